/* targets.c - shares of the copy on one thread, and the lowest ratio of OpenCL to native. */
#include "targets.h"

#include <stdio.h>
#include <string.h>

/* On native:1; least in percent of the copy. */
static const struct {
	const char *lobe;
	int verb;
	double least;
} shares[] = {{"ggx_conductor", BENCH_SAMPLE, 35.0},
	      {"ggx_conductor", BENCH_EVAL_PDF, 60.0},
	      {"lambert", BENCH_EVAL_PDF, 80.0},
	      {"lambert", BENCH_SAMPLE, 80.0}};

static const double least_ratio = 0.85;

/* The first line is preceded by the table's head. */
static void put(int *lines, const bench_plan *plan, const bench_result *r, const char *what, double value,
		double target, const char *unit)
{
	char measured[32], least[32];
	const int digits = *unit == '%' ? 1 : 2;
	if ((*lines)++ == 0) {
		printf("\nTargets. lowest of native: of all OpenCL rows in the table of throughput.\n\n");
		printf("%-18s %-9s %-10s %-17s %9s %9s\n", "lobe", "verb", "device", "what", "measured", "at least");
	}
	snprintf(measured, sizeof measured, "%.*f %s", digits, value, unit);
	snprintf(least, sizeof least, "%.*f %s", digits, target, unit);
	printf("%-18s %-9s %-10s %-17s %9s %9s  %s\n", bench_lobe_name(r->lobe), bench_verb_name(r->verb),
	       plan->devices[r->device].label, what, measured, least, value >= target ? "met" : "missed");
}

/* The row of that lobe and verb on native:1, or NULL. */
static const bench_result *find_row(const bench_plan *plan, const bench_results *results, const char *lobe, int verb)
{
	for (size_t i = 0; i < results->count; i++) {
		const bench_result *r = &results->result[i];
		if (r->size == 0 && r->verb == verb && strcmp(bench_lobe_name(r->lobe), lobe) == 0 &&
		    strcmp(plan->devices[r->device].label, "native:1") == 0)
			return r;
	}
	return NULL;
}

void bench_print_targets(const bench_plan *plan, const bench_results *results)
{
	const bench_result *lowest = NULL;
	int lines = 0;
	for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
		const bench_result *r = find_row(plan, results, shares[i].lobe, shares[i].verb);
		if (r)
			put(&lines, plan, r, "of copy", r->copy_share, shares[i].least, "%");
	}
	for (size_t i = 0; i < results->count; i++) {
		const bench_result *r = &results->result[i];
		if (r->size == 0 && r->native_ratio > 0.0 && (!lowest || r->native_ratio < lowest->native_ratio))
			lowest = r;
	}
	if (lowest)
		put(&lines, plan, lowest, "lowest of native", lowest->native_ratio, least_ratio, "x");
}
