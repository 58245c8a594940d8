/* test_distributions_opencl.c - every distribution of microfacet/distribution.h on every OpenCL device, from a table in
 * the kernel's own buffer: not one bit may differ from C. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "distribution_cases.h"
#include "lobe/lobe.h"
#include "opencl_api.h"
#include "support.h"
#include "unity.h"

enum { N = 50000, INPUTS = 6, OUTPUTS = 15, COMPARISONS = 12 };

/* What stands in here is compiled as C and kept as text for OpenCL. */
#define SHARED(...) __VA_ARGS__ static const char shared_source[] = #__VA_ARGS__ "\n"

/* clang-format off */
SHARED(
	typedef struct {
		lobe_facet_density density;
		lobe_real hidden; lobe_real sigma; lobe_real tail; lobe_real inverse;
		lobe_vec3 visible; lobe_vec3 plain;
		lobe_real walter; lobe_real fit; lobe_real closed;
	} all_results;

	LOBE_FN all_results all_of(lobe_distribution d, lobe_vec3 v, lobe_real x, lobe_vec2 u)
	{
		all_results r;
		r.density = lobe_distribution_density(d, v);
		r.hidden = lobe_distribution_hidden(d, v);
		r.sigma = lobe_distribution_sigma(d, v);
		r.tail = lobe_distribution_tail(d, LOBE_R(1.0) / x - LOBE_R(1.0));
		r.inverse = lobe_distribution_tail_inverse(d, x);
		r.visible = lobe_distribution_visible(d, v, u);
		r.plain = lobe_distribution_plain(d, u);
		r.walter = lobe_phong_hidden_walter(d, v);
		r.fit = lobe_student_t_hidden_fit(d, v);
		r.closed = lobe_gtr_hidden_closed(d, v);
		return r;
	}
);
/* clang-format on */

/* shape: ndf, exponent, width, norm of each case. */
static const char kernel_source[] =
	"__kernel void distributions(__global const float *tables, __global const uint4 *shape, uint cases,\n"
	"			     __global const float *in, __global all_results *out)\n"
	"{\n"
	"	const uint i = get_global_id(0), c = i % cases;\n"
	"	lobe_distribution d;\n"
	"	d.ndf = shape[c].x;\n"
	"	d.exponent = as_float(shape[c].y);\n"
	"	d.width = as_float(shape[c].z);\n"
	"	d.norm = as_float(shape[c].w);\n"
	"	d.table = lobe_table_at((ulong)(tables + c * LOBE_PROFILE_WORDS));\n"
	"	__global const float *x = in + 6 * i;\n"
	"	out[i] = all_of(d, lobe_vec3_make(x[0], x[1], x[2]), x[3], lobe_vec2_make(x[4], x[5]));\n"
	"}\n";

static const lobe_cl_functions *cl;
static size_t device_count, case_total;
static const distribution_case *cases;
static float in[N][INPUTS];
static all_results expected[N], got[N];
static uint32_t shape[DISTRIBUTION_CASES_MAX][4];
static float tables[DISTRIBUTION_CASES_MAX][LOBE_PROFILE_WORDS];

void setUp(void) {}
void tearDown(void) {}

static const lobe_distribution plain_ggx = {LOBE_NDF_GGX, 0.0f, 1.0f, 1.0f, {0u, 0u}};

/* The cases, and GGX, which has no table, as one more. */
static lobe_distribution distribution_at(size_t c) { return c < case_total - 1 ? cases[c].d : plain_ggx; }

static void prepare(void)
{
	static const float extreme_u[] = {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f};
	cases = distribution_cases(&case_total);
	TEST_ASSERT_NOT_NULL(cases);
	case_total++;
	TEST_ASSERT_EQUAL(sizeof(all_results), OUTPUTS * sizeof(float));
	for (size_t c = 0; c < case_total; c++) {
		const lobe_distribution d = distribution_at(c);
		const uint32_t s[4] = {d.ndf, test_float_bits(d.exponent), test_float_bits(d.width),
				       test_float_bits(d.norm)};
		memcpy(shape[c], s, sizeof s);
		if (c < case_total - 1)
			memcpy(tables[c], (const void *)(uintptr_t)lobe_table_address(d.table), sizeof tables[c]);
	}
	for (uint32_t i = 0; i < N; i++) {
		/* Stretched by any width, and every so often exactly along or across the normal. */
		const float width = powf(10.0f, -4.0f * test_uniform(11, 4 * i));
		test_direction(12, i, in[i]);
		in[i][0] *= width;
		in[i][1] *= width;
		if (i / case_total % 16 == 3)
			in[i][2] = 0.0f;
		if (i / case_total % 16 == 7)
			in[i][0] = in[i][1] = 0.0f;
		in[i][3] = powf(10.0f, -8.0f * test_uniform(11, 4 * i + 1));
		in[i][4] = i / case_total % 8 == 5 ? extreme_u[test_bits(13, i) % 4] : test_uniform(11, 4 * i + 2);
		in[i][5] = i / case_total % 8 == 6 ? extreme_u[test_bits(13, i) % 4] : test_uniform(11, 4 * i + 3);
		expected[i] = all_of(distribution_at(i % case_total), lobe_vec3_make(in[i][0], in[i][1], in[i][2]),
				     in[i][3], lobe_vec2_make(in[i][4], in[i][5]));
	}
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_count("opencl", &device_count), lobe_error_message());
	cl = lobe_cl_load();
}

static cl_mem buffer(cl_context context, const void *from, size_t size)
{
	cl_int error;
	cl_mem b = cl->clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, size, (void *)(uintptr_t)from,
				      &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	return b;
}

static void run_on(lobe_device *device)
{
	cl_context context;
	cl_device_id id;
	cl_command_queue queue;
	cl_int error;
	const size_t n = N;
	const cl_uint count = (cl_uint)case_total;
	const char *sources[] = {lobe_opencl_source(), shared_source, kernel_source};
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(device, &context, &id, &queue));
	cl_program program = cl->clCreateProgramWithSource(context, 3, sources, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clBuildProgram(program, 1, &id, lobe_opencl_options(NULL), NULL, NULL));
	cl_kernel kernel = cl->clCreateKernel(program, "distributions", &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	memset(got, 0xee, sizeof got);
	cl_mem b[4] = {buffer(context, tables, sizeof tables), buffer(context, shape, sizeof shape),
		       buffer(context, in, sizeof in), buffer(context, got, sizeof got)};
	cl->clSetKernelArg(kernel, 0, sizeof b[0], &b[0]);
	cl->clSetKernelArg(kernel, 1, sizeof b[1], &b[1]);
	cl->clSetKernelArg(kernel, 2, sizeof count, &count);
	cl->clSetKernelArg(kernel, 3, sizeof b[2], &b[2]);
	cl->clSetKernelArg(kernel, 4, sizeof b[3], &b[3]);
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &n, NULL, 0, NULL, NULL));
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clEnqueueReadBuffer(queue, b[3], CL_TRUE, 0, sizeof got, got, 0, NULL, NULL));
	for (int k = 0; k < 4; k++)
		cl->clReleaseMemObject(b[k]);
	cl->clReleaseKernel(kernel);
	cl->clReleaseProgram(program);
}

static void test_same_bits(void)
{
	if (device_count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	for (size_t i = 0; i < device_count; i++) {
		char name[32];
		lobe_device *d;
		uint64_t differ = 0, nans = 0;
		snprintf(name, sizeof name, "opencl:%zu", i);
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, name));
		run_on(d);
		for (size_t k = 0; k < N; k++) {
			float a[OUTPUTS], b[OUTPUTS];
			memcpy(a, &expected[k], sizeof a);
			memcpy(b, &got[k], sizeof b);
			for (int o = 0; o < OUTPUTS; o++) {
				/* The published approximations divide by |v.xy|; nothing else may be undefined. */
				nans += o < COMPARISONS && (isnan(a[o]) || isnan(b[o]));
				if (test_float_bits(a[o]) != test_float_bits(b[o]) && !(isnan(a[o]) && isnan(b[o])) &&
				    differ++ < 10)
					printf("  %zu: output %d of case %zu: %a %a\n", k, o, k % case_total,
					       (double)a[o], (double)b[o]);
			}
		}
		printf("  %s: %d x %d results of %zu distributions, %llu differ, %llu are NaN\n", lobe_device_name(d),
		       N, OUTPUTS, case_total, (unsigned long long)differ, (unsigned long long)nans);
		lobe_device_close(d);
		TEST_ASSERT_TRUE(differ == 0);
		TEST_ASSERT_TRUE(nans == 0);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(prepare);
	RUN_TEST(test_same_bits);
	return UNITY_END();
}
