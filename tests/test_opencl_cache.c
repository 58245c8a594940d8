/* test_opencl_cache.c - programs kept between runs: a second start builds nothing from source and gives the same bits,
 * and whatever is wrong with a file or its folder, the program is built from source as if it were not there.
 *
 * PoCL is given an empty cache of its own, so that what is found is what lobe kept. */
#define _XOPEN_SOURCE 700
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cache_folder.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "opencl_api.h"
#include "unity.h"

enum { N = 1003 };

static lobe_cl_functions real, *table;
static int sources, binaries, refused;   /* programs made from each, and built; binaries that a build refused */
static int refuse_binary, refuse_create; /* pretend that the driver does */
static cl_program from_binary;
static const char *other_driver; /* pretend that the driver has this version */
static inputs in;
static float out[4][N], expected[4][N];
static char home[PATH];

static cl_program count_binary(cl_context c, cl_uint n, const cl_device_id *d, const size_t *l, const unsigned char **b,
			       cl_int *s, cl_int *e)
{
	if (refuse_create) {
		*e = CL_INVALID_BINARY;
		refused++;
		return NULL;
	}
	from_binary = real.clCreateProgramWithBinary(c, n, d, l, b, s, e);
	return from_binary;
}

static cl_int count_build(cl_program p, cl_uint n, const cl_device_id *d, const char *o,
			  void (*notify)(cl_program, void *), void *u)
{
	const int binary = p == from_binary;
	from_binary = NULL;
	if (binary && refuse_binary) {
		refused++;
		return CL_INVALID_BINARY;
	}
	*(binary ? &binaries : &sources) += 1;
	return real.clBuildProgram(p, n, d, o, notify, u);
}

static cl_int pretend_driver(cl_device_id d, cl_uint what, size_t n, void *value, size_t *size)
{
	if (what == CL_DRIVER_VERSION && other_driver && n > strlen(other_driver)) {
		memcpy(value, other_driver, strlen(other_driver) + 1);
		return CL_SUCCESS;
	}
	return real.clGetDeviceInfo(d, what, n, value, size);
}

/* Evaluates on a device opened anew; the counts are those of this call. */
static lobe_status shade_on(const char *name, float alpha)
{
	const lobe_bsdf iron = lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(alpha, 0.3f, lobe_metal_eta(LOBE_METAL_IRON), lobe_metal_k(LOBE_METAL_IRON)));
	lobe_device *device;
	lobe_scene *scene;
	lobe_batch b;
	lobe_status status;
	memset(&b, 0, sizeof b);
	b.count = N;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = in.array[k];
		b.wi[k] = in.array[3 + k];
		b.f[k] = out[k];
	}
	b.pdf = out[3];
	memset(out, 0xee, sizeof out);
	sources = binaries = refused = 0;
	if (lobe_device_open(&device, name) != LOBE_OK)
		return LOBE_ERROR_DEVICE;
	status = lobe_scene_create(&scene, device, &iron, 1);
	if (status == LOBE_OK) {
		status = lobe_scene_eval(scene, &b);
		lobe_scene_destroy(scene);
	}
	lobe_device_close(device);
	return status;
}

static void shade(void)
{
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, shade_on("opencl", 0.2f), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(expected, out, sizeof out);
}

static void assert_cold(void)
{
	shade();
	TEST_ASSERT_EQUAL_MESSAGE(1, sources, "built from source");
	TEST_ASSERT_EQUAL_MESSAGE(0, binaries, "built from the cache");
}

static void assert_warm(void)
{
	shade();
	TEST_ASSERT_EQUAL_MESSAGE(0, sources, "built from source");
	TEST_ASSERT_EQUAL_MESSAGE(1, binaries, "built from the cache");
}

void setUp(void)
{
	refuse_binary = refuse_create = 0;
	other_driver = NULL;
	setenv("LOBE_CACHE_DIR", folder, 1);
}
void tearDown(void) {}

/* --- programs ----------------------------------------------------------------------------------------------------- */

static void needs_opencl(void)
{
	if (!table)
		TEST_IGNORE_MESSAGE("no OpenCL device");
}

static void test_second_start(void)
{
	needs_opencl();
	struct stat s;
	char path[PATH];
	empty_folder();
	assert_cold();
	TEST_ASSERT_EQUAL(1, files(path));
	TEST_ASSERT_EQUAL(0, stat(path, &s));
	TEST_ASSERT_EQUAL_HEX(0600, s.st_mode & 0777);
	TEST_ASSERT_EQUAL(0, stat(folder, &s));
	TEST_ASSERT_EQUAL_HEX(0700, s.st_mode & 0777);
	assert_warm();
	assert_warm();
	TEST_ASSERT_EQUAL(1, files(NULL));
}

/* What the program depends on: another driver does not get this one's. */
static void test_key(void)
{
	needs_opencl();
	other_driver = "another version";
	assert_cold();
	assert_warm();
	TEST_ASSERT_EQUAL(2, files(NULL));
	other_driver = NULL;
	assert_warm();
	/* Materials are no part of it. */
	TEST_ASSERT_EQUAL(LOBE_OK, shade_on("opencl", 0.9f));
	TEST_ASSERT_EQUAL(0, sources);
}

static void test_refused_by_the_driver(void)
{
	needs_opencl();
	refuse_binary = 1;
	assert_cold();
	TEST_ASSERT_EQUAL(1, refused);
	refuse_binary = 0;
	refuse_create = 1;
	assert_cold();
	TEST_ASSERT_EQUAL(1, refused);
	refuse_create = 0;
	assert_warm(); /* the file was written anew */
}

/* The checks of a file are the cache's own, tried on all its parts below; here, that a damaged program is rebuilt. */
static void test_damaged_program(void)
{
	needs_opencl();
	char path[PATH];
	empty_folder();
	assert_cold();
	TEST_ASSERT_EQUAL(1, files(path));
	read_file(path);
	content[content_size - 1000] ^= 4;
	write_file(path, content, content_size);
	assert_cold();
	assert_warm();
	write_file(path, content, content_size / 2);
	assert_cold();
	assert_warm();
}

/* Two processes that start together, cold; then two that start warm. */
static void test_two_processes(void)
{
	needs_opencl();
	empty_folder();
	for (int round = 0; round < 2; round++) {
		pid_t child[2];
		for (int i = 0; i < 2; i++) {
			char *const arguments[] = {"test_opencl_cache", "--child", round ? "warm" : "cold", NULL};
			child[i] = fork();
			if (child[i] == 0) {
				execv("/proc/self/exe", arguments);
				_exit(127);
			}
		}
		for (int i = 0; i < 2; i++) {
			int status = -1;
			TEST_ASSERT_EQUAL(child[i], waitpid(child[i], &status, 0));
			TEST_ASSERT_EQUAL_MESSAGE(0, status, "the child's Unity output tells more");
		}
		TEST_ASSERT_EQUAL(1, files(NULL));
	}
	assert_warm();
}

static void test_no_folder(void)
{
	needs_opencl();
	empty_folder();
	setenv("LOBE_CACHE_DIR", "", 1);
	assert_cold();
	assert_cold();
	setenv("LOBE_CACHE_DIR", "/proc/no such folder", 1);
	assert_cold();
	assert_cold();
	setenv("LOBE_CACHE_DIR", "/dev/null", 1);
	assert_cold();
	TEST_ASSERT_EQUAL(0, files(NULL));
}

/* PoCL keeps programs itself: without LOBE_CACHE_DIR nothing is asked of it. Other drivers' go to the home folder. */
static void test_default_folder(void)
{
	needs_opencl();
	char path[2 * PATH];
	unsetenv("LOBE_CACHE_DIR");
	assert_cold();
	snprintf(path, sizeof path, "%s/lobe", home);
	cl_platform_id platform;
	char name[256] = "";
	real.clGetPlatformIDs(1, &platform, NULL);
	real.clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name, name, NULL);
	TEST_ASSERT_EQUAL(strcmp(name, "Portable Computing Language") ? 0 : -1, access(path, F_OK));
}

static void install(void)
{
	size_t count = 0;
	in = inputs_alloc(N);
	inputs_random(in, 8000000);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, shade_on("native:1", 0.2f), lobe_error_message());
	memcpy(expected, out, sizeof out);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_count("opencl", &count));
	if (count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	table = (lobe_cl_functions *)(uintptr_t)lobe_cl_load();
	real = *table;
	table->clCreateProgramWithBinary = count_binary;
	table->clBuildProgram = count_build;
	table->clGetDeviceInfo = pretend_driver;
}

int main(int argc, char **argv)
{
	char pocl[] = "/tmp/lobe-pocl-XXXXXX", ours[] = "/tmp/lobe-cache-XXXXXX";
	/* Each process has an empty cache of PoCL's own. */
	if (!mkdtemp(pocl) || !mkdtemp(ours))
		return 1;
	setenv("POCL_CACHE_DIR", pocl, 1);
	setenv("XDG_CACHE_HOME", ours, 1);
	UNITY_BEGIN();
	if (argc > 2 && strcmp(argv[1], "--child") == 0) {
		snprintf(folder, sizeof folder, "%s", getenv("LOBE_CACHE_DIR"));
		RUN_TEST(install);
		if (strcmp(argv[2], "warm") == 0)
			RUN_TEST(assert_warm);
		else
			RUN_TEST(shade);
	} else {
		snprintf(home, sizeof home, "%s", ours);
		snprintf(folder, sizeof folder, "%s/folder", ours);
		setenv("LOBE_CACHE_DIR", folder, 1);
		RUN_TEST(install);
		RUN_TEST(test_second_start);
		RUN_TEST(test_key);
		RUN_TEST(test_refused_by_the_driver);
		RUN_TEST(test_damaged_program);
		RUN_TEST(test_two_processes);
		RUN_TEST(test_no_folder);
		RUN_TEST(test_default_folder);
	}
	inputs_free(in);
	free(content);
	remove_all(pocl);
	remove_all(ours);
	return UNITY_END();
}
