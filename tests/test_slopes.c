/* test_slopes.c - slopes.h: moments of maps with closed forms, the pyramid, layers, and bad input. */
#include "lobe/lobe.h"

#include "measured.h"
#include "support.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static float *texels;

/* A map of heights f(i, j) over the given memory. */
static lobe_slope_map heights(size_t width, size_t height, double (*f)(double, double))
{
	lobe_slope_map map;
	memset(&map, 0, sizeof map);
	free(texels);
	texels = malloc(width * height * sizeof *texels);
	TEST_ASSERT_NOT_NULL(texels);
	for (size_t j = 0; j < height; j++)
		for (size_t i = 0; i < width; i++)
			texels[j * width + i] = f ? (float)f((double)i, (double)j) : 0.0f;
	map.kind = LOBE_SLOPES_HEIGHT;
	map.texels = texels;
	map.width = width;
	map.height = height;
	map.texel_x = map.texel_y = 1.0;
	map.edge = LOBE_EDGE_WRAP;
	return map;
}

static lobe_slope_stats measure(lobe_slope_map map)
{
	lobe_slope_stats s;
	TEST_ASSERT_EQUAL_STRING("LOBE_OK", lobe_status_string(lobe_slope_stats_measure(&s, &map)));
	return s;
}

static double worst_of(const double *a, const double *b, int n)
{
	double worst = 0.0;
	for (int k = 0; k < n; k++)
		worst = larger(worst, isnan(a[k]) ? HUGE_VAL : fabs(a[k] - b[k]));
	return worst;
}

static double moments_differ(lobe_slope_moments a, lobe_slope_moments b)
{
	const double p[5] = {a.x, a.y, a.xx, a.yy, a.xy}, q[5] = {b.x, b.y, b.xx, b.yy, b.xy};
	return worst_of(p, q, 5);
}

/* mean x, y, variance x, y, covariance */
static double central_differ(lobe_slope_stats s, double x, double y, double xx, double yy, double xy)
{
	const double p[5] = {s.mean_x, s.mean_y, s.var_x, s.var_y, s.cov}, q[5] = {x, y, xx, yy, xy};
	return worst_of(p, q, 5);
}

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

enum { WIDTH = 96, HEIGHT = 60 };
static const int wave[3][2] = {{5, 3}, {7, -4}, {2, 11}};
static const double amplitude[3] = {1.5, 0.75, 0.4};

static double waves(double i, double j)
{
	double h = 0.0;
	for (int k = 0; k < 3; k++)
		h += amplitude[k] * cos(TWO_PI * (wave[k][0] * i / WIDTH + wave[k][1] * j / HEIGHT) + 0.3 * k);
	return h;
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

/* --- pyramid ------------------------------------------------------------------------------------------------------ */

static double noise(double i, double j) { return (double)test_uniform(1, (uint64_t)(i + 4096.0 * j)) + 0.01 * i; }

/* What texel i of `to` covers of [0, from), by the definition: the measure of the overlap of two intervals. */
static double overlap(size_t i, size_t to, size_t k, size_t from)
{
	const double lo = fmax((double)i / (double)to, (double)k / (double)from);
	const double hi = fmin((double)(i + 1) / (double)to, (double)(k + 1) / (double)from);
	return hi > lo ? (hi - lo) * (double)to : 0.0;
}

static void test_pyramid(void)
{
	static const size_t sizes[][2] = {{1, 1}, {2, 1},  {1, 7},   {3, 3},    {5, 2},
					  {8, 8}, {13, 6}, {64, 64}, {100, 37}, {255, 129}};
	double worst_top = 0.0, worst_mean = 0.0, worst_area = 0.0;
	for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
		const size_t width = sizes[s][0], height = sizes[s][1], levels = lobe_slope_levels(width, height);
		lobe_slope_map map = heights(width, height, noise);
		size_t count, offset, w, h, end;
		map.edge = LOBE_EDGE_CLAMP;
		TEST_ASSERT_EQUAL_INT(LOBE_OK, lobe_slope_level(&count, &w, &h, width, height, levels));
		TEST_ASSERT_TRUE(w == 0 && h == 0);
		TEST_ASSERT_EQUAL_INT(LOBE_OK, lobe_slope_level(&end, &w, &h, width, height, levels - 1));
		TEST_ASSERT_TRUE(w == 1 && h == 1 && end == count - 1);
		lobe_slope_moments *pyramid = malloc((count + 1) * sizeof *pyramid);
		TEST_ASSERT_NOT_NULL(pyramid);
		memset(pyramid, 0x7f, (count + 1) * sizeof *pyramid);
		const lobe_slope_moments guard = pyramid[count];
		TEST_ASSERT_EQUAL_INT(LOBE_OK, lobe_slope_pyramid(pyramid, count, &map));
		TEST_ASSERT_TRUE(memcmp(&guard, &pyramid[count], sizeof guard) == 0);
		worst_top = larger(worst_top, moments_differ(pyramid[count - 1], measure(map).moments));
		for (size_t level = 1; level < levels; level++) {
			lobe_slope_level(&offset, &w, &h, width, height, level);
			double mean = 0.0;
			for (size_t i = 0; i < w * h; i++)
				mean += pyramid[offset + i].xy / (double)(w * h);
			worst_mean = larger(worst_mean, fabs(mean - pyramid[count - 1].xy));
			/* One texel of it straight from the level below, by overlaps. */
			size_t below, bw, bh;
			lobe_slope_level(&below, &bw, &bh, width, height, level - 1);
			const size_t i = w - 1 - w / 3, j = h / 2;
			double xx = 0.0, area = 0.0;
			for (size_t l = 0; l < bh; l++)
				for (size_t k = 0; k < bw; k++) {
					const double share = overlap(i, w, k, bw) * overlap(j, h, l, bh);
					xx += share * pyramid[below + l * bw + k].xx;
					area += share;
				}
			worst_area = larger(worst_area, fabs(xx - pyramid[offset + j * w + i].xx));
			TEST_ASSERT_TRUE(fabs(area - 1.0) < 1e-12);
		}
		free(pyramid);
	}
	measured("last level against the moments of the map", worst_top, 1e-13);
	measured("mean of each level against the last", worst_mean, 1e-13);
	measured("a texel against its overlaps", worst_area, 1e-13);
}

/* --- layers ------------------------------------------------------------------------------------------------------- */

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
	TEST_ASSERT_TRUE(isnan(lobe_slope_central((lobe_slope_moments){NAN, 0, 1, 1, 0}).var_x));
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

/* --- bad input ---------------------------------------------------------------------------------------------------- */

static lobe_slope_stats before, after;

/* An argument error whose message has the words, and an untouched output. */
static void refused(const lobe_slope_map *map, const char *words)
{
	memset(&before, 0x5a, sizeof before);
	after = before;
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_stats_measure(&after, map));
	TEST_ASSERT_TRUE_MESSAGE(strstr(lobe_error_message(), words) != NULL, lobe_error_message());
	TEST_ASSERT_TRUE(memcmp(&before, &after, sizeof before) == 0);
	lobe_slope_moments pyramid[200];
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_pyramid(pyramid, 200, map));
	TEST_ASSERT_TRUE_MESSAGE(strstr(lobe_error_message(), words) != NULL, lobe_error_message());
}

static void test_bad_input(void)
{
	const lobe_slope_map good = heights(8, 8, noise);
	lobe_slope_map m;
	float normal[12] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_stats_measure(NULL, &good));
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "stats"));
	refused(NULL, "map is NULL");
#define WITH(change, words)                                                                                            \
	do {                                                                                                           \
		m = good;                                                                                              \
		change;                                                                                                \
		refused(&m, words);                                                                                    \
	} while (0)
	WITH(m.kind = (lobe_slope_kind)3, "map.kind");
	WITH(m.kind = (lobe_slope_kind)-1, "map.kind");
	WITH(m.texels = NULL, "map.texels");
	WITH(m.texels = (const float *)((const char *)good.texels + 1), "aligned");
	WITH(m.width = 0, "map.width");
	WITH(m.height = 0, "map.height");
	WITH(m.width = SIZE_MAX; m.height = 2, "map.width x map.height");
	WITH(m.width = SIZE_MAX / 2; m.height = 1, "map.width x map.height");
	WITH(m.stride = 7, "map.stride");
	WITH(m.stride = SIZE_MAX / 4, "map.stride");
	WITH(m.texel_x = 0.0, "map.texel_x");
	WITH(m.texel_y = -1.0, "map.texel_y");
	WITH(m.texel_x = (double)NAN, "map.texel_x");
	WITH(m.texel_y = (double)INFINITY, "map.texel_y");
	WITH(m.edge = (lobe_slope_edge)2, "map.edge");
	WITH(m.texel_x = 1e-320, "the slope at column 0, row 0 is too steep");
	texels[8 * 5 + 3] = NAN;
	refused(&good, "the height at column 3, row 5 is nan");
	texels[8 * 5 + 3] = INFINITY;
	refused(&good, "the height at column 3, row 5 is inf");
	m = good;
	m.width = m.height = 1;
	texels[0] = NAN;
	refused(&m, "column 0, row 0");
	m.kind = LOBE_SLOPES_NORMAL;
	m.texels = normal;
	m.width = m.height = 2;
	TEST_ASSERT_EQUAL_INT(LOBE_OK, lobe_slope_stats_measure(&after, &m));
	for (int k = 0; k < 4; k++) {
		normal[11] = (const float[]){0.0f, -1.0f, NAN, INFINITY}[k];
		refused(&m, "column 1, row 1");
	}
	normal[11] = 1.0f;
	normal[9] = INFINITY;
	refused(&m, "z > 0");
	m.stride = 5;
	refused(&m, "map.stride");

	lobe_slope_moments pyramid[3];
	size_t n = 99;
	m = good;
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_pyramid(NULL, 1000, &m));
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "pyramid"));
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_pyramid(pyramid, 3, &m));
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "has 85 elements"));
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_level(&n, NULL, NULL, 8, 8, 5));
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "level"));
	TEST_ASSERT_EQUAL_INT(LOBE_ERROR_ARGUMENT, lobe_slope_level(&n, NULL, NULL, 0, 8, 0));
	TEST_ASSERT_TRUE(n == 99 && lobe_slope_levels(0, 8) == 0 && lobe_slope_levels(5, 9) == 4);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_plane);
	RUN_TEST(test_waves);
	RUN_TEST(test_stride);
	RUN_TEST(test_two_passes);
	RUN_TEST(test_normals);
	RUN_TEST(test_pyramid);
	RUN_TEST(test_layers);
	RUN_TEST(test_linear);
	RUN_TEST(test_bad_input);
	free(texels);
	return UNITY_END() != 0;
}
