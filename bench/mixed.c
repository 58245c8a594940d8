/* mixed.c - batches of random materials of several lobes, against each lobe alone. */
#define _POSIX_C_SOURCE 200809L
#include "mixed.h"

#include <stdlib.h>
#include <string.h>

#include "native.h"
#include "race.h"

/* What a scene is likely to have most of, from the cheapest lobe to nearly the dearest, opaque and transparent: diffuse
 * walls, two metals of different tails, glass, and the Schlick surface of engines. */
static const int five[] = {BENCH_LOBE_LAMBERT, BENCH_LOBE_GGX_CONDUCTOR, BENCH_LOBE_GGX_DIELECTRIC,
			   BENCH_LOBE_BECKMANN_CONDUCTOR, BENCH_LOBE_GGX_SCHLICK};
enum { FIVE = sizeof five / sizeof *five };

static const int verbs[] = {BENCH_EVAL_PDF, BENCH_SAMPLE, BENCH_SAMPLE_WI};
enum { VERBS = sizeof verbs / sizeof *verbs };

/* One scene: so many materials, lobe after lobe. */
typedef struct {
	const char *name;
	int lobes; /* FIVE or BENCH_LOBES */
	size_t materials;
} mix;

static const mix mixes[] = {{"five lobes", FIVE, FIVE},
			    {"five lobes, many materials", FIVE, 30 * FIVE},
			    {"all lobes", BENCH_LOBES, BENCH_LOBES}};

static int lobe_of(const mix *m, size_t i) { return m->lobes == FIVE ? five[i % FIVE] : (int)(i % BENCH_LOBES); }

static lobe_status create_scene(lobe_scene **out, lobe_device *device, const mix *m)
{
	lobe_bsdf *const materials = malloc(m->materials * sizeof *materials);
	if (!materials)
		return LOBE_ERROR_MEMORY;
	for (size_t i = 0; i < m->materials; i++)
		materials[i] = bench_lobe_material(lobe_of(m, i));
	const lobe_status status = lobe_scene_create(out, device, materials, m->materials);
	free(materials);
	return status;
}

/* --- sorting alone ------------------------------------------------------------------------------------------------ */

/* What a native thread does to a mixed batch beside shading. */
typedef struct {
	const bench_shading *mixed;
	lobe_native_scratch *scratch;
	int move; /* 0: finds the places only */
} sorting;

static size_t list_outputs(const lobe_batch *b, void **out)
{
	void *const all[] = {b->f[0],         b->f[1],         b->f[2],         b->pdf,
			     b->sample_wi[0], b->sample_wi[1], b->sample_wi[2], b->weight[0],
			     b->weight[1],    b->weight[2],    b->sample_pdf,   b->event};
	size_t n = 0;
	for (size_t k = 0; k < sizeof all / sizeof *all; k++)
		if (all[k])
			out[n++] = all[k];
	return n;
}

static int sort(const void *context)
{
	const sorting *const s = context;
	const lobe_batch *const b = &s->mixed->batch;
	const lobe_scene *const scene = s->mixed->scene;
	const lobe_native_scene *const state = scene->state;
	const lobe_native_split *const split = lobe_native_split_of(scene->device);
	const float *const *const second = bench_verb_samples(s->mixed->verb) ? b->u : b->wi;
	void *out[LOBE_OUT_COUNT];
	const size_t outputs = list_outputs(b, out);
	const size_t block = lobe_native_split_block(scene);
	for (size_t at = 0; at < b->count; at += block) {
		const size_t n = b->count - at < block ? b->count - at : block;
		uint32_t begin[LOBE_NATIVE_SPLIT_KEYS], count[LOBE_NATIVE_SPLIT_KEYS];
		const void *from[LOBE_OUT_COUNT];
		void *to[LOBE_OUT_COUNT];
		split->sort(&s->scratch->places, begin, count, state->key, state->keys, scene->count, b->material + at,
			    n);
		if (!s->move)
			continue;
		for (int k = 0; k < LOBE_IN_COUNT; k++) {
			from[k] = (k < 3 ? b->wo[k] : second[k - 3]) + at;
			to[k] = s->scratch->in[k];
		}
		split->part(to, from, LOBE_IN_COUNT, &s->scratch->places, n);
		for (size_t k = 0; k < outputs; k++) {
			from[k] = s->scratch->out[k];
			to[k] = (float *)out[k] + at;
		}
		split->join(to, from, (int)outputs, &s->scratch->places, 0, n,
			    b->count >= LOBE_NATIVE_STREAM / 4 / outputs);
	}
	split->settle();
	return 1;
}

/* --- rows --------------------------------------------------------------------------------------------------------- */

enum { MIXED, SORTED, MOVED, ALONE, RACERS = ALONE + BENCH_LOBES };

typedef struct {
	const mix *mix;
	const bench_device *device;
	bench_shading shading[RACERS];
	sorting sorting[2];
	bench_racer racer[RACERS];
	uint32_t *material;
	double weight[BENCH_LOBES]; /* the share of each lobe in the elements */
} race;

/* Knuth's multiplicative hash of the place, and the bits mixed once more. */
static void fill_materials(race *r, size_t n)
{
	memset(r->weight, 0, sizeof r->weight);
	for (size_t i = 0; i < n; i++) {
		uint32_t random = (uint32_t)i * 2654435761u;
		random = (random ^ random >> 15) * 0x2c1b3c6du;
		random ^= random >> 13;
		r->material[i] = (uint32_t)((uint64_t)random * r->mix->materials >> 32);
		r->weight[r->material[i] % (uint32_t)r->mix->lobes] += 1.0 / (double)n;
	}
}

static int create_scenes(race *r)
{
	int ok = create_scene(&r->shading[MIXED].scene, r->device->device, r->mix) == LOBE_OK;
	for (int l = 0; ok && l < r->mix->lobes; l++)
		ok = bench_scene_create(&r->shading[ALONE + l].scene, r->device->device, lobe_of(r->mix, (size_t)l)) ==
		     LOBE_OK;
	if (!ok)
		fprintf(stderr, "throughput: %s\n", lobe_error_message());
	return ok;
}

/* The rates of a verb. Sorting is timed where one native thread shades. */
static int run_verb(race *r, const bench_arrays *a, int verb, size_t n, size_t runs, int sorted)
{
	bench_racer list[RACERS];
	int place[RACERS], count = 0;
	for (int i = 0; i < ALONE + r->mix->lobes; i++) {
		bench_shading *const s = &r->shading[i];
		if (i == SORTED || i == MOVED) {
			r->racer[i] =
				(bench_racer){.run = sort, .context = &r->sorting[i - SORTED], .elements = (double)n};
			if (!sorted)
				continue;
		} else {
			s->verb = verb;
			s->batch = bench_batch(a, verb, n);
			s->batch.material = i == MIXED ? r->material : NULL;
			r->racer[i] = bench_shading_racer(s, MIXED);
		}
		place[count] = i;
		list[count++] = r->racer[i];
	}
	const int ok = bench_race(list, count, runs);
	for (int i = 0; i < count; i++)
		r->racer[place[i]] = list[i];
	return ok;
}

static void print_share(FILE *csv, double share, int there)
{
	if (there) {
		printf(" %7.1f %%", share);
		fprintf(csv, ",%.4f", share);
	} else {
		printf(" %9s", "-");
		fputs(",-", csv);
	}
}

static void put_row(FILE *csv, const race *r, int verb, size_t n, int sorted, bench_mixed_results *out)
{
	/* Against the time of the mixed batch, which every ratio is to. */
	double mean = 0.0;
	for (int l = 0; l < r->mix->lobes; l++)
		mean += r->weight[l] / r->racer[ALONE + l].ratio.median;
	const double sorting_time = sorted ? 1.0 / r->racer[SORTED].ratio.median : 0.0;
	const double moving_time = sorted ? 1.0 / r->racer[MOVED].ratio.median - sorting_time : 0.0;
	printf("%-34s %-9s %-10s %9zu %9zu %9.1f", r->mix->name, bench_verb_name(verb), r->device->label, n,
	       r->mix->materials, r->racer[MIXED].rate.median);
	fprintf(csv, "mixed %s,%s,%s,%zu,%zu,%.4f", r->mix->lobes == FIVE ? "five" : "all", bench_verb_name(verb),
		r->device->label, n, r->mix->materials, r->racer[MIXED].rate.median);
	print_share(csv, 100.0 * mean, 1);
	print_share(csv, 100.0 * sorting_time / mean, sorted);
	print_share(csv, 100.0 * moving_time / mean, sorted);
	printf("\n");
	fputs("\n", csv);
	if (sorted && r->mix == mixes && out->count < sizeof out->result / sizeof *out->result)
		out->result[out->count++] =
			(bench_mixed_result){verb, n, 100.0 * mean, 100.0 * (sorting_time + moving_time) / mean};
}

static int run_mix(FILE *csv, race *r, const bench_arrays *a, size_t n, size_t runs, bench_mixed_results *out)
{
	const int sorted = strcmp(r->device->label, "native:1") == 0;
	int ok = 1;
	fill_materials(r, n);
	for (int v = 0; ok && v < VERBS; v++) {
		ok = run_verb(r, a, verbs[v], n, runs, sorted);
		if (ok)
			put_row(csv, r, verbs[v], n, sorted, out);
	}
	return ok;
}

int bench_mixed(FILE *csv, const bench_device *devices, int count, size_t n, size_t runs, bench_mixed_results *out)
{
	const size_t small = n < 16384 ? n : 16384;
	race r;
	bench_arrays a;
	void *scratch = NULL;
	memset(&r, 0, sizeof r);
	out->count = 0;
	r.material = malloc(n * sizeof *r.material);
	int ok = r.material && posix_memalign(&scratch, 64, sizeof(lobe_native_scratch)) == 0 &&
		 bench_arrays_create(&a, n);
	const int arrays = ok;
	if (!ok)
		fprintf(stderr, "throughput: out of memory\n");
	if (scratch)
		memset(scratch, 0, sizeof(lobe_native_scratch));
	for (int k = 0; k < 2; k++)
		r.sorting[k] = (sorting){&r.shading[MIXED], scratch, k};
	for (size_t m = 0; ok && m < (size_t)count * (sizeof mixes / sizeof *mixes); m++) {
		r.device = &devices[m / (sizeof mixes / sizeof *mixes)];
		r.mix = &mixes[m % (sizeof mixes / sizeof *mixes)];
		/* Some lobes choose at run time: all of them take seconds for the larger batch. */
		ok = create_scenes(&r) && (r.mix->lobes != FIVE || n == small || run_mix(csv, &r, &a, n, runs, out)) &&
		     run_mix(csv, &r, &a, small, runs, out);
		for (int i = 0; i < RACERS; i++) {
			lobe_scene_destroy(r.shading[i].scene);
			r.shading[i].scene = NULL;
		}
	}
	if (arrays)
		bench_arrays_destroy(&a);
	free(scratch);
	free(r.material);
	return ok;
}
