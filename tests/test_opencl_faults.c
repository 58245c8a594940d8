/* test_opencl_faults.c - every OpenCL call fails in turn, the first time it is made, the second and so on: each failure
 * comes back as a status whose message names the call, nothing is leaked, and the next batch works.
 *
 * The library calls OpenCL through a table of functions (opencl_api.h); the test puts wrappers into it. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "opencl_api.h"
#include "unity.h"

enum { N = 1003 };

static lobe_cl_functions real;   /* OpenCL itself */
static lobe_cl_functions *table; /* what the library calls */
static const char *failing = ""; /* the call that fails ... */
static long countdown;           /* ... when this gets to 0 */
static cl_int failure;           /* ... with this code */
static int discrete; /* the device pretends to be a GPU: memory of its own, and room for 777 elements in a buffer */
static long live;    /* objects created and not released */

/* 1 when this call is the one to fail. */
static int fails(const char *name) { return strcmp(name, failing) == 0 && countdown-- == 0; }

/* --- the wrappers ----------------------------------------------------------------------------------------------------- */

#define CREATES(type, name, parameters, arguments)                                                                     \
	static type wrap_##name parameters                                                                             \
	{                                                                                                              \
		if (fails(#name)) {                                                                                    \
			if (error)                                                                                     \
				*error = failure;                                                                      \
			return NULL;                                                                                   \
		}                                                                                                      \
		type made = real.name arguments;                                                                       \
		live += made != NULL;                                                                                  \
		return made;                                                                                           \
	}
#define RELEASES(name, type)                                                                                           \
	static cl_int wrap_##name(type object)                                                                         \
	{                                                                                                              \
		live--;                                                                                                \
		return real.name(object);                                                                              \
	}
#define RETAINS(name, type)                                                                                            \
	static cl_int wrap_##name(type object)                                                                         \
	{                                                                                                              \
		if (fails(#name))                                                                                      \
			return failure;                                                                                \
		live++;                                                                                                \
		return real.name(object);                                                                              \
	}
#define DOES(name, parameters, arguments)                                                                              \
	static cl_int wrap_##name parameters { return fails(#name) ? failure : real.name arguments; }

CREATES(cl_context, clCreateContext,
	(const cl_context_properties *p, cl_uint n, const cl_device_id *d,
	 void (*notify)(const char *, const void *, size_t, void *), void *user, cl_int *error),
	(p, n, d, notify, user, error))
CREATES(cl_command_queue, clCreateCommandQueue, (cl_context c, cl_device_id d, cl_bitfield p, cl_int *error),
	(c, d, p, error))
CREATES(cl_program, clCreateProgramWithSource,
	(cl_context c, cl_uint n, const char **s, const size_t *l, cl_int *error), (c, n, s, l, error))
CREATES(cl_kernel, clCreateKernel, (cl_program p, const char *name, cl_int *error), (p, name, error))
CREATES(cl_mem, clCreateBuffer, (cl_context c, cl_bitfield f, size_t n, void *p, cl_int *error), (c, f, n, p, error))
RETAINS(clRetainContext, cl_context)
RETAINS(clRetainCommandQueue, cl_command_queue)
RETAINS(clRetainDevice, cl_device_id)
RELEASES(clReleaseContext, cl_context)
RELEASES(clReleaseCommandQueue, cl_command_queue)
RELEASES(clReleaseDevice, cl_device_id)
RELEASES(clReleaseProgram, cl_program)
RELEASES(clReleaseKernel, cl_kernel)
RELEASES(clReleaseMemObject, cl_mem)
DOES(clGetPlatformIDs, (cl_uint n, cl_platform_id *p, cl_uint *m), (n, p, m))
DOES(clGetPlatformInfo, (cl_platform_id p, cl_uint w, size_t n, void *v, size_t *m), (p, w, n, v, m))
DOES(clGetDeviceIDs, (cl_platform_id p, cl_bitfield t, cl_uint n, cl_device_id *d, cl_uint *m), (p, t, n, d, m))
static cl_int wrap_clGetDeviceInfo(cl_device_id d, cl_uint what, size_t n, void *value, size_t *size)
{
	const cl_bool no = CL_FALSE;
	const cl_bitfield gpu = (cl_bitfield)1 << 2;
	const cl_ulong room = 4 * 777;
	if (fails("clGetDeviceInfo"))
		return failure;
	const cl_int error = real.clGetDeviceInfo(d, what, n, value, size);
	if (discrete && error == CL_SUCCESS && value) {
		if (what == CL_DEVICE_HOST_UNIFIED_MEMORY)
			memcpy(value, &no, sizeof no);
		else if (what == CL_DEVICE_TYPE)
			memcpy(value, &gpu, sizeof gpu);
		else if (what == CL_DEVICE_MAX_MEM_ALLOC_SIZE)
			memcpy(value, &room, sizeof room);
	}
	return error;
}
DOES(clBuildProgram,
     (cl_program p, cl_uint n, const cl_device_id *d, const char *o, void (*notify)(cl_program, void *), void *u),
     (p, n, d, o, notify, u))
DOES(clSetKernelArg, (cl_kernel k, cl_uint i, size_t n, const void *v), (k, i, n, v))
DOES(clGetKernelWorkGroupInfo, (cl_kernel k, cl_device_id d, cl_uint w, size_t n, void *v, size_t *m),
     (k, d, w, n, v, m))
DOES(clEnqueueReadBuffer,
     (cl_command_queue q, cl_mem b, cl_bool w, size_t o, size_t n, void *p, cl_uint c, const cl_event *l, cl_event *e),
     (q, b, w, o, n, p, c, l, e))
DOES(clEnqueueWriteBuffer,
     (cl_command_queue q, cl_mem b, cl_bool w, size_t o, size_t n, const void *p, cl_uint c, const cl_event *l,
      cl_event *e),
     (q, b, w, o, n, p, c, l, e))
DOES(clEnqueueNDRangeKernel,
     (cl_command_queue q, cl_kernel k, cl_uint d, const size_t *o, const size_t *g, const size_t *l, cl_uint c,
      const cl_event *w, cl_event *e),
     (q, k, d, o, g, l, c, w, e))
DOES(clEnqueueUnmapMemObject, (cl_command_queue q, cl_mem b, void *p, cl_uint c, const cl_event *w, cl_event *e),
     (q, b, p, c, w, e))
DOES(clFlush, (cl_command_queue q), (q))
DOES(clGetMemObjectInfo, (cl_mem b, cl_uint w, size_t n, void *v, size_t *m), (b, w, n, v, m))
DOES(clFinish, (cl_command_queue q), (q))

/* Mapping makes no object: it is undone by unmapping. */
static void *wrap_clEnqueueMapBuffer(cl_command_queue q, cl_mem b, cl_bool w, cl_bitfield f, size_t o, size_t n,
				     cl_uint c, const cl_event *l, cl_event *e, cl_int *error)
{
	if (fails("clEnqueueMapBuffer")) {
		if (error)
			*error = failure;
		return NULL;
	}
	return real.clEnqueueMapBuffer(q, b, w, f, o, n, c, l, e, error);
}

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

static int reached_times[sizeof calls / sizeof *calls];

/* --- one life of a device: open, scene, batch ------------------------------------------------------------------------- */

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
		buffer[k] = real.clCreateBuffer(context, CL_MEM_READ_WRITE | (k < 6 ? CL_MEM_COPY_HOST_PTR : 0), N * 4,
						k < 6 ? in.array[k] : NULL, NULL);
	memset(&b, 0, sizeof b);
	b.count = N;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = buffer[k];
		b.wi[k] = buffer[3 + k];
	}
	b.pdf = buffer[6];
	status = lobe_scene_eval_cl(scene, &b);
	for (int k = 0; k < 7; k++)
		real.clReleaseMemObject(buffer[k]);
	return status;
}

/* name: the device to live on. */
static lobe_status live_on(const char *name)
{
	lobe_device *device;
	lobe_scene *scene;
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = N;
	b.material = material;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = in.array[k];
		b.wi[k] = in.array[3 + k];
		b.u[k] = in.array[6 + k];
		b.f[k] = out[k];
		b.sample_wi[k] = out[4 + k];
		b.weight[k] = out[7 + k];
	}
	b.pdf = out[3];
	b.sample_pdf = out[10];
	b.event = (uint32_t *)(void *)out[11];
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

void setUp(void) {}
void tearDown(void) {}

static void install(void)
{
	size_t count = 0;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_count("opencl", &count));
	if (count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	table = (lobe_cl_functions *)(uintptr_t)lobe_cl_load();
	real = *table;
#define WRAP(name) table->name = wrap_##name
	WRAP(clCreateContext);
	WRAP(clCreateCommandQueue);
	WRAP(clCreateProgramWithSource);
	WRAP(clCreateKernel);
	WRAP(clCreateBuffer);
	WRAP(clRetainContext);
	WRAP(clRetainCommandQueue);
	WRAP(clRetainDevice);
	WRAP(clReleaseContext);
	WRAP(clReleaseCommandQueue);
	WRAP(clReleaseDevice);
	WRAP(clReleaseProgram);
	WRAP(clReleaseKernel);
	WRAP(clReleaseMemObject);
	WRAP(clGetPlatformIDs);
	WRAP(clGetPlatformInfo);
	WRAP(clGetDeviceIDs);
	WRAP(clGetDeviceInfo);
	WRAP(clBuildProgram);
	WRAP(clSetKernelArg);
	WRAP(clGetKernelWorkGroupInfo);
	WRAP(clEnqueueReadBuffer);
	WRAP(clEnqueueWriteBuffer);
	WRAP(clEnqueueNDRangeKernel);
	WRAP(clEnqueueUnmapMemObject);
	WRAP(clEnqueueMapBuffer);
	WRAP(clFlush);
	WRAP(clGetMemObjectInfo);
	WRAP(clFinish);
	in = inputs_alloc(N);
	inputs_random(in, 8000000);
	materials[0] = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.5f, 0.5f, 0.5f)));
	materials[1] = lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(0.2f, 0.3f, lobe_metal_eta(LOBE_METAL_IRON), lobe_metal_k(LOBE_METAL_IRON)));
	materials[2].kind = LOBE_KIND_NONE;
	for (uint32_t i = 0; i < N; i++)
		material[i] = i % 3;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_on("native:1"), lobe_error_message());
	memcpy(expected, out, sizeof expected);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof expected);
}

static void test_nothing_leaks(void) { TEST_ASSERT_EQUAL_MESSAGE(0, live, "objects created and not released"); }

static void fail_each(cl_int code, int check_memory)
{
	failure = code;
	for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
		int failed = 0, made = 0;
		failing = calls[c].name;
		/* The first few calls of this name, then later ones further apart. */
		for (long at = 0; at < 64; at += at < 6 ? 1 : at) {
			countdown = at;
			const lobe_status status = live_once();
			const int reached = countdown < 0;
			made += reached;
			reached_times[c] += reached;
			if (!reached) {
				TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, status, lobe_error_message());
				break;
			}
			failed += status != LOBE_OK;
			if (status == LOBE_OK) {
				TEST_ASSERT_TRUE_MESSAGE(calls[c].may_succeed, failing);
			} else {
				const int build = strcmp(failing, "clBuildProgram") == 0;
				const lobe_status right =
					check_memory ? LOBE_ERROR_MEMORY : (build ? LOBE_ERROR_BUILD : status);
				TEST_ASSERT_EQUAL_STRING(lobe_status_string(right), lobe_status_string(status));
				TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), failing),
							     lobe_error_message());
			}
			TEST_ASSERT_EQUAL_MESSAGE(0, live, failing);
		}
		printf("  %-28s failed %d of %d times\n", failing, failed, made);
		/* The library is as good as before. */
		failing = "";
		memset(out, 0, sizeof out);
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
		TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof expected);
		TEST_ASSERT_EQUAL(0, live);
	}
}

/* The path of a device with memory of its own: copies in and out, in rounds, one work-item for each element. */
static void test_discrete_memory(void)
{
	discrete = 1;
	memset(out, 0xee, sizeof out);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof expected);
	TEST_ASSERT_EQUAL(0, live);
	fail_each(CL_INVALID_VALUE, 0);
	discrete = 0;
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
	return real.clBuildProgram(p, n, d, options, notify, u);
}

static void test_build_log(void)
{
	table->clBuildProgram = build_nonsense;
	TEST_ASSERT_EQUAL_STRING("LOBE_ERROR_BUILD", lobe_status_string(live_once()));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), "error:"), lobe_error_message());
	table->clBuildProgram = wrap_clBuildProgram;
	TEST_ASSERT_EQUAL(0, live);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, live_once(), lobe_error_message());
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(install);
	if (table) { /* else there is no OpenCL device, as install said */
		RUN_TEST(test_nothing_leaks);
		RUN_TEST(test_each_call_fails);
		RUN_TEST(test_out_of_memory);
		RUN_TEST(test_build_log);
		RUN_TEST(test_discrete_memory);
		RUN_TEST(test_every_call_was_reached);
	}
	return UNITY_END();
}
