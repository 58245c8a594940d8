/* timing.h - the clock, what is said of repeated timings, and the plain copy that everything is compared with. */
#ifndef LOBE_BENCH_TIMING_H
#define LOBE_BENCH_TIMING_H

#include <stddef.h>

/* Seconds of a clock that only goes forwards. */
double bench_now(void);

/* quarter1 and quarter3: below them lie one and three quarters of the values, interpolated linearly. low and high: an
 * interval that holds the true median with 95 % confidence or more, whatever the distribution: the values of those
 * ranks between which it lies unless too many of n fair coins fall on one side. (Fewer than 6 values do not reach 95 %:
 * then it is all of them.) */
typedef struct {
	double min, quarter1, median, quarter3, max;
	double low, high;
} bench_stats;

/* Of values[0..n), n at least 1, which it sorts. */
bench_stats bench_stats_of(double *values, size_t n);

/* The interquartile range in percent of the median, and half the interval of low and high. */
double bench_spread(const bench_stats *s);
double bench_error(const bench_stats *s);

/* A team of threads and two arrays between which it copies. */
typedef struct bench_copy bench_copy;

/* bytes: the most that a copy will move, reads and writes together. NULL: no memory or threads. */
bench_copy *bench_copy_create(size_t threads, size_t bytes);
void bench_copy_destroy(bench_copy *copy);

/* memcpy that moves bytes, half of them read and half written, calls times over; each thread does one contiguous
 * part. The seconds that it took. */
double bench_copy_run(bench_copy *copy, size_t bytes, size_t calls);

#endif
