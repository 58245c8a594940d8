/* main.c - the report: runs what is missing of every study, and writes the page.
 *
 *	report [--quick] [--threads N] [--only SECTION]
 *
 * --only leaves the page at that section alone. Interrupted, it goes on from there the next time. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../timing.h"
#include "page.h"
#include "processors.h"
#include "units.h"

static int usage(void)
{
	fputs("usage: report [--quick] [--threads N] [--only SECTION]\nsections:", stderr);
	for (size_t i = 0; report_sections[i]; i++)
		fprintf(stderr, " %s", report_sections[i]->name);
	fputs("\n", stderr);
	return 2;
}

static int is_section(const char *name)
{
	for (size_t i = 0; report_sections[i]; i++)
		if (strcmp(name, report_sections[i]->name) == 0)
			return 1;
	return 0;
}

int main(int argc, char **argv)
{
	const char *only = NULL;
	size_t threads = processor_count();
	int quick = 0;
	const double start = bench_now();
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--quick") == 0)
			quick = 1;
		else if (strcmp(argv[i], "--threads") == 0 && i + 1 < argc && atoi(argv[i + 1]) > 0)
			threads = (size_t)atoi(argv[++i]);
		else if (strcmp(argv[i], "--only") == 0 && i + 1 < argc && is_section(argv[i + 1]))
			only = argv[++i];
		else
			return usage();
	}
	report_page page = {.command = quick ? "build/bench/report --quick" : "build/bench/report"};
	for (size_t i = 0; report_sections[i]; i++) {
		const report_section *section = report_sections[i];
		const report_table *tables[REPORT_STUDIES_MAX] = {NULL};
		if (only && strcmp(only, section->name) != 0)
			continue;
		fprintf(stderr, "%s\n", section->title);
		for (int k = 0; k < REPORT_STUDIES_MAX && section->studies[k]; k++)
			tables[k] = report_study_run(section, section->studies[k], quick, threads);
		report_page_section(&page, section);
		section->write(&page, tables, quick);
	}
	report_page_write(&page, quick, only == NULL);
	report_rows_free(&page.findings);
	report_rows_free(&page.text);
	report_rows_free(&page.readme);
	printf("out/report/report.md, %.0f s\n", bench_now() - start);
	return 0;
}
