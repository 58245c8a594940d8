/* options.h - the command line of build/bench/throughput. */
#ifndef LOBE_BENCH_OPTIONS_H
#define LOBE_BENCH_OPTIONS_H

#include <stddef.h>

/* Elements of a batch, at most 56 bytes each. By default 117 MB of them, so that memory is measured and not caches, and
 * no more, as all verbs of all lobes take minutes on each device. In the cache they fit into the second-level caches of
 * two cores. */
enum { BENCH_ELEMENTS = 1 << 21, BENCH_IN_CACHE = 16384, BENCH_QUICK = 1 << 18 };

typedef struct {
	int lobe, verb;     /* -1: all */
	const char *device; /* NULL: all */
	size_t n;           /* 0: the default, and the size in the cache as well */
	size_t runs;
	const char *csv;
	const char *json;                                                /* NULL: none */
	int throughput, build, pruning, scaling, layout, hand, roofline; /* the tables */
	char native[32];                                                 /* device, where --threads gave it */
	int quick;
} bench_options;

/* 0: go on. 1: --help has been printed. 2: something was wrong, and stderr says what. */
int bench_options_parse(bench_options *o, int argc, char **argv);

#endif
