/* csv.h - text that grows, and tables read from it. */
#ifndef LOBE_BENCH_REPORT_CSV_H
#define LOBE_BENCH_REPORT_CSV_H

#include <stdarg.h>

#include "report.h"

/* text: always ended by 0 once anything was added, else NULL. */
struct report_rows {
	char *text;
	size_t length, room;
};

/* Ends the program, with a message, where there is no memory. */
void *report_alloc(void *old, size_t size);

void report_rows_print(report_rows *rows, const char *format, va_list arguments);
void report_rows_add(report_rows *rows, const char *format, ...) REPORT_PRINTF(2, 3);
void report_rows_free(report_rows *rows);

/* Appends the whole file. 0: it cannot be read. */
int report_rows_read(report_rows *rows, const char *path);

/* Writes the text to path as a whole or not at all: to a name beside it, then renamed. Ends the program on failure. */
void report_rows_write(const report_rows *rows, const char *path);

/* columns: the first line. Takes its own copy of both; lives until the program's end. */
report_table *report_table_make(const char *name, const char *columns, const char *text);

#endif
