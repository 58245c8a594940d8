/* trace.h - a wavefront path tracer that shades through the batch API. */
#ifndef GALLERY_TRACE_H
#define GALLERY_TRACE_H

#include "image.h"
#include "light.h"
#include "pool.h"
#include "scene.h"

/* A picture in the making: the sum of a pixel's samples, in double and in the order of the samples. */
struct film {
	int width, height;
	uint32_t samples; /* in every pixel */
	double *sum;
};

struct trace_stats {
	uint64_t samples, queries; /* camera samples; elements of all batches */
	double lobe_seconds;       /* in lobe_scene_sample and lobe_scene_eval */
};

struct trace_setup {
	const struct scene *scene;
	const struct light *light;
	struct pool *pool;
	lobe_scene *materials; /* scene->material on a device */
	int bounces;           /* surfaces that a path scatters at, at most */
	uint32_t seed;         /* other seeds, independent pictures */
	void (*progress)(void *context, uint64_t samples);
	void *context;
};

int film_alloc(struct film *film, int width, int height);
void film_free(struct film *film);
void film_image(const struct film *film, struct image *image); /* image: of the film's size */

/* Adds samples to every pixel until there are `until`, and to stats. The result depends on the scene, the light, the
 * seed and the numbers of bounces and samples; on the device, the threads and earlier stops on the way it does not.
 * 0, or -1 with the reason in message. */
int trace(struct film *film, const struct trace_setup *setup, uint32_t until, struct trace_stats *stats, char *message,
	  size_t size);

#endif
