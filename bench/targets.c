/* targets.c - shares of the copy, OpenCL against native, mixed batches, and the build time of OpenCL
 * programs. */
#include "targets.h"

#include <stdio.h>
#include <string.h>

/* Least shares of the copy on as many threads, in percent. What lambert computes is next to nothing. */
static const struct {
	const char *lobe;
	int verb;
	const char *device;
	double least;
} shares[] = {{"lambert", BENCH_EVAL, "native:1", 90.0},      {"lambert", BENCH_PDF, "native:1", 90.0},
	      {"lambert", BENCH_EVAL_PDF, "native:1", 90.0},  {"lambert", BENCH_SAMPLE, "native:1", 90.0},
	      {"lambert", BENCH_SAMPLE_WI, "native:1", 90.0}, {"ggx_conductor", BENCH_EVAL_PDF, "native", 85.0},
	      {"ggx_conductor", BENCH_SAMPLE, "native", 60.0}};

static const double least_ratio = 0.95;                 /* OpenCL to native, as many threads */
static const double most_share = 40.0, most_ms = 100.0; /* of programs */

static const double least_mixed = 60.0, most_sorting = 15.0; /* of five lobes mixed, in percent */

typedef struct {
	const char *lobe, *verb, *device, *what;
	double value;
	int at_least; /* else at most */
	double target;
	const char *unit;
} line;

/* The first line is preceded by the table's head. */
static void put(int *lines, const line *l)
{
	char measured[32], target[32];
	const int digits = *l->unit == 'x' ? 2 : 1;
	if ((*lines)++ == 0) {
		printf("\nTargets. lowest of native: of the lobe's verbs in the table of throughput. The others are "
		       "the\n"
		       "highest of all scenes of one lobe: the cold build, against that of all lobes; and a second\n"
		       "process's build and first launch.\n\n");
		printf("%-21s %-9s %-10s %-17s %9s %12s\n", "lobe", "verb", "device", "what", "measured", "target");
	}
	snprintf(measured, sizeof measured, "%.*f %s", digits, l->value, l->unit);
	snprintf(target, sizeof target, "%s %.*f %s", l->at_least ? ">=" : "<=", digits, l->target, l->unit);
	printf("%-21s %-9s %-10s %-17s %9s %12s  %s\n", l->lobe, l->verb, l->device, l->what, measured, target,
	       (l->at_least ? l->value >= l->target : l->value <= l->target) ? "met" : "missed");
}

/* The row of that lobe and verb on that device, or NULL. */
static const bench_result *find_row(const bench_plan *plan, const bench_results *results, const char *lobe, int verb,
				    const char *device)
{
	for (size_t i = 0; i < results->count; i++) {
		const bench_result *r = &results->result[i];
		if (r->size == 0 && r->verb == verb && strcmp(bench_lobe_name(r->lobe), lobe) == 0 &&
		    strcmp(plan->devices[r->device].label, device) == 0)
			return r;
	}
	return NULL;
}

static void put_row(int *lines, const bench_plan *plan, const bench_result *r, const char *what, double value,
		    double least, const char *unit)
{
	const line l = {.lobe = bench_lobe_name(r->lobe),
			.verb = bench_verb_name(r->verb),
			.device = plan->devices[r->device].label,
			.what = what,
			.value = value,
			.at_least = 1,
			.target = least,
			.unit = unit};
	put(lines, &l);
}

/* For every lobe and OpenCL device, the verb that is lowest. */
static void put_ratios(int *lines, const bench_plan *plan, const bench_results *results)
{
	for (int d = 0; d < plan->device_count; d++)
		for (int lobe = 0; lobe < BENCH_LOBES; lobe++) {
			const bench_result *lowest = NULL;
			for (size_t i = 0; i < results->count; i++) {
				const bench_result *r = &results->result[i];
				if (r->device == d && r->lobe == lobe && r->size == 0 && r->native_ratio > 0.0 &&
				    (!lowest || r->native_ratio < lowest->native_ratio))
					lowest = r;
			}
			if (lowest)
				put_row(lines, plan, lowest, "lowest of native", lowest->native_ratio, least_ratio,
					"x");
		}
}

static void put_mixed(int *lines, const bench_mixed_results *mixed)
{
	for (size_t i = 0; i < mixed->count; i++) {
		const bench_mixed_result *r = &mixed->result[i];
		char lobe[32];
		snprintf(lobe, sizeof lobe, "five, %zu", r->n);
		const char *const verb = bench_verb_name(r->verb);
		const line share = {lobe, verb, "native:1", "of mean", r->share, 1, least_mixed, "%"};
		const line sorting = {lobe, verb, "native:1", "sorting, moving", r->sorting, 0, most_sorting, "%"};
		put(lines, &share);
		put(lines, &sorting);
	}
}

static void put_build(int *lines, const bench_build_figure *f, const char *what, double most, const char *unit)
{
	if (f->device) {
		const line l = {bench_lobe_name(f->lobe), "-", f->device->label, what, f->value, 0, most, unit};
		put(lines, &l);
	}
}

void bench_print_targets(const bench_plan *plan, const bench_results *results, const bench_mixed_results *mixed,
			 const bench_build_highest *build)
{
	int lines = 0;
	for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
		const bench_result *r = find_row(plan, results, shares[i].lobe, shares[i].verb, shares[i].device);
		if (r)
			put_row(&lines, plan, r, "of copy", r->copy_share, shares[i].least, "%");
	}
	put_ratios(&lines, plan, results);
	put_mixed(&lines, mixed);
	put_build(&lines, &build->share, "build, of all", most_share, "%");
	put_build(&lines, &build->cached, "cached", most_ms, "ms");
	put_build(&lines, &build->kept, "kept", most_ms, "ms");
}
