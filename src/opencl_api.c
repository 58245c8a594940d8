/* opencl_api.c - the OpenCL library of the system, loaded at run time (dlopen): what the program asks for never needs
 * it to start. */
#define _POSIX_C_SOURCE 200809L

#include "opencl_api.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "internal.h"

static pthread_once_t once = PTHREAD_ONCE_INIT;
static lobe_cl_functions functions;
static int loaded;
static char load_error[256] = "";

/* dlsym's answer as a function pointer: C99 has no cast for it, and POSIX says that the copy works. */
static int find(void *library, const char *name, void *function, size_t size)
{
	void *const symbol = dlsym(library, name);
	if (!symbol) {
		snprintf(load_error, sizeof load_error, "the OpenCL library has no %s", name);
		return 0;
	}
	memcpy(function, &symbol, size);
	return 1;
}

static void load(void)
{
	static const char *const names[] = {"libOpenCL.so.1", "libOpenCL.so"};
	void *library = NULL;
	size_t i;
	for (i = 0; i < sizeof names / sizeof *names && !library; i++) {
		library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
		if (!library && i == 0) {
			const char *const why = dlerror();
			snprintf(load_error, sizeof load_error, "%s", why ? why : "libOpenCL.so.1 cannot be loaded");
		}
	}
	if (!library)
		return;
	/* On success it is never closed again: OpenCL implementations leave threads and exit handlers behind. */
	loaded = 1;
#define LOBE_CL_FUNCTION(result, name, arguments)                                                                      \
	loaded = loaded && find(library, #name, &functions.name, sizeof functions.name);
	LOBE_CL_FUNCTIONS(LOBE_CL_FUNCTION)
#undef LOBE_CL_FUNCTION
	if (!loaded)
		dlclose(library);
}

const lobe_cl_functions *lobe_cl_load(void) { return pthread_once(&once, load) == 0 && loaded ? &functions : NULL; }

const char *lobe_cl_load_error(void) { return load_error; }

const char *lobe_cl_error_name(cl_int error)
{
	switch (error) {
#define LOBE_CL_ERROR(name, value)                                                                                     \
	case value:                                                                                                    \
		return #name;
		LOBE_CL_ERRORS(LOBE_CL_ERROR)
#undef LOBE_CL_ERROR
	default:
		return "unknown error";
	}
}

lobe_status lobe_cl_fail(const char *call, cl_int error)
{
	const int memory = error == CL_OUT_OF_RESOURCES || error == CL_MEM_OBJECT_ALLOCATION_FAILURE ||
			   error == CL_OUT_OF_HOST_MEMORY;
	return lobe_fail(memory ? LOBE_ERROR_MEMORY : LOBE_ERROR_OPENCL, "%s failed: %s (%d)", call,
			 lobe_cl_error_name(error), (int)error);
}
