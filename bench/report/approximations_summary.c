/* approximations_summary.c - the rows of one way put together, and what is compared by them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "approximations_summary.h"

const char *const approximations_loops_measured[3] = {"vector", "scalar", "opencl"};

double approximations_time_of(const report_table *times, const char *group, const char *name, const char *loop)
{
	for (size_t i = 0; i < report_table_rows(times); i++)
		if (strcmp(report_cell(times, i, "group"), group) == 0 &&
		    strcmp(report_cell(times, i, "name"), name) == 0 &&
		    strcmp(report_cell(times, i, "loop"), loop) == 0)
			return report_number(times, i, "ns");
	return (double)NAN;
}

approximations_summary approximations_summarise(const report_table *errors, const report_table *times,
						const char *group, const char *name, const char *of)
{
	approximations_summary s = {.group = group, .name = name, .max_case = "", .albedo_case = ""};
	double sum2 = 0.0;
	s.albedo = s.albedo_reference = (double)NAN;
	for (size_t i = 0; i < report_table_rows(errors); i++) {
		if (strcmp(report_cell(errors, i, "group"), group) != 0 ||
		    strcmp(report_cell(errors, i, "name"), name) != 0 ||
		    (of && strcmp(report_cell(errors, i, "case"), of) != 0))
			continue;
		const double max = report_number(errors, i, "max"), rms = report_number(errors, i, "rms");
		s.cases++;
		sum2 += rms * rms;
		s.reference = fmax(s.reference, report_number(errors, i, "reference"));
		if (max >= s.max) {
			s.max = max;
			s.max_case = report_cell(errors, i, "case");
		}
		if (!report_cell(errors, i, "albedo")[0])
			continue;
		const double albedo = report_number(errors, i, "albedo");
		s.albedo_reference = fmax(s.albedo_reference, report_number(errors, i, "albedo_reference"));
		if (!(albedo <= s.albedo)) {
			s.albedo = albedo;
			s.albedo_case = report_cell(errors, i, "case");
		}
	}
	s.rms = s.cases ? sqrt(sum2 / s.cases) : (double)NAN;
	for (int k = 0; k < 3; k++)
		s.ns[k] = approximations_time_of(times, group, name, approximations_loops_measured[k]);
	return s;
}

int approximations_gather(const report_table *errors, const report_table *times, const char *group, const char *of,
			  approximations_summary all[APPROXIMATIONS_WAYS_MAX])
{
	int n = 0;
	for (size_t i = 0; i < report_table_rows(errors); i++) {
		const char *name = report_cell(errors, i, "name");
		int known = 0;
		if (strcmp(report_cell(errors, i, "group"), group) != 0)
			continue;
		for (int k = 0; k < n; k++)
			known |= strcmp(all[k].name, name) == 0;
		if (known || n == APPROXIMATIONS_WAYS_MAX)
			continue;
		all[n] = approximations_summarise(errors, times, group, name, of);
		n += all[n].cases > 0;
	}
	return n;
}

const approximations_summary *approximations_find(const approximations_summary *all, int n, const char *name)
{
	for (int i = 0; i < n; i++)
		if (strcmp(all[i].name, name) == 0)
			return &all[i];
	fprintf(stderr, "report: no rows of %s\n", name);
	exit(1);
}

/* Time that is compared: of the loop as a renderer would run it, vectorised where it can be. */
static double best_ns(const approximations_summary *s) { return fmin(s->ns[0], s->ns[1]); }

void approximations_mark_front(approximations_summary *all, int n)
{
	for (int i = 0; i < n; i++) {
		all[i].front = 1;
		for (int k = 0; k < n; k++)
			if (best_ns(&all[k]) <= best_ns(&all[i]) && all[k].rms <= all[i].rms &&
			    (best_ns(&all[k]) < best_ns(&all[i]) || all[k].rms < all[i].rms))
				all[i].front = 0;
	}
}

static void cell(report_page *page, double x, const char *format)
{
	if (isnan(x))
		report_text(page, " - |");
	else
		report_text(page, format, x);
}

/* An error that is not ten times its reference's: what it is below. */
static void error_cell(report_page *page, double x, double reference)
{
	if (x < 10.0 * reference)
		report_text(page, " < %.1g |", x + reference);
	else
		cell(page, x, " %.2g |");
}

void approximations_table(report_page *page, const approximations_summary *all, int n, const char *unit)
{
	report_text(page,
		    "| | max error%s | at worst in | RMS | largest error of albedo | of | reference good to | ns, "
		    "vectorised "
		    "| ns, one by one | ns, OpenCL |\n|---|---|---|---|---|---|---|---|---|---|\n",
		    unit);
	for (int i = 0; i < n; i++) {
		const approximations_summary *s = &all[i];
		report_text(page, "| %s%s%s |", s->front ? "**" : "", s->name, s->front ? "**" : "");
		error_cell(page, s->max, s->reference);
		report_text(page, " %s |", s->max_case);
		error_cell(page, s->rms, s->reference);
		error_cell(page, s->albedo, s->albedo_reference);
		report_text(page, " %s |", s->albedo_case);
		report_text(page, isnan(s->albedo_reference) ? " %.0e |" : " %.0e; albedo %.0e |", s->reference,
			    s->albedo_reference);
		for (int k = 0; k < 3; k++)
			cell(page, s->ns[k], " %.2f |");
		report_text(page, "\n");
	}
	report_text(page, "\nBold: on the front, nothing is both faster and nearer.\n\n");
}

void approximations_write_points(const char *group, const approximations_summary *all, int n)
{
	char file[96];
	snprintf(file, sizeof file, "approximations_pareto_%s.csv", group);
	FILE *to = report_open(file);
	/* In order of time, so that a line through the front's points is the front. */
	int order[APPROXIMATIONS_WAYS_MAX];
	for (int i = 0; i < n; i++) {
		int k = i;
		for (; k > 0 && best_ns(&all[order[k - 1]]) > best_ns(&all[i]); k--)
			order[k] = order[k - 1];
		order[k] = i;
	}
	fprintf(to, "name,ns,rms,front\n");
	for (int i = 0; i < n; i++) {
		const approximations_summary *s = &all[order[i]];
		fprintf(to, "%s,%.4g,%.4g,%d\n", s->name, best_ns(s), fmax(s->rms, 1e-9), s->front);
	}
	if (fclose(to) != 0)
		exit(1);
}
