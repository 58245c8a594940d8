/* layout.c - mixed lobes, and arrays of structs. */
#include "layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine.h"
#include "race.h"

enum { RACERS_MAX = BENCH_LOBES + 2 };

static const int verbs[] = {BENCH_EVAL_PDF, BENCH_SAMPLE};
enum { VERBS = sizeof verbs / sizeof *verbs };

/* --- mixed lobes -------------------------------------------------------------------------------------------------- */

/* A scene of so many materials, lobe after lobe. */
static lobe_status create_mixed(lobe_scene **out, lobe_device *device, size_t materials)
{
	lobe_bsdf *const m = malloc(materials * sizeof *m);
	if (!m)
		return LOBE_ERROR_MEMORY;
	for (size_t i = 0; i < materials; i++)
		m[i] = bench_lobe_material((int)(i % BENCH_LOBES));
	const lobe_status status = lobe_scene_create(out, device, m, materials);
	free(m);
	return status;
}

/* The mean of the times of each lobe alone over the time of the mixed batch, in percent. racer[i]: compared with the
 * mixed one. */
static double share(const bench_racer *alone)
{
	double time = 0.0;
	for (int i = 0; i < BENCH_LOBES; i++)
		time += 1.0 / alone[i].ratio.median;
	return 100.0 * time / BENCH_LOBES;
}

/* material: a random number for each element. */
static int mixed_rows(FILE *csv, const bench_device *d, bench_arrays *a, uint32_t *material, size_t n, size_t materials,
		      size_t runs)
{
	bench_shading shading[RACERS_MAX];
	bench_racer racer[RACERS_MAX];
	int ok = create_mixed(&shading[0].scene, d->device, materials) == LOBE_OK, scenes = ok;
	for (int i = 0; ok && i < BENCH_LOBES; i++, scenes += ok)
		ok = bench_scene_create(&shading[1 + i].scene, d->device, i) == LOBE_OK;
	for (size_t i = 0; i < n; i++) {
		/* Knuth's multiplicative hash of the place. */
		const uint32_t random = (uint32_t)i * 2654435761u;
		material[i] = (uint32_t)((uint64_t)(random ^ random >> 15) * materials >> 32);
	}
	for (int v = 0; ok && v < VERBS; v++) {
		for (int i = 0; i <= BENCH_LOBES; i++) {
			shading[i].verb = verbs[v];
			shading[i].batch = bench_batch(a, verbs[v], n);
			racer[i] = bench_shading_racer(&shading[i], 0);
		}
		shading[0].batch.material = material;
		ok = bench_race(racer, 1 + BENCH_LOBES, runs);
		if (!ok)
			break;
		printf("%-34s %-9s %-10s %9zu %9.1f %7.1f %%\n", "mixed, against its lobes alone",
		       bench_verb_name(verbs[v]), d->label, materials, racer[0].rate.median, share(racer + 1));
		fprintf(csv, "mixed,%s,%s,%zu,%zu,%.4f,%.4f\n", bench_verb_name(verbs[v]), d->label, n, materials,
			racer[0].rate.median, share(racer + 1));
	}
	for (int i = 0; i < scenes; i++)
		lobe_scene_destroy(shading[i].scene);
	return ok;
}

/* --- arrays of structs -------------------------------------------------------------------------------------------- */

/* What a renderer may keep of a hit. */
typedef struct {
	lobe_vec3 wo, wi_or_u;
	lobe_vec3 wi;
	lobe_rgb f;
	float pdf;
	uint32_t event;
} hit;

static lobe_batch struct_batch(hit *h, const bench_arrays *a, int verb, size_t n)
{
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = n;
	for (size_t i = 0; i < n; i++) {
		float *const *const second = bench_verb_samples(verb) ? a->u : a->wi;
		memset(&h[i], 0, sizeof h[i]);
		h[i].wo = lobe_vec3_make(a->wo[0][i], a->wo[1][i], a->wo[2][i]);
		h[i].wi_or_u = lobe_vec3_make(second[0][i], second[1][i], second[2][i]);
	}
	b.wo[0] = &h->wo.x, b.wo[1] = &h->wo.y, b.wo[2] = &h->wo.z;
	if (bench_verb_samples(verb)) {
		b.u[0] = &h->wi_or_u.x, b.u[1] = &h->wi_or_u.y, b.u[2] = &h->wi_or_u.z;
		b.sample_wi[0] = &h->wi.x, b.sample_wi[1] = &h->wi.y, b.sample_wi[2] = &h->wi.z;
		b.weight[0] = &h->f.r, b.weight[1] = &h->f.g, b.weight[2] = &h->f.b;
		b.sample_pdf = &h->pdf;
		b.event = &h->event;
	} else {
		b.wi[0] = &h->wi_or_u.x, b.wi[1] = &h->wi_or_u.y, b.wi[2] = &h->wi_or_u.z;
		b.f[0] = &h->f.r, b.f[1] = &h->f.g, b.f[2] = &h->f.b;
		b.pdf = &h->pdf;
	}
	const size_t s = sizeof *h;
	b.stride = (lobe_strides){s, s, s, s, s, s, s, s, s, s};
	return b;
}

static int struct_rows(FILE *csv, const bench_device *d, int lobe, const bench_arrays *a, hit *h, size_t n, size_t runs)
{
	bench_shading shading[2];
	bench_racer racer[2];
	int ok = bench_scene_create(&shading[0].scene, d->device, lobe) == LOBE_OK;
	if (!ok)
		return 0;
	shading[1].scene = shading[0].scene;
	for (int v = 0; ok && v < VERBS; v++) {
		for (int i = 0; i < 2; i++) {
			shading[i].verb = verbs[v];
			shading[i].batch = i ? struct_batch(h, a, verbs[v], n) : bench_batch(a, verbs[v], n);
			racer[i] = bench_shading_racer(&shading[i], 0);
		}
		ok = bench_race(racer, 2, runs);
		if (!ok)
			break;
		printf("%-34s %-9s %-10s %9zu %9.1f %7.1f %%\n",
		       lobe == BENCH_LOBE_LAMBERT ? "structs, lambert" : "structs, ggx_conductor",
		       bench_verb_name(verbs[v]), d->label, n, racer[1].rate.median, 100.0 * racer[1].ratio.median);
		fprintf(csv, "structs %s,%s,%s,%zu,1,%.4f,%.4f\n", bench_lobe_name(lobe), bench_verb_name(verbs[v]),
			d->label, n, racer[1].rate.median, 100.0 * racer[1].ratio.median);
	}
	lobe_scene_destroy(shading[0].scene);
	return ok;
}

/* --- both --------------------------------------------------------------------------------------------------------- */

int bench_layout(const bench_device *devices, int count, size_t n, size_t runs, const char *path)
{
	static const size_t materials[] = {BENCH_LOBES, 30 * BENCH_LOBES};
	static const int lobes[] = {BENCH_LOBE_LAMBERT, BENCH_LOBE_GGX_CONDUCTOR};
	const size_t small = n < 8192 ? n : 8192;
	bench_arrays a;
	FILE *csv = bench_create_file(path);
	uint32_t *const material = malloc(n * sizeof *material);
	hit *const h = malloc(n * sizeof *h);
	int ok = csv && material && h && bench_arrays_create(&a, n);
	const int arrays = ok;
	if (csv && !ok)
		fprintf(stderr, "throughput: out of memory\n");
	if (ok) {
		printf("\nLayout: batches of %zu elements. mixed: random materials of every lobe, in percent of the "
		       "mean of\n"
		       "the lobes alone. structs: inputs and outputs in structs of %zu bytes, in percent of packed "
		       "arrays; in\n"
		       "memory, and in the cache (%zu elements).\n\n",
		       n, sizeof *h, small);
		printf("%-34s %-9s %-10s %9s %9s %9s\n", "what", "verb", "device", "materials", "M/s", "share");
		fputs("what,verb,device,elements,materials,median_melements_per_s,share_percent\n", csv);
	}
	for (int d = 0; ok && d < count; d++)
		for (size_t i = 0; ok && i < sizeof materials / sizeof *materials; i++)
			ok = mixed_rows(csv, &devices[d], &a, material, n, materials[i], runs);
	if (ok)
		printf("\n%-34s %-9s %-10s %9s %9s %9s\n", "what", "verb", "device", "elements", "M/s", "share");
	for (int d = 0; ok && d < count; d++)
		for (size_t i = 0; ok && i < sizeof lobes / sizeof *lobes; i++)
			ok = struct_rows(csv, &devices[d], lobes[i], &a, h, n, runs) &&
			     struct_rows(csv, &devices[d], lobes[i], &a, h, small, runs);
	if (arrays)
		bench_arrays_destroy(&a);
	free(material);
	free(h);
	return csv && fclose(csv) == 0 && ok;
}
