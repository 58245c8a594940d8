/* opencl_run.c - OpenCL batches: arrays to the device, kernels, results back. */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>

#include "opencl_device.h"

/* Host arrays go through in chunks of so many elements. Where host and device share memory, what one buffer can hold.
 * Where they do not, small enough that the first one's kernels start soon and the kept buffers stay small, and large
 * enough to hide the cost of a command: a batch goes in four chunks as long as they are not smaller or larger than
 * this.
 */
#ifndef LOBE_CL_WRAP_MAX
#define LOBE_CL_WRAP_MAX ((size_t)1 << 30)
#endif
#ifndef LOBE_CL_COPY_MIN
#define LOBE_CL_COPY_MIN ((size_t)1 << 16)
#endif
#ifndef LOBE_CL_COPY_MAX
#define LOBE_CL_COPY_MAX ((size_t)1 << 20)
#endif
/* When memory is short, chunks of half the size are tried, down to this. */
#ifndef LOBE_CL_CHUNK_MIN
#define LOBE_CL_CHUNK_MIN ((size_t)1 << 12)
#endif

/* --- batches of host arrays --- */

/* Elements [first, first + count) of a job's array. */
static void *at(const void *array, size_t first) { return (void *)((const char *)array + 4 * first); }

/* The host's memory as a buffer, without a copy. */
static lobe_status wrap(lobe_cl_device *device, cl_bitfield access, void *array, size_t count, cl_mem *out)
{
	cl_int error = CL_SUCCESS;
	*out = device->cl->clCreateBuffer(device->context, access | CL_MEM_USE_HOST_PTR, 4 * count, array, &error);
	return *out ? LOBE_OK : lobe_cl_fail("clCreateBuffer", error);
}

static lobe_status copy_in(const lobe_cl_shading *b, lobe_cl_buffer *buffer, const void *array, size_t count, cl_mem *out)
{
	cl_int error;
	const lobe_status status = lobe_cl_grow(b->device, buffer, count);
	if (status != LOBE_OK)
		return status;
	*out = buffer->mem;
	error = b->device->cl->clEnqueueWriteBuffer(b->lane->queue, buffer->mem, CL_FALSE, 0, 4 * count, array, 0, NULL,
						    NULL);
	return error == CL_SUCCESS ? LOBE_OK : lobe_cl_fail("clEnqueueWriteBuffer", error);
}

enum { INPUTS = LOBE_IN_COUNT + 1 }; /* and the materials */

/* Where each input of a chunk of host arrays lies on the device. */
typedef struct {
	void *array[INPUTS]; /* NULL: not there */
	cl_mem mem[INPUTS];
	cl_mem wrapped[INPUTS]; /* those of them to release */
} inputs;

/* Buffers over the same host memory must not overlap, and a batch may give one array twice: the second time it gets the
 * first one's buffer, and an array that overlaps another one in part is copied. */
static lobe_status place_input(const lobe_cl_shading *b, inputs *in, int i, size_t count)
{
	lobe_cl_buffer *const kept = i < LOBE_IN_COUNT ? &b->lane->in[i] : &b->lane->material;
	const uintptr_t begin = (uintptr_t)in->array[i];
	int overlaps = 0, k;
	lobe_status status;
	for (k = 0; k < i; k++) {
		const uintptr_t other = (uintptr_t)in->array[k];
		if (in->array[k] && other == begin) {
			in->mem[i] = in->mem[k];
			return LOBE_OK;
		}
		overlaps |= in->array[k] && other < begin + 4 * count && begin < other + 4 * count;
	}
	if (!b->device->unified || overlaps)
		return copy_in(b, kept, in->array[i], count, &in->mem[i]);
	status = wrap(b->device, CL_MEM_READ_ONLY, in->array[i], count, &in->wrapped[i]);
	in->mem[i] = in->wrapped[i];
	return status;
}

/* The results, into wrapped memory: once a buffer has been mapped, the array behind it holds the latest bits. */
static lobe_status map_output(const lobe_cl_shading *b, cl_mem mem, size_t count)
{
	const lobe_cl_functions *const cl = b->device->cl;
	cl_int error = CL_SUCCESS;
	void *const p = cl->clEnqueueMapBuffer(b->lane->queue, mem, CL_FALSE, CL_MAP_READ, 0, 4 * count, 0, NULL, NULL,
					       &error);
	if (!p)
		return lobe_cl_fail("clEnqueueMapBuffer", error);
	error = cl->clEnqueueUnmapMemObject(b->lane->queue, mem, p, 0, NULL, NULL);
	return error == CL_SUCCESS ? LOBE_OK : lobe_cl_fail("clEnqueueUnmapMemObject", error);
}

static lobe_status read_output(const lobe_cl_shading *b, cl_mem mem, void *array, size_t count)
{
	const cl_int error = b->device->cl->clEnqueueReadBuffer(b->lane->queue, mem, CL_FALSE, 0, 4 * count, array, 0,
								NULL, NULL);
	return error == CL_SUCCESS ? LOBE_OK : lobe_cl_fail("clEnqueueReadBuffer", error);
}

/* A chunk: its inputs, and the output buffers to release once its commands are done. */
typedef struct {
	inputs in;
	cl_mem wrapped[LOBE_OUT_COUNT];
} chunk;

/* Enqueues the whole of elements [first, first + count) on b->lane. */
static lobe_status enqueue_host(lobe_cl_shading *b, chunk *c, const lobe_job *job, size_t first, size_t count)
{
	lobe_cl_device *const device = b->device;
	inputs *const in = &c->in;
	lobe_status status = LOBE_OK;
	int i;
	for (i = 0; i < LOBE_IN_COUNT; i++)
		in->array[i] = at(job->in[i], first);
	in->array[LOBE_IN_COUNT] = job->material ? at(job->material, first) : NULL;
	for (i = 0; i < INPUTS && status == LOBE_OK; i++) {
		if (in->array[i])
			status = place_input(b, in, i, count);
	}
	memcpy(b->in, in->mem, sizeof b->in);
	b->material = in->mem[LOBE_IN_COUNT];
	for (i = 0; i < LOBE_OUT_COUNT && status == LOBE_OK; i++) {
		if (!b->wanted[i])
			continue;
		if (device->unified) {
			status = wrap(device, CL_MEM_WRITE_ONLY, at(job->out[i], first), count, &c->wrapped[i]);
			b->out[i] = c->wrapped[i];
		} else {
			status = lobe_cl_grow(device, &b->lane->out[i], count);
			b->out[i] = b->lane->out[i].mem;
		}
	}
	if (status == LOBE_OK)
		status = lobe_cl_add_scratch(b, count);
	if (status == LOBE_OK)
		status = lobe_cl_enqueue(b, in->array[LOBE_IN_COUNT], count);
	for (i = 0; i < LOBE_OUT_COUNT && status == LOBE_OK; i++) {
		if (b->wanted[i])
			status = device->unified ? map_output(b, b->out[i], count)
						 : read_output(b, b->out[i], at(job->out[i], first), count);
	}
	return status;
}

/* Waits for a lane; its failure counts if there has been none before. */
static void finish(lobe_cl_device *device, const lobe_cl_lane *lane, lobe_status *status)
{
	const cl_int error = lane->queue ? device->cl->clFinish(lane->queue) : CL_SUCCESS;
	if (*status == LOBE_OK && error != CL_SUCCESS)
		*status = lobe_cl_fail("clFinish", error);
}

static void release_chunk(const lobe_cl_functions *cl, const chunk *c)
{
	int i;
	for (i = 0; i < INPUTS; i++) {
		if (c->in.wrapped[i])
			cl->clReleaseMemObject(c->in.wrapped[i]);
	}
	for (i = 0; i < LOBE_OUT_COUNT; i++) {
		if (c->wrapped[i])
			cl->clReleaseMemObject(c->wrapped[i]);
	}
}

/* Shared memory: chunk by chunk, of which there is more than one only beyond the limits of a buffer. */
static lobe_status run_wrapped(lobe_cl_shading *b, const lobe_job *job, size_t limit)
{
	lobe_status status = LOBE_OK;
	size_t first = 0;
	while (first < job->count && status == LOBE_OK) {
		const size_t count = lobe_cl_smaller(job->count - first, limit);
		chunk c;
		memset(&c, 0, sizeof c);
		status = enqueue_host(b, &c, job, first, count);
		/* After a failure too: what has been enqueued uses the caller's arrays. */
		finish(b->device, b->lane, &status);
		release_chunk(b->device->cl, &c);
		first += count;
	}
	return status;
}

/* Separate memory: chunks go to the lanes in turn. Each lane's queue is in order, so a chunk's copies wait for the
 * chunk before the last, whose buffers they use, and for nothing else: they go on beside the kernels of the last
 * one. */
static lobe_status run_copied(lobe_cl_shading *b, const lobe_job *job, size_t limit)
{
	lobe_cl_device *const device = b->device;
	lobe_status status = LOBE_OK;
	size_t first = 0;
	int next = 0, i;
	while (first < job->count && status == LOBE_OK) {
		const size_t count = lobe_cl_smaller(job->count - first, limit);
		chunk c; /* nothing is wrapped */
		memset(&c, 0, sizeof c);
		b->lane = &device->lane[next];
		next = (next + 1) % LOBE_CL_LANES;
		if (!b->lane->queue)
			status = lobe_cl_lane_open(device, b->lane);
		if (status == LOBE_OK)
			status = enqueue_host(b, &c, job, first, count);
		if (status == LOBE_OK) {
			const cl_int error = device->cl->clFlush(b->lane->queue);
			if (error != CL_SUCCESS)
				status = lobe_cl_fail("clFlush", error);
		}
		first += count;
	}
	for (i = 0; i < LOBE_CL_LANES; i++)
		finish(device, &device->lane[i], &status);
	return status;
}

/* Elements of a chunk. */
static size_t chunk_size(const lobe_cl_device *device, size_t count)
{
	size_t limit = LOBE_CL_WRAP_MAX, chunks;
	if (!device->unified) {
		const size_t quarter = (count + 3) / 4;
		limit = lobe_cl_smaller(quarter > LOBE_CL_COPY_MIN ? quarter : LOBE_CL_COPY_MIN, LOBE_CL_COPY_MAX);
		limit = lobe_cl_smaller(limit, device->copy_count);
	}
	limit = lobe_cl_smaller(limit, device->max_count);
	chunks = (count - 1) / limit + 1;
	return (count - 1) / chunks + 1;
}

static void start_batch(lobe_cl_shading *b, const lobe_scene *scene, const lobe_job *job)
{
	int i;
	memset(b, 0, sizeof *b);
	b->device = (lobe_cl_device *)scene->device;
	b->lane = &b->device->lane[0];
	b->scene = scene;
	b->verb = job->verb;
	for (i = 0; i < LOBE_OUT_COUNT; i++)
		b->wanted[i] = lobe_verb_writes(job->verb, i) && job->out[i];
}

lobe_status lobe_cl_run(lobe_scene *scene, const lobe_job *job)
{
	lobe_cl_device *const device = (lobe_cl_device *)scene->device;
	lobe_message before;
	lobe_status status;
	lobe_cl_shading b;
	size_t limit;
	lobe_message_get(&before);
	pthread_mutex_lock(&device->lock);
	limit = chunk_size(device, job->count);
	for (;;) {
		start_batch(&b, scene, job);
		status = device->unified ? run_wrapped(&b, job, limit) : run_copied(&b, job, limit);
		if (status != LOBE_ERROR_MEMORY || limit / 2 < LOBE_CL_CHUNK_MIN)
			break;
		/* Others use the device as well: with less, from the beginning. */
		lobe_cl_buffers_release(device);
		limit /= 2;
	}
	if (status == LOBE_OK) {
		lobe_message_set(&before);
		lobe_cl_binaries_update(device);
	}
	pthread_mutex_unlock(&device->lock);
	return status;
}

/* --- batches of device buffers --- */

/* That mem, the field of that name, holds count elements, belongs to the device's context, and was not made for what
 * the flag forbids: CL_MEM_WRITE_ONLY or CL_MEM_READ_ONLY, of which OpenCL leaves undefined what becomes of it. */
static lobe_status check_buffer(const lobe_cl_device *device, cl_mem mem, const char *name, size_t count,
				cl_bitfield forbidden)
{
	cl_bitfield flags = 0;
	size_t size = 0;
	cl_context context = NULL;
	cl_uint type = CL_MEM_OBJECT_BUFFER;
	cl_int error = device->cl->clGetMemObjectInfo(mem, CL_MEM_SIZE, sizeof size, &size, NULL);
	if (error == CL_SUCCESS)
		error = device->cl->clGetMemObjectInfo(mem, CL_MEM_CONTEXT, sizeof context, &context, NULL);
	if (error == CL_SUCCESS)
		error = device->cl->clGetMemObjectInfo(mem, CL_MEM_TYPE, sizeof type, &type, NULL);
	if (error == CL_SUCCESS)
		error = device->cl->clGetMemObjectInfo(mem, CL_MEM_FLAGS, sizeof flags, &flags, NULL);
	if (error == CL_INVALID_MEM_OBJECT || (error == CL_SUCCESS && type != CL_MEM_OBJECT_BUFFER))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "batch->%s is not an OpenCL buffer", name);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clGetMemObjectInfo", error);
	if (context != device->context)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "batch->%s belongs to another context than the device", name);
	if (size / 4 < count)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "batch->%s holds %lu bytes, too few for %lu elements", name,
				 (unsigned long)size, (unsigned long)count);
	if (flags & forbidden)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "batch->%s was made with %s", name,
				 forbidden == CL_MEM_READ_ONLY ? "CL_MEM_READ_ONLY, and is written"
							       : "CL_MEM_WRITE_ONLY, and is read");
	return LOBE_OK;
}

static lobe_status take_buffers(lobe_cl_shading *b, const lobe_job *job)
{
	lobe_status status = LOBE_OK;
	int i;
	for (i = 0; i < LOBE_IN_COUNT && status == LOBE_OK; i++) {
		b->in[i] = (cl_mem)(void *)at(job->in[i], 0);
		status = check_buffer(b->device, b->in[i],
				      lobe_array_name(lobe_verb_is_sample(b->verb), LOBE_OUT_COUNT + i), job->count,
				      CL_MEM_WRITE_ONLY);
	}
	if (job->material && status == LOBE_OK) {
		b->material = (cl_mem)(void *)at(job->material, 0);
		status = check_buffer(b->device, b->material, "material", job->count, CL_MEM_WRITE_ONLY);
	}
	for (i = 0; i < LOBE_OUT_COUNT && status == LOBE_OK; i++) {
		if (b->wanted[i]) {
			b->out[i] = (cl_mem)job->out[i];
			status = check_buffer(b->device, b->out[i], lobe_array_name(lobe_verb_is_sample(b->verb), i),
					      job->count, CL_MEM_READ_ONLY);
		}
	}
	return status;
}

/* The materials as a host array, the caller's to free, each checked to be one of the scene's. */
static lobe_status read_materials(const lobe_cl_shading *b, size_t count, uint32_t **out)
{
	uint32_t *const material = count <= SIZE_MAX / 4 ? malloc(4 * count) : NULL;
	cl_int error;
	size_t i;
	if (!material)
		return lobe_out_of_memory("the materials of a batch");
	error = b->device->cl->clEnqueueReadBuffer(b->lane->queue, b->material, CL_TRUE, 0, 4 * count, material, 0,
						   NULL, NULL);
	if (error != CL_SUCCESS) {
		free(material);
		return lobe_cl_fail("clEnqueueReadBuffer", error);
	}
	for (i = 0; i < count && material[i] < b->scene->count; i++)
		;
	if (i < count) {
		const lobe_status status =
			lobe_fail(LOBE_ERROR_ARGUMENT, "batch->material[%lu] is %lu, but the scene has %lu materials",
				  (unsigned long)i, (unsigned long)material[i], (unsigned long)b->scene->count);
		free(material);
		return status;
	}
	*out = material;
	return LOBE_OK;
}

static lobe_status run_buffers(lobe_cl_shading *b, const lobe_job *job)
{
	const lobe_cl_scene *const state = b->scene->state;
	uint32_t *material = NULL;
	cl_int error;
	lobe_status status = take_buffers(b, job);
	if (status == LOBE_OK)
		status = lobe_cl_add_scratch(b, job->count);
	if (status == LOBE_OK && b->material && state->lobe_count > 1)
		status = read_materials(b, job->count, &material);
	if (status == LOBE_OK)
		status = lobe_cl_enqueue(b, material, job->count);
	free(material);
	if (status != LOBE_OK)
		return status;
	error = b->device->cl->clFlush(b->lane->queue);
	return error == CL_SUCCESS ? LOBE_OK : lobe_cl_fail("clFlush", error);
}

lobe_status lobe_cl_run_device(lobe_scene *scene, const lobe_job *job)
{
	lobe_cl_device *const device = (lobe_cl_device *)scene->device;
	lobe_status status;
	lobe_cl_shading b;
	pthread_mutex_lock(&device->lock);
	start_batch(&b, scene, job);
	status = run_buffers(&b, job);
	pthread_mutex_unlock(&device->lock);
	return status;
}
