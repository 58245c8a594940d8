/* measure.c - timed rounds over the verbs and devices of a lobe. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../examples/common/processors.h"
#include "machine.h"
#include "measure.h"

/* A timed run takes at least so long: far more than the clock's resolution and a thread's waking. */
#define SHORTEST_RUN 3e-3
/* A batch that takes longer is no longer bound by memory, and is cut in half, down to plan->least. */
#define LONGEST_RUN 0.15

/* One result in the making. */
typedef struct {
	lobe_scene *scene;
	lobe_batch batch;
	bench_copy *copy;
	double *rate, *copy_rate; /* [runs] */
} cell;

typedef struct {
	const bench_plan *plan;
	bench_results *results;
	bench_arrays arrays;
	bench_copy *copy[BENCH_DEVICES_MAX];  /* by device; devices of as many threads share one */
	lobe_scene *scene[BENCH_DEVICES_MAX]; /* of the lobe at hand */
	cell *cell;                           /* of the lobe at hand, as results->result[first..] */
	size_t first;
	double *ratio; /* [runs] */
} work;

static int fail(const char *what)
{
	fprintf(stderr, "throughput: %s\n", what);
	return 0;
}

static int chosen(int wanted, int i) { return wanted < 0 || wanted == i; }

/* --- one cell ----------------------------------------------------------------------------------------------------- */

/* Seconds of calls batches, or less than 0 when one fails. */
static double time_batches(const cell *c, int verb, size_t calls)
{
	const double start = bench_now();
	for (size_t i = 0; i < calls; i++)
		if (bench_run(c->scene, verb, &c->batch) != LOBE_OK)
			return -1.0;
	return bench_now() - start;
}

/* Warms up, which compiles the kernel of an OpenCL device, and finds how many elements and calls make a run. */
static int prepare(cell *c, bench_result *r, size_t least)
{
	double seconds = time_batches(c, r->verb, 1);
	r->calls = 1;
	while (seconds >= 0.0) {
		seconds = time_batches(c, r->verb, r->calls);
		if (seconds > LONGEST_RUN && r->n / 2 >= least) {
			r->n /= 2;
			c->batch.count = r->n;
		} else if (seconds < SHORTEST_RUN) {
			r->calls *= 2;
		} else {
			return 1;
		}
	}
	return fail(lobe_error_message());
}

/* One run and its copy. Batches that stay in the cache are first brought back into it. */
static int time_cell(const cell *c, const bench_result *r, size_t run)
{
	const double elements = (double)r->n * (double)r->calls * 1e-6;
	if (r->calls > 1 && time_batches(c, r->verb, 1) < 0.0)
		return fail(lobe_error_message());
	const double seconds = time_batches(c, r->verb, r->calls);
	if (seconds < 0.0)
		return fail(lobe_error_message());
	if (r->calls > 1)
		bench_copy_run(c->copy, r->n * r->bytes, 1);
	c->rate[run] = elements / seconds;
	c->copy_rate[run] = elements / bench_copy_run(c->copy, r->n * r->bytes, r->calls);
	return 1;
}

/* The median over the rounds of rate over base. ratio: room for them. */
static double median_ratio(const double *rate, const double *base, double *ratio, size_t runs)
{
	for (size_t i = 0; i < runs; i++)
		ratio[i] = rate[i] / base[i];
	return bench_stats_of(ratio, runs).median;
}

/* The plan's native device with all threads, or -1. */
static int native_device(const bench_plan *plan)
{
	for (int d = 0; d < plan->device_count; d++)
		if (strncmp(plan->devices[d].label, "native", 6) == 0 && plan->devices[d].threads == processor_count())
			return d;
	return -1;
}

/* The results of the lobe from its rounds. Ratios first: the statistics sort the rates, and so lose the rounds. */
static void summarise(const work *w, size_t cells)
{
	const size_t runs = w->plan->runs;
	const int native = native_device(w->plan);
	bench_result *const results = &w->results->result[w->first];
	for (size_t i = 0; i < cells; i++) {
		const cell *c = &w->cell[i];
		bench_result *r = &results[i];
		r->copy_share = 100.0 * median_ratio(c->rate, c->copy_rate, w->ratio, runs);
		/* The devices of a verb and size lie side by side, in the plan's order. */
		if (native >= 0 && bench_is_opencl(&w->plan->devices[r->device]))
			r->native_ratio = median_ratio(c->rate, (c - r->device + native)->rate, w->ratio, runs);
	}
	for (size_t i = 0; i < cells; i++) {
		results[i].rate = bench_stats_of(w->cell[i].rate, runs);
		results[i].copy_rate = bench_stats_of(w->cell[i].copy_rate, runs);
	}
}

/* --- one lobe ----------------------------------------------------------------------------------------------------- */

/* Appends the results of the lobe, in the order of the rounds, with their cells. */
static int add_cells(work *w, int lobe)
{
	const bench_plan *plan = w->plan;
	for (int verb = 0; verb < BENCH_VERBS; verb++) {
		if (!chosen(plan->verb, verb))
			continue;
		const size_t bytes = bench_bytes(plan->devices[0].device, lobe, verb);
		if (bytes == 0)
			return fail("out of memory, or the library failed");
		for (int size = 0; size < plan->size_count; size++)
			for (int device = 0; device < plan->device_count; device++) {
				cell *c = &w->cell[w->results->count - w->first];
				bench_result *r = &w->results->result[w->results->count++];
				r->lobe = lobe;
				r->verb = verb;
				r->device = device;
				r->size = size;
				r->n = plan->sizes[size];
				r->bytes = bytes;
				c->scene = w->scene[device];
				c->batch = bench_batch(&w->arrays, verb, r->n);
				c->copy = w->copy[device];
				if (!prepare(c, r, plan->least))
					return 0;
			}
	}
	return 1;
}

static int measure_lobe(work *w, int lobe)
{
	const bench_plan *plan = w->plan;
	int ok = 1;
	w->first = w->results->count;
	bench_progress(bench_lobe_name(lobe), 0, plan->runs);
	for (int d = 0; d < plan->device_count; d++)
		w->scene[d] = NULL;
	for (int d = 0; ok && d < plan->device_count; d++)
		if (bench_scene_create(&w->scene[d], plan->devices[d].device, lobe) != LOBE_OK)
			ok = fail(lobe_error_message());
	ok = ok && add_cells(w, lobe);
	const size_t cells = w->results->count - w->first;
	for (size_t run = 0; ok && run < plan->runs; run++) {
		bench_progress(bench_lobe_name(lobe), run + 1, plan->runs);
		for (size_t i = 0; ok && i < cells; i++)
			ok = time_cell(&w->cell[i], &w->results->result[w->first + i], run);
	}
	bench_progress(NULL, 0, 0);
	if (ok)
		summarise(w, cells);
	for (int d = 0; d < plan->device_count; d++)
		lobe_scene_destroy(w->scene[d]);
	return ok;
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

/* A copy for each number of threads. */
static int create_copies(work *w, size_t n)
{
	const size_t most = n * 4 * (6 + 8);
	for (int d = 0; d < w->plan->device_count; d++) {
		for (int k = 0; k < d && !w->copy[d]; k++)
			if (w->plan->devices[k].threads == w->plan->devices[d].threads)
				w->copy[d] = w->copy[k];
		if (!w->copy[d] && !(w->copy[d] = bench_copy_create(w->plan->devices[d].threads, most)))
			return 0;
	}
	return 1;
}

static void destroy_copies(work *w)
{
	for (int d = w->plan->device_count - 1; d >= 0; d--) {
		int shared = 0;
		for (int k = 0; k < d; k++)
			shared |= w->copy[k] == w->copy[d];
		if (!shared)
			bench_copy_destroy(w->copy[d]);
	}
}

int bench_measure(const bench_plan *plan, bench_results *results)
{
	const size_t cells = (size_t)(BENCH_VERBS * plan->size_count * plan->device_count);
	work w;
	size_t n = 1;
	int ok;
	memset(&w, 0, sizeof w);
	w.plan = plan;
	w.results = results;
	for (int s = 0; s < plan->size_count; s++)
		n = plan->sizes[s] > n ? plan->sizes[s] : n;
	results->count = 0;
	results->result = calloc(cells * BENCH_LOBES, sizeof *results->result);
	w.cell = calloc(cells, sizeof *w.cell);
	double *const rates = malloc((cells * 2 + 1) * plan->runs * sizeof *rates);
	ok = results->result && w.cell && rates && bench_arrays_create(&w.arrays, n) && create_copies(&w, n);
	if (!ok)
		fail("out of memory or threads; --n takes fewer elements");
	for (size_t i = 0; ok && i < cells; i++) {
		w.cell[i].rate = rates + 2 * i * plan->runs;
		w.cell[i].copy_rate = w.cell[i].rate + plan->runs;
	}
	w.ratio = ok ? rates + 2 * cells * plan->runs : NULL;
	for (int lobe = 0; ok && lobe < BENCH_LOBES; lobe++)
		if (chosen(plan->lobe, lobe))
			ok = measure_lobe(&w, lobe);
	destroy_copies(&w);
	bench_arrays_destroy(&w.arrays);
	free(rates);
	free(w.cell);
	return ok;
}

const bench_result *bench_find(const bench_results *results, int lobe, int verb, int device, int size)
{
	for (size_t i = 0; i < results->count; i++) {
		const bench_result *r = &results->result[i];
		if (r->lobe == lobe && r->verb == verb && r->device == device && r->size == size)
			return r;
	}
	return NULL;
}
