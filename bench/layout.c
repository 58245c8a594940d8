/* layout.c - arrays of structs, behind mixed lobes. */
#include "layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine.h"
#include "race.h"

static const int verbs[] = {BENCH_EVAL_PDF, BENCH_SAMPLE};
enum { VERBS = sizeof verbs / sizeof *verbs };

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
	memset(shading, 0, sizeof shading);
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
		fprintf(csv, "structs %s,%s,%s,%zu,1,%.4f,%.4f,-,-\n", bench_lobe_name(lobe), bench_verb_name(verbs[v]),
			d->label, n, racer[1].rate.median, 100.0 * racer[1].ratio.median);
	}
	lobe_scene_destroy(shading[0].scene);
	return ok;
}

/* --- both --------------------------------------------------------------------------------------------------------- */

int bench_layout(const bench_device *devices, int count, size_t n, size_t runs, const char *path,
		 bench_mixed_results *mixed)
{
	static const int lobes[] = {BENCH_LOBE_LAMBERT, BENCH_LOBE_GGX_CONDUCTOR};
	const size_t small = n < 8192 ? n : 8192;
	bench_arrays a;
	FILE *csv = bench_create_file(path);
	hit *const h = malloc(n * sizeof *h);
	int ok = csv && h && bench_arrays_create(&a, n);
	const int arrays = ok;
	if (csv && !ok)
		fprintf(stderr, "throughput: out of memory\n");
	if (ok) {
		printf("\nLayout. Mixed: random materials. of mean: the rate in percent of the mean of its lobes "
		       "alone, which takes\n"
		       "for each lobe's elements the time of as many in a batch of that lobe (the harmonic mean, "
		       "weighted by elements).\n"
		       "sorting: finding each element's place, moving: bringing inputs there and results back, both "
		       "alone, in percent\n"
		       "of that mean's time.\n\n");
		printf("%-34s %-9s %-10s %9s %9s %9s %9s %9s %9s\n", "what", "verb", "device", "elements", "materials",
		       "M/s", "of mean", "sorting", "moving");
		fputs("what,verb,device,elements,materials,median_melements_per_s,share_percent,sorting_percent,"
		      "moving_percent\n",
		      csv);
		ok = bench_mixed(csv, devices, count, n, runs, mixed);
	}
	if (ok)
		printf("\nStructs: inputs and outputs in structs of %zu bytes, in percent of packed arrays; in memory, "
		       "and in the cache.\n\n%-34s %-9s %-10s %9s %9s %9s\n",
		       sizeof *h, "what", "verb", "device", "elements", "M/s", "share");
	for (int d = 0; ok && d < count; d++)
		for (size_t i = 0; ok && i < sizeof lobes / sizeof *lobes; i++)
			ok = struct_rows(csv, &devices[d], lobes[i], &a, h, n, runs) &&
			     struct_rows(csv, &devices[d], lobes[i], &a, h, small, runs);
	if (arrays)
		bench_arrays_destroy(&a);
	free(h);
	return csv && fclose(csv) == 0 && ok;
}
