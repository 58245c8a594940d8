/* test_delta.c - the smooth lobes: where light goes, with what probability and with what weight, against the laws of
 * Snell and Fresnel in long double, and a pane against light that walks about in it. */
#include "lobe/shading.h"

#include "measured.h"
#include "support.h"
#include "textbook.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static const float last = 0x1.fffffep-1f;

/* Number i of many directions, some grazing, and a number for u.z. */
static lobe_vec3 direction(uint32_t i)
{
	float w[3];
	test_direction(1, i, w);
	if (i % 3 == 1) {
		const float z = w[2] * powf(10.0f, -5.0f * test_uniform(2, i));
		const float s = sqrtf((1.0f - z * z) / (w[0] * w[0] + w[1] * w[1]));
		w[0] *= s;
		w[1] *= s;
		w[2] = z;
	}
	return lobe_vec3_make(w[0], w[1], w[2]);
}

static lobe_vec3 only_z(float z) { return lobe_vec3_make(0.3f, 0.6f, z); }

static int is_mirrored(lobe_vec3 wo, lobe_vec3 wi) { return wi.x == -wo.x && wi.y == -wo.y && wi.z == wo.z; }

static int is_straight(lobe_vec3 wo, lobe_vec3 wi) { return wi.x == -wo.x && wi.y == -wo.y && wi.z == -wo.z; }

/* --- mirrors ------------------------------------------------------------------------------------------------------ */

static void test_mirror(void)
{
	const lobe_mirror p = lobe_mirror_make(lobe_rgb_make(0.2f, 0.5f, 1.0f));
	for (uint32_t i = 0; i < 10000u; i++) {
		const lobe_vec3 wo = direction(i);
		const lobe_sample s = lobe_mirror_sample(p, wo, only_z(test_uniform(3, i)));
		TEST_ASSERT_EQUAL_UINT(LOBE_EVENT_REFLECT | LOBE_EVENT_DELTA, s.event);
		TEST_ASSERT_TRUE(is_mirrored(wo, s.wi) && s.pdf == 1.0f);
		TEST_ASSERT_TRUE(s.weight.r == 0.2f && s.weight.g == 0.5f && s.weight.b == 1.0f);
	}
	TEST_ASSERT_EQUAL_UINT(0, lobe_mirror_sample(p, lobe_vec3_make(1.0f, 0.0f, 0.0f), only_z(0.5f)).event);
}

static void test_smooth_conductor(void)
{
	double worst = 0.0;
	for (uint32_t i = 0; i < 30000u; i++) {
		const lobe_rgb n = lobe_metal_eta(i % LOBE_METAL_COUNT), k = lobe_metal_k(i % LOBE_METAL_COUNT);
		const lobe_vec3 wo = direction(i);
		const lobe_sample s =
			lobe_smooth_conductor_sample(lobe_smooth_conductor_make(n, k), wo, only_z(test_uniform(3, i)));
		if (wo.z <= 0.0f) {
			TEST_ASSERT_EQUAL_UINT(0, s.event);
			continue;
		}
		TEST_ASSERT_EQUAL_UINT(LOBE_EVENT_REFLECT | LOBE_EVENT_DELTA, s.event);
		TEST_ASSERT_TRUE(is_mirrored(wo, s.wi) && s.pdf == 1.0f);
		const double c = (double)wo.z;
		worst = larger(worst,
			       fabs((double)s.weight.r - textbook_fresnel_conductor(c, (double)n.r, (double)k.r)));
		worst = larger(worst,
			       fabs((double)s.weight.b - textbook_fresnel_conductor(c, (double)n.b, (double)k.b)));
	}
	/* That of lobe_fresnel_conductor (test_fresnel_conductor.c). */
	measured("smooth_conductor: weight - F", worst, 60.0 * U);
}

/* --- glass -------------------------------------------------------------------------------------------------------- */

static float index_of(uint32_t i)
{
	static const float some[] = {1.5f, 1.0f / 1.5f, 1.33f, 2.42f, 1000.0f, 1e-3f, 1.0001f, 0.9999f};
	return i % 4 ? some[i / 4 % 8] : powf(4.0f, 2.0f * test_uniform(4, i) - 1.0f);
}

/* Reflectance and cosine beyond, from the index in use: 1/eta is rounded. */
static long double exact_reflectance(long double c, long double e, long double *cos_t)
{
	const long double g2 = (e - 1.0L) * (e + 1.0L) + c * c;
	*cos_t = g2 > 0.0L ? sqrtl(g2) / e : 0.0L;
	if (g2 <= 0.0L)
		return 1.0L;
	const long double g = sqrtl(g2), s = (c - g) / (c + g), p = (e * e * c - g) / (e * e * c + g);
	return 0.5L * (s * s + p * p);
}

/* Both events of one direction, u.z = 0 and the last below 1: Fresnel's two shares, where they are what happens. */
static void test_smooth_dielectric(void)
{
	double reflect = 0.0, transmit = 0.0, sum = 0.0, snell = 0.0, cosine = 0.0, unit = 0.0, scale = 0.0;
	unsigned wrong = 0, threshold = 0, refracted = 0;
	for (uint32_t i = 0; i < 200000u; i++) {
		const float eta = index_of(i);
		const lobe_smooth_dielectric p = lobe_smooth_dielectric_make(eta);
		const lobe_smooth_dielectric q = lobe_smooth_dielectric_transport(p, LOBE_TRANSPORT_IMPORTANCE);
		const lobe_vec3 wo = direction(i);
		const long double e = wo.z > 0.0f ? (long double)p.eta : (long double)p.inv_eta;
		const double c = fabs((double)wo.z);
		long double cos_t;
		const double f = (double)exact_reflectance((long double)c, e, &cos_t);
		/* How far from total reflection, which multiplies every rounding of e and c. */
		const double g2 = (double)(e * e * cos_t * cos_t);
		if (e < 1.0L && fabs((double)((e - 1.0L) * (e + 1.0L)) + c * c) < 1e-5)
			continue;
		const double sharp = e < 1.0L && g2 > 0.0 ? 1.0 + (double)(e * e) / g2 : 1.0;
		const lobe_sample a = lobe_smooth_dielectric_sample(p, wo, only_z(0.0f));
		const lobe_sample b = lobe_smooth_dielectric_sample(p, wo, only_z(last));
		wrong += a.event != (LOBE_EVENT_REFLECT | LOBE_EVENT_DELTA) || !is_mirrored(wo, a.wi);
		wrong += a.weight.r != 1.0f || a.weight.g != 1.0f || a.weight.b != 1.0f;
		if (a.event & LOBE_EVENT_REFLECT)
			reflect = larger(reflect, fabs((double)a.pdf - f) / sharp);
		if (b.event != (LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA)) {
			/* Nothing gets through, or less than the rounding of F. */
			wrong += !(b.event & LOBE_EVENT_REFLECT) || 1.0 - f > 60.0 * U;
			continue;
		}
		refracted++;
		const double t[3] = {(double)b.wi.x, (double)b.wi.y, (double)b.wi.z};
		transmit = larger(transmit, fabs((double)b.pdf - (1.0 - f)) / (1.0 - f) / sharp);
		sum = larger(sum, fabs((double)a.pdf + (double)b.pdf - 1.0));
		unit = larger(unit, fabs(sqrt(textbook_dot(t, t)) - 1.0));
		/* Tangent over e, the other side, and the cosine. */
		const double back = 1.0 / fmin((double)e, 1.0);
		snell = larger(snell, fabs(t[0] + (double)((long double)wo.x / e)) / back / back);
		snell = larger(snell, fabs(t[1] + (double)((long double)wo.y / e)) / back / back);
		cosine = larger(cosine, fabs(fabs(t[2]) - (double)cos_t) / (double)cos_t / sharp / back / back);
		wrong += b.wi.z * wo.z >= 0.0f;
		const lobe_sample r = lobe_smooth_dielectric_sample(q, wo, only_z(last));
		wrong += r.weight.g != 1.0f || r.wi.x != b.wi.x || r.pdf != b.pdf;
		scale = larger(scale, fabs((double)b.weight.g * (double)(e * e) - 1.0));
		/* u.z decides at F. */
		const float at = a.pdf;
		if (a.event & LOBE_EVENT_REFLECT)
			threshold += !(lobe_smooth_dielectric_sample(p, wo, only_z(at)).event & LOBE_EVENT_TRANSMIT) ||
				     !(lobe_smooth_dielectric_sample(p, wo, only_z(nextafterf(at, 0.0f))).event &
				       LOBE_EVENT_REFLECT);
	}
	printf("  %u of them refract\n", refracted);
	TEST_ASSERT_TRUE(refracted > 100000u);
	measured("glass: reflects with F, absolute", reflect, 60.0 * U);
	measured("glass: refracts with 1 - F, relative", transmit, 60.0 * U);
	measured("glass: both add up to 1", sum, 52.0 * U);
	measured("glass: | |wi| - 1 |", unit, 16.0 * U);
	measured("glass: Snell's tangent / max(1, 1/eta)^2", snell, 16.0 * U);
	measured("glass: cosine relative / max(1, 1/eta)^2", cosine, 16.0 * U);
	measured("glass: radiance's weight eta^2 - 1", scale, 4.0 * U);
	measured("glass: wrong events, sides, weights", wrong, 0.0);
	measured("glass: u.z does not decide at F", threshold, 0.0);
}

static void test_index_1_is_nothing(void)
{
	for (uint32_t i = 0; i < 20000u; i++) {
		const lobe_vec3 wo = direction(i);
		const lobe_vec3 u = only_z(i % 8 ? test_uniform(3, i) : 0.0f);
		const lobe_sample s = lobe_smooth_dielectric_sample(lobe_smooth_dielectric_make(1.0f), wo, u);
		const lobe_sample t = lobe_thin_dielectric_sample(lobe_thin_dielectric_make(1.0f), wo, u);
		TEST_ASSERT_TRUE(is_straight(wo, s.wi) && s.weight.g == 1.0f && s.pdf == 1.0f);
		TEST_ASSERT_TRUE(is_straight(wo, t.wi) && t.weight.g == 1.0f && t.pdf == 1.0f);
		TEST_ASSERT_EQUAL_UINT(LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA, s.event & t.event);
	}
}

/* What was refracted comes back the way it went, with as much probability. */
static void test_back_through_glass(void)
{
	double way = 0.0, probability = 0.0;
	for (uint32_t i = 0; i < 100000u; i++) {
		const lobe_smooth_dielectric p = lobe_smooth_dielectric_make(i & 1u ? 1.5f : 0.4f);
		const lobe_vec3 wo = direction(i);
		const lobe_sample s = lobe_smooth_dielectric_sample(p, wo, only_z(last));
		if (!(s.event & LOBE_EVENT_TRANSMIT) || fabsf(s.wi.z) < 0.01f || fabsf(wo.z) < 0.01f)
			continue;
		const lobe_sample r = lobe_smooth_dielectric_sample(p, s.wi, only_z(last));
		TEST_ASSERT_TRUE((r.event & LOBE_EVENT_TRANSMIT) != 0u);
		const double sharp = fmin(fabs((double)s.wi.z), fabs((double)wo.z));
		const double off = fmax(fabs((double)(r.wi.x - wo.x)),
					fmax(fabs((double)(r.wi.y - wo.y)), fabs((double)(r.wi.z - wo.z))));
		way = larger(way, off * sharp);
		probability = larger(probability, fabs((double)r.pdf - (double)s.pdf) * sharp * sharp);
		/* Radiance there and back: unchanged. */
		TEST_ASSERT_TRUE(fabs((double)s.weight.g * (double)r.weight.g - 1.0) < 8.0 * U);
	}
	measured("glass, there and back: direction", way, 89.0 * 6.25 * U);
	measured("glass, there and back: probability", probability, 89.0 * 6.25 * U);
}

/* --- panes -------------------------------------------------------------------------------------------------------- */

/* R + T^2 R (1 + R^2 + R^4 + ...), term by term; what is left over at last is in the transmittance. */
static double pane(double c, double eta, double *through)
{
	const double r = textbook_fresnel(c, eta), t = 1.0 - r;
	double reflected = r, inside = t;
	*through = 0.0;
	for (int bounce = 0; bounce < 100000 && inside > 1e-18; bounce++) {
		*through += inside * t; /* leaves below */
		inside *= r;
		reflected += inside * t; /* leaves above */
		inside *= r;
	}
	return reflected;
}

static void test_thin_dielectric(void)
{
	static const float etas[] = {1.5f, 1.33f, 2.42f, 1.0f / 1.5f, 1.0001f, 10.0f};
	double reflect = 0.0, transmit = 0.0, sum = 0.0;
	unsigned wrong = 0, passed = 0;
	for (uint32_t i = 0; i < 50000u; i++) {
		const float eta = etas[i % 6];
		const lobe_thin_dielectric p = lobe_thin_dielectric_make(eta);
		const lobe_vec3 wo = direction(i);
		const double c = fabs((double)wo.z);
		/* Near total reflection the textbook's formula cancels. */
		if (c < 1e-3 || fabs((double)eta * (double)eta - 1.0 + c * c) < 1e-3)
			continue;
		double through;
		const double r = pane(c, (double)eta, &through);
		const lobe_sample a = lobe_thin_dielectric_sample(p, wo, only_z(0.0f));
		const lobe_sample b = lobe_thin_dielectric_sample(p, wo, only_z(last));
		wrong += a.event != (LOBE_EVENT_REFLECT | LOBE_EVENT_DELTA) || !is_mirrored(wo, a.wi);
		reflect = larger(reflect, fabs((double)a.pdf - r));
		if (!(b.event & LOBE_EVENT_TRANSMIT)) {
			wrong += through > 4.0 * U;
			continue;
		}
		passed++;
		wrong += !is_straight(wo, b.wi) || b.weight.r != 1.0f || a.weight.r != 1.0f;
		transmit = larger(transmit, fabs((double)b.pdf - through));
		sum = larger(sum, fabs((double)a.pdf + (double)b.pdf - 1.0));
	}
	TEST_ASSERT_TRUE(passed > 20000u);
	/* Those of F, twice. */
	measured("pane: R' against the sum of interreflections", reflect, 120.0 * U);
	measured("pane: T' against the sum of interreflections", transmit, 120.0 * U);
	measured("pane: both add up to 1", sum, 60.0 * U);
	measured("pane: wrong events, directions, weights", wrong, 0.0);
}

/* A pane is two interfaces: light that walks between smooth_dielectric and its underside leaves as often above. */
static double walk(float eta, lobe_vec3 wo, uint32_t stream, uint32_t n)
{
	const lobe_smooth_dielectric p = lobe_smooth_dielectric_make(eta);
	uint32_t above = 0;
	for (uint32_t i = 0; i < n; i++) {
		uint64_t draw = (uint64_t)i * 64u;
		lobe_sample s = lobe_smooth_dielectric_sample(p, wo, only_z(test_uniform(stream, draw++)));
		int outside = (s.event & LOBE_EVENT_REFLECT) != 0u, at_top = 1;
		while (!outside && draw < (uint64_t)i * 64u + 63u) {
			/* Arrives at the other interface from within, below its surface. */
			s.wi.z = -fabsf(s.wi.z);
			at_top = !at_top;
			s = lobe_smooth_dielectric_sample(p, s.wi, only_z(test_uniform(stream, draw++)));
			outside = (s.event & LOBE_EVENT_TRANSMIT) != 0u;
		}
		above += (uint32_t)at_top;
	}
	return (double)above / (double)n;
}

static void test_thin_dielectric_against_a_walk(void)
{
	static const float cosines[] = {1.0f, 0.5f, 0.2f, 0.05f};
	const uint32_t n = 200000u;
	for (uint32_t i = 0; i < 8u; i++) {
		const float z = cosines[i % 4], eta = i < 4u ? 1.5f : 2.4f;
		const lobe_vec3 wo = lobe_vec3_make(sqrtf(1.0f - z * z), 0.0f, z);
		const double r =
			(double)lobe_thin_dielectric_sample(lobe_thin_dielectric_make(eta), wo, only_z(0.0f)).pdf;
		const double sigma = sqrt(r * (1.0 - r) / n), got = walk(eta, wo, 50u + i, n);
		char what[64];
		snprintf(what, sizeof what, "walk in a pane of %.1f, cos %.2f: deviations from R'", (double)eta,
			 (double)z);
		measured(what, fabs(got - r) / sigma, 4.5);
		/* One interface alone would be caught. */
		TEST_ASSERT_TRUE(i > 0u || fabs(got - textbook_fresnel((double)z, (double)eta)) > 20.0 * sigma);
	}
}

/* What summing F of both polarisations instead of each by itself costs: the header states it for glass. */
static void test_pane_of_unpolarised_light(void)
{
	double worst = 0.0, at = 0.0;
	const double e = 1.5;
	for (int i = 1; i <= 10000; i++) {
		const double c = i / 10000.0, g = sqrt(e * e - 1.0 + c * c);
		const double s = (c - g) / (c + g), p = (e * e * c - g) / (e * e * c + g);
		const double rs = s * s, rp = p * p, f = 0.5 * (rs + rp);
		const double apart = rs / (1.0 + rs) + rp / (1.0 + rp);
		if (2.0 * f / (1.0 + f) - apart > worst) {
			worst = 2.0 * f / (1.0 + f) - apart;
			at = c;
		}
	}
	printf("  R' of glass is above that of both polarisations apart by at most %.4f, at %.1f degrees\n", worst,
	       acos(at) * 180.0 / PI);
	measured("pane: R' less that of each polarisation", worst, 0.0223);
}

/* The bounds mean something: an index 1e-4 off breaks them. */
static void test_planted(void)
{
	const lobe_vec3 wo = lobe_vec3_make(0.8f, 0.0f, 0.6f);
	long double cos_t;
	const double f = (double)exact_reflectance(0.6L, 1.5L, &cos_t);
	const lobe_sample s = lobe_smooth_dielectric_sample(lobe_smooth_dielectric_make(1.5001f), wo, only_z(last));
	TEST_ASSERT_TRUE(fabs((double)s.pdf - (1.0 - f)) > 60.0 * U);
	TEST_ASSERT_TRUE(fabs((double)s.wi.x + 0.8 / 1.5) > 16.0 * U);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_mirror);
	RUN_TEST(test_smooth_conductor);
	RUN_TEST(test_smooth_dielectric);
	RUN_TEST(test_index_1_is_nothing);
	RUN_TEST(test_back_through_glass);
	RUN_TEST(test_thin_dielectric);
	RUN_TEST(test_thin_dielectric_against_a_walk);
	RUN_TEST(test_pane_of_unpolarised_light);
	RUN_TEST(test_planted);
	return UNITY_END();
}
