/* strides.h - words of 4 bytes at equal distances: members of an array of structs, or a packed array. */
#ifndef LOBE_STRIDES_H
#define LOBE_STRIDES_H

#include "internal.h"

/* Arrays to be packed or unpacked, up to all that a batch has. */
typedef struct {
	int count;
	void *packed[LOBE_ARRAY_COUNT];
	void *apart[LOBE_ARRAY_COUNT]; /* stride[a] bytes from word to word */
	size_t stride[LOBE_ARRAY_COUNT];
} lobe_strided;

static inline void lobe_strided_add(lobe_strided *s, void *packed, const void *apart, size_t stride)
{
	s->packed[s->count] = packed;
	s->apart[s->count] = (void *)(uintptr_t)apart;
	s->stride[s->count++] = stride;
}

/* The first n words of each array. (strides.c) */
void lobe_pack(const lobe_strided *s, size_t n);
void lobe_unpack(const lobe_strided *s, size_t n);

/* Alignment, strides and overlap of a job's arrays; LOBE_ERROR_ARGUMENT and a message that names the field.
 * (strides.c) */
lobe_status lobe_check_arrays(const lobe_job *job, int sample, const char *call);

/* Runs a job that has been checked; on a device that takes packed arrays alone in parts that are packed and unpacked
 * here. (strides.c) */
lobe_status lobe_run_job(lobe_scene *scene, const lobe_job *job);

#endif
