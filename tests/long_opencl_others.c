/* long_opencl_others.c - other OpenCL implementations than the one that the tests run on: long_opencl_others.sh sets
 * each up and runs this. Every device that promises exact arithmetic gives the native device's bits. One that does not
 * is refused; with LOBE_OTHERS_EXACT it is made to claim it all the same, and must give them too. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "cl_faults.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "support.h"
#include "unity.h"

enum { MATERIALS = 256 };

static lobe_bsdf materials[MATERIALS];
static size_t material_count;
static int seen, refused;

void setUp(void) {}
void tearDown(void) {}

static void shade(lobe_device *device, inputs in, const uint32_t *material, float *out)
{
	const lobe_batch b = inputs_batch(in, material, out);
	lobe_scene *scene;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count),
				  lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	lobe_scene_destroy(scene);
}

/* Words of the results of all materials that differ. */
static size_t differences(lobe_device *device, inputs in)
{
	const size_t words = INPUTS_OUTPUTS * in.count;
	uint32_t *const material = malloc(in.count * sizeof *material);
	float *const expected = malloc(words * sizeof *expected), *const got = malloc(words * sizeof *got);
	lobe_device *native;
	size_t n = 0;
	TEST_ASSERT_TRUE(material && expected && got);
	memset(got, 0xee, words * sizeof *got);
	for (size_t i = 0; i < in.count; i++)
		material[i] = test_bits(91, i) % (uint32_t)material_count;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&native, "native"));
	shade(native, in, material, expected);
	lobe_device_close(native);
	shade(device, in, material, got);
	for (size_t i = 0; i < words; i++)
		n += test_float_bits(expected[i]) != test_float_bits(got[i]);
	free(material);
	free(expected);
	free(got);
	return n;
}

static size_t all_differences(lobe_device *device)
{
	const char *const asked = getenv("LOBE_OTHERS_COUNT"); /* of a simulator, say */
	const size_t count = asked ? (size_t)atol(asked) : 200000;
	inputs random = inputs_alloc(count), extreme = inputs_extreme();
	inputs_random(random, 3000000);
	size_t n = differences(device, random);
	if (extreme.count > count)
		extreme.count = count;
	n += differences(device, extreme);
	printf("  %zu elements, %zu words of %zu differ\n", random.count + extreme.count, n,
	       INPUTS_OUTPUTS * (random.count + extreme.count));
	inputs_free(random);
	inputs_free(extreme);
	return n;
}

static void test_same_bits(void)
{
	size_t count = 0;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_count("opencl", &count));
	for (size_t i = 0; i < count; i++) {
		char name[32];
		lobe_device *device;
		snprintf(name, sizeof name, "opencl:%zu", i);
		seen++;
		if (lobe_device_open(&device, name) != LOBE_OK) {
			printf("refused: %s\n", lobe_error_message());
			refused++;
			continue;
		}
		printf("%s\n", lobe_device_name(device));
		const size_t n = all_differences(device);
		lobe_device_close(device);
		TEST_ASSERT_EQUAL(0, n);
	}
}

/* Those that do not promise it, and keep it. */
static void test_refused_devices(void)
{
	cl_faults.claims = CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT | CL_FP_DENORM | CL_FP_ROUND_TO_NEAREST | CL_FP_INF_NAN;
	for (int i = 0; i < seen; i++) {
		char name[32];
		lobe_device *device;
		snprintf(name, sizeof name, "opencl:%d", i);
		if (lobe_device_open(&device, name) != LOBE_OK)
			continue;
		printf("%s, taken at a word that it does not give\n", lobe_device_name(device));
		const size_t n = all_differences(device);
		lobe_device_close(device);
		TEST_ASSERT_EQUAL(0, n);
	}
	cl_faults.claims = 0;
}

int main(void)
{
	setenv("LOBE_CACHE_DIR", "", 1);
	for (size_t i = 0; i < case_count() && material_count < MATERIALS; i++)
		materials[material_count++] = case_at(i)->bsdf;
	UNITY_BEGIN();
	if (cl_faults_install()) {
		RUN_TEST(test_same_bits);
		if (refused && getenv("LOBE_OTHERS_EXACT"))
			RUN_TEST(test_refused_devices);
	}
	return UNITY_END();
}
