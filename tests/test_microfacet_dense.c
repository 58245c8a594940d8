/* test_microfacet_dense.c - microfacet_dielectric from within very dense glass, where light leaves in a cone so narrow that
 * the cosine to its axis has no digits left, against the double build. */
#include <math.h>
#include <stdlib.h>

#include "cases.h"
#include "double.h"
#include "lobe/shading.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_EQUAL_STRING("", measured_outside()); }

enum { DRAWS = 5000 };

/* Of ggx_dielectric, all of which the double build reads: its transport too. */
static const double glass[CASE_PARAMETERS] = {5e-4, 5e-4, 1000.0};

static lobe_microfacet_dielectric any_glass(void)
{
	const lobe_linear map = lobe_linear_stretch((float)glass[0], (float)glass[1]);
	return lobe_microfacet_dielectric_make(lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), map),
					       lobe_fresnel_model_dielectric(), (float)glass[2], LOBE_STRATEGY_VISIBLE);
}

static int by_value(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Every direction above has a facet of the cone. */
static void test_refraction_from_within(void)
{
	const lobe_microfacet_dielectric p = any_glass();
	const double o[3] = {0.0, 0.0, -1.0};
	static double error[DRAWS];
	size_t count = 0;
	for (uint64_t i = 0; i < DRAWS; i++) {
		float w[3];
		double f[3];
		test_direction(77, i, w);
		w[2] = fabsf(w[2]);
		const double in[3] = {(double)w[0], (double)w[1], (double)w[2]};
		double_eval(LOBE_KIND_GGX_DIELECTRIC, glass, o, in, f);
		const lobe_rgb got = lobe_microfacet_dielectric_eval(p, lobe_vec3_make(0.0f, 0.0f, -1.0f),
								     lobe_vec3_make(w[0], w[1], w[2]));
		if (w[2] > 1e-3f)
			error[count++] = fabs((double)got.r / f[0] - 1.0);
	}
	qsort(error, count, sizeof *error, by_value);
	measured("relative error of eval, 99 in 100", error[count * 99 / 100], 1e-6);
	measured("relative error of eval, largest", error[count - 1], 2e-6);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_refraction_from_within);
	return UNITY_END();
}
