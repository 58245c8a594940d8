/* approximations.h - ways to compute the same thing, exact and approximate: what the section's studies compare.
 *
 *	approximations_ways.h		every way, once: its group, its name and its expression
 *	approximations_loops.c		the expressions as loops, vectorised and one by one
 *	approximations_opencl.c		the same text as OpenCL kernels, and OpenCL's built-in functions
 *	approximations_albedo.c		directions and weights to integrate albedos with
 *	approximations_fresnel.c	errors of reflectances, films included
 *	approximations_reference.c	what the references themselves are off by
 *	approximations_shadow.c		errors of Lambda, masking and tabulated distributions
 *	approximations_real.c		errors of elementary functions
 *	approximations_field.c		masking simulated on explicit height fields
 *	approximations_field.h		the fields, and rays over them
 *	approximations_lobes.h		lobes in single and in double precision (approximations_single.c, _double.c)
 *	approximations_precision.c	one against the other
 *	approximations_time.c		time of all of them
 *	approximations.c		the section */
#ifndef LOBE_BENCH_REPORT_APPROXIMATIONS_H
#define LOBE_BENCH_REPORT_APPROXIMATIONS_H

#include "approximations_ways.h"
#include "report.h"

/* --- ways --------------------------------------------------------------------------------------------------------- */

typedef enum {
	GROUP_LAMBDA,     /* |z| Lambda of Beckmann's surface; in: x, z of the direction */
	GROUP_DIELECTRIC, /* reflectance; in: cosine */
	GROUP_CONDUCTOR,  /* reflectance of one channel; in: cosine */
	GROUP_FILM,       /* three channels; in: cosine */
	GROUP_MASKING,    /* G2 of a GGX surface; in: o.z, o.x, i.z, i.x, i.y (o.y = 0) */
	GROUP_ACROSS,     /* the same, i below: -i.z, -i.x, -i.y */
	GROUP_DENSITY,    /* pi D of a direction's unstretched half vector; in: x, y, z */
	GROUP_HIDDEN,     /* |z| Lambda; in: x, y, z */
	GROUP_VISIBLE,    /* a visible normal, three outputs; in: x, y, z, u.x, u.y */
	GROUP_REAL,       /* elementary functions; in: x, y. Named function/by */
	GROUPS
} approximations_group;

extern const char *const approximations_groups[GROUPS];

enum { APPROXIMATIONS_IN = 5, APPROXIMATIONS_OUT = 3 };

/* Arrays of n numbers. in: as many as the group has, the rest are not read. */
typedef void (*approximations_loop)(const approximations_set *set, size_t n, const float *const in[APPROXIMATIONS_IN],
				    float *const out[APPROXIMATIONS_OUT]);

typedef struct {
	approximations_group group;
	const char *id;   /* of the OpenCL kernel */
	const char *name; /* no comma */
	int outputs;
	int exact; /* what the others of the group approximate */
	approximations_loop vector, scalar;
	const char *text; /* of the kernel's value; NULL: none on OpenCL */
} approximations_way;

extern const approximations_way approximations_ways[];
size_t approximations_way_count(void);

/* Spectral nodes of the film ways in approximations_loops.c: place nodes over the observer's range.
 * Call once before. */
void approximations_film_nodes(void);

/* The sensitivity of channel 0 .. 2 at wave number nu [1/nm], whose integral is 1 (core/thin_film.h). */
double approximations_film_sensitivity(int channel, double nu);
#define FILM_NU_MIN 0.9e-3
#define FILM_NU_MAX 3.1e-3

/* --- OpenCL ------------------------------------------------------------------------------------------------------- */

/* Built-in functions of OpenCL beside the ways of GROUP_REAL. */
typedef struct {
	const char *id, *name, *text;
} approximations_builtin;

extern const approximations_builtin approximations_builtins[];
size_t approximations_builtin_count(void);

typedef struct approximations_device approximations_device;

/* NULL: no OpenCL here, after a word on stderr. */
approximations_device *approximations_device_open(void);
void approximations_device_close(approximations_device *device);

/* Runs kernel id on n elements, rounds times; seconds: of each round, NULL: not asked for. Not 0: failed. */
int approximations_device_run(approximations_device *device, const char *id, const approximations_set *set, size_t n,
			      const float *const in[APPROXIMATIONS_IN], float *out[APPROXIMATIONS_OUT], int rounds,
			      double *seconds);

/* --- errors ------------------------------------------------------------------------------------------------------- */

/* What a study says of one way. reference: what the exact value itself may be off by; at: where the
 * largest error is. */
typedef struct {
	double max, sum2, n, albedo, albedo_at[2], reference, albedo_reference;
	char at[64];
} approximations_error;

void approximations_error_add(approximations_error *e, double got, double exact, const char *format, ...)
	REPORT_PRINTF(4, 5);
void approximations_error_albedo(approximations_error *e, double off, double reference, double alpha, double cosine);
void approximations_error_row(report_rows *rows, const char *group, const char *name, const char *of,
			      const char *quantity, const approximations_error *e);

/* Units of the error study, in the order of their sections; each appends the rows of unit 0 .. units - 1. */
typedef struct {
	size_t (*units)(void);
	int (*run)(int quick, size_t unit, report_rows *rows);
} approximations_part;
extern const approximations_part approximations_fresnel, approximations_shadow, approximations_real;

extern const report_study approximations_field_study, approximations_precision_study, approximations_time_study;

/* --- references --------------------------------------------------------------------------------------------------- */

/* How far a reference in double precision is from the same in long double (of real: MPFR). */
double approximations_doubt_fresnel(double exact, double c, double n, double k);
double approximations_doubt_beckmann_g1(double exact, double a);
double approximations_doubt_ggx_g2(double exact, double alpha, const double o[3], const double i[3], int across);
double approximations_doubt_density(double exact, int beckmann, double t);
double approximations_doubt_hidden(double exact, int beckmann, double t);
double approximations_doubt_real(const char *name, double reference, float x, float y);

/* --- albedo ------------------------------------------------------------------------------------------------------- */

/* Directions that facets visible from o reflect it to: E = sum weight (G2/z_o) F with sigma(o) in the weight. i.z <= 0
 * is left out. o.y = 0. */
enum { ALBEDO_ALPHAS = 4, ALBEDO_COSINES = 6 };
extern const double albedo_alphas[ALBEDO_ALPHAS], albedo_cosines[ALBEDO_COSINES];

typedef struct {
	size_t n;
	float *cosine;       /* o.m */
	float *iz, *ix, *iy; /* i */
	float *hx, *hy, *hz; /* the facet, unit */
	double *weight;      /* sigma/count */
	double *smith;       /* G2/z_o, height-correlated */
	float ox, oz;
} albedo_nodes;

/* ndf: LOBE_NDF_GGX or _BECKMANN. side: points per axis. NULL d: visible normals of ndf; or of another distribution. */
albedo_nodes *albedo_nodes_make(unsigned ndf, const lobe_distribution *d, double alpha, double cosine, int side);
void albedo_nodes_free(albedo_nodes *nodes);

#endif
