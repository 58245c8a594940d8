/* targets.c - shares of the copy on one thread, the lowest ratio of OpenCL to native, and mixed batches. */
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

/* Of five lobes mixed, in percent. */
static const double least_mixed = 60.0, most_sorting = 15.0;

/* What a line is about. */
typedef struct {
	const char *lobe, *device;
	int verb;
} subject;

static subject subject_of(const bench_plan *plan, const bench_result *r)
{
	return (subject){bench_lobe_name(r->lobe), plan->devices[r->device].label, r->verb};
}

/* The first line is preceded by the table's head. sign: "" where the target is the least, "<" where it is the most. */
static void put(int *lines, subject s, const char *what, double value, double target, const char *unit,
		const char *sign)
{
	char measured[32], limit[32];
	const int digits = *unit == '%' ? 1 : 2, met = *sign ? value <= target : value >= target;
	if ((*lines)++ == 0) {
		printf("\nTargets. lowest of native: of all OpenCL rows in the table of throughput.\n\n");
		printf("%-18s %-9s %-10s %-17s %9s %9s\n", "lobe", "verb", "device", "what", "measured", "at least");
	}
	snprintf(measured, sizeof measured, "%.*f %s", digits, value, unit);
	snprintf(limit, sizeof limit, "%s %.*f %s", sign, digits, target, unit);
	printf("%-18s %-9s %-10s %-17s %9s %9s  %s\n", s.lobe, bench_verb_name(s.verb), s.device, what, measured,
	       limit + !*sign, met ? "met" : "missed");
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

static void put_mixed(int *lines, const bench_mixed_results *mixed)
{
	for (size_t i = 0; i < mixed->count; i++) {
		const bench_mixed_result *r = &mixed->result[i];
		char lobe[32];
		snprintf(lobe, sizeof lobe, "five, %zu", r->n);
		const subject s = {lobe, "native:1", r->verb};
		put(lines, s, "of mean", r->share, least_mixed, "%", "");
		put(lines, s, "sorting, moving", r->sorting, most_sorting, "%", "<");
	}
}

void bench_print_targets(const bench_plan *plan, const bench_results *results, const bench_mixed_results *mixed)
{
	const bench_result *lowest = NULL;
	int lines = 0;
	for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
		const bench_result *r = find_row(plan, results, shares[i].lobe, shares[i].verb);
		if (r)
			put(&lines, subject_of(plan, r), "of copy", r->copy_share, shares[i].least, "%", "");
	}
	for (size_t i = 0; i < results->count; i++) {
		const bench_result *r = &results->result[i];
		if (r->size == 0 && r->native_ratio > 0.0 && (!lowest || r->native_ratio < lowest->native_ratio))
			lowest = r;
	}
	if (lowest)
		put(&lines, subject_of(plan, lowest), "lowest of native", lowest->native_ratio, least_ratio, "x", "");
	put_mixed(&lines, mixed);
}
