/* test_iridescent.c - the lobes with a film: those without where it has no thickness; what it passes, and what it
 * reflects from within. */
#include "lobe/shading.h"

#include "film_cases.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* At thickness 0 the lobes are those without a film. */
static void test_lobes_without_film(void)
{
	const lobe_rgb n = lobe_metal_eta(LOBE_METAL_COPPER), k = lobe_metal_k(LOBE_METAL_COPPER);
	const lobe_iridescent_conductor a = lobe_iridescent_conductor_make(0.3f, 0.2f, 0.0f, 1.5f, n, k);
	const lobe_ggx_conductor b = lobe_ggx_conductor_make(0.3f, 0.2f, n, k);
	double metal = 0.0, glass = 0.0;
	for (uint32_t i = 0; i < 40000u; i++) {
		float o[3], w[3];
		test_direction(30, i, o);
		test_direction(31, i, w);
		if (fabsf(o[2]) < 0.05f || fabsf(w[2]) < 0.05f)
			continue;
		const float eta = i & 1u ? 1.5f : 0.7f;
		const lobe_vec3 wo = lobe_vec3_make(o[0], o[1], o[2]), wi = lobe_vec3_make(w[0], w[1], w[2]);
		const double fa = (double)lobe_iridescent_conductor_eval(a, wo, wi).r;
		const double fb = (double)lobe_ggx_conductor_eval(b, wo, wi).r;
		if (fb > 0.0)
			metal = larger(metal, fabs(fa - fb) / fb);
		const double ga = (double)lobe_iridescent_dielectric_eval(
					  lobe_iridescent_dielectric_make(0.4f, 0.3f, 0.0f, 1.4f, eta), wo, wi)
					  .g;
		const double gb = (double)lobe_ggx_dielectric_eval(lobe_ggx_dielectric_make(0.4f, 0.3f, eta), wo, wi).g;
		if (gb > 0.0)
			glass = larger(glass, fabs(ga - gb) / gb);
	}
	measured("iridescent_conductor at 0 nm - ggx_conductor, relative", metal, 40.0 * U);
	measured("iridescent_dielectric at 0 nm - ggx_dielectric, relative", glass, 40.0 * U);
}

/* eta = 1: what a film passes goes straight on, with the film's probability and colour. */
static void test_soap_film(void)
{
	const lobe_iridescent_dielectric p = lobe_iridescent_dielectric_make(0.1f, 0.1f, 350.0f, 1.33f, 1.0f);
	const float s = sqrtf(1.0f - 0.6f * 0.6f);
	const lobe_vec3 wo = lobe_vec3_make(s, 0.0f, 0.6f);
	const lobe_film_fresnel f = lobe_thin_film_dielectric_rgb(0.6f, p.film, 1.0f);
	double through = 0.0, weight[3] = {0};
	const uint32_t n = 20000u;
	for (uint32_t i = 0; i < n; i++) {
		float u[3];
		test_u3(40, i, u);
		const lobe_sample r = lobe_iridescent_dielectric_sample(p, wo, lobe_vec3_make(u[0], u[1], u[2]));
		if (!(r.event & LOBE_EVENT_TRANSMIT))
			continue;
		TEST_ASSERT_EQUAL_UINT(LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA, r.event);
		TEST_ASSERT_TRUE(r.wi.x == -wo.x && r.wi.y == -wo.y && r.wi.z == -wo.z);
		through += 1.0 / n;
		for (int k = 0; k < 3; k++)
			weight[k] += channel(r.weight, k) / n;
	}
	/* Facets of alpha .1 see the film at angles around wo's. */
	TEST_ASSERT_DOUBLE_WITHIN(0.02, (double)f.mean_transmittance, through);
	for (int k = 0; k < 3; k++)
		TEST_ASSERT_DOUBLE_WITHIN(0.02, channel(f.transmittance, k), weight[k]);
}

/* Beyond the critical angle all is reflected, white, whatever the film; before it the colours of both events complement
 * each other. */
static void test_from_within_glass(void)
{
	const lobe_iridescent_dielectric p = lobe_iridescent_dielectric_make(1e-3f, 1e-3f, 300.0f, 1.38f, 1.5f);
	for (uint32_t i = 0; i < 2000u; i++) {
		const float z = i & 1u ? 0.7f * test_uniform(41, i) + 0.02f : 0.8f + 0.2f * test_uniform(41, i);
		const lobe_vec3 wo = lobe_vec3_make(0.0f, sqrtf(1.0f - z * z), -z);
		const lobe_sample r = lobe_iridescent_dielectric_sample(p, wo, lobe_vec3_make(0.5f, 0.5f, 0.0f));
		const lobe_sample t =
			lobe_iridescent_dielectric_sample(p, wo, lobe_vec3_make(0.5f, 0.5f, 0x1.fffffep-1f));
		TEST_ASSERT_TRUE((r.event & LOBE_EVENT_REFLECT) != 0u);
		if (i & 1u) {
			TEST_ASSERT_TRUE((t.event & LOBE_EVENT_REFLECT) != 0u);
			TEST_ASSERT_TRUE(t.weight.r == t.weight.g && t.weight.g == t.weight.b && t.weight.r > 0.9f);
		} else {
			TEST_ASSERT_TRUE((t.event & LOBE_EVENT_TRANSMIT) != 0u);
			TEST_ASSERT_TRUE((r.weight.r > r.weight.b) == (t.weight.r < t.weight.b));
		}
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_lobes_without_film);
	RUN_TEST(test_soap_film);
	RUN_TEST(test_from_within_glass);
	return UNITY_END();
}
