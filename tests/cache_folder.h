/* cache_folder.h - the folder that tests of the cache give it, and the files there. */
#ifndef LOBE_TESTS_CACHE_FOLDER_H
#define LOBE_TESTS_CACHE_FOLDER_H

#include <stddef.h>

enum { PATH = 512 };

extern char folder[PATH];

/* Files in the folder; the path of the last in path. */
int files(char *path);
void empty_folder(void);

/* read_file: what the file holds, until the next call. */
extern unsigned char *content;
extern size_t content_size;
void read_file(const char *path);
void write_file(const char *path, const void *data, size_t size);

/* A folder and all that is in it. */
void remove_all(const char *path);

#endif
