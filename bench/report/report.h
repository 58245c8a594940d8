/* report.h - what a study of `make report` is made of: units of work whose rows are kept, and a section of the page.
 *
 * A study measures in units that do not depend on each other or on the order in which they run: each appends rows to a
 * CSV, and draws its random numbers from counters, so that the rows are the same whatever the number of threads. A
 * unit's rows are kept in out/report/data/<study>/ under a key of all that they follow from - the library's source,
 * that of the section (bench/report/<section>*) and what sections share (units.c), the settings, and for timings the
 * machine - so that a run does only what is not there yet, and an interrupted one goes on where it stopped. When all
 * units are there the rows become out/report/<study>.csv, and the section is written from them alone.
 *
 *	build/bench/report [--quick] [--threads N] [--only SECTION]	the page is out/report/report.md
 *
 * A new section: bench/report/<section>*.c with its `report_section`, a line in sections.c, and
 * bench/report/<plot>.gp. */
#ifndef LOBE_BENCH_REPORT_H
#define LOBE_BENCH_REPORT_H

#include <stddef.h>

#if defined(__GNUC__)
#define REPORT_PRINTF(at, first) __attribute__((format(printf, at, first)))
#else
#define REPORT_PRINTF(at, first)
#endif

/* --- studies ------------------------------------------------------------------------------------------------------ */

/* Where a unit's rows go: a line without its end a call. */
typedef struct report_rows report_rows;
void report_row(report_rows *rows, const char *format, ...) REPORT_PRINTF(2, 3);

typedef struct {
	const char *name;    /* of its files */
	const char *columns; /* the CSV's first line; no cell has a comma */
	int timed;           /* measures time: its units run one after another on a machine that is otherwise idle */
	/* quick: the report in minutes instead of an hour. Fewer samples and cases, the same questions. */
	size_t (*units)(int quick);
	/* Appends the rows of unit 0 .. units(quick) - 1. Called from several threads at once, unless timed. Not 0:
	 * failed, after a message on stderr. */
	int (*run)(int quick, size_t unit, report_rows *rows);
	/* NULL, or what rows follow from besides: files that the user names, say. */
	const char *(*settings)(int quick);
} report_study;

/* --- rows read back ----------------------------------------------------------------------------------------------- */

typedef struct report_table report_table;
size_t report_table_rows(const report_table *table);
/* By the column's name; ends the program when there is no such column. */
const char *report_cell(const report_table *table, size_t row, const char *column);
double report_number(const report_table *table, size_t row, const char *column);

/* --- the page ----------------------------------------------------------------------------------------------------- */

typedef struct report_page report_page;

/* A line of the summary, at the page's top: what a reader would act on, with its figure. Its numbers come from the
 * rows. */
void report_finding(report_page *page, const char *format, ...) REPORT_PRINTF(2, 3);

/* Markdown in the section. */
void report_text(report_page *page, const char *format, ...) REPORT_PRINTF(2, 3);

/* out/report/<file> with a caption, and the command that makes it. */
void report_figure(report_page *page, const char *file, const char *format, ...) REPORT_PRINTF(3, 4);

/* Markdown for README.md, where `make readme` puts it. A picture of out/report is doc/<file> there. */
void report_readme(report_page *page, const char *format, ...) REPORT_PRINTF(2, 3);

/* Runs gnuplot on bench/report/<script> in the folder out/report, where the studies' CSVs and what the section wrote
 * with report_open lie. definitions: NULL, or gnuplot assignments "a=1; b='x'". Ends the program when gnuplot fails;
 * where there is none, says so once and goes on: the figures are then missing. */
void report_gnuplot(report_page *page, const char *script, const char *definitions);

/* A file in out/report to write (FILE *); ends the program with a message when it cannot be made. */
void *report_open(const char *file);

/* --- sections ----------------------------------------------------------------------------------------------------- */

enum { REPORT_STUDIES_MAX = 8 };

typedef struct {
	const char *name, *title, *question; /* question: what its findings answer, a heading of the summary */
	const report_study *studies[REPORT_STUDIES_MAX]; /* ended by NULL */
	/* tables: of the studies, in their order. */
	void (*write)(report_page *page, const report_table *const *tables, int quick);
} report_section;

/* In the order of the page; ended by NULL. */
extern const report_section *const report_sections[];

#endif
