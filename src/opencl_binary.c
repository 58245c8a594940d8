/* opencl_binary.c - binaries of OpenCL programs, kept in the cache between runs. */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "opencl_cache.h"
#include "opencl_device.h"

enum { TEXT_SIZE = 1024 };

/* Names and versions: a driver that changes one of them may have changed its compiler. *pocl: it is PoCL. */
static int describe(const lobe_cl_device *device, char *out, size_t size, int *pocl)
{
	const lobe_cl_functions *const cl = device->cl;
	cl_platform_id platform = NULL;
	char text[5][TEXT_SIZE];
	cl_int error;
	memset(text, 0, sizeof text);
	error = cl->clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetPlatformInfo(platform, CL_PLATFORM_NAME, TEXT_SIZE, text[0], NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetPlatformInfo(platform, CL_PLATFORM_VERSION, TEXT_SIZE, text[1], NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetDeviceInfo(device->id, CL_DEVICE_NAME, TEXT_SIZE, text[2], NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetDeviceInfo(device->id, CL_DEVICE_VERSION, TEXT_SIZE, text[3], NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetDeviceInfo(device->id, CL_DRIVER_VERSION, TEXT_SIZE, text[4], NULL);
	if (error != CL_SUCCESS)
		return 0;
	*pocl = strcmp(text[0], LOBE_CL_POCL) == 0;
	snprintf(out, size, "platform %s, %s\ndevice %s, %s\ndriver %s\n", text[0], text[1], text[2], text[3], text[4]);
	return 1;
}

/* PoCL compiles a kernel when it is launched, and all kernels of a program when it is asked for a binary, which takes
 * three times as long as building the program: 1.4 s for the 15 kernels of a lobe, where most scenes launch one or two.
 * It has a cache of its own, from which a second start takes 50 ms. So there ours serves only whoever asks for it, and
 * then takes the binary again when kernels have been launched that it lacks, which costs little the second time. */
void lobe_cl_binary_find_key(const lobe_cl_device *device, lobe_cl_program *p, const char *const source[3])
{
	char description[6 * TEXT_SIZE];
	size_t length;
	if (!describe(device, description, sizeof description, &p->grows) || (p->grows && !lobe_cl_cache_asked_for()))
		return;
	length = strlen(description) + strlen("options \n") + strlen(p->options) + strlen(source[0]) +
		 strlen(source[1]) + strlen(source[2]);
	p->key = malloc(length + 1);
	if (!p->key)
		return;
	snprintf(p->key, length + 1, "%soptions %s\n%s%s%s", description, p->options, source[0], source[1], source[2]);
	p->key_size = length;
}

void lobe_cl_binary_load(lobe_cl_device *device, lobe_cl_program *p)
{
	const lobe_cl_functions *const cl = device->cl;
	cl_int error = CL_SUCCESS, taken = CL_SUCCESS;
	size_t size = 0;
	unsigned char *const binary = p->key ? lobe_cl_cache_get(p->key, p->key_size, &size) : NULL;
	const unsigned char *from = binary;
	cl_program program;
	if (!binary)
		return;
	program = cl->clCreateProgramWithBinary(device->context, 1, &device->id, &size, &from, &taken, &error);
	free(binary);
	if (!program)
		return;
	if (taken == CL_SUCCESS && cl->clBuildProgram(program, 1, &device->id, p->options, NULL, NULL) == CL_SUCCESS) {
		p->program = program;
		p->kept_size = size;
	} else {
		cl->clReleaseProgram(program);
	}
}

/* A program in a context of several devices has a binary for each, and is not kept. */
void lobe_cl_binary_store(lobe_cl_device *device, lobe_cl_program *p)
{
	const lobe_cl_functions *const cl = device->cl;
	size_t size = 0;
	unsigned char *binary;
	if (!p->key ||
	    cl->clGetProgramInfo(p->program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL) != CL_SUCCESS ||
	    size == 0 || size == p->kept_size)
		return;
	binary = malloc(size);
	if (binary && cl->clGetProgramInfo(p->program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL) == CL_SUCCESS) {
		lobe_cl_cache_put(p->key, p->key_size, binary, size);
		p->kept_size = size;
	}
	free(binary);
}

void lobe_cl_binaries_update(lobe_cl_device *device)
{
	lobe_cl_program *p;
	for (p = device->programs; p; p = p->next) {
		if (p->grows && p->outgrown)
			lobe_cl_binary_store(device, p);
		p->outgrown = 0;
	}
}
