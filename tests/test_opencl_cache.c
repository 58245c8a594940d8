/* test_opencl_cache.c - programs kept between runs: a second start builds nothing from source and gives the same bits,
 * and whatever is wrong with a file or its folder, the program is built from source as if it were not there.
 *
 * PoCL is given an empty cache of its own, so that what is found is what lobe kept. */
#define _XOPEN_SOURCE 700
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "opencl_cache.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "opencl_api.h"
#include "unity.h"

enum { N = 1003, PATH = 512 };

static lobe_cl_functions real, *table;
static int sources, binaries, refused;   /* programs made from each, and built; binaries that a build refused */
static int refuse_binary, refuse_create; /* pretend that the driver does */
static cl_program from_binary;
static const char *other_driver; /* pretend that the driver has this version */
static inputs in;
static float out[4][N], expected[4][N];
static char folder[PATH], home[PATH];

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
	const lobe_bsdf iron = lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(
		alpha, 0.3f, lobe_metal_eta(LOBE_METAL_IRON), lobe_metal_k(LOBE_METAL_IRON)));
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

/* --- the folder ------------------------------------------------------------------------------------------------------ */

/* Files in the folder; the path of the last in path. */
static int files(char *path)
{
	const struct dirent *e;
	int n = 0;
	DIR *const d = opendir(folder);
	while (d && (e = readdir(d)) != NULL)
		if (e->d_name[0] != '.') {
			n++;
			if (path)
				snprintf(path, PATH, "%.200s/%.200s", folder, e->d_name);
		}
	if (d)
		closedir(d);
	return n;
}

static void empty_folder(void)
{
	char path[PATH];
	while (files(path))
		TEST_ASSERT_EQUAL(0, remove(path));
}

static unsigned char *content;
static size_t content_size;

static void read_file(const char *path)
{
	struct stat s;
	FILE *const f = fopen(path, "rb");
	TEST_ASSERT_NOT_NULL(f);
	TEST_ASSERT_EQUAL(0, fstat(fileno(f), &s));
	free(content);
	content_size = (size_t)s.st_size;
	content = malloc(content_size);
	TEST_ASSERT_NOT_NULL(content);
	TEST_ASSERT_EQUAL(content_size, fread(content, 1, content_size, f));
	fclose(f);
}

static void write_file(const char *path, const void *data, size_t size)
{
	FILE *const f = fopen(path, "wb");
	TEST_ASSERT_NOT_NULL(f);
	TEST_ASSERT_EQUAL(size, fwrite(data, 1, size, f));
	fclose(f);
}

void setUp(void)
{
	refuse_binary = refuse_create = 0;
	other_driver = NULL;
	setenv("LOBE_CACHE_DIR", folder, 1);
}
void tearDown(void) {}

/* --- programs -------------------------------------------------------------------------------------------------------- */

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

/* --- files ----------------------------------------------------------------------------------------------------------- */

static const char key[] = "what it was made from", other[] = "what it was not made from";
static const char data[] = "what was made";

static int found(const char *k)
{
	size_t size = 0;
	void *const got = lobe_cl_cache_get(k, strlen(k), &size);
	const int right = got && size == sizeof data && memcmp(got, data, size) == 0;
	TEST_ASSERT_TRUE_MESSAGE(right || !got, "something that was not put there");
	free(got);
	return right;
}

static void put_one(char *path)
{
	empty_folder();
	lobe_cl_cache_put(key, strlen(key), data, sizeof data);
	TEST_ASSERT_EQUAL(1, files(path));
	TEST_ASSERT_TRUE(found(key));
}

/* Cut off after any byte, with any bit turned, or followed by one byte more, it is not there. */
static void test_every_damage(void)
{
	char path[PATH];
	put_one(path);
	read_file(path);
	for (size_t n = 0; n < content_size; n++) {
		write_file(path, content, n);
		TEST_ASSERT_FALSE(found(key));
		for (int bit = 0; bit < 8; bit++) {
			content[n] ^= (unsigned char)(1 << bit);
			write_file(path, content, content_size);
			TEST_ASSERT_FALSE(found(key));
			content[n] ^= (unsigned char)(1 << bit);
		}
	}
	unsigned char longer[1024] = {0};
	memcpy(longer, content, content_size);
	write_file(path, longer, content_size + 1);
	TEST_ASSERT_FALSE(found(key));
	write_file(path, content, content_size);
	TEST_ASSERT_TRUE(found(key));
}

/* The right name and a sound file, but of another key: what a collision of hashes would give. */
static void test_foreign_key(void)
{
	char mine[PATH], path[PATH];
	put_one(mine);
	empty_folder();
	lobe_cl_cache_put(other, strlen(other), data, sizeof data);
	TEST_ASSERT_EQUAL(1, files(path));
	TEST_ASSERT_TRUE(found(other));
	TEST_ASSERT_FALSE(found(key));
	TEST_ASSERT_EQUAL(0, rename(path, mine));
	TEST_ASSERT_FALSE(found(key));
}

/* A file that another user could have written, a link, a folder, a pipe. */
static void test_strange_files(void)
{
	char path[PATH], aside[PATH + 8];
	put_one(path);
	TEST_ASSERT_EQUAL(0, chmod(path, 0620));
	TEST_ASSERT_FALSE(found(key));
	TEST_ASSERT_EQUAL(0, chmod(path, 0600));
	if (geteuid() == 0) {
		TEST_ASSERT_EQUAL(0, chown(path, 65534, 65534));
		TEST_ASSERT_FALSE(found(key));
		TEST_ASSERT_EQUAL(0, chown(path, 0, 0));
	}
	TEST_ASSERT_TRUE(found(key));
	snprintf(aside, sizeof aside, "%s.aside", path);
	TEST_ASSERT_EQUAL(0, rename(path, aside));
	TEST_ASSERT_EQUAL(0, symlink(aside, path));
	TEST_ASSERT_FALSE(found(key));
	TEST_ASSERT_EQUAL(0, remove(path));
	TEST_ASSERT_EQUAL(0, mkfifo(path, 0600));
	TEST_ASSERT_FALSE(found(key));
	TEST_ASSERT_EQUAL(0, remove(path));
	TEST_ASSERT_EQUAL(0, mkdir(path, 0700));
	TEST_ASSERT_FALSE(found(key));
	lobe_cl_cache_put(key, strlen(key), data, sizeof data); /* cannot replace a folder */
	TEST_ASSERT_FALSE(found(key));
	TEST_ASSERT_EQUAL(0, remove(path));
	TEST_ASSERT_EQUAL(0, remove(aside));
	TEST_ASSERT_EQUAL_MESSAGE(0, files(NULL), "a temporary file is left");
}

/* Ten files of 10 MB: the bound of 64 MiB leaves the six that were used last. */
static void test_bound(void)
{
	enum { SIZE = 10000000 };
	char *const big = calloc(SIZE, 1);
	char name[2] = "0", path[PATH], left[PATH + 64];
	size_t size;
	TEST_ASSERT_NOT_NULL(big);
	empty_folder();
	/* What a writer left that was killed yesterday, and one that writes now. */
	for (int i = 0; i < 2; i++) {
		const struct timespec old[2] = {{time(NULL) - (i ? 0 : 86400), 0}, {time(NULL) - (i ? 0 : 86400), 0}};
		snprintf(left, sizeof left, "%s/%d.part", folder, i);
		write_file(left, "x", 1);
		TEST_ASSERT_EQUAL(0, utimensat(AT_FDCWD, left, old, 0));
	}
	for (int i = 0; i < 10; i++) {
		const struct timespec moment = {0, 20000000}; /* file times have the grain of the kernel's clock */
		name[0] = (char)('0' + i);
		lobe_cl_cache_put(name, 1, big, SIZE);
		nanosleep(&moment, NULL);
		free(lobe_cl_cache_get("1", 1, &size)); /* file 1 stays in use */
		nanosleep(&moment, NULL);
	}
	free(big);
	for (int i = 0; i < 10; i++) {
		name[0] = (char)('0' + i);
		void *const got = lobe_cl_cache_get(name, 1, &size);
		TEST_ASSERT_EQUAL_MESSAGE(i == 1 || i >= 5, got != NULL, name);
		free(got);
	}
	TEST_ASSERT_EQUAL(6 + 1, files(NULL));
	TEST_ASSERT_EQUAL(0, access(left, F_OK));
	TEST_ASSERT_EQUAL(0, remove(left));
	empty_folder();
	(void)path;
}

/* A folder that cannot be written can be read. As root, which may write anywhere, only the reading is tested. */
static void test_read_only_folder(void)
{
	char path[PATH];
	put_one(path);
	TEST_ASSERT_EQUAL(0, chmod(folder, 0500));
	TEST_ASSERT_TRUE(found(key));
	lobe_cl_cache_put(other, strlen(other), data, sizeof data);
	TEST_ASSERT_EQUAL(geteuid() == 0, found(other));
	TEST_ASSERT_EQUAL(0, chmod(folder, 0700));
	empty_folder();
}

/* LOBE_CACHE_DIR, else XDG_CACHE_HOME, else HOME; folders are made, for their user alone. */
static void test_where(void)
{
	static const char *const below[] = {"a/b", "c/lobe", "d/.cache/lobe"};
	char path[PATH + 64];
	struct stat s;
	for (int i = 0; i < 3; i++) {
		snprintf(path, sizeof path, "%s/%c%s", home, "acd"[i], i ? "" : "/b");
		unsetenv("LOBE_CACHE_DIR");
		setenv("XDG_CACHE_HOME", "no/absolute/path", 1);
		setenv(i == 0 ? "LOBE_CACHE_DIR" : (i == 1 ? "XDG_CACHE_HOME" : "HOME"), path, 1);
		TEST_ASSERT_EQUAL(i == 0, lobe_cl_cache_asked_for());
		TEST_ASSERT_FALSE(found(key));
		lobe_cl_cache_put(key, strlen(key), data, sizeof data);
		TEST_ASSERT_TRUE(found(key));
		snprintf(path, sizeof path, "%s/%s", home, below[i]);
		TEST_ASSERT_EQUAL_MESSAGE(0, stat(path, &s), path);
		TEST_ASSERT_EQUAL_HEX(0700, s.st_mode & 0777);
	}
	setenv("HOME", home, 1);
	setenv("XDG_CACHE_HOME", home, 1);
}

/* ---------------------------------------------------------------------------------------------------------------------- */

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

static void remove_all(const char *path)
{
	char *const arguments[] = {"rm", "-rf", (char *)(uintptr_t)path, NULL};
	const pid_t child = fork();
	if (child == 0) {
		execvp("rm", arguments);
		_exit(127);
	}
	waitpid(child, NULL, 0);
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
		mkdir(folder, 0700);
		RUN_TEST(test_every_damage);
		RUN_TEST(test_foreign_key);
		RUN_TEST(test_strange_files);
		RUN_TEST(test_bound);
		RUN_TEST(test_read_only_folder);
		RUN_TEST(test_where);
	}
	inputs_free(in);
	free(content);
	remove_all(pocl);
	remove_all(ours);
	return UNITY_END();
}
