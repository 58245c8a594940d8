/* race.c - timed rounds. */
#include "race.h"

#include <stdio.h>
#include <stdlib.h>

/* A timed run takes at least so long: far more than the clock's resolution and a thread's waking. */
#define SHORTEST_RUN 1e-3

static double time_runs(const bench_racer *r, size_t calls)
{
	const double start = bench_now();
	for (size_t i = 0; i < calls; i++)
		if (!r->run(r->context))
			return -1.0;
	return bench_now() - start;
}

/* Warms up and finds how many calls make a run. */
static int prepare(bench_racer *r)
{
	double seconds = time_runs(r, 1);
	r->calls = 1;
	while (seconds >= 0.0 && (seconds = time_runs(r, r->calls)) < SHORTEST_RUN && seconds >= 0.0)
		r->calls *= 2;
	return seconds >= 0.0;
}

static int fail(const char *what)
{
	fprintf(stderr, "throughput: %s\n", what);
	return 0;
}

int bench_race(bench_racer *racer, int count, size_t runs)
{
	double *const rates = malloc((size_t)count * runs * sizeof *rates);
	double *const ratio = malloc(runs * sizeof *ratio);
	int ok = rates && ratio;
	if (!ok)
		fail("out of memory");
	for (int i = 0; ok && i < count; i++)
		ok = prepare(&racer[i]) || fail(lobe_error_message());
	for (size_t run = 0; ok && run < runs; run++)
		for (int i = 0; ok && i < count; i++) {
			const double seconds = time_runs(&racer[i], racer[i].calls);
			ok = seconds >= 0.0 || fail(lobe_error_message());
			rates[(size_t)i * runs + run] = racer[i].elements * (double)racer[i].calls * 1e-6 / seconds;
		}
	/* Ratios first: the statistics sort the rates, and so lose the rounds. */
	for (int i = 0; ok && i < count; i++) {
		for (size_t run = 0; run < runs; run++)
			ratio[run] = rates[(size_t)i * runs + run] / rates[(size_t)racer[i].base * runs + run];
		racer[i].ratio = bench_stats_of(ratio, runs);
	}
	for (int i = 0; ok && i < count; i++)
		racer[i].rate = bench_stats_of(rates + (size_t)i * runs, runs);
	free(rates);
	free(ratio);
	return ok;
}

static int shade(const void *context)
{
	const bench_shading *s = context;
	return bench_run(s->scene, s->verb, &s->batch) == LOBE_OK;
}

bench_racer bench_shading_racer(const bench_shading *shading, int base)
{
	return (bench_racer){.run = shade, .context = shading, .elements = (double)shading->batch.count, .base = base};
}
