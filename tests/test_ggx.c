/* test_ggx.c - microfacet/ggx.h: the distribution, its projected area and masking, and visible-normal sampling. */
#include "stretched_ggx.h"

#include "chi_square.h"
#include "directions.h"
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

typedef struct {
	double x, y, z;
} vec;

/* A normal of the surface from one of the unit hemisphere that is stretched onto it, and the ratio of their solid
 * angles: m = M h/|M h| with M = diag(ax, ay, 1), dm/dh = det M/|M h|^3. However narrow D is, it is smooth in h. */
static lobe_vec3 stretched(lobe_stretch d, vec h, double *jacobian)
{
	const double ax = (double)d.alpha_x, ay = (double)d.alpha_y;
	const double x = ax * h.x, y = ay * h.y, len = sqrt(x * x + y * y + h.z * h.z);
	*jacobian = ax * ay / (len * len * len);
	return lobe_vec3_make((float)(x / len), (float)(y / len), (float)(h.z / len));
}

/* What is integrated: D(m) times cos of m and w. */
typedef struct {
	lobe_stretch d;
	lobe_vec3 w;
	double (*weight)(lobe_vec3 w, lobe_vec3 m);
} integrand;

static double weight_normal(lobe_vec3 w, lobe_vec3 m)
{
	(void)w;
	return (double)m.z;
}

static double weight_visible(lobe_vec3 w, lobe_vec3 m)
{
	const double c = (double)w.x * (double)m.x + (double)w.y * (double)m.y + (double)w.z * (double)m.z;
	return c > 0.0 ? c : 0.0;
}

static double integrand_at(const integrand *f, double z, double phi)
{
	const double s = sqrt((1.0 - z) * (1.0 + z));
	const vec h = {s * cos(phi), s * sin(phi), z};
	double jacobian;
	const lobe_vec3 m = stretched(f->d, h, &jacobian);
	return f->weight(f->w, m) * (double)stretched_ggx_d(f->d, m) * jacobian;
}

/* Over z0..z1 and phi0..phi1 of h, n Gauss points each way. */
static double integrate(const integrand *f, double z0, double z1, double phi0, double phi1, size_t n)
{
	gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(n);
	double sum = 0.0;
	for (size_t i = 0; i < n; i++) {
		double z, z_weight;
		gsl_integration_glfixed_point(z0, z1, i, &z, &z_weight, rule);
		for (size_t j = 0; j < n; j++) {
			double phi, phi_weight;
			gsl_integration_glfixed_point(phi0, phi1, j, &phi, &phi_weight, rule);
			sum += z_weight * phi_weight * integrand_at(f, z, phi);
		}
	}
	gsl_integration_glfixed_table_free(rule);
	return sum;
}

static void test_normalisation(void)
{
	double worst = 0.0;
	for (size_t i = 0; i < WIDTHS; i++) {
		for (size_t j = 0; j < WIDTHS; j++) {
			const integrand f = {
				lobe_stretch_make(widths[i], widths[j]), {0.0f, 0.0f, 1.0f}, weight_normal};
			worst = worse(worst, fabs(integrate(&f, 0.0, 1.0, 0.0, TWO_PI, 40) - 1.0));
		}
	}
	/* D is off by 21 U at worst; m is rounded to floats, which moves D z by 5 U. */
	measured("|integral of D cos - 1|", worst, 26.0 * U);
}

/* w stretched the other way, into the space of h: there visible means w'.h > 0. */
static vec unstretched(lobe_stretch d, lobe_vec3 w)
{
	const double x = (double)d.alpha_x * (double)w.x, y = (double)d.alpha_y * (double)w.y, z = (double)w.z;
	const double len = sqrt(x * x + y * y + z * z);
	const vec v = {x / len, y / len, z / len};
	return v;
}

static double visible_row(double z, void *parameters)
{
	const integrand *f = parameters;
	const vec w = unstretched(f->d, f->w);
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
		sum += weight * integrand_at(f, z, phi);
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
				integrand f = {lobe_stretch_make(widths[i], widths[j]), direction_at(cosines[k], 0.7),
					       weight_visible};
				gsl_function row;
				row.function = visible_row;
				row.params = &f;
				/* Below this height the circle is visible in part, above it as a whole. */
				const vec w = unstretched(f.d, f.w);
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
				const vec v = unstretched(d, w);
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

/* --- visible normals ---------------------------------------------------------------------------------------------- */

/* The last cells of u.y on the side where the cap's point and v add up: slopes of the visible normals against the cap
 * in long double. Planted: the point's distance from the axis as the root of h (2 t - h). */
static void test_visible_far_end(void)
{
	double off = 0.0, planted = 0.0;
	for (size_t k = 0; k < WIDTHS; k++)
		for (int angle = 1; angle < 90; angle++)
			for (uint32_t i = 1; i <= 64u; i++) {
				const double theta = (double)angle * PI / 180.0;
				const lobe_vec3 v =
					lobe_vec3_make(widths[k] * (float)sin(theta), 0.0f, (float)cos(theta));
				const lobe_vec2 u = lobe_vec2_make(0.0f, 1.0f - (float)i * (float)U);
				const long double x = (long double)v.x, z = (long double)v.z, t = sqrtl(x * x + z * z);
				const long double rest = (1.0L - (long double)u.y) * (t + z), h = t + z - rest;
				const long double exact = (x + sqrtl(h * (t - z + rest))) / rest;
				const lobe_vec3 m = lobe_ggx_visible_above(v, lobe_ggx_t(v), u);
				const float rounded = u.y * (v.z + lobe_ggx_t(v)),
					    two_t = lobe_ggx_t(v) + lobe_ggx_t(v);
				const float s = sqrtf(fmaxf(rounded * (two_t - rounded), 0.0f));
				off = worse(off, fabs((double)m.x / (double)m.z / (double)exact - 1.0));
				planted = worse(planted, fabs((double)(v.x + s) / (double)m.z / (double)exact - 1.0));
			}
	/* z is off by 3 U and s by 4 U, x by one more. */
	measured("visible normal, last cells: slope, relative", off, 8.0 * U);
	TEST_ASSERT_TRUE(planted > 0.05);
}

#define SAMPLES  1000000u
#define Z_BINS   16
#define PHI_BINS 24

typedef lobe_vec3 (*sampler)(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u);

/* Planted: the cap reaches down to +w'.z in place of -w'.z. */
static lobe_vec3 sample_wrong_height(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u)
{
	const float height = 1.0f - w.z / t;
	const lobe_vec3 c = lobe_spherical_cap(u, height);
	return lobe_vec3_make(d.alpha_x * (c.x + d.alpha_x * w.x / t), d.alpha_y * (c.y + d.alpha_y * w.y / t),
			      c.z + w.z / t);
}

/* Planted, and harder to see: w is stretched by a width that is 3 % off. */
static lobe_vec3 sample_wrong_width(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u)
{
	lobe_stretch wide = d;
	(void)t;
	wide.alpha_x *= 1.03f;
	return stretched_ggx_visible(wide, w, stretched_ggx_t(wide, w), u);
}

/* Chi-square of the normals in the space of h, where cells of equal size suit every width, with D and w.m of the header
 * and the normalisation sigma = (z + t)/2. */
static double visible_p_value(sampler sample, lobe_stretch d, lobe_vec3 w, uint32_t stream)
{
	static uint32_t count[Z_BINS * PHI_BINS];
	static double probability[Z_BINS * PHI_BINS];
	const integrand f = {d, w, weight_visible};
	const float t = stretched_ggx_t(d, w);
	const double sigma = 0.5 * ((double)w.z + (double)t);
	for (int i = 0; i < Z_BINS * PHI_BINS; i++) {
		const double z = (double)(i / PHI_BINS) / Z_BINS, phi = TWO_PI * (i % PHI_BINS) / PHI_BINS;
		count[i] = 0;
		probability[i] = integrate(&f, z, z + 1.0 / Z_BINS, phi, phi + TWO_PI / PHI_BINS, 16) / sigma;
	}
	for (uint64_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec3 m = sample(d, w, t, lobe_vec2_make(u[0], u[1]));
		const double x = (double)m.x / (double)d.alpha_x, y = (double)m.y / (double)d.alpha_y, z = (double)m.z;
		double turns = atan2(y, x) / TWO_PI;
		turns -= floor(turns);
		int row = (int)(z / sqrt(x * x + y * y + z * z) * Z_BINS), phi = (int)(turns * PHI_BINS);
		row = row < 0 ? 0 : row >= Z_BINS ? Z_BINS - 1 : row;
		phi = phi >= PHI_BINS ? PHI_BINS - 1 : phi;
		count[row * PHI_BINS + phi]++;
	}
	return chi_square_of(probability, count, Z_BINS * PHI_BINS).p;
}

static void test_visible_chi_square(void)
{
	static const struct {
		float ax, ay;
		double cosine, phi;
	} cases[] = {
		{1.0f, 1.0f, 1.0, 0.0},    {1.0f, 1.0f, 0.5, 1.0},    {1.0f, 1.0f, 1e-3, 2.0},
		{0.3f, 0.3f, 0.7, 4.0},    {0.3f, 0.3f, 1e-3, 5.0},   {0.1f, 0.1f, 0.2, 0.3},
		{0.01f, 0.01f, 0.9, 3.0},  {0.01f, 0.01f, 1e-3, 3.5}, {1e-4f, 1e-4f, 0.3, 2.2},
		{1e-4f, 1e-4f, 1e-6, 0.1}, {0.5f, 0.05f, 0.6, 0.9},   {0.05f, 0.5f, 1e-3, 1.2},
		{1e-4f, 1.0f, 0.4, 1.5},   {1.0f, 1e-4f, 1e-3, 0.2},  {0.8f, 0.3f, 1e-6, 2.8},
	};
	const size_t n = sizeof cases / sizeof cases[0];
	/* Sidak: all cases together reject a right sampler in 1 of 100 sets of random numbers (ours are fixed). */
	const double level = 1.0 - pow(0.99, 1.0 / (double)n);
	for (size_t i = 0; i < n; i++) {
		const lobe_stretch d = lobe_stretch_make(cases[i].ax, cases[i].ay);
		const lobe_vec3 w = direction_at(cases[i].cosine, cases[i].phi);
		const double p = visible_p_value(stretched_ggx_visible, d, w, 10 + (uint32_t)i);
		printf("  alpha %-6g %-6g cos %-6g p = %8.3g   level %.3g\n", (double)cases[i].ax, (double)cases[i].ay,
		       cases[i].cosine, p, level);
		if (p <= level)
			measured("the chi-square p of that case, negated", -p, -level);
	}
	const lobe_stretch d = lobe_stretch_make(0.5f, 0.05f);
	const lobe_vec3 w = direction_at(0.6, 0.9);
	const double height = visible_p_value(sample_wrong_height, d, w, 10),
		     width = visible_p_value(sample_wrong_width, d, w, 10);
	printf("  planted: height 1 - w'.z p = %.3g, width 3 %% off p = %.3g\n", height, width);
	TEST_ASSERT_TRUE_MESSAGE(height <= level, "the planted height was not caught");
	TEST_ASSERT_TRUE_MESSAGE(width <= level, "the planted width was not caught");
}

/* Every u and w, the extreme ones above all: m.z > 0, and the length can be divided by. */
static void test_visible_extremes(void)
{
	static const float corner[] = {0.0f, 0x1p-149f, 0x1p-24f,       0.25f,         0x1.fffffep-2f,
				       0.5f, 0.75f,     0x1.fffffcp-1f, 0x1.fffffep-1f};
	static const double cosines[] = {1e-6, 1e-5, 1e-3, 0.1, 0.5, 1.0 - 0x1p-24, 1.0};
	static const double azimuths[] = {0.0, 0.785398, 1.5707963, 3.14159265, 4.712389, 5.5};
	const size_t corners = sizeof corner / sizeof corner[0];
	double lowest = 1.0, shortest = 10.0, hidden = 0.0;
	uint32_t bad = 0;
	for (size_t i = 0; i < WIDTHS * WIDTHS; i++) {
		const lobe_stretch d = lobe_stretch_make(widths[i / WIDTHS], widths[i % WIDTHS]);
		for (size_t j = 0; j < 7 * 6; j++) {
			lobe_vec3 w = direction_at(cosines[j / 6], azimuths[j % 6]);
			for (int k = 0; k < 2; k++) {
				const float t = stretched_ggx_t(d, w);
				for (uint64_t l = 0; l < corners * corners + 200; l++) {
					/* Near the rim of the cap as well, where the normal is shortest. */
					lobe_vec2 u = {corner[l % corners], corner[l / corners % corners]};
					if (l >= corners * corners)
						u = lobe_vec2_make(test_uniform(30, l),
								   l & 1 ? 0x1.fffffep-1f : test_uniform(31, l));
					const lobe_vec3 m = stretched_ggx_visible(d, w, t, u);
					const lobe_vec3 n = lobe_normalize(m);
					const double len = sqrt((double)m.x * (double)m.x + (double)m.y * (double)m.y +
								(double)m.z * (double)m.z);
					const double c = (double)w.x * (double)m.x + (double)w.y * (double)m.y +
							 (double)w.z * (double)m.z;
					if (!(m.z > 0.0f && len < 10.0 && fabs((double)lobe_dot(n, n) - 1.0) < 1e-6)) {
						if (bad++ < 4)
							printf("  alpha %g %g w %a %a %a u %a %a: m %g %g %g\n",
							       (double)d.alpha_x, (double)d.alpha_y, (double)w.x,
							       (double)w.y, (double)w.z, (double)u.x, (double)u.y,
							       (double)m.x, (double)m.y, (double)m.z);
						continue;
					}
					lowest = fmin(lowest, (double)m.z / (double)t);
					shortest = fmin(shortest, len);
					hidden = larger(hidden, -c / len);
				}
				/* An upward direction that normalising has left an ulp too long. */
				w = lobe_vec3_scale(w, 1.0f + 0x1p-23f);
			}
		}
	}
	measured("visible normals not finite, not up, or not to be normalised", bad, 0.0);
	/* (1 - u.y)(1 + w'.z) with u.y at most 1 - 2^-24. */
	measured("2^-24 - lowest m.z", U - lowest, 0.0);
	printf("  %-60s %11.4g\n", "shortest m", shortest);
	/* lobe_normalize is good from 1e-18 on. */
	measured("1e-18 / shortest m", 1e-18 / shortest, 1.0);
	printf("  %-60s %11.4g\n", "largest -w.m/|m| (0: all are visible)", hidden);
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
	RUN_TEST(test_visible_chi_square);
	RUN_TEST(test_visible_extremes);
	RUN_TEST(test_visible_far_end);
	return UNITY_END();
}
