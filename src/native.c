/* native.c - the device of the processor: picks the instruction set and cuts batches into chunks (native_chunk.c) for
 * the threads. */
#define _GNU_SOURCE /* sched_getaffinity */
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "native.h"
#include "pool.h"

extern const lobe_native_split lobe_native_split_baseline;
#ifdef LOBE_X86
extern const lobe_native_split lobe_native_split_avx2, lobe_native_split_avx512;
#endif
#ifdef LOBE_VBMI2
extern const lobe_native_split lobe_native_split_vbmi2;
#endif

typedef struct {
	const char *name;
	const lobe_native_split *split;
	int runs_here;
} isa;

/* list: by LOBE_ISA_*. */
static void list_isas(isa *list)
{
#ifdef LOBE_X86
	list[LOBE_ISA_AVX512] = (isa){"avx512", &lobe_native_split_avx512,
				      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
					      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")};
#ifdef LOBE_VBMI2
	if (__builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("popcnt"))
		list[LOBE_ISA_AVX512].split = &lobe_native_split_vbmi2;
#endif
	list[LOBE_ISA_AVX2] =
		(isa){"avx2", &lobe_native_split_avx2, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")};
#endif
	list[LOBE_ISA_BASELINE] = (isa){"baseline", &lobe_native_split_baseline, 1};
}

typedef struct {
	lobe_device base;
	const lobe_rows *rows[LOBE_COUNT]; /* NULL: not linked */
	const lobe_native_split *split;
	size_t threads;
	lobe_pool *pool;
	lobe_native_scratch *scratch;                 /* [threads] */
	pthread_mutex_t lock;                         /* one batch at a time */
	double cost[LOBE_COUNT + 2][LOBE_VERB_COUNT]; /* nanoseconds of an element; LOBE_COUNT + 1: several lobes */
} native_device;

/* --- device ------------------------------------------------------------------------------------------------------ */

/* Elements of a chunk. One thread takes all at once, and so does the caller's where a batch is short in time; else each
 * thread gets a few chunks, so that one that wakes late or is disturbed takes fewer. Multiples of a page of floats:
 * threads share no cache line of a packed array, but where the array's start has them share one. */
static size_t chunk_size(const native_device *device, size_t count, double cost)
{
	const size_t page = 1024, few = 4;
	if (device->threads == 1 || (double)count * cost <= LOBE_NATIVE_ALONE)
		return count;
	const size_t share = (count / (few * device->threads) + page) / page * page;
	return share < LOBE_NATIVE_CHUNK ? share : LOBE_NATIVE_CHUNK;
}

/* What an element costs, learnt from what the first chunk of each batch took. Lobes differ by a factor of ten and
 * processors by more, so a number of elements would not do. A thread that was put aside in between counts little. */
static void learn(double *cost, double took) { *cost = *cost > took ? took : *cost + (took - *cost) / 8; }

/* Whether no cache would keep what a batch writes. Results for structs go through the thread's own memory, which
 * does. */
static int streams(const lobe_job *job)
{
	size_t outputs = 0;
	for (int k = 0; k < LOBE_OUT_COUNT; k++) {
		if (job->out[k] && job->out_stride[k] != 4)
			return 0;
		outputs += job->out[k] != NULL;
	}
	return job->count >= LOBE_NATIVE_STREAM / 4 / outputs;
}

static lobe_status native_run(lobe_scene *scene, const lobe_job *job)
{
	native_device *device = (native_device *)scene->device;
	const int whole = lobe_native_whole(scene, job);
	double *const cost = &device->cost[whole < 0 ? LOBE_COUNT + 1 : whole][job->verb];
	lobe_native_job j = {scene, job, device->rows, device->split, device->scratch, 0, streams(job), 0.0};
	pthread_mutex_lock(&device->lock);
	j.chunk = chunk_size(device, job->count, *cost);
	lobe_pool_run(device->pool, lobe_native_chunk, &j, (job->count + j.chunk - 1) / j.chunk);
	if (job->count >= LOBE_NATIVE_BLOCK)
		learn(cost, j.nanoseconds);
	pthread_mutex_unlock(&device->lock);
	return LOBE_OK;
}

const lobe_native_split *lobe_native_split_of(const lobe_device *device)
{
	return ((const native_device *)device)->split;
}

/* That the program has the loops of every lobe in the scene. */
static lobe_status native_scene_create(lobe_scene *scene)
{
	const native_device *device = (const native_device *)scene->device;
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++)
		if (scene->table[lobe].count && !device->rows[lobe])
			return lobe_fail(LOBE_ERROR_PARAMETER,
					 "lobe_scene_create: lobe_%s is not linked into this program (lobe/link.h)",
					 lobe_param_name[lobe]);
	return lobe_native_scene_create(scene);
}

static void native_close(lobe_device *base)
{
	native_device *device = (native_device *)base;
	lobe_pool_destroy(device->pool);
	pthread_mutex_destroy(&device->lock);
	free(device->scratch);
	free(device);
}

static const lobe_device_ops native_ops = {native_close, native_scene_create, lobe_native_scene_destroy, native_run,
					   NULL};

/* The widest instruction set that runs here, or the one that LOBE_ISA names, if it is not empty; its place in list, or
 * -1 and a message. */
static int choose_isa(const isa *list)
{
	const char *const value = getenv("LOBE_ISA");
	const char *const asked = value && *value ? value : NULL;
	char names[64] = "";
	for (int i = 0; i < LOBE_ISA_COUNT; i++) {
		if (asked ? strcmp(asked, list[i].name) != 0 : !list[i].runs_here)
			continue;
		if (list[i].runs_here)
			return i;
		lobe_set_error_message("LOBE_ISA=%s: this processor has no such instructions", asked);
		return -1;
	}
	for (int i = 0; i < LOBE_ISA_COUNT; i++) {
		const size_t end = strlen(names);
		snprintf(names + end, sizeof names - end, " %s", list[i].name);
	}
	lobe_set_error_message("LOBE_ISA=%s: this library has%s", asked, names);
	return -1;
}

/* Those that this process may run on. */
static size_t processors(void)
{
#ifdef CPU_COUNT
	cpu_set_t set;
	if (sched_getaffinity(0, sizeof set, &set) == 0)
		return (size_t)CPU_COUNT(&set);
#endif
	const long online = sysconf(_SC_NPROCESSORS_ONLN);
	return online < 1 ? 1 : (size_t)online;
}

static lobe_native_scratch *create_scratch(size_t threads)
{
	void *scratch;
	if (posix_memalign(&scratch, 64, threads * sizeof(lobe_native_scratch)) != 0)
		return NULL;
	return memset(scratch, 0, threads * sizeof(lobe_native_scratch));
}

lobe_status lobe_native_count(size_t *count)
{
	*count = 1;
	return LOBE_OK;
}

lobe_status lobe_native_open(lobe_device **out, size_t threads)
{
	isa list[LOBE_ISA_COUNT];
	list_isas(list);
	const int chosen = choose_isa(list);
	if (chosen < 0)
		return LOBE_ERROR_DEVICE;
	if (threads == 0) {
		const size_t here = processors();
		threads = here < 1 ? 1 : (here > 1024 ? 1024 : here);
	}
	native_device *device = calloc(1, sizeof *device);
	if (!device || pthread_mutex_init(&device->lock, NULL) != 0) {
		free(device);
		return lobe_out_of_memory("a device");
	}
	device->base.ops = &native_ops;
	device->base.takes_strides = 1;
	device->split = list[chosen].split;
	for (const struct lobe_linked *const *l = lobe_linked; *l; l++)
		device->rows[(*l)->lobe] = (*l)->rows[chosen];
	device->threads = threads;
	for (int lobe = 0; lobe < LOBE_COUNT + 2; lobe++)
		for (int verb = 0; verb < LOBE_VERB_COUNT; verb++)
			device->cost[lobe][verb] = 2.0;
	device->scratch = create_scratch(threads);
	device->pool = lobe_pool_create(threads);
	if (!device->scratch || !device->pool) {
		native_close(&device->base);
		return lobe_fail(LOBE_ERROR_MEMORY, "lobe_device_open: no memory or threads for %zu threads", threads);
	}
	snprintf(device->base.name, sizeof device->base.name, "native, %s, %zu thread%s", list[chosen].name, threads,
		 threads == 1 ? "" : "s");
	*out = &device->base;
	return LOBE_OK;
}
