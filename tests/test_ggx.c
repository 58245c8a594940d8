/* test_ggx.c - microfacet/ggx.h: the distribution, its projected area and masking. (Visible normals:
 * test_ggx_visible.c.) */
#include "directions.h"
#include "ggx_integral.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

#define U 0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static const float widths[] = {1e-4f, 3e-4f, 1e-3f, 1e-2f, 0.1f, 0.3f, 1.0f};
#define WIDTHS (sizeof widths / sizeof widths[0])

/* Number i of many directions above the surface: everywhere, near the horizon down to 1e-6, near the pole. */
static lobe_vec3 direction(uint32_t stream, uint64_t i)
{
	const double u = (double)test_uniform(stream, 2 * i), phi = TWO_PI * (double)test_uniform(stream, 2 * i + 1);
	if (i % 3 == 0)
		return direction_at(u + 1e-6, phi);
	if (i % 3 == 1)
		return direction_at(pow(10.0, -6.0 * u), phi);
	const double s = pow(10.0, -6.0 * u);
	return lobe_vec3_make((float)(s * cos(phi)), (float)(s * sin(phi)), (float)sqrt((1.0 - s) * (1.0 + s)));
}

/* --- D ------------------------------------------------------------------------------------------------------------ */

/* The textbook: 1/(pi ax ay ((x/ax)^2 + (y/ay)^2 + z^2)^2), at the very components that are given. */
static long double exact_d(float ax, float ay, lobe_vec3 m)
{
	const long double x = (long double)m.x / (long double)ax, y = (long double)m.y / (long double)ay;
	const long double q = x * x + y * y + (long double)m.z * (long double)m.z;
	return 1.0L / ((long double)PI * (long double)ax * (long double)ay * q * q);
}

/* Two widespread forms that know the angle from its cosine alone. a2 cos^2 + sin^2 by 1 - cos^2 : */
static float d_one_minus_cos2(float a, float z)
{
	const float k = a / (1.0f - z * z + a * z * (a * z));
	return k * k * (float)(1.0 / PI);
}

/* and as in Karis 2013, "Real shading in Unreal Engine 4". */
static float d_karis(float a, float z)
{
	const float a2 = a * a;
	const float d = (z * a2 - z) * z + 1.0f;
	return a2 / (d * d) * (float)(1.0 / PI);
}

static void test_d(void)
{
	double worst = 0.0, worst_narrow = 0.0;
	for (size_t i = 0; i < WIDTHS; i++) {
		for (size_t j = 0; j < WIDTHS; j++) {
			const lobe_stretch d = lobe_stretch_make(widths[i], widths[j]);
			for (uint64_t l = 0; l < 20000; l++) {
				const lobe_vec3 m = direction(1, l);
				const long double e = exact_d(widths[i], widths[j], m);
				const double error = fabs((double)(((long double)stretched_ggx_d(d, m) - e) / e));
				worst = worse(worst, error);
				if (i == j && i < 5)
					worst_narrow = worse(worst_narrow, error);
			}
		}
	}
	/* 1/ax is rounded, x/ax again: 2 U, squared 4 U, and 2 U for the sum: 6 U of Q, 7 U of its reciprocal, 14 U of
	 * its square; two products, and 5 U of 1/(pi ax ay): 21 U. */
	measured("D: relative error, all widths", worst, 21.0 * U);
	measured("D: relative error, isotropic, 1e-4 to .1", worst_narrow, 21.0 * U);
}

/* Near the peak, where D falls from its largest value within an angle of alpha. */
static void test_d_peak(void)
{
	for (size_t i = 0; i < 5; i++) {
		const float a = widths[i];
		const lobe_stretch d = lobe_stretch_make(a, a);
		double worst = 0.0, worst_cos2 = 0.0, worst_karis = 0.0;
		for (uint64_t l = 0; l < 100000; l++) {
			const double s = 4.0 * (double)a * (double)test_uniform(2, 2 * l),
				     phi = TWO_PI * (double)test_uniform(2, 2 * l + 1);
			const lobe_vec3 m = {(float)(s * cos(phi)), (float)(s * sin(phi)),
					     (float)sqrt((1.0 - s) * (1.0 + s))};
			const long double e = exact_d(a, a, m);
			worst = worse(worst, fabs((double)(((long double)stretched_ggx_d(d, m) - e) / e)));
			worst_cos2 = worse(worst_cos2, fabs((double)(((long double)d_one_minus_cos2(a, m.z) - e) / e)));
			worst_karis = worse(worst_karis, fabs((double)(((long double)d_karis(a, m.z) - e) / e)));
		}
		char what[80];
		snprintf(what, sizeof what, "D near the peak, alpha %g", (double)a);
		measured(what, worst, 21.0 * U);
		printf("  %60s by 1 - cos^2: %.2g, Karis: %.2g\n", "", worst_cos2, worst_karis);
		/* What the other forms lose: about U/alpha^2. If they did not, this test would look at the wrong place.
		 */
		TEST_ASSERT_TRUE(worst_cos2 > 0.1 * U / ((double)a * (double)a));
		TEST_ASSERT_TRUE(worst_karis > 0.1 * U / ((double)a * (double)a));
	}
}

static void test_d_domain(void)
{
	const float corners[] = {-1.0f, -0x1p-149f, 0.0f};
	for (size_t i = 0; i < WIDTHS; i++) {
		const lobe_stretch d = lobe_stretch_make(widths[i], widths[WIDTHS - 1 - i]);
		for (size_t j = 0; j < sizeof corners / sizeof corners[0]; j++)
			TEST_ASSERT_TRUE(stretched_ggx_d(d, lobe_vec3_make(0.6f, 0.8f, corners[j])) == 0.0f);
		TEST_ASSERT_TRUE(lobe_ggx_density(lobe_vec3_make(0.0f, 0.0f, 0.0f)).inv > LOBE_REAL_MAX);
		for (uint64_t l = 0; l < 1000; l++) {
			const float v = stretched_ggx_d(d, direction(3, l));
			TEST_ASSERT_TRUE(v > 0.0f && v <= LOBE_REAL_MAX);
		}
	}
	/* Widths are clamped, and a NaN is kept. */
	TEST_ASSERT_TRUE(lobe_stretch_make(0.0f, 7.0f).alpha_x == 1e-4f &&
			 lobe_stretch_make(0.0f, 7.0f).alpha_y == 1.0f);
	TEST_ASSERT_TRUE(isnan(lobe_stretch_make(NAN, 0.5f).alpha_x) && lobe_stretch_make(NAN, 0.5f).alpha_y == 0.5f);
}

/* --- integrals of D ----------------------------------------------------------------------------------------------- */

static void test_normalisation(void)
{
	double worst = 0.0;
	for (size_t i = 0; i < WIDTHS; i++) {
		for (size_t j = 0; j < WIDTHS; j++) {
			const ggx_integral f = {
				lobe_stretch_make(widths[i], widths[j]), {0.0f, 0.0f, 1.0f}, ggx_weight_normal};
			worst = worse(worst, fabs(ggx_integrate(&f, 0.0, 1.0, 0.0, TWO_PI, 40) - 1.0));
		}
	}
	/* D is off by 21 U at worst; m is rounded to floats, which moves D z by 5 U. */
	measured("|integral of D cos - 1|", worst, 26.0 * U);
}

/* w stretched the other way, into the space of h: there visible means w'.h > 0. */
static ggx_vector unstretched(lobe_stretch d, lobe_vec3 w)
{
	const double x = (double)d.alpha_x * (double)w.x, y = (double)d.alpha_y * (double)w.y, z = (double)w.z;
	const double len = sqrt(x * x + y * y + z * z);
	const ggx_vector v = {x / len, y / len, z / len};
	return v;
}

static double visible_row(double z, void *parameters)
{
	const ggx_integral *f = parameters;
	const ggx_vector w = unstretched(f->d, f->w);
	/* On the circle of height z normals are visible within an angle of half around the azimuth of w. */
	const double s = sqrt((1.0 - z) * (1.0 + z)), r = sqrt(w.x * w.x + w.y * w.y);
	const double cosine = r * s > 0.0 ? -w.z * z / (r * s) : -1.0;
	const double half = cosine <= -1.0 ? PI : cosine >= 1.0 ? 0.0 : acos(cosine);
	const double middle = atan2(w.y, w.x);
	static gsl_integration_glfixed_table *rule = NULL;
	if (!rule)
		rule = gsl_integration_glfixed_table_alloc(32);
	double sum = 0.0;
	for (size_t j = 0; j < 32; j++) {
		double phi, weight;
		gsl_integration_glfixed_point(middle - half, middle + half, j, &phi, &weight, rule);
		sum += weight * ggx_integral_at(f, z, phi);
	}
	return sum;
}

static void test_projected_area(void)
{
	gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(200);
	const double cosines[] = {1e-6, 1e-3, 0.05, 0.3, 0.7, 0.99, 1.0};
	double worst = 0.0;
	for (size_t i = 0; i < WIDTHS; i++) {
		for (size_t j = 0; j < WIDTHS; j++) {
			for (size_t k = 0; k < sizeof cosines / sizeof cosines[0]; k++) {
				ggx_integral f = {lobe_stretch_make(widths[i], widths[j]),
						  direction_at(cosines[k], 0.7), ggx_weight_visible};
				gsl_function row;
				row.function = visible_row;
				row.params = &f;
				/* Below this height the circle is visible in part, above it as a whole. */
				const ggx_vector w = unstretched(f.d, f.w);
				const double split = sqrt(w.x * w.x + w.y * w.y);
				const double sigma = gsl_integration_glfixed(&row, 0.0, split, rule) +
						     gsl_integration_glfixed(&row, split, 1.0, rule);
				const double t = (double)stretched_ggx_t(f.d, f.w);
				worst = worse(worst, fabs(0.5 * ((double)f.w.z + t) / sigma - 1.0));
			}
		}
	}
	gsl_integration_glfixed_table_free(rule);
	/* D as above, 26 U; t 3 U; w.m in double. At split the rows have a square root, which n = 200 Gauss points
	 * integrate to about 1/n^3: 2 U. */
	measured("(z + t)/2 against the integral of max(0, w.m) D: relative", worst, 31.0 * U);
}

/* --- masking ------------------------------------------------------------------------------------------------------ */

/* Heitz 2014: Lambda = (sqrt(1 + a^2 tan^2) - 1)/2. */
static long double exact_lambda(float ax, float ay, lobe_vec3 w)
{
	const long double x = (long double)ax * (long double)w.x, y = (long double)ay * (long double)w.y,
			  z = (long double)w.z;
	return 0.5L * (sqrtl(1.0L + (x * x + y * y) / (z * z)) - 1.0L);
}

static float g1(lobe_stretch d, lobe_vec3 w)
{
	const float t = stretched_ggx_t(d, w);
	return (w.z + w.z) / (w.z + t);
}

/* Lambda as printed, in float: what the header avoids. */
static float g1_from_lambda(lobe_stretch d, lobe_vec3 w)
{
	const float x = d.alpha_x * w.x, y = d.alpha_y * w.y;
	const float tan2 = (x * x + y * y) / (w.z * w.z);
	return 0.5f * (lobe_sqrt(1.0f + tan2) - 1.0f);
}

static void test_masking(void)
{
	double worst_t = 0.0, worst_g1 = 0.0, worst_g2 = 0.0, excess = 0.0, worst_printed = 0.0;
	for (size_t i = 0; i < WIDTHS; i++) {
		for (size_t j = 0; j < WIDTHS; j++) {
			const float ax = widths[i], ay = widths[j];
			const lobe_stretch d = lobe_stretch_make(ax, ay);
			for (uint64_t l = 0; l < 8000; l++) {
				const lobe_vec3 o = direction(4, l), w = direction(5, l * 7 + 1);
				const long double lo = exact_lambda(ax, ay, o), li = exact_lambda(ax, ay, w);
				const long double t = (long double)o.z * (1.0L + 2.0L * lo);
				worst_t = worse(worst_t, fabs((double)(((long double)stretched_ggx_t(d, o) - t) / t)));
				worst_g1 = worse(worst_g1, fabs((double)((long double)g1(d, o) * (1.0L + lo) - 1.0L)));
				const float g2_over_cos =
					lobe_smith_g2_over_cos(o.z, stretched_ggx_t(d, o), w.z, stretched_ggx_t(d, w));
				const long double g2 = (long double)g2_over_cos * (long double)o.z;
				worst_g2 = worse(worst_g2, fabs((double)(g2 * (1.0L + lo + li) - 1.0L)));
				const double least = fmin((double)g1(d, o), (double)g1(d, w));
				excess = worse(excess, (double)g2 / least - 1.0);
				if (lo > 0.0L)
					worst_printed =
						worse(worst_printed,
						      fabs((double)((long double)g1_from_lambda(d, o) / lo - 1.0L)));
			}
		}
	}
	/* x and y carry 1 U, their squares 2 U, the sum 3 more; half of that, and the root's own: 3.5 U. Then z + t and
	 * the quotient: 5.5 U. G2: products with t 4.5 U and their sum, and the quotient: 6.5 U. */
	measured("t: relative", worst_t, 3.6 * U);
	measured("G1 = 2z/(z + t) against 1/(1 + Lambda): relative", worst_g1, 5.6 * U);
	measured("G2 against 1/(1 + Lambda_o + Lambda_i): relative", worst_g2, 6.6 * U);
	measured("G2/min(G1) - 1", excess, 12.2 * U);
	printf("  %-60s %11.4g\n", "Lambda as printed, in float: relative", worst_printed);
	TEST_ASSERT_TRUE(worst_printed > 0.5);
}

/* GGX of any width is the one of width 1, stretched (Heitz 2014, section 5.3). */
static void test_stretch_invariance(void)
{
	const lobe_stretch one = lobe_stretch_make(1.0f, 1.0f);
	double worst_d = 0.0, worst_t = 0.0, worst_sample = 0.0;
	for (size_t i = 0; i < WIDTHS; i++) {
		for (size_t j = 0; j < WIDTHS; j++) {
			const lobe_stretch d = lobe_stretch_make(widths[i], widths[j]);
			for (uint64_t l = 0; l < 4000; l++) {
				const lobe_vec3 w = direction(6, l);
				/* D_M(m) = D(m')/(ax ay |M^T m|^4) with m' = M^T m = (x/ax, y/ay, z), normalised. */
				const double x = (double)w.x / (double)widths[i], y = (double)w.y / (double)widths[j];
				const double len2 = x * x + y * y + (double)w.z * (double)w.z, len = sqrt(len2);
				const lobe_vec3 m = {(float)(x / len), (float)(y / len), (float)((double)w.z / len)};
				const double e = (double)stretched_ggx_d(one, m) /
						 ((double)widths[i] * (double)widths[j] * len2 * len2);
				/* Underflow of m.z in the stretched space says nothing. */
				if (m.z > 0.0f)
					worst_d = worse(worst_d, fabs((double)stretched_ggx_d(d, w) / e - 1.0));
				/* t is the length of the other stretch, and 1 for the unit vector along it. */
				const ggx_vector v = unstretched(d, w);
				const lobe_vec3 o = {(float)v.x, (float)v.y, (float)v.z};
				worst_t = worse(worst_t, fabs((double)stretched_ggx_t(one, o) - 1.0));
				/* The same u picks the same facet. */
				const lobe_vec2 u = {test_uniform(7, 2 * l), test_uniform(7, 2 * l + 1)};
				const float t_a = stretched_ggx_t(d, w), t_b = stretched_ggx_t(one, o);
				const lobe_vec3 a = stretched_ggx_visible(d, w, t_a, u);
				const lobe_vec3 b = stretched_ggx_visible(one, o, t_b, u);
				const double of_a = 1.0 / (double)t_a, of_b = 1.0 / (double)t_b;
				const double ax = (double)a.x * of_a / (double)widths[i],
					     ay = (double)a.y * of_a / (double)widths[j];
				worst_sample = worse(worst_sample, fabs(ax - (double)b.x * of_b));
				worst_sample = worse(worst_sample, fabs(ay - (double)b.y * of_b));
				worst_sample = worse(worst_sample, fabs((double)a.z * of_a - (double)b.z * of_b));
			}
		}
	}
	/* Two evaluations of D of 21 U, and the components of m rounded once: 4 U. */
	measured("D(ax, ay) against D(1, 1) stretched: relative", worst_d, 46.0 * U);
	measured("t of the unit vector in the space of width 1, - 1", worst_t, 4.6 * U);
	/* Both samples are sums of c, which moves with the height (7 U, and s by the root of that near the rim: the
	 * cap's radius is sqrt(h (2 - h)) with 2 - h down to 2^-23), and w'. */
	measured("sample(ax, ay) against sample(1, 1) stretched", worst_sample, 2.0 * sqrt(7.0 * U));
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_d);
	RUN_TEST(test_d_peak);
	RUN_TEST(test_d_domain);
	RUN_TEST(test_normalisation);
	RUN_TEST(test_projected_area);
	RUN_TEST(test_masking);
	RUN_TEST(test_stretch_invariance);
	return UNITY_END();
}
