/* cl_faults.h - OpenCL that fails on demand, and that counts what it has made.
 *
 * The library calls OpenCL through a table of functions (opencl_api.h); cl_faults_install puts wrappers into it. */
#ifndef LOBE_TESTS_CL_FAULTS_H
#define LOBE_TESTS_CL_FAULTS_H

#include "opencl_api.h"

typedef struct {
	lobe_cl_functions real;   /* OpenCL itself */
	lobe_cl_functions *table; /* what the library calls */

	const char *failing; /* the call that fails, or "" */
	long countdown;      /* it does when this gets to 0; negative afterwards */
	cl_int failure;      /* with this code */
	int lost;            /* and from then on the device is lost: nothing can be made, enqueued or waited for */

	cl_bitfield claims; /* devices claim these of CL_DEVICE_SINGLE_FP_CONFIG too */
	int discrete;       /* devices have memory of their own, as a GPU does */
	cl_ulong room;      /* when not 0: bytes of the largest buffer */
	cl_ulong memory;    /* when not 0: bytes of device memory */
	cl_ulong free;      /* when not 0: bytes of it that others leave; buffers beyond them cannot be made */

	const char *counting; /* a call whose calls are counted, or "" */
	long counted;
	long live;              /* objects created and not released */
	cl_ulong used, largest; /* bytes of device memory at most at any time, and of the largest buffer there */
} cl_faults_state;

extern cl_faults_state cl_faults;

/* 0 when there is no OpenCL device to fail. Called again, it changes nothing. */
int cl_faults_install(void);

/* The first line of a test of OpenCL: without a device the test is reported as skipped. A macro, for Unity to name the
 * test's own line. */
#define NEEDS_OPENCL()                                                                                                 \
	do {                                                                                                           \
		if (!cl_faults_install())                                                                              \
			TEST_IGNORE_MESSAGE("no OpenCL device");                                                       \
	} while (0)

#endif
