/* furnaces.h - surfaces in constant light: what of it they send back, and what of their facets is seen.
 *
 *	furnaces_integral.c	integrals over the facets that a direction sees, to an error of their own
 *	furnaces_surfaces.c	every lobe of lobes.def, white, and the value that its furnaces are drawn over
 *	furnaces_energy.c	the energy of one surface from one angle
 *	furnaces_white.c	over value and angle: the maps
 *	furnaces_shown.c	at the values and angles of the tables, and averaged over a ball
 *	furnaces_weak.c		the weak furnace of every distribution and masking
 *	furnaces_sheets.c	maps and balls as pictures
 *	furnaces.c		the section */
#ifndef LOBE_BENCH_REPORT_FURNACES_H
#define LOBE_BENCH_REPORT_FURNACES_H

#include "lobe/lobe.h"
#include "report.h"

/* --- integrals over facets ---------------------------------------------------------------------------------------- */

/* Facets are s = (sx, sy, 1), not unit. Functions of them whose zeros bound what is integrated, or
 * where it has a kink. */
typedef enum {
	FURNACES_VISIBLE,   /* o.m > 0 */
	FURNACES_REFLECTED, /* the reflected direction is on o's side */
	FURNACES_REFRACTED, /* the refracted one is on the other side */
	FURNACES_TOTAL,     /* there is a refracted one */
	FURNACES_LEVEL,     /* the reflected direction is above o */
	FURNACES_CAVITY_O,  /* V-cavities hide nothing of the facet from o ... */
	FURNACES_CAVITY_I,  /* ... from the reflected direction */
	FURNACES_CUTS
} furnaces_cut;

typedef struct {
	double s[3], length2, facing; /* facing: o.s */
} furnaces_facet;

/* o: unit, o.y = 0, o.z >= 0. The facets' slopes are (ax cos, ay sin)(phi) r; e: index of the far side over o's.
 * bounds, kinks: sets of 1 << furnaces_cut. add: adds weight times the integrand, per solid angle of facets, to sum. */
typedef struct furnaces_integrand {
	double o[3], ax, ay, e;
	int tail; /* 1: facets beyond a few widths do not count; 3: a long tail */
	unsigned bounds, kinks;
	void (*add)(const struct furnaces_integrand *f, const furnaces_facet *m, double weight, double sum[3]);
	const void *context;
} furnaces_integrand;

/* The integral of a function that is even in y, by n x n Gauss points to each smooth piece, for more and more n = 8,
 * 12, 16, 24 .. most, until twice the change from either of the last two is less than tolerance; returns that, which
 * holds for the last as long as each is nearer than the one before (in 2 of 1110 cells the bare change was up to 1.4
 * times too small). scale: of sum. */
double furnaces_integral(const furnaces_integrand *f, double scale, double tolerance, size_t most, double sum[3]);

/* --- surfaces ----------------------------------------------------------------------------------------------------- */

enum { FURNACES_SHOWN = 5 };

/* How the energy is integrated. FACETS: over facets; HEMISPHERE: over directions; EVENTS: a delta lobe's events. */
typedef enum { FURNACES_FACETS, FURNACES_HEMISPHERE, FURNACES_EVENTS } furnaces_way;

/* A surface at one value of its axis. eta: 0 where nothing is transmitted. tail: of furnaces_integrand. */
typedef struct {
	lobe_bsdf bsdf;
	double ax, ay, eta;
	int tail;
} furnaces_made;

typedef struct furnaces_surface {
	const char *family; /* surfaces of one sheet */
	const char *lobe;   /* of lobes.def */
	const char *name;   /* no comma */
	const char *axis;   /* what value is */
	double from, to;    /* of maps: even steps of the value, or of sqrt(alpha) */
	double shown[FURNACES_SHOWN];
	furnaces_way way;
	int inside;     /* seen from below */
	int no_surface; /* masking that is no surface's, to be compared: may make light */
	int absorbs;    /* what is missing is not lost by scattering once */
	furnaces_made (*make)(const struct furnaces_surface *s, double value);
	unsigned ndf, masking, joint, across, stretch;
	unsigned kinks;
	double stated; /* what the lobe's header says that eval is off by, by fixed facets */
	/* NULL: the lobe's own; tests plant theirs. */
	lobe_rgb (*eval)(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 wi);
} furnaces_surface;

extern const furnaces_surface furnaces_surfaces[];
extern const size_t furnaces_surface_count;

/* Distributions, those with a table among them. Prepares the tables: call once before threads. */
enum { FURNACES_SHAPES = 8 };
extern const char *const furnaces_shape_names[FURNACES_SHAPES];
void furnaces_prepare(void);

int furnaces_shape_tail(unsigned shape);

/* That shape stretched to the width that is most like GGX's alpha. */
lobe_microsurface furnaces_microsurface(unsigned shape, double alpha, double alpha_y);

/* Value i of n along the axis of the maps. */
double furnaces_value(const furnaces_surface *s, size_t i, size_t n);
int furnaces_by_alpha(const furnaces_surface *s);

/* --- energies ----------------------------------------------------------------------------------------------------- */

typedef struct {
	double rgb[3], error;
} furnaces_energy;

/* Integrals are refined until they change by less than 1e-4, 5e-6 or 5e-7, or no longer than is worth it. */
typedef enum { FURNACES_ROUGH, FURNACES_FINE, FURNACES_FINEST } furnaces_effort;

/* Of constant light 1 the radiance that leaves at that cosine; below a glass the light is as strong as in balance with
 * that above, index squared: energy is counted as importance. */
furnaces_energy furnaces_energy_at(const furnaces_surface *s, double value, double cosine, furnaces_effort effort);

/* What a map's cell or a table's entry may be above 1 by roundings of floats. */
#define FURNACES_ROUNDING 1e-5

/* The area of facets that a direction sees, over that of the mean plane, by masking LOBE_MASKING_*: 1 for a surface.
 * wrong: of a masking of a surface that much wider, for tests; 0. */
furnaces_energy furnaces_weak_at(unsigned shape, unsigned masking, double alpha, double cosine, double wrong);

/* On GGX, of a masking that is a function of the cosine alone. NaN: there is no closed form here. */
double furnaces_weak_known(unsigned masking, double alpha, double cosine);

/* --- studies and pictures ----------------------------------------------------------------------------------------- */

extern const report_study furnaces_white, furnaces_shown, furnaces_weak;

/* The rows of one surface at value i of n, as furnaces_white has them. */
void furnaces_white_rows(const furnaces_surface *s, size_t i, int quick, report_rows *rows);

/* The mean of the channels: a film passes in one what it reflects in another. */
double furnaces_mean(const report_table *t, size_t row);

/* The cell of t, rows of furnaces_white, that is most above 1 by more than its error, FURNACES_ROUNDING and what the
 * lobe states, among the surfaces of that name (NULL: of all that are surfaces). 0: there is none. *most: that cell, or
 * the brightest. */
int furnaces_gains(const report_table *t, const char *name, size_t *most);

/* Files that the gnuplot scripts draw, and the figures in the page. */
void furnaces_draw_maps(report_page *page, const report_table *white);
void furnaces_draw_balls(report_page *page, const report_table *shown);
/* What a ball of that surface and value loses, in %, as printed: the last digit is ten times its error or more. */
typedef struct {
	char text[32];
} furnaces_lost;
furnaces_lost furnaces_ball_loses(const report_table *shown, const char *name, double value);
void furnaces_write_balls(report_page *page, const report_table *shown);
void furnaces_write_angles(report_page *page, const report_table *shown);
void furnaces_write_weak(report_page *page, const report_table *weak);

/* In a map's colours: 0 within 1/1000 of 1, -1 where all is lost, 1 where as much is made, by logarithm between. */
double furnaces_tone(double energy);

#endif
