/* test_fallback.c - "opencl,native": whichever OpenCL call fails, once or because the device is lost, results are there
 * and right, nothing is leaked, and it is told that the device was given up. */
#define _POSIX_C_SOURCE 200809L
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

static inputs in;
static uint32_t material[N];
static lobe_bsdf materials[3];
static float expected[INPUTS_OUTPUTS][N], out[INPUTS_OUTPUTS][N];

void setUp(void) {}
void tearDown(void) {}

/* Two rounds of both verbs; each must be right. 1 when the device was given up. */
static int live_on(const char *name)
{
	const lobe_batch b = inputs_batch(in, material, out[0]);
	lobe_device *device;
	lobe_scene *scene;
	lobe_event *e;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&device, name), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, 3), lobe_error_message());
	for (int round = 0; round < 2; round++) {
		memset(out, 0xee, sizeof out);
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample_async(scene, &b, &e), lobe_error_message());
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_event_wait(e), lobe_error_message());
		lobe_event_release(e);
		TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof out);
	}
	const int lost = lobe_device_lost(device) != NULL;
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	return lost;
}

static void prepare(void)
{
	in = inputs_alloc(N);
	inputs_random(in, 4000000);
	fixture_materials(materials, material, N);
	const lobe_batch b = inputs_batch(in, material, expected[0]);
	lobe_device *device;
	lobe_scene *scene;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native:1"));
	TEST_ASSERT_NULL(lobe_device_lost(device));
	TEST_ASSERT_NULL(lobe_device_lost(NULL));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, 3));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b));
	lobe_scene_destroy(scene);
	lobe_device_close(device);
}

static void test_names(void)
{
	static const char *const bad[] = {"native,native",  "opencl,",         "opencl,opencl", ",native",
					  "opencl,native:", "opencl,native:0", "foo,native",    "opencl,native,native",
					  "opencl:all:1",   "opencl:al,native"};
	lobe_device *d = NULL;
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		TEST_ASSERT_EQUAL_STRING_MESSAGE("LOBE_ERROR_DEVICE", lobe_status_string(lobe_device_open(&d, bad[i])),
						 bad[i]);
		TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), "lobe_device_open"), lobe_error_message());
		TEST_ASSERT_NULL(d);
	}
}

/* A device that is not there: native from the start, and it is told why. */
static void test_no_such_device(void)
{
	lobe_device *device;
	lobe_set_error_message("before");
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "opencl:99,native:2"));
	TEST_ASSERT_EQUAL_STRING("before", lobe_error_message());
	printf("%s: %s\n", lobe_device_name(device), lobe_device_lost(device));
	TEST_ASSERT_EQUAL_STRING_LEN("native, ", lobe_device_name(device), 8);
	TEST_ASSERT_NOT_NULL(strstr(lobe_device_name(device), "2 threads"));
	TEST_ASSERT_TRUE(strstr(lobe_device_lost(device), "OpenCL") || strstr(lobe_device_lost(device), "opencl:99"));
	lobe_device_close(device);
	TEST_ASSERT_EQUAL(1, live_on("opencl:99,native"));
}

static void test_all_is_well(void)
{
	NEEDS_OPENCL();
	lobe_device *device;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "opencl,native:2"));
	printf("%s\n", lobe_device_name(device));
	TEST_ASSERT_EQUAL_STRING_LEN("opencl:0, ", lobe_device_name(device), 10);
	TEST_ASSERT_NOT_NULL(strstr(lobe_device_name(device), "or else native, "));
	TEST_ASSERT_NULL(lobe_device_lost(device));
	lobe_device_close(device);
	cl_faults.counting = "clEnqueueNDRangeKernel";
	cl_faults.counted = 0;
	TEST_ASSERT_EQUAL(0, live_on("opencl,native"));
	TEST_ASSERT_GREATER_THAN_MESSAGE(0, cl_faults.counted, "the OpenCL device shades");
	TEST_ASSERT_EQUAL(0, live_on("opencl:all,native:1"));
	cl_faults.counting = "";
	TEST_ASSERT_EQUAL(0, cl_faults.live);
}

static int total;

/* Every call in turn: the first time it is made, the second, and later ones further apart. */
static void fail_each(const char *device, cl_int code, int lost)
{
	static const char *const calls[] = {
#define LOBE_CL_FUNCTION(result, name, arguments) #name,
		LOBE_CL_FUNCTIONS(LOBE_CL_FUNCTION)
#undef LOBE_CL_FUNCTION
	};
	int given_up = 0, reached = 0;
	cl_faults.failure = code;
	cl_faults.lost = lost;
	for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
		for (long at = 0; at < 64; at += at ? at : 1) {
			cl_faults.failing = calls[c];
			cl_faults.countdown = at;
			const int gone = live_on(device);
			const int made = cl_faults.countdown < 0;
			given_up += gone;
			reached += made;
			TEST_ASSERT_EQUAL_MESSAGE(0, cl_faults.live, calls[c]);
			/* Given up is what failed, and a lost device is always given up when it was asked again. */
			TEST_ASSERT_TRUE_MESSAGE(made || !gone, calls[c]);
			TEST_ASSERT_TRUE_MESSAGE(gone || !made || !lost || strncmp(calls[c], "clEnqueue", 9), calls[c]);
			if (!made)
				break;
		}
	}
	cl_faults.failing = "";
	cl_faults.lost = 0;
	printf("  %-16s %s (%d), %s: %d failures, given up %d times\n", device, lost ? "lost" : "once", (int)code,
	       cl_faults.discrete ? "separate memory" : "shared memory", reached, given_up);
	TEST_ASSERT_EQUAL_MESSAGE(0, live_on(device), "the library is as good as before");
	total += reached;
}

static void test_each_call(void)
{
	NEEDS_OPENCL();
	for (int discrete = 0; discrete < 2; discrete++) {
		cl_faults.discrete = discrete;
		cl_faults.room = discrete ? 4 * 777 : 0;
		fail_each("opencl,native:2", CL_INVALID_COMMAND_QUEUE, 0);
		fail_each("opencl,native:2", CL_INVALID_COMMAND_QUEUE, 1);
	}
	cl_faults.discrete = 0;
	cl_faults.room = 0;
	TEST_ASSERT_GREATER_THAN(150, total);
}

static void test_each_call_of_all(void)
{
	NEEDS_OPENCL();
	fail_each("opencl:all,native", CL_INVALID_COMMAND_QUEUE, 1);
}

/* Out of memory is no reason to give a device up. */
static void test_out_of_memory(void)
{
	NEEDS_OPENCL();
	const lobe_batch b = inputs_batch(in, material, out[0]);
	lobe_device *device;
	lobe_scene *scene;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "opencl,native"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, 3));
	cl_faults.failing = "clEnqueueNDRangeKernel";
	cl_faults.failure = CL_MEM_OBJECT_ALLOCATION_FAILURE;
	cl_faults.countdown = 0;
	for (int round = 0; round < 2; round++) {
		cl_faults.counting = cl_faults.failing;
		cl_faults.counted = 0;
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
		TEST_ASSERT_NULL(lobe_device_lost(device));
		/* One launch each: that which fails, and after it that which does not. */
		TEST_ASSERT_EQUAL_MESSAGE(1, cl_faults.counted, "asked again after the failure, and only then");
	}
	cl_faults.failing = cl_faults.counting = "";
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	TEST_ASSERT_EQUAL(0, cl_faults.live);
}

int main(void)
{
	setenv("POCL_DEVICES", "pthread basic", 1);
	setenv("LOBE_CACHE_DIR", "", 1);
	UNITY_BEGIN();
	RUN_TEST(prepare);
	RUN_TEST(test_names);
	RUN_TEST(test_no_such_device);
	RUN_TEST(test_all_is_well);
	RUN_TEST(test_each_call);
	RUN_TEST(test_each_call_of_all);
	RUN_TEST(test_out_of_memory);
	inputs_free(in);
	return UNITY_END();
}
