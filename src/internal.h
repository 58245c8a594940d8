/* internal.h - what the batch front (batch.c) and the backends (native.c, opencl.c) share. */
#ifndef LOBE_INTERNAL_H
#define LOBE_INTERNAL_H

#include <stdint.h>

#include "lobe/lobe.h"

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

/* One backend. Each function but close and scene_destroy sets the error message when it fails. */
typedef struct {
	void (*close)(lobe_device *device);
	lobe_status (*scene_create)(lobe_scene *scene);             /* sets scene->state */
	void (*scene_destroy)(lobe_scene *scene);                   /* after a successful scene_create only */
	lobe_status (*run)(lobe_scene *scene, const lobe_job *job); /* host arrays; returns when they are written */
	lobe_status (*run_device)(lobe_scene *scene, const lobe_job *job); /* cl_mem arrays; NULL for a native device */
} lobe_device_ops;

typedef struct lobe_worker lobe_worker; /* event.h */

/* First member of each backend's own device struct, which begins as zeros. */
struct lobe_device {
	const lobe_device_ops *ops;
	int takes_strides; /* 0: run gets packed arrays alone */
	lobe_worker *worker; /* runs batches behind the caller; NULL until the first */
	char name[256];
};

struct lobe_scene {
	lobe_device *device;
	size_t count;    /* materials */
	uint32_t *index; /* [count] LOBE_INDEX_* of each material */
	uint32_t *slot;  /* [count] its place in that lobe's table */
	struct {
		void *params; /* lobe_<name>[count], owned; NULL when count is 0 */
		size_t count;
	} table[LOBE_COUNT];
	float *tables;      /* [table_words] copies of the materials' tables (core/table.h), owned; [0] is no table */
	size_t table_words; /* 0: no lobe of the scene may carry one */
	char *options;      /* OpenCL build options, owned */
	void *state;   /* the backend's */
};

/* Size of lobe_<name> by LOBE_INDEX_*, and its name. (fields.c) */
extern const size_t lobe_param_size[LOBE_COUNT];
extern const char *const lobe_param_name[LOBE_COUNT];

/* LOBE_INDEX_* of a kind, LOBE_INDEX_NONE of LOBE_KIND_NONE, -1 of anything else. (fields.c) */
int lobe_index_of_kind(uint32_t kind);

/* The arrays of a job by position, as lobe_batch calls them: [lobe_verb_is_sample(verb)][LOBE_IN_* or LOBE_OUT_*].
 * (batch.c) */
extern const char *const lobe_in_names[2][LOBE_IN_COUNT], *const lobe_out_names[2][LOBE_OUT_COUNT];

/* Checks every field of materials[i]; LOBE_ERROR_PARAMETER and a message that names i and the field. (fields.c) */
lobe_status lobe_check_material(const lobe_bsdf *materials, size_t i);

/* What lobes choose at run time: LOBE_ONLY_<NAME> of config.h. */
#define LOBE_CHOICES(X) X(NDF) X(MASKING) X(JOINT) X(ACROSS) X(FRESNEL) X(STRATEGY) X(DELTA) X(DENSE)
enum {
#define LOBE_CHOICE_ENUM(NAME) LOBE_CHOICE_##NAME,
	LOBE_CHOICES(LOBE_CHOICE_ENUM)
#undef LOBE_CHOICE_ENUM
	LOBE_CHOICES_COUNT
};

/* Adds bit n of used[choice] for the value n that a checked material chooses. 0: it has nothing to choose.
 * (fields.c) */
int lobe_add_choices(const lobe_bsdf *material, uint32_t used[LOBE_CHOICES_COUNT]);

/* The options of a scene whose tables are filled, the caller's to free. NULL: out of memory. (options.c) */
char *lobe_make_options(const lobe_scene *scene, const lobe_bsdf *materials);

/* lobe_fail(status, format, ...): sets this thread's error message (printf) and is status. A macro, so that a reader
 * and an analyser see that it is not LOBE_OK. (status.c) */
#define lobe_fail(status, ...) (lobe_set_error_message(__VA_ARGS__), (status))
void lobe_set_error_message(const char *format, ...)
#ifdef __GNUC__
	__attribute__((format(printf, 1, 2)))
#endif
	;

/* This thread's error message, for what fails on the way to success and for what another thread has done. (status.c) */
typedef struct {
	char text[4096];
} lobe_message;
void lobe_message_get(lobe_message *out);
void lobe_message_set(const lobe_message *message);

/* Elements [0, n) of material[] grouped by lobe: order[begin[L] .. begin[L+1]) are the elements of lobe L, ascending;
 * L up to and including LOBE_INDEX_NONE, begin has LOBE_COUNT + 2 entries. material has been checked. (sort.c) */
void lobe_sort_by_lobe(const lobe_scene *scene, const uint32_t *material, size_t n, uint32_t *order, size_t *begin);

/* Whether that lobe may carry a table: LOBE_X_TABLED of lobes.def. (tables.c) */
int lobe_is_tabled(int index);

/* Copies the tables that scene->table's parameters name into scene->tables, once each, and puts their places there, in
 * bytes, into the handles. Materials are checked by lobe_check_table before. 0: out of memory. (tables.c) */
int lobe_tables_gather(lobe_scene *scene);

/* Adds base to every handle. (tables.c) */
void lobe_tables_rebase(lobe_scene *scene, uint64_t base);

/* Whether the table of materials[i], if it has one, begins with its own length. (tables.c) */
lobe_status lobe_check_table(const lobe_bsdf *materials, size_t i);

/* The table of microfacet/profile.h for a density of slopes f, up to a factor; untouched on failure.
 * (profile_table.c) */
lobe_status lobe_profile_make(float *table, lobe_profile_function f, void *context);

/* Backends. lobe_native_open: threads 0 means all processors. (native.c and opencl.c, or native_none.c and
 * opencl_none.c where one is left out) */
lobe_status lobe_native_count(size_t *count);
lobe_status lobe_native_open(lobe_device **out, size_t threads);
lobe_status lobe_opencl_count(size_t *count);
lobe_status lobe_opencl_open(lobe_device **out, size_t index);
lobe_status lobe_opencl_open_all(lobe_device **out); /* opencl_all.c */

/* A device that does on native what first fails to do. Takes both over when it succeeds. first NULL: opening it failed,
 * with this thread's message as the reason. (fallback.c) */
lobe_status lobe_fallback_open(lobe_device **out, lobe_device *first, lobe_device *native);

/* out becomes a scene of its own on that device, in which the lists and parameters are from's. (batch.c) */
lobe_status lobe_scene_share(lobe_scene *out, const lobe_scene *from, lobe_device *device);
/* lobe_device_open_cl and lobe_device_cl are implemented in opencl.c, lobe_opencl_source in opencl_source.c and
 * lobe_opencl_options in options.c. */

#endif
