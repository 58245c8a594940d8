/* opencl_cache.c - the cache folder. A file's name is the hash of its key; the key itself stands in the file and is
 * compared, so that a collision finds nothing rather than something wrong, and a checksum over all of it tells a file
 * that is not whole. A file is written under another name and then renamed: readers see the old one or the new one. */
#define _POSIX_C_SOURCE 200809L
#include "opencl_cache.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Bytes of all files together, and seconds after which a temporary file is one that its writer left behind. */
#ifndef LOBE_CACHE_MAX
#define LOBE_CACHE_MAX ((uint64_t)64 << 20)
#endif
#define TEMPORARY_MAX 3600

#define SUFFIX           ".lobe"
#define TEMPORARY_SUFFIX ".part"

enum { PATH_SIZE = 4096 };

typedef struct {
	uint64_t low, high;
} hash;

/* FNV-1a in two lanes, the second over the bytes with every bit turned and from another start. It tells files apart and
 * finds damage; it is no defence, which the folder's permissions are. */
static hash hash_more(hash h, const void *data, size_t size)
{
	const unsigned char *const bytes = data;
	for (size_t i = 0; i < size; i++) {
		h.low = (h.low ^ bytes[i]) * 0x100000001b3u;
		h.high = (h.high ^ (bytes[i] ^ 0xffu)) * 0x10000000233u;
	}
	return h;
}

static hash hash_of(const void *data, size_t size)
{
	const hash start = {0xcbf29ce484222325u, 0x6c62272e07bb0142u};
	return hash_more(start, data, size);
}

/* What a file begins with; then the key, then the data. In the byte order of its machine: another's sizes or checksum
 * do not fit. */
typedef struct {
	char magic[8];
	uint64_t key_size, size;
	hash check; /* of the two sizes, the key and the data */
} header;

static const char magic[8] = {'l', 'o', 'b', 'e', 'b', 'i', 'n', '1'};

static hash check_of(const header *h, const void *key, const void *data)
{
	const hash sizes = hash_of(&h->key_size, 2 * sizeof h->key_size);
	return hash_more(hash_more(sizes, key, (size_t)h->key_size), data, (size_t)h->size);
}

/* --- names -------------------------------------------------------------------------------------------------------- */

int lobe_cl_cache_asked_for(void)
{
	const char *const asked = getenv("LOBE_CACHE_DIR");
	return asked && *asked;
}

/* The folder's path; 0 when there is to be no cache. */
static int folder(char *path, size_t size)
{
	const char *const asked = getenv("LOBE_CACHE_DIR");
	const char *const xdg = getenv("XDG_CACHE_HOME"), *const home = getenv("HOME");
	int length = 0;
	if (asked)
		length = snprintf(path, size, "%s", asked);
	else if (xdg && *xdg == '/') /* as the XDG specification has it, a relative path is ignored */
		length = snprintf(path, size, "%s/lobe", xdg);
	else if (home && *home == '/')
		length = snprintf(path, size, "%s/.cache/lobe", home);
	return length > 0 && (size_t)length < size;
}

/* Opens the folder, making it and those above it when they are missing. -1: no. */
static int open_folder(int make)
{
	char path[PATH_SIZE];
	if (!folder(path, sizeof path))
		return -1;
	for (char *s = path + 1; make && *s; s++) {
		if (*s != '/')
			continue;
		*s = '\0';
		mkdir(path, 0700);
		*s = '/';
	}
	if (make)
		mkdir(path, 0700);
	return open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

enum { NAME_SIZE = 64 };

static void file_name(char *name, const char *key, size_t key_size)
{
	const hash h = hash_of(key, key_size);
	snprintf(name, NAME_SIZE, "%016llx%016llx" SUFFIX, (unsigned long long)h.high, (unsigned long long)h.low);
}

/* Where the name of a file of the cache goes on behind what file_name makes, NULL for one that is somebody else's: the
 * folder may be one that is shared. */
static const char *own_suffix(const char *name)
{
	enum { DIGITS = 32 };
	if (strspn(name, "0123456789abcdef") != DIGITS || strncmp(name + DIGITS, SUFFIX, strlen(SUFFIX)) != 0)
		return NULL;
	return name + DIGITS + strlen(SUFFIX);
}

static int ends_with(const char *name, const char *end)
{
	const size_t n = strlen(name), m = strlen(end);
	return n >= m && strcmp(name + n - m, end) == 0;
}

/* --- reading ------------------------------------------------------------------------------------------------------ */

static int read_all(int file, void *to, size_t size)
{
	unsigned char *at = to;
	while (size > 0) {
		const ssize_t got = read(file, at, size);
		if (got < 0 && errno == EINTR)
			continue;
		if (got <= 0)
			return 0;
		at += got;
		size -= (size_t)got;
	}
	return 1;
}

/* Data becomes code: no file of another user, nor one that another user could have written to. */
static int is_ours(int file, uint64_t *size)
{
	struct stat s;
	if (fstat(file, &s) != 0 || !S_ISREG(s.st_mode) || s.st_uid != geteuid() || (s.st_mode & (S_IWGRP | S_IWOTH)))
		return 0;
	*size = (uint64_t)s.st_size;
	return 1;
}

/* The data of an open file. */
static void *get_data(int file, const char *key, size_t key_size, size_t *size)
{
	uint64_t file_size;
	header h;
	if (!is_ours(file, &file_size) || !read_all(file, &h, sizeof h))
		return NULL;
	/* Each size by itself before the sum, which could wrap. */
	if (memcmp(h.magic, magic, sizeof magic) != 0 || h.key_size != key_size || h.size > file_size ||
	    sizeof h + h.key_size + h.size != file_size)
		return NULL;
	char *const found_key = malloc(key_size + 1);
	void *data = malloc((size_t)h.size + 1);
	int whole = found_key && data && read_all(file, found_key, key_size) && read_all(file, data, (size_t)h.size) &&
		    memcmp(found_key, key, key_size) == 0;
	if (whole) {
		const hash check = check_of(&h, found_key, data);
		whole = check.low == h.check.low && check.high == h.check.high;
	}
	free(found_key);
	if (!whole) {
		free(data);
		return NULL;
	}
	*size = (size_t)h.size;
	return data;
}

void *lobe_cl_cache_get(const char *key, size_t key_size, size_t *size)
{
	char name[NAME_SIZE];
	const int dir = open_folder(0);
	if (dir < 0)
		return NULL;
	file_name(name, key, key_size);
	/* O_NONBLOCK: a pipe of that name must not hold us up. */
	const int file = openat(dir, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
	void *data = NULL;
	if (file >= 0) {
		data = get_data(file, key, key_size, size);
		if (data)
			futimens(file, NULL); /* used just now */
		close(file);
	}
	close(dir);
	return data;
}

/* --- writing ------------------------------------------------------------------------------------------------------ */

static int write_all(int file, const void *from, size_t size)
{
	const unsigned char *at = from;
	while (size > 0) {
		const ssize_t put = write(file, at, size);
		if (put < 0 && errno == EINTR)
			continue;
		if (put <= 0)
			return 0;
		at += put;
		size -= (size_t)put;
	}
	return 1;
}

/* Whether the process may write files of that size: one that tries to write more is sent a signal that ends it. */
static int is_allowed(uint64_t size)
{
	struct rlimit limit;
	return getrlimit(RLIMIT_FSIZE, &limit) == 0 && (limit.rlim_cur == RLIM_INFINITY || size <= limit.rlim_cur);
}

/* A new file whose name is not taken. */
static int open_temporary(int dir, const char *name, char *temporary)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	for (unsigned long salt = (unsigned long)now.tv_nsec, end = salt + 16; salt < end; salt++) {
		snprintf(temporary, 2 * NAME_SIZE, "%s.%ld.%lx" TEMPORARY_SUFFIX, name, (long)getpid(), salt);
		const int file = openat(dir, temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
		if (file >= 0 || errno != EEXIST)
			return file;
	}
	return -1;
}

typedef struct {
	char name[NAME_SIZE];
	uint64_t size;
	struct timespec used;
} kept;

static int by_use(const void *a, const void *b)
{
	const struct timespec x = ((const kept *)a)->used, y = ((const kept *)b)->used;
	if (x.tv_sec != y.tv_sec)
		return x.tv_sec < y.tv_sec ? -1 : 1;
	return (x.tv_nsec > y.tv_nsec) - (x.tv_nsec < y.tv_nsec);
}

/* The cache's files, the caller's to free. Removes what writers left behind. */
static kept *list_files(int dir, size_t *count)
{
	kept *list = NULL;
	size_t room = 0;
	const time_t now = time(NULL);
	const int copy = dup(dir); /* closedir closes it */
	DIR *const entries = copy < 0 ? NULL : fdopendir(copy);
	const struct dirent *e;
	*count = 0;
	if (!entries) {
		if (copy >= 0)
			close(copy);
		return NULL;
	}
	rewinddir(entries);
	while ((e = readdir(entries)) != NULL) {
		struct stat s;
		const char *const suffix = own_suffix(e->d_name);
		const int temporary = suffix && *suffix == '.' && ends_with(suffix, TEMPORARY_SUFFIX);
		if (!suffix || (*suffix && !temporary) ||
		    fstatat(dir, e->d_name, &s, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(s.st_mode))
			continue;
		if (temporary) {
			if (now - s.st_mtime > TEMPORARY_MAX)
				unlinkat(dir, e->d_name, 0);
			continue;
		}
		if (*count == room) {
			kept *const longer = realloc(list, (2 * room + 16) * sizeof *list);
			if (!longer)
				break;
			list = longer;
			room = 2 * room + 16;
		}
		memcpy(list[*count].name, e->d_name, strlen(e->d_name) + 1);
		list[*count].size = (uint64_t)s.st_size;
		list[(*count)++].used = s.st_mtim;
	}
	closedir(entries);
	return list;
}

/* Removes the files longest unused until the rest is within the bound. */
static void trim(int dir)
{
	size_t count;
	kept *const list = list_files(dir, &count);
	uint64_t total = 0;
	for (size_t i = 0; i < count; i++)
		total += list[i].size;
	if (total > LOBE_CACHE_MAX)
		qsort(list, count, sizeof *list, by_use);
	for (size_t i = 0; i < count && total > LOBE_CACHE_MAX; i++) {
		unlinkat(dir, list[i].name, 0);
		total -= list[i].size;
	}
	free(list);
}

void lobe_cl_cache_put(const char *key, size_t key_size, const void *data, size_t size)
{
	char name[NAME_SIZE], temporary[2 * NAME_SIZE];
	header h;
	const int dir = is_allowed(sizeof h + key_size + size) ? open_folder(1) : -1;
	if (dir < 0)
		return;
	memset(&h, 0, sizeof h);
	memcpy(h.magic, magic, sizeof magic);
	h.key_size = key_size;
	h.size = size;
	h.check = check_of(&h, key, data);
	file_name(name, key, key_size);
	const int file = open_temporary(dir, name, temporary);
	if (file >= 0) {
		const int written = write_all(file, &h, sizeof h) && write_all(file, key, key_size) &&
				    write_all(file, data, size);
		if (close(file) != 0 || !written || renameat(dir, temporary, dir, name) != 0)
			unlinkat(dir, temporary, 0);
		else
			trim(dir);
	}
	close(dir);
}
