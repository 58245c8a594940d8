/* batch.h - devices, scenes and batches: shade many elements at once, natively or on OpenCL, to the same bits.
 *
 *	lobe_device *device;
 *	lobe_scene *scene;
 *	if (lobe_device_open(&device, "opencl") != LOBE_OK)
 *		puts(lobe_error_message());
 *	lobe_scene_create(&scene, device, materials, material_count);
 *	lobe_scene_sample(scene, &batch);
 *
 * Every call returns a lobe_status. One that fails leaves its outputs and everything else as they were, and
 * lobe_error_message() says what was wrong, naming the argument or field. (Results of a batch that fails on an OpenCL
 * device halfway, out of memory say, are unspecified.)
 *
 * Threads: a device and the scenes made from it may be used from several threads; calls on one device take turns.
 * Distinct devices are independent. Closing or destroying something in use is the caller's mistake. The library's own
 * threads take no signals. A child after fork has none of them: it may not use or close its parent's devices, and
 * whether it may open an OpenCL one is for the OpenCL runtime to say. */
#ifndef LOBE_BATCH_H
#define LOBE_BATCH_H

#include <stddef.h>
#include <stdint.h>

#include "backend/api.h"
#include "bsdf.h"

#if LOBE_DOUBLE
#error "batches are single precision: include shading.h alone in LOBE_DOUBLE builds"
#endif
#if !LOBE_HAS_ALL
#error "lobe_bsdf of the linked library has every lobe: LOBE_HAS_* switches are for shading.h without batch.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
	LOBE_OK = 0,
	LOBE_ERROR_ARGUMENT,  /* a null or misaligned pointer, overlapping arrays, an index out of range */
	LOBE_ERROR_PARAMETER, /* a material's field is not finite or outside its domain */
	LOBE_ERROR_DEVICE,    /* no such backend or device, or no OpenCL runtime */
	LOBE_ERROR_BUILD,     /* the OpenCL compiler refused the program; the message holds the head of its log */
	LOBE_ERROR_MEMORY,    /* the host or the device is out of memory */
	LOBE_ERROR_OPENCL     /* any other OpenCL failure; the message names the call and its code */
} lobe_status;

/* The name of a status, e.g. "LOBE_OK". Never null. */
LOBE_API const char *lobe_status_string(lobe_status status);

/* Why the last call of this thread that failed did so. Never null; "" if none has. Valid until the thread's next
 * call. */
LOBE_API const char *lobe_error_message(void);

typedef struct lobe_device lobe_device;
typedef struct lobe_scene lobe_scene;

/* Devices that backend "native" (1) or "opencl" (all devices of all platforms; 0 without a runtime) offers. A library
 * built without a backend (make LOBE_NATIVE=0, make LOBE_OPENCL=0) has 0 of it; opening one is a LOBE_ERROR_DEVICE that
 * says so. LOBE_ERROR_ARGUMENT: a NULL; LOBE_ERROR_DEVICE: no such backend; LOBE_ERROR_OPENCL, LOBE_ERROR_MEMORY: the
 * runtime's own. */
LOBE_API lobe_status lobe_device_count(const char *backend, size_t *count);

/* Opens a device by name:
 *	"native"     a thread for each processor that this process may run on
 *	"native:N"   N threads, 1 to 1024
 *	"opencl"     the first OpenCL device (the same as "opencl:0")
 *	"opencl:N"   OpenCL device N, counted over all platforms
 *	"opencl:all" every OpenCL device that can be used, as one: a batch is split between them
 *	"opencl,native", "opencl:N,native:N", "opencl:all,native" and so on: what the OpenCL device fails to do is done
 *	             on the native one
 *
 * "opencl:all" gives each device an equal part of a scene's first batch of a kind, and then parts in proportion to the
 * speed that was measured; a batch of fewer than 1024 elements for each device goes to the fastest. Results do not
 * depend on it. A device that fails fails the batch, and the message names it. Devices that could not be opened are
 * left out.
 *
 * With ",native" a batch that fails on the OpenCL device, lost in its middle say, runs natively from its beginning, and
 * the caller sees nothing but the right results. A device that failed is not asked again (lobe_device_lost), unless it
 * was short of memory; the same goes for a program that does not build, and for a device that cannot be opened in the
 * first place. Such a device takes no cl_mem, nor does "opencl:all".
 *
 * A native device runs the widest instruction set of "baseline", "avx2" and "avx512" that was compiled in and that the
 * processor has; the environment variable LOBE_ISA, if not empty, names a narrower one. Results do not depend on it.
 *
 * LOBE_ERROR_ARGUMENT: a NULL; LOBE_ERROR_DEVICE: no such name or device; LOBE_ERROR_MEMORY, LOBE_ERROR_OPENCL. On
 * failure *out is left as it was. */
LOBE_API lobe_status lobe_device_open(lobe_device **out, const char *name);

/* What the device is, for people: "native, avx2, 2 threads", "opencl:0, PLATFORM, DEVICE". Valid until it is closed. */
LOBE_API const char *lobe_device_name(const lobe_device *device);

/* Null while the device does as its name says, and for devices without ",native". Why the native one has taken over for
 * good, otherwise. Valid until the device is closed. */
LOBE_API const char *lobe_device_lost(const lobe_device *device);

/* Releases the device, or leaves that to the last of its scenes to be destroyed: they hold it. Null does nothing. */
LOBE_API void lobe_device_close(lobe_device *device);

/* Takes a copy of materials[0..count) and of the tables that they carry (core/table.h), and prepares the device for the
 * kinds of lobe in it and no others. Each field is checked, and that those which make prepares belong to the others: to
 * change a material make it anew. On OpenCL the program is built here, unless this device has already built one for the
 * same kinds.
 *
 * LOBE_ERROR_ARGUMENT: a NULL, no material; LOBE_ERROR_PARAMETER: a field, named in the message; LOBE_ERROR_BUILD,
 * LOBE_ERROR_MEMORY, LOBE_ERROR_OPENCL. On failure *out is left as it was.
 *
 * Built OpenCL programs are kept between runs in a folder: $LOBE_CACHE_DIR, else $XDG_CACHE_HOME/lobe, else
 * ~/.cache/lobe; LOBE_CACHE_DIR="" keeps none. They are written when the program is built, or where kernels are
 * compiled at their first use (PoCL) after the first batch, and found by source, options, device and driver. A file
 * that is damaged, not the user's own or refused by the driver is passed over, a folder that cannot be written does no
 * harm, and what has not been used for longest goes when all exceed 64 MiB. Processes may share the folder. PoCL has a
 * cache of its own, and takes longer to hand out a binary than to build a program: there ours is used only when
 * LOBE_CACHE_DIR is set. */
LOBE_API lobe_status lobe_scene_create(lobe_scene **out, lobe_device *device, const lobe_bsdf *materials, size_t count);

/* Frees the scene, and its device if that is closed and this was the last. Null does nothing. */
LOBE_API void lobe_scene_destroy(lobe_scene *scene);

/* Bytes from one element of an array to the next, multiples of 4. 0: the array is packed, 4 bytes apart. */
typedef struct {
	size_t material, wo, wi, u, f, pdf, sample_wi, weight, sample_pdf, event;
} lobe_strides;

/* A batch as structure of arrays, each of count elements, aligned as its element type is. An output that is NULL is not
 * wanted; the three components of a vector are wanted together or not at all. Inputs may be the same arrays as each
 * other; no word of an output may be one of an input or of another output (LOBE_ERROR_ARGUMENT).
 *
 * Arrays of structs: point at the members of the first struct, and give the struct's size as stride. Nothing else in
 * the structs is read or written, outputs may be members of the same structs as inputs, and a batch may have packed
 * arrays beside them:
 *
 *	struct hit { lobe_vec3 wo; uint32_t material; lobe_vec3 u, wi; lobe_rgb weight; } *hit;
 *	lobe_batch batch = {
 *		.count = n, .material = &hit->material, .wo = {&hit->wo.x, &hit->wo.y, &hit->wo.z},
 *		.u = {&hit->u.x, &hit->u.y, &hit->u.z}, .sample_wi = {&hit->wi.x, &hit->wi.y, &hit->wi.z},
 *		.weight = {&hit->weight.r, &hit->weight.g, &hit->weight.b}, .event = event,
 *		.stride = {.material = sizeof *hit, .wo = sizeof *hit, .u = sizeof *hit, .sample_wi = sizeof *hit,
 *			   .weight = sizeof *hit}};
 *
 * A native device takes strided elements a block at a time through the first-level cache; an OpenCL device gets them
 * packed by the host, part by part.
 *
 * count 0 is allowed and does nothing. A batch may be larger than an OpenCL device's memory, or than the part of it
 * that is free: it goes through in chunks. Inputs of one element never affect another's result. */
typedef struct {
	size_t count;
	const uint32_t *material;          /* index into the scene's materials, or NULL: material 0 for every element */
	const float *wo[3], *wi[3], *u[3]; /* wo always; wi for eval; u, each in [0,1), for sample */
	float *f[3], *pdf;                 /* eval */
	float *sample_wi[3], *weight[3], *sample_pdf;
	uint32_t *event; /* sample */
	lobe_strides stride;
} lobe_batch;

/* f |cos theta_i| and the pdf, whichever is asked for. At least one of f and pdf must be. LOBE_ERROR_ARGUMENT names the
 * array; LOBE_ERROR_MEMORY and LOBE_ERROR_OPENCL are the device's, after which outputs may be written in part. */
LOBE_API lobe_status lobe_scene_eval(lobe_scene *scene, const lobe_batch *batch);

/* sample_wi, weight, sample_pdf and event, whichever are asked for. At least one must be. The same statuses. */
LOBE_API lobe_status lobe_scene_sample(lobe_scene *scene, const lobe_batch *batch);

/* A batch that runs behind the caller. */
typedef struct lobe_event lobe_event;

/* lobe_scene_eval and lobe_scene_sample that return before the results are there. Arguments are checked at once, and
 * what is wrong with them is this call's status; what fails later is the status of lobe_event_wait. Until the batch is
 * done its arrays must stay, inputs unchanged, and so must the scene; lobe_batch itself is copied.
 *
 * A device runs such batches one after another in the order in which they were given, on a thread of its own that the
 * first one starts, and in turn with plain calls from other threads; any number may be waiting. Batches given to
 * several devices run at the same time. On an OpenCL device with memory of its own, the copies of one part of a large
 * batch go on beside the kernels of another, here and in plain calls. */
LOBE_API lobe_status lobe_scene_eval_async(lobe_scene *scene, const lobe_batch *batch, lobe_event **out);
LOBE_API lobe_status lobe_scene_sample_async(lobe_scene *scene, const lobe_batch *batch, lobe_event **out);

/* Waits until the batch is done. Its status, and after a failure its message; the same every time, from any thread. */
LOBE_API lobe_status lobe_event_wait(lobe_event *event);

/* 1 once the batch is done, 0 before. */
LOBE_API int lobe_event_done(lobe_event *event);

/* Waits until the batch is done and frees the event. Null does nothing. */
LOBE_API void lobe_event_release(lobe_event *event);

/* --- OpenCL ---------------------------------------------------------------------------------------------------- */

/* OpenCL's own handles, without its headers: cl_context is a struct _cl_context * and so on. */
struct _cl_context;
struct _cl_device_id;
struct _cl_command_queue;
struct _cl_mem;

/* The shared source, shading.h and all that it includes, as one string. Put it before your own kernels. "" in a library
 * built with LOBE_OPENCL=0. */
LOBE_API const char *lobe_opencl_source(void);

/* Build options for a program that holds lobe_opencl_source() and serves this scene: exact arithmetic, the scene's
 * kinds of lobe only, and of what microfacet_* lobes choose at run time what its materials do choose, where that is one
 * thing (config.h). scene NULL: every lobe and choice. Valid until the scene is destroyed. */
LOBE_API const char *lobe_opencl_options(const lobe_scene *scene);

/* A device on the caller's own context, device and in-order queue, each retained until the device is closed. */
LOBE_API lobe_status lobe_device_open_cl(lobe_device **out, struct _cl_context *context, struct _cl_device_id *device,
					 struct _cl_command_queue *queue);

/* The context, device and queue of an OpenCL device, so that buffers can be made for it; each still owned by it.
 * Any of the three may be NULL. LOBE_ERROR_ARGUMENT for a native device. */
LOBE_API lobe_status lobe_device_cl(const lobe_device *device, struct _cl_context **context, struct _cl_device_id **id,
				    struct _cl_command_queue **queue);

/* lobe_batch with buffers that stay on the device: each holds at least count elements of 4 bytes from offset 0. The
 * same rules, with two exceptions: overlapping sub-buffers are not noticed, and where no more than one kind of lobe is
 * in the scene a material index out of range is not an error but shades to 0. The call enqueues on the device's queue
 * and returns; clFinish or a blocking read waits for the results. With a material buffer and more than one kind of lobe
 * in the scene, the indices are read back first, to sort by kind. */
typedef struct {
	size_t count;
	struct _cl_mem *material;
	struct _cl_mem *wo[3], *wi[3], *u[3];
	struct _cl_mem *f[3], *pdf;
	struct _cl_mem *sample_wi[3], *weight[3], *sample_pdf, *event;
} lobe_cl_batch;

/* lobe_scene_eval and lobe_scene_sample of such buffers. LOBE_ERROR_ARGUMENT too for a device that takes none. */
LOBE_API lobe_status lobe_scene_eval_cl(lobe_scene *scene, const lobe_cl_batch *batch);
LOBE_API lobe_status lobe_scene_sample_cl(lobe_scene *scene, const lobe_cl_batch *batch);

#ifdef __cplusplus
}
#endif

#endif
