/* opencl_launch.c - the kernels of an OpenCL batch whose arrays are on the device. */
#define _POSIX_C_SOURCE 200809L

#include "opencl_device.h"

/* Elements in one launch. */
#ifndef LOBE_CL_LAUNCH_MAX
#define LOBE_CL_LAUNCH_MAX ((size_t)1 << 30)
#endif

/* --- kept buffers --- */

lobe_status lobe_cl_grow(lobe_cl_device *device, lobe_cl_buffer *buffer, size_t count)
{
	const size_t size = count * 4;
	cl_int error = CL_SUCCESS;
	cl_mem mem;
	if (buffer->size >= size)
		return LOBE_OK;
	mem = device->cl->clCreateBuffer(device->context, CL_MEM_READ_WRITE, size, NULL, &error);
	if (!mem)
		return lobe_cl_fail("clCreateBuffer", error);
	if (buffer->mem)
		device->cl->clReleaseMemObject(buffer->mem);
	buffer->mem = mem;
	buffer->size = size;
	return LOBE_OK;
}

static void release(lobe_cl_device *device, lobe_cl_buffer *buffer)
{
	if (buffer->mem)
		device->cl->clReleaseMemObject(buffer->mem);
	buffer->mem = NULL;
	buffer->size = 0;
}

void lobe_cl_buffers_release(lobe_cl_device *device)
{
	int k, i;
	for (k = 0; k < LOBE_CL_LANES; k++) {
		lobe_cl_lane *const lane = &device->lane[k];
		for (i = 0; i < LOBE_IN_COUNT; i++)
			release(device, &lane->in[i]);
		for (i = 0; i < LOBE_OUT_COUNT; i++)
			release(device, &lane->out[i]);
		release(device, &lane->material);
		release(device, &lane->order);
	}
}

/* The arguments of a kernel, set one after another. The first error stays. */
typedef struct {
	lobe_cl_device *device;
	cl_command_queue queue;
	cl_kernel kernel;
	cl_uint next;
	cl_int error;
} arguments;

static void put(arguments *a, const void *value, size_t size)
{
	if (a->error == CL_SUCCESS)
		a->error = a->device->cl->clSetKernelArg(a->kernel, a->next++, size, value);
}

static arguments begin(const lobe_cl_shading *b, cl_kernel kernel)
{
	/* Arguments 0 to 2 are launch's. */
	const arguments a = {b->device, b->lane->queue, kernel, 3, CL_SUCCESS};
	return a;
}

static void put_mem(arguments *a, cl_mem mem) { put(a, &mem, sizeof mem); }

static void put_ulong(arguments *a, size_t value)
{
	const cl_ulong x = value;
	put(a, &x, sizeof x);
}

/* Elements of one work-item. A processor's units get a few each, so that one that is disturbed takes fewer; in whole
 * pages of floats, and up to as many as make what a work-item does before and after its loop not count (of 1024, 3
 * %). */
static size_t run_of(const lobe_cl_device *device, size_t count)
{
	const size_t page = 1024, most = 16 * page, few = 4;
	const size_t share = count / (few * device->units) / page * page;
	if (!device->loops)
		return 1;
	return share < page ? page : lobe_cl_smaller(share, most);
}

/* Enqueues the indices [first, last). Arguments 0 to 2 are set here, the others have been. */
static lobe_status launch(arguments *a, size_t local, size_t first, size_t last)
{
	const lobe_cl_functions *const cl = a->device->cl;
	while (first < last) {
		const size_t count = lobe_cl_smaller(last - first, LOBE_CL_LAUNCH_MAX);
		const size_t run = run_of(a->device, count), share = run * local;
		const size_t global = (count + share - 1) / share * local;
		cl_int error;
		a->next = 0;
		put_ulong(a, first);
		put_ulong(a, first + count);
		put_ulong(a, run);
		if (a->error != CL_SUCCESS)
			return lobe_cl_fail("clSetKernelArg", a->error);
		error = cl->clEnqueueNDRangeKernel(a->queue, a->kernel, 1, NULL, &global, &local, 0, NULL, NULL);
		if (error != CL_SUCCESS)
			return lobe_cl_fail("clEnqueueNDRangeKernel", error);
		first += count;
	}
	return LOBE_OK;
}

static void put_table(arguments *a, const lobe_cl_scene *state, int lobe)
{
	put_mem(a, state->table[lobe]);
	if (lobe_is_tabled(lobe))
		put_mem(a, state->tables);
}

static void put_arrays(arguments *a, const lobe_cl_shading *b)
{
	int i;
	for (i = 0; i < LOBE_IN_COUNT; i++)
		put_mem(a, b->in[i]);
	for (i = 0; i < LOBE_OUT_COUNT; i++) {
		if (lobe_verb_writes(b->verb, i))
			put_mem(a, b->out[i]);
	}
}

/* The elements of one lobe. first, last: elements, or places in order in the mixed case. */
static lobe_status shade(const lobe_cl_shading *b, int lobe, int how, size_t first, size_t last, size_t base)
{
	const lobe_cl_scene *const state = b->scene->state;
	const cl_uint slot_count = (cl_uint)b->scene->count;
	lobe_cl_kernel kernel;
	arguments a;
	lobe_status status;
	if (first == last)
		return LOBE_OK;
	status = lobe_cl_kernel_get(b->device, state->program, lobe, b->verb, how, &kernel);
	if (status != LOBE_OK)
		return status;
	a = begin(b, kernel.kernel);
	put_table(&a, state, lobe);
	if (how != LOBE_CL_ONE)
		put_mem(&a, state->slot);
	if (how == LOBE_CL_MANY)
		put(&a, &slot_count, sizeof slot_count);
	if (how != LOBE_CL_ONE)
		put_mem(&a, b->material);
	if (how == LOBE_CL_MIXED) {
		put_mem(&a, b->lane->order.mem);
		put_ulong(&a, base);
	}
	put_arrays(&a, b);
	return launch(&a, kernel.local, first, last);
}

/* The elements of all lobes, sorted by the work-items. */
static lobe_status shade_every(const lobe_cl_shading *b, size_t count)
{
	const lobe_cl_scene *const state = b->scene->state;
	lobe_cl_kernel kernel;
	arguments a;
	int lobe;
	const lobe_status status = lobe_cl_kernel_get(b->device, state->program, LOBE_CL_EVERY_LOBE, b->verb,
						      LOBE_CL_MIXED, &kernel);
	if (status != LOBE_OK)
		return status;
	a = begin(b, kernel.kernel);
	for (lobe = 0; lobe < LOBE_COUNT; lobe++) {
		if (state->table[lobe])
			put_table(&a, state, lobe);
	}
	put_mem(&a, state->number);
	put_mem(&a, state->slot);
	put_mem(&a, b->material);
	put_arrays(&a, b);
	return launch(&a, kernel.local, 0, count);
}

/* 0 to every wanted output, for elements of LOBE_KIND_NONE. */
static lobe_status zero(const lobe_cl_shading *b, int how, size_t first, size_t last, size_t base)
{
	const lobe_cl_scene *const state = b->scene->state;
	lobe_cl_kernel kernel;
	lobe_status status;
	int i;
	if (first == last)
		return LOBE_OK;
	status = lobe_cl_kernel_get(b->device, state->program, LOBE_CL_NO_LOBE, 0, how, &kernel);
	for (i = 0; i < LOBE_OUT_COUNT && status == LOBE_OK; i++) {
		arguments a;
		if (!b->wanted[i])
			continue;
		a = begin(b, kernel.kernel);
		if (how == LOBE_CL_MIXED) {
			put_mem(&a, b->lane->order.mem);
			put_ulong(&a, base);
		}
		put_mem(&a, b->out[i]);
		status = launch(&a, kernel.local, first, last);
	}
	return status;
}

/* Sorts elements [base, base + count) into lane->order; start as begin in lobe_sort_by_lobe. */
static lobe_status sort(const lobe_cl_shading *b, const uint32_t *material, size_t base, size_t count, size_t *start)
{
	const lobe_cl_functions *const cl = b->device->cl;
	lobe_cl_buffer *const kept = &b->lane->order;
	cl_int error = CL_SUCCESS;
	uint32_t *order;
	const lobe_status status = lobe_cl_grow(b->device, kept, count);
	if (status != LOBE_OK)
		return status;
	order = cl->clEnqueueMapBuffer(b->lane->queue, kept->mem, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, count * 4,
				       0, NULL, NULL, &error);
	if (!order)
		return lobe_cl_fail("clEnqueueMapBuffer", error);
	lobe_sort_by_lobe(b->scene, material + base, count, order, start);
	error = cl->clEnqueueUnmapMemObject(b->lane->queue, kept->mem, order, 0, NULL, NULL);
	if (error == CL_SUCCESS)
		return LOBE_OK;
	release(b->device, kept); /* It may still be mapped: the next batch gets a new one. */
	return lobe_cl_fail("clEnqueueUnmapMemObject", error);
}

/* Elements of several lobes: each lobe in a launch of its own. material: a host copy of b->material. */
static lobe_status shade_mixed(const lobe_cl_shading *b, const uint32_t *material, size_t count)
{
	const size_t limit = lobe_cl_smaller(LOBE_CL_LAUNCH_MAX, b->device->max_count);
	size_t start[LOBE_COUNT + 2];
	lobe_status status = LOBE_OK;
	size_t base = 0;
	int lobe;
	while (base < count && status == LOBE_OK) {
		const size_t n = lobe_cl_smaller(count - base, limit);
		status = sort(b, material, base, n, start);
		for (lobe = 0; lobe < LOBE_COUNT && status == LOBE_OK; lobe++) {
			if (start[lobe + 1] - start[lobe] == n)
				status = shade(b, lobe, LOBE_CL_MANY, base, base + n, 0);
			else
				status = shade(b, lobe, LOBE_CL_MIXED, start[lobe], start[lobe + 1], base);
		}
		if (status == LOBE_OK)
			status = zero(b, LOBE_CL_MIXED, start[LOBE_INDEX_NONE], start[LOBE_INDEX_NONE + 1], base);
		base += n;
	}
	return status;
}

lobe_status lobe_cl_enqueue(const lobe_cl_shading *b, const uint32_t *host_material, size_t count)
{
	const lobe_cl_scene *const state = b->scene->state;
	if (state->lobe_count == 0 || (!b->material && b->scene->index[0] == LOBE_INDEX_NONE))
		return zero(b, LOBE_CL_ONE, 0, count, 0);
	if (!b->material)
		return shade(b, (int)b->scene->index[0], LOBE_CL_ONE, 0, count, 0);
	if (state->lobe_count == 1)
		return shade(b, state->last_lobe, LOBE_CL_MANY, 0, count, 0);
	return b->device->loops ? shade_every(b, count) : shade_mixed(b, host_material, count);
}

lobe_status lobe_cl_add_scratch(lobe_cl_shading *b, size_t count)
{
	lobe_status status = LOBE_OK;
	int i;
	for (i = 0; i < LOBE_OUT_COUNT && status == LOBE_OK; i++) {
		if (b->wanted[i] || !lobe_verb_writes(b->verb, i))
			continue;
		status = lobe_cl_grow(b->device, &b->lane->out[i], count);
		b->out[i] = b->lane->out[i].mem;
	}
	return status;
}
