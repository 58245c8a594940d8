/* native_chunk.c - one chunk of a native batch on one thread. Where arrays are packed and all elements are of one lobe
 * the row loop works on them in place. Else elements go through the thread's own memory a block at a time: packed, if
 * they lie apart; split by lobe or material, if those are mixed; shaded; and put back. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <time.h>

#include "native.h"
#include "strides.h"

/* --- scenes ------------------------------------------------------------------------------------------------------ */

lobe_status lobe_native_scene_create(lobe_scene *scene)
{
	const int by_material = scene->count <= LOBE_NATIVE_SPLIT_MATERIALS;
	size_t none = scene->count;
	lobe_native_scene *const state = calloc(1, sizeof *state + scene->count * sizeof *state->key);
	if (!state)
		return lobe_out_of_memory("a scene");
	state->single = -1;
	state->by_material = by_material;
	for (int lobe = 0; lobe <= LOBE_COUNT; lobe++) {
		/* Materials without a lobe are all the same; what no material has needs no key. */
		const size_t materials = lobe < LOBE_COUNT ? scene->table[lobe].count : none;
		const size_t n = by_material && lobe < LOBE_COUNT ? materials : materials > 0;
		none -= materials;
		state->first_key[lobe + 1] = state->first_key[lobe] + (uint32_t)n;
		if (lobe < LOBE_COUNT && scene->table[lobe].count == scene->count)
			state->single = lobe;
	}
	state->keys = state->first_key[LOBE_COUNT + 1];
	for (size_t i = 0; i < scene->count; i++) {
		const uint32_t lobe = scene->index[i];
		state->key[i] = state->first_key[lobe] + (by_material && lobe < LOBE_COUNT ? scene->slot[i] : 0);
	}
	scene->state = state;
	/* Its parameters and tables serve as they are. */
	lobe_tables_rebase(scene, (uint64_t)(uintptr_t)scene->tables);
	return LOBE_OK;
}

void lobe_native_scene_destroy(lobe_scene *scene) { free(scene->state); }

/* --- blocks ------------------------------------------------------------------------------------------------------ */

/* Elements of a batch by their arrays. An output that nobody wants is NULL in out, but has a place in shade. */
typedef struct {
	size_t n;
	const uint32_t *material; /* NULL: all are of the scene's first */
	const float *in[LOBE_IN_COUNT];
	void *out[LOBE_OUT_COUNT];
} block;

static void *room(lobe_native_scratch *s, int k, int sample)
{
	return sample && k == LOBE_OUT_EVENT ? (void *)s->event : (void *)s->out[k];
}

static void *packed_room(lobe_native_scratch *s, int k, int sample)
{
	return sample && k == LOBE_OUT_EVENT ? (void *)s->packed_event : (void *)s->packed_out[k];
}

/* Whether no output that the loops write goes to the thread's own memory, which has room for a block alone. */
static int all_wanted(const lobe_job *job)
{
	int yes = 1;
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		yes &= job->out[k] || !lobe_verb_writes(job->verb, k);
	return yes;
}

/* The loop of a lobe. slot: of each element, or NULL: all are at that place of its table. */
static void run_row(const lobe_native_job *j, int lobe, const uint32_t *slot, size_t place, size_t n,
		    const float *const *in, void *const *out)
{
	const unsigned char *const table = j->scene->table[lobe].params;
	const int verb = j->job->verb;
	uint32_t differs = 0;
	for (size_t i = 0; slot && i < n; i++)
		differs |= slot[i] ^ slot[0];
	if (differs)
		j->rows[lobe]->verb[verb].many(table, slot, n, in, out);
	else
		j->rows[lobe]->verb[verb].one(table + (slot ? slot[0] : place) * lobe_param_size[lobe], slot, n, in,
					      out);
}

/* A block of one lobe. */
static void shade_one(const lobe_native_job *j, lobe_native_scratch *s, int lobe, const block *b)
{
	const int sample = lobe_verb_is_sample(j->job->verb);
	void *out[LOBE_OUT_COUNT];
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		out[k] = b->out[k] ? b->out[k] : room(s, k, sample);
	if (b->material)
		j->split->look_up(s->slot, j->scene->slot, b->material, b->n);
	run_row(j, lobe, b->material ? s->slot : NULL, j->scene->slot[0], b->n, b->in, out);
}

/* Elements of one key, at [at, at + n) of the thread's own memory. */
static void shade_key(const lobe_native_job *j, lobe_native_scratch *s, int lobe, uint32_t key, size_t at, size_t n)
{
	const lobe_native_scene *const state = j->scene->state;
	const int sample = lobe_verb_is_sample(j->job->verb);
	const float *in[LOBE_IN_COUNT];
	void *out[LOBE_OUT_COUNT];
	for (int k = 0; k < LOBE_IN_COUNT; k++)
		in[k] = s->in[k] + at;
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		out[k] = lobe_word_at(room(s, k, sample), 4, at);
	if (lobe == LOBE_INDEX_NONE) {
		for (int k = 0; k < LOBE_OUT_COUNT; k++)
			memset(out[k], 0, 4 * n);
		return;
	}
	/* Whole vectors: what is behind the last element is ours, and nobody reads what comes of it. */
	uint32_t *const slot = state->by_material ? NULL : s->slot + at;
	const size_t all = (n + LOBE_NATIVE_SPLIT_VECTOR - 1) / LOBE_NATIVE_SPLIT_VECTOR * LOBE_NATIVE_SPLIT_VECTOR;
	for (size_t i = n; slot && i < all; i++)
		slot[i] = slot[0];
	run_row(j, lobe, slot, key - state->first_key[lobe], all, in, out);
}

/* What the next block reads, and how much of it is on its way to the caches. */
typedef struct {
	int arrays;
	const unsigned char *array[LOBE_IN_COUNT + 1];
	size_t bytes, done; /* of each */
} ahead;

/* Asks for the next bytes of each. */
static void fetch(ahead *a, size_t bytes)
{
	const size_t end = a->bytes - a->done < bytes ? a->bytes : a->done + bytes;
	for (int k = 0; k < a->arrays; k++)
		for (size_t i = a->done; i < end; i += 64)
			__builtin_prefetch(a->array[k] + i, 0, 2);
	a->done = end;
}

/* A block of several lobes. What the next one reads is fetched while results are joined: parting, a block at a time, is
 * too short a walk for the processor to see it coming. */
static void shade_mixed(const lobe_native_job *j, lobe_native_scratch *s, const block *b, ahead *a)
{
	enum { PIECE = 2 * LOBE_NATIVE_SPLIT_TILE };
	const lobe_native_scene *const state = j->scene->state;
	const int sample = lobe_verb_is_sample(j->job->verb);
	const void *from[LOBE_IN_COUNT + 1], *results[LOBE_OUT_COUNT];
	void *to[LOBE_IN_COUNT + 1], *wanted[LOBE_OUT_COUNT];
	uint32_t begin[LOBE_NATIVE_SPLIT_KEYS], count[LOBE_NATIVE_SPLIT_KEYS];
	int inputs = LOBE_IN_COUNT, outputs = 0;
	j->split->sort(&s->places, begin, count, state->key, state->keys, j->scene->count, b->material, b->n);
	for (int k = 0; k < LOBE_IN_COUNT; k++) {
		from[k] = b->in[k];
		to[k] = s->in[k];
	}
	if (!state->by_material) {
		j->split->look_up(s->slots, j->scene->slot, b->material, b->n);
		from[inputs] = s->slots;
		to[inputs++] = s->slot;
	}
	j->split->part(to, from, inputs, &s->places, b->n);
	for (int lobe = 0; lobe <= LOBE_COUNT; lobe++)
		for (uint32_t k = state->first_key[lobe]; k < state->first_key[lobe + 1]; k++)
			if (count[k])
				shade_key(j, s, lobe, k, begin[k], count[k]);
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		if (b->out[k]) {
			results[outputs] = room(s, k, sample);
			wanted[outputs++] = b->out[k];
		}
	for (size_t i = 0; i < b->n; i += PIECE) {
		fetch(a, 4 * PIECE);
		j->split->join(wanted, results, outputs, &s->places, i, b->n - i < PIECE ? b->n : i + PIECE, j->stream);
	}
}

/* --- the floating-point environment ------------------------------------------------------------------------------- */

/* The caller's may round otherwise or flush subnormal numbers, and threads of the pool have that of who opened the
 * device: all shade in the default one. */
#ifdef LOBE_X86
#include <immintrin.h>

typedef unsigned environment;

static environment enter_default(void)
{
	const environment before = _mm_getcsr();
	_mm_setcsr(0x1f80); /* rounds to nearest, keeps subnormals, traps nothing */
	return before;
}

static void leave_default(environment before) { _mm_setcsr(before); }
#else
#include <fenv.h>

typedef fenv_t environment;

static environment enter_default(void)
{
	environment before;
	fegetenv(&before);
	fesetenv(FE_DFL_ENV);
	return before;
}

static void leave_default(environment before) { fesetenv(&before); }
#endif

/* --- chunks ------------------------------------------------------------------------------------------------------ */

/* Elements [first, first + n) of the job as packed arrays: where they are, or in the thread's own memory. unpack: the
 * outputs that are to be brought where they belong. */
static block open_block(const lobe_job *job, lobe_native_scratch *s, size_t first, size_t n, lobe_strided *unpack)
{
	block b = {n, NULL, {NULL}, {NULL}};
	lobe_strided pack;
	pack.count = unpack->count = 0;
	for (int k = 0; k < LOBE_IN_COUNT; k++) {
		b.in[k] = lobe_word_at(job->in[k], job->in_stride[k], first);
		if (job->in_stride[k] != 4) {
			lobe_strided_add(&pack, s->packed_in[k], b.in[k], job->in_stride[k]);
			b.in[k] = s->packed_in[k];
		}
	}
	if (job->material) {
		b.material = lobe_word_at(job->material, job->material_stride, first);
		if (job->material_stride != 4) {
			lobe_strided_add(&pack, s->material, b.material, job->material_stride);
			b.material = s->material;
		}
	}
	for (int k = 0; k < LOBE_OUT_COUNT; k++) {
		if (!job->out[k])
			continue;
		b.out[k] = lobe_word_at(job->out[k], job->out_stride[k], first);
		if (job->out_stride[k] != 4) {
			void *const packed = packed_room(s, k, lobe_verb_is_sample(job->verb));
			lobe_strided_add(unpack, packed, b.out[k], job->out_stride[k]);
			b.out[k] = packed;
		}
	}
	lobe_pack(&pack, n);
	return b;
}

static void shade_none(const lobe_job *job, const block *b)
{
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		if (job->out[k] && lobe_verb_writes(job->verb, k))
			memset(b->out[k], 0, 4 * b->n);
}

size_t lobe_native_split_block(const lobe_scene *scene)
{
	const lobe_native_scene *const state = scene->state;
	const size_t n = (size_t)LOBE_NATIVE_SPLIT_EACH * state->keys;
	if (!state->by_material || n > LOBE_NATIVE_SPLIT_MAX)
		return LOBE_NATIVE_SPLIT_MAX;
	return n < LOBE_NATIVE_SPLIT_MIN ? LOBE_NATIVE_SPLIT_MIN : n;
}

/* Elements that are shaded at a time. */
static size_t block_size(const lobe_native_job *j, int whole)
{
	const lobe_job *const job = j->job;
	if (whole < 0)
		return lobe_native_split_block(j->scene);
	/* Materials are looked up for a block of slots, however many the scene has. */
	const int apart = !lobe_is_packed(job) || job->material;
	return apart || !all_wanted(job) ? LOBE_NATIVE_BLOCK : j->chunk;
}

int lobe_native_whole(const lobe_scene *scene, const lobe_job *job)
{
	const lobe_native_scene *const state = scene->state;
	return job->material ? state->single : (int)scene->index[0];
}

/* Elements [first, first + n): those arrays that are read where they are. */
static ahead look_ahead(const lobe_job *job, size_t first, size_t n)
{
	ahead a = {0, {NULL}, 4 * n, 0};
	for (int k = 0; n && k < LOBE_IN_COUNT; k++)
		if (job->in_stride[k] == 4)
			a.array[a.arrays++] = lobe_word_at(job->in[k], 4, first);
	if (n && job->material_stride == 4)
		a.array[a.arrays++] = lobe_word_at(job->material, 4, first);
	return a;
}

static void shade_chunk(const lobe_native_job *j, lobe_native_scratch *s, size_t first, size_t end)
{
	const int whole = lobe_native_whole(j->scene, j->job);
	const size_t step = block_size(j, whole);
	for (size_t at = first; at < end; at += step) {
		lobe_strided unpack;
		const block b = open_block(j->job, s, at, end - at < step ? end - at : step, &unpack);
		if (whole == LOBE_INDEX_NONE)
			shade_none(j->job, &b);
		else if (whole >= 0)
			shade_one(j, s, whole, &b);
		else {
			const size_t next = at + b.n, left = end - next;
			ahead a = look_ahead(j->job, next, left < step ? left : step);
			shade_mixed(j, s, &b, &a);
		}
		lobe_unpack(&unpack, b.n);
	}
	if (j->stream)
		j->split->settle();
}

void lobe_native_chunk(void *context, size_t chunk, size_t thread)
{
	lobe_native_job *const j = context;
	const size_t first = chunk * j->chunk, left = j->job->count - first, n = left < j->chunk ? left : j->chunk;
	const environment before = enter_default();
	struct timespec start, end;
	if (chunk != 0) {
		shade_chunk(j, &j->scratch[thread], first, first + n);
		leave_default(before);
		return;
	}
	clock_gettime(CLOCK_MONOTONIC, &start);
	shade_chunk(j, &j->scratch[thread], first, first + n);
	clock_gettime(CLOCK_MONOTONIC, &end);
	leave_default(before);
	j->nanoseconds =
		((double)(end.tv_sec - start.tv_sec) * 1e9 + (double)(end.tv_nsec - start.tv_nsec)) / (double)n;
}
