/* layout.h - what it costs that elements of several lobes are mixed, or that they lie in structs. */
#ifndef LOBE_BENCH_LAYOUT_H
#define LOBE_BENCH_LAYOUT_H

#include "mixed.h"

/* Prints the tables, by device, and writes them to path: mixed batches (mixed.h); a batch in structs against packed
 * arrays. 0 after a failure. */
int bench_layout(const bench_device *devices, int count, size_t n, size_t runs, const char *path,
		 bench_mixed_results *mixed);

#endif
