/* timing.c - the clock, quartiles, and the plain copy. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "pool.h"
#include "timing.h"

double bench_now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* --- statistics --------------------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static double quantile(const double *sorted, size_t n, double q)
{
	const double at = q * (double)(n - 1);
	const size_t low = (size_t)at;
	const size_t high = low + 1 < n ? low + 1 : low;
	return sorted[low] + (at - (double)low) * (sorted[high] - sorted[low]);
}

/* How many of n sorted values lie beyond each end of the interval: the median is beyond values[r] when no more than r
 * of n fair coins fall on that side. n at most 1000, where 2^-n is still a number. */
static size_t outside(size_t n)
{
	double term = 1.0;
	size_t r = 0;
	for (size_t i = 0; i < n; i++)
		term *= 0.5;
	for (double sum = term; sum <= 0.025 && r < n / 2; sum += term) {
		r++;
		term *= (double)(n - r + 1) / (double)r;
	}
	return r ? r - 1 : 0;
}

bench_stats bench_stats_of(double *values, size_t n)
{
	bench_stats s;
	qsort(values, n, sizeof *values, ascending);
	s.min = values[0];
	s.quarter1 = quantile(values, n, 0.25);
	s.median = quantile(values, n, 0.5);
	s.quarter3 = quantile(values, n, 0.75);
	s.max = values[n - 1];
	s.low = values[outside(n)];
	s.high = values[n - 1 - outside(n)];
	return s;
}

double bench_spread(const bench_stats *s) { return 100.0 * (s->quarter3 - s->quarter1) / s->median; }

double bench_error(const bench_stats *s) { return 50.0 * (s->high - s->low) / s->median; }

/* --- copy --------------------------------------------------------------------------------------------------------- */

/* The library's own pool of threads, so that a copy pays what a native batch pays to wake them. */
struct bench_copy {
	lobe_pool *pool;
	size_t threads;
	unsigned char *from, *to;
	size_t half; /* bytes of the running copy */
};

bench_copy *bench_copy_create(size_t threads, size_t bytes)
{
	bench_copy *copy = calloc(1, sizeof *copy);
	if (!copy)
		return NULL;
	copy->threads = threads;
	copy->pool = lobe_pool_create(threads);
	copy->from = malloc(bytes / 2 + 1);
	copy->to = malloc(bytes / 2 + 1);
	if (!copy->pool || !copy->from || !copy->to) {
		bench_copy_destroy(copy);
		return NULL;
	}
	/* Written once, so that every page is there; and not with 0, which a system may share between pages. */
	memset(copy->from, 0x55, bytes / 2 + 1);
	memset(copy->to, 0xaa, bytes / 2 + 1);
	return copy;
}

void bench_copy_destroy(bench_copy *copy)
{
	if (!copy)
		return;
	lobe_pool_destroy(copy->pool);
	free(copy->from);
	free(copy->to);
	free(copy);
}

static void copy_part(void *context, size_t part, size_t thread)
{
	const bench_copy *copy = context;
	const size_t begin = copy->half / copy->threads * part;
	const size_t end = part + 1 == copy->threads ? copy->half : begin + copy->half / copy->threads;
	(void)thread;
	memcpy(copy->to + begin, copy->from + begin, end - begin);
}

double bench_copy_run(bench_copy *copy, size_t bytes, size_t calls)
{
	const double start = bench_now();
	copy->half = bytes / 2;
	for (size_t i = 0; i < calls; i++)
		lobe_pool_run(copy->pool, copy_part, copy, copy->threads);
	return bench_now() - start;
}
