/* test_slopes_layers.c - slopes.h: moments of layers on one another, and the microsurface that moments stand for. */
#include "lobe/lobe.h"

#include "measured.h"
#include "slope_maps.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdlib.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double layer_a(double i, double j)
{
	return 1.5 * cos(TWO_PI * (5.0 * i / WIDTH + 3.0 * j / HEIGHT)) + 0.25 * i - 0.125 * j;
}
static double layer_b(double i, double j)
{
	return 0.4 * cos(TWO_PI * (7.0 * i / WIDTH - 4.0 * j / HEIGHT) + 1.0) - 0.5 * i + 0.75 * j;
}
static double both(double i, double j) { return layer_a(i, j) + 2.0 * layer_b(i, j); }

/* Waves that do not go with each other are independent layers, and planes are their means. Edges, where the one-sided
 * differences are not orthogonal, are cut off by measuring the pyramid's first level inside. */
static lobe_slope_moments inside(double (*f)(double, double))
{
	const size_t width = WIDTH + 2, height = HEIGHT + 2;
	lobe_slope_map map = heights(width, height, f);
	lobe_slope_moments sum = {0, 0, 0, 0, 0}, *pyramid;
	size_t count;
	map.edge = LOBE_EDGE_CLAMP;
	lobe_slope_level(&count, NULL, NULL, width, height, lobe_slope_levels(width, height));
	pyramid = malloc(count * sizeof *pyramid);
	TEST_ASSERT_NOT_NULL(pyramid);
	TEST_ASSERT_EQUAL_INT(LOBE_OK, lobe_slope_pyramid(pyramid, count, &map));
	for (size_t j = 1; j <= HEIGHT; j++)
		for (size_t i = 1; i <= WIDTH; i++) {
			const lobe_slope_moments m = pyramid[j * width + i];
			sum.x += m.x / (WIDTH * HEIGHT);
			sum.y += m.y / (WIDTH * HEIGHT);
			sum.xx += m.xx / (WIDTH * HEIGHT);
			sum.yy += m.yy / (WIDTH * HEIGHT);
			sum.xy += m.xy / (WIDTH * HEIGHT);
		}
	free(pyramid);
	return sum;
}

static void test_layers(void)
{
	const lobe_slope_moments a = inside(layer_a), b = inside(layer_b), ab = inside(both);
	const lobe_slope_moments b2 = lobe_slope_scale(b, 2.0);
	measured("a + 2 b from the moments of a and b", moments_differ(lobe_slope_add(a, b2), ab), 1e-5);
	/* Without 2 E[a] E[b] - right where one of the means is 0 - it is another surface. */
	TEST_ASSERT_TRUE(fabs(a.xx + b2.xx - ab.xx) > 0.1 && fabs(a.xy + b2.xy - ab.xy) > 0.1);
	const lobe_slope_stats s = lobe_slope_central(lobe_slope_add(a, lobe_slope_roughness(0.3, 0.1)));
	const lobe_slope_stats t = lobe_slope_central(a);
	measured("a material's own roughness adds alpha^2/2",
		 central_differ(s, t.mean_x, t.mean_y, t.var_x + 0.045, t.var_y + 0.005, t.cov), 1e-15);
	const lobe_slope_stats flat = lobe_slope_central((lobe_slope_moments){1.1, 0.0, 1.2099999, 0.0, 0.0});
	TEST_ASSERT_TRUE(flat.var_x == 0.0);
	TEST_ASSERT_TRUE(isnan(lobe_slope_central((lobe_slope_moments){(double)NAN, 0, 1, 1, 0}).var_x));
}

/* From heights to the microsurface and back: A A^T = 2 Cov. */
static void test_linear(void)
{
	const lobe_slope_stats s = measure(heights(WIDTH, HEIGHT, waves));
	const lobe_linear m = lobe_slope_linear(s);
	const double xx = (double)m.xx, xy = (double)m.xy, yx = (double)m.yx, yy = (double)m.yy;
	measured("A A^T/2 against the covariance: relative",
		 worst_of((double[]){(xx * xx + xy * xy) / 2 / s.var_x, (yx * yx + yy * yy) / 2 / s.var_y,
				     (xx * yx + xy * yy) / 2 / s.cov},
			  (double[]){1, 1, 1}, 3),
		 1e-6);
	TEST_ASSERT_TRUE(fabs((double)m.mean_x - s.mean_x) < 1e-9 && fabs((double)m.mean_y - s.mean_y) < 1e-9);
	const lobe_linear flat = lobe_slope_linear(measure(heights(8, 8, NULL)));
	TEST_ASSERT_TRUE(flat.xx == LOBE_ALPHA_MIN && flat.yy == LOBE_ALPHA_MIN && flat.mean_x == 0.0f);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_layers);
	RUN_TEST(test_linear);
	heights_free();
	return UNITY_END() != 0;
}
