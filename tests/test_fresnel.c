/* test_fresnel.c - core/fresnel.h against MPFR and complex arithmetic, core/optics.h and its names. */
#include "lobe/core/fresnel.h"
#include "lobe/core/fresnel_schlick.h"
#include "lobe/optics_names.h"

#include "measured.h"
#include "support.h"
#include "unity.h"

#include <complex.h>
#include <math.h>
#include <mpfr.h>
#include <stdio.h>
#include <string.h>

#define U 0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* A maximum and the arguments where it was found. */
typedef struct {
	double value;
	float c, eta;
} worst;

static void keep_worst(worst *w, double value, float c, float eta)
{
	/* Not <=, so that a NaN is kept. */
	if (!(value <= w->value)) {
		w->value = value;
		w->c = c;
		w->eta = eta;
	}
}

static void measured_at(const char *what, worst w, double bound)
{
	measured(what, w.value, bound);
	printf("  %60s at c = %.9g, eta = %.9g\n", "", (double)w.c, (double)w.eta);
}

/* --- dielectric -----------------------------------------------------------------------------------------------------
 */

#define BITS                                                                                                           \
	400 /* of the reference: R = (eta - 1)^2/4 is 1e-15 next to terms of 1, and T = 1 - R is formed by subtraction \
	     */

typedef struct {
	double reflectance, transmittance, cos_t;
	double rp;   /* amplitude of the polarisation that vanishes at Brewster's angle */
	double edge; /* g^2: how far c^2 is from total reflection, < 0 at total reflection */
} exact_fresnel;

/* Fresnel's amplitudes as textbooks print them, (cos_i - eta cos_t)/(cos_i + eta cos_t) and so on. */
static exact_fresnel exact_dielectric(float c, float eta)
{
	static mpfr_t c1, n, g2, g, num, den, rs, rp, r;
	static int ready = 0;
	if (!ready) {
		mpfr_inits2(BITS, c1, n, g2, g, num, den, rs, rp, r, (mpfr_ptr)0);
		ready = 1;
	}
	exact_fresnel e;
	mpfr_set_flt(c1, c, MPFR_RNDN);
	mpfr_set_flt(n, eta, MPFR_RNDN);
	/* g = eta cos_t = sqrt(eta^2 - (1 - c^2)) */
	mpfr_sqr(g2, n, MPFR_RNDN);
	mpfr_sqr(r, c1, MPFR_RNDN);
	mpfr_add(g2, g2, r, MPFR_RNDN);
	mpfr_sub_ui(g2, g2, 1, MPFR_RNDN);
	e.edge = mpfr_get_d(g2, MPFR_RNDN);
	if (mpfr_sgn(g2) <= 0) {
		e.reflectance = 1.0;
		e.transmittance = 0.0;
		e.cos_t = 0.0;
		e.rp = 1.0;
		return e;
	}
	mpfr_sqrt(g, g2, MPFR_RNDN);
	mpfr_div(r, g, n, MPFR_RNDN);
	e.cos_t = mpfr_get_d(r, MPFR_RNDN);
	mpfr_sub(num, c1, g, MPFR_RNDN);
	mpfr_add(den, c1, g, MPFR_RNDN);
	mpfr_div(rs, num, den, MPFR_RNDN);
	mpfr_mul(c1, c1, n, MPFR_RNDN); /* eta cos_i against cos_t, both times eta */
	mpfr_mul(c1, c1, n, MPFR_RNDN);
	mpfr_sub(num, c1, g, MPFR_RNDN);
	mpfr_add(den, c1, g, MPFR_RNDN);
	mpfr_div(rp, num, den, MPFR_RNDN);
	e.rp = mpfr_get_d(rp, MPFR_RNDN);
	mpfr_sqr(rs, rs, MPFR_RNDN);
	mpfr_sqr(rp, rp, MPFR_RNDN);
	mpfr_add(r, rs, rp, MPFR_RNDN);
	mpfr_div_ui(r, r, 2, MPFR_RNDN);
	e.reflectance = mpfr_get_d(r, MPFR_RNDN);
	mpfr_ui_sub(r, 1, r, MPFR_RNDN);
	e.transmittance = mpfr_get_d(r, MPFR_RNDN);
	return e;
}

#define COSINES 600
#define INDICES 260

/* From 1e-7 to 1, by powers, by equal steps, and close to 1. */
static float cosine(int i)
{
	if (i < 200)
		return (float)pow(10.0, -7.0 * (200 - i) / 200.0);
	if (i < 500)
		return (float)((i - 199) / 301.0);
	if (i < 599)
		return (float)(1.0 - pow(10.0, -7.2 * (i - 499) / 100.0));
	return 1.0f;
}

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

/* --- refraction
 * ------------------------------------------------------------------------------------------------------- */

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

static lobe_vec3 direction(uint32_t stream, uint64_t i)
{
	float w[3];
	test_direction(stream, i, w);
	return lobe_vec3_make(w[0], w[1], w[2]);
}

#define RAYS 400000

/* Number i of many w and m with w.m > 0, and an index; some nearly parallel, some grazing. */
typedef struct {
	lobe_vec3 w, m;
	float c, eta;
} ray;

static int make_ray(uint64_t i, ray *r)
{
	const double bend = pow(10.0, -4.0 * (double)test_uniform(12, i));
	r->m = direction(10, i);
	lobe_vec3 w = direction(11, i);
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

/* --- conductor ------------------------------------------------------------------------------------------------------
 */

/* Textbook amplitudes in complex arithmetic. p = N cos_t; p^2 = N^2 - sin^2 is formed from n - 1 and c^2, which are
 * exact, and moved by shift. */
static double exact_conductor(float c_in, float n_in, float k_in, double shift)
{
	const long double c = (long double)c_in, n = (long double)n_in, k = (long double)k_in;
	const long double re = (n - 1.0L) * (n + 1.0L) - k * k + c * c + (long double)shift;
	const long double complex n2 = (n * n - k * k) + 2.0L * n * k * (long double complex)I;
	const long double complex p = csqrtl(re + 2.0L * n * k * (long double complex)I);
	const long double complex rs_den = c + p, rp_den = n2 * c + p;
	const long double rs = rs_den == 0.0L ? 0.0L : cabsl((c - p) / rs_den);
	const long double rp = rp_den == 0.0L ? 0.0L : cabsl((n2 * c - p) / rp_den);
	return (double)(0.5L * (rs * rs + rp * rp));
}

/* How far the result is from what exact arithmetic gives for t = n^2 - k^2 - s^2 off by up to the three roundings that
 * float arithmetic cannot but make in it (of the two factors, their product, s^2 and the difference): 4 U(|n^2-k^2| +
 * s^2). Only with a small k near n = sin theta does that matter: the edge of total reflection. */
static double conductor_error(float c, float n, float k)
{
	const double s2 = (1.0 - (double)c) * (1.0 + (double)c);
	const double off = 4.0 * U * (fabs((double)n - (double)k) * ((double)n + (double)k) + s2);
	double lo = 2.0, hi = -1.0;
	for (int i = -4; i <= 4; i++) {
		const double e = exact_conductor(c, n, k, off * i / 4.0);
		lo = fmin(lo, e);
		hi = fmax(hi, e);
	}
	const double got = (double)lobe_fresnel_conductor(c, n, k);
	if (isnan(got))
		return HUGE_VAL;
	return got < lo ? lo - got : got > hi ? got - hi : 0.0;
}

/* From t, with its error set apart: q 4 U, |t| + q 5 U and its root with b 3.5 U, X c 6.5 U, (q + c^2) b 9.5 U. F_s is
 * a quotient of difference and sum, off by twice (6.5 + 9.5)/2 U at most where both terms are alike, and as much again
 * by E: 2 * 16 U + 2 * 14 U, absolute since F <= 1. */
static const double conductor_bound = 60.0 * U;

static void test_conductor_metals(void)
{
	double worst_absolute = 0.0, worst_relative = 0.0;
	for (uint32_t metal = 0; metal < LOBE_METAL_COUNT; metal++) {
		const lobe_rgb n = lobe_metal_eta(metal), k = lobe_metal_k(metal);
		for (int j = 0; j <= COSINES; j++) {
			const float c = j < COSINES ? cosine(j) : 0.0f;
			const lobe_rgb f = lobe_fresnel_conductor_rgb(c, n, k);
			const float got[3] = {f.r, f.g, f.b}, ns[3] = {n.r, n.g, n.b}, ks[3] = {k.r, k.g, k.b};
			for (int i = 0; i < 3; i++) {
				const double e = exact_conductor(c, ns[i], ks[i], 0.0);
				worst_absolute = larger(worst_absolute, fabs((double)got[i] - e));
				worst_relative = larger(worst_relative, fabs((double)got[i] - e) / e);
				/* By another division: 5 more roundings, and 2 in the scalar form. */
				const double scalar = (double)lobe_fresnel_conductor(c, ns[i], ks[i]);
				TEST_ASSERT_TRUE(fabs((double)got[i] - scalar) <= 7.0 * U * scalar);
				TEST_ASSERT_TRUE(got[i] >= 0.0f && got[i] <= 1.0f);
			}
		}
	}
	measured("metals: F absolute", worst_absolute, conductor_bound);
	/* No metal reflects less than a third at any angle. */
	measured("metals: F relative", worst_relative, 3.0 * conductor_bound);
}

static void test_conductor_everywhere(void)
{
	worst backward = {0};
	uint32_t out_of_range = 0;
	float bad_c = 0.0f, bad_n = 0.0f, bad_k = 0.0f, worst_k = 0.0f;
	for (int i = 0; i < 61; i++) {
		const float n = (float)pow(10.0, (i - 30) / 10.0);
		for (int l = 0; l < 62; l++) {
			const float k = l == 0 ? 0.0f : (float)pow(10.0, (l - 31) / 10.0);
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
	measured_at("conductor: F absolute, beside 4 U in t", backward, conductor_bound);
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

/* --- Schlick --------------------------------------------------------------------------------------------------------
 */

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

/* --- optical constants ----------------------------------------------------------------------------------------------
 */

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
	RUN_TEST(test_conductor_metals);
	RUN_TEST(test_conductor_everywhere);
	RUN_TEST(test_conductor_extremes);
	RUN_TEST(test_conductor_without_absorption);
	RUN_TEST(test_schlick);
	RUN_TEST(test_metals_normal_incidence);
	RUN_TEST(test_metals_look);
	RUN_TEST(test_glasses);
	RUN_TEST(test_names);
	return UNITY_END();
}
