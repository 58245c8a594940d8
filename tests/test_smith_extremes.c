/* test_smith_extremes.c - microfacet/smith.h with whatever parameters, directions and random numbers: results are
 * finite and not negative, and in the domain there is a normal to see. */
#include "lobe/microfacet/smith.h"

#include "leadr_surfaces.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

/* Whatever the parameters: finite and not negative; in the domain there is a normal to see wherever facets face w. */
static void extremes_of(lobe_smith s, lobe_vec3 o, lobe_vec2 u, int in_domain)
{
	const lobe_vec3 m = lobe_smith_visible(s, o, u);
	const float out[] = {lobe_smith_d(s, o),
			     lobe_smith_p22(s, o.x, o.y),
			     lobe_smith_sigma(s, o),
			     lobe_smith_g1(s, o),
			     lobe_smith_g2(s, o, o),
			     lobe_smith_visible_pdf(s, o, m),
			     m.z,
			     m.x * m.x,
			     m.y * m.y};
	for (size_t i = 0; i < sizeof out / sizeof out[0]; i++)
		TEST_ASSERT_TRUE(out[i] >= 0.0f && out[i] <= LOBE_REAL_MAX);
	const float len2 = lobe_dot(m, m);
	TEST_ASSERT_TRUE(in_domain ? fabsf(len2 - 1.0f) < 1e-6f : len2 == 0.0f || fabsf(len2 - 1.0f) < 1e-6f);
}

static void test_extremes(void)
{
	const float widths[] = {0.0f, 1e-4f, 1.0f, 100.0f, -1.0f, 1e30f, NAN, INFINITY};
	const float tilts[][2] = {{0, 0}, {100, -100}, {-1, 0.5f}, {1e-4f, 0}, {1e30f, 0}, {NAN, 0}, {0, INFINITY}};
	const float u[] = {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f};
	const float ws[][3] = {{0, 0, 1},         {1, 0, 0}, {-1, 0, 0},        {0.6f, 0, 0.8f}, {0, 1, 1e-6f},
			       {-0.6f, 0, -0.8f}, {0, 0, 0}, {NAN, 0.5f, 0.5f}, {0, 0, -1}};
	unsigned count = 0, regular = 0;
	for (size_t i = 0; i < FIXED * 8 * 8 * 7 * 9 * 16; i++) {
		const size_t n = i % FIXED, a = i / FIXED % 8, b = i / FIXED / 8 % 8, t = i / FIXED / 64 % 7;
		const size_t w = i / FIXED / 64 / 7 % 9, k = i / FIXED / 64 / 7 / 9;
		const lobe_linear map = lobe_linear_tilted(
			lobe_linear_correlated(widths[a], widths[b], (float)rhos[(a + b + t + w + k) % 8]), tilts[t][0],
			tilts[t][1]);
		const int in_domain = kind_of(n) == LEADR_GGX && a < 5 && b < 5 && t < 4 && w < 6;
		extremes_of(lobe_smith_make(lobe_distribution_make(fixed[n].ndf), map),
			    lobe_vec3_make(ws[w][0], ws[w][1], ws[w][2]), lobe_vec2_make(u[k / 4], u[k % 4]),
			    in_domain);
		count++;
		regular += (unsigned)in_domain;
	}
	printf("  %u combinations, %u of them in the domain\n", count, regular);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_extremes);
	return UNITY_END() != 0;
}
