/* inputs.h - reproducible random arrays for batches, and how many bytes of them a verb of a lobe moves. */
#ifndef LOBE_BENCH_INPUTS_H
#define LOBE_BENCH_INPUTS_H

#include "scenes.h"

/* Input and output arrays of the largest batch. */
typedef struct {
	size_t n;
	float *wo[3], *wi[3], *u[3];
	float *out[7]; /* f and pdf, or sample_wi, weight and sample_pdf */
	uint32_t *event;
	void *memory;
} bench_arrays;

/* n elements: wo uniform on the hemisphere above the surface, wi uniform on the sphere, u uniform; the same numbers in
 * every run (Philox4x32-10 of Random123). 0: out of memory. */
int bench_arrays_create(bench_arrays *a, size_t n);
void bench_arrays_destroy(bench_arrays *a);

/* The first n elements as a batch that asks for what the verb computes. */
lobe_batch bench_batch(const bench_arrays *a, int verb, size_t n);

/* lobe_scene_eval or lobe_scene_sample. */
lobe_status bench_run(lobe_scene *scene, int verb, const lobe_batch *batch);

/* Bytes for each element: 4 for every output array that the verb writes, and 4 for every input array that it depends
 * on. An input that the lobe ignores (u[2] of a lobe that takes two numbers, wo[0] of lambert) is not counted. That is
 * found by trial: other numbers in that one array, and a look whether any bit of the outputs changes. Cache lines that
 * the processor reads before it overwrites them are not counted, neither here nor in the copy. 0: out of memory, or
 * the library failed. */
size_t bench_bytes(lobe_device *device, int lobe, int verb);

#endif
