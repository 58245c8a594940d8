/* sphere.h - a ball of mirroring metal whose surface is rough: by the height field itself, or by a microsurface. */
#ifndef HEIGHTFIELD_SPHERE_H
#define HEIGHTFIELD_SPHERE_H

#include <stdint.h>

#include "field.h"
#include "fit.h"
#include "image.h"
#include "progress.h"

/* Light that has been mirrored once, from facets that are seen and lit; what meets the surface again is dark. The ball
 * is so large that its surface is flat as far as the field goes, and the field repeats.
 *
 * Into the picture from column x on, size pixels each way, spp samples a pixel. Each adds what is done to *done
 * [pixels]. */
struct sphere_view {
	struct image *image;
	int x, size;
	uint32_t spp;
	struct progress *progress;
	uint64_t *done;
};

/* Rays meet the heights, bilinear between texels; mean: slopes of the plane in them. 0, or -1 when out of memory. */
int sphere_of_field(const struct sphere_view *view, const struct field *field, double mean_x, double mean_y);

/* The same light from the distribution, by its visible normals, Smith's masking and shadowing. */
void sphere_of_surface(const struct sphere_view *view, lobe_smith surface);

/* Mean of |a - b| over the mean of b, of two such pictures that begin at these columns. Blocks of 8 x 8 pixels are
 * taken together, so that less of it is noise. */
double sphere_difference(const struct image *image, int a, int b, int size);

#endif
