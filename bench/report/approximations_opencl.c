/* approximations_opencl.c - the ways as OpenCL kernels, with the library's source before them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../timing.h"
#include "approximations.h"
#include "csv.h"
#include "opencl_device.h"

#define TEXT_(...) #__VA_ARGS__
#define TEXT(...)  TEXT_(__VA_ARGS__)

/* What OpenCL has of its own for GROUP_REAL. It has no inverse of erf. */
const approximations_builtin approximations_builtins[] = {
	{"builtin_sin_2pi", "sin_2pi/OpenCL", "sinpi(2.0f * x)"},
	{"builtin_cos_2pi", "cos_2pi/OpenCL", "cospi(2.0f * x)"},
	{"builtin_sin", "sin/OpenCL", "sin(x)"},
	{"builtin_exp", "exp/OpenCL", "exp(x)"},
	{"builtin_log", "log/OpenCL", "log(x)"},
	{"builtin_pow", "pow/OpenCL", "pow(x, y)"},
	{"builtin_erf", "erf/OpenCL", "erf(x)"},
	{"builtin_acos", "acos/OpenCL", "acos(x)"},
	{"builtin_atan2", "atan2/OpenCL", "atan2(x, y)"},
};
size_t approximations_builtin_count(void) { return sizeof approximations_builtins / sizeof *approximations_builtins; }

struct approximations_device {
	lobe_device *device;
	lobe_scene *scene;
	const lobe_cl_functions *cl;
	cl_context context;
	cl_device_id id;
	cl_command_queue queue;
	cl_program program;
};

static const char kernel_head[] = "(approximations_set p, __global const float *a, __global const float *b,\n"
				  "__global const float *c, __global const float *d, __global const float *e,\n"
				  "__global float *r0, __global float *r1, __global float *r2)\n"
				  "{ const uint i = get_global_id(0);\n"
				  "const lobe_real x = a[i], y = b[i], z = c[i], s = d[i], t = e[i];\n";

static char *program_text(void)
{
	report_rows text = {NULL, 0, 0};
	report_row(&text, "%s", TEXT(APPROXIMATIONS_SET));
	report_row(&text, "%s", TEXT(APPROXIMATIONS_HELPERS));
	for (size_t w = 0; w < approximations_way_count(); w++) {
		const approximations_way *way = &approximations_ways[w];
		if (way->text)
			report_row(&text,
				   way->outputs == 1 ? "__kernel void %s%s r0[i] = %s; }"
						     : "__kernel void %s%s const lobe_rgb v = %s; r0[i] = v.r; "
						       "r1[i] = v.g; r2[i] = v.b; }",
				   way->id, kernel_head, way->text);
	}
	for (size_t b = 0; b < approximations_builtin_count(); b++)
		report_row(&text, "__kernel void %s%s r0[i] = %s; }", approximations_builtins[b].id, kernel_head,
			   approximations_builtins[b].text);
	return text.text;
}

static int say(const char *what, cl_int code)
{
	if (code != CL_SUCCESS)
		fprintf(stderr, "report: OpenCL: %s failed (%d)\n", what, (int)code);
	return code != CL_SUCCESS;
}

approximations_device *approximations_device_open(void)
{
	size_t count = 0;
	cl_int code;
	if (lobe_device_count("opencl", &count) != LOBE_OK || count == 0) {
		fputs("report: no OpenCL device here: its rows are left out\n", stderr);
		return NULL;
	}
	approximations_device *d = report_alloc(NULL, sizeof *d);
	memset(d, 0, sizeof *d);
	/* A scene that needs the comparison lobes alone: its options leave the rest out of the program. */
	const lobe_bsdf material = lobe_bsdf_from_microfacet_conductor(lobe_microfacet_conductor_make(
		lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
				       lobe_linear_make(0.5f, 0.0f, 0.0f, 0.5f, 0.0f, 0.0f)),
		lobe_fresnel_model_constant(lobe_rgb_make(1.0f, 1.0f, 1.0f)), LOBE_STRATEGY_VISIBLE));
	if (lobe_device_open(&d->device, "opencl") != LOBE_OK ||
	    lobe_device_cl(d->device, &d->context, &d->id, &d->queue) != LOBE_OK ||
	    lobe_scene_create(&d->scene, d->device, &material, 1) != LOBE_OK) {
		fprintf(stderr, "report: %s\n", lobe_error_message());
		approximations_device_close(d);
		return NULL;
	}
	d->cl = ((const lobe_cl_device *)(const void *)d->device)->cl;
	char *own = program_text();
	const char *sources[2] = {lobe_opencl_source(), own};
	d->program = d->cl->clCreateProgramWithSource(d->context, 2, sources, NULL, &code);
	if (say("clCreateProgramWithSource", code) ||
	    say("clBuildProgram",
		d->cl->clBuildProgram(d->program, 1, &d->id, lobe_opencl_options(d->scene), NULL, NULL))) {
		free(own);
		approximations_device_close(d);
		return NULL;
	}
	free(own);
	return d;
}

void approximations_device_close(approximations_device *device)
{
	if (device->program)
		device->cl->clReleaseProgram(device->program);
	lobe_scene_destroy(device->scene);
	lobe_device_close(device->device);
	free(device);
}

int approximations_device_run(approximations_device *device, const char *id, const approximations_set *set, size_t n,
			      const float *const in[APPROXIMATIONS_IN], float *out[APPROXIMATIONS_OUT], int rounds,
			      double *seconds)
{
	const lobe_cl_functions *cl = device->cl;
	const size_t local = 64, global = (n + local - 1) / local * local, bytes = global * sizeof(float);
	cl_mem buffers[APPROXIMATIONS_IN + APPROXIMATIONS_OUT] = {NULL};
	cl_int code;
	cl_kernel kernel = cl->clCreateKernel(device->program, id, &code);
	int failed = say(id, code);
	if (!failed)
		failed = say("clSetKernelArg", cl->clSetKernelArg(kernel, 0, sizeof *set, set));
	for (cl_uint k = 0; k < APPROXIMATIONS_IN + APPROXIMATIONS_OUT && !failed; k++) {
		buffers[k] = cl->clCreateBuffer(device->context, CL_MEM_READ_WRITE, bytes, NULL, &code);
		failed = say("clCreateBuffer", code) ||
			 say("clSetKernelArg", cl->clSetKernelArg(kernel, k + 1, sizeof buffers[k], &buffers[k]));
		if (!failed && k < APPROXIMATIONS_IN)
			failed = say("clEnqueueWriteBuffer",
				     cl->clEnqueueWriteBuffer(device->queue, buffers[k], CL_TRUE, 0, n * sizeof(float),
							      in[k], 0, NULL, NULL));
	}
	for (int r = 0; r < rounds && !failed; r++) {
		const double start = bench_now();
		failed = say("clEnqueueNDRangeKernel", cl->clEnqueueNDRangeKernel(device->queue, kernel, 1, NULL,
										  &global, &local, 0, NULL, NULL)) ||
			 say("clFinish", cl->clFinish(device->queue));
		if (seconds)
			seconds[r] = bench_now() - start;
	}
	for (int k = 0; k < APPROXIMATIONS_OUT && !failed; k++)
		if (out[k])
			failed = say("clEnqueueReadBuffer",
				     cl->clEnqueueReadBuffer(device->queue, buffers[APPROXIMATIONS_IN + k], CL_TRUE, 0,
							     n * sizeof(float), out[k], 0, NULL, NULL));
	for (int k = 0; k < APPROXIMATIONS_IN + APPROXIMATIONS_OUT; k++)
		if (buffers[k])
			cl->clReleaseMemObject(buffers[k]);
	if (kernel)
		cl->clReleaseKernel(kernel);
	return failed;
}
