/* scaling.h - throughput by the size of a batch, from 1 element to 16M, and by threads. */
#ifndef LOBE_BENCH_SCALING_H
#define LOBE_BENCH_SCALING_H

#include <stddef.h>

/* Prints the tables of one lobe, eval+pdf and sample, on native:1, native:2, ... to the processors there are, and the
 * first OpenCL device, and writes them to path. 0 after a failure. */
int bench_scaling(int lobe, size_t runs, size_t most, const char *path);

#endif
