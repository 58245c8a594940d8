/* scaling.c - one lobe in batches of every size, on every number of threads. */
#include "scaling.h"

#include <stdio.h>
#include <string.h>

#include "../examples/common/processors.h"
#include "machine.h"
#include "race.h"

enum { TEAMS_MAX = 12 };

typedef struct {
	char label[32];
	lobe_device *device;
	lobe_scene *scene;
} team;

static int open_team(team *t, const char *label, int lobe)
{
	snprintf(t->label, sizeof t->label, "%s", label);
	if (lobe_device_open(&t->device, label) != LOBE_OK)
		return 0;
	if (bench_scene_create(&t->scene, t->device, lobe) == LOBE_OK)
		return 1;
	lobe_device_close(t->device);
	return 0;
}

/* native:1, 2, 4, ... and all processors; then OpenCL. */
static int open_teams(team *teams, int lobe)
{
	const size_t all = processor_count();
	int count = 0;
	for (size_t threads = 1; count < TEAMS_MAX - 2; threads = 2 * threads < all ? 2 * threads : all) {
		char label[32];
		snprintf(label, sizeof label, "native:%zu", threads);
		count += open_team(&teams[count], label, lobe);
		if (threads == all)
			break;
	}
	return count + open_team(&teams[count], "opencl", lobe);
}

static int row(FILE *csv, const team *teams, int count, const bench_arrays *a, int lobe, int verb, size_t n,
	       size_t runs)
{
	bench_shading shading[TEAMS_MAX];
	bench_racer racer[TEAMS_MAX];
	for (int i = 0; i < count; i++) {
		shading[i] = (bench_shading){teams[i].scene, verb, bench_batch(a, verb, n)};
		racer[i] = bench_shading_racer(&shading[i], 0);
	}
	if (!bench_race(racer, count, runs))
		return 0;
	printf("%-9s %9zu", bench_verb_name(verb), n);
	for (int i = 0; i < count; i++) {
		printf(" %9.1f %5.2f", racer[i].rate.median, racer[i].ratio.median);
		fprintf(csv, "%s,%s,%s,%zu,%zu,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", bench_lobe_name(lobe),
			bench_verb_name(verb), teams[i].label, n, runs, racer[i].rate.median, racer[i].rate.low,
			racer[i].rate.high, racer[i].ratio.median, racer[i].ratio.low, racer[i].ratio.high);
	}
	printf("\n");
	return 1;
}

int bench_scaling(int lobe, size_t runs, size_t most, const char *path)
{
	team teams[TEAMS_MAX];
	bench_arrays a;
	FILE *csv = bench_create_file(path);
	const int count = csv ? open_teams(teams, lobe) : 0;
	int ok = csv && count > 0 && bench_arrays_create(&a, most);
	if (csv && !ok)
		fprintf(stderr, "throughput: out of memory or devices for %zu elements\n", most);
	if (ok) {
		printf("\nScaling: %s, batches of 1 to %zu elements; M/s, and times the first device in the same "
		       "rounds.\n\n",
		       bench_lobe_name(lobe), most);
		printf("%-9s %9s", "verb", "elements");
		for (int i = 0; i < count; i++)
			printf(" %9s %5s", teams[i].label, "x");
		printf("\n");
		fputs("lobe,verb,device,elements,runs,median_melements_per_s,low,high,ratio,ratio_low,ratio_high\n",
		      csv);
	}
	static const int verbs[] = {BENCH_EVAL_PDF, BENCH_SAMPLE};
	for (size_t v = 0; ok && v < sizeof verbs / sizeof *verbs; v++)
		/* By fours, and by twos where threads begin to pay. */
		for (size_t n = 1; ok && n <= most; n *= n >= 1024 && n < 262144 ? 2 : 4)
			ok = row(csv, teams, count, &a, lobe, verbs[v], n, runs);
	if (csv && count > 0) {
		for (int i = 0; i < count; i++) {
			lobe_scene_destroy(teams[i].scene);
			lobe_device_close(teams[i].device);
		}
	}
	if (ok)
		bench_arrays_destroy(&a);
	return csv && fclose(csv) == 0 && ok;
}
