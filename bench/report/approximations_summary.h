/* approximations_summary.h - what the section's rows say of one way to compute something: its errors over all cases,
 * its times, and whether it is on the front of the two. */
#ifndef LOBE_BENCH_APPROXIMATIONS_SUMMARY_H
#define LOBE_BENCH_APPROXIMATIONS_SUMMARY_H

#include "report.h"

enum { APPROXIMATIONS_WAYS_MAX = 48 };

/* Over all cases, or one. rms: root of the mean of the cases' squares. Times [ns] of a call: NaN where
 * there is none. */
typedef struct {
	const char *group, *name;
	double max, rms, albedo, reference, albedo_reference, ns[3];
	const char *max_case, *albedo_case;
	int cases, front;
} approximations_summary;

/* The order of ns: "vector", "scalar", "opencl". */
extern const char *const approximations_loops_measured[3];

/* [ns] a call in such a loop; NaN where there is none. */
double approximations_time_of(const report_table *times, const char *group, const char *name, const char *loop);

/* Of one way; of: in that case alone (NULL: in all). */
approximations_summary approximations_summarise(const report_table *errors, const report_table *times,
						const char *group, const char *name, const char *of);

/* All ways of a group that have rows, of: in that case alone (NULL: in all). Their number. */
int approximations_gather(const report_table *errors, const report_table *times, const char *group, const char *of,
			  approximations_summary all[APPROXIMATIONS_WAYS_MAX]);

/* The one of that name; ends the program where there is none. */
const approximations_summary *approximations_find(const approximations_summary *all, int n, const char *name);

/* On the front: nothing is both faster and nearer. */
void approximations_mark_front(approximations_summary *all, int n);

/* The Markdown table. */
void approximations_table(report_page *page, const approximations_summary *all, int n, const char *unit);

/* name, time, error, whether on the front: what approximations.gp draws. */
void approximations_write_points(const char *group, const approximations_summary *all, int n);

#endif
