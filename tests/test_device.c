/* test_device.c - native devices: their names, what is refused and how they say so, and what they answer to OpenCL's
 * calls. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>

#include "batch_fixture.h"
#include "lobe/lobe.h"
#include "unity.h"

void setUp(void) { fixture_open(); }
void tearDown(void) { fixture_close(); }

static void test_device_names(void)
{
	lobe_device *d;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "native:3"));
	TEST_ASSERT_NOT_NULL(strstr(lobe_device_name(d), "3 threads"));
	lobe_device_close(d);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "native"));
	TEST_ASSERT_EQUAL_STRING_LEN("native, ", lobe_device_name(d), 8);
	lobe_device_close(d);
	lobe_device_close(NULL);
	TEST_ASSERT_EQUAL_STRING("", lobe_device_name(NULL));
}

static void test_device_refusals(void)
{
	static const char *const bad[] = {
		"",        "gpu",       "native:", "native:0",  "native:1025", "native:x",
		"native2", "native:-1", "opencl:", "opencl:1x", "openclx",     "native:99999999999999999999"};
	lobe_device *d = fixture.device;
	size_t count = 77;
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		assert_refused(LOBE_ERROR_DEVICE, lobe_device_open(&d, bad[i]), "lobe_device_open");
		TEST_ASSERT_EQUAL_PTR(fixture.device, d);
	}
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open(NULL, "native"), "out");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open(&d, NULL), "name");
	assert_refused(LOBE_ERROR_DEVICE, lobe_device_count("cuda", &count), "cuda");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_count(NULL, &count), "backend");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_count("native", NULL), "count");
	TEST_ASSERT_EQUAL(77, count);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_count("native", &count));
	TEST_ASSERT_EQUAL(1, count);
}

static void test_isa_by_name(void)
{
	lobe_device *d;
	setenv("LOBE_ISA", "baseline", 1);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "native:1"));
	TEST_ASSERT_EQUAL_STRING("native, baseline, 1 thread", lobe_device_name(d));
	lobe_device_close(d);
	setenv("LOBE_ISA", "vax", 1);
	assert_refused(LOBE_ERROR_DEVICE, lobe_device_open(&d, "native:1"), "vax");
	unsetenv("LOBE_ISA");
}

static void test_status_strings(void)
{
	for (int s = LOBE_OK; s <= LOBE_ERROR_OPENCL; s++)
		TEST_ASSERT_EQUAL_STRING_LEN("LOBE_", lobe_status_string((lobe_status)s), 5);
	TEST_ASSERT_NOT_NULL(lobe_status_string((lobe_status)99));
}

static void test_native_takes_no_buffers(void)
{
	lobe_cl_batch b;
	memset(&b, 0, sizeof b);
	b.count = 1;
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(fixture.scene, &b), "cl_mem");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_sample_cl(fixture.scene, &b), "cl_mem");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_cl(fixture.device, NULL, NULL, NULL), "lobe_device_cl");
}

static void test_source_and_options(void)
{
	TEST_ASSERT_NOT_NULL(strstr(lobe_opencl_source(), "lobe_ggx_conductor_eval"));
	TEST_ASSERT_NOT_NULL(strstr(lobe_opencl_options(NULL), "-cl-fp32-correctly-rounded-divide-sqrt"));
	TEST_ASSERT_NOT_NULL(strstr(lobe_opencl_options(fixture.scene), "-DLOBE_HAS_GGX_DIELECTRIC=1"));
	TEST_ASSERT_NOT_NULL(strstr(lobe_opencl_options(fixture.scene), "-DLOBE_HAS_DEFAULT=0"));
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_device_names);
	RUN_TEST(test_device_refusals);
	RUN_TEST(test_isa_by_name);
	RUN_TEST(test_status_strings);
	RUN_TEST(test_native_takes_no_buffers);
	RUN_TEST(test_source_and_options);
	return UNITY_END();
}
