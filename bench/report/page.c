/* page.c - the report's Markdown. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../machine.h"
#include "lobe/lobe.h"
#include "page.h"
#include "processors.h"
#include "units.h"

void report_finding(report_page *page, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	report_rows_add(&page->findings, "- ");
	report_rows_print(&page->findings, format, arguments);
	report_rows_add(&page->findings, "\n");
	va_end(arguments);
}

void report_text(report_page *page, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	report_rows_print(&page->text, format, arguments);
	va_end(arguments);
}

void report_figure(report_page *page, const char *file, const char *format, ...)
{
	va_list arguments;
	report_rows_add(&page->text, "\n![](%s)\n\n", file);
	va_start(arguments, format);
	report_rows_print(&page->text, format, arguments);
	va_end(arguments);
	report_rows_add(&page->text, " <sub>(`%s --only %s`)</sub>\n\n", page->command, page->section);
}

void report_readme(report_page *page, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	report_rows_print(&page->readme, format, arguments);
	va_end(arguments);
}

void *report_open(const char *file)
{
	char path[512];
	snprintf(path, sizeof path, REPORT_FOLDER "/%s", file);
	FILE *f = bench_create_file(path);
	if (!f)
		exit(1);
	return f;
}

void report_gnuplot(report_page *page, const char *script, const char *definitions)
{
	char command[2048];
	if (system("command -v gnuplot >/dev/null 2>&1") != 0) {
		if (!page->gnuplot_missing)
			fputs("report: no gnuplot here: the plots are left out\n", stderr);
		page->gnuplot_missing = 1;
		return;
	}
	/* The scripts are beside this file; the folder of the CSVs is where they run. */
	snprintf(command, sizeof command, "cd " REPORT_FOLDER " && gnuplot -e \"%s\" ../../bench/report/%s",
		 definitions ? definitions : "", script);
	if (system(command) != 0) {
		fprintf(stderr, "report: gnuplot failed: %s\n", command);
		exit(1);
	}
}

void report_page_section(report_page *page, const report_section *section)
{
	page->section = section->name;
	report_rows_add(&page->findings, "\n### [%s](#%s)\n\n", section->question, section->name);
	report_rows_add(&page->text, "\n<a id=\"%s\"></a>\n\n## %s\n\n", section->name, section->title);
	report_rows_add(&page->text, "Raw data:");
	for (int i = 0; i < REPORT_STUDIES_MAX && section->studies[i]; i++)
		report_rows_add(&page->text, "%s [%s.csv](%s.csv)", i ? "," : "", section->studies[i]->name,
				section->studies[i]->name);
	report_rows_add(&page->text, "; all of it by `%s --only %s`.\n\n", page->command, section->name);
}

/* The devices that the section's timings are of. */
static void print_devices(FILE *to)
{
	size_t opencl = 0;
	lobe_device_count("opencl", &opencl);
	for (size_t i = 0; i <= opencl; i++) {
		char label[32] = "native";
		lobe_device *device;
		if (i)
			snprintf(label, sizeof label, "opencl:%zu", i - 1);
		if (lobe_device_open(&device, label) != LOBE_OK) {
			fprintf(to, "%-10s none: %s\n", label, lobe_error_message());
			continue;
		}
		fprintf(to, "%-10s %s\n", label, lobe_device_name(device));
		lobe_device_close(device);
	}
	if (opencl == 0)
		fprintf(to, "opencl     no device\n");
}

static void close_file(FILE *file, const char *name)
{
	if (fclose(file) == 0)
		return;
	fprintf(stderr, "report: " REPORT_FOLDER "/%s: %s\n", name, strerror(errno));
	exit(1);
}

/* What make readme puts into README.md. */
static void write_readme(const report_page *page, int quick)
{
	char commit[64], processor[256];
	FILE *to = report_open("readme.md");
	bench_processor_name(processor, sizeof processor);
	if (!bench_command("git describe --always --dirty --abbrev=12 2>/dev/null", commit, sizeof commit))
		snprintf(commit, sizeof commit, "unknown");
	fprintf(to, "Measured by `make report%s` on %s, %zu processors, at commit %s.\n\n%s", quick ? " QUICK=1" : "",
		processor, processor_count(), commit, page->readme.text ? page->readme.text : "");
	close_file(to, "readme.md");
}

void report_page_write(const report_page *page, int quick, int whole)
{
	FILE *to = report_open("report.md");
	fprintf(to, "# lobe: error against run time, and stability at the extremes\n\n");
	if (quick)
		fprintf(to, "**The quick form**: fewer samples and cases, the same questions; `make report` without "
			    "`QUICK=1` asks them whole.\n\n");
	fprintf(to, "```\n");
	bench_print_machine(to);
	print_devices(to);
	fprintf(to, "```\n\n## Findings\n\nEach figure is computed from the rows of its section. Words: a strategy "
		    "*follows the lobe* if it draws facets or directions by the lobe, as uniform and cosine sampling do not; *told a shape*, "
		    "`lobe_recommend_strategy` knows of the light its `lobe_light_shape` alone, *asking*, it looks the "
		    "light up in some directions; a *comparison lobe* (`microfacet_*`) chooses its parts at run time, "
		    "production lobes have them built in; the *floor* of a result is what half an ulp of its inputs moves "
		    "the exact answer by; *roundings of 1* are 2^-24, however small the reflectance.\n%s",
		page->findings.text ? page->findings.text : "");
	fprintf(to, "%s", page->text.text ? page->text.text : "");
	close_file(to, "report.md");
	if (whole)
		write_readme(page, quick);
}
