/* test_beckmann_visible.c - visible-normal sampling of microfacet/beckmann.h: the distribution that it inverts, in
 * double, chi-square of its samples, and every extreme. */
#include "chi_square.h"
#include "directions.h"
#include "double_reference.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include "lobe/microfacet/beckmann.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double radius(lobe_vec3 v) { return hypot((double)v.x, (double)v.y); }

/* --- the distribution that is inverted ---------------------------------------------------------------------------- */

/* u number i: all of the 1000 next to either end, then random ones. */
static float u_at(uint32_t stream, uint32_t i)
{
	return i < 1000u   ? (float)i * 0x1p-24f
	       : i < 2000u ? 1.0f - (float)(i - 999u) * 0x1p-24f
			   : test_uniform(stream, i);
}

/* The complement of X's distribution, at X = x for z >= 0 and at X = c + x below the horizon (c = |z|/r). */
static double complement_above(double c, double x)
{
	return (exp(-x * x) / sqrt(PI) + c * erfc(x)) / (2.0 * c + exp(-c * c) * reference_ierfcx(c));
}

static double complement_below(double c, double x)
{
	return exp(-x * (x + 2.0 * c)) * (reference_ierfcx(c + x) + x * reference_erfcx(c + x)) / reference_ierfcx(c);
}

/* X by bisection of the same, to the last bit of a double. */
static double bisected(double (*complement)(double, double), double c, double lo, double share)
{
	double hi = 12.0;
	for (int i = 0; i < 80; i++) {
		const double middle = 0.5 * (lo + hi);
		if (complement(c, middle) > share)
			lo = middle;
		else
			hi = middle;
	}
	return 0.5 * (lo + hi);
}

static void test_inversion(void)
{
	double above = 0.0, below = 0.0, tail = 0.0, distance = 0.0;
	uint32_t not_visible = 0;
	for (uint32_t k = 0; k <= 300; k++) {
		const double wanted = k == 0 ? 0.0 : pow(10.0, -7.0 + 13.0 * k / 300.0);
		const lobe_vec3 v = at_cotangent(wanted, 2.0, 1.0);
		const double c = (double)v.z / radius(v);
		const float c_float = (float)c;
		for (uint32_t i = 0; i < 6000u; i++) {
			const float u = u_at(100u + k, i);
			const double share = (double)u + 0x1p-25;
			const double x = (double)lobe_beckmann_slope_above(v, u);
			above = worse(above, fabs(complement_above(c, x) - share));
			if (share < 0.5)
				tail = worse(tail, fabs(complement_above(c, x) / share - 1.0));
			not_visible += x > -c - 1e-6 * c ? 0u : 1u;
			const double f = (double)lobe_beckmann_slope_below(c_float, u);
			below = worse(below, fabs(complement_below((double)c_float, f) - share));
			not_visible += f > 0.0 ? 0u : 1u;
			if (i % 60 == 0) {
				/* In X itself, where the density is not small. */
				const double e = bisected(complement_above, c, fmax(-c, -6.0), share);
				if (share > 1e-3 && share < 0.999)
					distance = worse(distance, fabs(x - e));
			}
		}
	}
	measured("distribution of X: absolute error above the horizon", above, 7.2e-7);
	measured("distribution of X: absolute error below", below, 7.2e-7);
	measured("its upper tail: relative error", tail, 6e-6);
	measured("X against bisection, 1e-3 < u < 1 - 1e-3", distance, 2e-5);
	measured("facets that are not visible", not_visible, 0.0);
}

/* Rounding aside X falls as u rises, and without a jump: over 2^-12 in u it falls, but for nowhere by more than a
 * neighbouring cell would. */
static void test_monotone(void)
{
	uint32_t rises = 0;
	double largest = 0.0;
	for (uint32_t k = 0; k <= 100; k++) {
		const lobe_vec3 v = at_cotangent(k == 0 ? 0.0 : pow(10.0, -4.0 + 8.0 * k / 100.0), 2.0, 1.0);
		const float c = (float)((double)v.z / radius(v));
		float last = lobe_beckmann_slope_above(v, 0.0f), last_below = lobe_beckmann_slope_below(c, 0.0f);
		for (uint32_t i = 1; i < 4096u; i++) {
			const float x = lobe_beckmann_slope_above(v, (float)i * 0x1p-12f);
			const float f = lobe_beckmann_slope_below(c, (float)i * 0x1p-12f);
			rises += (x < last ? 0u : 1u) + (f < last_below ? 0u : 1u);
			if (i > 40u && i < 4056u)
				largest = larger(largest, (double)(last - x));
			last = x;
			last_below = f;
		}
	}
	measured("X rises with u, in steps of 2^-12", rises, 0.0);
	measured("largest step of X between u of .01 and .99", largest, 0.02);
}

/* --- samples ------------------------------------------------------------------------------------------------------ */

#define SAMPLES 500000u
#define SIDE    20

typedef lobe_vec3 (*sampler)(lobe_vec3 v, lobe_vec2 u);

/* Planted: an inversion that stops early. X of normal incidence, moved by half of the mean that X has at c. */
static lobe_vec3 sample_gauss_start(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real x = lobe_erfinv(lobe_fma(LOBE_R(-2.0), u.x, LOBE_BELOW_ONE));
	return lobe_beckmann_normal(v, x + 0.25f / (float)(fabs((double)v.z) / radius(v)), u.y);
}

/* Planted: v 3 % off its length along z. */
static lobe_vec3 sample_wrong_view(lobe_vec3 v, lobe_vec2 u)
{
	return lobe_beckmann_visible(lobe_vec3_make(v.x, v.y, 1.03f * v.z), u);
}

static lobe_vec3 sample_above(lobe_vec3 v, lobe_vec2 u) { return lobe_beckmann_visible_above(v, u); }

/* Chi-square over cells of equal probability: in X by the complement of its distribution, in Y by that of a Gaussian,
 * which the exact formulas tell apart from how the sampler inverts them. */
static double p_value(sampler sample, lobe_vec3 v, uint32_t stream)
{
	static uint32_t count[SIDE * SIDE];
	static double probability[SIDE * SIDE];
	const double r = radius(v), z = (double)v.z, c = fabs(z) / r;
	const double cos_phi = (double)v.x / r, sin_phi = (double)v.y / r;
	for (int i = 0; i < SIDE * SIDE; i++) {
		count[i] = 0;
		probability[i] = 1.0 / (SIDE * SIDE);
	}
	for (uint64_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec3 m = sample(v, lobe_vec2_make(u[0], u[1]));
		const double mx = (double)m.x / (double)m.z, my = (double)m.y / (double)m.z;
		const double x = cos_phi * mx + sin_phi * my, y = cos_phi * my - sin_phi * mx;
		const double s = z < 0.0 ? complement_below(c, fmax(x - c, 0.0)) : complement_above(c, x);
		int column = (int)(s * SIDE), row = (int)(0.5 * erfc(y) * SIDE);
		column = column < 0 ? 0 : column >= SIDE ? SIDE - 1 : column;
		row = row >= SIDE ? SIDE - 1 : row;
		count[column * SIDE + row] += 1u;
	}
	return chi_square_of(probability, count, SIDE * SIDE).p;
}

static void test_visible_chi_square(void)
{
	static const double cots[] = {0.0, 1e-6, 0.01, 0.3, 1.0, 2.5, 5.0, 1e3, -1e-4, -0.2, -1.0, -3.0, -10.0};
	const size_t n = sizeof cots / sizeof *cots;
	const double level = 1.0 - pow(0.99, 1.0 / (double)n); /* Sidak, all cases together: .01 */
	for (size_t i = 0; i < n; i++) {
		const lobe_vec3 v = at_cotangent(cots[i], 0.7 * (double)i, 1.0);
		const double p = p_value(lobe_beckmann_visible, v, 300u + (uint32_t)i);
		printf("  cot %-7g p = %8.3g   level %.3g\n", cots[i], p, level);
		if (p <= level)
			measured("the chi-square p of that case, negated", -p, -level);
		if (v.z > 0.0f) {
			float u[3];
			test_u3(400u, i, u);
			const lobe_vec2 at = lobe_vec2_make(u[0], u[1]);
			const lobe_vec3 a = lobe_beckmann_visible(v, at), b = sample_above(v, at);
			TEST_ASSERT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z);
		}
	}
	const double start = p_value(sample_gauss_start, at_cotangent(2.5, 1.0, 1.0), 300u);
	const double view = p_value(sample_wrong_view, at_cotangent(1.0, 1.0, 1.0), 300u);
	printf("  planted: a shifted Gaussian for X at cot 2.5 p = %.3g; v.z 3 %% off at cot 1 p = %.3g\n", start,
	       view);
	TEST_ASSERT_TRUE(start <= level && view <= level);
}

/* Every v and u: finite and upright. */
static void test_visible_extremes(void)
{
	static const float corner[] = {0.0f, 0x1p-149f, 0x1p-24f, 0.25f, 0.5f, 0.75f, 0x1.fffffcp-1f, 0x1.fffffep-1f};
	static const float parts[] = {0.0f, 1e-30f, 1e-20f, 1e-10f, 1e-6f, 1e-4f, 1e-2f, 1.0f};
	uint32_t bad = 0;
	double steepest = 0.0;
	for (uint32_t i = 0; i < 8u * 8u * 64u * 2u; i++) {
		const float z = parts[i / 8u % 8u];
		const lobe_vec3 v = lobe_vec3_make(parts[i % 8u], 0.0f, i & 0x1000u ? -z : z);
		const lobe_vec3 m =
			lobe_beckmann_visible(v, lobe_vec2_make(corner[i / 64u % 8u], corner[i / 512u % 8u]));
		const double size = (double)m.x * (double)m.x + (double)m.y * (double)m.y;
		bad += m.z == 1.0f && size < 1e13 ? 0u : 1u;
		steepest = v.z >= 0.0f ? larger(steepest, sqrt(size)) : steepest;
	}
	measured("visible normals not finite or not upright", bad, 0.0);
	printf("  steepest slope from above: %.2f\n", steepest);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_inversion);
	RUN_TEST(test_monotone);
	RUN_TEST(test_visible_chi_square);
	RUN_TEST(test_visible_extremes);
	return UNITY_END() != 0;
}
