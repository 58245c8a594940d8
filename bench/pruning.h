/* pruning.h - what leaving things out saves: bytes of code, and the time of outputs that nobody asks for. */
#ifndef LOBE_BENCH_PRUNING_H
#define LOBE_BENCH_PRUNING_H

#include "measure.h"

/* Prints the table and writes it to path. library: the folder of liblobe.a and liblobe.so. Sizes need cc and size(1)
 * and the headers in ./include; a size that cannot be had is skipped with a word. 0: path cannot be written. */
int bench_pruning(const bench_plan *plan, const bench_results *results, const char *library, const char *path);

#endif
