/* build_time.c - the build time of OpenCL programs, measured in fresh processes. */
#define _XOPEN_SOURCE 700
#include "build_time.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inputs.h"
#include "machine.h"
#include "timing.h"

enum { RUNS_MAX = 16 };

/* Seconds, in the order of the child's output. create: lobe_scene_create. launch: the first lobe_scene_sample, of one
 * element: runtimes leave part of the compilation to it. again: both, for a second scene. */
enum { OPEN, CREATE, LAUNCH, AGAIN, TIMES };

/* --- child -------------------------------------------------------------------------------------------------------- */

static int child_failed(void)
{
	fprintf(stderr, "throughput: %s\n", lobe_error_message());
	return 1;
}

int bench_build_child(char **arguments)
{
	/* Those of PoCL, of Mesa and Intel, and of NVIDIA. Before the first call: the runtime reads them once. */
	static const char *const variables[] = {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "CUDA_CACHE_PATH", "cl_cache_dir"};
	const int lobe = atoi(arguments[2]);
	double start = bench_now(), time[TIMES];
	lobe_device *device;
	lobe_scene *scene[2];
	bench_arrays a;
	for (size_t i = 0; i < sizeof variables / sizeof *variables; i++)
		setenv(variables[i], arguments[0], 1);
	if (!bench_arrays_create(&a, 1))
		return 1;
	const lobe_batch batch = bench_batch(&a, BENCH_SAMPLE, 1);
	if (lobe_device_open(&device, arguments[1]) != LOBE_OK)
		return child_failed();
	time[OPEN] = bench_now() - start;
	for (int i = 0; i < 2; i++) {
		start = bench_now();
		if (bench_scene_create(&scene[i], device, lobe) != LOBE_OK)
			return child_failed();
		const double create = bench_now() - start;
		if (lobe_scene_sample(scene[i], &batch) != LOBE_OK)
			return child_failed();
		const double both = bench_now() - start;
		if (i == 0) {
			time[CREATE] = create;
			time[LAUNCH] = both - create;
		} else {
			time[AGAIN] = both;
		}
	}
	printf("%.9f %.9f %.9f %.9f\n", time[OPEN], time[CREATE], time[LAUNCH], time[AGAIN]);
	lobe_scene_destroy(scene[0]);
	lobe_scene_destroy(scene[1]);
	lobe_device_close(device);
	bench_arrays_destroy(&a);
	return 0;
}

/* Runs the child and reads its times. Without a shell, so that program and cache may have any name. */
static int run_child(const char *program, const char *cache, const char *device, int lobe, double *time)
{
	char number[16], output[256];
	int ends[2], status = 1;
	size_t length = 0;
	ssize_t got;
	snprintf(number, sizeof number, "%d", lobe);
	fflush(stdout);
	if (pipe(ends) != 0)
		return 0;
	const pid_t child = fork();
	if (child == 0) {
		dup2(ends[1], STDOUT_FILENO);
		close(ends[0]);
		close(ends[1]);
		execlp(program, program, "--build-child", cache, device, number, (char *)NULL);
		_exit(127);
	}
	close(ends[1]);
	while (child > 0 && length < sizeof output - 1 &&
	       (got = read(ends[0], output + length, sizeof output - 1 - length)) > 0)
		length += (size_t)got;
	close(ends[0]);
	output[length] = '\0';
	if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
		return 0;
	return sscanf(output, "%lf %lf %lf %lf", &time[OPEN], &time[CREATE], &time[LAUNCH], &time[AGAIN]) == TIMES;
}

/* --- the cache folder --------------------------------------------------------------------------------------------- */

static double folder_bytes; /* nftw hands its function no argument of ours */

static int add_size(const char *path, const struct stat *s, int type, struct FTW *where)
{
	(void)path;
	(void)where;
	if (type == FTW_F)
		folder_bytes += (double)s->st_size;
	return 0;
}

static int remove_entry(const char *path, const struct stat *s, int type, struct FTW *where)
{
	(void)s;
	(void)type;
	(void)where;
	remove(path);
	return 0;
}

/* --- table -------------------------------------------------------------------------------------------------------- */

typedef struct {
	double cold_create, cold_launch, cached_create, cached_launch, again; /* milliseconds */
	double cache_bytes;
} build_times;

static double median_ms(double *seconds, size_t n) { return 1e3 * bench_stats_of(seconds, n).median; }

static int measure(const char *program, const char *device, int lobe, size_t runs, build_times *out)
{
	double cold[TIMES], cached[TIMES], times[5][RUNS_MAX];
	const char *const base = getenv("TMPDIR");
	char what[128];
	int ok = 1;
	snprintf(what, sizeof what, "building %s on %s", bench_lobe_name(lobe), device);
	for (size_t i = 0; ok && i < runs; i++) {
		char cache[1024];
		snprintf(cache, sizeof cache, "%s/lobe-bench-XXXXXX", base && *base ? base : "/tmp");
		if (!mkdtemp(cache))
			return 0;
		bench_progress(what, i, runs);
		ok = run_child(program, cache, device, lobe, cold);
		folder_bytes = 0.0;
		nftw(cache, add_size, 8, FTW_PHYS);
		out->cache_bytes = folder_bytes;
		ok = ok && run_child(program, cache, device, lobe, cached);
		nftw(cache, remove_entry, 8, FTW_PHYS | FTW_DEPTH);
		times[0][i] = cold[CREATE];
		times[1][i] = cold[LAUNCH];
		times[2][i] = cached[CREATE];
		times[3][i] = cached[LAUNCH];
		times[4][i] = cached[AGAIN];
	}
	bench_progress(NULL, 0, 0);
	if (!ok)
		return 0;
	out->cold_create = median_ms(times[0], runs);
	out->cold_launch = median_ms(times[1], runs);
	out->cached_create = median_ms(times[2], runs);
	out->cached_launch = median_ms(times[3], runs);
	out->again = median_ms(times[4], runs);
	return 1;
}

/* One scene on one device. */
static int row(const char *program, const bench_device *d, int lobe, size_t runs, FILE *csv)
{
	build_times t;
	lobe_scene *scene;
	if (!measure(program, d->label, lobe, runs, &t) || bench_scene_create(&scene, d->device, lobe) != LOBE_OK) {
		fprintf(stderr, "throughput: building %s on %s failed\n", bench_lobe_name(lobe), d->label);
		return 0;
	}
	printf("%-18s %-10s %5zu %11.1f %11.1f %11.1f %11.1f %9.3f %9.1f\n", bench_lobe_name(lobe), d->label, runs,
	       t.cold_create, t.cold_launch, t.cached_create, t.cached_launch, t.again, t.cache_bytes / 1024.0);
	fprintf(csv, "%s,%s,%zu,%.3f,%.3f,%.3f,%.3f,%.4f,%.0f,%zu,%s\n", bench_lobe_name(lobe), d->label, runs,
		t.cold_create, t.cold_launch, t.cached_create, t.cached_launch, t.again, t.cache_bytes,
		strlen(lobe_opencl_source()), lobe_opencl_options(scene));
	lobe_scene_destroy(scene);
	return 1;
}

int bench_build_times(const char *program, const bench_device *devices, int count, int lobe, size_t runs,
		      double seconds, const char *path)
{
	const double start = bench_now();
	FILE *csv = bench_create_file(path);
	int ok = csv != NULL, rows = 0;
	if (!ok)
		return 0;
	printf("\nOpenCL programs: build time by scene, medians. cold: nothing in the runtime's cache. cached: in a\n"
	       "new process. again: a second scene of the same lobes in that process, with its launch. The source is\n"
	       "the same %zu bytes for every scene; options leave lobes out.\n\n",
	       strlen(lobe_opencl_source()));
	printf("%-18s %-10s %5s %11s %11s %11s %11s %9s %9s\n", "scene", "device", "runs", "cold", "cold", "cached",
	       "cached", "again", "in cache");
	printf("%-18s %-10s %5s %11s %11s %11s %11s %9s %9s\n", "", "", "", "create ms", "launch ms", "create ms",
	       "launch ms", "ms", "KiB");
	fputs("scene,device,runs,cold_create_ms,cold_launch_ms,cached_create_ms,cached_launch_ms,again_ms,"
	      "cache_bytes,source_bytes,options\n",
	      csv);
	for (int d = 0; d < count; d++)
		for (int i = 0; ok && i <= BENCH_LOBES; i++)
			if (bench_is_opencl(&devices[d]) && (lobe < 0 || lobe == i)) {
				const size_t all = runs < RUNS_MAX ? runs : RUNS_MAX;
				ok = row(program, &devices[d], i, bench_now() - start < seconds ? all : 1, csv);
				rows += ok;
			}
	if (ok && rows == 0)
		puts("(no OpenCL device)");
	return fclose(csv) == 0 && ok;
}
