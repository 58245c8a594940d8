/* test_warp.c - core/warp.h: every point of the square is mapped into the domain, and has a density there. (Densities:
 * test_warp_density.c. Inverses: test_warp_inverse.c.) */
#include "measured.h"
#include "unity.h"
#include "warp_points.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double length3(lobe_vec3 w)
{
	return sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y + (double)w.z * (double)w.z);
}

static void test_disk_domain(void)
{
	double widest = 0.0;
	for (uint64_t i = 0; i < CASES; i++)
		widest = larger(widest, radius(lobe_concentric_disk(point(i))));
	/* |r| <= 1 - 2^-24 before the sine and cosine, whose rounding (2 ulp each) can add up to 2.5e-7. */
	printf("  %-56s %11.4g\n", "disk: largest radius - 1", widest - 1.0);
	TEST_ASSERT_TRUE_MESSAGE(widest < 1.0 + 2.5e-7, "a point of the disk lies outside by more than rounding");
}

static void test_cosine_domain(void)
{
	double off_unit = 0.0, lowest = 1.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec3 w = lobe_cosine_hemisphere(point(i));
		off_unit = larger(off_unit, fabs(length3(w) - 1.0));
		lowest = (double)w.z < lowest ? (double)w.z : lowest;
		TEST_ASSERT_TRUE_MESSAGE(lobe_cosine_hemisphere_pdf(w) > 0.0f, "a sample has no density");
	}
	/* x and y are r times a sine and a cosine off by 1 ulp (2 U) each, rounded once (1 U); z is off by 2.5 U. */
	measured("cosine hemisphere: | |w| - 1 |", off_unit, 3.1 * U);
	measured("cosine hemisphere: 3e-4 - lowest z", 3e-4 - lowest, 0.0);
}

static void test_cap_domain(void)
{
	double off_unit = 0.0, below = 0.0;
	for (size_t k = 0; k < HEIGHTS; k++) {
		for (uint64_t i = 0; i < CASES / HEIGHTS; i++) {
			const lobe_vec3 w = lobe_spherical_cap(point(i), cap_heights[k]);
			off_unit = larger(off_unit, fabs(length3(w) - 1.0));
			/* In the cap, up to the rounding of z itself: 1 - z is at most the height. */
			below = larger(below, (1.0 - (double)w.z) - (double)cap_heights[k]);
			TEST_ASSERT_TRUE_MESSAGE(lobe_spherical_cap_pdf(cap_heights[k]) > 0.0f,
						 "a sample has no density");
		}
	}
	/* As above with s off by 1.5 U in place of r, and z by 1 U. */
	measured("cap: | |w| - 1 |", off_unit, 4.6 * U);
	measured("cap: 1 - z - height", below, 1.0 * U);
}

/* Where the cap is nearly the whole sphere and u.y in its last cells, against the map in long double: what is left of
 * the sphere below a point is small. Planted: that as a difference of what is above. */
static void test_cap_far_end(void)
{
	double off = 0.0, planted = 0.0;
	for (uint32_t k = 0; k < 8192u; k += 61u)
		for (uint32_t i = 1; i <= 8192u; i += 67u) {
			const float height = 2.0f - (float)k * 0x1p-23f;
			const lobe_vec2 u = lobe_vec2_make(0.125f, 1.0f - (float)i * (float)U);
			const long double h = (long double)u.y * (long double)height;
			const double exact = (double)sqrtl(h * (2.0L - h));
			const lobe_vec3 w = lobe_spherical_cap(u, height);
			const float rounded = u.y * height;
			off = larger(off, fabs(hypot((double)w.x, (double)w.y) / exact - 1.0));
			planted = larger(planted, fabs(sqrt((double)(rounded * (2.0f - rounded))) / exact - 1.0));
		}
	/* s is off by 3 U, sine and cosine by 2 U each, and the products by 1 U. */
	measured("cap, last cells: distance from the axis, relative", off, 6.0 * U);
	TEST_ASSERT_TRUE(planted > 100.0 * U);
}

static void test_uniform_hemisphere_domain(void)
{
	double lowest = 1.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec3 w = lobe_uniform_hemisphere(point(i));
		lowest = (double)w.z < lowest ? (double)w.z : lowest;
		TEST_ASSERT_TRUE_MESSAGE(lobe_uniform_hemisphere_pdf(w) > 0.0f, "a sample has no density");
	}
	/* 1 - u.y for the largest u.y. */
	measured("uniform hemisphere: 2^-24 - lowest z", U - lowest, 0.0);
}

static void test_density_outside(void)
{
	const lobe_vec3 below = {0.6f, 0.0f, -0.8f}, level = {1.0f, 0.0f, 0.0f}, nan = {NAN, NAN, NAN};
	TEST_ASSERT_TRUE(lobe_cosine_hemisphere_pdf(below) == 0.0f);
	TEST_ASSERT_TRUE(lobe_cosine_hemisphere_pdf(level) == 0.0f);
	TEST_ASSERT_TRUE(lobe_cosine_hemisphere_pdf(nan) == 0.0f);
	TEST_ASSERT_TRUE(lobe_uniform_hemisphere_pdf(below) == 0.0f);
	TEST_ASSERT_TRUE(lobe_uniform_hemisphere_pdf(nan) == 0.0f);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_disk_domain);
	RUN_TEST(test_cosine_domain);
	RUN_TEST(test_cap_domain);
	RUN_TEST(test_cap_far_end);
	RUN_TEST(test_uniform_hemisphere_domain);
	RUN_TEST(test_density_outside);
	return UNITY_END();
}
