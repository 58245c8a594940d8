/* targets.h - how a run stands against the project's targets of speed. */
#ifndef LOBE_BENCH_TARGETS_H
#define LOBE_BENCH_TARGETS_H

#include "build_time.h"
#include "measure.h"
#include "mixed.h"

/* Prints a line for every target whose rows were measured, from the batches of the plan's first size, and of both sizes
 * of mixed batches: what was measured, the target, and whether it was met. Prints nothing when there are none. */
void bench_print_targets(const bench_plan *plan, const bench_results *results, const bench_mixed_results *mixed,
			 const bench_build_highest *build);

#endif
