/* test_slopes.c - slopes.h: moments of maps with closed forms, of heights and of normals. (The pyramid:
 * test_slopes_pyramid.c. Layers: test_slopes_layers.c. Bad input: test_slopes_refused.c.) */
#include "lobe/lobe.h"

#include "measured.h"
#include "slope_maps.h"
#include "support.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- heights ------------------------------------------------------------------------------------------------------ */

static double plane(double i, double j) { return 3.0 * i - 0.5 * j + 7.0; }

/* Every difference of a plane is its slope: also at edges, in a row of two, and in one texel, which has none. */
static void test_plane(void)
{
	lobe_slope_map map = heights(37, 23, plane);
	map.edge = LOBE_EDGE_CLAMP;
	map.texel_x = 0.25;
	map.texel_y = 2.0;
	measured("plane", central_differ(measure(map), 12.0, -0.25, 0.0, 0.0, 0.0), 0.0);
	measured("plane: raw moments",
		 moments_differ(measure(map).moments, (lobe_slope_moments){12.0, -0.25, 144.0, 0.0625, -3.0}), 0.0);
	map.flip_y = 1;
	measured("plane, flipped", central_differ(measure(map), 12.0, 0.25, 0.0, 0.0, 0.0), 0.0);
	map.flip_y = 0;
	map.width = 2;
	map.stride = 37;
	measured("plane, two columns of it", central_differ(measure(map), 12.0, -0.25, 0.0, 0.0, 0.0), 0.0);
	map.width = map.height = 1;
	measured("one texel", central_differ(measure(map), 0.0, 0.0, 0.0, 0.0, 0.0), 0.0);
	map.edge = LOBE_EDGE_WRAP;
	measured("one texel, wrapped", central_differ(measure(map), 0.0, 0.0, 0.0, 0.0, 0.0), 0.0);
	/* A plane that wraps has a cliff, where the two differences beside it go down by the whole width less two. */
	map = heights(8, 4, plane);
	const double step = (3.0 - 21.0) / 2.0, mean = (6.0 * 3.0 + 2.0 * step) / 8.0;
	measured("plane, wrapped: E[x], a sum of differences", fabs(measure(map).mean_x - mean), 0.0);
	measured("plane, wrapped: E[x^2]", fabs(measure(map).moments.xx - (6.0 * 9.0 + 2.0 * step * step) / 8.0), 0.0);
}

/* Waves that fit the map are orthogonal: each adds a^2/2 times the products of its differenced wave numbers,
 * sin(k texel)/texel in place of k. */
static void test_waves(void)
{
	const double tx = 0.5, ty = 0.8;
	lobe_slope_map map = heights(WIDTH, HEIGHT, waves);
	double xx = 0.0, yy = 0.0, xy = 0.0, ideal = 0.0;
	map.texel_x = tx;
	map.texel_y = ty;
	for (int k = 0; k < 3; k++) {
		const double kx = TWO_PI * wave[k][0] / WIDTH, ky = TWO_PI * wave[k][1] / HEIGHT;
		const double a2 = 0.5 * amplitude[k] * amplitude[k];
		xx += a2 * sin(kx) * sin(kx) / (tx * tx);
		yy += a2 * sin(ky) * sin(ky) / (ty * ty);
		xy += a2 * sin(kx) * sin(ky) / (tx * ty);
		ideal += a2 * ky * ky / (ty * ty);
	}
	/* Heights to 2.65 are rounded by 1.2e-7 at most, each by itself: over 5760 texels that averages out. */
	measured("three waves: moments of sampled differences", central_differ(measure(map), 0.0, 0.0, xx, yy, xy),
		 1e-8);
	printf("  %-60s %11.4g of the waves' own\n", "Var y, of waves down to 5.5 texels", yy / ideal);
	TEST_ASSERT_TRUE(yy < 0.9 * ideal); /* what the header says the difference costs */
	map.flip_y = 1;
	measured("flipped: Cov changes its sign", central_differ(measure(map), 0.0, 0.0, xx, yy, -xy), 1e-8);
	/* Clamped, all but the edges is the same. */
	map.flip_y = 0;
	map.edge = LOBE_EDGE_CLAMP;
	measured("clamped: Var x", fabs(measure(map).var_x / xx - 1.0), 0.05);
}

/* Texels that no one may read are NaN. */
static void test_stride(void)
{
	const size_t stride = WIDTH + 5;
	float *padded = malloc(stride * HEIGHT * sizeof *padded);
	lobe_slope_map map = heights(WIDTH, HEIGHT, waves);
	const lobe_slope_stats s = measure(map);
	TEST_ASSERT_NOT_NULL(padded);
	for (size_t j = 0; j < HEIGHT; j++)
		for (size_t i = 0; i < stride; i++)
			padded[j * stride + i] = i < WIDTH ? texels[j * WIDTH + i] : NAN;
	map.texels = padded;
	map.stride = stride;
	const lobe_slope_stats t = measure(map);
	free(padded);
	TEST_ASSERT_TRUE(memcmp(&s, &t, sizeof s) == 0);
}

static double slanted_waves(double i, double j) { return 0x1p-12 * waves(i, j) + 128.0 * i; }

/* A mean of 128 over deviations of 1e-4: differences of raw moments keep nothing, the two passes all that the texels
 * have. */
static void test_two_passes(void)
{
	lobe_slope_map map = heights(WIDTH, HEIGHT, slanted_waves);
	double mean = 0.0, var = 0.0;
	map.edge = LOBE_EDGE_CLAMP;
	const lobe_slope_stats s = measure(map), raw = lobe_slope_central(s.moments);
	/* The same in long double, from the texels. */
	long double sum = 0.0L, sum2 = 0.0L;
	for (size_t pass = 0; pass < 2; pass++)
		for (size_t j = 0; j < HEIGHT; j++)
			for (size_t i = 0; i < WIDTH; i++) {
				const float *row = texels + j * WIDTH;
				const size_t a = i ? i - 1 : 0, b = i + 1 < WIDTH ? i + 1 : i;
				const long double d =
					((long double)row[b] - (long double)row[a]) / (long double)(b - a);
				if (pass)
					sum2 += (d - (long double)mean) * (d - (long double)mean);
				else
					sum += d;
				mean = pass ? mean : (double)(sum / (WIDTH * HEIGHT));
			}
	/* mean above is that of the last texel of pass 0 */
	var = (double)(sum2 / (WIDTH * HEIGHT));
	measured("steep mean: its relative error", fabs(s.mean_x / mean - 1.0), 4.0 * DBL_EPSILON);
	measured("steep mean: relative error of Var x", fabs(s.var_x / var - 1.0), 1e-11);
	printf("  %-60s %11.4g\n", "Var x as a difference of raw moments: relative error", fabs(raw.var_x / var - 1.0));
	TEST_ASSERT_TRUE(fabs(raw.var_x / var - 1.0) > 1e-9);
}

/* --- normals ------------------------------------------------------------------------------------------------------ */

/* Normals made from the differenced heights have the same moments, in any of their encodings. */
static void test_normals(void)
{
	lobe_slope_map map = heights(WIDTH, HEIGHT, waves), normals;
	const lobe_slope_stats s = measure(map);
	float *n = malloc(3 * WIDTH * HEIGHT * sizeof *n), *encoded = malloc(3 * WIDTH * HEIGHT * sizeof *n);
	TEST_ASSERT_TRUE(n && encoded);
	for (size_t j = 0; j < HEIGHT; j++)
		for (size_t i = 0; i < WIDTH; i++) {
			const size_t at = 3 * (j * WIDTH + i);
			const double x = 0.5 * ((double)texels[j * WIDTH + (i + 1) % WIDTH] -
						(double)texels[j * WIDTH + (i + WIDTH - 1) % WIDTH]);
			const double y = 0.5 * ((double)texels[(j + 1) % HEIGHT * WIDTH + i] -
						(double)texels[(j + HEIGHT - 1) % HEIGHT * WIDTH + i]);
			const double len = sqrt(1.0 + x * x + y * y);
			n[at] = (float)(-x / len);
			n[at + 1] = (float)(-y / len);
			n[at + 2] = (float)(1.0 / len);
			for (size_t k = 0; k < 3; k++)
				encoded[at + k] = 0.5f * n[at + k] + 0.5f;
		}
	normals = map;
	normals.kind = LOBE_SLOPES_NORMAL;
	normals.texels = n;
	normals.texel_x = normals.texel_y = 0.0; /* not looked at */
	const lobe_slope_stats a = measure(normals);
	measured("normals against heights", central_differ(a, s.mean_x, s.mean_y, s.var_x, s.var_y, s.cov), 1e-8);
	for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
		n[i] *= 4.0f;
	TEST_ASSERT_TRUE_MESSAGE(central_differ(measure(normals), a.mean_x, a.mean_y, a.var_x, a.var_y, a.cov) == 0.0,
				 "normals need not be unit");
	normals.kind = LOBE_SLOPES_NORMAL_PICTURE;
	normals.texels = encoded;
	measured("normals of a picture against heights",
		 central_differ(measure(normals), s.mean_x, s.mean_y, s.var_x, s.var_y, s.cov), 1e-7);
	normals.flip_y = 1;
	const lobe_slope_stats f = measure(normals);
	measured("flipped: Cov", fabs(f.cov + s.cov), 1e-7);
	free(n);
	free(encoded);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_plane);
	RUN_TEST(test_waves);
	RUN_TEST(test_stride);
	RUN_TEST(test_two_passes);
	RUN_TEST(test_normals);
	heights_free();
	return UNITY_END() != 0;
}
