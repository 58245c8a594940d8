/* test_opencl_cache_files.c - the files of the cache of programs: a file that is damaged, another's or strange is as if
 * it were not there; how many are kept, and where. No device is needed. */
#define _XOPEN_SOURCE 700
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cache_folder.h"
#include "opencl_cache.h"
#include "unity.h"

static char home[PATH];

void setUp(void) { setenv("LOBE_CACHE_DIR", folder, 1); }
void tearDown(void) {}

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
	static const char hash[] = "0123456789abcdef0123456789abcdef";
	/* Somebody else's: a download, and files of stranger names. */
	static const char *const foreign[] = {"holiday.mp4.part", "walls.lobe", "x.lobe.1.part"};
	char name[2] = "0", left[PATH + 96], stranger[PATH + 64];
	size_t size;
	TEST_ASSERT_NOT_NULL(big);
	empty_folder();
	/* What a writer left that was killed yesterday, and one that writes now. */
	for (int i = 0; i < 2; i++) {
		const struct timespec old[2] = {{time(NULL) - (i ? 0 : 86400), 0}, {time(NULL) - (i ? 0 : 86400), 0}};
		snprintf(left, sizeof left, "%s/%s.lobe.%d.0.part", folder, hash, i);
		write_file(left, "x", 1);
		TEST_ASSERT_EQUAL(0, utimensat(AT_FDCWD, left, old, 0));
	}
	for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
		const struct timespec old[2] = {{time(NULL) - 86400, 0}, {time(NULL) - 86400, 0}};
		snprintf(stranger, sizeof stranger, "%s/%s", folder, foreign[i]);
		write_file(stranger, "x", 1);
		TEST_ASSERT_EQUAL(0, utimensat(AT_FDCWD, stranger, old, 0));
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
	for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
		snprintf(stranger, sizeof stranger, "%s/%s", folder, foreign[i]);
		TEST_ASSERT_EQUAL_MESSAGE(0, remove(stranger), foreign[i]);
	}
	TEST_ASSERT_EQUAL(6 + 1, files(NULL));
	TEST_ASSERT_EQUAL(0, access(left, F_OK));
	TEST_ASSERT_EQUAL(0, remove(left));
	empty_folder();
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

/* A process that may not write files of that size is sent no signal for trying. */
static void test_size_limit(void)
{
	struct rlimit before, small;
	char path[PATH];
	empty_folder();
	TEST_ASSERT_EQUAL(0, getrlimit(RLIMIT_FSIZE, &before));
	small = before;
	small.rlim_cur = sizeof data;
	TEST_ASSERT_EQUAL(0, setrlimit(RLIMIT_FSIZE, &small));
	lobe_cl_cache_put(key, strlen(key), data, sizeof data);
	TEST_ASSERT_EQUAL(0, setrlimit(RLIMIT_FSIZE, &before));
	TEST_ASSERT_EQUAL(0, files(path));
	put_one(path);
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

int main(void)
{
	char ours[] = "/tmp/lobe-cache-XXXXXX";
	if (!mkdtemp(ours))
		return 1;
	setenv("XDG_CACHE_HOME", ours, 1);
	snprintf(home, sizeof home, "%s", ours);
	snprintf(folder, sizeof folder, "%s/folder", ours);
	mkdir(folder, 0700);
	UNITY_BEGIN();
	RUN_TEST(test_every_damage);
	RUN_TEST(test_foreign_key);
	RUN_TEST(test_strange_files);
	RUN_TEST(test_bound);
	RUN_TEST(test_read_only_folder);
	RUN_TEST(test_size_limit);
	RUN_TEST(test_where);
	free(content);
	remove_all(ours);
	return UNITY_END();
}
