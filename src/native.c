/* native.c - batches on the processor: picks the instruction set, cuts the batch into chunks for the threads, and in a
 * chunk of mixed lobes groups the elements so that each lobe runs its own loop (rows.c). */
#define _GNU_SOURCE /* sched_getaffinity */
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "pool.h"
#include "rows.h"

/* Elements of a chunk: small enough for the second-level cache, large enough to hide the hand-over. */
#define CHUNK 8192
/* Elements gathered at a time when lobes are mixed: inputs and outputs stay in the first-level cache. */
#define BLOCK 256

#define LOBE_X(NAME, name, kind) extern const lobe_rows lobe_rows_baseline_##name;
#include "lobe/lobes/lobes.def"
#undef LOBE_X
static const lobe_rows *const rows_baseline[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) &lobe_rows_baseline_##name,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};

#ifdef LOBE_X86
#define LOBE_X(NAME, name, kind) extern const lobe_rows lobe_rows_avx2_##name, lobe_rows_avx512_##name;
#include "lobe/lobes/lobes.def"
#undef LOBE_X
static const lobe_rows *const rows_avx2[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) &lobe_rows_avx2_##name,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};
static const lobe_rows *const rows_avx512[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) &lobe_rows_avx512_##name,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};
#endif

/* Instruction sets from the widest to the narrowest; the last runs anywhere. */
typedef struct {
	const char *name;
	const lobe_rows *const *rows;
	int runs_here;
} isa;

#ifdef LOBE_X86
#define ISA_COUNT 3
#else
#define ISA_COUNT 1
#endif

static void list_isas(isa *list)
{
	const isa baseline = {"baseline", rows_baseline, 1};
#ifdef LOBE_X86
	const isa avx512 = {"avx512", rows_avx512,
			    __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
				    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")};
	const isa avx2 = {"avx2", rows_avx2, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")};
	*list++ = avx512;
	*list++ = avx2;
#endif
	*list = baseline;
}

/* A thread's own memory for grouping a chunk. */
typedef struct {
	uint32_t order[CHUNK];
	uint32_t slot[BLOCK];
	float in[LOBE_IN_COUNT][BLOCK];
	float out[LOBE_OUT_COUNT][BLOCK];
	uint32_t event[BLOCK];
} scratch;

typedef struct {
	lobe_device base;
	isa isa;
	size_t threads;
	lobe_pool *pool;
	scratch *scratch;     /* [threads] */
	pthread_mutex_t lock; /* one batch at a time */
} native_device;

typedef struct {
	const lobe_scene *scene;
	const lobe_job *job;
	const native_device *device;
} native_job;

/* --- one chunk --------------------------------------------------------------------------------------------------- */

/* The only lobe of the scene, or -1. */
static int single_lobe(const lobe_scene *scene)
{
	for (int i = 0; i < LOBE_COUNT; i++)
		if (scene->table[i].count)
			return scene->table[i].count == scene->count ? i : -1;
	return -1;
}

/* Where output k of a block goes when it is gathered or thrown away. */
static void *spare_output(scratch *s, int k, int sample)
{
	return sample && k == LOBE_OUT_EVENT ? (void *)s->event : (void *)s->out[k];
}

/* Element i of an array of 4-byte elements, whatever their type. */
static unsigned char *element(void *array, size_t i) { return (unsigned char *)array + 4 * i; }

/* One lobe, elements in place: [first, first + n) in blocks where something is gathered or thrown away. */
static void run_in_place(const native_job *j, scratch *s, int lobe, const void *table, const uint32_t *material,
			 size_t first, size_t n)
{
	const lobe_job *job = j->job;
	const lobe_row one = j->device->isa.rows[lobe]->verb[job->verb].one;
	const lobe_row many = j->device->isa.rows[lobe]->verb[job->verb].many;
	int spare = 0;
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		spare |= lobe_verb_writes(job->verb, k) && !job->out[k];
	const size_t step = material || spare ? BLOCK : n;
	for (size_t at = first; at < first + n; at += step) {
		const size_t count = first + n - at < step ? first + n - at : step;
		const float *in[LOBE_IN_COUNT];
		void *out[LOBE_OUT_COUNT];
		for (int k = 0; k < LOBE_IN_COUNT; k++)
			in[k] = (const float *)job->in[k] + at;
		for (int k = 0; k < LOBE_OUT_COUNT; k++)
			out[k] = job->out[k] ? (void *)element(job->out[k], at)
					     : spare_output(s, k, lobe_verb_is_sample(job->verb));
		for (size_t i = 0; material && i < count; i++)
			s->slot[i] = j->scene->slot[material[at + i]];
		(material ? many : one)(table, s->slot, count, in, out);
	}
}

/* Elements first + order[0..n), all of one lobe: gather, shade, scatter. */
static void run_gathered(const native_job *j, scratch *s, int lobe, const uint32_t *order, size_t first, size_t n)
{
	const lobe_job *job = j->job;
	const lobe_row many = j->device->isa.rows[lobe]->verb[job->verb].many;
	const uint32_t *material = job->material;
	const float *in[LOBE_IN_COUNT];
	void *out[LOBE_OUT_COUNT];
	for (int k = 0; k < LOBE_IN_COUNT; k++)
		in[k] = s->in[k];
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		out[k] = spare_output(s, k, lobe_verb_is_sample(job->verb));
	for (size_t at = 0; at < n; at += BLOCK) {
		const size_t count = n - at < BLOCK ? n - at : BLOCK;
		for (int k = 0; k < LOBE_IN_COUNT; k++)
			for (size_t i = 0; i < count; i++)
				s->in[k][i] = ((const float *)job->in[k])[first + order[at + i]];
		for (size_t i = 0; i < count; i++)
			s->slot[i] = j->scene->slot[material[first + order[at + i]]];
		many(j->scene->table[lobe].params, s->slot, count, in, out);
		for (int k = 0; k < LOBE_OUT_COUNT; k++)
			if (job->out[k] && lobe_verb_writes(job->verb, k))
				for (size_t i = 0; i < count; i++)
					memcpy(element(job->out[k], first + order[at + i]), element(out[k], i), 4);
	}
}

static void run_none(const lobe_job *job, const uint32_t *order, size_t first, size_t n)
{
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		for (size_t i = 0; job->out[k] && i < n; i++)
			memset(element(job->out[k], first + (order ? order[i] : i)), 0, 4);
}

static void run_chunk(void *context, size_t chunk, size_t thread)
{
	const native_job *j = context;
	const lobe_scene *scene = j->scene;
	const uint32_t *material = j->job->material;
	scratch *s = &j->device->scratch[thread];
	const size_t first = chunk * CHUNK;
	const size_t n = j->job->count - first < CHUNK ? j->job->count - first : CHUNK;
	const int single = material ? single_lobe(scene) : (int)scene->index[0];
	if (single == LOBE_INDEX_NONE) {
		run_none(j->job, NULL, first, n);
	} else if (single >= 0) {
		const unsigned char *table = scene->table[single].params;
		const size_t slot = material ? 0 : scene->slot[0];
		run_in_place(j, s, single, table + slot * lobe_param_size[single], material, first, n);
	} else {
		size_t begin[LOBE_COUNT + 2];
		lobe_sort_by_lobe(scene, material + first, n, s->order, begin);
		for (int lobe = 0; lobe < LOBE_COUNT; lobe++)
			run_gathered(j, s, lobe, s->order + begin[lobe], first, begin[lobe + 1] - begin[lobe]);
		run_none(j->job, s->order + begin[LOBE_INDEX_NONE], first,
			 begin[LOBE_INDEX_NONE + 1] - begin[LOBE_INDEX_NONE]);
	}
}

/* --- device ------------------------------------------------------------------------------------------------------ */

static lobe_status native_run(lobe_scene *scene, const lobe_job *job)
{
	native_device *device = (native_device *)scene->device;
	native_job j = {scene, job, device};
	pthread_mutex_lock(&device->lock);
	lobe_pool_run(device->pool, run_chunk, &j, (job->count + CHUNK - 1) / CHUNK);
	pthread_mutex_unlock(&device->lock);
	return LOBE_OK;
}

/* A scene's parameters and tables serve as they are. */
static lobe_status native_scene_create(lobe_scene *scene)
{
	lobe_tables_rebase(scene, (uint64_t)(uintptr_t)scene->tables);
	return LOBE_OK;
}

static void native_scene_destroy(lobe_scene *scene) { (void)scene; }

static void native_close(lobe_device *base)
{
	native_device *device = (native_device *)base;
	lobe_pool_destroy(device->pool);
	pthread_mutex_destroy(&device->lock);
	free(device->scratch);
	free(device);
}

static const lobe_device_ops native_ops = {native_close, native_scene_create, native_scene_destroy, native_run, NULL};

/* The widest instruction set that runs here, or the one that LOBE_ISA names; its place in list, or -1 and a message. */
static int choose_isa(const isa *list)
{
	const char *asked = getenv("LOBE_ISA");
	for (int i = 0; i < ISA_COUNT; i++) {
		if (asked ? strcmp(asked, list[i].name) != 0 : !list[i].runs_here)
			continue;
		if (list[i].runs_here)
			return i;
		lobe_set_error_message("LOBE_ISA=%s: this processor has no such instructions", asked);
		return -1;
	}
	lobe_set_error_message("LOBE_ISA=%s: this library was not built for it", asked);
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

lobe_status lobe_native_open(lobe_device **out, size_t threads)
{
	isa list[ISA_COUNT];
	list_isas(list);
	const int chosen = choose_isa(list);
	if (chosen < 0)
		return LOBE_ERROR_DEVICE;
	if (threads == 0) {
		const size_t here = processors();
		threads = here < 1 ? 1 : (here > 1024 ? 1024 : here);
	}
	native_device *device = calloc(1, sizeof *device);
	if (!device)
		return lobe_fail(LOBE_ERROR_MEMORY, "lobe_device_open: out of memory");
	device->base.ops = &native_ops;
	device->isa = list[chosen];
	device->threads = threads;
	pthread_mutex_init(&device->lock, NULL);
	device->scratch = calloc(threads, sizeof *device->scratch);
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
