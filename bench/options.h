/* options.h - the command line of build/bench/throughput. */
#ifndef LOBE_BENCH_OPTIONS_H
#define LOBE_BENCH_OPTIONS_H

#include <stddef.h>

typedef struct {
	int lobe, verb;     /* -1: all */
	const char *device; /* NULL: all */
	size_t n;           /* 0: the default, and the size in the cache as well */
	size_t runs;
	const char *csv;
	int throughput, build, pruning; /* the tables */
	int quick;
} bench_options;

/* 0: go on. 1: --help has been printed. 2: something was wrong, and stderr says what. */
int bench_options_parse(bench_options *o, int argc, char **argv);

#endif
