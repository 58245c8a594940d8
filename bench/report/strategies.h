/* strategies.h - what the studies of sampling strategies share: lights, materials, and one sample by each technique.
 *
 * A case is a material, a direction to the viewer and a light around it; what is estimated is the luminance that
 * reaches the viewer, the integral of f L |cos theta_i|. All techniques estimate the same number, each from its own
 * directions: the ten strategies of microfacet/strategy.h draw them from the lobe, LIGHT from the light in proportion
 * to its luminance, and the last ones from both, a direction each, weighted by the balance or power heuristic (Veach
 * 1997). */
#ifndef LOBE_REPORT_STRATEGIES_H
#define LOBE_REPORT_STRATEGIES_H

#include "light.h"
#include "lobe/lobe.h"
#include "lobe/recommend.h"
#include "report.h"

/* --- lights (strategies_light.c) ---------------------------------------------------------------------------------- */

enum { STRATEGIES_PARTS = 2, STRATEGIES_PROBES = 8 };

/* A part of an analytic light, of unit power. CONE: a disk of 1 - cos(radius) = a, uniform. SKY: a + b z above the
 * horizon. GLOW: ((1 + cos)/2)^a around the axis, over the whole sphere. share: of the light's power. place: what the
 * axis is when a case is set up. */
enum { STRATEGIES_CONE, STRATEGIES_SKY, STRATEGIES_GLOW };
enum { STRATEGIES_FIXED, STRATEGIES_HIGHLIGHT, STRATEGIES_ASIDE };

typedef struct {
	int kind, place;
	float share, a, b;
	lobe_frame frame; /* n: the axis */
} strategies_part;

/* Its radiance is its power times the density with which it is drawn, so that the parts sum up to either; a probe's is
 * its own, and its density that of its luminance. solid_angle [sr]: of a uniform light that is as concentrated,
 * (integral of L)^2 over integral of L^2. */
typedef struct {
	char name[48];
	int parts;
	strategies_part part[STRATEGIES_PARTS];
	const struct light *probe; /* or NULL */
	lobe_light_shape shape;    /* of a probe: fitted */
	double solid_angle;
	int turned;       /* the light's z is not the surface's: */
	lobe_frame frame; /* the surface, in the light's space */
} strategies_light;

/* Loads the probes when it is called first, which should be from one thread: LOBE_REPORT_PROBES names files or folders,
 * separated by ':'; without it those that deps.sh probes has fetched, or of an installed blender-data. quick: two of
 * them at most. */
size_t strategies_lights(int quick);
size_t strategies_analytic_lights(void);

/* For the section's text: where probes came from, or why there are none. */
const char *strategies_probes_said(void);
/* What rows follow from: the probes' names and contents. */
const char *strategies_settings(int quick);

/* Light i, placed for a viewer at wo. */
strategies_light strategies_light_at(size_t i, lobe_vec3 wo);

/* What comes from w (unit), and the density with which strategies_draw draws it. */
lobe_rgb strategies_radiance(const strategies_light *light, lobe_vec3 w, float *pdf);
struct light_sample strategies_draw(const strategies_light *light, float u1, float u2);

/* strategies_shape.c: the light as lobe_recommend_strategy is told of it; that fitted to a probe. */
lobe_light_shape strategies_shape(const strategies_light *light);
lobe_light_shape strategies_fit(const struct light *light);

/* --- cases and techniques (strategies_case.c) --------------------------------------------------------------------- */

enum {
	STRATEGIES_LIGHT = LOBE_STRATEGY_LAST + 1, /* those before: LOBE_STRATEGY_* */
	STRATEGIES_BALANCE,
	STRATEGIES_POWER,
	STRATEGIES_BALANCE_BOUNDED, /* with the bounded cap in the place of visible normals */
	STRATEGIES_TECHNIQUES,
	STRATEGIES_LOBE = STRATEGIES_LIGHT /* the number of those that sample the lobe alone */
};

const char *strategies_name(int technique);

/* Materials: gold with GGX, GGX four times as wide along x as along y, Beckmann. alpha is the greater width. */
enum { STRATEGIES_GGX, STRATEGIES_BRUSHED, STRATEGIES_BECKMANN, STRATEGIES_MATERIALS };
const char *strategies_material_name(int material);

typedef struct {
	int material;
	double alpha, cosine;
	lobe_vec3 wo;
	strategies_light light;
	lobe_microfacet_conductor lobe[LOBE_STRATEGY_LAST + 1]; /* by strategy */
} strategies_case;

/* light: of strategies_lights. */
strategies_case strategies_case_make(int material, double alpha, double cosine, size_t light);
lobe_microfacet_conductor strategies_lobe(int material, float alpha, lobe_uint strategy);

/* The distribution's part of a material: what time depends on. */
int strategies_ndf(int material);

/* LOBE_STRATEGY_*: what the production lobe of it does. */
int strategies_default(int material);

/* One estimate of the luminance. u for a direction from the lobe, v for one from the light. */
float strategies_estimate(const strategies_case *c, int technique, const float u[3], const float v[3]);

/* The same, and what it is made of, compiled for one distribution and for each strategy alone (strategies_only.h): what
 * times are of. The same bits. */
typedef struct {
	float (*estimate[STRATEGIES_TECHNIQUES])(const strategies_case *c, const float u[3], const float v[3]);
	lobe_real (*pdf[STRATEGIES_LOBE])(const strategies_case *c, lobe_vec3 wi);
	lobe_sample (*sample[STRATEGIES_LOBE])(const strategies_case *c, lobe_vec3 u);
} strategies_compiled;
extern const strategies_compiled strategies_only_ggx, strategies_only_beckmann;
const strategies_compiled *strategies_compiled_for(const strategies_case *c);

/* The same with production code, ggx_conductor or beckmann_conductor, in the place of VISIBLE. */
float strategies_estimate_production(const strategies_case *c, const lobe_rough_conductor *p, const float u[3]);
lobe_rough_conductor strategies_production(int material, float alpha);

static inline float strategies_luminance(lobe_rgb c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/* strategies_shape.c: what lobe/recommend.h finds when it asks the light itself. */
lobe_recommend_sums strategies_asked(const strategies_case *c);

/* --- exact moments (strategies_moments.c) ------------------------------------------------------------------------- */

/* mean: what is estimated; variance: of one sample by each technique (of MIS: a direction of each). error: one standard
 * deviation of either, from independent randomisations. */
typedef struct {
	double mean, mean_error;
	double variance[STRATEGIES_TECHNIQUES], error[STRATEGIES_TECHNIQUES];
} strategies_moments;

/* By points in both the lobe's and the light's coordinates, together (balance heuristic): 2 n points, Owen-scrambled,
 * runs times. runs at most 16. */
strategies_moments strategies_moments_of(const strategies_case *c, uint32_t n, uint32_t runs, uint32_t seed);

/* The mean alone, by n points of POWER, runs times, and its standard deviation. */
double strategies_reference(const strategies_case *c, uint32_t n, uint32_t runs, uint32_t seed, double *error);

/* The same by adaptive quadrature of the textbook's formula in double, for analytic lights; 0 for probes. */
double strategies_quadrature(const strategies_case *c, double *error);

/* --- grids and studies -------------------------------------------------------------------------------------------- */

size_t strategies_alphas(int quick);
double strategies_alpha(int quick, size_t i);
/* Light i of those that a material is seen under: all, or for Beckmann some. */
size_t strategies_lights_of(int quick, int material);
size_t strategies_light_of(int quick, int material, size_t i);

size_t strategies_cosines(int quick);
double strategies_cosine(int quick, size_t i);

extern const report_study strategies_map_study, strategies_time_study, strategies_batch_study, strategies_curves_study,
	strategies_reference_study, strategies_expected_study, strategies_pictures_study, strategies_holdout_study;

/* Of pictures by other seeds every fourth pixel of every fourth row, from the second on. */
enum { STRATEGIES_GRID = 4 };

/* strategies_sheet.c: the sheets of pictures, from the rows. */
void strategies_write_pictures(report_page *page, const report_table *reference, const report_table *expected,
			       const report_table *pictures);

#endif
