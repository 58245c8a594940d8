/* tool_bits.c - a fingerprint of everything that a device computes, to compare builds and machines by diff.
 *
 *	tool_bits DEVICE
 *
 * prints, for each case of each lobe, a 64-bit hash over the outputs of 80 k random and all extreme inputs (a part of
 * both for the slowest lobe). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "inputs.h"
#include "lobe/lobe.h"

/* FNV-1a over 32-bit words. */
static uint64_t hash(uint64_t h, const float *words, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		uint32_t w;
		memcpy(&w, &words[i], 4);
		h = (h ^ w) * 0x100000001b3u;
	}
	return h;
}

static void stop(const char *what)
{
	fprintf(stderr, "tool_bits: %s: %s\n", what, lobe_error_message());
	exit(1);
}

static uint64_t fingerprint(lobe_device *device, const lobe_bsdf *material, inputs in)
{
	lobe_scene *scene;
	lobe_batch b;
	float *out = malloc(12 * in.count * sizeof *out);
	if (!out || lobe_scene_create(&scene, device, material, 1) != LOBE_OK)
		stop("lobe_scene_create");
	memset(&b, 0, sizeof b);
	b.count = in.count;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = in.array[k];
		b.wi[k] = in.array[3 + k];
		b.u[k] = in.array[6 + k];
		b.f[k] = out + (size_t)k * in.count;
		b.sample_wi[k] = out + (size_t)(4 + k) * in.count;
		b.weight[k] = out + (size_t)(7 + k) * in.count;
	}
	b.pdf = out + 3 * in.count;
	b.sample_pdf = out + 10 * in.count;
	b.event = (uint32_t *)(void *)(out + 11 * in.count);
	if (lobe_scene_eval(scene, &b) != LOBE_OK || lobe_scene_sample(scene, &b) != LOBE_OK)
		stop("batch");
	const uint64_t h = hash(0xcbf29ce484222325u, out, 12 * in.count);
	lobe_scene_destroy(scene);
	free(out);
	return h;
}

int main(int argc, char **argv)
{
	lobe_device *device;
	if (argc != 2) {
		fprintf(stderr, "usage: tool_bits DEVICE\n");
		return 2;
	}
	if (lobe_device_open(&device, argv[1]) != LOBE_OK)
		stop(argv[1]);
	inputs random = inputs_alloc(81920), extreme = inputs_extreme();
	inputs_random(random, 1000000);
	fprintf(stderr, "%s\n", lobe_device_name(device));
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		/* Which shades by a hundred facets an element. */
		const size_t share = c->kind == LOBE_KIND_MICROFACET_DIFFUSE ? 16 : 1;
		inputs some = random, corners = extreme;
		some.count /= share;
		corners.count /= share;
		printf("%016llx %016llx %s\n", (unsigned long long)fingerprint(device, &c->bsdf, some),
		       (unsigned long long)fingerprint(device, &c->bsdf, corners), c->name);
	}
	inputs_free(random);
	inputs_free(extreme);
	lobe_device_close(device);
	return 0;
}
