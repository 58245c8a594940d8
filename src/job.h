/* job.h - a batch on its way to a backend: what is asked for, and the arrays by number. */
#ifndef LOBE_JOB_H
#define LOBE_JOB_H

#include <stdint.h>

#include "lobe/lobe.h"

#ifdef __GNUC__
#define LOBE_MAY_ALIAS __attribute__((may_alias))
#else
#define LOBE_MAY_ALIAS
#endif

/* Lobes numbered without gaps, in the order of lobes.def: the index of tables. */
enum {
#define LOBE_X(NAME, name, kind) LOBE_INDEX_##NAME,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	LOBE_COUNT,
	LOBE_INDEX_NONE = LOBE_COUNT /* LOBE_KIND_NONE: nothing to run, outputs 0 */
};

/* What a row loop or kernel computes, by the outputs that are wanted. LOBE_VERB(NAME, name); lobe_verb_writes() tells
 * the outputs. */
#define LOBE_VERBS(LOBE_VERB)                                                                                          \
	LOBE_VERB(EVAL_F, eval_f)         /* f */                                                                      \
	LOBE_VERB(EVAL_PDF, eval_pdf)     /* pdf */                                                                    \
	LOBE_VERB(EVAL_F_PDF, eval_f_pdf) /* both */                                                                   \
	LOBE_VERB(SAMPLE, sample)         /* wi, weight, pdf, event */                                                 \
	LOBE_VERB(SAMPLE_WI, sample_wi)   /* wi, event */

enum {
#define LOBE_VERB(NAME, name) LOBE_VERB_##NAME,
	LOBE_VERBS(LOBE_VERB)
#undef LOBE_VERB
		LOBE_VERB_COUNT
};

/* Arrays of a batch in one order, whatever the verb. */
enum {
	LOBE_IN_WO = 0, /* 3 */
	LOBE_IN_WI = 3, /* 3: eval */
	LOBE_IN_U = 3,  /* 3: sample */
	LOBE_IN_COUNT = 6,

	LOBE_OUT_F = 0,   /* 3: eval */
	LOBE_OUT_PDF = 3, /* 1: eval */

	LOBE_OUT_WI = 0,         /* 3: sample */
	LOBE_OUT_WEIGHT = 3,     /* 3: sample */
	LOBE_OUT_SAMPLE_PDF = 6, /* 1: sample */
	LOBE_OUT_EVENT = 7,      /* 1: sample; uint32_t */
	LOBE_OUT_COUNT = 8
};

/* A batch whose arguments have been checked. Array a is a host pointer (float const *, float *; uint32_t * for the
 * event) or, in a device job, a struct _cl_mem *. An output that is not wanted is NULL. */
typedef struct {
	int verb; /* LOBE_VERB_* */
	size_t count;
	const void *material;
	const void *in[LOBE_IN_COUNT];
	void *out[LOBE_OUT_COUNT];
	size_t material_stride, in_stride[LOBE_IN_COUNT], out_stride[LOBE_OUT_COUNT]; /* bytes; 4: packed */
} lobe_job;

/* Its arrays one after the other: outputs, inputs, material. NULL: not there. sample: lobe_verb_is_sample(verb). The
 * name is lobe_batch's. (job.c) */
enum { LOBE_ARRAY_COUNT = LOBE_OUT_COUNT + LOBE_IN_COUNT + 1 };
const void *lobe_array(const lobe_job *job, int k);
size_t lobe_array_stride(const lobe_job *job, int k);
const char *lobe_array_name(int sample, int k);

/* Whether none of them has its words apart. (job.c) */
int lobe_is_packed(const lobe_job *job);

/* Word i of an array. */
static inline void *lobe_word_at(const void *array, size_t stride, size_t i)
{
	return (unsigned char *)(uintptr_t)array + stride * i;
}

/* A word of an array, float or not: moved alone. */
typedef uint32_t LOBE_MAY_ALIAS lobe_word;

/* Whether a verb writes output k (LOBE_OUT_*), be it wanted or not. */
static inline int lobe_verb_writes(int verb, int k)
{
	switch (verb) {
	case LOBE_VERB_EVAL_F:
		return k < LOBE_OUT_PDF;
	case LOBE_VERB_EVAL_PDF:
		return k == LOBE_OUT_PDF;
	case LOBE_VERB_EVAL_F_PDF:
		return k <= LOBE_OUT_PDF;
	case LOBE_VERB_SAMPLE_WI:
		return k < LOBE_OUT_WEIGHT || k == LOBE_OUT_EVENT;
	default:
		return 1;
	}
}

static inline int lobe_verb_is_sample(int verb) { return verb == LOBE_VERB_SAMPLE || verb == LOBE_VERB_SAMPLE_WI; }

#endif
