/* test_masking_joints.c - how the masking of two directions is joined: bounds, symmetries and limits of every joint,
 * and its digits where it is a small difference. */
#include "directions.h"
#include "measured.h"
#include "microsurface_cases.h"
#include "support.h"

#include "unity.h"

#include <math.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static const lobe_uint joints[] = {LOBE_JOINT_HEIGHT, LOBE_JOINT_SEPARABLE, LOBE_JOINT_DIRECTION,
				   LOBE_JOINT_HEIGHT_DIRECTION};

/* G2 of a pair on one side (of the facet between them), and G1 of each, by the surface's own masking. */
static double g2(lobe_microsurface s, lobe_vec3 o, lobe_vec3 i)
{
	const lobe_seen a = lobe_see(s, o, 1.0f), b = lobe_see(s, i, 1.0f);
	const lobe_vec3 h = lobe_vec3_add(o, i);
	return (double)a.z * (double)lobe_masking_g2_over_cos(s, a, b, lobe_seen_facet_make(o, i, h), 0);
}

static double g1(lobe_microsurface s, lobe_vec3 o)
{
	const lobe_seen a = lobe_see(s, o, 1.0f);
	return (double)a.z / (double)(a.z + a.hides);
}

/* G2 <= min(G1), = for i = o where directions are correlated; symmetric; between the separable and the least;
 * V-cavities and the across forms too. */
static void test_joints_keep_their_bounds(void)
{
	double above = 0.0, asymmetry = 0.0, same = 0.0, order = 0.0, cavity_above = 0.0, across_above = 0.0;
	for (uint32_t j = 0; j < 20000u; j++) {
		float a[3], b[3], u[3];
		test_direction(900u, j, a);
		test_direction(901u, j, b);
		test_u3(902u, j, u);
		const lobe_vec3 o = lobe_vec3_make(a[0], a[1], fabsf(a[2])),
				i = lobe_vec3_make(b[0], b[1], fabsf(b[2]));
		lobe_microsurface s = lobe_microsurface_make(
			shape_make(&shapes[j % SHAPES]),
			lobe_linear_make(0.01f + 0.9f * u[0], 0.0f, 0.3f * u[2], 0.01f + 0.9f * u[1], 0.0f, 0.0f));
		const double least = fmin(g1(s, o), g1(s, i)), product = g1(s, o) * g1(s, i);
		double got[4];
		for (int k = 0; k < 4; k++) {
			s.joint = joints[k];
			got[k] = g2(s, o, i);
			above = larger(above, got[k] / least - 1.0);
			order = larger(order, 1.0 - got[k] / product);
			asymmetry = larger(asymmetry, fabs(got[k] - g2(s, i, o)) / got[k]);
		}
		s.joint = LOBE_JOINT_DIRECTION;
		same = larger(same, fabs(g2(s, o, o) / g1(s, o) - 1.0));
		s.joint = LOBE_JOINT_HEIGHT_DIRECTION;
		same = larger(same, fabs(g2(s, o, o) / g1(s, o) - 1.0));
		s.masking = LOBE_MASKING_VCAVITY;
		const lobe_vec3 h = lobe_vec3_add(o, i);
		const double v_o = (double)lobe_vcavity_g1(o.z, lobe_dot(o, h), h.z),
			     v_i = (double)lobe_vcavity_g1(i.z, lobe_dot(i, h), h.z);
		cavity_above = larger(cavity_above, g2(s, o, i) - fmin(v_o, v_i));
		/* Across: what is seen through is no more than each sees. */
		s.masking = LOBE_MASKING_SMITH;
		s.across = LOBE_ACROSS_BETA;
		const lobe_vec3 below = lobe_vec3_make(i.x, i.y, -i.z);
		const lobe_seen so = lobe_see(s, o, 1.0f), si = lobe_see(s, below, -1.0f);
		const double beta = (double)so.z * (double)lobe_masking_g2_over_cos(s, so, si, lobe_seen_facet_make(o, i, h), 1);
		across_above = larger(across_above, beta / least - 1.0);
	}
	measured("G2 above min(G1), relative", above, 1e-6);
	measured("G1 G1 above G2, relative", order, 1e-6);
	measured("joints: |G2(o,i) - G2(i,o)|, relative", asymmetry, 1e-6);
	measured("direction-correlated, i = o: |G2/G1 - 1|", same, 1e-6);
	measured("V-cavities: G2 above min(G1)", cavity_above, 1e-6);
	measured("beta across above min(G1), relative", across_above, 1e-5);
}

/* Opposite azimuths at angle p = pi: l = 13.85/14.85; the factor wraps and knows no sense of rotation. */
static void test_van_ginneken(void)
{
	const double at_pi = 4.41 * PI / (4.41 * PI + 1.0);
	double worst = 0.0;
	for (int k = -400; k <= 400; k++) {
		const double p = PI * k / 100.0, wrapped = fabs(remainder(p, TWO_PI));
		const lobe_vec3 o = direction_at(0.5, 3.0), i = direction_at(0.2, 3.0 + p);
		const double expected = 4.41 * wrapped / (4.41 * wrapped + 1.0);
		worst = larger(worst, fabs((double)lobe_masking_azimuth_make(o, i).apart - expected));
	}
	measured("van Ginneken's factor, any azimuths: off", worst, 2e-6);
	const lobe_vec3 o = direction_at(0.3, 0.0), i = direction_at(0.2, PI);
	lobe_microsurface s = ggx(0.7);
	const double lo = 1.0 / g1(s, o) - 1.0, li = 1.0 / g1(s, i) - 1.0;
	s.joint = LOBE_JOINT_HEIGHT_DIRECTION;
	TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 / (1.0 + fmax(lo, li) + at_pi * fmin(lo, li)), g2(s, o, i));
	s.joint = LOBE_JOINT_DIRECTION;
	TEST_ASSERT_DOUBLE_WITHIN(1e-6, at_pi * g1(s, o) * g1(s, i) + (1.0 - at_pi) * fmin(g1(s, o), g1(s, i)),
				  g2(s, o, i));
	s.joint = LOBE_JOINT_HEIGHT;
	TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 / (1.0 + lo + li), g2(s, o, i));
}

/* Nothing jumps where a view passes from the mean plane's front to its back. */
static void test_behind_the_mean_plane(void)
{
	lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
						     lobe_linear_make(0.4f, 0.0f, 0.0f, 0.4f, 1.0f, 0.0f));
	const lobe_vec3 i = direction_at(0.9, 2.0);
	double jump = 0.0;
	for (int k = 0; k < 4; k++) {
		double value[2];
		for (int side = 0; side < 2; side++) {
			/* w.z - w.x = +- 1e-6 */
			const double angle = 0.25 * PI + (side ? 1e-6 : -1e-6);
			const lobe_vec3 o = lobe_vec3_make((float)cos(angle), 0.0f, (float)sin(angle));
			s.joint = joints[k];
			const lobe_vec3 h = lobe_vec3_add(o, i);
			value[side] = (double)lobe_masking_g2_over_cos(s, lobe_see(s, o, 1.0f), lobe_see(s, i, 1.0f),
								       lobe_seen_facet_make(o, i, h), 0);
			TEST_ASSERT_TRUE(value[side] > 0.0);
		}
		jump = larger(jump, fabs(value[0] / value[1] - 1.0));
	}
	measured("G2/z_o on both sides of the mean plane's edge, relative", jump, 1e-4);
	const lobe_vec3 o = direction_at(0.9, 2.0), back = direction_at(0.5, 0.0);
	TEST_ASSERT_EQUAL_FLOAT(0.0f, lobe_masking_g2_over_cos(s, lobe_see(s, o, 1.0f), lobe_see(s, back, 1.0f),
							       lobe_seen_facet_make(o, back, lobe_vec3_add(o, back)), 0));
}

/* A lobe_seen of which masking uses z alone. */
static lobe_seen seen_z(float z)
{
	lobe_seen d = {{0.0f, 0.0f, 0.0f}, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
	d.z = z;
	return d;
}

/* G1 + G1 - 1 of V-cavities across the surface, in long double of the same areas, where one direction sees all of the
 * side or nearly so, and the other little. Planted: as it is written. */
static void test_vcavities_across(void)
{
	double off = 0.0, planted = 0.0;
	for (uint32_t i = 0; i < 100000u; i++) {
		const float least = powf(10.0f, -6.0f * test_uniform(21, i)), m_z = 0.1f + 0.9f * test_uniform(22, i);
		const float z = 0.05f + 0.95f * test_uniform(23, i);
		/* The greater is above 1, or below it by as much as the lesser is above 0 at most. */
		const float g = i % 2 ? 1.0f + test_uniform(24, i) : 1.0f - 0.9f * least * test_uniform(24, i);
		lobe_seen_facet m = {2.0f * m_z * z / g, 2.0f * m_z * z / least, m_z, 1.0f};
		const long double sees[2] = {fminl(1.0L, 2.0L * (long double)m_z * (long double)z / (long double)m.o),
					     fminl(1.0L, 2.0L * (long double)m_z * (long double)z / (long double)m.i)};
		const long double exact = sees[0] + sees[1] - 1.0L;
		if (exact < 0.1L * (long double)least)
			continue;
		const float as_is = lobe_vcavity_g1(z, m.o, m_z) - (1.0f - lobe_vcavity_g1(z, m.i, m_z));
		const double one = (double)(z * lobe_masking_vcavity(seen_z(z), seen_z(z), m, 1));
		const float swap = m.o;
		m.o = m.i;
		m.i = swap;
		const double other = (double)(z * lobe_masking_vcavity(seen_z(z), seen_z(z), m, 1));
		off = larger(off, larger(fabs(one / (double)exact - 1.0), fabs(other / (double)exact - 1.0)));
		planted = larger(planted, fabs((double)as_is / (double)exact - 1.0));
	}
	measured("V-cavities across: G1(o) + G1(i) - 1, relative", off, 2e-6);
	TEST_ASSERT_TRUE(planted > 1e-3);
}

/* Direction-correlated masking of nearly opposite azimuths is 1/14.85 of the lesser G1, and a product: the weight of
 * the lesser as a number of its own. Against long double of the same areas. */
static void test_direction_correlated_keeps_its_digits(void)
{
	double off = 0.0;
	for (uint32_t i = 0; i < 20000u; i++) {
		const double p = 3.0 + 0.14 * (double)test_uniform(31, i);
		const lobe_seen o =
			lobe_see(ggx(0.9), direction_at(1.5 * (double)test_uniform(32, i) + 0.05, 0.3), 1.0f);
		const lobe_seen a =
			lobe_see(ggx(0.9), direction_at(1.5 * (double)test_uniform(33, i) + 0.05, 0.3 + p), 1.0f);
		const long double angle = acosl(
			((long double)o.v.x * (long double)a.v.x + (long double)o.v.y * (long double)a.v.y) /
			sqrtl(((long double)o.v.x * (long double)o.v.x + (long double)o.v.y * (long double)o.v.y) *
			      ((long double)a.v.x * (long double)a.v.x + (long double)a.v.y * (long double)a.v.y)));
		const long double l = 4.41L * angle / (4.41L * angle + 1.0L);
		const long double g_o = (long double)o.z / ((long double)o.z + (long double)o.hides),
				  g_a = (long double)a.z / ((long double)a.z + (long double)a.hides);
		const long double exact = l * g_o * g_a + (1.0L - l) * fminl(g_o, g_a);
		const double got = (double)o.z * (double)lobe_masking_smith(LOBE_JOINT_DIRECTION, o, a);
		off = larger(off, fabs(got / (double)exact - 1.0));
	}
	measured("direction-correlated, opposite azimuths: relative", off, 1e-6);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_joints_keep_their_bounds);
	RUN_TEST(test_van_ginneken);
	RUN_TEST(test_behind_the_mean_plane);
	RUN_TEST(test_vcavities_across);
	RUN_TEST(test_direction_correlated_keeps_its_digits);
	return UNITY_END() != 0;
}
