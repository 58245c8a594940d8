/* image.h - pictures in and out: OpenEXR through its C library, PNG through libpng. */
#ifndef COMMON_IMAGE_H
#define COMMON_IMAGE_H

#include <stddef.h>

/* Linear RGB, three floats a pixel, the top row first. */
struct image {
	int width, height;
	float *rgb;
};

/* Each returns 0, or -1 after it has written the reason (one line, without a newline) to message[0..size). */
int image_alloc(struct image *image, int width, int height, char *message, size_t size);

/* The first part of an EXR file, scanlines or tiles, channels R, G and B or Y alone, of any pixel type. */
int image_read_exr(struct image *image, const char *path, char *message, size_t size);

/* The same for DWA compression. image_read_exr() falls back on it, after it has checked the file's header. */
int image_read_dwa(struct image *image, const char *path, char *message, size_t size);

/* Floats, as they are. */
int image_write_exr(const struct image *image, const char *path, char *message, size_t size);

/* 8 bits a channel, sRGB, after the tone curve that image.c explains; exposure in stops. */
int image_write_png(const struct image *image, const char *path, float exposure, char *message, size_t size);

/* The same without tone curve and exposure: 0 to 1, for pictures of data. */
int image_write_png_plain(const struct image *image, const char *path, char *message, size_t size);

void image_free(struct image *image);

#endif
