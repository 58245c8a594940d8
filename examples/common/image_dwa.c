/* image_dwa.c - EXR files in DWA compression, which OpenEXR's C library (as of 3.1) cannot decode.
 *
 * Its C++ library can, and has an interface for C. That one delivers half floats, so it is the second choice. */
#include "image.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <ImfCRgbaFile.h>

static int fail(char *message, size_t size, const char *path)
{
	/* The text begins with what went wrong with which file; newlines separate causes. */
	size_t n = (size_t)snprintf(message, size, "%s: %s", path, ImfErrorMessage());
	for (size_t i = 0; i < n && i < size && message[i]; i++)
		if (message[i] == '\n')
			message[i] = ' ';
	return -1;
}

int image_read_dwa(struct image *image, const char *path, char *message, size_t size)
{
	int x0, y0, x1, y1, status = -1;
	ImfRgba *pixels = NULL;
	ImfInputFile *file = ImfOpenInputFile(path);
	if (!file)
		return fail(message, size, path);
	ImfHeaderDataWindow(ImfInputHeader(file), &x0, &y0, &x1, &y1);
	/* The caller has found the window to be of a sensible size. */
	const size_t width = (size_t)((int64_t)x1 - x0 + 1), height = (size_t)((int64_t)y1 - y0 + 1);
	if (image_alloc(image, (int)width, (int)height, message, size) != 0)
		goto done;
	pixels = calloc(width * height, sizeof *pixels);
	if (!pixels) {
		snprintf(message, size, "%s: out of memory", path);
		goto done;
	}
	/* The interface wants the address of pixel (0,0), which need not be in the window. */
	const uintptr_t origin = (uintptr_t)pixels - ((uintptr_t)y0 * width + (uintptr_t)x0) * sizeof *pixels;
	if (!ImfInputSetFrameBuffer(file, (ImfRgba *)origin, 1, width) || !ImfInputReadPixels(file, y0, y1)) {
		fail(message, size, path);
		goto done;
	}
	for (size_t i = 0; i < width * height; i++) {
		image->rgb[3 * i] = ImfHalfToFloat(pixels[i].r);
		image->rgb[3 * i + 1] = ImfHalfToFloat(pixels[i].g);
		image->rgb[3 * i + 2] = ImfHalfToFloat(pixels[i].b);
	}
	status = 0;
done:
	if (status != 0)
		image_free(image);
	free(pixels);
	ImfCloseInputFile(file);
	return status;
}
