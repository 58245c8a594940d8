/* page.h - the page while it is written. */
#ifndef LOBE_BENCH_REPORT_PAGE_H
#define LOBE_BENCH_REPORT_PAGE_H

#include "csv.h"

struct report_page {
	const char *section;                /* the one being written */
	const char *command;                /* "build/bench/report" and its options */
	report_rows findings, text, readme; /* of all sections until now */
	int gnuplot_missing;                /* it was said */
};

/* Heading of a section, and what makes its figures. */
void report_page_section(report_page *page, const report_section *section);

/* out/report/report.md: head, findings, sections; and README's part, where all sections are there. */
void report_page_write(const report_page *page, int quick, int whole);

#endif
