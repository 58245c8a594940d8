/* test_smith_leadr.c - microfacet/smith.h under every linear map against LEADR's formulas (leadr.c): D, projected area
 * and masking at random. (Integrals: test_smith_integrals.c. Beyond the domain: test_smith_extremes.c.) */
#include "lobe/microfacet/smith.h"

#include "directions.h"
#include "leadr_surfaces.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static void test_d(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double worst = 0.0;
		for (uint64_t i = 0; i < 200000; i++) {
			const leadr s = random_surface(4, i, (leadr_kind)kind_of(n));
			const lobe_smith m = surface_of(&s, n);
			/* A facet within 8 widths of the mean (4 where exp takes over). */
			const double r = (s.kind == LEADR_GGX ? 8.0 : 4.0) * uniform(5, 2 * i),
				     phi = TWO_PI * uniform(5, 2 * i + 1);
			const double x = r * cos(phi), y = r * sin(phi);
			double h[3] = {-(s.ax * x + s.tx), -(s.ay * (s.rho * x + sqrt(1.0 - s.rho * s.rho) * y) + s.ty),
				       1.0};
			const double len = sqrt(h[0] * h[0] + h[1] * h[1] + 1.0);
			for (int k = 0; k < 3; k++)
				h[k] = single(h[k] / len);
			const double exact = leadr_d(&s, h), got = (double)lobe_smith_d(m, rounded(h));
			/* Rounding of a tilted normal may throw its facet far out of these 8 widths. */
			if (exact > 1e-37 && exact < 1e37 && exact * s.ax * s.ay > 1e-12)
				worst = worse(worst,
					      fabs(got / exact - 1.0) / leadr_condition(&s) / leadr_steepness(&s, h));
		}
		char what[80];
		snprintf(what, sizeof what, "%s: D, relative error over condition(A)%s", fixed[n].name,
			 kind_of(n) == LEADR_GGX ? "" : " (1 + r^2)");
		measured(what, worst, 6e-7);
	}
}

/* sigma relative to what does not cancel: v.z is a difference when the view is along the mean plane, v.x and v.y are
 * when the view is along a narrow axis. Far below Beckmann's horizon sigma falls as exp(-cot^2), and errors grow with
 * cot^2. */
static void test_sigma(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double worst = 0.0;
		unsigned away = 0;
		for (uint64_t i = 0; i < 200000; i++) {
			const leadr s = random_surface(6, i, (leadr_kind)kind_of(n));
			float w[3];
			double k[3], v[3];
			test_direction(7, i, w);
			for (int c = 0; c < 3; c++)
				k[c] = (double)w[c];
			leadr_direction(&s, k, v);
			const double exact = leadr_sigma(&s, k), across = hypot(v[0], v[1]);
			const double got = (double)lobe_smith_sigma(surface_of(&s, n), rounded(k));
			const double cancels = (s.ax * fabs(k[0]) + s.ay * fabs(k[1])) / across;
			const double cot2 =
				s.kind == LEADR_BECKMANN && v[2] < 0.0 ? v[2] * v[2] / (across * across) : 0.0;
			away += k[2] > 0.0 && v[2] < 0.0;
			if (exact > 1e-30 && cot2 < 20.0)
				worst = worse(worst, fabs(got - exact) / (exact * cancels * (1.0 + cot2) +
									  fabs(k[0] * s.tx) + fabs(k[1] * s.ty)));
		}
		char what[80];
		snprintf(what, sizeof what, "%s: sigma, error in U of its terms", fixed[n].name);
		measured(what, worst / U, 12.0);
		printf("  %-60s %11u\n", "  directions above the horizon that the mean plane faces away from", away);
		TEST_ASSERT_TRUE(away > 10000u);
	}
}

static void test_masking(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double g1 = 0.0, g2 = 0.0;
		for (uint64_t i = 0; i < 50000; i++) {
			leadr s = random_surface(8, i, (leadr_kind)kind_of(n));
			s.tx = s.tx > 0.0 ? s.tx / 100.0 : 0.0; /* to 1: else the plane seldom faces both */
			s.ty /= 100.0;
			s = as_floats(s);
			const lobe_smith m = surface_of(&s, n);
			float o[3], w[3];
			double ko[3], ki[3], vo[3], vi[3];
			test_direction(9, 2 * i, o);
			test_direction(9, 2 * i + 1, w);
			for (int c = 0; c < 3; c++) {
				ko[c] = (double)o[c];
				ki[c] = (double)w[c];
			}
			leadr_direction(&s, ko, vo);
			leadr_direction(&s, ki, vi);
			const double got1 = (double)lobe_smith_g1(m, rounded(ko));
			const double got2 = (double)lobe_smith_g2(m, rounded(ko), rounded(ki));
			TEST_ASSERT_TRUE(vo[2] > 1e-6 || got1 < 0.01 || s.ax < 0.01 || s.ay < 0.01);
			if (vo[2] > 0.01)
				g1 = worse(g1, fabs(got1 * (1.0 + leadr_lambda(s.kind, vo)) - 1.0));
			if (vo[2] > 0.01 && vi[2] > 0.01)
				g2 = worse(g2, fabs(got2 * (1.0 + leadr_lambda(s.kind, vo) + leadr_lambda(s.kind, vi)) -
						    1.0));
			TEST_ASSERT_TRUE(got2 == 0.0 || (vo[2] > -1e-6 && vi[2] > -1e-6));
		}
		char what[80];
		/* v.z, a difference of terms to 1, is above 0.01. */
		snprintf(what, sizeof what, "%s: G1 against 1/(1 + Lambda(M^-1 w))", fixed[n].name);
		measured(what, g1, 1e-5);
		snprintf(what, sizeof what, "%s: G2 against 1/(1 + Lambda_o + Lambda_i)", fixed[n].name);
		measured(what, g2, 2e-5);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_d);
	RUN_TEST(test_sigma);
	RUN_TEST(test_masking);
	return UNITY_END() != 0;
}
