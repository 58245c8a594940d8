/* own_kernel.c - an OpenCL kernel of your own on top of lobe: the albedo of a metal by sampling, for a row of angles,
 * and the same in C from the same text, which gives the same bits.
 *
 *	cc -std=c99 -O2 -ffp-contract=off -Iinclude examples/own_kernel.c build/liblobe.a -lOpenCL -lm -ldl -lpthread */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/lobe.h"

enum { ANGLES = 9, SAMPLES = 1 << 16 };

/* What stands in here is compiled as C and kept as text for OpenCL. Macros are not expanded in the text; both sides
 * have lobe's. Sums and products stand alone: write lobe_fma(a, b, c) where a*b + c is meant. */
#define SHARED(...) __VA_ARGS__ static const char shared_source[] = #__VA_ARGS__ "\n"

/* clang-format off */
SHARED(
	/* 24 bits of a hash of a counter (Wellons' lowbias32), in [0,1). */
	LOBE_FN lobe_real own_random(lobe_uint counter)
	{
		counter ^= counter >> 16;
		counter *= 0x7feb352du;
		counter ^= counter >> 15;
		counter *= 0x846ca68bu;
		counter ^= counter >> 16;
		return (lobe_real)(counter >> 8) * LOBE_R(0x1p-24);
	}

	LOBE_FN lobe_rgb own_albedo(lobe_ggx_conductor metal, lobe_real turns, lobe_uint samples)
	{
		const lobe_sincos angle = lobe_sincos_2pi(turns);
		const lobe_vec3 wo = lobe_vec3_make(angle.s, LOBE_R(0.0), angle.c);
		lobe_rgb sum = lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
		for (lobe_uint i = 0; i < samples; i++) {
			const lobe_vec3 u =
				lobe_vec3_make(own_random(3 * i), own_random(3 * i + 1), own_random(3 * i + 2));
			const lobe_rgb weight = lobe_ggx_conductor_sample(metal, wo, u).weight;
			sum = lobe_rgb_make(sum.r + weight.r, sum.g + weight.g, sum.b + weight.b);
		}
		return lobe_rgb_scale(sum, LOBE_R(1.0) / (lobe_real)samples);
	}
);
/* clang-format on */

/* The kernel: a lobe's prepared constants are a plain struct, passed as it is. */
static const char kernel_source[] =
	"__kernel void albedo(lobe_ggx_conductor metal, uint samples, __global lobe_rgb *result)\n"
	"{\n"
	"	const uint i = get_global_id(0);\n"
	"	result[i] = own_albedo(metal, (lobe_real)i / 40.0f, samples);\n"
	"}\n";

static void check(cl_int code, const char *what)
{
	if (code == CL_SUCCESS)
		return;
	fprintf(stderr, "own_kernel: %s failed (%d)\n", what, code);
	exit(1);
}

int main(void)
{
	const lobe_ggx_conductor gold =
		lobe_ggx_conductor_make(0.25f, 0.25f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD));
	const lobe_bsdf material = lobe_bsdf_from_ggx_conductor(gold);
	const cl_uint samples = SAMPLES;
	const size_t angles = ANGLES;
	lobe_device *device;
	lobe_scene *scene;
	cl_context context;
	cl_device_id id;
	cl_command_queue queue;
	lobe_rgb result[ANGLES];
	cl_int code;
	size_t count;

	if (lobe_device_count("opencl", &count) != LOBE_OK || count == 0) {
		puts("own_kernel: no OpenCL device here");
		return 0;
	}
	/* lobe picks the device and says which options its source needs; a context of your own would do as well. The
	 * scene serves to leave out of the program all lobes but one: lobe_opencl_options(NULL) keeps them all. */
	if (lobe_device_open(&device, "opencl") != LOBE_OK ||
	    lobe_device_cl(device, &context, &id, &queue) != LOBE_OK ||
	    lobe_scene_create(&scene, device, &material, 1) != LOBE_OK) {
		fprintf(stderr, "own_kernel: %s\n", lobe_error_message());
		return 1;
	}
	const char *sources[] = {lobe_opencl_source(), shared_source, kernel_source};
	cl_program program = clCreateProgramWithSource(context, 3, sources, NULL, &code);
	check(code, "clCreateProgramWithSource");
	check(clBuildProgram(program, 1, &id, lobe_opencl_options(scene), NULL, NULL), "clBuildProgram");
	cl_kernel kernel = clCreateKernel(program, "albedo", &code);
	check(code, "clCreateKernel");
	cl_mem buffer = clCreateBuffer(context, CL_MEM_WRITE_ONLY, sizeof result, NULL, &code);
	check(code, "clCreateBuffer");
	check(clSetKernelArg(kernel, 0, sizeof gold, &gold), "clSetKernelArg");
	check(clSetKernelArg(kernel, 1, sizeof samples, &samples), "clSetKernelArg");
	check(clSetKernelArg(kernel, 2, sizeof buffer, &buffer), "clSetKernelArg");
	check(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &angles, NULL, 0, NULL, NULL), "clEnqueueNDRangeKernel");
	check(clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, sizeof result, result, 0, NULL, NULL),
	      "clEnqueueReadBuffer");

	int differing = 0;
	printf("albedo of gold, alpha 0.25, %d samples an angle, on %s\n", SAMPLES, lobe_device_name(device));
	printf("%8s %10s %10s %10s\n", "angle", "red", "green", "blue");
	for (int i = 0; i < ANGLES; i++) {
		const lobe_rgb here = own_albedo(gold, (float)i / 40.0f, SAMPLES);
		differing += memcmp(&here, &result[i], sizeof here) != 0;
		printf("%4d deg %10.6f %10.6f %10.6f\n", 9 * i, (double)result[i].r, (double)result[i].g,
		       (double)result[i].b);
	}
	printf("compared with the same function in C, differing: %d\n", differing);

	clReleaseMemObject(buffer);
	clReleaseKernel(kernel);
	clReleaseProgram(program);
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	return differing != 0;
}
