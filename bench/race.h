/* race.h - things that are timed against each other: in rounds, each round one timed run of every one, so that other
 * programs on the machine hit all of them alike. What is compared is the median over the rounds of the ratio within a
 * round. */
#ifndef LOBE_BENCH_RACE_H
#define LOBE_BENCH_RACE_H

#include "inputs.h"
#include "timing.h"

typedef struct {
	int (*run)(const void *context); /* once; 0 after a failure, which lobe_error_message() tells */
	const void *context;
	double elements; /* of one run */
	int base;        /* whom it is compared with */

	bench_stats rate;  /* million elements per second */
	bench_stats ratio; /* rate over the base's */
	size_t calls;      /* runs in a timed one: as many as the clock needs */
} bench_racer;

/* Times them all. 0 after a failure, which it reports. */
int bench_race(bench_racer *racer, int count, size_t runs);

/* A batch of a scene as a racer. */
typedef struct {
	lobe_scene *scene;
	int verb;
	lobe_batch batch;
} bench_shading;

bench_racer bench_shading_racer(const bench_shading *shading, int base);

#endif
