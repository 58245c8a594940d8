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
	const int lobe = atoi(arguments[3]);
	double start = bench_now(), time[TIMES];
	lobe_device *device;
	lobe_scene *scene[2];
	bench_arrays a;
	for (size_t i = 0; i < sizeof variables / sizeof *variables; i++)
		setenv(variables[i], arguments[0], 1);
	setenv("LOBE_CACHE_DIR", strcmp(arguments[1], "-") == 0 ? "" : arguments[1], 1);
	if (!bench_arrays_create(&a, 1))
		return 1;
	const lobe_batch batch = bench_batch(&a, BENCH_SAMPLE, 1);
	if (lobe_device_open(&device, arguments[2]) != LOBE_OK)
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
static int run_child(const char *program, const char *cache, const char *kept, const char *device, int lobe,
		     double *time)
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
		execlp(program, program, "--build-child", cache, kept, device, number, (char *)NULL);
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

/* Starts by what they find: nothing; what the runtime kept of the one before; nothing, and lobe keeps the binary; that
 * binary, and nothing of the runtime's. */
enum { COLD, CACHED, KEEPING, KEPT, STARTS };
static const char *const start_name[STARTS] = {"cold", "cached", "keeping", "kept"};

typedef struct {
	double create[STARTS], launch[STARTS], again; /* milliseconds */
	double cache_bytes, kept_bytes;
} build_times;

static double median_ms(double *seconds, size_t n) { return 1e3 * bench_stats_of(seconds, n).median; }

static double bytes_in(const char *folder)
{
	folder_bytes = 0.0;
	nftw(folder, add_size, 8, FTW_PHYS);
	return folder_bytes;
}

/* A start of each kind, in folders made for them: the runtime's of COLD and CACHED, of KEEPING, of KEPT; lobe's. */
static int one_of_each(const char *program, const char *device, int lobe, double time[STARTS][TIMES], build_times *out)
{
	const char *const base = getenv("TMPDIR");
	char folder[4][1024];
	int made = 0, ok = 1;
	for (; ok && made < 4; made += ok) {
		snprintf(folder[made], sizeof folder[made], "%s/lobe-bench-XXXXXX", base && *base ? base : "/tmp");
		ok = mkdtemp(folder[made]) != NULL;
	}
	for (int i = 0; ok && i < STARTS; i++) {
		ok = run_child(program, folder[i < KEEPING ? 0 : i - 1], i < KEEPING ? "-" : folder[3], device, lobe,
			       time[i]);
		if (i == COLD)
			out->cache_bytes = bytes_in(folder[0]);
	}
	out->kept_bytes = made == 4 ? bytes_in(folder[3]) : 0.0;
	while (made > 0)
		nftw(folder[--made], remove_entry, 8, FTW_PHYS | FTW_DEPTH);
	return ok;
}

static int measure(const char *program, const char *device, int lobe, size_t runs, build_times *out)
{
	double create[STARTS][RUNS_MAX], launch[STARTS][RUNS_MAX], again[RUNS_MAX], time[STARTS][TIMES];
	char what[128];
	int ok = 1;
	snprintf(what, sizeof what, "building %s on %s", bench_lobe_name(lobe), device);
	for (size_t i = 0; ok && i < runs; i++) {
		bench_progress(what, i, runs);
		ok = one_of_each(program, device, lobe, time, out);
		for (int k = 0; ok && k < STARTS; k++) {
			create[k][i] = time[k][CREATE];
			launch[k][i] = time[k][LAUNCH];
		}
		again[i] = ok ? time[CACHED][AGAIN] : 0.0;
	}
	bench_progress(NULL, 0, 0);
	if (!ok)
		return 0;
	for (int k = 0; k < STARTS; k++) {
		out->create[k] = median_ms(create[k], runs);
		out->launch[k] = median_ms(launch[k], runs);
	}
	out->again = median_ms(again, runs);
	return 1;
}

static void take_highest(bench_build_figure *f, const bench_device *d, int lobe, double value)
{
	if (!f->device || value > f->value)
		*f = (bench_build_figure){lobe, d, value};
}

/* coldest: of the device's scenes of one lobe the one that builds longest, in milliseconds. */
static void add_to_highest(bench_build_highest *h, bench_build_figure *coldest, const bench_device *d, int lobe,
			   const build_times *t)
{
	if (lobe < BENCH_LOBES) {
		take_highest(coldest, d, lobe, t->create[COLD]);
		take_highest(&h->cached, d, lobe, t->create[CACHED] + t->launch[CACHED]);
		take_highest(&h->kept, d, lobe, t->create[KEPT] + t->launch[KEPT]);
	} else if (lobe == BENCH_LOBES && coldest->device) {
		take_highest(&h->share, d, coldest->lobe, 100.0 * coldest->value / t->create[COLD]);
	}
}

/* One scene on one device. */
static int row(const char *program, const bench_device *d, int lobe, size_t runs, FILE *csv, build_times *out)
{
	build_times t;
	lobe_scene *scene;
	if (!measure(program, d->label, lobe, runs, &t) || bench_scene_create(&scene, d->device, lobe) != LOBE_OK) {
		fprintf(stderr, "throughput: building %s on %s failed\n", bench_lobe_name(lobe), d->label);
		return 0;
	}
	printf("%-18s %-9s %4zu", bench_lobe_name(lobe), d->label, runs);
	fprintf(csv, "%s,%s,%zu", bench_lobe_name(lobe), d->label, runs);
	for (int k = 0; k < STARTS; k++) {
		printf(" %8.1f %7.1f", t.create[k], t.launch[k]);
		fprintf(csv, ",%.3f,%.3f", t.create[k], t.launch[k]);
	}
	printf(" %7.3f %7.0f\n", t.again, t.kept_bytes / 1024.0);
	fprintf(csv, ",%.4f,%.0f,%.0f,%zu,%s\n", t.again, t.cache_bytes, t.kept_bytes, strlen(lobe_opencl_source()),
		lobe_opencl_options(scene));
	lobe_scene_destroy(scene);
	*out = t;
	return 1;
}

int bench_build_times(const char *program, const bench_device *devices, int count, int lobe, size_t runs,
		      double seconds, const char *path, bench_build_highest *highest)
{
	const double start = bench_now();
	FILE *csv = bench_create_file(path);
	int ok = csv != NULL, rows = 0;
	if (!ok)
		return 0;
	printf("\nOpenCL programs: build time by scene, medians in ms: creating the scene, and the first launch.\n"
	       "cold: nothing kept. cached: a second process finds what the runtime keeps by itself. keeping: cold,\n"
	       "and lobe puts the binary into LOBE_CACHE_DIR. kept: a second process finds that binary and nothing of\n"
	       "the runtime's. again: a second scene of the same lobes in one process, with its launch. The source is\n"
	       "the same %zu bytes for every scene; options leave lobes out.\n\n",
	       strlen(lobe_opencl_source()));
	printf("%-18s %-9s %4s", "scene", "device", "runs");
	for (int k = 0; k < STARTS; k++)
		printf(" %16s", start_name[k]);
	printf(" %7s %7s\n%-18s %-9s %4s", "again", "kept", "", "", "");
	for (int k = 0; k < STARTS; k++)
		printf(" %8s %7s", "create", "launch");
	printf(" %7s %7s\n", "", "KiB");
	fputs("scene,device,runs", csv);
	for (int k = 0; k < STARTS; k++)
		fprintf(csv, ",%s_create_ms,%s_launch_ms", start_name[k], start_name[k]);
	fputs(",again_ms,cache_bytes,kept_bytes,source_bytes,options\n", csv);
	for (int d = 0; d < count; d++) {
		bench_build_figure coldest = {0, NULL, 0.0};
		for (int i = 0; ok && i < BENCH_SCENES; i++)
			if (bench_is_opencl(&devices[d]) && (lobe < 0 || lobe == i)) {
				const size_t all = runs < RUNS_MAX ? runs : RUNS_MAX;
				build_times t;
				ok = row(program, &devices[d], i, bench_now() - start < seconds ? all : 1, csv, &t);
				if (ok)
					add_to_highest(highest, &coldest, &devices[d], i, &t);
				rows += ok;
			}
	}
	if (ok && rows == 0)
		puts("(no OpenCL device)");
	return fclose(csv) == 0 && ok;
}
