/* json.h - the table of throughput for other programs. */
#ifndef LOBE_BENCH_JSON_H
#define LOBE_BENCH_JSON_H

#include <stdio.h>

#include "measure.h"

/* A file for it, before anything is measured. "-": the standard output, and all that would be printed there goes to the
 * standard error from now on. NULL after a failure, which it reports. */
FILE *bench_open_json(const char *path);

/* Writes {"results": [...]}, an object for each row, and closes the file. 0 after a failure. */
int bench_write_json(const bench_plan *plan, const bench_results *results, FILE *out);

#endif
