/* light.h - the light around the scene: a lat-long probe, from a file or a procedural studio.
 *
 * World space: z up. The picture's middle column lies at +y, in front of the camera, and its right half at +x. */
#ifndef GALLERY_LIGHT_H
#define GALLERY_LIGHT_H

#include "image.h"
#include "lobe/shading.h"

struct texel {
	lobe_rgb radiance;
	float pdf; /* per solid angle, constant on a texel */
};

struct light {
	int width, height;
	struct texel *texel;             /* [height][width] */
	float *row_cdf, *col_cdf;        /* [height + 1]; [height][width + 1] */
	uint16_t *row_guide, *col_guide; /* [height]; [height][width]: where to start in the cdf, see find() */
	float *cos_theta;                /* [height + 1], of the rows' edges */
	float turn;                      /* rotation about z, in turns */
};

struct light_sample {
	lobe_vec3 wi;
	lobe_rgb radiance;
	float pdf; /* per solid angle; 0: no sample */
};

/* Takes a copy of a lat-long picture. What cannot be radiance is repaired, NaN and negative to 0 and infinite to the
 * largest half, and *repaired says in how many texels. 0, or -1 when memory runs out. */
int light_from_image(struct light *light, const struct image *image, float degrees, size_t *repaired);

/* The default: a dim sky, a low sun and three soft boxes. 0, or -1 when memory runs out. */
int light_studio(struct light *light, float degrees);

void light_free(struct light *light);

/* What comes from direction w (unit), and the density with which light_draw draws w. */
lobe_rgb light_radiance(const struct light *light, lobe_vec3 w, float *pdf);

/* A direction with a density proportional to the luminance. u1, u2 in [0,1). */
struct light_sample light_draw(const struct light *light, float u1, float u2);

#endif
