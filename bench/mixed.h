/* mixed.h - what it costs that the elements of a batch are of several lobes. */
#ifndef LOBE_BENCH_MIXED_H
#define LOBE_BENCH_MIXED_H

#include <stdio.h>

#include "scenes.h"

/* Of five lobes with a material each, on one native thread. In percent. */
typedef struct {
	int verb;
	size_t n;
	double share;   /* of the weighted mean of its lobes alone */
	double sorting; /* of the time of that mean: finding places and moving */
} bench_mixed_result;

typedef struct {
	bench_mixed_result result[8];
	size_t count;
} bench_mixed_results;

/* Prints a row for each scene, verb and size, and writes them to csv. n: elements of the larger batches; the smaller
 * stay in the caches. 0 after a failure, which it reports. */
int bench_mixed(FILE *csv, const bench_device *devices, int count, size_t n, size_t runs, bench_mixed_results *out);

#endif
