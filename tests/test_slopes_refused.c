/* test_slopes_refused.c - slopes.h: bad input is refused by the name of what is bad, and nothing is written. */
#include "lobe/lobe.h"

#include "slope_maps.h"
#include "unity.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

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
	RUN_TEST(test_bad_input);
	heights_free();
	return UNITY_END() != 0;
}
