#include "opencl_kernel.h"

#include <stdint.h>
#include <stdio.h>

#include "lobe/lobe.h"
#include "opencl_api.h"
#include "unity.h"

int opencl_kernel_run(size_t k, const char *source, size_t count, const void *in, size_t in_size, void *out,
		      size_t out_size)
{
	const lobe_cl_functions *cl = lobe_cl_load();
	char name[32], options[1024], log[4096] = "";
	lobe_device *d;
	cl_context context;
	cl_device_id id;
	cl_command_queue queue;
	cl_int error;
	snprintf(name, sizeof name, "opencl:%zu", k);
	if (lobe_device_open(&d, name) != LOBE_OK) {
		printf("  skipped: %s: %s\n", name, lobe_error_message());
		return 0;
	}
	printf("  %s\n", lobe_device_name(d));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(d, &context, &id, &queue));
	cl_program program = cl->clCreateProgramWithSource(context, 1, &source, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	snprintf(options, sizeof options, "%s -I include", lobe_opencl_options(NULL));
	error = cl->clBuildProgram(program, 1, &id, options, NULL, NULL);
	cl->clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, sizeof log, log, NULL);
	TEST_ASSERT_EQUAL_MESSAGE(CL_SUCCESS, error, log);
	cl_kernel kernel = cl->clCreateKernel(program, "run", &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl_mem from = cl->clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, in_size,
					 (void *)(uintptr_t)in, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl_mem to = cl->clCreateBuffer(context, CL_MEM_WRITE_ONLY, out_size, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clSetKernelArg(kernel, 0, sizeof from, &from));
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clSetKernelArg(kernel, 1, sizeof to, &to));
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &count, NULL, 0, NULL, NULL));
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clEnqueueReadBuffer(queue, to, CL_TRUE, 0, out_size, out, 0, NULL, NULL));
	cl->clReleaseMemObject(from);
	cl->clReleaseMemObject(to);
	cl->clReleaseKernel(kernel);
	cl->clReleaseProgram(program);
	lobe_device_close(d);
	return 1;
}
