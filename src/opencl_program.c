/* opencl_program.c - OpenCL scenes: the program for a scene's lobes, its kernels, its tables on the device. */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "opencl_device.h"

/* LOBE_ERROR_BUILD with the beginning of the compiler's log. */
static lobe_status build_failed(lobe_cl_device *device, cl_program program, cl_int error)
{
	const lobe_cl_functions *const cl = device->cl;
	size_t size = 0;
	char *log = NULL;
	lobe_status status;
	if (error == CL_OUT_OF_HOST_MEMORY || error == CL_OUT_OF_RESOURCES || error == CL_MEM_OBJECT_ALLOCATION_FAILURE)
		return lobe_cl_fail("clBuildProgram", error);
	if (cl->clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size) == CL_SUCCESS)
		log = calloc(size + 1, 1);
	if (log && size)
		cl->clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
	status = lobe_fail(LOBE_ERROR_BUILD, "clBuildProgram failed: %s (%d)\n%.2000s", lobe_cl_error_name(error),
			   (int)error, log && *log ? log : "(no log)");
	free(log);
	return status;
}

static lobe_status build_source(lobe_cl_device *device, const char *source[3], const char *options, cl_program *out)
{
	const lobe_cl_functions *const cl = device->cl;
	cl_int error = CL_SUCCESS;
	const cl_program program = cl->clCreateProgramWithSource(device->context, 3, source, NULL, &error);
	if (!program)
		return lobe_cl_fail("clCreateProgramWithSource", error);
	error = cl->clBuildProgram(program, 1, &device->id, options, NULL, NULL);
	if (error != CL_SUCCESS) {
		const lobe_status status = build_failed(device, program, error);
		cl->clReleaseProgram(program);
		return status;
	}
	*out = program;
	return LOBE_OK;
}

/* From the cache, else from source and into the cache. mixed: with the kernels for batches of several lobes. */
static lobe_status build(lobe_cl_device *device, lobe_cl_program *p, int mixed)
{
	const char *source[3];
	char switches[64];
	lobe_status status = LOBE_OK;
	snprintf(switches, sizeof switches, "#define LOBE_LOOPS %d\n#define LOBE_MIXED %d\n", device->loops, mixed);
	source[0] = lobe_opencl_source();
	source[1] = switches;
	source[2] = lobe_opencl_kernels();
	lobe_cl_binary_find_key(device, p, source);
	lobe_cl_binary_load(device, p);
	if (!p->program) {
		status = build_source(device, source, p->options, &p->program);
		if (status == LOBE_OK && !p->grows)
			lobe_cl_binary_store(device, p);
	}
	if (status != LOBE_OK || !p->grows) {
		free(p->key);
		p->key = NULL;
	}
	return status;
}

/* The device's program of these options, built when it is the first. mixed: options name several lobes. */
static lobe_status get_program(lobe_cl_device *device, const char *options, int mixed, lobe_cl_program **out)
{
	const size_t size = strlen(options) + 1;
	lobe_cl_program *p;
	lobe_status status;
	for (p = device->programs; p; p = p->next) {
		if (strcmp(p->options, options) == 0) {
			*out = p;
			return LOBE_OK;
		}
	}
	p = calloc(1, sizeof *p + size);
	if (!p)
		return lobe_out_of_memory("an OpenCL program");
	memcpy(p->options, options, size);
	status = build(device, p, mixed);
	if (status != LOBE_OK) {
		free(p);
		return status;
	}
	p->next = device->programs;
	device->programs = p;
	*out = p;
	return LOBE_OK;
}

void lobe_cl_programs_release(lobe_cl_device *device)
{
	const lobe_cl_functions *const cl = device->cl;
	lobe_cl_binaries_update(device);
	while (device->programs) {
		lobe_cl_program *const p = device->programs;
		lobe_cl_kernel *const shade = &p->shade[0][0][0];
		size_t i;
		for (i = 0; i < sizeof p->shade / sizeof *shade; i++) {
			if (shade[i].kernel)
				cl->clReleaseKernel(shade[i].kernel);
		}
		for (i = 0; i < LOBE_VERB_COUNT; i++) {
			if (p->mixed[i].kernel)
				cl->clReleaseKernel(p->mixed[i].kernel);
		}
		if (p->zero.kernel)
			cl->clReleaseKernel(p->zero.kernel);
		if (p->zero_mixed.kernel)
			cl->clReleaseKernel(p->zero_mixed.kernel);
		cl->clReleaseProgram(p->program);
		device->programs = p->next;
		free(p->key);
		free(p);
	}
}

static lobe_status make_kernel(lobe_cl_device *device, cl_program program, const char *name, lobe_cl_kernel *out)
{
	const lobe_cl_functions *const cl = device->cl;
	size_t limit = 0, local = device->local;
	cl_int error = CL_SUCCESS;
	const cl_kernel kernel = cl->clCreateKernel(program, name, &error);
	if (!kernel)
		return lobe_cl_fail("clCreateKernel", error);
	error = cl->clGetKernelWorkGroupInfo(kernel, device->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof limit, &limit, NULL);
	if (error != CL_SUCCESS) {
		cl->clReleaseKernel(kernel);
		return lobe_cl_fail("clGetKernelWorkGroupInfo", error);
	}
	while (local > 1 && local > limit)
		local /= 2;
	out->kernel = kernel;
	out->local = local;
	return LOBE_OK;
}

lobe_status lobe_cl_kernel_get(lobe_cl_device *device, lobe_cl_program *program, int lobe, int verb, int how,
			       lobe_cl_kernel *out)
{
#define LOBE_VERB(NAME, name) #name,
	static const char *const verbs[] = {LOBE_VERBS(LOBE_VERB)};
#undef LOBE_VERB
	static const char *const hows[] = {"one", "many", "mixed"};
	lobe_cl_kernel *kept;
	lobe_status status = LOBE_OK;
	char name[128];
	if (lobe == LOBE_CL_EVERY_LOBE) {
		kept = &program->mixed[verb];
		snprintf(name, sizeof name, "lobe_kernel_mixed_%s", verbs[verb]);
	} else if (lobe == LOBE_CL_NO_LOBE) {
		kept = how == LOBE_CL_MIXED ? &program->zero_mixed : &program->zero;
		snprintf(name, sizeof name, "lobe_kernel_zero%s", how == LOBE_CL_MIXED ? "_mixed" : "");
	} else {
		kept = &program->shade[lobe][verb][how];
		snprintf(name, sizeof name, "lobe_kernel_%s_%s_%s", lobe_param_name[lobe], verbs[verb], hows[how]);
	}
	if (!kept->kernel) {
		status = make_kernel(device, program->program, name, kept);
		program->outgrown = 1;
	}
	if (status == LOBE_OK)
		*out = *kept;
	return status;
}

/* A constant array on the device. */
static lobe_status upload(lobe_cl_device *device, const void *data, size_t size, cl_mem *out)
{
	cl_int error = CL_SUCCESS;
	/* OpenCL asks for a pointer to non-const, and only reads from it. */
	const cl_mem mem = device->cl->clCreateBuffer(device->context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, size,
						      (void *)data, &error);
	if (!mem)
		return lobe_cl_fail("clCreateBuffer", error);
	*out = mem;
	return LOBE_OK;
}

/* One number of each material. */
static lobe_status upload_numbers(lobe_cl_device *device, const lobe_scene *scene, const uint32_t *of_index,
				  const uint32_t *of_material, uint32_t of_none, cl_mem *out)
{
	uint32_t *const number = malloc(scene->count * sizeof *number);
	lobe_status status;
	size_t i;
	if (!number)
		return lobe_out_of_memory("a scene's materials");
	for (i = 0; i < scene->count; i++) {
		const uint32_t index = scene->index[i];
		number[i] = index == LOBE_INDEX_NONE ? of_none : of_index ? of_index[index] : of_material[i];
	}
	status = upload(device, number, scene->count * sizeof *number, out);
	free(number);
	return status;
}

static lobe_status fill_state(lobe_cl_device *device, const lobe_scene *scene, lobe_cl_scene *state)
{
	uint32_t number[LOBE_COUNT];
	lobe_status status;
	int lobe;
	for (lobe = 0; lobe < LOBE_COUNT; lobe++) {
		if (scene->table[lobe].count == 0)
			continue;
		number[lobe] = (uint32_t)state->lobe_count++;
		state->last_lobe = lobe;
	}
	status = get_program(device, scene->options, state->lobe_count > 1, &state->program);
	for (lobe = 0; lobe < LOBE_COUNT && status == LOBE_OK; lobe++) {
		const size_t count = scene->table[lobe].count;
		if (count == 0)
			continue;
		status = upload(device, scene->table[lobe].params, count * lobe_param_size[lobe], &state->table[lobe]);
	}
	if (status == LOBE_OK && scene->table_words)
		status = upload(device, scene->tables, scene->table_words * sizeof *scene->tables, &state->tables);
	if (status == LOBE_OK)
		status = upload_numbers(device, scene, NULL, scene->slot, LOBE_CL_NO_SLOT, &state->slot);
	if (status == LOBE_OK && device->loops && state->lobe_count > 1)
		status = upload_numbers(device, scene, number, NULL, (uint32_t)state->lobe_count, &state->number);
	return status;
}

static void release_state(lobe_cl_device *device, lobe_cl_scene *state)
{
	int lobe;
	for (lobe = 0; lobe < LOBE_COUNT; lobe++) {
		if (state->table[lobe])
			device->cl->clReleaseMemObject(state->table[lobe]);
	}
	if (state->tables)
		device->cl->clReleaseMemObject(state->tables);
	if (state->slot)
		device->cl->clReleaseMemObject(state->slot);
	if (state->number)
		device->cl->clReleaseMemObject(state->number);
	free(state);
}

lobe_status lobe_cl_scene_create(lobe_scene *scene)
{
	lobe_cl_device *const device = (lobe_cl_device *)scene->device;
	lobe_cl_scene *const state = calloc(1, sizeof *state);
	lobe_status status;
	if (!state)
		return lobe_out_of_memory("a scene on OpenCL");
	pthread_mutex_lock(&device->lock);
	status = fill_state(device, scene, state);
	pthread_mutex_unlock(&device->lock);
	if (status == LOBE_OK)
		scene->state = state;
	else
		release_state(device, state);
	return status;
}

/* Commands that still use the tables hold references of their own. */
void lobe_cl_scene_destroy(lobe_scene *scene) { release_state((lobe_cl_device *)scene->device, scene->state); }
