/* batch.c - the same batch on every device: rate, and proof that the bits agree.
 *
 *	cc -std=c99 -O2 batch.c -llobe -lm */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "lobe/lobe.h"

enum { N = 1 << 20, RUNS = 5 };

static double seconds(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A cheap well-mixed sequence in [0,1), enough for an example. */
static float uniform(void)
{
	static uint64_t state = 1;
	state = state * 6364136223846793005u + 1442695040888963407u;
	return (float)(state >> 40) * 0x1p-24f;
}

int main(void)
{
	/* Gold on even elements, frosted glass on odd ones. */
	const lobe_bsdf materials[2] = {
		lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(0.3f, 0.1f, lobe_metal_eta(LOBE_METAL_GOLD),
								     lobe_metal_k(LOBE_METAL_GOLD))),
		lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.2f, 0.2f, lobe_glass_eta(LOBE_GLASS_BK7)))};
	static float in[6][N], out[7][N], first[7][N];
	static uint32_t material[N], event[N];
	lobe_batch batch = {.count = N, .material = material, .sample_pdf = out[6], .event = event};
	for (int k = 0; k < 3; k++) {
		batch.wo[k] = in[k];
		batch.u[k] = in[3 + k];
		batch.sample_wi[k] = out[k];
		batch.weight[k] = out[3 + k];
	}
	for (int i = 0; i < N; i++) {
		const lobe_vec3 wo = lobe_cosine_hemisphere(lobe_vec2_make(uniform(), uniform()));
		material[i] = (uint32_t)i & 1;
		in[0][i] = wo.x;
		in[1][i] = wo.y;
		in[2][i] = wo.z;
		for (int k = 3; k < 6; k++)
			in[k][i] = uniform();
	}

	size_t opencl = 0;
	int wrong = 0;
	lobe_device_count("opencl", &opencl);
	printf("%-58s %14s %14s\n", "device", "M samples/s", "differing bits");
	for (size_t d = 0; d <= opencl; d++) {
		char name[32] = "native";
		lobe_device *device = NULL;
		lobe_scene *scene;
		if (d)
			snprintf(name, sizeof name, "opencl:%zu", d - 1);
		if (lobe_device_open(&device, name) != LOBE_OK ||
		    lobe_scene_create(&scene, device, materials, 2) != LOBE_OK) {
			/* The others are compared with native, so that it alone must work. */
			fprintf(d ? stdout : stderr, "%s%s: %s\n", d ? "skipped: " : "", name, lobe_error_message());
			lobe_device_close(device);
			if (d == 0)
				return 1;
			continue;
		}
		double best = 1e30;
		for (int run = 0; run <= RUNS; run++) { /* the first warms up */
			const double start = seconds();
			if (lobe_scene_sample(scene, &batch) != LOBE_OK) {
				fprintf(stderr, "%s: %s\n", name, lobe_error_message());
				return 1;
			}
			const double took = seconds() - start;
			best = run && took < best ? took : best;
		}
		long bits = 0;
		for (int k = 0; k < 7; k++)
			for (int i = 0; i < N; i++) {
				if (d == 0)
					first[k][i] = out[k][i];
				lobe_uint x = lobe_to_bits(out[k][i]) ^ lobe_to_bits(first[k][i]);
				for (; x; x &= x - 1)
					bits++;
			}
		printf("%-58s %14.1f %14ld\n", lobe_device_name(device), 1e-6 * N / best, bits);
		wrong |= bits != 0;
		lobe_scene_destroy(scene);
		lobe_device_close(device);
	}
	return wrong;
}
