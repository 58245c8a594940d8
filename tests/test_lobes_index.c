/* test_lobes_index.c - what happens as the index of refraction goes to 1: an interface between equal media is none. */
#include "cases.h"
#include "directions.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

static void test_index_1_passes_light_straight_through(void)
{
	static const float corner[] = {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f};
	unsigned long n = 0;
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		/* A pane has the same medium on both sides whatever it is made of. */
		const int is_pane = c->kind == LOBE_KIND_THIN_DIELECTRIC && c->parameter[0] != 1.0;
		if (!(c->flags & CASE_TRANSMITS) || c->eta != 1.0 || is_pane)
			continue;
		for (size_t k = 0; k < case_wo_count(c); k++)
			for (uint32_t j = 0; j < 5000u; j++, n++) {
				float u[3], w[3];
				const lobe_vec3 wo = case_wo(k);
				test_u3(300u + (uint32_t)k, j, u);
				if (j < 64u)
					for (int m = 0; m < 3; m++)
						u[m] = corner[j >> 2 * m & 3u];
				const lobe_sample s = lobe_bsdf_sample(c->bsdf, wo, lobe_vec3_make(u[0], u[1], u[2]));
				TEST_ASSERT_EQUAL_UINT(LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA, s.event);
				TEST_ASSERT_TRUE(s.wi.x == -wo.x && s.wi.y == -wo.y && s.wi.z == -wo.z);
				TEST_ASSERT_TRUE(s.weight.r == 1.0f && s.weight.g == 1.0f && s.weight.b == 1.0f);
				TEST_ASSERT_TRUE(fabs((double)s.pdf - 1.0) <= 4 * 0x1p-24);
				test_direction(301u, j, w);
				const lobe_vec3 wi = lobe_vec3_make(w[0], w[1], w[2]);
				TEST_ASSERT_TRUE(lobe_bsdf_eval(c->bsdf, wo, wi).r == 0.0f);
				TEST_ASSERT_TRUE(lobe_bsdf_pdf(c->bsdf, wo, wi) == 0.0f);
			}
	}
	printf("  eta 1: %lu samples go straight through with weight 1\n", n);
	TEST_ASSERT_GREATER_THAN(100000, n);
}

typedef struct {
	double energy, reflected, rejected;
	int delta;
} share;

static share shares(double alpha, double eta, double mu, uint32_t stream)
{
	const uint32_t n = 20000u;
	const lobe_ggx_dielectric p = lobe_ggx_dielectric_transport(
		lobe_ggx_dielectric_make((lobe_real)alpha, (lobe_real)alpha, (lobe_real)eta),
		LOBE_TRANSPORT_IMPORTANCE);
	const lobe_vec3 wo = direction_at(mu, 0.5);
	share r = {0.0, 0.0, 0.0, p.delta != 0u};
	for (uint32_t i = 0; i < n; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_sample s = lobe_ggx_dielectric_sample(p, wo, lobe_vec3_make(u[0], u[1], u[2]));
		r.energy += (double)s.weight.g / n;
		r.reflected += (s.event & LOBE_EVENT_REFLECT ? (double)s.weight.g : 0.0) / n;
		r.rejected += (s.event == 0u ? 1.0 : 0.0) / n;
	}
	return r;
}

/* Reflected, transmitted and lost energy as eta goes to 1 from both sides. A delta refraction (printed with d) is not
 * masked and loses nothing. Any other is masked by G1(o) G1(i), whose loss is that of single scattering and does not
 * vanish with |eta - 1|: as i goes to -o what is left goes to G1(o). So the bound asserted is G1(o), less the 2 % that
 * Fresnel and the turning of light take at 1e-3 and cos .2; the step to 1 where delta begins is printed. */
static void test_energy_near_index_1_stays_above_g1(void)
{
	static const double alphas[] = {1e-3, 0.05, 0.1, 0.3, 0.5, 1.0};
	static const double mus[] = {0.9, 0.5, 0.2};
	static const double offs[] = {-1e-3, -1e-4, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 1e-4, 1e-3};
	double step_smooth = 0.0, step_rough = 0.0, rejected = 0.0, below_g1 = 0.0;
	printf("  energy reflected + transmitted at eta = 1 +...   (d: refraction is a delta event)\n  alpha  cos ");
	for (size_t k = 0; k < 9; k++)
		printf("  %8.0e", offs[k]);
	printf("   G1(o)\n");
	for (size_t a = 0; a < sizeof alphas / sizeof *alphas; a++)
		for (size_t m = 0; m < sizeof mus / sizeof *mus; m++) {
			const double o[3] = {sqrt(1.0 - mus[m] * mus[m]), 0.0, mus[m]};
			const double g1 = 1.0 / (1.0 + textbook_ggx_lambda(alphas[a], alphas[a], o));
			printf("  %5.3f %4.2f ", alphas[a], mus[m]);
			for (size_t k = 0; k < 9; k++) {
				const share s = shares(alphas[a], 1.0 + offs[k], mus[m], 400u);
				printf("  %.5f%s", s.energy, s.delta ? "d" : " ");
				rejected = fmax(rejected, s.rejected);
				step_rough = fmax(step_rough, 1.0 - s.energy);
				if (alphas[a] <= 0.1)
					step_smooth = fmax(step_smooth, 1.0 - s.energy);
				if (s.delta)
					TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0, s.energy);
				below_g1 = fmax(below_g1, g1 - s.energy);
				TEST_ASSERT_TRUE(s.energy <= 1.0 + 1e-6);
			}
			printf("  %.5f\n", g1);
		}
	printf("  rejected at most %.5f; energy lost at most %.4f up to alpha .1, %.4f at any alpha; below G1(o) by "
	       "%.4f\n",
	       rejected, step_smooth, step_rough, below_g1);
	TEST_ASSERT_TRUE(rejected < 0.01);
	TEST_ASSERT_TRUE(below_g1 < 0.02);
	TEST_ASSERT_TRUE(step_smooth < 0.07);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_index_1_passes_light_straight_through);
	RUN_TEST(test_energy_near_index_1_stays_above_g1);
	return UNITY_END() != 0;
}
