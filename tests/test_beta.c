/* test_beta.c - core/beta.h against GSL. */
#include "lobe/core/beta.h"

#include "measured.h"
#include "unity.h"

#include <gsl/gsl_sf_gamma.h>
#include <math.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static void test_beta(void)
{
	double worst = 0.0, worst_scaled = 0.0;
	for (int i = 0; i <= 120; i++)
		for (int k = 0; k <= 120; k++) {
			const double a = (double)(float)(1.0 + (i ? pow(10.0, -4.0 + i * 0.1) : 0.0));
			const double b = (double)(float)(1.0 + (k ? pow(10.0, -4.0 + k * 0.1) : 0.0));
			const double exact = gsl_sf_lnbeta(a, b);
			if (exact < -85.0)
				continue;
			const double off = fabs((double)lobe_beta((float)a, (float)b) / exp(exact) - 1.0);
			worst = exact > -7.0 ? larger(worst, off) : worst;
			worst_scaled = larger(worst_scaled, off / (1.0 + fabs(exact)));
		}
	measured("B(a, b) against GSL where above 1e-3, relative", worst, 1.2e-6);
	measured("B(a, b), relative over 1 + |ln B|", worst_scaled, 2.3e-7);
	TEST_ASSERT_EQUAL_FLOAT(0.0f, lobe_beta(0x1p60f, 0x1p60f));
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_beta);
	return UNITY_END();
}
