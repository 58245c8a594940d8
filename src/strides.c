/* strides.c - arrays of a batch whose elements are apart: whether they are sound, and packing for devices that want
 * packed ones. */
#include <stdlib.h>

#include "strides.h"

enum { ARRAYS = LOBE_OUT_COUNT + LOBE_IN_COUNT + 1 };

/* An array of the job as a caller knows it. Outputs come first, material last. */
typedef struct {
	const char *name;
	uintptr_t at; /* 0: not there */
	size_t stride;
} array;

static void list_arrays(array *a, const lobe_job *job, int sample)
{
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		a[i] = (array){lobe_out_names[sample][i], (uintptr_t)job->out[i], job->out_stride[i]};
	for (int i = 0; i < LOBE_IN_COUNT; i++)
		a[LOBE_OUT_COUNT + i] = (array){lobe_in_names[sample][i], (uintptr_t)job->in[i], job->in_stride[i]};
	a[ARRAYS - 1] = (array){"material", (uintptr_t)job->material, job->material_stride};
}

/* Its first and last byte are in memory, its words and their distance aligned. */
static lobe_status check_array(const array *a, size_t count, const char *call)
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
				 "%s: batch->count is %zu, too many for memory from batch->%s on, %zu bytes apart", call,
				 count, a->name, a->stride);
	return LOBE_OK;
}

/* Whether two arrays that check_array has passed share a word. Members of one struct lie between each other and do not. */
static int overlap(const array *a, const array *b, size_t count)
{
	const uintptr_t a_last = a->at + (count - 1) * a->stride, b_last = b->at + (count - 1) * b->stride;
	if (a->at > b_last || b->at > a_last)
		return 0;
	if (a->stride < b->stride)
		return overlap(b, a, count);
	/* From the first word of a that is not before b to the last that is not behind it: is one of them at a multiple
	 * of b's stride? Where they stand between two of those repeats, after no more steps than b has words between. */
	const uintptr_t skipped = a->at < b->at ? (b->at - a->at + a->stride - 1) / a->stride * a->stride : 0;
	const size_t period = a->stride % b->stride == 0 ? 1 : b->stride / 4;
	size_t distance = a->at + skipped - b->at;
	for (size_t i = 0; i < period && distance <= b_last - b->at && skipped + i * a->stride <= a_last - a->at; i++) {
		if (distance % b->stride == 0)
			return 1;
		distance += a->stride;
	}
	return 0;
}

lobe_status lobe_check_arrays(const lobe_job *job, int sample, const char *call)
{
	array a[ARRAYS];
	list_arrays(a, job, sample);
	for (int i = 0; i < ARRAYS; i++) {
		const lobe_status status = a[i].at ? check_array(&a[i], job->count, call) : LOBE_OK;
		if (status != LOBE_OK)
			return status;
	}
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		for (int k = i + 1; a[i].at && k < ARRAYS; k++)
			if (a[k].at && overlap(&a[i], &a[k], job->count))
				return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: output batch->%s overlaps batch->%s", call,
						 a[i].name, a[k].name);
	return LOBE_OK;
}

/* --- packing ----------------------------------------------------------------------------------------------------- */

/* Elements packed at a time: enough to hide what a launch costs, few enough for the outer caches. */
#ifndef LOBE_PACK_MAX
#define LOBE_PACK_MAX ((size_t)1 << 17)
#endif

static int packed(const lobe_job *job)
{
	int yes = !job->material || job->material_stride == 4;
	for (int i = 0; i < LOBE_IN_COUNT; i++)
		yes &= job->in_stride[i] == 4;
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		yes &= !job->out[i] || job->out_stride[i] == 4;
	return yes;
}

/* Elements [first, first + n) of an input: where they are, if packed, else packed into the buffer. */
static const void *pack(const void *from, size_t *stride, size_t first, size_t n, unsigned char *buffer)
{
	const unsigned char *const begin = (const unsigned char *)from + first * *stride;
	if (*stride == 4)
		return begin;
	lobe_gather(buffer, begin, *stride, n);
	*stride = 4;
	return buffer;
}

static lobe_status run_part(lobe_scene *scene, const lobe_job *job, size_t first, size_t n, unsigned char *buffer)
{
	lobe_job part = *job;
	part.count = n;
	for (int i = 0; i < LOBE_IN_COUNT; i++, buffer += 4 * LOBE_PACK_MAX)
		part.in[i] = pack(job->in[i], &part.in_stride[i], first, n, buffer);
	if (job->material)
		part.material = pack(job->material, &part.material_stride, first, n, buffer);
	buffer += 4 * LOBE_PACK_MAX;
	for (int i = 0; i < LOBE_OUT_COUNT; i++) {
		if (!job->out[i])
			continue;
		part.out_stride[i] = 4;
		part.out[i] = job->out_stride[i] == 4 ? (unsigned char *)job->out[i] + 4 * first
						      : buffer + 4 * LOBE_PACK_MAX * (size_t)i;
	}
	const lobe_status status = scene->device->ops->run(scene, &part);
	for (int i = 0; i < LOBE_OUT_COUNT && status == LOBE_OK; i++)
		if (job->out[i] && job->out_stride[i] != 4 && lobe_verb_writes(job->verb, i))
			lobe_scatter((unsigned char *)job->out[i] + first * job->out_stride[i], job->out_stride[i],
				     part.out[i], n);
	return status;
}

lobe_status lobe_run_packed(lobe_scene *scene, const lobe_job *job)
{
	lobe_status status = LOBE_OK;
	if (packed(job))
		return scene->device->ops->run(scene, job);
	unsigned char *const buffer = malloc((LOBE_IN_COUNT + 1 + LOBE_OUT_COUNT) * 4 * LOBE_PACK_MAX);
	if (!buffer)
		return lobe_fail(LOBE_ERROR_MEMORY, "out of memory");
	for (size_t first = 0; first < job->count && status == LOBE_OK; first += LOBE_PACK_MAX)
		status = run_part(scene, job, first,
				  job->count - first < LOBE_PACK_MAX ? job->count - first : LOBE_PACK_MAX, buffer);
	free(buffer);
	return status;
}
