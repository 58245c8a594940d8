/* test_recommend_opencl.c - lobe/recommend.h as OpenCL C: the same answers, to the bit, as in C, for random surfaces,
 * views and lights. */
#include "lobe/lobe.h"
#include "lobe/recommend.h"

#include "opencl_kernel.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

enum { N_MOST = 4096, IN = 16, OUT = 3 };

void setUp(void) {}
void tearDown(void) {}

/* The very text that both compilers read: one element from in[IN] to out[OUT]. */
#define TEXT_(...) #__VA_ARGS__
#define TEXT(...)  TEXT_(__VA_ARGS__)

#define ELEMENT                                                                                                        \
	const lobe_microsurface s =                                                                                    \
		lobe_microsurface_make(lobe_distribution_make((lobe_uint)in[0]), lobe_linear_stretch(in[1], in[2]));   \
	const lobe_vec3 wo = lobe_vec3_make(in[3], in[4], in[5]);                                                      \
	lobe_light_shape l = lobe_light_shape_disk(lobe_vec3_make(in[6], in[7], in[8]), in[9], in[10]);                \
	l = lobe_light_shape_with_glow(l, in[11], in[12]);                                                             \
	l.slope = in[13];                                                                                              \
	lobe_recommend_cost cost = lobe_recommend_cost_samples();                                                      \
	cost.light = in[14];                                                                                           \
	cost.lobe[LOBE_STRATEGY_BOUNDED_CAP] = in[15];                                                                 \
	const lobe_recommendation r = lobe_recommend_strategy(s, wo, l, cost);                                         \
	out[0] = (float)r.strategy;                                                                                    \
	out[1] = (float)r.from;                                                                                        \
	out[2] = r.deviation;

static void in_c(const float *in, float *out) { ELEMENT }

static const char kernel_source[] =
	"#include \"lobe/recommend.h\"\n"
	"static void element(const float *in, float *out) { " TEXT(
		ELEMENT) " }\n"
			 "__kernel void run(__global const float *in, __global float *out)\n"
			 "{\n"
			 "	float a[16], b[3];\n"
			 "	size_t at = get_global_id(0);\n"
			 "	for (int k = 0; k < 16; k++) a[k] = in[16 * at + k];\n"
			 "	element(a, b);\n"
			 "	for (int k = 0; k < 3; k++) out[3 * at + k] = b[k];\n"
			 "}\n";

static float in[N_MOST][IN], expected[N_MOST][OUT], got[N_MOST][OUT];

static size_t cases(void) { return test_long() ? N_MOST : 256; }

/* Suns to domes, some in the mirror image of the viewer; Beckmann too; directions of all kinds. */
static void prepare(void)
{
	for (uint64_t i = 0; i < cases(); i++) {
		float *x = in[i];
		for (uint64_t k = 0; k < IN; k++)
			x[k] = test_uniform(5, IN * i + k);
		const float share = x[10], rest = (1.0f - share) * x[12];
		x[0] = i % 3 == 2 ? (float)LOBE_NDF_BECKMANN : (float)LOBE_NDF_GGX;
		x[1] = powf(10.0f, 4.0f * x[1] - 4.0f);
		x[2] = i % 2 ? x[1] : powf(10.0f, 4.0f * x[2] - 4.0f);
		test_direction(6, i, x + 3);
		x[5] = i % 32 ? fabsf(x[5]) : -fabsf(x[5]); /* a few from behind */
		test_direction(7, i, x + 6);
		if (i % 4 == 1) {
			x[6] = -x[3];
			x[7] = -x[4];
			x[8] = x[5];
		}
		x[9] = 6.2f * powf(10.0f, -5.0f * x[9]);
		x[10] = i % 5 ? share : 0.0f;
		x[11] = 6.2f * powf(10.0f, -3.0f * x[11]);
		x[12] = i % 7 ? 0.0f : rest;
		x[13] = 3.0f * x[13] - 1.0f;
		x[14] = i % 11 ? 1.0f : 0.5f + x[14];
		x[15] = i % 11 ? 1.0f : 0.5f + x[15];
		in_c(x, expected[i]);
	}
}

static void test_the_same_answers(void)
{
	size_t devices = 0, seen[LOBE_SAMPLE_BOTH_POWER + 1] = {0};
	prepare();
	for (size_t i = 0; i < cases(); i++)
		seen[(int)expected[i][1]]++;
	for (size_t k = 0; k <= LOBE_SAMPLE_BOTH_POWER; k++) {
		printf("  from %zu: %zu of %zu\n", k, seen[k], cases());
		TEST_ASSERT_TRUE(seen[k] > 0);
	}
	if (lobe_device_count("opencl", &devices) != LOBE_OK || devices == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	const size_t count = cases();
	size_t tested = 0;
	for (size_t k = 0; k < devices; k++) {
		size_t differing = 0;
		if (!opencl_kernel_run(k, kernel_source, count, in, sizeof in, got, count * sizeof got[0]))
			continue;
		tested++;
		for (size_t i = 0; i < count; i++)
			for (size_t j = 0; j < OUT; j++)
				if (test_float_bits(expected[i][j]) != test_float_bits(got[i][j]) && differing++ < 5)
					printf("  element %zu, output %zu: %a in C, %a on the device\n", i, j,
					       (double)expected[i][j], (double)got[i][j]);
		printf("  %zu of %zu differ\n", differing, count * OUT);
		TEST_ASSERT_EQUAL_UINT(0, differing);
	}
	if (tested == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device that can be opened");
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_the_same_answers);
	return UNITY_END();
}
