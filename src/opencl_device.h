/* opencl_device.h - what the parts of the OpenCL backend share: opencl.c (devices), opencl_program.c (scenes and their
 * programs), opencl_binary.c (programs in the cache), opencl_run.c (batches: arrays to and from the device),
 * opencl_launch.c (batches: kernels). */
#ifndef LOBE_OPENCL_DEVICE_H
#define LOBE_OPENCL_DEVICE_H

#include <pthread.h>

#include "internal.h"
#include "opencl_api.h"

/* How an element finds its parameters, the last part of a kernel's name (cl/kernels.cl). */
enum { LOBE_CL_ONE, LOBE_CL_MANY, LOBE_CL_MIXED, LOBE_CL_HOW_COUNT };

/* In place of a slot, for a material of LOBE_KIND_NONE. The same number stands in cl/kernels.cl. */
#define LOBE_CL_NO_SLOT 0xFFFFFFFFu

/* What PoCL calls its platform. */
#define LOBE_CL_POCL "Portable Computing Language"

/* A kernel and its local size; made when it is first needed. */
typedef struct {
	cl_kernel kernel;
	size_t local;
} lobe_cl_kernel;

/* A program, kept by its device for every scene of the same options. */
typedef struct lobe_cl_program {
	struct lobe_cl_program *next;
	cl_program program;
	lobe_cl_kernel shade[LOBE_COUNT][LOBE_VERB_COUNT][LOBE_CL_HOW_COUNT];
	lobe_cl_kernel zero, zero_mixed;
	lobe_cl_kernel mixed[LOBE_VERB_COUNT]; /* of a processor, in place of those of LOBE_CL_MIXED */
	char *key; /* in the cache, owned; NULL when there is nothing to look for there or to write to it any more */
	size_t key_size;
	size_t kept_size; /* of the binary in the cache, as far as is known here; 0: none */
	int grows;        /* binaries hold the kernels that have been launched */
	int outgrown;     /* a kernel has been made since the binary was taken */
	char options[];
} lobe_cl_program;

/* Device memory that is kept from call to call and only grows. */
typedef struct {
	cl_mem mem;
	size_t size;
} lobe_cl_buffer;

/* A queue and the buffers that its commands use. */
typedef struct {
	cl_command_queue queue;
	lobe_cl_buffer in[LOBE_IN_COUNT], out[LOBE_OUT_COUNT], material, order;
} lobe_cl_lane;

/* Two, so that one's transfers go on beside the other's kernels. */
enum { LOBE_CL_LANES = 2 };

typedef struct {
	lobe_device base;
	const lobe_cl_functions *cl;
	cl_context context;
	cl_device_id id;
	int unified;       /* shares its memory with the host: batches need no copies */
	int loops;         /* a processor, by PoCL: a work-item shades many elements, LOBE_LOOPS of cl/kernels.cl */
	size_t units;      /* that run work-items */
	size_t local;      /* work-items in a group */
	size_t max_count;  /* elements of 4 bytes in a buffer */
	size_t copy_count; /* elements of a chunk of which a lane's buffers take a quarter of the device's memory */

	pthread_mutex_t lock; /* held by every call that uses what is below, the kernels' arguments above all */
	lobe_cl_program *programs;
	lobe_cl_lane lane[LOBE_CL_LANES]; /* the first one's queue is the device's; the second's is made when it is needed */
} lobe_cl_device;

/* scene->state */
typedef struct {
	lobe_cl_program *program;
	cl_mem table[LOBE_COUNT]; /* of each lobe that the scene has */
	cl_mem slot;              /* scene->slot, with LOBE_CL_NO_SLOT */
	cl_mem number;            /* of each material's lobe among the scene's (cl/mixed.cl), or NULL: not needed */
	cl_mem tables;            /* scene->tables, or NULL */
	int lobe_count;           /* lobes that the scene has */
	int last_lobe;            /* one of them */
} lobe_cl_scene;

/* A batch whose arrays are on the device. Outputs that nobody wants are scratch here, not NULL. */
typedef struct {
	lobe_cl_device *device;
	lobe_cl_lane *lane;
	const lobe_scene *scene;
	int verb;
	cl_mem in[LOBE_IN_COUNT], out[LOBE_OUT_COUNT], material;
	int wanted[LOBE_OUT_COUNT];
} lobe_cl_shading;

static inline size_t lobe_cl_smaller(size_t a, size_t b) { return a < b ? a : b; }

/* opencl.c: a queue for a lane that has none yet. */
lobe_status lobe_cl_lane_open(lobe_cl_device *device, lobe_cl_lane *lane);

/* opencl_program.c */
lobe_status lobe_cl_scene_create(lobe_scene *scene);
void lobe_cl_scene_destroy(lobe_scene *scene);
void lobe_cl_programs_release(lobe_cl_device *device);

/* In place of a lobe: all of them. */
enum { LOBE_CL_NO_LOBE = -1, LOBE_CL_EVERY_LOBE = -2 };

/* The kernel of a lobe and verb, of LOBE_CL_EVERY_LOBE and a verb, or of LOBE_CL_NO_LOBE: zero (LOBE_CL_ONE) or
 * zero_mixed (LOBE_CL_MIXED). */
lobe_status lobe_cl_kernel_get(lobe_cl_device *device, lobe_cl_program *program, int lobe, int verb, int how,
			       lobe_cl_kernel *out);

/* opencl_binary.c: binaries of programs in the cache (opencl_cache.h). None of these fails: else there is the
 * source. */

/* Sets p->key: the three parts of the source, the options, and all that names the device and its driver; and
 * p->grows. */
void lobe_cl_binary_find_key(const lobe_cl_device *device, lobe_cl_program *p, const char *const source[3]);
/* Sets p->program from the cache, built, unless it is not there or the device does not take it. */
void lobe_cl_binary_load(lobe_cl_device *device, lobe_cl_program *p);
void lobe_cl_binary_store(lobe_cl_device *device, lobe_cl_program *p);
/* Stores the programs that are outgrown. */
void lobe_cl_binaries_update(lobe_cl_device *device);

/* opencl_launch.c */

/* Makes room for count elements of 4 bytes; the contents are lost when the buffer grows. */
lobe_status lobe_cl_grow(lobe_cl_device *device, lobe_cl_buffer *buffer, size_t count);
void lobe_cl_buffers_release(lobe_cl_device *device);

/* Fills in the outputs of the verb that nobody wants: its kernels write them all the same, to memory that nobody reads.
 */
lobe_status lobe_cl_add_scratch(lobe_cl_shading *b, size_t count);

/* Enqueues the kernels. host_material: b->material on the host; needed only if the scene has several lobes. */
lobe_status lobe_cl_enqueue(const lobe_cl_shading *b, const uint32_t *host_material, size_t count);

/* opencl_run.c */
lobe_status lobe_cl_run(lobe_scene *scene, const lobe_job *job);
lobe_status lobe_cl_run_device(lobe_scene *scene, const lobe_job *job);

/* The kernels, generated from cl/kernels.cl. */
const char *lobe_opencl_kernels(void);

#endif
