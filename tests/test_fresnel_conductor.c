/* test_fresnel_conductor.c - the reflectance of conductors of core/fresnel.h against complex arithmetic, core/optics.h
 * and its names. */
#include "lobe/core/fresnel.h"
#include "lobe/optics_names.h"

#include "fresnel_exact.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- conductor ------------------------------------------------------------------------------------------------------ */

/* Textbook amplitudes in complex arithmetic. p = N cos_t; p^2 = N^2 - sin^2 is formed from n - 1 and c^2, which are
 * exact. */
static double exact_conductor(float c_in, float n_in, float k_in)
{
	const long double c = (long double)c_in, n = (long double)n_in, k = (long double)k_in;
	const long double re = (n - 1.0L) * (n + 1.0L) - k * k + c * c;
	const long double complex n2 = (n * n - k * k) + 2.0L * n * k * (long double complex)I;
	const long double complex p = csqrtl(re + 2.0L * n * k * (long double complex)I);
	const long double complex rs_den = c + p, rp_den = n2 * c + p;
	const long double rs = rs_den == 0.0L ? 0.0L : cabsl((c - p) / rs_den);
	const long double rp = rp_den == 0.0L ? 0.0L : cabsl((n2 * c - p) / rp_den);
	return (double)(0.5L * (rs * rs + rp * rp));
}

/* The same at a cosine off by the factor 1 + turn, with p^2 moved by shift where it alone counts: c - p = (1 - N^2)/(c +
 * p), whose numerator has no angle in it, and r_p/r_s = (c p - s^2)/(c p + s^2). */
static double shifted_conductor(float c_in, float n_in, float k_in, double turn, double shift)
{
	const long double c = (long double)c_in * (1.0L + (long double)turn), n = (long double)n_in;
	const long double k = (long double)k_in, m = (n - 1.0L) * (n + 1.0L) - k * k, s2 = (1.0L - c) * (1.0L + c);
	const long double complex ink = 2.0L * n * k * (long double complex)I;
	const long double complex p = csqrtl(m + c * c + (long double)shift + ink);
	const long double rs = cabsl((m + ink) / ((c + p) * (c + p)));
	const long double rp = rs * cabsl((c * p - s2) / (c * p + s2));
	return (double)(0.5L * (rs * rs + rp * rp));
}

/* How far the result is, relatively, from what exact arithmetic gives for c^2 off by its rounding, and t by what float
 * arithmetic cannot but lose: 3 U of n^2 - 1 and U of its difference to k^2, or 3 U of n^2 - k^2, U of sin^2, and U of
 * the sum. Only with a small k near n = sin theta does that matter: the edge of total reflection. */
static double conductor_error(float c, float n, float k)
{
	const double c2 = (double)c * (double)c, n2 = (double)n * (double)n, k2 = (double)k * (double)k;
	const double off = n < 0.75f ? U * (4.0 * fabs(n2 - k2) + 2.0 * (1.0 - c2))
				     : U * (5.0 * fabs(n2 - 1.0) + 2.0 * k2 + c2);
	double lo = exact_conductor(c, n, k), hi = lo;
	for (int turn = -1; turn <= 1; turn++) {
		for (int i = -4; i <= 4; i++) {
			const double e = shifted_conductor(c, n, k, turn * U / 2.0, off * i / 4.0);
			lo = fmin(lo, e);
			hi = fmax(hi, e);
		}
	}
	const double got = (double)lobe_fresnel_conductor(c, n, k);
	if (isnan(got))
		return HUGE_VAL;
	return got < lo ? (lo - got) / lo : got > hi ? (got - hi) / hi : 0.0;
}

/* From t, with its error set apart: q 3 U, S = q + |t| 4 U, the root of 2 c^2 S 4 U, 2AcS 9 U, WS 10 U; E S 13 U, of
 * which sin^4 is 7, and E + 2Ac sin^2 14 U; M, a sum of squares, 8 U. So 32 U for the numerator and 36 for the
 * denominator, less what of S they have in common, and the quotient. */
static const double conductor_bound = 69.0 * U;

static void test_conductor_metals(void)
{
	double worst_relative = 0.0;
	for (uint32_t metal = 0; metal < LOBE_METAL_COUNT; metal++) {
		const lobe_rgb n = lobe_metal_eta(metal), k = lobe_metal_k(metal);
		for (int j = 0; j <= COSINES; j++) {
			const float c = j < COSINES ? cosine(j) : 0.0f;
			const lobe_rgb f = lobe_fresnel_conductor_rgb(c, n, k);
			const float got[3] = {f.r, f.g, f.b}, ns[3] = {n.r, n.g, n.b}, ks[3] = {k.r, k.g, k.b};
			for (int i = 0; i < 3; i++) {
				const double e = exact_conductor(c, ns[i], ks[i]);
				worst_relative = larger(worst_relative, fabs((double)got[i] - e) / e);
				/* By another division: 5 more roundings, and 2 in the scalar form. */
				const double scalar = (double)lobe_fresnel_conductor(c, ns[i], ks[i]);
				TEST_ASSERT_TRUE(fabs((double)got[i] - scalar) <= 7.0 * U * scalar);
				TEST_ASSERT_TRUE(got[i] >= 0.0f && got[i] <= 1.0f);
			}
		}
	}
	measured("metals: F relative", worst_relative, conductor_bound);
}

static void test_conductor_everywhere(void)
{
	worst backward = {0};
	uint32_t out_of_range = 0;
	float bad_c = 0.0f, bad_n = 0.0f, bad_k = 0.0f, worst_k = 0.0f;
	for (int i = 0; i < 75; i++) {
		/* Decades, and what is hardly an interface. */
		const double near = pow(10.0, -1 - (i - 61) / 2);
		const float n = (float)(i < 61 ? pow(10.0, (i - 30) / 10.0) : i % 2 ? 1.0 + near : 1.0 - near);
		for (int l = 0; l < 67; l++) {
			const float k = l == 0 ? 0.0f : (float)pow(10.0, l < 62 ? (l - 31) / 10.0 : 58 - l);
			for (int j = 0; j <= COSINES; j += 3) {
				const float c = j < COSINES ? cosine(j) : 0.0f;
				const float f = lobe_fresnel_conductor(c, n, k);
				if (!(f >= 0.0f && f <= 1.0f)) {
					out_of_range++;
					bad_c = c;
					bad_n = n;
					bad_k = k;
					continue;
				}
				const double before = backward.value;
				keep_worst(&backward, conductor_error(c, n, k), c, n);
				if (backward.value != before)
					worst_k = k;
			}
		}
	}
	printf("  worst at k = %g\n", (double)worst_k);
	measured_at("conductor: F relative, beside roundings of t, c^2", backward, conductor_bound);
	if (out_of_range)
		printf("  F(c %a, n %a, k %a) = %g\n", (double)bad_c, (double)bad_n, (double)bad_k,
		       (double)lobe_fresnel_conductor(bad_c, bad_n, bad_k));
	measured("conductor: results outside of [0,1]", out_of_range, 0.0);
}

/* The ends of the domain and the zeros of the formula's own terms. */
static void test_conductor_extremes(void)
{
	const float ns[] = {0.001f, 0.5f, 0x1.fffffep-1f, 1.0f, 0x1.000002p+0f, 1.5f, 1000.0f};
	const float ks[] = {0.0f, 0x1p-149f, 1e-20f, 1e-7f, 0.001f, 1.0f, 1000.0f};
	const float cs[] = {0.0f, 0x1p-149f, 1e-20f, 1e-7f, 1e-4f, 0.01f, 0.5f, 0x1.bb67aep-1f, 0x1.fffffep-1f, 1.0f};
	uint32_t bad = 0;
	for (size_t i = 0; i < sizeof ns / sizeof ns[0]; i++) {
		for (size_t j = 0; j < sizeof ks / sizeof ks[0]; j++) {
			for (size_t l = 0; l < sizeof cs / sizeof cs[0]; l++) {
				const float f = lobe_fresnel_conductor(cs[l], ns[i], ks[j]);
				if (!(f >= 0.0f && f <= 1.0f)) {
					if (bad++ < 8)
						printf("  F(c %a, n %a, k %a) = %g\n", (double)cs[l], (double)ns[i],
						       (double)ks[j], (double)f);
				}
			}
		}
	}
	measured("conductor: extremes outside of [0,1]", bad, 0.0);
}

static void test_conductor_without_absorption(void)
{
	worst w = {0};
	const float etas[] = {1.001f, 1.1f, 1.33f, 1.5f, 2.42f, 4.0f, 100.0f, 1.0f / 1.5f, 0.25f};
	for (size_t i = 0; i < sizeof etas / sizeof etas[0]; i++) {
		for (int j = 0; j < COSINES; j++) {
			const float c = cosine(j);
			const exact_fresnel e = exact_dielectric(c, etas[i]);
			const double s2 = (1.0 - (double)c) * (1.0 + (double)c), eta = (double)etas[i];
			/* t is off by 4 U(n^2 + s^2), so g by half of that over g^2, and F by twice 2 g/(c + g)^2 or
			 * less. */
			const double off = 4.0 * U * (eta * eta + s2);
			if (fabs(e.edge) < 16.0 * off)
				continue;
			const double error = fabs((double)lobe_fresnel_conductor(c, etas[i], 0.0f) -
						  (double)lobe_fresnel_dielectric(c, etas[i]).reflectance);
			const double condition = e.edge > 0.0 ? e.transmittance * off / e.edge : off / -e.edge;
			keep_worst(&w, larger(error - condition, 0.0), c, etas[i]);
		}
	}
	measured_at("conductor with k = 0 against dielectric: |difference|", w, conductor_bound + 40.0 * U);
}

/* --- optical constants ---------------------------------------------------------------------------------------------- */

static double f0(float n_in, float k_in)
{
	const double n = (double)n_in, k = (double)k_in;
	return ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
}

static void test_metals_normal_incidence(void)
{
	double worst_f0 = 0.0;
	for (uint32_t metal = 0; metal < LOBE_METAL_COUNT; metal++) {
		const lobe_rgb n = lobe_metal_eta(metal), k = lobe_metal_k(metal);
		const lobe_rgb f = lobe_fresnel_conductor_rgb(1.0f, n, k);
		printf("  %-12s F0 = %.3f %.3f %.3f\n", lobe_metal_name(metal), (double)f.r, (double)f.g, (double)f.b);
		worst_f0 = larger(worst_f0, fabs((double)f.r - f0(n.r, k.r)));
		worst_f0 = larger(worst_f0, fabs((double)f.g - f0(n.g, k.g)));
		worst_f0 = larger(worst_f0, fabs((double)f.b - f0(n.b, k.b)));
	}
	measured("metals: F0 against ((n-1)^2+k^2)/((n+1)^2+k^2)", worst_f0, conductor_bound);
}

/* What everybody knows of their looks; it would show exchanged columns. */
static void test_metals_look(void)
{
	const lobe_rgb gold =
		lobe_fresnel_conductor_rgb(1.0f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD));
	TEST_ASSERT_TRUE_MESSAGE(gold.r > gold.g && gold.g > gold.b && gold.r > 0.9f && gold.b < 0.5f,
				 "gold is yellow");
	const lobe_rgb copper =
		lobe_fresnel_conductor_rgb(1.0f, lobe_metal_eta(LOBE_METAL_COPPER), lobe_metal_k(LOBE_METAL_COPPER));
	TEST_ASSERT_TRUE_MESSAGE(copper.r > 0.9f && copper.r > 1.4f * copper.g && copper.g > copper.b, "copper is red");
	const lobe_rgb silver =
		lobe_fresnel_conductor_rgb(1.0f, lobe_metal_eta(LOBE_METAL_SILVER), lobe_metal_k(LOBE_METAL_SILVER));
	TEST_ASSERT_TRUE_MESSAGE(silver.r > 0.95f && silver.g > 0.95f && silver.b > 0.95f, "silver is white");
	const lobe_rgb aluminium = lobe_fresnel_conductor_rgb(1.0f, lobe_metal_eta(LOBE_METAL_ALUMINIUM),
							      lobe_metal_k(LOBE_METAL_ALUMINIUM));
	TEST_ASSERT_TRUE_MESSAGE(aluminium.r > 0.88f && aluminium.r < 0.94f && aluminium.b > aluminium.r,
				 "aluminium is blue-white");
	const lobe_rgb tungsten = lobe_fresnel_conductor_rgb(1.0f, lobe_metal_eta(LOBE_METAL_TUNGSTEN),
							     lobe_metal_k(LOBE_METAL_TUNGSTEN));
	TEST_ASSERT_TRUE_MESSAGE(tungsten.r < 0.6f && tungsten.b > 0.4f, "tungsten is grey");
}

static void test_glasses(void)
{
	/* Tables of any optics book give these to two decimals. */
	TEST_ASSERT_TRUE(fabsf(lobe_glass_eta(LOBE_GLASS_WATER) - 1.33f) < 0.005f);
	TEST_ASSERT_TRUE(fabsf(lobe_glass_eta(LOBE_GLASS_ICE) - 1.31f) < 0.005f);
	TEST_ASSERT_TRUE(fabsf(lobe_glass_eta(LOBE_GLASS_BK7) - 1.5168f) < 0.00005f);
	TEST_ASSERT_TRUE(fabsf(lobe_glass_eta(LOBE_GLASS_ACRYLIC) - 1.49f) < 0.005f);
	TEST_ASSERT_TRUE(fabsf(lobe_glass_eta(LOBE_GLASS_DIAMOND) - 2.417f) < 0.001f);
	TEST_ASSERT_TRUE(fabsf(lobe_glass_eta(LOBE_GLASS_SAPPHIRE) - 1.77f) < 0.005f);
	TEST_ASSERT_TRUE(lobe_glass_eta(LOBE_GLASS_COUNT) == 1.0f && lobe_glass_eta(0xffffffffu) == 1.0f);
	const lobe_rgb n = lobe_metal_eta(LOBE_METAL_COUNT), k = lobe_metal_k(0xffffffffu);
	TEST_ASSERT_TRUE(n.r == 1.0f && n.g == 1.0f && n.b == 1.0f && k.r == 0.0f && k.g == 0.0f && k.b == 0.0f);
}

static void test_names(void)
{
	for (uint32_t i = 0; i < LOBE_METAL_COUNT; i++)
		TEST_ASSERT_EQUAL_UINT32(i, lobe_metal_find(lobe_metal_name(i)));
	for (uint32_t i = 0; i < LOBE_GLASS_COUNT; i++)
		TEST_ASSERT_EQUAL_UINT32(i, lobe_glass_find(lobe_glass_name(i)));
	TEST_ASSERT_EQUAL_STRING("gold", lobe_metal_name(LOBE_METAL_GOLD));
	TEST_ASSERT_EQUAL_STRING("nickel", lobe_metal_name(LOBE_METAL_NICKEL));
	TEST_ASSERT_EQUAL_STRING("bk7", lobe_glass_name(LOBE_GLASS_BK7));
	TEST_ASSERT_NULL(lobe_metal_name(LOBE_METAL_COUNT));
	TEST_ASSERT_NULL(lobe_metal_name(0xffffffffu));
	TEST_ASSERT_NULL(lobe_glass_name(LOBE_GLASS_COUNT));
	const char *const unknown[] = {NULL, "", "Gold", "gold ", "gol", "unobtainium", "water"};
	for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
		TEST_ASSERT_EQUAL_UINT32(LOBE_METAL_COUNT, lobe_metal_find(unknown[i]));
	TEST_ASSERT_EQUAL_UINT32(LOBE_GLASS_COUNT, lobe_glass_find(NULL));
	TEST_ASSERT_EQUAL_UINT32(LOBE_GLASS_COUNT, lobe_glass_find("gold"));
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_conductor_metals);
	RUN_TEST(test_conductor_everywhere);
	RUN_TEST(test_conductor_extremes);
	RUN_TEST(test_conductor_without_absorption);
	RUN_TEST(test_metals_normal_incidence);
	RUN_TEST(test_metals_look);
	RUN_TEST(test_glasses);
	RUN_TEST(test_names);
	return UNITY_END();
}
