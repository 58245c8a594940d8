#include "slope_maps.h"

#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

float *texels;

lobe_slope_map heights(size_t width, size_t height, double (*f)(double, double))
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

void heights_free(void)
{
	free(texels);
	texels = NULL;
}

lobe_slope_stats measure(lobe_slope_map map)
{
	lobe_slope_stats s;
	TEST_ASSERT_EQUAL_STRING("LOBE_OK", lobe_status_string(lobe_slope_stats_measure(&s, &map)));
	return s;
}

double worst_of(const double *a, const double *b, int n)
{
	double worst = 0.0;
	for (int k = 0; k < n; k++)
		worst = larger(worst, isnan(a[k]) ? HUGE_VAL : fabs(a[k] - b[k]));
	return worst;
}

double moments_differ(lobe_slope_moments a, lobe_slope_moments b)
{
	const double p[5] = {a.x, a.y, a.xx, a.yy, a.xy}, q[5] = {b.x, b.y, b.xx, b.yy, b.xy};
	return worst_of(p, q, 5);
}

double central_differ(lobe_slope_stats s, double x, double y, double xx, double yy, double xy)
{
	const double p[5] = {s.mean_x, s.mean_y, s.var_x, s.var_y, s.cov}, q[5] = {x, y, xx, yy, xy};
	return worst_of(p, q, 5);
}

const int wave[3][2] = {{5, 3}, {7, -4}, {2, 11}};
const double amplitude[3] = {1.5, 0.75, 0.4};

double waves(double i, double j)
{
	double h = 0.0;
	for (int k = 0; k < 3; k++)
		h += amplitude[k] * cos(TWO_PI * (wave[k][0] * i / WIDTH + wave[k][1] * j / HEIGHT) + 0.3 * k);
	return h;
}

double noise(double i, double j) { return (double)test_uniform(1, (uint64_t)(i + 4096.0 * j)) + 0.01 * i; }
