/* hand_opencl.c - ggx_conductor on an OpenCL device: the library's batch of device buffers against a kernel of the
 * user's own over lobe_opencl_source(). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hand.h"
#include "opencl_api.h"
#include "race.h"

enum { ARRAYS = 6 + 8 };

/* The same shape as the library's (cl/kernels.cl): one element in a work-item of a GPU, many in one of a processor, in
 * vectors as wide, and as many at a time. */
#define LOOP(vectors)                                                                                                  \
	"	const ulong begin = get_global_id(0) * (ulong)RUN, end = min(begin + (ulong)RUN, n);\n"                      \
	"	const lobe_ggx_conductor p = given[0];\n"                                                                    \
	"#if defined(__clang__) && defined(__AVX512VL__)\n"                                                            \
	"#pragma clang diagnostic ignored \"-Wpass-failed\"\n"                                                         \
	"#pragma clang loop vectorize_width(16) interleave_count(" vectors ")\n"                                       \
	"#endif\n"                                                                                                     \
	"	for (ulong i = begin; i < end; i++) {\n"
#define IN(a)  "__global const float *restrict " #a ", "
#define OUT(a) "__global float *restrict " #a ", "

static const char eval_source[] = "\n__kernel void hand(__global const lobe_ggx_conductor *restrict given, " IN(ox)
	IN(oy) IN(oz) IN(ix) IN(iy) IN(iz) OUT(r) OUT(g) OUT(b)
		OUT(pdf) "ulong n)\n{\n" LOOP("1") "		const lobe_vec3 wo = lobe_vec3_make(ox[i], oy[i], oz[i]), wi = "
			 "lobe_vec3_make(ix[i], iy[i], iz[i]);\n"
			 "		const lobe_rgb f = lobe_ggx_conductor_eval(p, wo, wi);\n"
			 "		r[i] = f.r;\n		g[i] = f.g;\n		b[i] = f.b;\n"
			 "		pdf[i] = lobe_ggx_conductor_pdf(p, wo, wi);\n	}\n}\n";

static const char sample_source[] = "\n__kernel void hand(__global const lobe_ggx_conductor *restrict given, " IN(ox)
	IN(oy) IN(oz) IN(ux) IN(uy) IN(uz) OUT(x) OUT(y) OUT(z) OUT(r) OUT(g) OUT(b) OUT(
		pdf) "__global uint *restrict event, ulong n)\n{\n" LOOP("2")
		     "		const lobe_sample s = lobe_ggx_conductor_sample(p, lobe_vec3_make(ox[i], oy[i], "
		     "oz[i]),\n"
		     "						lobe_vec3_make(ux[i], uy[i], uz[i]));\n"
		     "		x[i] = s.wi.x;\n		y[i] = s.wi.y;\n		z[i] = s.wi.z;\n"
		     "		r[i] = s.weight.r;\n		g[i] = s.weight.g;\n		b[i] = s.weight.b;\n"
		     "		pdf[i] = s.pdf;\n		event[i] = s.event;\n	}\n}\n";

typedef struct {
	const lobe_cl_functions *cl;
	lobe_device *device;
	lobe_scene *scene;
	cl_context context;
	cl_device_id id;
	cl_command_queue queue;
	cl_program program;
	cl_kernel kernel;
	cl_mem given, array[ARRAYS];
	lobe_cl_batch batch;
	int sample;
	size_t n, run, local;
} work;

static int run_library(const void *context)
{
	const work *w = context;
	const lobe_status status =
		w->sample ? lobe_scene_sample_cl(w->scene, &w->batch) : lobe_scene_eval_cl(w->scene, &w->batch);
	return status == LOBE_OK && w->cl->clFinish(w->queue) == CL_SUCCESS;
}

static int run_hand(const void *context)
{
	const work *w = context;
	const size_t share = w->run * w->local, global = (w->n + share - 1) / share * w->local;
	return w->cl->clEnqueueNDRangeKernel(w->queue, w->kernel, 1, NULL, &global, &w->local, 0, NULL, NULL) ==
		       CL_SUCCESS &&
	       w->cl->clFinish(w->queue) == CL_SUCCESS;
}

/* Inputs that every bench has, in buffers of the device; outputs after them. */
static int make_buffers(work *w, const bench_arrays *a)
{
	const size_t size = 4 * w->n;
	cl_int error;
	for (int k = 0; k < ARRAYS; k++) {
		float *const *const second = w->sample ? a->u : a->wi;
		void *const from = k < 3 ? a->wo[k] : (k < 6 ? second[k - 3] : NULL);
		const cl_bitfield how = CL_MEM_READ_WRITE | (from ? CL_MEM_COPY_HOST_PTR : 0);
		w->array[k] = w->cl->clCreateBuffer(w->context, how, size, from, &error);
		if (!w->array[k])
			return 0;
	}
	w->batch.count = w->n;
	for (int k = 0; k < 3; k++) {
		w->batch.wo[k] = w->array[k];
		if (w->sample) {
			w->batch.u[k] = w->array[3 + k];
			w->batch.sample_wi[k] = w->array[6 + k];
			w->batch.weight[k] = w->array[9 + k];
		} else {
			w->batch.wi[k] = w->array[3 + k];
			w->batch.f[k] = w->array[6 + k];
		}
	}
	w->batch.pdf = w->sample ? NULL : w->array[9];
	w->batch.sample_pdf = w->sample ? w->array[12] : NULL;
	w->batch.event = w->sample ? w->array[13] : NULL;
	return 1;
}

static int make_kernel(work *w, lobe_ggx_conductor *p)
{
	const char *const source[] = {lobe_opencl_source(), w->sample ? sample_source : eval_source};
	const int outputs = w->sample ? 8 : 4;
	char options[4096];
	cl_bitfield type = 0;
	cl_int error = CL_SUCCESS;
	cl_uint at = 0;
	const cl_ulong n = w->n;
	w->cl->clGetDeviceInfo(w->id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
	w->run = type & CL_DEVICE_TYPE_CPU ? 16384 : 1;
	w->local = w->run > 1 ? 1 : 128;
	snprintf(options, sizeof options, "%s -DRUN=%zu", lobe_opencl_options(w->scene), w->run);
	w->program = w->cl->clCreateProgramWithSource(w->context, 2, (const char **)(uintptr_t)source, NULL, &error);
	if (!w->program || w->cl->clBuildProgram(w->program, 1, &w->id, options, NULL, NULL) != CL_SUCCESS)
		return 0;
	w->kernel = w->cl->clCreateKernel(w->program, "hand", &error);
	w->given = w->cl->clCreateBuffer(w->context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, sizeof *p, p, &error);
	if (!w->kernel || !w->given)
		return 0;
	error = w->cl->clSetKernelArg(w->kernel, at++, sizeof w->given, &w->given);
	for (int k = 0; k < 6 + outputs; k++)
		error |= w->cl->clSetKernelArg(w->kernel, at++, sizeof w->array[k], &w->array[k]);
	error |= w->cl->clSetKernelArg(w->kernel, at++, sizeof n, &n);
	return error == CL_SUCCESS;
}

static void release(work *w)
{
	if (w->kernel)
		w->cl->clReleaseKernel(w->kernel);
	if (w->program)
		w->cl->clReleaseProgram(w->program);
	if (w->given)
		w->cl->clReleaseMemObject(w->given);
	for (int k = 0; k < ARRAYS; k++)
		if (w->array[k])
			w->cl->clReleaseMemObject(w->array[k]);
	lobe_scene_destroy(w->scene);
}

/* Whether a run of each gives the same bits in the first output. */
static int same_bits(const work *w)
{
	float *const both[2] = {malloc(4 * w->n), malloc(4 * w->n)};
	int same = both[0] && both[1];
	for (int i = 0; same && i < 2; i++)
		same = (i ? run_hand(w) : run_library(w)) &&
		       w->cl->clEnqueueReadBuffer(w->queue, w->array[6], 1, 0, 4 * w->n, both[i], 0, NULL, NULL) ==
			       CL_SUCCESS;
	same = same && memcmp(both[0], both[1], 4 * w->n) == 0;
	free(both[0]);
	free(both[1]);
	return same;
}

int bench_hand_opencl(const bench_arrays *a, int verb, size_t n, size_t runs, bench_racer racer[2])
{
	work w = {.cl = lobe_cl_load(), .sample = bench_verb_samples(verb), .n = n};
	lobe_bsdf gold = bench_lobe_material(BENCH_LOBE_GGX_CONDUCTOR);
	if (!w.cl || lobe_device_open(&w.device, "opencl") != LOBE_OK)
		return -1;
	int ok = lobe_scene_create(&w.scene, w.device, &gold, 1) == LOBE_OK &&
		 lobe_device_cl(w.device, &w.context, &w.id, &w.queue) == LOBE_OK && make_buffers(&w, a) &&
		 make_kernel(&w, &gold.as.ggx_conductor);
	if (!ok)
		fprintf(stderr, "throughput: a kernel by hand cannot be made: %s\n", lobe_error_message());
	else if (!same_bits(&w)) {
		fprintf(stderr, "throughput: the kernel by hand gives other bits than the library\n");
		ok = 0;
	}
	racer[0] = (bench_racer){.run = run_library, .context = &w, .elements = (double)n, .base = 1};
	racer[1] = (bench_racer){.run = run_hand, .context = &w, .elements = (double)n, .base = 1};
	ok = ok && bench_race(racer, 2, runs);
	release(&w);
	lobe_device_close(w.device);
	return ok;
}
