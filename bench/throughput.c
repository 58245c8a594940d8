/* throughput.c - the benchmark of speed and size: prints tables, which it writes as CSV, and what they say of the
 * project's targets.
 *
 *	throughput.csv  every lobe by verb and device: elements per second, against a plain copy (measure.h)
 *	roofline.csv    the operations and bytes of every loop, and how near it comes to the processor's ceilings (roofline.h)
 *	hand.csv        ggx_conductor against loops by hand, and against scalar C with libm (hand.h)
 *	layout.csv      mixed lobes and arrays of structs (layout.h)
 *	scaling.csv     from 1 element to 16M, from one thread to all (scaling.h)
 *	build_time.csv  the build time of OpenCL programs (build_time.h)
 *	pruning.csv     what leaving things out saves (pruning.h)
 *
 * Exit status: 0, 1 after a failure, 2 for a bad option. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "build_time.h"
#include "hand.h"
#include "json.h"
#include "layout.h"
#include "machine.h"
#include "measure.h"
#include "options.h"
#include "pruning.h"
#include "roofline.h"
#include "scaling.h"
#include "targets.h"

/* --- the table of throughput -------------------------------------------------------------------------------------- */

static void print_row(const bench_plan *plan, const bench_results *results, const bench_result *r)
{
	const bench_result *small = plan->size_count > 1 ? bench_find(results, r->lobe, r->verb, r->device, 1) : NULL;
	printf("%-18s %-9s %-10s %9zu %5zu %9.1f %8.1f %9.2f %6zu %8.1f", bench_lobe_name(r->lobe),
	       bench_verb_name(r->verb), plan->devices[r->device].label, r->n, plan->runs, r->rate.median,
	       bench_error(&r->rate), 1e3 / r->rate.median, r->bytes, r->copy_share);
	if (r->native_ratio > 0.0)
		printf(" %9.2f", r->native_ratio);
	else
		printf(" %9s", "-");
	if (small)
		printf(" %9.1f", small->rate.median);
	printf("\n");
}

static void write_row(FILE *csv, const bench_plan *plan, const bench_result *r)
{
	fprintf(csv, "%s,%s,%s,%zu,%zu,%zu,%.3f,%.2f,%.3f,%.3f,%.4f,%zu,%.3f,%.3f,%.2f,", bench_lobe_name(r->lobe),
		bench_verb_name(r->verb), plan->devices[r->device].label, plan->devices[r->device].threads, r->n,
		plan->runs, r->rate.median, bench_spread(&r->rate), r->rate.min, r->rate.max, 1e3 / r->rate.median,
		r->bytes, 1e-3 * r->rate.median * (double)r->bytes, r->copy_rate.median, r->copy_share);
	if (r->native_ratio > 0.0)
		fprintf(csv, "%.4f", r->native_ratio);
	else
		fprintf(csv, "-");
	fprintf(csv, ",%.3f,%.3f\n", r->rate.low, r->rate.high);
}

static int report(const bench_plan *plan, const bench_results *results, const char *path)
{
	FILE *csv = bench_create_file(path);
	if (!csv)
		return 0;
	printf("\nThroughput: medians; +- half their 95 %% interval. bytes: what the verb reads and writes for\n"
	       "an element. of copy: against memcpy of as many bytes, half read and half written, on as many threads,\n"
	       "run in turn with it. of native: against the native device with all threads, in the same rounds.");
	if (plan->size_count > 1)
		printf("\nin cache: batches of %zu elements instead.", plan->sizes[1]);
	printf("\n\n%-18s %-9s %-10s %9s %5s %9s %8s %9s %6s %8s %9s%s\n", "lobe", "verb", "device", "elements", "runs",
	       "median", "+-", "time", "bytes", "of copy", "of native", plan->size_count > 1 ? "  in cache" : "");
	printf("%-18s %-9s %-10s %9s %5s %9s %8s %9s %6s %8s %9s%s\n", "", "", "", "", "", "M/s", "%", "ns", "", "%",
	       "x", plan->size_count > 1 ? "       M/s" : "");
	fputs("lobe,verb,device,threads,elements,runs,median_melements_per_s,iqr_percent,min_melements_per_s,"
	      "max_melements_per_s,ns_per_element,bytes_per_element,gbytes_per_s,copy_melements_per_s,"
	      "copy_share_percent,native_ratio,low_melements_per_s,high_melements_per_s\n",
	      csv);
	for (size_t i = 0; i < results->count; i++) {
		const bench_result *r = &results->result[i];
		if (r->size == 0)
			print_row(plan, results, r);
		write_row(csv, plan, r);
	}
	return fclose(csv) == 0;
}

/* --- main --------------------------------------------------------------------------------------------------------- */

/* path with what follows its last '/' replaced by name. Allocated; NULL when out of memory. */
static char *beside(const char *path, const char *name)
{
	const char *slash = strrchr(path, '/');
	const size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
	char *const joined = malloc(folder + strlen(name) + 1);
	if (joined) {
		memcpy(joined, path, folder);
		strcpy(joined + folder, name);
	}
	return joined;
}

static bench_plan make_plan(const bench_options *o, bench_device *devices, int count)
{
	bench_plan plan;
	memset(&plan, 0, sizeof plan);
	plan.lobe = o->lobe;
	plan.verb = o->verb;
	plan.sizes[plan.size_count++] = o->n ? o->n : BENCH_ELEMENTS;
	if (!o->n || o->quick)
		plan.sizes[plan.size_count++] = BENCH_IN_CACHE;
	if (plan.sizes[0] == BENCH_IN_CACHE)
		plan.size_count = 1;
	plan.least = o->n ? o->n : (size_t)1 << 20; /* 40 MB and more for the larger verbs: still far from the caches */
	plan.runs = o->runs;
	plan.devices = devices;
	plan.device_count = count;
	return plan;
}

/* The largest batch of the scaling: 16M elements, where memory has room for their arrays. */
static size_t scaling_most(const bench_options *o)
{
	size_t most = o->n ? o->n : (size_t)1 << 24;
	while (!o->n && most > 1024 && (double)most * 4 * 17 > 0.5 * bench_memory())
		most /= 4;
	return most;
}

int main(int argc, char **argv)
{
	bench_options o;
	bench_device devices[BENCH_DEVICES_MAX];
	bench_results results = {NULL, 0};
	bench_mixed_results mixed = {.count = 0};
	bench_build_highest build = {{0}, {0}, {0}};
	int ok = 1;
	if (argc == 6 && strcmp(argv[1], "--build-child") == 0)
		return bench_build_child(argv + 2);
	const int status = bench_options_parse(&o, argc, argv);
	if (status != 0)
		return status == 2 ? 2 : 0;
	FILE *const json = o.json ? bench_open_json(o.json) : NULL;
	if (o.json && !json)
		return 1;
	bench_print_machine(stdout);
	const int count = bench_devices_open(devices, o.device);
	if (count == 0 && o.device)
		return 2;
	/* The library lies in build/, this program in build/bench/. */
	char *const library = beside(argv[0], "..");
	char *const objects = beside(argv[0], "../obj");
	char *const build_csv = beside(o.csv, "build_time.csv"), *const pruning_csv = beside(o.csv, "pruning.csv");
	char *const scaling_csv = beside(o.csv, "scaling.csv"), *const layout_csv = beside(o.csv, "layout.csv");
	char *const hand_csv = beside(o.csv, "hand.csv"), *const roofline_csv = beside(o.csv, "roofline.csv");
	const bench_plan plan = make_plan(&o, devices, count);
	ok = library && objects && build_csv && pruning_csv && scaling_csv && layout_csv && hand_csv && roofline_csv;
	/* Tables of native loops alone have no place where another device was asked for. */
	const int native = !o.device || strncmp(o.device, "native", 6) == 0;
	if (count > 0 && (o.throughput || o.pruning))
		ok = ok && bench_measure(&plan, &results);
	if (o.throughput)
		ok = ok && report(&plan, &results, o.csv);
	if (json)
		ok = bench_write_json(&plan, &results, json) && ok;
	if (o.roofline && native)
		ok = ok && bench_roofline(o.lobe, plan.sizes[0], o.runs, objects, roofline_csv);
	if (o.hand && native && (o.lobe < 0 || o.lobe == BENCH_LOBE_GGX_CONDUCTOR))
		ok = ok && bench_hand(plan.sizes[0], o.runs, hand_csv);
	if (o.layout && o.lobe < 0)
		ok = ok && bench_layout(devices, count, plan.sizes[0], o.runs, layout_csv, &mixed);
	if (o.scaling && native)
		ok = ok && bench_scaling(o.lobe < 0 ? BENCH_LOBE_GGX_CONDUCTOR : o.lobe, o.runs, scaling_most(&o),
					 scaling_csv);
	if (o.build)
		ok = ok && bench_build_times(argv[0], devices, count, o.lobe, o.quick ? 1 : 3, 25.0, build_csv, &build);
	if (o.pruning)
		ok = ok && bench_pruning(&plan, &results, library, pruning_csv);
	if (ok)
		bench_print_targets(&plan, &results, &mixed, &build);
	free(library);
	free(objects);
	free(build_csv);
	free(pruning_csv);
	free(scaling_csv);
	free(layout_csv);
	free(hand_csv);
	free(roofline_csv);
	free(results.result);
	bench_devices_close(devices, count);
	return ok ? 0 : 1;
}
