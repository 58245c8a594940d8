/* units.c - the units of a study: which are kept, which are to be run, and the table of all of them. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <glob.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../machine.h"
#include "../timing.h"
#include "lobe/lobe.h"
#include "pool.h"
#include "csv.h"
#include "folders.h"
#include "units.h"

/* --- what rows follow from ---------------------------------------------------------------------------------------- */

/* FNV-1a: it has to tell versions of one text apart, not to withstand an enemy. */
static uint64_t hash(uint64_t h, const char *text)
{
	for (; *text; text++)
		h = (h ^ (unsigned char)*text) * 0x100000001b3u;
	return (h ^ 0xffu) * 0x100000001b3u;
}

/* Files of the folder that the report runs in. How many. */
static size_t hash_files(uint64_t *hashed, const char *pattern)
{
	uint64_t h = *hashed;
	glob_t files;
	if (glob(pattern, 0, NULL, &files) != 0)
		return 0;
	for (size_t i = 0; i < files.gl_pathc; i++) {
		report_rows text = {NULL, 0, 0};
		if (report_rows_read(&text, files.gl_pathv[i]) && text.text)
			h = hash(h, text.text);
		report_rows_free(&text);
	}
	const size_t count = files.gl_pathc;
	globfree(&files);
	*hashed = h;
	return count;
}

/* The section's own source, and what sections share that is not in the OpenCL source: cases and references of the
 * tests, random numbers, lights, and the library's host part. */
static uint64_t hash_sources(uint64_t h, const char *section)
{
	static const char *const shared[] = {
		"tests/cases*.[ch]",      "tests/textbook.[ch]",         "tests/double*.[ch]", "tests/quadrature.[ch]",
		"examples/common/*.[ch]", "examples/gallery/light.[ch]", "src/*.[ch]"};
	char pattern[256];
	snprintf(pattern, sizeof pattern, "bench/report/%s*.[ch]", section);
	if (hash_files(&h, pattern) == 0) {
		fprintf(stderr, "report: no %s: run it from the folder of the Makefile\n", pattern);
		exit(1);
	}
	for (size_t i = 0; i < sizeof shared / sizeof *shared; i++)
		hash_files(&h, shared[i]);
	return h;
}

static uint64_t key_of(const report_section *section, const report_study *study, int quick)
{
	char text[1024];
	uint64_t h = hash_sources(hash(0xcbf29ce484222325u, lobe_opencl_source()), section->name);
	h = hash(h, study->columns);
	h = hash(h, quick ? "quick" : "full");
	if (study->settings)
		h = hash(h, study->settings(quick));
	if (study->timed) {
		bench_processor_name(text, sizeof text);
		h = hash(h, text);
	}
	return h;
}

/* --- running ------------------------------------------------------------------------------------------------------ */

typedef struct {
	const report_study *study;
	lobe_pool *pool;
	int quick;
	uint64_t key;
	const size_t *missing; /* units */
	size_t count, done;    /* of missing; done is counted by whichever thread ends one */
	int failed;
	double start, said;
	int terminal;
} run;

static void unit_path(const report_study *study, uint64_t key, size_t unit, char *path, size_t size)
{
	snprintf(path, size, REPORT_FOLDER "/data/%s/%016llx_%zu.csv", study->name, (unsigned long long)key, unit);
}

/* On a terminal a line that changes; elsewhere one every ten seconds. */
static void say(run *r, size_t done)
{
	const double now = bench_now();
	const int last = done == r->count;
	if (!last && now - r->said < (r->terminal ? 0.2 : 10.0))
		return;
	r->said = now;
	fprintf(stderr, "%s  %-28s %5zu of %zu units, %.0f s%s", r->terminal ? "\r" : "", r->study->name, done,
		r->count, now - r->start, !r->terminal || last ? "\n" : "");
}

static void run_unit(void *context, size_t chunk, size_t thread)
{
	run *r = context;
	char path[512];
	report_rows rows = {NULL, 0, 0};
	if (__atomic_load_n(&r->failed, __ATOMIC_RELAXED))
		return;
	if (r->study->run(r->quick, r->missing[chunk], &rows) == 0) {
		unit_path(r->study, r->key, r->missing[chunk], path, sizeof path);
		report_rows_write(&rows, path);
	} else {
		fprintf(stderr, "report: unit %zu of %s failed\n", r->missing[chunk], r->study->name);
		__atomic_store_n(&r->failed, 1, __ATOMIC_RELAXED);
	}
	report_rows_free(&rows);
	const size_t done = __atomic_add_fetch(&r->done, 1, __ATOMIC_RELAXED);
	if (thread == 0 || done == r->count)
		say(r, done);
}

static void run_missing(run *r, size_t threads)
{
	r->start = r->said = bench_now();
	r->terminal = isatty(STDERR_FILENO);
	r->pool = lobe_pool_create(r->study->timed ? 1 : threads);
	if (!r->pool) {
		fputs("report: no memory or threads\n", stderr);
		exit(1);
	}
	fprintf(stderr, "  %-28s %zu units to run%s\n", r->study->name, r->count,
		r->study->timed ? ", timed, one by one" : "");
	lobe_pool_run(r->pool, run_unit, r, r->count);
	lobe_pool_destroy(r->pool);
	if (r->failed)
		exit(1);
}

/* --- a study ------------------------------------------------------------------------------------------------------ */

static void fail(const char *path)
{
	fprintf(stderr, "report: %s: %s\n", path, strerror(errno));
	exit(1);
}

report_table *report_study_run(const report_section *section, const report_study *study, int quick, size_t threads)
{
	const size_t units = study->units(quick);
	size_t *missing = report_alloc(NULL, units * sizeof *missing);
	run r = {.study = study, .quick = quick, .key = key_of(section, study, quick), .missing = missing};
	report_rows all = {NULL, 0, 0};
	char path[512];
	snprintf(path, sizeof path, REPORT_FOLDER "/data/%s", study->name);
	if (make_folders(path) != 0)
		fail(path);
	for (size_t i = 0; i < units; i++) {
		unit_path(study, r.key, i, path, sizeof path);
		if (access(path, R_OK) != 0)
			missing[r.count++] = i;
	}
	if (r.count)
		run_missing(&r, threads);
	free(missing);
	report_row(&all, "%s", study->columns);
	const size_t header = all.length;
	for (size_t i = 0; i < units; i++) {
		unit_path(study, r.key, i, path, sizeof path);
		if (!report_rows_read(&all, path))
			fail(path);
	}
	snprintf(path, sizeof path, REPORT_FOLDER "/%s.csv", study->name);
	report_rows_write(&all, path);
	report_table *table = report_table_make(study->name, study->columns, all.text + header);
	report_rows_free(&all);
	return table;
}
