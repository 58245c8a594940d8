/* internal.h - what the front (device.c, scene.c, batch.c) and the backends (native.c, opencl.c) share. */
#ifndef LOBE_INTERNAL_H
#define LOBE_INTERNAL_H

#include "job.h"

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
	long scenes; /* that hold it; -1 once it was closed: whoever brings it there frees it (device.c, scene.c) */
	int takes_strides;   /* 0: run gets packed arrays alone */
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
	void *state;        /* the backend's */
};

/* A material as its make function would make it, from what it holds; and whether its linear map, if it has one, is the
 * inverse of its inverse. (remake.c) */
lobe_bsdf lobe_remake(const lobe_bsdf *material);
int lobe_map_is_whole(const lobe_bsdf *material);

/* Checks what a Fresnel model and a film are made of; lobe: the name of materials[i]'s. (optics_check.c) */
lobe_status lobe_check_optics(const lobe_bsdf *materials, size_t i, const char *lobe);

/* Size of lobe_<name> by LOBE_INDEX_*, and its name. (fields.c) */
extern const size_t lobe_param_size[LOBE_COUNT];
extern const char *const lobe_param_name[LOBE_COUNT];

/* LOBE_INDEX_* of a kind, LOBE_INDEX_NONE of LOBE_KIND_NONE, -1 of anything else. (fields.c) */
int lobe_index_of_kind(uint32_t kind);

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

/* LOBE_ERROR_MEMORY, and a message that says for what. (status.c) */
lobe_status lobe_out_of_memory(const char *what);

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

/* Whether the table that the distribution of materials[i] needs, if it does, is one. (tables.c) */
lobe_status lobe_check_table(const lobe_bsdf *materials, size_t i);

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

/* out becomes a scene of its own on that device, in which the lists and parameters are from's. (scene.c) */
lobe_status lobe_scene_share(lobe_scene *out, const lobe_scene *from, lobe_device *device);
/* lobe_device_open_cl and lobe_device_cl are implemented in opencl.c, lobe_opencl_source in opencl_source.c and
 * lobe_opencl_options in options.c. */

#endif
