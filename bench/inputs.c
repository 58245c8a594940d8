/* inputs.c - random arrays for batches, and the bytes that a verb moves. */
#define _POSIX_C_SOURCE 200809L
#include <Random123/philox.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inputs.h"

enum {
	ARRAYS = 9 + 8,
	LINE = 64,   /* bytes in a cache line */
	TRIAL = 4096 /* elements that bench_bytes looks at */
};

/* --- arrays ------------------------------------------------------------------------------------------------------- */

static philox4x32_ctr_t numbers(uint32_t stream, size_t i)
{
	const philox4x32_ctr_t counter = {{(uint32_t)i, (uint32_t)((uint64_t)i >> 32), stream, 0}};
	const philox4x32_key_t key = {{0x6c6f6265u, 0}};
	return philox4x32(counter, key);
}

/* [0, 1), a multiple of 2^-24 */
static float uniform(uint32_t bits) { return (float)(bits >> 8) * 0x1p-24f; }

/* Unit and never in the plane of the surface. lowest: -1 for the sphere, 0 for the upper hemisphere. */
static void direction(float *const w[3], size_t i, float lowest, uint32_t a, uint32_t b)
{
	const float z = lowest + (1.0f - lowest) * (uniform(a) + 0x1p-25f);
	const float r = sqrtf((1.0f - z) * (1.0f + z));
	const float phi = 6.2831853f * uniform(b);
	w[0][i] = r * cosf(phi);
	w[1][i] = r * sinf(phi);
	w[2][i] = z;
}

int bench_arrays_create(bench_arrays *a, size_t n)
{
	/* Arrays of a power of two elements that begin at the same place in a page fall into the same few sets of the
	 * cache. Each is shifted by some lines against the one before, so that the figures do not hang on that. */
	const size_t lines = (n * 4 + LINE - 1) / LINE + 5;
	float *array[ARRAYS];
	if (posix_memalign(&a->memory, 4096, lines * LINE * ARRAYS) != 0) {
		a->memory = NULL;
		return 0;
	}
	memset(a->memory, 0xff, lines * LINE * ARRAYS);
	for (size_t k = 0; k < ARRAYS; k++)
		array[k] = (float *)a->memory + k * lines * (LINE / 4);
	a->n = n;
	for (int c = 0; c < 3; c++) {
		a->wo[c] = array[c];
		a->wi[c] = array[3 + c];
		a->u[c] = array[6 + c];
	}
	for (int k = 0; k < 7; k++)
		a->out[k] = array[9 + k];
	a->event = (uint32_t *)(void *)array[16];
	for (size_t i = 0; i < n; i++) {
		const philox4x32_ctr_t d = numbers(0, i), u = numbers(1, i);
		direction(a->wo, i, 0.0f, d.v[0], d.v[1]);
		direction(a->wi, i, -1.0f, d.v[2], d.v[3]);
		for (int c = 0; c < 3; c++)
			a->u[c][i] = uniform(u.v[c]);
	}
	return 1;
}

void bench_arrays_destroy(bench_arrays *a) { free(a->memory); }

lobe_batch bench_batch(const bench_arrays *a, int verb, size_t n)
{
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = n;
	for (int c = 0; c < 3; c++) {
		b.wo[c] = a->wo[c];
		if (bench_verb_samples(verb)) {
			b.u[c] = a->u[c];
			b.sample_wi[c] = a->out[c];
			b.weight[c] = verb == BENCH_SAMPLE ? a->out[3 + c] : NULL;
		} else {
			b.wi[c] = a->wi[c];
			b.f[c] = verb == BENCH_PDF ? NULL : a->out[c];
		}
	}
	if (bench_verb_samples(verb)) {
		b.sample_pdf = verb == BENCH_SAMPLE ? a->out[6] : NULL;
		b.event = a->event;
	} else {
		b.pdf = verb == BENCH_EVAL ? NULL : a->out[3];
	}
	return b;
}

lobe_status bench_run(lobe_scene *scene, int verb, const lobe_batch *batch)
{
	return bench_verb_samples(verb) ? lobe_scene_sample(scene, batch) : lobe_scene_eval(scene, batch);
}

/* --- bytes -------------------------------------------------------------------------------------------------------- */

/* The outputs of a batch, copied to results; the number of arrays. */
static size_t take_outputs(const lobe_batch *b, float *results)
{
	const void *const out[] = {b->f[0],         b->f[1],         b->f[2],         b->pdf,
				   b->sample_wi[0], b->sample_wi[1], b->sample_wi[2], b->weight[0],
				   b->weight[1],    b->weight[2],    b->sample_pdf,   b->event};
	size_t n = 0;
	for (size_t k = 0; k < sizeof out / sizeof *out; k++)
		if (out[k])
			memcpy(results + n++ * TRIAL, out[k], TRIAL * 4);
	return n;
}

/* Words for each element, 0 after a failure. results: room for 8 arrays, twice. */
static size_t count_words(lobe_scene *scene, int verb, bench_arrays *a, float *results)
{
	float *const *const inputs[2] = {a->wo, bench_verb_samples(verb) ? a->u : a->wi};
	const lobe_batch b = bench_batch(a, verb, TRIAL);
	float kept[TRIAL];
	if (bench_run(scene, verb, &b) != LOBE_OK)
		return 0;
	const size_t outputs = take_outputs(&b, results);
	size_t words = outputs;
	for (int k = 0; k < 6; k++) {
		/* Directions on the other side of the surface too: a lobe may read no more than that. */
		const int u = k >= 3 && bench_verb_samples(verb);
		float *const input = inputs[k / 3][k % 3];
		memcpy(kept, input, sizeof kept);
		for (size_t i = 0; i < TRIAL; i++)
			input[i] = kept[(i + 1) % TRIAL] * (u || i % 2 ? 1.0f : -1.0f);
		if (bench_run(scene, verb, &b) != LOBE_OK)
			return 0;
		take_outputs(&b, results + 8 * TRIAL);
		words += memcmp(results, results + 8 * TRIAL, outputs * TRIAL * 4) != 0;
		memcpy(input, kept, sizeof kept);
	}
	return words;
}

size_t bench_bytes(lobe_device *device, int lobe, int verb)
{
	bench_arrays a;
	lobe_scene *scene;
	float *const results = malloc(2 * 8 * TRIAL * sizeof *results);
	size_t words = 0;
	if (!results || !bench_arrays_create(&a, TRIAL)) {
		free(results);
		return 0;
	}
	if (bench_scene_create(&scene, device, lobe) == LOBE_OK) {
		words = count_words(scene, verb, &a, results);
		lobe_scene_destroy(scene);
	}
	bench_arrays_destroy(&a);
	free(results);
	return 4 * words;
}
