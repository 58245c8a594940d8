/* test_smith_opencl.c - linear.h and smith.h as OpenCL C: the same bits as in C, for every constructor and function, on
 * random surfaces and on parameters that are none. */
#include "lobe/lobe.h"
#include "lobe/microfacet/smith.h"

#include "opencl_kernel.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 20000, IN = 16, OUT = 24 };

void setUp(void) {}
void tearDown(void) {}

/* The very text that both compilers read: one element from in[IN] to out[OUT]. */
#define TEXT_(...) #__VA_ARGS__
#define TEXT(...)  TEXT_(__VA_ARGS__)

#define ELEMENT                                                                                                        \
	const lobe_vec3 w = lobe_vec3_make(in[0], in[1], in[2]);                                                       \
	const lobe_vec3 h = lobe_vec3_make(in[3], in[4], in[5]);                                                       \
	const int way = (int)in[15];                                                                                   \
	lobe_linear m = lobe_linear_correlated(in[6], in[7], in[8]);                                                   \
	if (way == 1)                                                                                                  \
		m = lobe_linear_rotated(in[6], in[7], in[8]);                                                          \
	if (way == 2)                                                                                                  \
		m = lobe_linear_from_moments(0.0f, 0.0f, in[6], in[7], in[8] * in[6]);                                 \
	if (way == 3)                                                                                                  \
		m = lobe_linear_from_points(in[6], in[8], in[9], in[7], in[10], in[11], 1.5f);                         \
	if (way == 4)                                                                                                  \
		m = lobe_linear_compose(m, lobe_linear_make(in[6], in[8], in[9], in[7], in[10], in[11]));              \
	m = lobe_linear_tilted(m, in[9], in[10]);                                                                      \
	const lobe_smith s = lobe_smith_make(lobe_distribution_make((lobe_uint)in[14]), m);                            \
	const lobe_vec3 v = lobe_linear_direction(m, w);                                                               \
	const lobe_vec3 f = lobe_linear_facet(m, h);                                                                   \
	const lobe_vec3 n = lobe_linear_normal(m, h);                                                                  \
	const lobe_vec3 x = lobe_smith_visible(s, w, lobe_vec2_make(in[12], in[13]));                                  \
	out[0] = v.x;                                                                                                  \
	out[1] = v.y;                                                                                                  \
	out[2] = v.z;                                                                                                  \
	out[3] = f.x;                                                                                                  \
	out[4] = f.y;                                                                                                  \
	out[5] = n.x;                                                                                                  \
	out[6] = n.y;                                                                                                  \
	out[7] = m.norm;                                                                                               \
	out[8] = lobe_smith_d(s, h);                                                                                   \
	out[9] = lobe_smith_p22(s, h.x, h.y);                                                                          \
	out[10] = lobe_smith_sigma(s, w);                                                                              \
	out[11] = lobe_smith_g1(s, w);                                                                                 \
	out[12] = lobe_smith_g2(s, w, h);                                                                              \
	out[13] = x.x;                                                                                                 \
	out[14] = x.y;                                                                                                 \
	out[15] = x.z;                                                                                                 \
	out[16] = lobe_smith_visible_pdf(s, w, x);                                                                     \
	out[17] = m.xx;                                                                                                \
	out[18] = m.xy;                                                                                                \
	out[19] = m.yx;                                                                                                \
	out[20] = m.yy;                                                                                                \
	out[21] = m.iyx;                                                                                               \
	out[22] = m.mean_x;                                                                                            \
	out[23] = m.mean_y;

static void in_c(const float *in, float *out) { ELEMENT }

static const char kernel_source[] =
	"#include \"lobe/microfacet/smith.h\"\n"
	"static void element(const float *in, float *out) { " TEXT(
		ELEMENT) " }\n"
			 "__kernel void run(__global const float *in, __global float *out)\n"
			 "{\n"
			 "	float a[16], b[24];\n"
			 "	size_t at = get_global_id(0);\n"
			 "	for (int k = 0; k < 16; k++) a[k] = in[16 * at + k];\n"
			 "	element(a, b);\n"
			 "	for (int k = 0; k < 24; k++) out[24 * at + k] = b[k];\n"
			 "}\n";

static float in[N][IN], expected[N][OUT], got[N][OUT];

static void prepare(void)
{
	static const float odd[] = {0.0f, 1.0f, -1.0f, 1e-4f, 100.0f, NAN, INFINITY, 1e30f};
	for (uint64_t i = 0; i < N; i++) {
		test_direction(1, i, in[i]);
		test_direction(2, i, in[i] + 3);
		in[i][5] = fabsf(in[i][5]);
		for (uint64_t k = 6; k < 14; k++)
			in[i][k] = test_uniform(3, IN * i + k);
		in[i][6] = powf(10.0f, 5.0f * in[i][6] - 4.0f);
		in[i][7] = powf(10.0f, 5.0f * in[i][7] - 4.0f);
		for (uint64_t k = 8; k < 12; k++)
			in[i][k] = 2.0f * in[i][k] - 1.0f;
		if (i % 2)
			in[i][9] *= 100.0f;
		if (i % 10 == 9)
			in[i][test_bits(4, 2 * i) % 12] = odd[test_bits(4, 2 * i + 1) % 8];
		/* Every distribution without a shape. */
		static const float fixed[] = {
#define LOBE_NDF_FIXED(NAME, name, number) number,
#define LOBE_NDF_SHAPED(NAME, name, number)
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
		};
		in[i][14] = fixed[i / 5 % (sizeof fixed / sizeof fixed[0])];
		in[i][15] = (float)(i % 5);
		in_c(in[i], expected[i]);
	}
}

static void test_the_same_bits(void)
{
	size_t devices = 0;
	prepare();
	if (lobe_device_count("opencl", &devices) != LOBE_OK || devices == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	size_t tested = 0;
	for (size_t k = 0; k < devices; k++) {
		size_t differing = 0, numbers = 0;
		if (!opencl_kernel_run(k, kernel_source, N, in, sizeof in, got, sizeof got))
			continue;
		tested++;
		for (size_t i = 0; i < N; i++)
			for (size_t j = 0; j < OUT; j++) {
				/* Any NaN is as good as another. */
				const int same = test_float_bits(expected[i][j]) == test_float_bits(got[i][j]) ||
						 (isnan(expected[i][j]) && isnan(got[i][j]));
				numbers += !isnan(expected[i][j]) && expected[i][j] != 0.0f;
				if (!same && differing++ < 5)
					printf("  element %zu, output %zu: %a in C, %a on the device\n", i, j,
					       (double)expected[i][j], (double)got[i][j]);
			}
		printf("  %zu of %d differ; %zu are neither 0 nor NaN\n", differing, N * OUT, numbers);
		TEST_ASSERT_EQUAL_UINT(0, differing);
		TEST_ASSERT_TRUE(numbers > N * OUT / 2);
	}
	if (tested == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device that can be opened");
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_the_same_bits);
	return UNITY_END() != 0;
}
