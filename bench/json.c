/* json.c - results as JSON. Names are lobe's own and hold nothing that would want escaping, but for the device's. */
#define _POSIX_C_SOURCE 200809L
#include "json.h"

#include <string.h>
#include <unistd.h>

#include "machine.h"

static void put_string(FILE *out, const char *s)
{
	fputc('"', out);
	for (; *s; s++) {
		if (*s == '"' || *s == '\\')
			fputc('\\', out);
		if ((unsigned char)*s >= ' ')
			fputc(*s, out);
	}
	fputc('"', out);
}

static void put_row(FILE *out, const bench_plan *plan, const bench_result *r)
{
	const bench_device *d = &plan->devices[r->device];
	fprintf(out,
		"{\"lobe\": \"%s\", \"verb\": \"%s\", \"device\": \"%s\", \"device_name\": ", bench_lobe_name(r->lobe),
		bench_verb_name(r->verb), d->label);
	put_string(out, lobe_device_name(d->device));
	fprintf(out,
		", \"threads\": %zu, \"elements\": %zu, \"runs\": %zu, \"melements_per_s\": {\"median\": %.4f, "
		"\"low95\": %.4f, "
		"\"high95\": %.4f, \"min\": %.4f, \"max\": %.4f}, \"bytes_per_element\": %zu, "
		"\"copy_melements_per_s\": %.4f, "
		"\"copy_share_percent\": %.3f, \"native_ratio\": ",
		d->threads, r->n, plan->runs, r->rate.median, r->rate.low, r->rate.high, r->rate.min, r->rate.max,
		r->bytes, r->copy_rate.median, r->copy_share);
	if (r->native_ratio > 0.0)
		fprintf(out, "%.4f}", r->native_ratio);
	else
		fprintf(out, "null}");
}

FILE *bench_open_json(const char *path)
{
	if (strcmp(path, "-") != 0)
		return bench_create_file(path);
	fflush(stdout);
	const int own = dup(STDOUT_FILENO);
	FILE *const out = own >= 0 && dup2(STDERR_FILENO, STDOUT_FILENO) >= 0 ? fdopen(own, "w") : NULL;
	if (!out)
		perror("throughput: standard output");
	return out;
}

int bench_write_json(const bench_plan *plan, const bench_results *results, FILE *out)
{
	fprintf(out, "{\"results\": [");
	for (size_t i = 0; i < results->count; i++) {
		fprintf(out, i ? ",\n\t" : "\n\t");
		put_row(out, plan, &results->result[i]);
	}
	fprintf(out, "\n]}\n");
	return fclose(out) == 0;
}
