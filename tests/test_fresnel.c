/* test_fresnel.c - dielectrics of core/fresnel.h against MPFR. (Refraction: test_refract.c; Schlick's curve:
 * test_fresnel_schlick.c.) */
#include "lobe/core/fresnel.h"

#include "fresnel_exact.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

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
	return UNITY_END();
}
