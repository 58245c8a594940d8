/* test_masking_rational.c - LOBE_MASKING_SMITH_RATIONAL of distributions whose width is part of their shape: masked as the
 * Beckmann surface that they are like, and not as one of width 1. */
#include <math.h>

#include "lobe/lobe.h"
#include "measured.h"
#include "unity.h"

static float table[LOBE_PROFILE_WORDS];

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_EQUAL_STRING("", measured_outside()); }

/* How far G1 is from Smith's own of the distribution at most. */
static double worst_g1(lobe_distribution d, float alpha)
{
	const lobe_microsurface smith = lobe_microsurface_make(d, lobe_linear_stretch(alpha, 0.7f * alpha));
	const lobe_microsurface rational = lobe_microsurface_masking(smith, LOBE_MASKING_SMITH_RATIONAL);
	double worst = 0.0;
	for (int i = 1; i < 100; i++) {
		const float z = 0.01f * (float)i, s = sqrtf(1.0f - z * z);
		const lobe_seen a = lobe_see(smith, lobe_vec3_make(0.6f * s, 0.8f * s, z), 1.0f);
		const lobe_seen b = lobe_see(rational, lobe_vec3_make(0.6f * s, 0.8f * s, z), 1.0f);
		const double exact = (double)a.z / ((double)a.z + (double)a.hides);
		worst = larger(worst, fabs((double)b.z / ((double)b.z + (double)b.hides) - exact));
	}
	return worst;
}

/* Beckmann: the fit's own error. Phong: what phong.h states of the fit, .047 at exponent 5 and less beyond. GTR of gamma 2 is GGX, whose masking is
 * another's: the surface of width .05 is nearly unmasked by either, which one of width 1 would not be (.33 off). */
static void test_masks_by_the_width(void)
{
	lobe_distribution d;
	measured("Beckmann", worst_g1(lobe_distribution_make(LOBE_NDF_BECKMANN), 0.5f), 0.0032);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_phong(&d, table, LOBE_PROFILE_WORDS, 1000.0f));
	measured("Phong, exponent 1000", worst_g1(d, 1.0f), 0.0032);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_phong(&d, table, LOBE_PROFILE_WORDS, 10.0f));
	measured("Phong, exponent 10", worst_g1(d, 1.0f), 0.047);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_gtr(&d, table, LOBE_PROFILE_WORDS, 2.0f, 0.05f));
	measured("GTR, gamma 2, alpha .05", worst_g1(d, 1.0f), 0.25);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_masks_by_the_width);
	return UNITY_END();
}
