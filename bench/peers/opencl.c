/* opencl.c - the library's batches on every OpenCL device that there is, in turn: opencl.sh brings PoCL and Intel's runtime
 * for processors together. Devices that promise no correctly rounded division, which the library refuses, are made to
 * claim it: here speed is compared (tests/long_opencl_others.sh compares bits). */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/inputs.h"
#include "bench/machine.h"
#include "bench/race.h"
#include "cl_faults.h"

enum { DEVICES_MAX = 8, RUNS = 11 };

static const int lobes[] = {BENCH_LOBE_LAMBERT, BENCH_LOBE_GGX_CONDUCTOR, BENCH_LOBE_GGX_DIELECTRIC,
			    BENCH_LOBE_BECKMANN_CONDUCTOR, BENCH_LOBE_GGX_SCHLICK};
static const int verbs[] = {BENCH_EVAL_PDF, BENCH_SAMPLE};

typedef struct {
	lobe_device *device[DEVICES_MAX];
	int count;
} fleet;

static void open_devices(fleet *f)
{
	size_t count = 0;
	f->count = 0;
	if (lobe_device_count("opencl", &count) != LOBE_OK)
		return;
	for (size_t i = 0; i < count && f->count < DEVICES_MAX; i++) {
		char name[32];
		snprintf(name, sizeof name, "opencl:%zu", i);
		if (lobe_device_open(&f->device[f->count], name) != LOBE_OK) {
			printf("%s: skipped: %s\n", name, lobe_error_message());
			continue;
		}
		printf("device %d   %s\n", f->count, lobe_device_name(f->device[f->count]));
		f->count++;
	}
}

/* A row: rates of every device, and the first one's over each other's. */
static int race_row(FILE *csv, const fleet *f, const bench_arrays *a, int lobe, int verb, size_t n)
{
	bench_shading shading[DEVICES_MAX];
	bench_racer racer[DEVICES_MAX];
	int ok = 1, made = 0;
	for (; ok && made < f->count; made += ok) {
		ok = bench_scene_create(&shading[made].scene, f->device[made], lobe) == LOBE_OK;
		shading[made].verb = verb;
		shading[made].batch = bench_batch(a, verb, n);
		racer[made] = bench_shading_racer(&shading[made], 0);
	}
	if (!ok)
		fprintf(stderr, "opencl: %s\n", lobe_error_message());
	ok = ok && bench_race(racer, f->count, RUNS);
	if (ok) {
		printf("%-20s %-9s %9zu", bench_lobe_name(lobe), bench_verb_name(verb), n);
		for (int i = 0; i < f->count; i++) {
			printf(" %9.1f", racer[i].rate.median);
			fprintf(csv, "%s,%s,%zu,%d,%.4f,%.4f\n", bench_lobe_name(lobe), bench_verb_name(verb), n, i,
				racer[i].rate.median, 1.0 / racer[i].ratio.median);
		}
		for (int i = 1; i < f->count; i++)
			printf(" %8.2f", 1.0 / racer[i].ratio.median);
		printf("\n");
	}
	for (int i = 0; i < made; i++)
		lobe_scene_destroy(shading[i].scene);
	return ok;
}

static int race(FILE *csv, const fleet *f)
{
	const size_t sizes[] = {1u << 21, 1u << 16};
	bench_arrays a;
	if (!bench_arrays_create(&a, sizes[0])) {
		fprintf(stderr, "opencl: out of memory\n");
		return 0;
	}
	printf("\nMillion elements per second, medians of %d runs in turn; then device 0 over each other (median of the "
	       "rounds).\n\n%-20s %-9s %9s",
	       (int)RUNS, "lobe", "verb", "elements");
	for (int i = 0; i < f->count; i++)
		printf(" %8s%d", "device ", i);
	for (int i = 1; i < f->count; i++)
		printf("    0 / %d", i);
	printf("\n");
	fputs("lobe,verb,elements,device,rate,device_0_over_it\n", csv);
	int ok = 1;
	for (size_t s = 0; s < 2; s++)
		for (size_t l = 0; l < sizeof lobes / sizeof *lobes; l++)
			for (size_t v = 0; ok && v < sizeof verbs / sizeof *verbs; v++)
				ok = race_row(csv, f, &a, lobes[l], verbs[v], sizes[s]);
	bench_arrays_destroy(&a);
	return ok;
}

int main(void)
{
	fleet f;
	setenv("LOBE_CACHE_DIR", "", 1);
	setenv("POCL_AFFINITY", "1", 1);
	bench_print_machine(stdout);
	if (!cl_faults_install()) {
		printf("no OpenCL device\n");
		return 0;
	}
	cl_faults.claims = CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT | CL_FP_DENORM | CL_FP_ROUND_TO_NEAREST | CL_FP_INF_NAN;
	open_devices(&f);
	FILE *const csv = bench_create_file("out/bench/opencl.csv");
	const int ok = csv && f.count > 0 && race(csv, &f);
	for (int i = 0; i < f.count; i++)
		lobe_device_close(f.device[i]);
	return csv && fclose(csv) == 0 && ok ? 0 : 1;
}
