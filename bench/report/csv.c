/* csv.c - rows while they are made, and the table that they become. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "csv.h"

void *report_alloc(void *old, size_t size)
{
	void *p = realloc(old, size ? size : 1);
	if (p)
		return p;
	fputs("report: out of memory\n", stderr);
	exit(1);
}

/* --- text --------------------------------------------------------------------------------------------------------- */

void report_rows_print(report_rows *rows, const char *format, va_list arguments)
{
	va_list again;
	va_copy(again, arguments);
	const int n = vsnprintf(NULL, 0, format, arguments);
	if (n < 0) {
		fputs("report: a row cannot be printed\n", stderr);
		exit(1);
	}
	if (rows->length + (size_t)n + 1 > rows->room) {
		rows->room = 2 * (rows->length + (size_t)n + 1);
		rows->text = report_alloc(rows->text, rows->room);
	}
	vsnprintf(rows->text + rows->length, (size_t)n + 1, format, again);
	va_end(again);
	rows->length += (size_t)n;
}

void report_rows_add(report_rows *rows, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	report_rows_print(rows, format, arguments);
	va_end(arguments);
}

void report_row(report_rows *rows, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	report_rows_print(rows, format, arguments);
	va_end(arguments);
	report_rows_add(rows, "\n");
}

void report_rows_free(report_rows *rows)
{
	free(rows->text);
	memset(rows, 0, sizeof *rows);
}

int report_rows_read(report_rows *rows, const char *path)
{
	char part[4096];
	size_t n;
	FILE *file = fopen(path, "rb");
	if (!file)
		return 0;
	while ((n = fread(part, 1, sizeof part, file)) > 0)
		report_rows_add(rows, "%.*s", (int)n, part);
	const int ok = !ferror(file);
	fclose(file);
	return ok;
}

void report_rows_write(const report_rows *rows, const char *path)
{
	char beside[1024];
	snprintf(beside, sizeof beside, "%s.part", path);
	FILE *file = fopen(beside, "wb");
	int ok = file != NULL;
	if (file) {
		ok = fwrite(rows->text ? rows->text : "", 1, rows->length, file) == rows->length;
		ok = fclose(file) == 0 && ok;
	}
	if (ok && rename(beside, path) == 0)
		return;
	fprintf(stderr, "report: %s: %s\n", path, strerror(errno));
	exit(1);
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

struct report_table {
	const char *name;
	char *header, *text; /* commas and line ends made 0 */
	const char **columns, **cells;
	size_t column_count, row_count;
};

size_t report_table_rows(const report_table *table) { return table->row_count; }

/* The number of cells of a line, after it was cut into them; cells: NULL to count alone. */
static size_t cut(char *line, const char **cells)
{
	size_t n = 0;
	for (char *at = line; at; n++) {
		if (cells)
			cells[n] = at;
		at = strchr(at, ',');
		if (at && cells)
			*at = '\0';
		at = at ? at + 1 : NULL;
	}
	return n;
}

static char *copy_text(const char *text)
{
	const size_t size = strlen(text) + 1;
	return memcpy(report_alloc(NULL, size), text, size);
}

report_table *report_table_make(const char *name, const char *columns, const char *text)
{
	report_table *t = report_alloc(NULL, sizeof *t);
	size_t lines = 0;
	t->name = name;
	t->header = copy_text(columns);
	t->text = copy_text(text ? text : "");
	t->column_count = cut(t->header, NULL);
	t->columns = report_alloc(NULL, t->column_count * sizeof *t->columns);
	cut(t->header, t->columns);
	for (const char *at = t->text; (at = strchr(at, '\n')) != NULL; at++)
		lines++;
	t->cells = report_alloc(NULL, lines * t->column_count * sizeof *t->cells);
	t->row_count = 0;
	for (char *line = t->text, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
		*end = '\0';
		if (cut(line, NULL) != t->column_count) {
			fprintf(stderr, "report: %s: a row has not the cells of \"%s\": %s\n", name, columns, line);
			exit(1);
		}
		cut(line, t->cells + t->row_count++ * t->column_count);
	}
	return t;
}

const char *report_cell(const report_table *t, size_t row, const char *column)
{
	for (size_t i = 0; i < t->column_count; i++)
		if (strcmp(t->columns[i], column) == 0 && row < t->row_count)
			return t->cells[row * t->column_count + i];
	fprintf(stderr, "report: %s has no row %zu with a column %s\n", t->name, row, column);
	exit(1);
}

double report_number(const report_table *t, size_t row, const char *column)
{
	return strtod(report_cell(t, row, column), NULL);
}
