/* measure.h - the throughput of every lobe, verb, device and batch size, against a plain copy.
 *
 * All verbs and devices of a lobe are timed in rounds: each round times every one of them once and, right after it, a
 * plain copy of as many bytes on as many threads, so that other programs on the machine hit all of them alike. The
 * share of the copy is the median over the rounds of the ratio within a round. It can pass 100 %: a verb that mostly
 * reads moves its bytes for less than a copy, half of whose bytes are written. An OpenCL device is compared in the same
 * way with the native one that has all threads. */
#ifndef LOBE_BENCH_MEASURE_H
#define LOBE_BENCH_MEASURE_H

#include "inputs.h"
#include "timing.h"

enum { BENCH_SIZES_MAX = 2 };

/* What to measure. lobe, verb: -1 for all of them. sizes[0] is the size of the table, sizes[1] the one in the cache. */
typedef struct {
	int lobe, verb;
	size_t sizes[BENCH_SIZES_MAX];
	int size_count;
	size_t least; /* elements to which a batch that lasts too long may be cut */
	size_t runs;
	bench_device *devices;
	int device_count;
} bench_plan;

typedef struct {
	int lobe, verb, device; /* device: in the plan's */
	int size;               /* in the plan's sizes */
	size_t n;               /* elements of a batch: that size, or less where a run would last too long */
	size_t calls;           /* batches in a timed run: as many as the clock needs */
	size_t bytes;           /* per element, see bench_bytes */
	bench_stats rate;       /* million elements per second */
	bench_stats copy_rate;  /* the same of the copy */
	double copy_share;      /* rate over copy_rate, in percent */
	double native_ratio;    /* of an OpenCL device: rate over the native one's with all threads; 0: not measured */
} bench_result;

typedef struct {
	bench_result *result;
	size_t count;
} bench_results;

/* Measures the plan; the caller frees results->result. Progress on stderr. 0 after a failure, which it reports. */
int bench_measure(const bench_plan *plan, bench_results *results);

/* The result of that lobe, verb, device and place in the plan's sizes, or NULL. */
const bench_result *bench_find(const bench_results *results, int lobe, int verb, int device, int size);

#endif
