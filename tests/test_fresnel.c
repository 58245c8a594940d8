/* test_fresnel.c - dielectrics and refraction of core/fresnel.h against MPFR, and how far Schlick's curve is from
 * them. */
#include "lobe/core/fresnel.h"
#include "lobe/core/fresnel_schlick.h"

#include "directions.h"
#include "fresnel_exact.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- dielectric --------------------------------------------------------------------------------------------------- */

enum { INDICES = 260 };

/* From 1/1000 to 1000, 1 +- 2^-k, 1. */
static float index_of(int i)
{
	if (i < 200)
		return (float)pow(10.0, 3.0 * (i - 100) / 100.0);
	if (i < 225)
		return (float)(1.0 + ldexp(1.0, -(i - 200 + 1) > -23 ? -(i - 200 + 1) : -23));
	if (i < 250)
		return (float)(1.0 - ldexp(1.0, -(i - 225 + 1) > -24 ? -(i - 225 + 1) : -24));
	const float common[] = {1.0f, 1.33f, 1.5f, 1.0f / 1.33f, 1.0f / 1.5f, 2.42f, 4.0f, 0.25f, 0.001f, 1000.0f};
	return common[i - 250];
}

/* Into a denser medium nothing is ill conditioned but Brewster's zero. Bounds to first order in U, with every rounding
 * at its worst: k 3, g^2 4, g 3, A and B 4, products with their reciprocal 7, so r_s 19 and r_s^2 38. The two terms of
 * F are added with their own rounding: 40. In r_p the factor c A - 1 is off by 5 U c A + 1 U, absolute, which counts
 * where that factor is small; AM-GM bounds its share of F by its ratio to r_s. 1 - F is a sum of positive terms: g 3,
 * eta^2 and products 4, squares 14, with their sum 22. */
static void test_dielectric_denser(void)
{
	worst refl = {0}, refl_brewster = {0}, trans = {0}, cos_t = {0}, sum = {0};
	for (int i = 0; i < INDICES; i++) {
		const float eta = index_of(i);
		if (eta <= 1.0f)
			continue;
		for (int j = 0; j < COSINES; j++) {
			const float c = cosine(j);
			const exact_fresnel e = exact_dielectric(c, eta);
			const lobe_fresnel f = lobe_fresnel_dielectric(c, eta);
			const double error = fabs((double)f.reflectance - e.reflectance);
			/* Brewster's zero: the p part is less than 1 % of the s part. */
			if (e.rp * e.rp > 0.02 * e.reflectance)
				keep_worst(&refl, error / e.reflectance, c, eta);
			else
				keep_worst(&refl_brewster, error / e.reflectance, c, eta);
			keep_worst(&trans, fabs((double)f.transmittance - e.transmittance) / e.transmittance, c, eta);
			keep_worst(&cos_t, fabs((double)f.cos_t - e.cos_t) / e.cos_t, c, eta);
			keep_worst(&sum, fabs((double)f.reflectance + (double)f.transmittance - 1.0), c, eta);
		}
	}
	measured_at("eta > 1: R relative", refl, 60.0 * U);
	measured_at("eta > 1: R relative near Brewster's zero", refl_brewster, 60.0 * U);
	measured_at("eta > 1: 1-R relative", trans, 22.0 * U);
	measured_at("eta > 1: cos_t relative", cos_t, 4.0 * U);
	/* R and T are off by their own errors, of which the larger part counts. */
	measured_at("eta > 1: R + T - 1", sum, 40.0 * U);
}

/* Into a thinner medium g^2 = c^2 - (1 - eta^2) = eta^2 - s^2 cancels towards the edge of total reflection. A rounding
 * of (1 - eta^2) or of s^2, whichever is smaller, cannot be had for less than 3 U: half of that over g^2 is what the
 * edge adds to the relative errors of g, of cos_t and of T (whose logarithm moves by at most as much as that of g). F
 * moves with T. */
static double edge_rounding(float eta)
{
	const double e = (double)eta;
	return e < 1.0 ? 3.0 * U * fmin((1.0 - e) * (1.0 + e), e * e) : 0.0;
}

static double edge_adds(float eta, exact_fresnel e) { return edge_rounding(eta) / (2.0 * e.edge); }

static double beyond(double error, double allowed) { return error > allowed ? error - allowed : 0.0; }

static void test_dielectric_thinner(void)
{
	worst refl = {0}, refl_brewster = {0}, trans = {0}, cos_t = {0}, sum = {0};
	uint32_t wrong_side = 0;
	for (int i = 0; i < INDICES; i++) {
		const float eta = index_of(i);
		if (eta >= 1.0f)
			continue;
		const double k = (1.0 - (double)eta) * (1.0 + (double)eta);
		for (int j = 0; j < COSINES; j++) {
			/* Half of the cosines where anything is refracted at all. */
			const float c = j & 1 ? cosine(j) : (float)sqrt(k + (1.0 - k) * (double)cosine(j));
			const exact_fresnel e = exact_dielectric(c, eta);
			const lobe_fresnel f = lobe_fresnel_dielectric(c, eta);
			keep_worst(&sum, fabs((double)f.reflectance + (double)f.transmittance - 1.0), c, eta);
			if (fabs(e.edge) <= 2.0 * edge_rounding(eta))
				continue; /* either side of the edge may be had */
			if (e.edge < 0.0) {
				wrong_side += !(f.reflectance == 1.0f && f.transmittance == 0.0f && f.cos_t == 0.0f);
				continue;
			}
			/* To second order too: g^2 is at least half of itself here. */
			const double adds = 2.0 * edge_adds(eta, e), share = e.transmittance / e.reflectance;
			const double error = fabs((double)f.reflectance - e.reflectance) / e.reflectance;
			worst *which = e.rp * e.rp > 0.02 * e.reflectance ? &refl : &refl_brewster;
			keep_worst(which, beyond(error, adds * share), c, eta);
			keep_worst(&trans, beyond(fabs((double)f.transmittance / e.transmittance - 1.0), adds), c, eta);
			keep_worst(&cos_t, beyond(fabs((double)f.cos_t / e.cos_t - 1.0), adds), c, eta);
		}
	}
	measured_at("eta < 1: R relative, beyond what the edge adds", refl, 60.0 * U);
	measured_at("eta < 1: R near Brewster's zero, beyond the edge", refl_brewster, 60.0 * U);
	measured_at("eta < 1: 1-R relative, beyond what the edge adds", trans, 22.0 * U);
	measured_at("eta < 1: cos_t relative, beyond what the edge adds", cos_t, 4.0 * U);
	/* With g off by d the sum is off by 4 g (c - g)/(c + g)^3 d for the s part, 6 U at most, and the like for the p
	 * part: the edge adds next to nothing here. */
	measured_at("eta < 1: R + T - 1", sum, 52.0 * U);
	measured("eta < 1: total reflection missed", wrong_side, 0.0);
}

/* Where r_p vanishes only an absolute error says anything. */
static void test_brewster(void)
{
	worst absolute = {0}, relative = {0};
	const float etas[] = {0.01f, 0.25f, 1.0f / 1.5f, 0.9f, 0.999f, 1.001f, 1.1f, 1.33f, 1.5f, 2.42f, 4.0f, 100.0f};
	for (size_t i = 0; i < sizeof etas / sizeof etas[0]; i++) {
		/* tan of Brewster's angle is eta. */
		const double eta = (double)etas[i], at = 1.0 / sqrt(1.0 + eta * eta);
		for (int j = -2000; j <= 2000; j++) {
			const float c = (float)(at * (1.0 + j * U));
			const exact_fresnel e = exact_dielectric(c, etas[i]);
			if (e.edge <= 2.0 * edge_rounding(etas[i]))
				continue;
			const float got = lobe_fresnel_dielectric(c, etas[i]).reflectance;
			/* Far below 1 Brewster's angle comes close to that of total reflection. */
			const double adds = 2.0 * edge_adds(etas[i], e) * e.transmittance;
			const double error = beyond(fabs((double)got - e.reflectance), adds);
			keep_worst(&absolute, error, c, etas[i]);
			keep_worst(&relative, error / e.reflectance, c, etas[i]);
		}
	}
	measured_at("Brewster: R absolute", absolute, 40.0 * U);
	measured_at("Brewster: R relative (of r_s^2/2, as r_p is 0)", relative, 60.0 * U);
}

static void test_total_reflection_edge(void)
{
	/* The last cosine that is reflected and the first that is not, found by bisection on floats. */
	const float etas[] = {0.001f, 0.1f, 1.0f / 1.5f, 1.0f / 1.33f, 0.9f, 0.9999f, 0x1.fffffep-1f};
	worst off = {0}, sum = {0};
	for (size_t i = 0; i < sizeof etas / sizeof etas[0]; i++) {
		float total = 0.0f, refracted = 1.0f;
		for (;;) {
			const float middle = 0.5f * (total + refracted);
			if (middle <= total || middle >= refracted)
				break;
			if (lobe_fresnel_dielectric(middle, etas[i]).transmittance > 0.0f)
				refracted = middle;
			else
				total = middle;
		}
		const double eta = (double)etas[i], at = sqrt((1.0 - eta) * (1.0 + eta));
		keep_worst(&off, fabs((double)refracted - at) / at, refracted, etas[i]);
		const lobe_fresnel f = lobe_fresnel_dielectric(refracted, etas[i]),
				   below = lobe_fresnel_dielectric(total, etas[i]);
		keep_worst(&sum, fabs((double)f.reflectance + (double)f.transmittance - 1.0), refracted, etas[i]);
		TEST_ASSERT_TRUE(below.reflectance == 1.0f && below.transmittance == 0.0f && below.cos_t == 0.0f);
	}
	/* k is off by 3 U, its root by half of that; c is a float: 1 U, and the next float on may be the first: 2 U. */
	measured_at("edge of total reflection: c relative", off, 3.6 * U);
	measured_at("edge of total reflection: R + T - 1", sum, 52.0 * U);
}

static void test_no_interface(void)
{
	uint32_t reflects = 0, lacks = 0, bends = 0;
	float lacks_at = 0.0f, least = 1.0f;
	for (int i = 0; i < 100000; i++) {
		const float c = i < COSINES ? cosine(i) : i == COSINES ? 0.0f : test_uniform(1, (uint64_t)i);
		const lobe_fresnel f = lobe_fresnel_dielectric(c, 1.0f);
		reflects += f.reflectance != 0.0f;
		bends += fabs((double)f.cos_t - (double)c) > 2.0 * U * (double)c + 0x1p-40;
		if (f.transmittance != 1.0f) {
			lacks++;
			if (f.transmittance < least) {
				least = f.transmittance;
				lacks_at = c;
			}
		}
	}
	if (lacks)
		printf("  T(%a, 1) = 1 - %g\n", (double)lacks_at, 1.0 - (double)least);
	measured("eta = 1: cosines with R other than 0", reflects, 0.0);
	measured("eta = 1: cosines with T other than 1", lacks, 0.0);
	measured("eta = 1: cosines with cos_t other than c", bends, 0.0);
}

static void test_dielectric_range(void)
{
	const float cs[] = {0.0f, 0x1p-149f, 1e-38f, 1e-20f, 0x1p-40f, 1e-7f, 0.5f, 0x1.fffffep-1f, 1.0f};
	worst cos_t = {0};
	for (size_t j = 0; j < sizeof cs / sizeof cs[0]; j++) {
		for (int i = 0; i < INDICES; i++) {
			const lobe_fresnel f = lobe_fresnel_dielectric(cs[j], index_of(i));
			TEST_ASSERT_TRUE(f.reflectance >= 0.0f && f.reflectance <= 1.0f);
			TEST_ASSERT_TRUE(f.transmittance >= 0.0f && f.transmittance <= 1.0f);
			TEST_ASSERT_TRUE(f.cos_t >= 0.0f);
			keep_worst(&cos_t, (double)f.cos_t - 1.0, cs[j], index_of(i));
		}
	}
	measured_at("cos_t - 1", cos_t, 4.0 * U);
}

/* The bounds above must mean something: the formula with eta*eta - 1 and without factors, in float, breaks them. */
static void test_dielectric_planted(void)
{
	worst w = {0};
	for (int i = 200; i < 225; i++) {
		for (int j = 0; j < COSINES; j++) {
			const float c = cosine(j), eta = index_of(i);
			const float g = lobe_sqrt(eta * eta - 1.0f + c * c);
			const float rs = (c - g) / (c + g), rp = (eta * eta * c - g) / (eta * eta * c + g);
			const exact_fresnel e = exact_dielectric(c, eta);
			keep_worst(&w, fabs((double)(0.5f * (rs * rs + rp * rp)) - e.reflectance) / e.reflectance, c,
				   eta);
		}
	}
	printf("  %-60s %11.4g\n", "textbook form in float near eta = 1: R relative", w.value);
	TEST_ASSERT_TRUE(w.value > 0.01);
}

/* --- refraction --------------------------------------------------------------------------------------------------- */

typedef struct {
	double x, y, z;
} vec;

static vec to_double(lobe_vec3 v)
{
	const vec d = {(double)v.x, (double)v.y, (double)v.z};
	return d;
}

static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static vec cross(vec a, vec b)
{
	const vec c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
	return c;
}

static vec combine(double s, vec a, double t, vec b)
{
	const vec c = {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
	return c;
}

static double length(vec a) { return sqrt(dot(a, a)); }

#define RAYS 400000

/* Number i of many w and m with w.m > 0, and an index; some nearly parallel, some grazing. */
typedef struct {
	lobe_vec3 w, m;
	float c, eta;
} ray;

static int make_ray(uint64_t i, ray *r)
{
	const double bend = pow(10.0, -4.0 * (double)test_uniform(12, i));
	r->m = random_direction(10, i);
	lobe_vec3 w = random_direction(11, i);
	if (i % 3 == 1) /* close to m */
		w = lobe_normalize(lobe_vec3_fma((float)bend, w, r->m));
	if (i % 3 == 2) /* close to the surface */
		w = lobe_normalize(lobe_vec3_fma(lobe_dot(w, r->m) * ((float)bend - 1.0f), r->m, w));
	if (lobe_dot(w, r->m) < 0.0f)
		w = lobe_vec3_scale(w, -1.0f);
	r->w = w;
	r->c = lobe_dot(w, r->m);
	r->eta = i % 5 == 0 ? index_of((int)(i / 5 % INDICES))
			    : (float)pow(4.0, 2.0 * (double)test_uniform(13, i) - 1.0);
	return r->c > 0.0f;
}

/* w and m are unit to rounding: |w|^2 and |m|^2 are off by 2 U or so (up to 9 U from lobe_normalize), c by 3 U. Divided
 *by eta, whatever that leaves in w + (g - c) m grows by 1/eta, its square by 1/eta^2, into a thinner medium; into a
 *denser one g - c is up to eta and carries the errors of m. So all errors here are in units of U max(1, 1/eta)^2: unit
 *length: (9 + 2*3 + 9 + 2*7)/2 of those and the last two roundings, 3: 22 in-plane, Snell: t is a combination of w and
 *m up to its own rounding, 3 U in each component of length up to 1, and of 1/eta: 3 + 2 */
static void test_refract(void)
{
	worst unit = {0}, plane = {0}, snell = {0}, side = {0}, cosine_error = {0};
	for (uint64_t i = 0; i < RAYS; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		const lobe_fresnel f = lobe_fresnel_dielectric(r.c, r.eta);
		if (!(f.transmittance > 0.0f))
			continue;
		const vec w = to_double(r.w), m = to_double(r.m);
		const vec t = to_double(lobe_refract(r.w, r.m, 1.0f / r.eta, f));
		const double eta = (double)r.eta, scale = larger(1.0, 1.0 / eta), square = scale * scale;
		keep_worst(&unit, fabs(length(t) - 1.0) / square, r.c, r.eta);
		/* The part of t out of the plane of w and m, where there is a plane. */
		const vec normal = cross(w, m);
		if (length(normal) > 1e-3)
			keep_worst(&plane, fabs(dot(t, normal)) / length(normal) / scale, r.c, r.eta);
		/* w x m = eta (m x t): sines on one side eta times those on the other, and of opposite direction. */
		const vec difference = combine(1.0, normal, -eta, cross(m, t));
		keep_worst(&snell, length(difference) / eta / scale, r.c, r.eta);
		keep_worst(&side, dot(t, m), r.c, r.eta);
		keep_worst(&cosine_error, fabs(-dot(t, m) - (double)f.cos_t) / square, r.c, r.eta);
	}
	measured_at("refract: | |t| - 1 | / max(1, 1/eta)^2", unit, 22.0 * U);
	measured_at("refract: out of the plane / max(1, 1/eta)", plane, 5.0 * U);
	measured_at("refract: Snell / max(1, 1/eta)", snell, 6.0 * U);
	measured_at("refract: |t.m + cos_t| / max(1, 1/eta)^2", cosine_error, 22.0 * U);
	/* Beyond the surface, up to the rounding of a grazing direction. */
	measured_at("refract: t.m", side, 0.0);
}

static void test_refract_straight(void)
{
	double worst_near = 0.0;
	for (uint64_t i = 0; i < 100000; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		lobe_vec3 t = lobe_refract(r.w, r.m, 1.0f, lobe_fresnel_dielectric(r.c, 1.0f));
		TEST_ASSERT_TRUE(t.x == -r.w.x && t.y == -r.w.y && t.z == -r.w.z);
		/* Near eta = 1 t turns from -w by (eta - 1) tan theta: no jump, and no loss of the small angle. */
		if (r.c > 0.1f) {
			const float eta = 1.0f + 0x1p-20f;
			t = lobe_refract(r.w, r.m, 1.0f / eta, lobe_fresnel_dielectric(r.c, eta));
			const double sine = length(cross(to_double(r.w), to_double(r.m)));
			const double turned = length(cross(to_double(t), to_double(r.w)));
			worst_near = larger(worst_near, fabs(turned - 0x1p-20 * sine / (double)r.c));
		}
	}
	/* Three components with 3 roundings of numbers up to 1. */
	measured("refract: turning by (eta-1) tan theta at 1 + 2^-20", worst_near, 3.0 * U);
}

/* Back from the other side, with 1/eta, the ray comes out where it came from. */
static void test_refract_round_trip(void)
{
	worst back = {0}, fresnel = {0};
	for (uint64_t i = 0; i < RAYS; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		const lobe_fresnel f = lobe_fresnel_dielectric(r.c, r.eta);
		if (f.cos_t < 0.01f || r.c < 0.01f)
			continue;
		const lobe_vec3 t = lobe_refract(r.w, r.m, 1.0f / r.eta, f);
		const lobe_vec3 m = lobe_vec3_scale(r.m, -1.0f);
		const float c = lobe_dot(t, m), eta = 1.0f / r.eta;
		const lobe_fresnel g = lobe_fresnel_dielectric(c, eta);
		const lobe_vec3 w = lobe_refract(t, m, 1.0f / eta, g);
		const double scale = larger((double)r.eta, 1.0 / (double)r.eta);
		/* An error e of c or eta moves the cosine on the other side by e over that cosine. */
		const double sharp = fmin((double)r.c, (double)f.cos_t);
		keep_worst(&back, length(combine(1.0, to_double(w), -1.0, to_double(r.w))) * sharp / (scale * scale),
			   r.c, r.eta);
		/* R is the same from both sides. */
		keep_worst(&fresnel,
			   fabs((double)g.reflectance - (double)f.reflectance) * sharp * sharp / (scale * scale), r.c,
			   r.eta);
	}
	/* Twice the errors of one refraction in length and cosine (22 each), and 1/eta rounded. */
	measured_at("refract back: |w' - w| cos / max(eta, 1/eta)^2", back, 89.0 * U);
	measured_at("refract back: |R' - R| cos^2 / max(eta, 1/eta)^2", fresnel, 89.0 * U);
}

static void test_reflect(void)
{
	double angle = 0.0, unit = 0.0;
	for (uint64_t i = 0; i < 200000; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		const vec w = to_double(r.w), m = to_double(r.m), t = to_double(lobe_reflect(r.w, r.m, r.c));
		/* w + t is along m. */
		angle = larger(angle, length(cross(combine(1.0, w, 1.0, t), m)));
		unit = larger(unit, fabs(length(t) - 1.0));
	}
	/* |t|^2 = |w|^2 + 4 c (c |m|^2 - w.m): 9 + 4(9 + 3) at worst, half of it, and a rounding. */
	measured("reflect: (w + t) x m", angle, 2.0 * U);
	measured("reflect: | |t| - 1 |", unit, 29.5 * U);
}

/* --- Schlick ------------------------------------------------------------------------------------------------------ */

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

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_dielectric_denser);
	RUN_TEST(test_dielectric_thinner);
	RUN_TEST(test_brewster);
	RUN_TEST(test_total_reflection_edge);
	RUN_TEST(test_no_interface);
	RUN_TEST(test_dielectric_range);
	RUN_TEST(test_dielectric_planted);
	RUN_TEST(test_refract);
	RUN_TEST(test_refract_straight);
	RUN_TEST(test_refract_round_trip);
	RUN_TEST(test_reflect);
	RUN_TEST(test_schlick);
	return UNITY_END();
}
