/* furnaces_surfaces.c - every lobe of lobes.def, made white, and the value that its furnaces are drawn over. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "furnaces.h"

/* --- distributions ------------------------------------------------------------------------------------------------ */

enum { GGX, BECKMANN, PHONG, GTR_15, GTR_3, STUDENT_18, STUDENT_4, EXPONENTIAL };
const char *const furnaces_shape_names[FURNACES_SHAPES] = {"GGX",   "Beckmann",      "Phong 20",    "GTR 1.5",
							   "GTR 3", "Student-T 1.8", "Student-T 4", "exp(-3 tan)"};

static lobe_distribution shapes[FURNACES_SHAPES];
static float tables[FURNACES_SHAPES][LOBE_PROFILE_WORDS];

static double falls(void *context, double tan_theta)
{
	(void)context;
	return exp(-3.0 * tan_theta);
}

void furnaces_prepare(void)
{
	lobe_status failed = LOBE_OK;
	shapes[GGX] = lobe_distribution_make(LOBE_NDF_GGX);
	shapes[BECKMANN] = lobe_distribution_make(LOBE_NDF_BECKMANN);
	failed |= lobe_distribution_phong(&shapes[PHONG], tables[PHONG], LOBE_PROFILE_WORDS, 20.0f);
	failed |= lobe_distribution_gtr(&shapes[GTR_15], tables[GTR_15], LOBE_PROFILE_WORDS, 1.5f, 0.3f);
	failed |= lobe_distribution_gtr(&shapes[GTR_3], tables[GTR_3], LOBE_PROFILE_WORDS, 3.0f, 0.5f);
	failed |= lobe_distribution_student_t(&shapes[STUDENT_18], tables[STUDENT_18], LOBE_PROFILE_WORDS, 1.8f);
	failed |= lobe_distribution_student_t(&shapes[STUDENT_4], tables[STUDENT_4], LOBE_PROFILE_WORDS, 4.0f);
	failed |=
		lobe_distribution_tabulated(&shapes[EXPONENTIAL], tables[EXPONENTIAL], LOBE_PROFILE_WORDS, falls, NULL);
	if (failed != LOBE_OK) {
		fprintf(stderr, "report: %s\n", lobe_error_message());
		exit(1);
	}
}

/* The densities of slopes of four fall with r^-3 to r^-6, the others faster. */
int furnaces_shape_tail(unsigned shape)
{
	return shape == GGX || shape == GTR_15 || shape == GTR_3 || shape == STUDENT_18 ? 3 : 1;
}

lobe_microsurface furnaces_microsurface(unsigned shape, double alpha, double alpha_y)
{
	const lobe_distribution d = shapes[shape];
	const double like = (double)lobe_distribution_like_ggx(d);
	return lobe_microsurface_make(
		d, lobe_linear_make((float)(alpha / like), 0.0f, 0.0f, (float)(alpha_y / like), 0.0f, 0.0f));
}

/* --- how each is made --------------------------------------------------------------------------------------------- */

static lobe_rgb grey(double x) { return lobe_rgb_make((float)x, (float)x, (float)x); }

/* Reflects all but 4e-9 at normal incidence, and 4e-6 at its least. */
#define WHITE_METAL grey(1e-3), grey(1000.0)

#define MADE(lobe, ax, ay, eta, ...)                                                                                   \
	const furnaces_made made = {lobe_bsdf_from_##lobe(__VA_ARGS__), ax, ay, eta, furnaces_shape_tail(s->ndf)};     \
	(void)value;                                                                                                   \
	return made

/* stretch: 0, or how much wider the surface is along x (1) or y (2): four times. */
static double width(const furnaces_surface *s, double value, unsigned across)
{
	return s->stretch == across ? fmax(0.25 * value, 1e-4) : value;
}

#define MAKE(name) static furnaces_made name(const furnaces_surface *s, double value)
MAKE(ggx_conductor)
{
	const double x = width(s, value, 2), y = width(s, value, 1);
	MADE(ggx_conductor, x, y, 0.0, lobe_ggx_conductor_make((float)x, (float)y, WHITE_METAL));
}
MAKE(beckmann_conductor)
{
	const float a = (float)value;
	MADE(beckmann_conductor, value, value, 0.0, lobe_beckmann_conductor_make(a, a, WHITE_METAL));
}
MAKE(ggx_schlick)
{
	const float a = (float)value;
	MADE(ggx_schlick, value, value, 0.0, lobe_ggx_schlick_make(a, a, grey(1.0), grey(1.0)));
}
MAKE(iridescent_conductor)
{
	const float a = (float)value;
	MADE(iridescent_conductor, value, value, 0.0, lobe_iridescent_conductor_make(a, a, 400.0f, 1.33f, WHITE_METAL));
}
MAKE(ggx_dielectric)
{
	const float a = (float)value;
	MADE(ggx_dielectric, value, value, 1.5,
	     lobe_ggx_dielectric_transport(lobe_ggx_dielectric_make(a, a, 1.5f), LOBE_TRANSPORT_IMPORTANCE));
}
MAKE(beckmann_dielectric)
{
	const float a = (float)value;
	MADE(beckmann_dielectric, value, value, 1.5,
	     lobe_beckmann_dielectric_transport(lobe_beckmann_dielectric_make(a, a, 1.5f), LOBE_TRANSPORT_IMPORTANCE));
}
MAKE(iridescent_dielectric)
{
	const float a = (float)value;
	MADE(iridescent_dielectric, value, value, 1.5,
	     lobe_iridescent_dielectric_transport(lobe_iridescent_dielectric_make(a, a, 400.0f, 1.33f, 1.5f),
						  LOBE_TRANSPORT_IMPORTANCE));
}

/* Films by their thickness [nm] on a surface so smooth that it loses little. */
#define FILM_ALPHA 0.03
MAKE(film_on_metal)
{
	const float a = (float)FILM_ALPHA;
	MADE(iridescent_conductor, FILM_ALPHA, FILM_ALPHA, 0.0,
	     lobe_iridescent_conductor_make(a, a, (float)value, 1.33f, WHITE_METAL));
}
MAKE(film_on_gold)
{
	const float a = (float)FILM_ALPHA;
	MADE(iridescent_conductor, FILM_ALPHA, FILM_ALPHA, 0.0,
	     lobe_iridescent_conductor_make(a, a, (float)value, 1.33f, lobe_metal_eta(LOBE_METAL_GOLD),
					    lobe_metal_k(LOBE_METAL_GOLD)));
}
MAKE(film_on_glass)
{
	const float a = (float)FILM_ALPHA;
	MADE(iridescent_dielectric, FILM_ALPHA, FILM_ALPHA, 1.5,
	     lobe_iridescent_dielectric_transport(lobe_iridescent_dielectric_make(a, a, (float)value, 1.33f, 1.5f),
						  LOBE_TRANSPORT_IMPORTANCE));
}

MAKE(lambert) { MADE(lambert, 1.0, 1.0, 0.0, lobe_lambert_make(grey(value))); }
MAKE(mirror) { MADE(mirror, 1.0, 1.0, 0.0, lobe_mirror_make(grey(value))); }
MAKE(smooth_conductor) { MADE(smooth_conductor, 1.0, 1.0, 0.0, lobe_smooth_conductor_make(grey(0.2), grey(value))); }
MAKE(smooth_dielectric)
{
	MADE(smooth_dielectric, 1.0, 1.0, value,
	     lobe_smooth_dielectric_transport(lobe_smooth_dielectric_make((float)value), LOBE_TRANSPORT_IMPORTANCE));
}
MAKE(thin_dielectric) { MADE(thin_dielectric, 1.0, 1.0, value, lobe_thin_dielectric_make((float)value)); }

static lobe_microsurface chosen(const furnaces_surface *s, double alpha)
{
	return lobe_microsurface_joint(
		lobe_microsurface_masking(furnaces_microsurface(s->ndf, alpha, alpha), s->masking), s->joint,
		s->across);
}
MAKE(microfacet_conductor)
{
	MADE(microfacet_conductor, value, value, 0.0,
	     lobe_microfacet_conductor_make(chosen(s, value), lobe_fresnel_model_constant(grey(1.0)),
					    LOBE_STRATEGY_VISIBLE));
}
MAKE(microfacet_dielectric)
{
	MADE(microfacet_dielectric, value, value, 1.5,
	     lobe_microfacet_dielectric_transport(lobe_microfacet_dielectric_make(chosen(s, value),
										  lobe_fresnel_model_dielectric(), 1.5f,
										  LOBE_STRATEGY_VISIBLE),
						  LOBE_TRANSPORT_IMPORTANCE));
}
MAKE(microfacet_diffuse)
{
	MADE(microfacet_diffuse, value, value, 0.0, lobe_microfacet_diffuse_make(chosen(s, value), grey(1.0)));
}

/* --- the list ----------------------------------------------------------------------------------------------------- */

#define ALPHA      .axis = "alpha", .from = 0.0016, .to = 1.0, .shown = {0.03, 0.1, 0.3, 0.6, 1.0}
#define THICKNESS  .axis = "film [nm]", .from = 0.0, .to = 1200.0, .shown = {100.0, 200.0, 400.0, 800.0, 1200.0}
#define INDEX      .axis = "index", .from = 1.05, .to = 3.0, .shown = {1.1, 1.33, 1.5, 2.0, 3.0}
#define REFLECTS   .axis = "reflectance", .from = 0.05, .to = 1.0, .shown = {0.2, 0.4, 0.6, 0.8, 1.0}
#define EXTINCTION .axis = "extinction k", .from = 0.5, .to = 8.0, .shown = {1.0, 2.0, 3.0, 5.0, 8.0}

/* lobes/microfacet_diffuse.h */
#define DIFFUSE(name_, ...)                                                                                            \
	SURFACE("diffuse", microfacet_diffuse, microfacet_diffuse, name_, ALPHA, .way = FURNACES_HEMISPHERE,           \
		.stated = 0.023, __VA_ARGS__)
#define SURFACE(family_, lobe_, make_, name_, ...)                                                                     \
	{                                                                                                              \
		.family = family_, .lobe = #lobe_, .name = name_, .make = make_, __VA_ARGS__                           \
	}
#define MASKED(name_, ...) SURFACE("masking", microfacet_conductor, microfacet_conductor, name_, ALPHA, __VA_ARGS__)
#define NO_SURFACE(name_, ...)                                                                                         \
	SURFACE("compared", microfacet_conductor, microfacet_conductor, name_, ALPHA, .no_surface = 1, __VA_ARGS__)
#define SHAPE(name_, shape)                                                                                            \
	SURFACE("distribution", microfacet_conductor, microfacet_conductor, name_, ALPHA, .ndf = shape)
#define LEVEL    .kinks = 1u << FURNACES_LEVEL
#define CAVITIES .kinks = 1u << FURNACES_LEVEL | 1u << FURNACES_CAVITY_O | 1u << FURNACES_CAVITY_I

const furnaces_surface furnaces_surfaces[] = {
	SURFACE("metal", ggx_conductor, ggx_conductor, "ggx_conductor", ALPHA),
	SURFACE("metal", ggx_conductor, ggx_conductor, "ggx_conductor alpha : alpha/4", ALPHA, .stretch = 1),
	SURFACE("metal", ggx_conductor, ggx_conductor, "ggx_conductor alpha/4 : alpha", ALPHA, .stretch = 2),
	SURFACE("metal", beckmann_conductor, beckmann_conductor, "beckmann_conductor", ALPHA, .ndf = BECKMANN),
	SURFACE("metal", ggx_schlick, ggx_schlick, "ggx_schlick", ALPHA),
	SURFACE("metal", iridescent_conductor, iridescent_conductor, "iridescent_conductor 400 nm", ALPHA),

	SURFACE("glass", ggx_dielectric, ggx_dielectric, "ggx_dielectric 1.5", ALPHA),
	SURFACE("glass", ggx_dielectric, ggx_dielectric, "ggx_dielectric 1.5 from inside", ALPHA, .inside = 1),
	SURFACE("glass", beckmann_dielectric, beckmann_dielectric, "beckmann_dielectric 1.5", ALPHA, .ndf = BECKMANN),
	SURFACE("glass", beckmann_dielectric, beckmann_dielectric, "beckmann_dielectric 1.5 from inside", ALPHA,
		.inside = 1, .ndf = BECKMANN),
	SURFACE("glass", microfacet_dielectric, microfacet_dielectric, "microfacet_dielectric 1.5 beta across", ALPHA,
		.across = LOBE_ACROSS_BETA),
	SURFACE("glass", iridescent_dielectric, iridescent_dielectric, "iridescent_dielectric 400 nm", ALPHA),

	SURFACE("film", iridescent_conductor, film_on_metal, "iridescent_conductor white base", THICKNESS),
	SURFACE("film", iridescent_conductor, film_on_gold, "iridescent_conductor gold", THICKNESS, .absorbs = 1),
	SURFACE("film", iridescent_dielectric, film_on_glass, "iridescent_dielectric", THICKNESS),
	SURFACE("film", iridescent_dielectric, film_on_glass, "iridescent_dielectric from inside", THICKNESS,
		.inside = 1),

	SURFACE("ideal", lambert, lambert, "lambert", REFLECTS, .way = FURNACES_HEMISPHERE, .absorbs = 1),
	SURFACE("ideal", mirror, mirror, "mirror", REFLECTS, .way = FURNACES_EVENTS, .absorbs = 1),
	SURFACE("ideal", smooth_conductor, smooth_conductor, "smooth_conductor n = .2", EXTINCTION,
		.way = FURNACES_EVENTS, .absorbs = 1),
	SURFACE("ideal", smooth_dielectric, smooth_dielectric, "smooth_dielectric", INDEX, .way = FURNACES_EVENTS),
	SURFACE("ideal", smooth_dielectric, smooth_dielectric, "smooth_dielectric from inside", INDEX,
		.way = FURNACES_EVENTS, .inside = 1),
	SURFACE("ideal", thin_dielectric, thin_dielectric, "thin_dielectric", INDEX, .way = FURNACES_EVENTS),

	DIFFUSE("microfacet_diffuse GGX", .ndf = GGX),
	DIFFUSE("microfacet_diffuse Beckmann", .ndf = BECKMANN),
	DIFFUSE("microfacet_diffuse Beckmann V-cavities", .ndf = BECKMANN, .masking = LOBE_MASKING_VCAVITY),

	MASKED("Smith height-correlated", .joint = LOBE_JOINT_HEIGHT),
	MASKED("Smith separable", .joint = LOBE_JOINT_SEPARABLE),
	MASKED("Smith direction-correlated", .joint = LOBE_JOINT_DIRECTION, LEVEL),
	MASKED("Smith height and direction", .joint = LOBE_JOINT_HEIGHT_DIRECTION, LEVEL),
	MASKED("V-cavities", .masking = LOBE_MASKING_VCAVITY, CAVITIES),
	MASKED("Beckmann Smith rational", .no_surface = 1, .ndf = BECKMANN, .masking = LOBE_MASKING_SMITH_RATIONAL),

	NO_SURFACE("no masking", .masking = LOBE_MASKING_NONE),
	NO_SURFACE("implicit", .masking = LOBE_MASKING_IMPLICIT),
	NO_SURFACE("Schlick-Smith alpha/2", .masking = LOBE_MASKING_SCHLICK_GGX),
	NO_SURFACE("Schlick-Smith alpha sqrt(2/pi)", .masking = LOBE_MASKING_SCHLICK_SMITH),
	NO_SURFACE("Schlick-Smith (r + 1)^2/8", .masking = LOBE_MASKING_SCHLICK_GGX_LIGHTS),
	NO_SURFACE("Kelemen", .masking = LOBE_MASKING_KELEMEN),
	NO_SURFACE("Neumann", .masking = LOBE_MASKING_NEUMANN, LEVEL),
	NO_SURFACE("Disney", .masking = LOBE_MASKING_DISNEY),

	SHAPE("Beckmann", BECKMANN),
	SHAPE("Phong 20", PHONG),
	SHAPE("GTR 1.5", GTR_15),
	SHAPE("GTR 3", GTR_3),
	SHAPE("Student-T 1.8", STUDENT_18),
	SHAPE("Student-T 4", STUDENT_4),
	SHAPE("exp(-3 tan)", EXPONENTIAL),
};
const size_t furnaces_surface_count = sizeof furnaces_surfaces / sizeof *furnaces_surfaces;

int furnaces_by_alpha(const furnaces_surface *s) { return strcmp(s->axis, "alpha") == 0; }

double furnaces_value(const furnaces_surface *s, size_t i, size_t n)
{
	const double t = (double)i / (double)(n - 1);
	if (furnaces_by_alpha(s)) {
		const double r = sqrt(s->from) + (sqrt(s->to) - sqrt(s->from)) * t;
		return r * r;
	}
	return s->from + (s->to - s->from) * t;
}
