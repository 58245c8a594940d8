/* test_opencl_none.c - a machine without an OpenCL runtime: counted as no device, refused with a reason, and the native
 * device is as good as ever. And with a runtime: it is not loaded until asked for. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lobe/lobe.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static int loaded(const char *library)
{
	char line[4096];
	int found = 0;
	FILE *maps = fopen("/proc/self/maps", "r");
	if (!maps)
		TEST_IGNORE_MESSAGE("no /proc/self/maps");
	while (fgets(line, sizeof line, maps))
		found |= strstr(line, library) != NULL;
	fclose(maps);
	return found;
}

static void shade_on(const char *name)
{
	const lobe_bsdf white = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1)));
	const float x[1] = {0.0f}, z[1] = {1.0f};
	float pdf[1] = {0.0f};
	lobe_device *device;
	lobe_scene *scene;
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = 1;
	b.wo[0] = b.wo[1] = b.wi[0] = b.wi[1] = x;
	b.wo[2] = b.wi[2] = z;
	b.pdf = pdf;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, name));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, &white, 1));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
	TEST_ASSERT_EQUAL_FLOAT(0.31830989f, pdf[0]);
	lobe_scene_destroy(scene);
	lobe_device_close(device);
}

static void test_native_loads_no_opencl(void)
{
	shade_on("native");
	TEST_ASSERT_FALSE(loaded("libOpenCL"));
}

static void test_no_device(void)
{
	size_t count = 99;
	lobe_device *device = NULL;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_count("opencl", &count), lobe_error_message());
	TEST_ASSERT_EQUAL(0, count);
	TEST_ASSERT_EQUAL(LOBE_ERROR_DEVICE, lobe_device_open(&device, "opencl"));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), "OpenCL"), lobe_error_message());
	printf("the message: %s\n", lobe_error_message());
	TEST_ASSERT_NULL(device);
	TEST_ASSERT_EQUAL(LOBE_ERROR_DEVICE, lobe_device_open(&device, "opencl:all"));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), "OpenCL"), lobe_error_message());
	TEST_ASSERT_NULL(device);
	shade_on("native");
	shade_on("opencl,native");
	shade_on("opencl:all,native");
}

int main(void)
{
	char empty[] = "/tmp/lobe-no-opencl-XXXXXX";
	UNITY_BEGIN();
	RUN_TEST(test_native_loads_no_opencl);
	if (mkdtemp(empty)) {
		setenv("OCL_ICD_VENDORS", empty, 1);
		RUN_TEST(test_no_device);
		rmdir(empty);
	}
	return UNITY_END();
}
