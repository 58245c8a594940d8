/* cl_faults.c - OpenCL that fails on demand, by wrappers around every function that the library calls. */
#include "cl_faults.h"

#include <pthread.h>
#include <string.h>

cl_faults_state cl_faults = {.failing = "", .counting = ""};

/* Once a device is lost, what it must not do any more; questions are still answered, and objects released. */
static int needs_device(const char *name)
{
	return strncmp(name, "clEnqueue", 9) == 0 || strncmp(name, "clCreate", 8) == 0 || strcmp(name, "clFlush") == 0 ||
	       strcmp(name, "clFinish") == 0;
}

/* "opencl:all" calls from several threads. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* 1 when this call is to fail. */
static int fails(const char *name)
{
	pthread_mutex_lock(&lock);
	cl_faults.counted += strcmp(name, cl_faults.counting) == 0;
	int now = cl_faults.lost && cl_faults.countdown < 0 && needs_device(name);
	if (!now)
		now = strcmp(name, cl_faults.failing) == 0 && cl_faults.countdown-- == 0;
	pthread_mutex_unlock(&lock);
	return now;
}

static void count(long objects)
{
	pthread_mutex_lock(&lock);
	cl_faults.live += objects;
	pthread_mutex_unlock(&lock);
}

/* --- the wrappers ----------------------------------------------------------------------------------------------------- */

#define CREATES(type, name, parameters, arguments)                                                                     \
	static type wrap_##name parameters                                                                             \
	{                                                                                                              \
		if (fails(#name)) {                                                                                    \
			if (error)                                                                                     \
				*error = cl_faults.failure;                                                                      \
			return NULL;                                                                                   \
		}                                                                                                      \
		type made = cl_faults.real.name arguments;                                                                       \
		count(made != NULL);                                                                                           \
		return made;                                                                                           \
	}
#define RELEASES(name, type)                                                                                           \
	static cl_int wrap_##name(type object)                                                                         \
	{                                                                                                              \
		count(-1);                                                                                                \
		return cl_faults.real.name(object);                                                                              \
	}
#define RETAINS(name, type)                                                                                            \
	static cl_int wrap_##name(type object)                                                                         \
	{                                                                                                              \
		if (fails(#name))                                                                                      \
			return cl_faults.failure;                                                                                \
		count(1);                                                                                                \
		return cl_faults.real.name(object);                                                                              \
	}
#define DOES(name, parameters, arguments)                                                                              \
	static cl_int wrap_##name parameters { return fails(#name) ? cl_faults.failure : cl_faults.real.name arguments; }

CREATES(cl_context, clCreateContext,
	(const cl_context_properties *p, cl_uint n, const cl_device_id *d,
	 void (*notify)(const char *, const void *, size_t, void *), void *user, cl_int *error),
	(p, n, d, notify, user, error))
CREATES(cl_command_queue, clCreateCommandQueue, (cl_context c, cl_device_id d, cl_bitfield p, cl_int *error),
	(c, d, p, error))
CREATES(cl_program, clCreateProgramWithSource,
	(cl_context c, cl_uint n, const char **s, const size_t *l, cl_int *error), (c, n, s, l, error))
CREATES(cl_kernel, clCreateKernel, (cl_program p, const char *name, cl_int *error), (p, name, error))
CREATES(cl_program, clCreateProgramWithBinary,
	(cl_context c, cl_uint n, const cl_device_id *d, const size_t *l, const unsigned char **b, cl_int *s, cl_int *error),
	(c, n, d, l, b, s, error))
RETAINS(clRetainContext, cl_context)
RETAINS(clRetainCommandQueue, cl_command_queue)
RETAINS(clRetainDevice, cl_device_id)
RELEASES(clReleaseContext, cl_context)
RELEASES(clReleaseCommandQueue, cl_command_queue)
RELEASES(clReleaseDevice, cl_device_id)
RELEASES(clReleaseProgram, cl_program)
RELEASES(clReleaseKernel, cl_kernel)
DOES(clGetProgramInfo, (cl_program p, cl_uint w, size_t n, void *v, size_t *m), (p, w, n, v, m))
DOES(clGetPlatformIDs, (cl_uint n, cl_platform_id *p, cl_uint *m), (n, p, m))
DOES(clGetPlatformInfo, (cl_platform_id p, cl_uint w, size_t n, void *v, size_t *m), (p, w, n, v, m))
DOES(clGetDeviceIDs, (cl_platform_id p, cl_bitfield t, cl_uint n, cl_device_id *d, cl_uint *m), (p, t, n, d, m))
static cl_int wrap_clGetDeviceInfo(cl_device_id d, cl_uint what, size_t n, void *value, size_t *size)
{
	const cl_bool no = CL_FALSE;
	const cl_bitfield gpu = (cl_bitfield)1 << 2;
	if (fails("clGetDeviceInfo"))
		return cl_faults.failure;
	const cl_int error = cl_faults.real.clGetDeviceInfo(d, what, n, value, size);
	if (error != CL_SUCCESS || !value)
		return error;
	if (what == CL_DEVICE_SINGLE_FP_CONFIG)
		*(cl_bitfield *)value |= cl_faults.claims;
	else if (cl_faults.discrete && what == CL_DEVICE_HOST_UNIFIED_MEMORY)
		memcpy(value, &no, sizeof no);
	else if (cl_faults.discrete && what == CL_DEVICE_TYPE)
		memcpy(value, &gpu, sizeof gpu);
	else if (cl_faults.room && what == CL_DEVICE_MAX_MEM_ALLOC_SIZE)
		memcpy(value, &cl_faults.room, sizeof cl_faults.room);
	else if (cl_faults.memory && what == CL_DEVICE_GLOBAL_MEM_SIZE)
		memcpy(value, &cl_faults.memory, sizeof cl_faults.memory);
	return error;
}
DOES(clBuildProgram,
     (cl_program p, cl_uint n, const cl_device_id *d, const char *o, void (*notify)(cl_program, void *), void *u),
     (p, n, d, o, notify, u))
DOES(clGetCommandQueueInfo, (cl_command_queue q, cl_uint w, size_t n, void *v, size_t *m), (q, w, n, v, m))
DOES(clGetProgramBuildInfo, (cl_program p, cl_device_id d, cl_uint w, size_t n, void *v, size_t *m), (p, d, w, n, v, m))
DOES(clSetKernelArg, (cl_kernel k, cl_uint i, size_t n, const void *v), (k, i, n, v))
DOES(clGetKernelWorkGroupInfo, (cl_kernel k, cl_device_id d, cl_uint w, size_t n, void *v, size_t *m),
     (k, d, w, n, v, m))
DOES(clEnqueueReadBuffer,
     (cl_command_queue q, cl_mem b, cl_bool w, size_t o, size_t n, void *p, cl_uint c, const cl_event *l, cl_event *e),
     (q, b, w, o, n, p, c, l, e))
DOES(clEnqueueWriteBuffer,
     (cl_command_queue q, cl_mem b, cl_bool w, size_t o, size_t n, const void *p, cl_uint c, const cl_event *l,
      cl_event *e),
     (q, b, w, o, n, p, c, l, e))
DOES(clEnqueueNDRangeKernel,
     (cl_command_queue q, cl_kernel k, cl_uint d, const size_t *o, const size_t *g, const size_t *l, cl_uint c,
      const cl_event *w, cl_event *e),
     (q, k, d, o, g, l, c, w, e))
DOES(clEnqueueUnmapMemObject, (cl_command_queue q, cl_mem b, void *p, cl_uint c, const cl_event *w, cl_event *e),
     (q, b, p, c, w, e))
DOES(clFlush, (cl_command_queue q), (q))
DOES(clGetMemObjectInfo, (cl_mem b, cl_uint w, size_t n, void *v, size_t *m), (b, w, n, v, m))

/* What has been enqueued uses the test's memory: it ends before the failure is told. */
static cl_int wrap_clFinish(cl_command_queue q)
{
	const cl_int error = cl_faults.real.clFinish(q);
	return fails("clFinish") ? cl_faults.failure : error;
}

static size_t size_of(cl_mem b)
{
	size_t size = 0;
	cl_faults.real.clGetMemObjectInfo(b, CL_MEM_SIZE, sizeof size, &size, NULL);
	return size;
}

/* Memory that is the host's takes none of the device's. */
static cl_ulong in_use;

/* Takes n bytes of the device's memory; 0 when they are not free. */
static int take(size_t n)
{
	pthread_mutex_lock(&lock);
	const int fits = !cl_faults.free || in_use + n <= cl_faults.free;
	if (fits)
		in_use += n;
	if (in_use > cl_faults.used)
		cl_faults.used = in_use;
	if (n > cl_faults.largest)
		cl_faults.largest = n;
	pthread_mutex_unlock(&lock);
	return fits;
}

static void give_back(size_t n)
{
	pthread_mutex_lock(&lock);
	in_use -= n;
	pthread_mutex_unlock(&lock);
}

static cl_mem wrap_clCreateBuffer(cl_context c, cl_bitfield f, size_t n, void *p, cl_int *error)
{
	const size_t bytes = f & CL_MEM_USE_HOST_PTR ? 0 : n;
	if (fails("clCreateBuffer")) {
		*error = cl_faults.failure;
		return NULL;
	}
	if (!take(bytes)) {
		*error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
		return NULL;
	}
	const cl_mem made = cl_faults.real.clCreateBuffer(c, f, n, p, error);
	count(made != NULL);
	if (!made)
		give_back(bytes);
	return made;
}

static cl_int wrap_clReleaseMemObject(cl_mem b)
{
	cl_bitfield flags = 0;
	cl_faults.real.clGetMemObjectInfo(b, CL_MEM_FLAGS, sizeof flags, &flags, NULL);
	count(-1);
	give_back(flags & CL_MEM_USE_HOST_PTR ? 0 : size_of(b));
	return cl_faults.real.clReleaseMemObject(b);
}

/* Mapping makes no object: it is undone by unmapping. */
static void *wrap_clEnqueueMapBuffer(cl_command_queue q, cl_mem b, cl_bool w, cl_bitfield f, size_t o, size_t n,
				     cl_uint c, const cl_event *l, cl_event *e, cl_int *error)
{
	if (fails("clEnqueueMapBuffer")) {
		if (error)
			*error = cl_faults.failure;
		return NULL;
	}
	return cl_faults.real.clEnqueueMapBuffer(q, b, w, f, o, n, c, l, e, error);
}

int cl_faults_install(void)
{
	size_t count = 0;
	/* What is there already would be taken for OpenCL itself, and call itself for ever. */
	if (cl_faults.table)
		return 1;
	if (lobe_device_count("opencl", &count) != LOBE_OK || count == 0)
		return 0;
	cl_faults.table = (lobe_cl_functions *)(uintptr_t)lobe_cl_load();
	cl_faults.real = *cl_faults.table;
#define LOBE_CL_FUNCTION(result, name, arguments) cl_faults.table->name = wrap_##name;
	LOBE_CL_FUNCTIONS(LOBE_CL_FUNCTION)
#undef LOBE_CL_FUNCTION
	return 1;
}
