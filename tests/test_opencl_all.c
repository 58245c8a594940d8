/* test_opencl_all.c - "opencl:all": how a batch is cut by what was measured, the same bits wherever it is cut, and one
 * device that fails. PoCL is asked for two devices; any others that are here are used too. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cases.h"
#include "cl_faults.h"
#include "inputs.h"
#include "internal.h"
#include "lobe/lobe.h"
#include "opencl_split.h"
#include "support.h"
#include "unity.h"

enum { MATERIALS = 16 };

static lobe_bsdf materials[MATERIALS];
static size_t material_count;

void setUp(void) {}
void tearDown(void) {}

/* --- where a batch is cut ---------------------------------------------------------------------------------------------- */

enum { DEVICES_MAX = 5 };

/* Whole, in order, no device without a part. */
static void assert_whole(const lobe_cl_measure *m, size_t count, size_t n)
{
	size_t to[DEVICES_MAX + 1];
	lobe_cl_split(m, count, n, to);
	TEST_ASSERT_EQUAL(0, to[0]);
	TEST_ASSERT_EQUAL(n, to[count]);
	for (size_t i = 0; i < count; i++) {
		TEST_ASSERT_LESS_OR_EQUAL(to[i + 1], to[i]);
		if (n < count * LOBE_CL_SPLIT_PART)
			continue;
		TEST_ASSERT_GREATER_OR_EQUAL(LOBE_CL_SPLIT_PART, to[i + 1] - to[i]);
		TEST_ASSERT_EQUAL(0, to[i] % LOBE_CL_SPLIT_PART);
	}
}

static void test_split_is_whole(void)
{
	for (uint32_t i = 0; i < 200000; i++) {
		lobe_cl_measure m[DEVICES_MAX];
		const size_t count = 1 + test_bits(1, i) % DEVICES_MAX;
		const size_t n = 1 + (test_bits(2, i) >> (test_bits(3, i) % 32));
		for (size_t k = 0; k < count; k++) {
			const uint32_t x = test_bits((uint32_t)(4 + k), i);
			m[k].speed = x % 5 == 0 ? 0.0 : (double)(1u << (x >> 28 << 1)) * (double)(x % 1000 + 1);
			m[k].first = (int)(x & 1);
		}
		assert_whole(m, count, n);
	}
	const lobe_cl_measure extreme[3] = {{1e300, 0}, {1e-300, 0}, {1e300, 0}};
	assert_whole(extreme, 3, 3 * LOBE_CL_SPLIT_PART);
	assert_whole(extreme, 3, 1000003);
}

static void test_split_in_proportion(void)
{
	lobe_cl_measure m[2] = {{0.0, 0}, {0.0, 0}};
	size_t to[3];
	lobe_cl_split(m, 2, 1 << 20, to);
	TEST_ASSERT_EQUAL_MESSAGE(1 << 19, to[1], "nothing known: equal parts");
	m[0].speed = 3e6;
	lobe_cl_split(m, 2, 1 << 20, to);
	TEST_ASSERT_EQUAL_MESSAGE(1 << 19, to[1], "one not known: equal parts");
	m[1].speed = 1e6;
	lobe_cl_split(m, 2, 1 << 20, to);
	TEST_ASSERT_EQUAL_MESSAGE(3 << 18, to[1], "three to one");
	lobe_cl_split(m, 2, 2 * LOBE_CL_SPLIT_PART - 1, to);
	TEST_ASSERT_EQUAL_MESSAGE(2 * LOBE_CL_SPLIT_PART - 1, to[1], "few elements: all to the fastest");
	m[1].speed = 4e6;
	lobe_cl_split(m, 2, 2 * LOBE_CL_SPLIT_PART - 1, to);
	TEST_ASSERT_EQUAL_MESSAGE(0, to[1], "few elements: all to the fastest");
}

/* A device of speed v that takes 100 us for each batch, and at first half a second to build. */
static double simulated(double v, size_t n, int batch) { return 1e-4 + (batch ? 0.0 : 0.5 / v * 1e8) + (double)n / v; }

/* However the first batch misled, both devices end together. */
static void test_split_learns(void)
{
	static const double speed[][2] = {{1e8, 1e8}, {1e8, 1e10}, {3e9, 1e8}, {1e7, 2e7}};
	const size_t n = 4000000;
	for (size_t s = 0; s < sizeof speed / sizeof *speed; s++) {
		lobe_cl_measure m[2] = {{0.0, 0}, {0.0, 0}};
		size_t to[3];
		double a = 0.0, b = 0.0;
		for (int batch = 0; batch < 16; batch++) {
			lobe_cl_split(m, 2, n, to);
			a = simulated(speed[s][0], to[1], batch);
			b = simulated(speed[s][1], to[2] - to[1], batch);
			lobe_cl_measure_add(&m[0], to[1], a);
			lobe_cl_measure_add(&m[1], to[2] - to[1], b);
		}
		printf("  %8.3g and %8.3g elements/s: %7zu and %7zu of 4M, %.3f and %.3f ms\n", speed[s][0], speed[s][1],
		       to[1], to[2] - to[1], 1e3 * a, 1e3 * b);
		TEST_ASSERT_TRUE(a < 1.2 * b && b < 1.2 * a);
	}
}

/* --- devices --------------------------------------------------------------------------------------------------------- */

typedef struct {
	inputs in;
	uint32_t *material;
	float *expected, *out;
	size_t size; /* of those, in bytes */
} shaded;

/* A batch of n elements of all materials, and what the native device makes of it. */
static shaded prepare(size_t n)
{
	shaded s;
	lobe_device *device;
	lobe_scene *scene;
	s.in = inputs_alloc(n);
	s.size = INPUTS_OUTPUTS * n * sizeof(float);
	s.material = malloc(n * sizeof *s.material);
	s.expected = malloc(s.size);
	s.out = malloc(s.size);
	TEST_ASSERT_TRUE(s.material && s.expected && s.out);
	inputs_random(s.in, 5000000);
	for (size_t i = 0; i < n; i++)
		s.material[i] = test_bits(90, i) % (uint32_t)material_count;
	const lobe_batch b = inputs_batch(s.in, s.material, s.expected);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b));
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	return s;
}

static void free_shaded(shaded s)
{
	inputs_free(s.in);
	free(s.material);
	free(s.expected);
	free(s.out);
}

static void assert_right(lobe_scene *scene, shaded s)
{
	const lobe_batch b = inputs_batch(s.in, s.material, s.out);
	memset(s.out, 0xee, s.size);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(s.expected, s.out, s.size);
}

/* Every length around the places of cuts, again and again, so that the cuts move. */
static void test_same_bits(void)
{
	NEEDS_OPENCL();
	static const size_t length[] = {1, 100, 1024, 2047, 2048, 2049, 4096, 5003, 100003};
	lobe_device *device;
	lobe_scene *scene;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&device, "opencl:all"), lobe_error_message());
	printf("%s\n", lobe_device_name(device));
	TEST_ASSERT_EQUAL_STRING_LEN("opencl:all, ", lobe_device_name(device), 12);
	TEST_ASSERT_NULL_MESSAGE(strstr(lobe_device_name(device), " 1 device"), "PoCL did not heed POCL_DEVICES");
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count));
	for (size_t i = 0; i < sizeof length / sizeof *length; i++) {
		const shaded s = prepare(length[i]);
		for (int again = 0; again < 5; again++)
			assert_right(scene, s);
		free_shaded(s);
	}
	/* Behind the caller, and refused: buffers of one device. */
	const shaded s = prepare(5003);
	const lobe_batch b = inputs_batch(s.in, s.material, s.out);
	lobe_event *e[2];
	memset(s.out, 0xee, s.size);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval_async(scene, &b, &e[0]));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample_async(scene, &b, &e[1]));
	for (int k = 0; k < 2; k++) {
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[k]));
		lobe_event_release(e[k]);
	}
	TEST_ASSERT_EQUAL_MEMORY(s.expected, s.out, s.size);
	free_shaded(s);
	lobe_cl_batch buffers;
	memset(&buffers, 0, sizeof buffers);
	buffers.count = 1;
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &buffers));
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_device_cl(device, NULL, NULL, NULL));
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	TEST_ASSERT_EQUAL(0, cl_faults.live);
}

/* One device takes 30 ms longer for everything: it gets less, and the bits stay. */
static cl_command_queue slow;
static cl_int (*finish_behind)(cl_command_queue);

static cl_int finish_slowly(cl_command_queue q)
{
	const struct timespec moment = {0, 30000000};
	if (!slow)
		slow = q;
	if (q == slow)
		nanosleep(&moment, NULL);
	return finish_behind(q);
}

static void test_slow_device(void)
{
	NEEDS_OPENCL();
	lobe_device *device;
	lobe_scene *scene;
	const shaded s = prepare(50000);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "opencl:all"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count));
	finish_behind = cl_faults.table->clFinish;
	cl_faults.table->clFinish = finish_slowly;
	for (int again = 0; again < 6; again++)
		assert_right(scene, s);
	cl_faults.table->clFinish = finish_behind;
	for (int again = 0; again < 6; again++)
		assert_right(scene, s);
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	free_shaded(s);
}

/* A call fails on one of the devices: the batch does, and the message names the call. Then all is well again. A device
 * that cannot be opened is left out. */
static void test_one_fails(void)
{
	NEEDS_OPENCL();
	static const char *const calls[] = {"clCreateContext",        "clCreateCommandQueue",    "clGetDeviceInfo",
					    "clRetainDevice",         "clGetDeviceIDs",          "clCreateProgramWithSource",
					    "clBuildProgram",         "clCreateKernel",          "clCreateBuffer",
					    "clEnqueueNDRangeKernel", "clEnqueueMapBuffer",      "clEnqueueUnmapMemObject",
					    "clSetKernelArg",         "clGetKernelWorkGroupInfo", "clFinish"};
	const shaded s = prepare(5003);
	const lobe_batch b = inputs_batch(s.in, s.material, s.out);
	cl_faults.failure = CL_INVALID_COMMAND_QUEUE;
	for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
		int failed = 0;
		for (int at = 0; at < 12; at += at < 3 ? 1 : 4) {
			lobe_device *device;
			lobe_scene *scene;
			cl_faults.failing = calls[c];
			cl_faults.countdown = at;
			lobe_status status = lobe_device_open(&device, "opencl:all");
			if (status == LOBE_OK) {
				status = lobe_scene_create(&scene, device, materials, material_count);
				if (status == LOBE_OK) {
					status = lobe_scene_eval(scene, &b);
					if (status == LOBE_OK)
						status = lobe_scene_sample(scene, &b);
					cl_faults.failing = "";
					assert_right(scene, s); /* which leaves the message as it is */
					lobe_scene_destroy(scene);
				}
				lobe_device_close(device);
			}
			if (status != LOBE_OK) {
				failed++;
				TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), calls[c]), lobe_error_message());
			}
			TEST_ASSERT_EQUAL_MESSAGE(0, cl_faults.live, calls[c]);
		}
		printf("  %-28s failed %d batches or scenes\n", calls[c], failed);
	}
	cl_faults.failing = "";
	free_shaded(s);
}

static void test_failure_is_named(void)
{
	NEEDS_OPENCL();
	lobe_device *device;
	lobe_scene *scene;
	const shaded s = prepare(5003);
	const lobe_batch b = inputs_batch(s.in, s.material, s.out);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "opencl:all"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count));
	cl_faults.failing = "clEnqueueMapBuffer";
	cl_faults.countdown = 0;
	TEST_ASSERT_EQUAL_STRING("LOBE_ERROR_OPENCL", lobe_status_string(lobe_scene_eval(scene, &b)));
	cl_faults.failing = "";
	printf("the message: %s\n", lobe_error_message());
	TEST_ASSERT_EQUAL_STRING_LEN("opencl:", lobe_error_message(), 7);
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "clEnqueueMapBuffer failed"));
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	free_shaded(s);
}

int main(void)
{
	setenv("POCL_DEVICES", "pthread basic", 1);
	setenv("LOBE_CACHE_DIR", "", 1);
	for (size_t i = 0; i < case_count() && material_count < MATERIALS; i++)
		materials[material_count++] = case_at(i)->bsdf;
	memset(&materials[material_count - 1], 0, sizeof *materials); /* and one without a lobe */
	UNITY_BEGIN();
	RUN_TEST(test_split_is_whole);
	RUN_TEST(test_split_in_proportion);
	RUN_TEST(test_split_learns);
	RUN_TEST(test_same_bits);
	RUN_TEST(test_slow_device);
	RUN_TEST(test_one_fails);
	RUN_TEST(test_failure_is_named);
	return UNITY_END();
}
