/* test_slopes_pyramid.c - slopes.h: the levels of the pyramid of a map of any size against the map and the levels
 * below. */
#include "lobe/lobe.h"

#include "measured.h"
#include "slope_maps.h"
#include "unity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

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

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_pyramid);
	heights_free();
	return UNITY_END() != 0;
}
