/* strides.c - arrays of a batch whose elements are apart: whether they are sound, and packing for devices that want
 * packed ones. */
#include <stdlib.h>

#include "strides.h"
#include "strides_vectors.h"

/* An array of the job as a caller knows it. */
typedef struct {
	const char *name;
	uintptr_t at; /* 0: not there */
	size_t stride;
	uintptr_t last; /* its last word, once check_array has passed it */
} array;

/* Its first and last byte are in memory, its words and their distance aligned. */
static lobe_status check_array(array *a, size_t count, const char *call)
{
	const int vector = (int)strcspn(a->name, "[");
	if (a->at % 4)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->%s = %p is not aligned to 4 bytes", call, a->name,
				 (void *)a->at);
	if (a->stride % 4)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->stride.%.*s is %zu, not a multiple of 4", call,
				 vector, a->name, a->stride);
	if (count > (UINTPTR_MAX - a->at) / a->stride)
		return lobe_fail(LOBE_ERROR_ARGUMENT,
				 "%s: batch->count is %zu, too many for memory from batch->%s on, %zu bytes apart",
				 call, count, a->name, a->stride);
	a->last = a->at + (count - 1) * a->stride;
	return LOBE_OK;
}

/* Whether two arrays whose spans meet share a word. Members of one struct lie between each other and do not. */
static int overlap(const array *a, const array *b)
{
	if (a->stride < b->stride)
		return overlap(b, a);
	/* From the first word of a that is not before b on: is one a multiple of b's stride away from b? What remains
	 * of the distance repeats after as many steps as b's stride has words, at most. */
	const uintptr_t skipped = a->at < b->at ? (b->at - a->at + a->stride - 1) / a->stride * a->stride : 0;
	const size_t period = a->stride % b->stride == 0 ? 1 : b->stride / 4;
	uintptr_t at = a->at + skipped;
	for (size_t i = 0; i < period && at <= a->last && at <= b->last; i++, at += a->stride)
		if ((at - b->at) % b->stride == 0)
			return 1;
	return 0;
}

lobe_status lobe_check_arrays(const lobe_job *job, int sample, const char *call)
{
	array a[LOBE_ARRAY_COUNT];
	for (int i = 0; i < LOBE_ARRAY_COUNT; i++) {
		a[i] = (array){lobe_array_name(sample, i), (uintptr_t)lobe_array(job, i), lobe_array_stride(job, i), 0};
		const lobe_status status = a[i].at ? check_array(&a[i], job->count, call) : LOBE_OK;
		if (status != LOBE_OK)
			return status;
	}
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		for (int k = i + 1; a[i].at && k < LOBE_ARRAY_COUNT; k++)
			if (a[k].at && a[i].at <= a[k].last && a[k].at <= a[i].last && overlap(&a[i], &a[k]))
				return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: output batch->%s overlaps batch->%s", call,
						 a[i].name, a[k].name);
	return LOBE_OK;
}

/* --- packing ----------------------------------------------------------------------------------------------------- */

static int side_by_side(const word *x, const word *y, const word *z) { return y == x + 1 && z == x + 2; }

/* Three arrays at a time, mostly the components of one vector: a third faster than one by one. */
static void pack_3(word *restrict x, word *restrict y, word *restrict z, word *restrict fx, word *restrict fy,
		   word *restrict fz, size_t stride, size_t n)
{
	for (size_t i = side_by_side(fx, fy, fz) ? pack_vectors(x, y, z, fx, stride, n) : 0; i < n; i++) {
		x[i] = WORD(fx, stride, i);
		y[i] = WORD(fy, stride, i);
		z[i] = WORD(fz, stride, i);
	}
}

static void unpack_3(word *restrict tx, word *restrict ty, word *restrict tz, const word *restrict x,
		     const word *restrict y, const word *restrict z, size_t stride, size_t n)
{
	for (size_t i = side_by_side(tx, ty, tz) ? unpack_vectors(tx, x, y, z, stride, n) : 0; i < n; i++) {
		WORD(tx, stride, i) = x[i];
		WORD(ty, stride, i) = y[i];
		WORD(tz, stride, i) = z[i];
	}
}

/* Whether arrays a to a + 2 are there and equally far apart. */
static int three(const lobe_strided *s, int a)
{
	return a + 3 <= s->count && s->stride[a] == s->stride[a + 1] && s->stride[a] == s->stride[a + 2];
}

void lobe_pack(const lobe_strided *s, size_t n)
{
	for (int a = 0; a < s->count; a++) {
		if (three(s, a)) {
			pack_3(s->packed[a], s->packed[a + 1], s->packed[a + 2], s->apart[a], s->apart[a + 1],
			       s->apart[a + 2], s->stride[a], n);
			a += 2;
			continue;
		}
		for (size_t i = 0; i < n; i++)
			((word *)s->packed[a])[i] = WORD(s->apart[a], s->stride[a], i);
	}
}

void lobe_unpack(const lobe_strided *s, size_t n)
{
	for (int a = 0; a < s->count; a++) {
		if (three(s, a)) {
			unpack_3(s->apart[a], s->apart[a + 1], s->apart[a + 2], s->packed[a], s->packed[a + 1],
				 s->packed[a + 2], s->stride[a], n);
			a += 2;
			continue;
		}
		for (size_t i = 0; i < n; i++)
			WORD(s->apart[a], s->stride[a], i) = ((const word *)s->packed[a])[i];
	}
}

/* Elements packed at a time: enough to hide what a launch costs, few enough for the outer caches. */
#ifndef LOBE_PACK_MAX
#define LOBE_PACK_MAX ((size_t)1 << 17)
#endif

/* Elements [first, first + n) of an input: where they are, if packed, else in the buffer, once pack is done. */
static const void *packed_input(lobe_strided *pack, const void *from, size_t stride, size_t first,
				unsigned char *buffer)
{
	const void *const at = lobe_word_at(from, stride, first);
	if (stride == 4)
		return at;
	lobe_strided_add(pack, buffer, at, stride);
	return buffer;
}

static lobe_status run_part(lobe_scene *scene, const lobe_job *job, size_t first, size_t n, unsigned char *buffer)
{
	lobe_job part = {.verb = job->verb, .count = n, .material_stride = 4};
	lobe_strided pack = {0}, unpack = {0};
	for (int i = 0; i < LOBE_IN_COUNT; i++, buffer += 4 * LOBE_PACK_MAX) {
		part.in[i] = packed_input(&pack, job->in[i], job->in_stride[i], first, buffer);
		part.in_stride[i] = 4;
	}
	if (job->material)
		part.material = packed_input(&pack, job->material, job->material_stride, first, buffer);
	buffer += 4 * LOBE_PACK_MAX;
	for (int i = 0; i < LOBE_OUT_COUNT; i++, buffer += 4 * LOBE_PACK_MAX) {
		const size_t stride = job->out_stride[i];
		part.out_stride[i] = 4;
		if (!job->out[i])
			continue;
		part.out[i] = stride == 4 ? lobe_word_at(job->out[i], 4, first) : buffer;
		if (stride != 4)
			lobe_strided_add(&unpack, buffer, lobe_word_at(job->out[i], stride, first), stride);
	}
	lobe_pack(&pack, n);
	const lobe_status status = scene->device->ops->run(scene, &part);
	if (status == LOBE_OK)
		lobe_unpack(&unpack, n);
	return status;
}

lobe_status lobe_run_job(lobe_scene *scene, const lobe_job *job)
{
	lobe_status status = LOBE_OK;
	if (job->count == 0)
		return LOBE_OK;
	if (scene->device->takes_strides || lobe_is_packed(job))
		return scene->device->ops->run(scene, job);
	unsigned char *const buffer = malloc((LOBE_IN_COUNT + 1 + LOBE_OUT_COUNT) * 4 * LOBE_PACK_MAX);
	if (!buffer)
		return lobe_out_of_memory("packing a batch of strides");
	for (size_t first = 0; first < job->count && status == LOBE_OK; first += LOBE_PACK_MAX)
		status = run_part(scene, job, first,
				  job->count - first < LOBE_PACK_MAX ? job->count - first : LOBE_PACK_MAX, buffer);
	free(buffer);
	return status;
}
