/* test_light_shape.c - the light's shape of lobe/recommend.h is a density that its draws follow. */
#include "directions.h"
#include "measured.h"
#include "support.h"

#include "lobe/lobe.h"
#include "lobe/recommend.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

enum { SHAPES = 5 };

static lobe_light_shape shape(int i)
{
	const lobe_vec3 axis = direction_at(0.64, 1.3);
	lobe_light_shape sun = lobe_light_shape_disk(axis, 0.024f, 0.8f);
	sun.slope = -2.0f / 3.0f;
	switch (i) {
	case 0:
		return lobe_light_shape_sky(2.0f);
	case 1:
		return sun;
	case 2:
		return lobe_light_shape_glow(axis, 1.5f, 1.0f);
	case 3:
		return lobe_light_shape_with_glow(lobe_light_shape_disk(axis, 0.3f, 0.2f), 0.7f, 0.5f);
	default:
		return lobe_light_shape_disk(direction_at(0.05, 2.0), 0.4f, 1.0f);
	}
}

/* Boxes of equal area on the sphere, the axis of the light for pole: the density's integral over each (midpoints of a
 * fine grid) against the share of draws. crooked: draws of another shape, which has to show. */
enum { RINGS = 12, SECTORS = 8, BOXES = RINGS * SECTORS, FINE = 60 };

static double misfit(lobe_light_shape drawn, lobe_light_shape of, uint32_t stream, double *integral)
{
	static double expected[BOXES], found[BOXES];
	const lobe_frame frame = lobe_frame_from_normal(of.axis);
	const uint32_t n = 200000u;
	double worst = 0.0;
	*integral = 0.0;
	for (int b = 0; b < BOXES; b++)
		expected[b] = found[b] = 0.0;
	for (int i = 0; i < RINGS * FINE; i++)
		for (int k = 0; k < SECTORS * FINE; k++) {
			/* 1 - cos = 2 x^3, as lights are small */
			const double x = (i + 0.5) / (RINGS * FINE), h = 2.0 * x * x * x;
			const double phi = TWO_PI * (k + 0.5) / (SECTORS * FINE), r = sqrt(h * (2.0 - h));
			const double area = 6.0 * x * x / (RINGS * FINE) * TWO_PI / (SECTORS * FINE);
			const lobe_vec3 local =
				lobe_vec3_make((float)(r * cos(phi)), (float)(r * sin(phi)), (float)(1.0 - h));
			const double p = (double)lobe_light_shape_density(of, lobe_frame_to_world(frame, local)) * area;
			expected[i / FINE * SECTORS + k / FINE] += p;
			*integral += p;
		}
	for (uint32_t i = 0; i < n; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec3 w = lobe_light_shape_draw(drawn, lobe_vec3_make(u[0], u[1], u[2]));
		const lobe_vec3 local = lobe_frame_to_local(frame, w);
		const lobe_vec3 chord = lobe_vec3_fma(-1.0f, of.axis, w);
		const double x = cbrt(0.25 * (double)lobe_dot(chord, chord));
		const double turn = atan2((double)local.y, (double)local.x) / TWO_PI;
		const int ring = (int)fmin(x * RINGS, RINGS - 1.0);
		const int sector = (int)fmin((turn < 0.0 ? turn + 1.0 : turn) * SECTORS, SECTORS - 1.0);
		found[ring * SECTORS + sector] += 1.0 / n;
	}
	for (int b = 0; b < BOXES; b++)
		/* The midpoints err at the disk's edge and the horizon. */
		worst = larger(worst,
			       (fabs(found[b] - expected[b]) - 0.02 * expected[b]) / sqrt((expected[b] + 1e-4) / n));
	return worst;
}

static void test_draws_follow_the_density(void)
{
	double worst = 0.0, off = 0.0, integral;
	for (int i = 0; i < SHAPES; i++) {
		worst = larger(worst, misfit(shape(i), shape(i), 40u + (uint32_t)i, &integral));
		off = larger(off, fabs(integral - 1.0));
	}
	measured("boxes: draws off the density, standard deviations", worst, 5.0);
	measured("integral of the density - 1", off, 0.02);
	/* Caught: a glow of another width, and a sky of another slope. */
	lobe_light_shape wrong = shape(2);
	wrong.exponent *= 1.3f;
	const double of_glow = misfit(wrong, shape(2), 50u, &integral);
	wrong = shape(0);
	wrong.slope = 1.0f;
	const double of_sky = misfit(wrong, shape(0), 51u, &integral);
	printf("  planted: %.1f and %.1f standard deviations\n", of_glow, of_sky);
	TEST_ASSERT_TRUE(of_glow > 8.0);
	TEST_ASSERT_TRUE(of_sky > 8.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_draws_follow_the_density);
	return UNITY_END() != 0;
}
