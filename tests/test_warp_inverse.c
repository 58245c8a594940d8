/* test_warp_inverse.c - inverses of core/warp.h: there and back in both orders, and into the square. */
#include "measured.h"
#include "support.h"
#include "unity.h"
#include "warp_points.h"

#include <math.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static int in_square(lobe_vec2 u) { return u.x >= 0.0f && u.x < 1.0f && u.y >= 0.0f && u.y < 1.0f; }

/* Distance on a circle of length 1: the two ends of [0,1) are neighbours where u goes round. */
static double around(float a, float b)
{
	const double d = fabs((double)a - (double)b);
	return d < 0.5 ? d : 1.0 - d;
}

/* Forward, the angle is off by the rounding of `turns` (U/8, and U/8 more for 1/4 - eighth) and by U from sine and
 * cosine together: 1 U + pi/2 U = 2.6 U in angle, 4/pi of that in the square's [-1,1], half in u: 1.7 U. The radius is
 * off by 2.5 U, half of it in u. Back, len is off by 1.5 U, atan and quotient by 3 U, the products and constant by 3 U,
 * so u by (7.5 U)/2. u itself is rounded by U/2, and the cell's middle is taken off for half of an ulp: 8 U in all. */
static const double disk_inverse_bound = 8.0 * U;

static void test_disk_inverse_of_map(void)
{
	double worst = 0.0, worst_cosine = 0.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec2 u = point(i);
		const lobe_vec2 v = lobe_concentric_disk_inverse(lobe_concentric_disk(u));
		const lobe_vec2 w = lobe_cosine_hemisphere_inverse(lobe_cosine_hemisphere(u));
		worst = larger(worst, larger(fabs((double)(v.x - u.x)), fabs((double)(v.y - u.y))));
		worst_cosine = larger(worst_cosine, larger(fabs((double)(w.x - u.x)), fabs((double)(w.y - u.y))));
	}
	measured("disk: |inverse(map(u)) - u|", worst, disk_inverse_bound);
	measured("cosine hemisphere: |inverse(map(u)) - u|", worst_cosine, disk_inverse_bound);
	const lobe_vec2 middle = lobe_concentric_disk_inverse(lobe_vec2_make(0.0f, 0.0f));
	measured("disk: |inverse(centre) - 1/2|", larger(fabs((double)middle.x - 0.5), fabs((double)middle.y - 0.5)),
		 U);
}

static void test_disk_map_of_inverse(void)
{
	double worst = 0.0, worst_cosine = 0.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const double r =
			i % 8 ? sqrt((double)test_uniform(20, i)) : pow(10.0, -8.0 * (double)test_uniform(20, i));
		const double phi = TWO_PI * (double)test_uniform(21, i);
		const lobe_vec2 d = lobe_vec2_make((float)(r * cos(phi)), (float)(r * sin(phi)));
		const lobe_vec2 e = lobe_concentric_disk(lobe_concentric_disk_inverse(d));
		worst = larger(worst, larger(fabs((double)(e.x - d.x)), fabs((double)(e.y - d.y))));
		const lobe_vec3 w = {d.x, d.y, (float)sqrt(larger((1.0 - r) * (1.0 + r), 0.0))};
		const lobe_vec3 x = lobe_cosine_hemisphere(lobe_cosine_hemisphere_inverse(w));
		worst_cosine = larger(worst_cosine, larger(fabs((double)(x.x - w.x)), fabs((double)(x.y - w.y))));
		/* z = sqrt(1 - r^2) moves by r/z for each step of r. */
		const double z = larger((double)w.z, 3e-4);
		worst_cosine = larger(worst_cosine, fabs((double)(x.z - w.z)) * z);
	}
	/* The square is twice as wide as u, and its sides are at most pi/2 times as long on the disk. */
	measured("disk: |map(inverse(d)) - d|", worst, PI * disk_inverse_bound);
	measured("cosine hemisphere: |map(inverse(w)) - w| (dz times z)", worst_cosine, PI * disk_inverse_bound);
}

static void test_cap_inverse_of_map(void)
{
	double worst_round = 0.0, worst = 0.0, worst_relative = 0.0;
	for (size_t k = 0; k < HEIGHTS; k++) {
		for (uint64_t i = 0; i < CASES / HEIGHTS; i++) {
			const lobe_vec2 u = point(i);
			const lobe_vec2 v =
				lobe_spherical_cap_inverse(lobe_spherical_cap(u, cap_heights[k]), cap_heights[k]);
			const double error = fabs((double)v.y - (double)u.y);
			worst = larger(worst, error);
			/* Near the pole the error is relative, down to where squares underflow. */
			if (u.y > 0x1p-60f)
				worst_relative = larger(worst_relative, error / (double)u.y);
			/* At the poles themselves there is no way round. */
			if (u.y > 0x1p-60f)
				worst_round = larger(worst_round, around(v.x, u.x));
		}
	}
	/* x^2 + y^2 is h(2 - h), whose root is off by 1.5 U, times sine and cosine with 2 U and a rounding: 2 * 4.5 U,
	 * 2 U to form it, 2 U to divide, 1 U in u.y*height and 1 U in the last quotient: 15 U. Below the equator 1 - z
	 * is off by less than that. */
	measured("cap: |inverse(map(u)) - u| / u in u.y", worst_relative, 15.0 * U);
	measured("cap: |inverse(map(u)) - u| in u.y", worst, 15.0 * U);
	/* Sine, cosine, x and y move the angle by up to 3 U of a radian; atan2 is off by 2 ulp <= 4 U relative, its
	 * quotient and constant by 1.5 U, all of at most half a turn; adding 1 rounds by U/2: 0.5 + 2.75 + 0.5. */
	measured("cap: |inverse(map(u)) - u| in u.x", worst_round, 3.8 * U);
}

static void test_cap_map_of_inverse(void)
{
	double worst = 0.0, worst_z = 0.0;
	for (uint64_t i = 0; i < CASES; i++) {
		float d[3];
		test_direction(22, i, d);
		/* Every eighth near a pole. */
		if (i % 8 == 0) {
			const double s = pow(10.0, -9.0 * (double)test_uniform(23, i));
			const double len = sqrt((double)d[0] * (double)d[0] + (double)d[1] * (double)d[1]);
			d[0] = (float)((double)d[0] * s / len);
			d[1] = (float)((double)d[1] * s / len);
			d[2] = (float)copysign(sqrt((1.0 - s) * (1.0 + s)), (double)d[2]);
		}
		const lobe_vec3 w = {d[0], d[1], d[2]};
		const lobe_vec3 x = lobe_spherical_cap(lobe_spherical_cap_inverse(w, 2.0f), 2.0f);
		const double s = sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y);
		const double error = larger(fabs((double)(x.x - w.x)), fabs((double)(x.y - w.y)));
		/* Towards the lower pole x and y come from 1 - z, which knows less and less of them: s = sqrt(h(2 -
		 * h)). */
		worst = larger(worst, w.z > 0.0f ? error : error * s);
		worst_z = larger(worst_z, fabs((double)(x.z - w.z)));
	}
	/* h is off by 7 U relative above the equator, z by at most that; x and y by half of it and by 2 pi times
	 * the 3.8 U of u.x. Below it h is off by 2 U absolute: U/s in x and y. */
	measured("sphere: |map(inverse(w)) - w| in x, y (times s below)", worst, (3.5 + TWO_PI * 3.8 + 4.5) * U);
	measured("sphere: |map(inverse(w)) - w| in z", worst_z, 9.0 * U);
}

/* What an inverse returns can be used as u again: it lies in [0,1). */
static void test_inverse_in_square(void)
{
	uint32_t disk = 0, cosine = 0, cap = 0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec2 u = point(i);
		disk += !in_square(lobe_concentric_disk_inverse(lobe_concentric_disk(u)));
		cosine += !in_square(lobe_cosine_hemisphere_inverse(lobe_cosine_hemisphere(u)));
		const float height = cap_heights[i % HEIGHTS];
		cap += !in_square(lobe_spherical_cap_inverse(lobe_spherical_cap(u, height), height));
	}
	measured("disk: inverses outside of [0,1)^2", disk, 0.0);
	measured("cosine hemisphere: inverses outside of [0,1)^2", cosine, 0.0);
	measured("cap: inverses outside of [0,1)^2", cap, 0.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_disk_inverse_of_map);
	RUN_TEST(test_disk_map_of_inverse);
	RUN_TEST(test_cap_inverse_of_map);
	RUN_TEST(test_cap_map_of_inverse);
	RUN_TEST(test_inverse_in_square);
	return UNITY_END();
}
