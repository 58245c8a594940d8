/* stability_count.c - many corners at once, through the batch verbs: what must never come out, counted. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "inputs.h"
#include "stability.h"
#include "support.h"

enum { MATERIALS = 128 };

static void check(stability_counts *c, const float *x, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		c->non_finite += !(x[i] - x[i] == 0.0f);
		c->negative += x[i] < 0.0f;
	}
}

static int fail(const char *what)
{
	fprintf(stderr, "stability: %s: %s\n", what, lobe_error_message());
	return 1;
}

/* Materials and directions of a batch. */
static void draw(lobe_uint kind, uint64_t batch, lobe_bsdf *materials, uint32_t *material, inputs in)
{
	stability_case c;
	memset(&c, 0, sizeof c);
	c.kind = kind;
	for (size_t m = 0; m < MATERIALS; m++) {
		stability_draw_parameters(kind, batch * MATERIALS + m, c.parameter);
		materials[m] = stability_bsdf(&c);
	}
	for (size_t i = 0; i < in.count; i++) {
		stability_draw_anywhere(&c, batch * STABILITY_BATCH + i);
		material[i] = (uint32_t)(i % MATERIALS);
		for (int k = 0; k < 3; k++) {
			in.array[k][i] = c.wo[k];
			in.array[3 + k][i] = c.wi[k];
			in.array[6 + k][i] = c.u[k];
		}
	}
}

static int shade(lobe_scene *scene, inputs in, const uint32_t *material, float *out, stability_counts *c)
{
	const size_t n = in.count;
	lobe_batch b = inputs_batch(in, material, out);
	const float *pdf = out + 3 * n, *sampled = out + 10 * n;
	const uint32_t *event = b.event;
	if (lobe_scene_eval(scene, &b) != LOBE_OK || lobe_scene_sample(scene, &b) != LOBE_OK)
		return fail("a batch");
	check(c, out, 4 * n);
	check(c, out + 7 * n, 4 * n);
	for (size_t i = 0; i < 3 * n; i++)
		c->non_finite += !(out[4 * n + i] - out[4 * n + i] == 0.0f);
	/* The same pairs where the lobe is: what was sampled. */
	for (size_t k = 0; k < 3; k++)
		for (size_t i = 0; i < n; i++)
			if (event[i])
				in.array[3 + k][i] = out[(4 + k) * n + i];
	if (lobe_scene_eval(scene, &b) != LOBE_OK)
		return fail("a batch");
	check(c, out, 4 * n);
	for (size_t i = 0; i < n; i++) {
		c->kept += event[i] != 0u;
		if (event[i] && !(event[i] & LOBE_EVENT_DELTA))
			c->pdf_differs += test_float_bits(pdf[i]) != test_float_bits(sampled[i]);
	}
	c->elements += n;
	return 0;
}

int stability_count(lobe_uint kind, uint64_t batch, stability_counts *counts)
{
	const size_t n = kind == LOBE_KIND_MICROFACET_DIFFUSE ? STABILITY_BATCH / 10 : STABILITY_BATCH;
	lobe_bsdf *materials = malloc(MATERIALS * sizeof *materials);
	uint32_t *material = malloc(n * sizeof *material);
	float *out = malloc(INPUTS_OUTPUTS * n * sizeof *out);
	inputs in = inputs_alloc(n);
	lobe_device *device = NULL;
	lobe_scene *scene = NULL;
	int failed = !materials || !material || !out;
	if (!failed) {
		draw(kind, batch, materials, material, in);
		failed = lobe_device_open(&device, "native:1") != LOBE_OK ||
			 lobe_scene_create(&scene, device, materials, MATERIALS) != LOBE_OK;
		failed = failed ? fail("a scene") : shade(scene, in, material, out, counts);
	}
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	inputs_free(in);
	free(out);
	free(material);
	free(materials);
	return failed;
}
