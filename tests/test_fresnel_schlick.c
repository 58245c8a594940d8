/* test_fresnel_schlick.c - core/fresnel_schlick.h and core/fresnel_artist.h against the exact reflectances that they
 * stand for (textbook.c) and against their definitions in double. */
#include "lobe/core/fresnel.h"
#include "lobe/core/fresnel_artist.h"
#include "lobe/core/fresnel_schlick.h"
#include "lobe/core/optics.h"

#include "fresnel_exact.h"
#include "measured.h"
#include "support.h"
#include "textbook.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double power(double x, int n)
{
	double p = 1.0;
	for (int i = 0; i < n; i++)
		p *= x;
	return p;
}

/* f0 + (1 - f0)(1 - c)^5 and the dip on top of it, as the papers print them. */
static double schlick(double c, double f0) { return f0 + (1.0 - f0) * power(1.0 - c, 5); }

/* Kutz et al. 2021: b is such that the value at c = 1/7 is tint times Schlick's. */
static double f82_tint(double c, double f0, double tint)
{
	const double b = schlick(1.0 / 7.0, f0) * (1.0 - tint) * 7.0 / power(6.0 / 7.0, 6);
	return fmin(fmax(schlick(c, f0) - b * c * power(1.0 - c, 6), 0.0), 1.0);
}

/* --- how far from the exact ones ---------------------------------------------------------------------------------- */

static double schlick_distance(double eta)
{
	const double root = (eta - 1.0) / (eta + 1.0);
	double most = 0.0;
	for (int i = 0; i <= 20000; i++) {
		const double c = (double)(float)(i * 5e-5);
		most = larger(most, fabs((double)lobe_fresnel_schlick((float)c, (float)(root * root)) -
					 textbook_fresnel(fmax(c, 1e-12), eta)));
	}
	return most;
}

/* Published distances, each to its last digit. */
static void test_schlick_table(void)
{
	static const double table[][3] = {{1.1, .210, 1e-3},  {1.2, .113, 1e-3},  {1.33, .060, 1e-3},
					  {1.4, .046, 1e-3},  {1.5, .0357, 1e-4}, {1.6, .0319, 1e-4},
					  {1.8, .0345, 1e-4}, {2, .0444, 1e-4},   {2.42, .0757, 1e-4},
					  {3, .125, 1e-3},    {4, .201, 1e-3}};
	for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
		char what[80];
		const double d = schlick_distance(table[i][0]);
		snprintf(what, sizeof what, "Schlick, index %g: %.5f, published %g, off by", table[i][0], d,
			 table[i][1]);
		measured(what, fabs(d - table[i][1]), 0.5 * table[i][2]);
	}
}

static void check_schlick(float eta, double expected, double digit)
{
	const float root = (eta - 1.0f) / (eta + 1.0f);
	worst w = {0};
	for (int i = 0; i <= 100000; i++) {
		const float c = (float)i * 1e-5f;
		const double error =
			fabs((double)lobe_fresnel_schlick(c, root * root) - exact_dielectric(c, eta).reflectance);
		keep_worst(&w, error, c, eta);
	}
	char what[80];
	snprintf(what, sizeof what, "Schlick: largest error %.5f (published %g), off by", w.value, expected);
	w.value = fabs(w.value - expected);
	/* Half of the last digit that was published. */
	measured_at(what, w, 0.5 * digit);
}

static void test_schlick(void)
{
	check_schlick(1.33f, 0.060, 0.001);
	check_schlick(1.5f, 0.0357, 0.0001);
	check_schlick(4.0f, 0.201, 0.001);
	TEST_ASSERT_TRUE(lobe_fresnel_schlick(1.0f, 0.04f) == 0.04f);
	TEST_ASSERT_TRUE(lobe_fresnel_schlick(0.0f, 0.04f) == 1.0f);
	const lobe_rgb f = lobe_fresnel_schlick_rgb(0.5f, lobe_rgb_make(0.0f, 0.5f, 1.0f));
	TEST_ASSERT_TRUE(f.r == 0.03125f && f.g == 0.515625f && f.b == 1.0f);
}

/* Metal m, channel ch: largest distance of Schlick and of F82 (fitted at 1/7, as users do) from the exact conductor. */
static void metal_distance(uint32_t m, int ch, double *plain, double *dipped)
{
	const lobe_rgb eta = lobe_metal_eta(m), kappa = lobe_metal_k(m);
	const float n = ch == 0 ? eta.r : ch == 1 ? eta.g : eta.b, k = ch == 0 ? kappa.r : ch == 1 ? kappa.g : kappa.b;
	const float f0 = (float)textbook_fresnel_conductor(1.0, (double)n, (double)k);
	const float f82 = (float)textbook_fresnel_conductor(1.0 / 7.0, (double)n, (double)k);
	const float depth = lobe_fresnel_f82_depth_from_value(f0, f82);
	*plain = *dipped = 0.0;
	for (int i = 0; i <= 2000; i++) {
		const float c = (float)i / 2000.0f;
		const double exact = textbook_fresnel_conductor((double)c, (double)n, (double)k);
		*plain = larger(*plain, fabs((double)lobe_fresnel_schlick(c, f0) - exact));
		*dipped = larger(*dipped, fabs((double)lobe_fresnel_f82(c, f0, depth) - exact));
	}
}

/* Published distances at 650 nm, each to its last digit. */
static void test_f82_table(void)
{
	static const struct {
		const char *name;
		uint32_t metal;
		double plain, dipped;
	} table[] = {
		{"aluminium", LOBE_METAL_ALUMINIUM, .117, .017}, {"gold", LOBE_METAL_GOLD, .017, .005},
		{"chromium", LOBE_METAL_CHROMIUM, .194, .022},   {"titanium", LOBE_METAL_TITANIUM, .185, .016},
		{"iron", LOBE_METAL_IRON, .177, .018},
	};
	for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
		double plain, dipped;
		char what[96];
		metal_distance(table[i].metal, 0, &plain, &dipped);
		snprintf(what, sizeof what, "%s: Schlick %.4f (published %.3f), off by", table[i].name, plain,
			 table[i].plain);
		measured(what, fabs(plain - table[i].plain), 0.001);
		snprintf(what, sizeof what, "%s: F82 %.4f (published %.3f), off by", table[i].name, dipped,
			 table[i].dipped);
		measured(what, fabs(dipped - table[i].dipped), 0.001);
	}
	double worst_plain = 0.0, worst_dipped = 0.0;
	for (uint32_t m = 0; m < LOBE_METAL_COUNT; m++)
		for (int ch = 0; ch < 3; ch++) {
			double plain, dipped;
			metal_distance(m, ch, &plain, &dipped);
			worst_plain = larger(worst_plain, plain);
			worst_dipped = larger(worst_dipped, dipped);
		}
	measured("every metal of optics.def, every channel: Schlick", worst_plain, 0.213);
	measured("every metal of optics.def, every channel: F82", worst_dipped, 0.033);
	/* The dip is what does it. */
	TEST_ASSERT_TRUE(worst_plain > 4.0 * worst_dipped);
}

/* --- definitions -------------------------------------------------------------------------------------------------- */

/* Roundings of a sum of at most three terms of size up to 1 and of a power of 1 - c: 16 U, absolute. */
static void test_curves_are_their_definitions(void)
{
	double f90 = 0.0, f82 = 0.0, value = 0.0, hoffman = 0.0, general = 0.0;
	unsigned outside = 0, f0_moves = 0, not_constant = 0, not_end = 0;
	for (uint32_t i = 0; i < 200000u; i++) {
		const float c = i % 16 ? test_uniform(1, i) : (float)(i / 16 % 2), f0 = test_uniform(2, i);
		const float end = test_uniform(3, i), e = 0.5f + 9.5f * test_uniform(4, i), tint = test_uniform(5, i);
		const double m = 1.0 - (double)c, d0 = (double)f0, d90 = (double)end, dt = (double)tint;
		const float got[5] = {lobe_fresnel_schlick_f90(c, f0, end),
				      lobe_fresnel_f82(c, f0, lobe_fresnel_f82_depth(f0, tint)),
				      lobe_fresnel_f82(c, f0, lobe_fresnel_f82_depth_from_value(f0, tint)),
				      lobe_fresnel_hoffman(c, f0, end, e, lobe_fresnel_hoffman_depth(f0, end, e, tint)),
				      lobe_fresnel_schlick_power(c, f0, end, e)};
		f90 = larger(f90, fabs((double)got[0] - (d0 + (d90 - d0) * power(m, 5))));
		f82 = larger(f82, fabs((double)got[1] - f82_tint((double)c, d0, dt)));
		value = larger(value, fabs((double)got[2] - f82_tint((double)c, d0, dt / schlick(1.0 / 7.0, d0))));
		const double p = pow(6.0 / 7.0, (double)e), curve = d0 + (d90 - d0) * pow(m, (double)e);
		const double b = (d0 + (d90 - d0) * p) * (1.0 - dt) * 7.0 / power(6.0 / 7.0, 6);
		hoffman = larger(hoffman,
				 fabs((double)got[3] - fmin(fmax(curve - b * (double)c * power(m, 6), 0.0), 1.0)));
		general = larger(general, fabs((double)got[4] - curve));
		for (int k = 0; k < 5; k++)
			outside += !(got[k] >= 0.0f && got[k] <= 1.0f);
		not_constant += lobe_fresnel_schlick_f90(c, f0, f0) != f0;
		not_end += lobe_fresnel_schlick_f90(c, f0, 1.0f) != lobe_fresnel_schlick(c, f0);
		f0_moves += lobe_fresnel_schlick_f90(1.0f, f0, end) != f0 ||
			    lobe_fresnel_schlick_power(1.0f, f0, end, e) != f0 ||
			    lobe_fresnel_f82(1.0f, f0, lobe_fresnel_f82_depth(f0, tint)) != f0 ||
			    lobe_fresnel_hoffman(1.0f, f0, end, e, lobe_fresnel_hoffman_depth(f0, end, e, tint)) != f0;
	}
	measured("schlick_f90: absolute", f90, 16.0 * U);
	measured("schlick_power: absolute", general, 16.0 * U);
	measured("f82 from tint: absolute", f82, 16.0 * U);
	/* Above Schlick's curve the depth is up to 1, and so is its rounding. */
	measured("f82 from value: absolute", value, 16.0 * U);
	measured("hoffman: absolute", hoffman, 16.0 * U);
	measured("results outside of [0, 1]", outside, 0.0);
	measured("f0 not kept at normal incidence", f0_moves, 0.0);
	measured("f90 = f0 not constant", not_constant, 0.0);
	measured("f90 = 1 not Schlick to the bit", not_end, 0.0);
	/* The value is met where it was set, and another exponent of the dip would not. */
	const float f0 = 0.5f, seventh = 1.0f / 7.0f;
	TEST_ASSERT_TRUE(fabsf(lobe_fresnel_f82(seventh, f0, lobe_fresnel_f82_depth_from_value(f0, 0.4f)) - 0.4f) <
			 1e-6f);
	TEST_ASSERT_TRUE(fabs(f82_tint(0.3, 0.5, 0.8) - f82_tint(0.3, 0.5, 0.9)) > 1e-3);
}

static void test_rgb_forms_are_the_scalar_ones(void)
{
	unsigned differ = 0;
	for (uint32_t i = 0; i < 20000u; i++) {
		const float c = test_uniform(10, i), e = 1.0f + 8.0f * test_uniform(11, i);
		const lobe_rgb a = lobe_rgb_make(test_uniform(12, i), test_uniform(13, i), test_uniform(14, i));
		const lobe_rgb b = lobe_rgb_make(test_uniform(15, i), test_uniform(16, i), test_uniform(17, i));
		const lobe_rgb d = lobe_rgb_make(0.3f * test_uniform(18, i), 0.0f, 0.1f);
		const lobe_rgb s = lobe_fresnel_schlick_rgb(c, a), f = lobe_fresnel_schlick_f90_rgb(c, a, b);
		const lobe_rgb p = lobe_fresnel_schlick_power_rgb(c, a, b, e), t = lobe_fresnel_f82_rgb(c, a, d);
		const lobe_rgb h = lobe_fresnel_hoffman_rgb(c, a, b, e, d), k = lobe_fresnel_constant_rgb(c, a);
		differ += s.g != lobe_fresnel_schlick(c, a.g) || f.b != lobe_fresnel_schlick_f90(c, a.b, b.b) ||
			  p.r != lobe_fresnel_schlick_power(c, a.r, b.r, e) || t.r != lobe_fresnel_f82(c, a.r, d.r) ||
			  h.b != lobe_fresnel_hoffman(c, a.b, b.b, e, d.b) || k.g != a.g;
	}
	measured("rgb forms that differ from the scalar ones", differ, 0.0);
}

/* --- Gulbrandsen -------------------------------------------------------------------------------------------------- */

static double f0_of(double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); }

/* As the paper prints it, with digits to spare for the difference in k. */
static void printed(double r_in, double g_in, double *n, double *k)
{
	const long double r = (long double)r_in, g = (long double)g_in, s = sqrtl(r);
	const long double x = g * (1.0L - r) / (1.0L + r) + (1.0L - g) * (1.0L + s) / (1.0L - s);
	*n = (double)x;
	*k = (double)sqrtl(fmaxl(0.0L, (r * (x + 1.0L) * (x + 1.0L) - (x - 1.0L) * (x - 1.0L)) / (1.0L - r)));
}

static void test_artist_round_trip(void)
{
	double back = 0.0, lobe_back = 0.0, n_off = 0.0, k_off = 0.0;
	unsigned outside = 0;
	for (uint32_t i = 0; i < 200000u; i++) {
		float r = test_uniform(20, i), g = test_uniform(21, i);
		if (i % 4 == 0)
			r = 1.0f - powf(10.0f, -4.0f * r);
		if (i % 4 == 1)
			r = powf(10.0f, -7.0f * r);
		if (i % 16 < 2)
			g = (float)(i / 16 % 2);
		const lobe_fresnel_index m = lobe_fresnel_artist(r, g);
		const double held = (double)(r < LOBE_FRESNEL_ARTIST_MAX ? r : LOBE_FRESNEL_ARTIST_MAX);
		double n, k;
		printed(held, (double)g, &n, &k);
		outside += !(m.n >= 1e-3f && m.n <= 1000.0f && m.k >= 0.0f && m.k <= 1000.0f);
		back = larger(back, fabs(f0_of((double)m.n, (double)m.k) - held));
		lobe_back = larger(lobe_back, fabs((double)lobe_fresnel_conductor(1.0f, m.n, m.k) - held));
		n_off = larger(n_off, fabs((double)m.n - n) / n);
		if (g > 1e-5f && r > 1e-6f)
			k_off = larger(k_off, fabs((double)m.k - k) / k);
	}
	measured("artist: reflectance of n + ik - r", back, 12.0 * U);
	measured("artist: the same through lobe_fresnel_conductor", lobe_back, 24.0 * U);
	measured("artist: n relative to the paper's", n_off, 16.0 * U);
	measured("artist: k relative to the paper's", k_off, 16.0 * U);
	measured("artist: outside of the conductor's domain", outside, 0.0);
}

static void test_artist_edges(void)
{
	/* g = 0 is a dielectric of that reflectance; the greater g, the brighter 81.8 degrees. */
	for (int i = 1; i < 20; i++) {
		const float r = (float)i / 20.0f;
		TEST_ASSERT_TRUE(lobe_fresnel_artist(r, 0.0f).k == 0.0f);
		float before = 0.0f;
		for (int j = 0; j <= 10; j++) {
			const lobe_fresnel_index m = lobe_fresnel_artist(r, (float)j / 10.0f);
			const float edge = lobe_fresnel_conductor(0.14f, m.n, m.k);
			TEST_ASSERT_TRUE(edge >= before - 1e-6f);
			before = edge;
		}
	}
	const lobe_fresnel_index black = lobe_fresnel_artist(0.0f, 0.7f);
	TEST_ASSERT_TRUE(black.n == 1.0f && black.k == 0.0f);
	const lobe_fresnel_index nothing = lobe_fresnel_artist(NAN, 0.5f);
	TEST_ASSERT_TRUE(isnan(nothing.n) && isnan(nothing.k));
	const lobe_fresnel_index_rgb c =
		lobe_fresnel_artist_rgb(lobe_rgb_make(0.9f, 0.5f, 0.1f), lobe_rgb_make(0.1f, 0.5f, 0.9f));
	TEST_ASSERT_TRUE(c.eta.r == lobe_fresnel_artist(0.9f, 0.1f).n && c.k.b == lobe_fresnel_artist(0.1f, 0.9f).k);
}

/* The bound on k means something: as the paper prints it, in float, the difference cancels. */
static void test_artist_planted(void)
{
	double most = 0.0;
	for (uint32_t i = 0; i < 20000u; i++) {
		const float r = 0.5f + 0.4f * test_uniform(22, i), g = 0.01f + 0.01f * test_uniform(23, i),
			    s = sqrtf(r);
		const float x = g * (1.0f - r) / (1.0f + r) + (1.0f - g) * (1.0f + s) / (1.0f - s);
		const float k2 = (r * (x + 1.0f) * (x + 1.0f) - (x - 1.0f) * (x - 1.0f)) / (1.0f - r);
		double n, k;
		printed((double)r, (double)g, &n, &k);
		most = larger(most, fabs(sqrt(fmax(0.0, (double)k2)) - k) / k);
	}
	printf("  %-60s %11.4g\n", "artist as printed, in float: k relative", most);
	TEST_ASSERT_TRUE(most > 16.0 * U);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_schlick_table);
	RUN_TEST(test_schlick);
	RUN_TEST(test_f82_table);
	RUN_TEST(test_curves_are_their_definitions);
	RUN_TEST(test_rgb_forms_are_the_scalar_ones);
	RUN_TEST(test_artist_round_trip);
	RUN_TEST(test_artist_edges);
	RUN_TEST(test_artist_planted);
	return UNITY_END();
}
