/* test_opencl_faults.c - every OpenCL call fails in turn, the first time it is made, the second and so on: each failure
 * comes back as a status whose message names the call, nothing is leaked, and the next batch works. */
#define _XOPEN_SOURCE 700
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch_fixture.h"
#include "cl_faults.h"
#include "inputs.h"
#include "internal.h"
#include "lobe/lobe.h"
#include "unity.h"

enum { N = 1003 };

/* A call to fail, and whether the library may carry on without it (a question about the device, say). */
static const struct {
	const char *name;
	int may_succeed;
} calls[] = {
	{"clGetPlatformIDs", 0},
	{"clGetPlatformInfo", 1},
	{"clGetDeviceIDs", 1},
	{"clGetDeviceInfo", 1},
	{"clCreateContext", 0},
	{"clCreateCommandQueue", 0},
	{"clRetainDevice", 1},
	{"clCreateProgramWithSource", 0},
	{"clBuildProgram", 0},
	{"clCreateProgramWithBinary", 1},
	{"clGetProgramInfo", 1},
	{"clCreateKernel", 0},
	{"clCreateBuffer", 0},
	{"clSetKernelArg", 0},
	{"clGetKernelWorkGroupInfo", 1},
	{"clEnqueueWriteBuffer", 0},
	{"clEnqueueNDRangeKernel", 0},
	{"clEnqueueMapBuffer", 0},
	{"clEnqueueUnmapMemObject", 0},
	{"clEnqueueReadBuffer", 0},
	{"clFlush", 1},
	{"clFinish", 1},
	{"clGetMemObjectInfo", 0},
};

static int cached; /* programs come from the cache, and without it from source */
static int reached_times[sizeof calls / sizeof *calls];

/* --- one life of a device: open, scene, batch --------------------------------------------------------------------- */

static inputs in;
static uint32_t material[N];
static lobe_bsdf materials[3];
static float out[12][N], expected[12][N];

/* A batch on buffers of the device, and what is asked of them; the buffers are made behind the wrappers' back. */
static lobe_status eval_on_buffers(lobe_device *device, lobe_scene *scene)
{
	cl_context context;
	cl_mem buffer[7];
	lobe_cl_batch b;
	lobe_status status = lobe_device_cl(device, &context, NULL, NULL);
	if (status != LOBE_OK)
		return status;
	for (int k = 0; k < 7; k++)
		buffer[k] =
			cl_faults.real.clCreateBuffer(context, CL_MEM_READ_WRITE | (k < 6 ? CL_MEM_COPY_HOST_PTR : 0),
						      N * 4, k < 6 ? in.array[k] : NULL, NULL);
	memset(&b, 0, sizeof b);
	b.count = N;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = buffer[k];
		b.wi[k] = buffer[3 + k];
	}
	b.pdf = buffer[6];
	status = lobe_scene_eval_cl(scene, &b);
	for (int k = 0; k < 7; k++)
		cl_faults.real.clReleaseMemObject(buffer[k]);
	return status;
}

/* name: the device to live on. */
static lobe_status live_on(const char *name)
{
	lobe_device *device;
	lobe_scene *scene;
	const lobe_batch b = inputs_batch(in, material, out[0]);
	lobe_status status = lobe_device_open(&device, name);
	if (status != LOBE_OK)
		return status;
	status = lobe_scene_create(&scene, device, materials, 3);
	if (status == LOBE_OK) {
		status = lobe_scene_eval(scene, &b);
		if (status == LOBE_OK)
			status = lobe_scene_sample(scene, &b);
		if (status == LOBE_OK && strcmp(name, "opencl") == 0)
			status = eval_on_buffers(device, scene);
		lobe_scene_destroy(scene);
	}
	lobe_device_close(device);
	return status;
}

static lobe_status live_once(void) { return live_on("opencl"); }

void setUp(void) { NEEDS_OPENCL(); }
void tearDown(void) {}

static void install(void)
{
	in = inputs_alloc(N);
	inputs_random(in, 8000000);
	fixture_materials(materials, material, N);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_on("native:1"), lobe_error_message());
	memcpy(expected, out, sizeof expected);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof expected);
}

static void test_nothing_leaks(void)
{
	TEST_ASSERT_EQUAL_MESSAGE(0, cl_faults.live, "objects created and not released");
}

static void fail_each(cl_int code, int check_memory)
{
	cl_faults.failure = code;
	for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
		int failed = 0, made = 0;
		cl_faults.failing = calls[c].name;
		/* The first few calls of this name, then later ones further apart. */
		for (long at = 0; at < 64; at += at < 6 ? 1 : at) {
			cl_faults.countdown = at;
			const lobe_status status = live_once();
			const int reached = cl_faults.countdown < 0;
			made += reached;
			reached_times[c] += reached;
			if (!reached) {
				TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, status, lobe_error_message());
				break;
			}
			failed += status != LOBE_OK;
			if (status == LOBE_OK) {
				const int build = strcmp(cl_faults.failing, "clBuildProgram") == 0;
				TEST_ASSERT_TRUE_MESSAGE(calls[c].may_succeed || (build && cached), cl_faults.failing);
			} else {
				const int build = strcmp(cl_faults.failing, "clBuildProgram") == 0;
				const lobe_status right =
					check_memory ? LOBE_ERROR_MEMORY : (build ? LOBE_ERROR_BUILD : status);
				TEST_ASSERT_EQUAL_STRING(lobe_status_string(right), lobe_status_string(status));
				TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), cl_faults.failing),
							     lobe_error_message());
			}
			TEST_ASSERT_EQUAL_MESSAGE(0, cl_faults.live, cl_faults.failing);
		}
		printf("  %-28s failed %d of %d times\n", cl_faults.failing, failed, made);
		/* The library is as good as before. */
		cl_faults.failing = "";
		memset(out, 0, sizeof out);
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
		TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof expected);
		TEST_ASSERT_EQUAL(0, cl_faults.live);
	}
}

/* The path of a device with memory of its own: copies in and out, in rounds, one work-item for each element. */
static void test_discrete_memory(void)
{
	cl_faults.discrete = 1;
	cl_faults.room = 4 * 777;
	memset(out, 0xee, sizeof out);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof expected);
	TEST_ASSERT_EQUAL(0, cl_faults.live);
	fail_each(CL_INVALID_VALUE, 0);
	cl_faults.discrete = 0;
	cl_faults.room = 0;
}

/* Programs from the cache. A call that fails on the way there leads back to the source. */
static void test_cache(void)
{
	char folder[] = "/tmp/lobe-faults-XXXXXX", path[64];
	TEST_ASSERT_NOT_NULL(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/cache", folder);
	setenv("LOBE_CACHE_DIR", path, 1);
	cached = 1;
	fail_each(CL_INVALID_VALUE, 0);
	cached = 0;
	setenv("LOBE_CACHE_DIR", "", 1);
	snprintf(path, sizeof path, "rm -r %s", folder);
	TEST_ASSERT_EQUAL(0, system(path));
}

/* --- large batches on devices with memory of their own ------------------------------------------------------------ */

enum { LARGE = 200000 };
static const size_t large_size = INPUTS_OUTPUTS * LARGE * sizeof(float);
static inputs large;
static uint32_t *large_material;
static float *large_out, *large_expected;

/* mixed: by material; else the first material throughout. only_pdf: few of the outputs, the rest is scratch. */
static void shade_large(const char *name, float *to, int mixed, int only_pdf)
{
	lobe_device *device;
	lobe_scene *scene;
	lobe_batch b = inputs_batch(large, mixed ? large_material : NULL, to);
	if (only_pdf)
		for (int k = 0; k < 3; k++)
			b.weight[k] = b.sample_wi[k] = NULL;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&device, name), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, 3), lobe_error_message());
	cl_faults.counted = 0;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	lobe_scene_destroy(scene);
	lobe_device_close(device);
}

static void compare_large(void)
{
	for (int mixed = 0; mixed < 2; mixed++)
		for (int only_pdf = 0; only_pdf < 2; only_pdf++) {
			memset(large_out, 0xee, large_size);
			memset(large_expected, 0xee, large_size);
			shade_large("native", large_expected, mixed, only_pdf);
			cl_faults.used = cl_faults.largest = 0;
			shade_large("opencl", large_out, mixed, only_pdf);
			TEST_ASSERT_EQUAL_MEMORY(large_expected, large_out, large_size);
			TEST_ASSERT_EQUAL(0, cl_faults.live);
			TEST_ASSERT_EQUAL_STRING("", lobe_error_message());
		}
}

static void prepare_large(void)
{
	large = inputs_alloc(LARGE);
	inputs_random(large, 7000000);
	large_material = malloc(LARGE * sizeof *large_material);
	TEST_ASSERT_NOT_NULL(large_material);
	for (uint32_t i = 0; i < LARGE; i++)
		large_material[i] = (i / 7 + i) % 3;
	large_out = malloc(large_size);
	large_expected = malloc(large_size);
	TEST_ASSERT_NOT_NULL(large_out);
	TEST_ASSERT_NOT_NULL(large_expected);
	lobe_set_error_message("%s", ""); /* nothing below sets it */
}

/* Four chunks on two queues, and no wait but the last one for each queue. */
static void test_chunks_overlap(void)
{
	cl_faults.discrete = 1;
	cl_faults.counting = "clFinish";
	compare_large();
	TEST_ASSERT_EQUAL_MESSAGE(2 * 2, cl_faults.counted, "two calls, two queues");
	TEST_ASSERT_EQUAL_MESSAGE(4 * LARGE / 4, cl_faults.largest, "bytes of a chunk's array");
	cl_faults.counting = "";
	cl_faults.discrete = 0;
}

/* Memory for a fraction of the batch: the two lanes take no more than half of it. */
static void test_little_memory(void)
{
	cl_faults.discrete = 1;
	cl_faults.memory = cl_faults.free = 4000000;
	compare_large();
	TEST_ASSERT_GREATER_THAN(1000000, cl_faults.used);
	TEST_ASSERT_LESS_OR_EQUAL(2000000 + 10000, cl_faults.used); /* and the scene's tables */
	cl_faults.memory = cl_faults.free = 0;
	cl_faults.discrete = 0;
}

/* No buffer may be larger than a fraction of the batch, whichever memory it is in. */
static void test_small_buffers(void)
{
	for (int discrete = 0; discrete < 2; discrete++) {
		cl_faults.discrete = discrete;
		cl_faults.room = 4 * 30011;
		compare_large();
		TEST_ASSERT_GREATER_THAN(4 * 20000, cl_faults.largest);
		TEST_ASSERT_LESS_OR_EQUAL(4 * 30011, cl_faults.largest);
	}
	cl_faults.room = 0;
	cl_faults.discrete = 0;
}

/* Other programs have taken most of the memory: chunks get smaller until they fit. When nothing fits, it is said. */
static void test_memory_taken(void)
{
	cl_faults.discrete = 1;
	cl_faults.free = 2000000;
	compare_large();
	TEST_ASSERT_LESS_OR_EQUAL(2000000, cl_faults.used);
	cl_faults.discrete = 0;
	cl_faults.free = 200000; /* for what is not wanted, and the order */
	compare_large();
	cl_faults.discrete = 1;
	cl_faults.free = 20000;
	TEST_ASSERT_EQUAL_STRING("LOBE_ERROR_MEMORY", lobe_status_string(live_on("opencl")));
	TEST_ASSERT_EQUAL(0, cl_faults.live);
	lobe_set_error_message("%s", "");
	cl_faults.free = 0;
	cl_faults.discrete = 0;
}

/* Each call is reached on one of the two paths at least. */
static void test_every_call_was_reached(void)
{
	for (size_t c = 0; c < sizeof calls / sizeof *calls; c++)
		TEST_ASSERT_GREATER_THAN_MESSAGE(0, reached_times[c], calls[c].name);
}

static void test_each_call_fails(void) { fail_each(CL_INVALID_VALUE, 0); }
static void test_out_of_memory(void) { fail_each(CL_MEM_OBJECT_ALLOCATION_FAILURE, 1); }

/* A program that the OpenCL compiler refuses: the message holds its log. */
static cl_int build_nonsense(cl_program p, cl_uint n, const cl_device_id *d, const char *o,
			     void (*notify)(cl_program, void *), void *u)
{
	char options[4096];
	snprintf(options, sizeof options, "%s -DLOBE_FN=nonsense", o);
	return cl_faults.real.clBuildProgram(p, n, d, options, notify, u);
}

static void test_build_log(void)
{
	lobe_cl_functions before = *cl_faults.table;
	cl_faults.table->clBuildProgram = build_nonsense;
	TEST_ASSERT_EQUAL_STRING("LOBE_ERROR_BUILD", lobe_status_string(live_once()));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), "error:"), lobe_error_message());
	*cl_faults.table = before;
	TEST_ASSERT_EQUAL(0, cl_faults.live);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
}

int main(void)
{
	setenv("LOBE_CACHE_DIR", "", 1);
	UNITY_BEGIN();
	RUN_TEST(install);
	RUN_TEST(test_nothing_leaks);
	RUN_TEST(test_each_call_fails);
	RUN_TEST(test_out_of_memory);
	RUN_TEST(test_build_log);
	RUN_TEST(test_discrete_memory);
	RUN_TEST(test_cache);
	RUN_TEST(prepare_large);
	RUN_TEST(test_chunks_overlap);
	RUN_TEST(test_little_memory);
	RUN_TEST(test_small_buffers);
	RUN_TEST(test_memory_taken);
	RUN_TEST(test_every_call_was_reached);
	return UNITY_END();
}
