/* test_distributions_forms.c - what the distributions of microfacet/distribution.h are to each other: closed forms
 * against tables, the members that are GGX, the limit that is Beckmann, shape invariance; and single precision against
 * double. */
#include "distribution_cases.h"
#include "double_distributions.h"
#include "measured.h"
#include "support.h"

#include "unity.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const distribution_case *cases;
static size_t count;
static float table[LOBE_PROFILE_WORDS];

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static void test_made(void)
{
	cases = distribution_cases(&count);
	TEST_ASSERT_NOT_NULL(cases);
}

/* (1, 0, z) for z = 10^-4 to 10^4 */
enum { VIEWS = 400 };
static lobe_vec3 view(int i) { return lobe_vec3_make(1.0f, 0.0f, powf(10.0f, (float)i / (VIEWS / 8.0f) - 4.0f)); }

static lobe_distribution made(lobe_status status, const lobe_distribution *d)
{
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, status, lobe_error_message());
	return *d;
}
static lobe_distribution gtr(float gamma, float alpha)
{
	lobe_distribution d;
	return made(lobe_distribution_gtr(&d, table, LOBE_PROFILE_WORDS, gamma, alpha), &d);
}
static lobe_distribution student_t(float gamma)
{
	lobe_distribution d;
	return made(lobe_distribution_student_t(&d, table, LOBE_PROFILE_WORDS, gamma), &d);
}
static lobe_distribution phong(float n)
{
	lobe_distribution d;
	return made(lobe_distribution_phong(&d, table, LOBE_PROFILE_WORDS, n), &d);
}

static double pi_d(lobe_distribution d, lobe_vec3 h)
{
	const lobe_facet_density f = lobe_distribution_density(d, h);
	return (double)f.inv * (double)f.inv * (double)f.factor;
}

/* --- powers.h ----------------------------------------------------------------------------------------------------- */

static void test_powers(void)
{
	double log1p_ulp = 0.0, expm1_ulp = 0.0, over = 0.0;
	for (uint64_t i = 0; i < 400000; i++) {
		const float size = powf(2.0f, 60.0f * test_uniform(1, i) - 50.0f);
		log1p_ulp = worse(log1p_ulp, test_ulp(lobe_log1p(size), log1p((double)size)));
		over = worse(over, test_ulp(lobe_log1p_over(size), log1p((double)size) / (double)size));
		if (size < 0.999f) {
			log1p_ulp = worse(log1p_ulp, test_ulp(lobe_log1p(-size), log1p(-(double)size)));
			over = worse(over, test_ulp(lobe_log1p_over(-size), log1p(-(double)size) / -(double)size));
		}
		if (size < 88.0f) {
			expm1_ulp = worse(expm1_ulp, test_ulp(lobe_expm1(size), expm1((double)size)));
			expm1_ulp = worse(expm1_ulp, test_ulp(lobe_expm1(-size), expm1(-(double)size)));
		}
	}
	measured("log(1 + x): ulp", log1p_ulp, 2.4);
	measured("log(1 + x)/x: ulp", over, 2.4);
	measured("exp(x) - 1: ulp", expm1_ulp, 2.4);
	TEST_ASSERT_TRUE(lobe_log1p(0.0f) == 0.0f && lobe_log1p(HUGE_VALF) == HUGE_VALF && lobe_expm1(0.0f) == 0.0f);
	TEST_ASSERT_TRUE(lobe_expm1(-HUGE_VALF) == -1.0f && lobe_expm1(HUGE_VALF) == HUGE_VALF);
	TEST_ASSERT_TRUE(lobe_log1p_over(0.0f) == 1.0f && lobe_expm1_over(0.0f) == 1.0f);
	double ratio = 0.0;
	for (float x = 1.0f; x < 1e6f; x *= 1.01f)
		ratio = worse(
			ratio,
			fabs((double)lobe_gamma_ratio(x) / exp(lgamma((double)x) - lgamma((double)x + 0.5)) - 1.0));
	measured("Gamma(x)/Gamma(x + 1/2): relative", ratio, 2e-6);
}

/* (1 + x)^-e to a few ulp, also where it is 1e-30. Planted: its exponential of e log(1 + x), whose argument alone is
 * off by more. */
static void test_decay(void)
{
	double ulp = 0.0, large = 0.0, planted = 0.0;
	for (uint64_t i = 0; i < 400000; i++) {
		const float x = powf(2.0f, 60.0f * test_uniform(11, i) - 30.0f);
		const float e = powf(2.0f, 30.0f * test_uniform(12, i) - 3.0f);
		const long double exact = expl(-(long double)e * log1pl((long double)x));
		if (exact < 1e-36L)
			continue;
		const double off = test_ulp(lobe_decay(x, e), (double)exact);
		*(e < 1e5f ? &ulp : &large) = worse(e < 1e5f ? ulp : large, off);
		planted = worse(planted, test_ulp(lobe_exp(-e * lobe_log1p(x)), (double)exact));
	}
	measured("(1 + x)^-e, e to 1e5: ulp", ulp, 3.0);
	/* What 1 + x loses, e 2^-24, is up to 8 then, and so are the roundings of it. */
	measured("(1 + x)^-e, e to 1.3e8: ulp", large, 16.0);
	TEST_ASSERT_TRUE(planted > 30.0);
	TEST_ASSERT_TRUE(lobe_decay(0.0f, 2e8f) == 1.0f && lobe_decay(HUGE_VALF, 1.5f) == 0.0f);
	TEST_ASSERT_TRUE(lobe_decay(1e30f, 0.0f) == 1.0f);
}

/* --- members that are known --------------------------------------------------------------------------------------- */

/* d of slopes r is GGX of slopes r/width. */
static void assert_ggx(const char *what, lobe_distribution d, float width)
{
	double density = 0.0, hidden = 0.0, tail = 0.0, back = 0.0, visible = 0.0;
	for (int i = 0; i < VIEWS; i++) {
		const lobe_vec3 v = view(i), wide = lobe_vec3_make(width * v.x, 0.0f, v.z);
		const lobe_vec3 h = lobe_vec3_make(1.0f, 0.0f, width * v.z),
				wide_h = lobe_vec3_make(1.0f / width, 0.0f, width * v.z);
		const lobe_facet_density g = lobe_ggx_density(wide_h);
		const double exact = (double)g.inv * (double)g.inv / ((double)width * (double)width);
		density = worse(density, fabs(pi_d(d, h) / exact - 1.0));
		hidden = worse(hidden,
			       fabs((double)lobe_distribution_hidden(d, v) / (double)lobe_ggx_hidden(wide) - 1.0));
		const float t2 = v.z * v.z * 0x1p-10f, q = lobe_ggx_tail(t2 / (width * width));
		tail = worse(tail, fabs((double)lobe_distribution_tail(d, t2) / (double)q - 1.0));
		const double t2_back = (double)lobe_distribution_tail_inverse(d, q);
		const double t2_ggx = (double)lobe_ggx_tail_inverse(q) * (double)width * (double)width;
		back = worse(back, t2_ggx == 0.0 ? t2_back : fabs(t2_back / t2_ggx - 1.0));
		/* The same surface is seen by another map of u: the mean of m.z over a lattice of u's agrees. */
		if (i % 100 == 50) {
			double a = 0.0, b = 0.0;
			for (int n = 0; n < 4096; n++) {
				const lobe_vec2 u = lobe_vec2_make((float)(n % 64) / 64.0f + 0x1p-7f,
								   (float)(n / 64) / 64.0f + 0x1p-7f);
				const lobe_vec3 m = lobe_distribution_visible(d, v, u), e = lobe_ggx_visible(wide, u);
				a += (double)m.z / sqrt((double)lobe_dot(m, m)) / 4096.0;
				const double ex = (double)(width * e.x), ey = (double)(width * e.y), ez = (double)e.z;
				b += ez / sqrt(ex * ex + ey * ey + ez * ez) / 4096.0;
			}
			visible = worse(visible, fabs(a - b));
		}
	}
	printf("  %s, width %g\n", what, (double)width);
	measured("  density against GGX: relative", density, 5e-6);
	measured("  hidden against GGX: relative", hidden, 2e-6);
	measured("  tail against GGX: relative", tail, 5e-6);
	measured("  inverse tail against GGX: relative", back, 5e-6);
	measured("  mean cosine of visible normals against GGX", visible, 2e-3);
}

static void test_ggx_members(void)
{
	assert_ggx("GTR 2", gtr(2.0f, 0.25f), 0.25f);
	assert_ggx("GTR 2", gtr(2.0f, 1e-3f), 1e-3f);
	assert_ggx("GTR of width 1, any gamma", gtr(1.3f, 1.0f), 1.0f);
	assert_ggx("Student-T 2", student_t(2.0f), 1.0f);
	assert_ggx("Phong 0", phong(0.0f), 1.0f);
}

/* hidden of Beckmann: s (exp(-z^2)/sqrt(pi) - z erfc(z))/2. The difference is of order
 * z^4/gamma. */
static void test_beckmann_limit(void)
{
	double at[2] = {0.0, 0.0};
	for (int k = 0; k < 2; k++) {
		const lobe_distribution d = student_t(k == 0 ? 1000.0f : 100000.0f);
		for (int i = 0; i < VIEWS; i++) {
			const lobe_vec3 v = view(i);
			const double z = (double)v.z;
			if (z > 1.5)
				continue;
			const double h = 0.5 * (exp(-z * z) / sqrt(PI) - z * erfc(z));
			at[k] = worse(at[k], fabs((double)lobe_distribution_hidden(d, v) / h - 1.0));
			at[k] = worse(at[k], fabs((double)lobe_distribution_tail(d, v.z * v.z) / exp(-z * z) - 1.0));
			const lobe_vec3 m = lobe_vec3_make(v.z, 0.0f, 1.0f);
			at[k] = worse(at[k], fabs(pi_d(d, m) / exp(-z * z) - 1.0));
		}
	}
	measured("Student-T 1000 against Beckmann: relative", at[0], 7e-3);
	measured("Student-T 100000 against Beckmann: relative", at[1], 7e-5);
}

/* Phong is Student-T of gamma (n + 4)/2, stretched by lobe_phong_alpha(n). */
static void test_phong_is_student_t(void)
{
	static float other[LOBE_PROFILE_WORDS];
	double worst = 0.0;
	for (float n = 0.0f; n <= 1000.0f; n = 3.0f * n + 1.0f) {
		lobe_distribution t;
		const lobe_distribution p = phong(n);
		const float a = lobe_phong_alpha(n);
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_student_t(&t, other, LOBE_PROFILE_WORDS, 0.5f * n + 2.0f));
		for (int i = 0; i < VIEWS; i++) {
			const lobe_vec3 v = view(i);
			const float h = lobe_distribution_hidden(p, v);
			if (h > 1e-8f)
				worst = worse(worst,
					      fabs((double)lobe_distribution_hidden(t, lobe_vec3_make(a, 0.0f, v.z)) /
							   (double)h -
						   1.0));
		}
		TEST_ASSERT_TRUE(fabs((double)lobe_phong_exponent(a) - (double)n) <= 1e-6 * ((double)n + 1.0));
	}
	measured("Phong against Student-T: hidden, relative", worst, 1e-5);
	TEST_ASSERT_TRUE(lobe_phong_exponent(1.0f) == 0.0f);
}

/* Lambda in closed form (student_t.h), where its two terms do not cancel too far for double. */
static double exact_lambda(double g, double z)
{
	const double s2 = g - 1.0, s = sqrt(s2), c = exp(lgamma(g - 0.5) - lgamma(g)) * s2 / (sqrt(PI) * s);
	return c * s2 * pow(1.0 + z * z / s2, 1.5 - g) / ((2.0 * g - 3.0) * z) -
	       gsl_cdf_tdist_Q(z * sqrt(2.0 * g - 2.0) / s, 2.0 * g - 2.0);
}

static void test_student_t_lambda(void)
{
	static const float gammas[] = {1.501f, 1.51f, 1.6f, 1.9f, 2.0f, 2.5f, 3.0f, 5.0f, 10.0f, 100.0f, 1000.0f};
	double worst = 0.0;
	for (size_t k = 0; k < sizeof gammas / sizeof *gammas; k++) {
		const lobe_distribution d = student_t(gammas[k]);
		for (int i = 0; i < VIEWS; i++) {
			const lobe_vec3 v = view(i);
			const double exact = exact_lambda((double)gammas[k], (double)v.z);
			if (exact > 1e-6)
				worst = worse(
					worst,
					fabs((double)lobe_distribution_hidden(d, v) / (exact * (double)v.z) - 1.0));
		}
	}
	measured("Student-T: Lambda against its closed form: relative", worst, 2e-6);
}

static void test_gtr_closed_against_table(void)
{
	double worst = 0.0, jump = 0.0;
	for (float gamma = 1.0f; gamma <= 4.0f; gamma += 1.0f) {
		for (float alpha = 1.0f; alpha > 1e-4f; alpha *= 0.3f) {
			const lobe_distribution d = gtr(gamma, alpha);
			TEST_ASSERT_TRUE(lobe_gtr_is_closed(d));
			for (int i = 0; i < VIEWS; i++) {
				const double closed = (double)lobe_gtr_hidden_closed(d, view(i));
				worst = worse(worst,
					      fabs((double)lobe_profile_hidden(d.table, view(i)) / closed - 1.0));
			}
			if (alpha > 0.9f)
				continue;
			/* From the closed form to the table of the next gamma is no jump. */
			lobe_distribution near = gtr(gamma + 1e-4f, alpha);
			for (int i = 0; i < VIEWS; i++)
				jump = worse(jump, fabs((double)lobe_distribution_hidden(near, view(i)) /
								(double)lobe_gtr_hidden_closed(d, view(i)) -
							1.0));
		}
	}
	measured("GTR 1 to 4: hidden by table against closed form: relative", worst, 1e-5);
	measured("GTR: hidden at gamma + 1e-4 against gamma: relative", jump, 2e-3);
}

/* Near gamma = 1 and alpha = 1 the textbook's normalisation is 0/0. */
static void test_gtr_limits(void)
{
	double gamma_step = 0.0, alpha_step = 0.0;
	for (float alpha = 0.9f; alpha > 1e-3f; alpha *= 0.3f) {
		const double at = (double)gtr(1.0f, alpha).norm;
		gamma_step = worse(gamma_step, fabs((double)gtr(1.0f + 0x1p-23f, alpha).norm / at - 1.0));
		gamma_step = worse(gamma_step, fabs((double)gtr(1.0f - 0x1p-24f, alpha).norm / at - 1.0));
	}
	for (float gamma = 0.5f; gamma < 5.0f; gamma += 0.5f) {
		const lobe_distribution a = gtr(gamma, 1.0f), b = gtr(gamma, 1.0f - 0x1p-24f);
		alpha_step = worse(alpha_step, fabs((double)b.norm - 1.0));
		for (int i = 0; i < VIEWS; i++) {
			const float t2 = view(i).z, q = 1.0f / (1.0f + t2);
			alpha_step = worse(alpha_step,
					   fabs((double)lobe_gtr_tail(b, t2) / (double)lobe_gtr_tail(a, t2) - 1.0));
			alpha_step = worse(
				alpha_step,
				fabs((double)lobe_gtr_tail_inverse(b, q) / (double)lobe_gtr_tail_inverse(a, q) - 1.0));
		}
	}
	measured("GTR: norm at gamma = 1 +- 1 ulp against 1: relative", gamma_step, 3e-6);
	measured("GTR: norm, tail, inverse at alpha = 1 - 1 ulp against 1", alpha_step, 3e-6);
}

/* A shape-invariant surface of width alpha hides, in units of |v.xy|, alpha times what that of width 1 hides at
 * cot theta/alpha (Heitz 2014, section 5.2), and its D depends on tan theta/alpha. GTR does so for gamma = 2 alone. */
static double shape_difference(float gamma)
{
	static float other[LOBE_PROFILE_WORDS];
	const float a = 0.05f, b = 0.5f;
	lobe_distribution wide;
	const lobe_distribution narrow = gtr(gamma, a);
	double worst = 0.0;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_gtr(&wide, other, LOBE_PROFILE_WORDS, gamma, b));
	for (float x = 0.1f; x < 3.0f; x += 0.1f) {
		const double n =
			(double)lobe_distribution_hidden(narrow, lobe_vec3_make(1.0f, 0.0f, a * x)) / (double)a;
		const double w = (double)lobe_distribution_hidden(wide, lobe_vec3_make(1.0f, 0.0f, b * x)) / (double)b;
		worst = worse(worst, fabs(n / w - 1.0));
		const double nd = pi_d(narrow, lobe_vec3_make(a * x, 0.0f, 1.0f)) * (double)(a * a);
		const double wd = pi_d(wide, lobe_vec3_make(b * x, 0.0f, 1.0f)) * (double)(b * b);
		worst = worse(worst, fabs(nd / wd - 1.0));
	}
	return worst;
}

static void test_shape_invariance(void)
{
	const double one = shape_difference(1.0f), most = shape_difference(1.5f), three = shape_difference(3.0f);
	measured("GTR 2: alpha .05 against .5: relative", shape_difference(2.0f), 3e-6);
	printf("  GTR 1, 1.5, 3: the same %.3g %.3g %.3g\n", one, most, three);
	TEST_ASSERT_TRUE(one > 0.1 && most > 0.1 && three > 0.1);
}

/* --- single precision against double ------------------------------------------------------------------------------ */

static void test_double(void)
{
	double all[4] = {0.0, 0.0, 0.0, 0.0}, hard[4] = {0.0, 0.0, 0.0, 0.0};
	for (size_t i = 0; i < count; i++) {
		const lobe_distribution d = cases[i].d;
		const double_distribution dd = {d.ndf, (double)d.exponent, (double)d.width, (double)d.norm,
						(const float *)(uintptr_t)lobe_table_address(d.table)};
		const double median = sqrt(double_distribution_tail_inverse(dd, 0.5));
		double density = 0.0, hidden = 0.0, tail = 0.0, visible = 0.0;
		for (uint64_t k = 0; k < 2000; k++) {
			const float z = (float)(median * pow(10.0, 4.0 * (double)test_uniform(7, k) - 2.0));
			const double h[3] = {(double)z, 0.0, 1.0}, v[3] = {1.0, 0.0, (double)z};
			const float u[2] = {test_uniform(8, k), test_uniform(9, k)};
			const double ud[2] = {(double)u[0], (double)u[1]};
			const double e = double_distribution_density(dd, h), s = double_distribution_hidden(dd, v);
			const double q = double_distribution_tail(dd, (double)(z * z));
			double m[3];
			if (q > 1e-10 && e > 1e-10)
				density = worse(density, fabs(pi_d(d, lobe_vec3_make(z, 0.0f, 1.0f)) / e - 1.0));
			if (s > 1e-10 * median)
				hidden = worse(
					hidden,
					fabs((double)lobe_distribution_hidden(d, lobe_vec3_make(1.0f, 0.0f, z)) / s -
					     1.0));
			if (q > 1e-10)
				tail = worse(tail, fabs((double)lobe_distribution_tail(d, z * z) / q - 1.0));
			/* Angle between the normals; the last of u is where either may differ by all that is
			 * steeper. */
			double_distribution_visible(dd, v, ud, m);
			const lobe_vec3 f =
				lobe_distribution_visible(d, lobe_vec3_make(1.0f, 0.0f, z), lobe_vec2_make(u[0], u[1]));
			const double cx = (double)f.y * m[2] - (double)f.z * m[1],
				     cy = (double)f.z * m[0] - (double)f.x * m[2],
				     cz = (double)f.x * m[1] - (double)f.y * m[0];
			const double off = sqrt(cx * cx + cy * cy + cz * cz) /
					   sqrt((double)lobe_dot(f, f) * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]));
			if (u[0] > 1e-3f && u[0] < 0.999f)
				visible = worse(visible, off / fmin(median, 1.0));
		}
		printf("  %-16s density %.2g, hidden %.2g, tail %.2g, visible %.2g of the median\n", cases[i].name,
		       density, hidden, tail, visible);
		/* Where log Q falls by 100 and more for each step of log X, so does the error of X grow. */
		double *worst = cases[i].p22(&cases[i], 0.3 * median) > 1e-3 * cases[i].p22(&cases[i], median) &&
						cases[i].smooth
					? all
					: hard;
		worst[0] = worse(worst[0], density);
		worst[1] = worse(worst[1], hidden);
		worst[2] = worse(worst[2], tail);
		worst[3] = worse(worst[3], visible);
	}
	measured("float against double: density", all[0], 6e-6);
	measured("float against double: hidden", all[1], 5e-6);
	measured("float against double: tail", all[2], 5e-6);
	measured("float against double: visible", all[3], 3e-4);
	measured("float against double, rings and steps: density", hard[0], 5e-5);
	measured("float against double, rings and steps: hidden", hard[1], 2e-4);
	measured("float against double, rings and steps: tail", hard[2], 5e-5);
	measured("float against double, rings and steps: visible", hard[3], 1e-5);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_made);
	RUN_TEST(test_powers);
	RUN_TEST(test_decay);
	RUN_TEST(test_ggx_members);
	RUN_TEST(test_beckmann_limit);
	RUN_TEST(test_phong_is_student_t);
	RUN_TEST(test_student_t_lambda);
	RUN_TEST(test_gtr_closed_against_table);
	RUN_TEST(test_gtr_limits);
	RUN_TEST(test_shape_invariance);
	RUN_TEST(test_double);
	return UNITY_END();
}
