/* units.h - runs what is missing of a study and gathers its rows. */
#ifndef LOBE_BENCH_REPORT_UNITS_H
#define LOBE_BENCH_REPORT_UNITS_H

#include "report.h"

/* Where everything of the report is written. */
#define REPORT_FOLDER "out/report"

/* Runs the units whose rows are not kept yet, on so many threads (one where the study is timed), with progress on
 * stderr, and writes out/report/<name>.csv. Ends the program, after a message, when a unit fails or a file cannot be
 * written; what was done until then is kept. */
report_table *report_study_run(const report_section *section, const report_study *study, int quick, size_t threads);

#endif
