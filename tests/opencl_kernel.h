/* opencl_kernel.h - a test's own OpenCL kernel on one device of the library. */
#ifndef LOBE_TESTS_OPENCL_KERNEL_H
#define LOBE_TESTS_OPENCL_KERNEL_H

#include <stddef.h>

/* Builds source for "opencl:k" with the library's options, lets count work-items of its kernel run(in, out) turn in
 * into out (in_size and out_size bytes), and prints the device's name. 1, or 0 after a word why the device cannot be
 * opened: whoever gets no 1 from any device has tested nothing. Failures of OpenCL are Unity's. */
int opencl_kernel_run(size_t k, const char *source, size_t count, const void *in, size_t in_size, void *out,
		      size_t out_size);

#endif
