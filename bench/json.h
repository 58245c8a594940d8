/* json.h - the table of throughput for other programs. */
#ifndef LOBE_BENCH_JSON_H
#define LOBE_BENCH_JSON_H

#include "measure.h"

/* Writes {"results": [...]}, an object for each row, to path; "-": to the standard output. 0 after a failure. */
int bench_write_json(const bench_plan *plan, const bench_results *results, const char *path);

#endif
