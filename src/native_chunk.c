/* native_chunk.c - one chunk of a native batch on one thread. Where arrays are packed and all elements are of one lobe
 * the row loop works on them in place. Else elements go through the thread's own memory a block at a time: packed, if
 * they lie apart; split by lobe or material, if those are mixed; shaded; and put back. */
#include <stdlib.h>

#include "native.h"
#include "strides.h"

enum { VECTOR = 16 /* elements of the longest */ };

/* --- scenes ------------------------------------------------------------------------------------------------------ */

lobe_status lobe_native_scene_create(lobe_scene *scene)
{
	lobe_native_scene *const state = calloc(1, sizeof *state);
	if (!state)
		return lobe_fail(LOBE_ERROR_MEMORY, "lobe_scene_create: out of memory");
	state->single = -1;
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++)
		if (scene->table[lobe].count == scene->count)
			state->single = lobe;
	state->by_material = scene->count <= LOBE_NATIVE_KEYS;
	state->keys = state->by_material ? (uint32_t)scene->count : LOBE_COUNT + 1;
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

/* Word i of an array. */
static void *word_at(const void *array, size_t stride, size_t i)
{
	return (unsigned char *)(uintptr_t)array + stride * i;
}

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

/* The loop of a lobe. slot: of each element, or NULL: all have place. */
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
		j->rows[lobe]->verb[verb].one(table + (slot ? slot[0] : place) * lobe_param_size[lobe], slot, n, in, out);
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

/* A block of several. */
static void shade_mixed(const lobe_native_job *j, lobe_native_scratch *s, const block *b)
{
	const lobe_scene *const scene = j->scene;
	const lobe_native_scene *const state = scene->state;
	const int sample = lobe_verb_is_sample(j->job->verb);
	const uint32_t *key = b->material;
	const void *from[LOBE_IN_COUNT + 1], *results[LOBE_OUT_COUNT];
	void *to[LOBE_IN_COUNT + 1], *out[LOBE_OUT_COUNT], *wanted[LOBE_OUT_COUNT];
	int inputs = 0, outputs = 0;
	for (int k = 0; k < LOBE_IN_COUNT; k++) {
		from[inputs] = b->in[k];
		to[inputs++] = s->in[k];
	}
	for (int k = 0; k < LOBE_OUT_COUNT; k++) {
		out[k] = room(s, k, sample);
		if (b->out[k] && lobe_verb_writes(j->job->verb, k)) {
			results[outputs] = out[k];
			wanted[outputs++] = b->out[k];
		}
	}
	if (!state->by_material) {
		j->split->look_up(s->key, scene->index, b->material, b->n);
		j->split->look_up(s->slots, scene->slot, b->material, b->n);
		key = s->key;
		from[inputs] = s->slots;
		to[inputs++] = s->slot;
	}
	for (uint32_t k = 0; k < state->keys; k++) {
		const int lobe = state->by_material ? (int)scene->index[k] : (int)k;
		size_t n = !state->by_material && lobe < LOBE_COUNT && scene->table[lobe].count == 0
				   ? 0
				   : j->split->plan(&s->plan, key, k, b->n);
		const size_t count = n;
		if (count == 0)
			continue;
		if (lobe == LOBE_INDEX_NONE) {
			for (int i = 0; i < outputs; i++)
				memset((void *)(uintptr_t)results[i], 0, 4 * count);
		} else {
			const float *in[LOBE_IN_COUNT];
			for (int i = 0; i < LOBE_IN_COUNT; i++)
				in[i] = s->in[i];
			j->split->compress(to, from, inputs, &s->plan, b->n, count);
			/* Whole vectors: what is behind the last element is there, and nobody reads what comes of it. */
			for (; n % VECTOR; n++)
				s->slot[n] = s->slot[0];
			run_row(j, lobe, state->by_material ? NULL : s->slot, scene->slot[k < scene->count ? k : 0], n, in, out);
		}
		j->split->expand(wanted, results, outputs, &s->plan, b->n, count);
	}
}

/* --- chunks ------------------------------------------------------------------------------------------------------ */

/* Elements [first, first + n) of the job as packed arrays: where they are, or in the thread's own memory. */
static block open_block(const lobe_job *job, lobe_native_scratch *s, size_t first, size_t n)
{
	block b = {n, NULL, {NULL}, {NULL}};
	for (int k = 0; k < LOBE_IN_COUNT; k++) {
		const void *const at = word_at(job->in[k], job->in_stride[k], first);
		if (job->in_stride[k] != 4)
			lobe_gather(s->packed_in[k], at, job->in_stride[k], n);
		b.in[k] = job->in_stride[k] != 4 ? s->packed_in[k] : at;
	}
	if (job->material) {
		const void *const at = word_at(job->material, job->material_stride, first);
		if (job->material_stride != 4)
			lobe_gather(s->material, at, job->material_stride, n);
		b.material = job->material_stride != 4 ? s->material : at;
	}
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		if (job->out[k])
			b.out[k] = job->out_stride[k] == 4 ? word_at(job->out[k], 4, first)
							   : packed_room(s, k, lobe_verb_is_sample(job->verb));
	return b;
}

/* Results that are not where they belong. */
static void close_block(const lobe_job *job, const block *b, size_t first)
{
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		if (job->out[k] && job->out_stride[k] != 4)
			lobe_scatter(word_at(job->out[k], job->out_stride[k], first), job->out_stride[k], b->out[k], b->n);
}

static void shade_none(const lobe_job *job, const block *b)
{
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		if (job->out[k] && lobe_verb_writes(job->verb, k))
			memset(b->out[k], 0, 4 * b->n);
}

/* Elements that are shaded at a time. */
static size_t block_size(const lobe_native_job *j, int whole)
{
	const lobe_job *const job = j->job;
	int apart = job->material && (job->material_stride != 4 || j->scene->count > 1);
	if (whole < 0)
		return LOBE_NATIVE_MIXED;
	for (int k = 0; k < LOBE_IN_COUNT; k++)
		apart |= job->in_stride[k] != 4;
	for (int k = 0; k < LOBE_OUT_COUNT; k++)
		apart |= job->out[k] && job->out_stride[k] != 4;
	return apart || !all_wanted(job) ? LOBE_NATIVE_BLOCK : j->chunk;
}

void lobe_native_chunk(void *context, size_t chunk, size_t thread)
{
	const lobe_native_job *const j = context;
	const lobe_job *const job = j->job;
	const lobe_native_scene *const state = j->scene->state;
	lobe_native_scratch *const s = &j->scratch[thread];
	const int whole = job->material ? state->single : (int)j->scene->index[0];
	const size_t step = block_size(j, whole);
	const size_t first = chunk * j->chunk, left = job->count - first;
	const size_t end = first + (left < j->chunk ? left : j->chunk);
	for (size_t at = first; at < end; at += step) {
		const block b = open_block(job, s, at, end - at < step ? end - at : step);
		if (whole == LOBE_INDEX_NONE)
			shade_none(job, &b);
		else if (whole >= 0)
			shade_one(j, s, whole, &b);
		else
			shade_mixed(j, s, &b);
		close_block(job, &b, at);
	}
}
