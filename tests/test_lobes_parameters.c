/* test_lobes_parameters.c - parameters that are no numbers shade to nothing: each field of the struct in turn, and each
 * argument of make. */
#include "cases.h"
#include "directions.h"
#include "sound.h"
#include "support.h"

#include "unity.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

/* carries: what eval and the sample's weight add up to over some directions; 0 says that nothing is shaded. */
static double carries(const lobe_bsdf *b, int channel, uint32_t stream)
{
	double sum = 0.0;
	for (uint32_t j = 0; j < 200u; j++) {
		float a[3], w[3], u[3];
		test_direction(stream, j, a);
		test_direction(stream + 1u, j, w);
		test_u3(stream + 2u, j, u);
		const lobe_rgb f = lobe_bsdf_eval(*b, vec3(a), vec3(w));
		const lobe_sample s = lobe_bsdf_sample(*b, vec3(a), vec3(u));
		if (!sound_rgb(f) || !sound_rgb(s.weight) || !sound(s.pdf) ||
		    !sound(lobe_bsdf_pdf(*b, vec3(a), vec3(w))))
			return (double)INFINITY;
		sum += channel == 0   ? (double)(f.r + s.weight.r)
		       : channel == 1 ? (double)(f.g + s.weight.g)
				      : (double)(f.b + s.weight.b);
	}
	return sum;
}

/* offset of a field of one lobe's struct, and of another that is spoilt with it; channel: the colour that it governs,
 * or -1 for all three; is_width: part of the microsurface. */
typedef struct {
	const char *name;
	size_t offset, with;
	int channel, is_width;
} field;

#define FIELDS(lobe, member, other, channel, is_width)                                                                 \
	{                                                                                                              \
#lobe "." #member, offsetof(lobe_##lobe, member), offsetof(lobe_##lobe, other), channel, is_width      \
	}
#define FIELD(lobe, member, channel) FIELDS(lobe, member, member, channel, 0)
#define WIDTH(lobe, member)          FIELDS(lobe, member, member, -1, 1)
#define RGB_FIELD(lobe, member)      FIELD(lobe, member.r, 0), FIELD(lobe, member.g, 1), FIELD(lobe, member.b, 2)
#define STRETCH_FIELD(lobe, member)                                                                                    \
	WIDTH(lobe, member.alpha_x), WIDTH(lobe, member.alpha_y), WIDTH(lobe, member.inv_alpha_x),                     \
		WIDTH(lobe, member.inv_alpha_y), WIDTH(lobe, member.norm)
/* inv_eta serves below the surface alone, eta above: half of the directions do not read it, so a field has to be sound
 * everywhere and 0 where it is used; eta and inv_eta are spoilt together, as make would. */
#define ETA_FIELD(lobe, eta, inv_eta) FIELDS(lobe, eta, inv_eta, -1, 0), FIELDS(lobe, inv_eta, eta, -1, 0)
#define FILM_FIELD(lobe)              FIELD(lobe, film.thickness, -1), FIELD(lobe, film.index, -1)

static const field fields_lambert[] = {RGB_FIELD(lambert, reflectance)};
static const field fields_ggx_conductor[] = {STRETCH_FIELD(ggx_conductor, stretch), RGB_FIELD(ggx_conductor, eta),
					     RGB_FIELD(ggx_conductor, k)};
static const field fields_ggx_dielectric[] = {STRETCH_FIELD(ggx_dielectric, stretch),
					      ETA_FIELD(ggx_dielectric, eta, inv_eta)};
static const field fields_ggx_schlick[] = {STRETCH_FIELD(ggx_schlick, stretch), RGB_FIELD(ggx_schlick, f0),
					   RGB_FIELD(ggx_schlick, f90)};
static const field fields_mirror[] = {RGB_FIELD(mirror, reflectance)};
static const field fields_smooth_conductor[] = {RGB_FIELD(smooth_conductor, eta), RGB_FIELD(smooth_conductor, k)};
static const field fields_smooth_dielectric[] = {ETA_FIELD(smooth_dielectric, eta, inv_eta)};
static const field fields_thin_dielectric[] = {FIELD(thin_dielectric, eta, -1)};
static const field fields_iridescent_conductor[] = {
	STRETCH_FIELD(iridescent_conductor, stretch), RGB_FIELD(iridescent_conductor, eta),
	RGB_FIELD(iridescent_conductor, k), FILM_FIELD(iridescent_conductor)};
static const field fields_iridescent_dielectric[] = {STRETCH_FIELD(iridescent_dielectric, glass.stretch),
						     ETA_FIELD(iridescent_dielectric, glass.eta, glass.inv_eta),
						     FILM_FIELD(iridescent_dielectric)};

#define LINEAR_FIELD(lobe, map)                                                                                        \
	FIELD(lobe, map.xx, -1), FIELD(lobe, map.xy, -1), FIELD(lobe, map.yx, -1), FIELD(lobe, map.yy, -1),            \
		FIELD(lobe, map.mean_x, -1), FIELD(lobe, map.mean_y, -1), FIELD(lobe, map.ixx, -1),                    \
		FIELD(lobe, map.ixy, -1), FIELD(lobe, map.iyx, -1), FIELD(lobe, map.iyy, -1), FIELD(lobe, map.norm, -1)
#define MICROSURFACE_FIELD(lobe)                                                                                       \
	LINEAR_FIELD(lobe, surface.map), FIELD(lobe, surface.distribution.exponent, -1),                               \
		FIELD(lobe, surface.distribution.width, -1), FIELD(lobe, surface.distribution.norm, -1),               \
		FIELD(lobe, surface.like, -1), FIELD(lobe, surface.alpha, -1), FIELD(lobe, surface.narrow, -1)
#define FRESNEL_FIELD(lobe)                                                                                            \
	RGB_FIELD(lobe, fresnel.a), RGB_FIELD(lobe, fresnel.b), FIELD(lobe, fresnel.c, -1), FIELD(lobe, fresnel.d, -1)
static const field fields_microfacet_conductor[] = {MICROSURFACE_FIELD(microfacet_conductor),
						    FRESNEL_FIELD(microfacet_conductor)};
static const field fields_microfacet_dielectric[] = {MICROSURFACE_FIELD(microfacet_dielectric),
						     FRESNEL_FIELD(microfacet_dielectric),
						     FIELD(microfacet_dielectric, eta, -1),
						     FIELD(microfacet_dielectric, inv_eta, -1)};
static const field fields_microfacet_diffuse[] = {MICROSURFACE_FIELD(microfacet_diffuse),
						  RGB_FIELD(microfacet_diffuse, reflectance)};

static const field fields_beckmann_conductor[] = {STRETCH_FIELD(beckmann_conductor, stretch),
						  RGB_FIELD(beckmann_conductor, eta), RGB_FIELD(beckmann_conductor, k)};
static const field fields_beckmann_dielectric[] = {STRETCH_FIELD(beckmann_dielectric, stretch),
						   ETA_FIELD(beckmann_dielectric, eta, inv_eta)};

static unsigned poisoned, shaded;

static void poison(const test_case *c, const field *f, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		static const float values[] = {NAN, INFINITY, -INFINITY};
		for (size_t k = 0; k < 3; k++) {
			lobe_bsdf b = c->bsdf;
			memcpy((char *)&b.as + f[i].offset, &values[k], sizeof values[k]);
			memcpy((char *)&b.as + f[i].with, &values[k], sizeof values[k]);
			double sum = 0.0;
			for (int channel = 0; channel < 3; channel++)
				if (f[i].channel < 0 || f[i].channel == channel)
					sum += carries(&b, channel, 60000u);
			poisoned++;
			/* An infinite width or norm may come out as one that is merely wrong; a NaN must shade to
			 * nothing, and so must an infinite colour or index. Both must stay sound. */
			const int must_be_zero = isnan(values[k]) || !f[i].is_width;
			if (isinf(sum) || (must_be_zero && sum != 0.0)) {
				shaded++;
				printf("  %s: %s = %g gives %g, expected 0\n", c->name, f[i].name, (double)values[k],
				       sum);
			}
		}
	}
}

static void test_fields_that_are_no_numbers(void)
{
	lobe_uint last = 0;
	poisoned = shaded = 0;
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		/* One rough lobe of each kind is enough. */
		if (c->kind == last || (c->alpha_x > 0.0 && c->alpha_x < 0.5))
			continue;
		last = c->kind;
#define LOBE_X(NAME, name, value)                                                                                      \
	if (c->kind == LOBE_KIND_##NAME)                                                                               \
		poison(c, fields_##name, sizeof fields_##name / sizeof *fields_##name);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	}
	printf("  %u spoilt fields: %u shade to something\n", poisoned, shaded);
	TEST_ASSERT_GREATER_THAN(60, poisoned);
	TEST_ASSERT_EQUAL_UINT(0, shaded);
}

static void test_arguments_that_are_no_numbers(void)
{
	const lobe_rgb n = lobe_metal_eta(LOBE_METAL_GOLD), k = lobe_metal_k(LOBE_METAL_GOLD);
	const float nan = NAN;
	const lobe_bsdf b[] = {
		lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(nan, nan, nan))),
		lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(nan, 0.5f, n, k)),
		lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(0.5f, nan, n, k)),
		lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(0.5f, 0.5f, lobe_rgb_make(nan, nan, nan), k)),
		lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(0.5f, 0.5f, n, lobe_rgb_make(nan, nan, nan))),
		lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(nan, 0.5f, 1.5f)),
		lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.5f, nan, 1.5f)),
		lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.5f, 0.5f, nan)),
		lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.5f, 0.5f, INFINITY)),
		lobe_bsdf_from_beckmann_conductor(lobe_beckmann_conductor_make(nan, 0.5f, n, k)),
		lobe_bsdf_from_beckmann_conductor(lobe_beckmann_conductor_make(0.5f, nan, n, k)),
		lobe_bsdf_from_beckmann_dielectric(lobe_beckmann_dielectric_make(nan, 0.5f, 1.5f)),
		lobe_bsdf_from_beckmann_dielectric(lobe_beckmann_dielectric_make(0.5f, nan, 1.5f)),
		lobe_bsdf_from_beckmann_dielectric(lobe_beckmann_dielectric_make(0.5f, 0.5f, nan)),
		lobe_bsdf_from_ggx_schlick(lobe_ggx_schlick_make(nan, 0.5f, n, n)),
		lobe_bsdf_from_ggx_schlick(lobe_ggx_schlick_make(0.5f, 0.5f, lobe_rgb_make(nan, nan, nan), n)),
		lobe_bsdf_from_ggx_schlick(lobe_ggx_schlick_make(0.5f, 0.5f, n, lobe_rgb_make(nan, nan, nan))),
		lobe_bsdf_from_mirror(lobe_mirror_make(lobe_rgb_make(nan, nan, nan))),
		lobe_bsdf_from_smooth_conductor(lobe_smooth_conductor_make(lobe_rgb_make(nan, nan, nan), k)),
		lobe_bsdf_from_smooth_conductor(lobe_smooth_conductor_make(n, lobe_rgb_make(nan, nan, nan))),
		lobe_bsdf_from_smooth_dielectric(lobe_smooth_dielectric_make(nan)),
		lobe_bsdf_from_smooth_dielectric(lobe_smooth_dielectric_make(INFINITY)),
		lobe_bsdf_from_thin_dielectric(lobe_thin_dielectric_make(nan)),
		lobe_bsdf_from_thin_dielectric(lobe_thin_dielectric_make(INFINITY)),
		lobe_bsdf_from_iridescent_conductor(lobe_iridescent_conductor_make(0.5f, 0.5f, nan, 1.5f, n, k)),
		lobe_bsdf_from_iridescent_conductor(lobe_iridescent_conductor_make(0.5f, 0.5f, 300.0f, nan, n, k)),
		lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.5f, 0.5f, nan, 1.3f, 1.5f)),
		lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.5f, 0.5f, INFINITY, 1.3f, 1.5f)),
		lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.5f, 0.5f, 300.0f, nan, 1.5f)),
		lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.5f, 0.5f, 300.0f, 1.3f, nan)),
	};
	unsigned not_zero = 0;
	for (size_t i = 0; i < sizeof b / sizeof *b; i++)
		for (int channel = 0; channel < 3; channel++) {
			const double sum = carries(&b[i], channel, 61000u);
			if (sum != 0.0 && not_zero++ < 10)
				printf("  argument list %zu, channel %d: %g, expected 0\n", i, channel, sum);
		}
	TEST_ASSERT_EQUAL_UINT(0, not_zero);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_fields_that_are_no_numbers);
	RUN_TEST(test_arguments_that_are_no_numbers);
	return UNITY_END() != 0;
}
