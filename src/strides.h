/* strides.h - words of 4 bytes at equal distances: members of an array of structs, or a packed array. */
#ifndef LOBE_STRIDES_H
#define LOBE_STRIDES_H

#include "internal.h"

/* to[i] = word i of an array. */
static inline void lobe_gather(void *to, const void *from, size_t stride, size_t n)
{
	for (size_t i = 0; i < n; i++)
		memcpy((unsigned char *)to + 4 * i, (const unsigned char *)from + stride * i, 4);
}

/* Word i of an array = from[i]. */
static inline void lobe_scatter(void *to, size_t stride, const void *from, size_t n)
{
	for (size_t i = 0; i < n; i++)
		memcpy((unsigned char *)to + stride * i, (const unsigned char *)from + 4 * i, 4);
}

/* Alignment, strides and overlap of a job's arrays; LOBE_ERROR_ARGUMENT and a message that names the field. (strides.c) */
lobe_status lobe_check_arrays(const lobe_job *job, int sample, const char *call);

/* Runs a job on a device that takes packed arrays alone, in parts that are packed and unpacked here. (strides.c) */
lobe_status lobe_run_packed(lobe_scene *scene, const lobe_job *job);

#endif
