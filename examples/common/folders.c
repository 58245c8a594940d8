/* folders.c - see folders.h. */
#define _POSIX_C_SOURCE 200809L
#include "folders.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

/* Every path that ends at one of the first length characters: before a slash, or at the last of them. */
static int make_up_to(const char *path, size_t length)
{
	char part[512];
	if (length >= sizeof part) {
		errno = ENAMETOOLONG;
		return -1;
	}
	for (size_t i = 1; i <= length; i++) {
		if (i < length && path[i] != '/')
			continue;
		memcpy(part, path, i);
		part[i] = '\0';
		if (mkdir(part, 0777) != 0 && errno != EEXIST)
			return -1;
	}
	return 0;
}

int make_folders(const char *path) { return make_up_to(path, strlen(path)); }

int make_folders_of(const char *file)
{
	const char *const slash = strrchr(file, '/');
	return make_up_to(file, slash ? (size_t)(slash - file) : 0);
}
