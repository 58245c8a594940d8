#define _XOPEN_SOURCE 700
#include "cache_folder.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "unity.h"

char folder[PATH];

int files(char *path)
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

void empty_folder(void)
{
	char path[PATH];
	while (files(path))
		TEST_ASSERT_EQUAL(0, remove(path));
}

unsigned char *content;
size_t content_size;

void read_file(const char *path)
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

void write_file(const char *path, const void *data, size_t size)
{
	FILE *const f = fopen(path, "wb");
	TEST_ASSERT_NOT_NULL(f);
	TEST_ASSERT_EQUAL(size, fwrite(data, 1, size, f));
	fclose(f);
}

void remove_all(const char *path)
{
	char *const arguments[] = {"rm", "-rf", (char *)(uintptr_t)path, NULL};
	const pid_t child = fork();
	if (child == 0) {
		execvp("rm", arguments);
		_exit(127);
	}
	waitpid(child, NULL, 0);
}
