/* opencl.c - OpenCL devices: finding, opening and closing them. */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "opencl_device.h"

/* Work-items in a group of a device other than a processor. See cl/kernels.cl. */
enum { GPU_LOCAL = 128 };

/* One device in the numbering over all platforms. */
typedef struct {
	cl_platform_id platform;
	cl_device_id id;
} entry;

/* Appends a platform's devices to list[0..count). */
static lobe_status list_platform(const lobe_cl_functions *cl, cl_platform_id platform, entry **list, size_t *count)
{
	cl_uint n = 0, i;
	cl_device_id *ids;
	entry *longer;
	cl_int error = cl->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, NULL, &n);
	if (error == CL_DEVICE_NOT_FOUND || (error == CL_SUCCESS && n == 0))
		return LOBE_OK;
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clGetDeviceIDs", error);
	ids = calloc(n, sizeof *ids);
	longer = realloc(*list, (*count + n) * sizeof **list);
	if (longer)
		*list = longer;
	if (!ids || !longer) {
		free(ids);
		return lobe_out_of_memory("the list of OpenCL devices");
	}
	error = cl->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, n, ids, NULL);
	if (error == CL_SUCCESS) {
		for (i = 0; i < n; i++) {
			(*list)[*count].platform = platform;
			(*list)[(*count)++].id = ids[i];
		}
	}
	free(ids);
	return error == CL_SUCCESS ? LOBE_OK : lobe_cl_fail("clGetDeviceIDs", error);
}

/* All devices of all platforms; *list is the caller's to free, also after a failure. None is no failure. */
static lobe_status list_devices(const lobe_cl_functions *cl, entry **list, size_t *count)
{
	lobe_status status = LOBE_OK;
	lobe_message before;
	cl_platform_id *platforms;
	cl_uint n = 0, i;
	cl_int error = cl->clGetPlatformIDs(0, NULL, &n);
	if (error == CL_PLATFORM_NOT_FOUND_KHR || (error == CL_SUCCESS && n == 0))
		return LOBE_OK;
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clGetPlatformIDs", error);
	platforms = calloc(n, sizeof *platforms);
	if (!platforms)
		return lobe_out_of_memory("the list of OpenCL platforms");
	error = cl->clGetPlatformIDs(n, platforms, NULL);
	if (error != CL_SUCCESS)
		status = lobe_cl_fail("clGetPlatformIDs", error);
	/* A platform that fails is passed over; its failure is told when no other has a device. */
	lobe_message_get(&before);
	for (i = 0; error == CL_SUCCESS && i < n; i++) {
		const lobe_status failed = list_platform(cl, platforms[i], list, count);
		status = failed != LOBE_OK ? failed : status;
	}
	free(platforms);
	if (*count)
		lobe_message_set(&before);
	return *count ? LOBE_OK : status;
}

lobe_status lobe_opencl_count(size_t *count)
{
	const lobe_cl_functions *const cl = lobe_cl_load();
	entry *list = NULL;
	size_t n = 0;
	const lobe_status status = cl ? list_devices(cl, &list, &n) : LOBE_OK;
	free(list);
	if (status == LOBE_OK)
		*count = n;
	return status;
}

static lobe_status no_runtime(void)
{
	return lobe_fail(LOBE_ERROR_DEVICE, "no OpenCL runtime: %s", lobe_cl_load_error());
}

/* Some drivers pad the names that they give. */
static void trim(char *s)
{
	size_t n = strlen(s);
	const size_t blank = strspn(s, " ");
	while (n > blank && s[n - 1] == ' ')
		n--;
	memmove(s, s + blank, n - blank);
	s[n - blank] = '\0';
}

/* Arrays of a lane: inputs, outputs, material and order. */
enum { LANE_ARRAYS = LOBE_IN_COUNT + LOBE_OUT_COUNT + 2 };

/* Elements of 4 bytes that fit: 1 at least. */
static size_t elements(cl_ulong bytes)
{
	const cl_ulong n = bytes / 4 < SIZE_MAX / 4 ? bytes / 4 : SIZE_MAX / 4;
	return n == 0 ? 1 : (size_t)n;
}

/* What device->id can do, and the device's name: prefix, then platform and device. */
static lobe_status inspect(lobe_cl_device *device, const char *prefix)
{
	static const struct {
		cl_bitfield bit;
		const char *name;
	} needed[] = {{CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT, "correctly rounded division and square root"},
		      {CL_FP_DENORM, "denormal numbers"},
		      {CL_FP_ROUND_TO_NEAREST, "rounding to nearest"},
		      {CL_FP_INF_NAN, "infinities and NaNs"}};
	const lobe_cl_functions *const cl = device->cl;
	cl_platform_id platform = NULL;
	cl_bitfield type = 0, single = 0;
	size_t max_local = 1;
	cl_bool available = CL_FALSE, compiler = CL_FALSE, little = CL_FALSE, unified = CL_FALSE;
	cl_ulong max_size = 0, memory = 0;
	cl_uint units = 1;
	char platform_name[1024] = "", device_name[1024] = "";
	const struct {
		cl_uint what;
		size_t size;
		void *to;
	} query[] = {{CL_DEVICE_PLATFORM, sizeof platform, &platform},
		     {CL_DEVICE_TYPE, sizeof type, &type},
		     {CL_DEVICE_NAME, sizeof device_name, device_name},
		     {CL_DEVICE_SINGLE_FP_CONFIG, sizeof single, &single},
		     {CL_DEVICE_AVAILABLE, sizeof available, &available},
		     {CL_DEVICE_COMPILER_AVAILABLE, sizeof compiler, &compiler},
		     {CL_DEVICE_ENDIAN_LITTLE, sizeof little, &little},
		     {CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof unified, &unified},
		     {CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof max_size, &max_size},
		     {CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory},
		     {CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof max_local, &max_local},
		     {CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units}};
	const uint32_t one = 1;
	cl_int error = CL_SUCCESS;
	size_t i;

	for (i = 0; i < sizeof query / sizeof *query && error == CL_SUCCESS; i++)
		error = cl->clGetDeviceInfo(device->id, query[i].what, query[i].size, query[i].to, NULL);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clGetDeviceInfo", error);
	error = cl->clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof platform_name, platform_name, NULL);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clGetPlatformInfo", error);
	trim(platform_name);
	trim(device_name);
	snprintf(device->base.name, sizeof device->base.name, "%s, %.100s, %.120s", prefix, platform_name, device_name);

	if (!available)
		return lobe_fail(LOBE_ERROR_DEVICE, "%s: the device is not available", device->base.name);
	if (!compiler)
		return lobe_fail(LOBE_ERROR_DEVICE, "%s: the device has no compiler", device->base.name);
	if ((*(const unsigned char *)&one == 1) != (little == CL_TRUE))
		return lobe_fail(LOBE_ERROR_DEVICE, "%s: its byte order is not the host's", device->base.name);
	for (i = 0; i < sizeof needed / sizeof *needed; i++) {
		if (!(single & needed[i].bit))
			return lobe_fail(LOBE_ERROR_DEVICE, "%s: without %s in single precision results would differ",
					 device->base.name, needed[i].name);
	}
	device->unified = unified == CL_TRUE;
	/* PoCL makes vectors of loops; Intel's runtime makes them of work-items, and leaves loops as they are. */
	device->loops = (type & CL_DEVICE_TYPE_CPU) != 0 && strcmp(platform_name, LOBE_CL_POCL) == 0;
	device->units = units ? units : 1;
	device->local = device->loops ? 1 : GPU_LOCAL;
	while (device->local > max_local)
		device->local /= 2;
	device->max_count = elements(max_size);
	device->copy_count = elements(memory / 4 / LANE_ARRAYS);
	return LOBE_OK;
}

static void close_device(lobe_device *base)
{
	lobe_cl_device *const device = (lobe_cl_device *)base;
	const lobe_cl_functions *const cl = device->cl;
	int i;
	lobe_cl_buffers_release(device);
	lobe_cl_programs_release(device);
	for (i = 0; i < LOBE_CL_LANES; i++) {
		if (device->lane[i].queue)
			cl->clReleaseCommandQueue(device->lane[i].queue);
	}
	if (device->context)
		cl->clReleaseContext(device->context);
	if (device->id)
		cl->clReleaseDevice(device->id);
	pthread_mutex_destroy(&device->lock);
	free(device);
}

static const lobe_device_ops ops = {close_device, lobe_cl_scene_create, lobe_cl_scene_destroy, lobe_cl_run,
				    lobe_cl_run_device};

/* A device without handles, which close_device takes as well. */
static lobe_cl_device *new_device(const lobe_cl_functions *cl)
{
	lobe_cl_device *const device = calloc(1, sizeof *device);
	if (!device)
		return NULL;
	if (pthread_mutex_init(&device->lock, NULL) != 0) {
		free(device);
		return NULL;
	}
	device->base.ops = &ops;
	device->cl = cl;
	return device;
}

lobe_status lobe_cl_lane_open(lobe_cl_device *device, lobe_cl_lane *lane)
{
	cl_int error = CL_SUCCESS;
	lane->queue = device->cl->clCreateCommandQueue(device->context, device->id, 0, &error);
	return lane->queue ? LOBE_OK : lobe_cl_fail("clCreateCommandQueue", error);
}

/* Fills a new device with a context and a queue of its own. */
static lobe_status make_own(lobe_cl_device *device, const entry *from)
{
	const lobe_cl_functions *const cl = device->cl;
	const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM, (cl_context_properties)from->platform, 0};
	cl_int error = cl->clRetainDevice(from->id);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clRetainDevice", error);
	device->id = from->id;
	device->context = cl->clCreateContext(properties, 1, &from->id, NULL, NULL, &error);
	if (!device->context)
		return lobe_cl_fail("clCreateContext", error);
	return lobe_cl_lane_open(device, &device->lane[0]);
}

lobe_status lobe_opencl_open(lobe_device **out, size_t index)
{
	const lobe_cl_functions *const cl = lobe_cl_load();
	lobe_cl_device *device;
	entry *list = NULL, chosen;
	size_t count = 0;
	char prefix[32];
	lobe_status status;

	if (!cl)
		return no_runtime();
	status = list_devices(cl, &list, &count);
	if (status == LOBE_OK && count == 0)
		status = lobe_fail(LOBE_ERROR_DEVICE, "no OpenCL runtime: there is a loader, but no device");
	else if (status == LOBE_OK && index >= count)
		status = lobe_fail(LOBE_ERROR_DEVICE, "no device opencl:%lu: there are %lu", (unsigned long)index,
				   (unsigned long)count);
	if (status != LOBE_OK) {
		free(list);
		return status;
	}
	chosen = list[index];
	free(list);

	device = new_device(cl);
	if (!device)
		return lobe_out_of_memory("an OpenCL device");
	snprintf(prefix, sizeof prefix, "opencl:%lu", (unsigned long)index);
	status = make_own(device, &chosen);
	if (status == LOBE_OK)
		status = inspect(device, prefix);
	if (status == LOBE_OK)
		*out = &device->base;
	else
		close_device(&device->base);
	return status;
}

/* The context, device and queue that a caller gives belong together and the queue is in order. */
static lobe_status check_handles(const lobe_cl_functions *cl, cl_context context, cl_device_id id,
				 cl_command_queue queue)
{
	cl_context queue_context = NULL;
	cl_device_id queue_device = NULL;
	cl_bitfield properties = 0;
	cl_int error = cl->clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof queue_context, &queue_context, NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof queue_device, &queue_device, NULL);
	if (error == CL_SUCCESS)
		error = cl->clGetCommandQueueInfo(queue, CL_QUEUE_PROPERTIES, sizeof properties, &properties, NULL);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clGetCommandQueueInfo", error);
	if (queue_context != context)
		return lobe_fail(LOBE_ERROR_ARGUMENT,
				 "lobe_device_open_cl: queue belongs to another context than the one given");
	if (queue_device != id)
		return lobe_fail(LOBE_ERROR_ARGUMENT,
				 "lobe_device_open_cl: queue belongs to another device than the one given");
	if (properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE)
		return lobe_fail(LOBE_ERROR_ARGUMENT,
				 "lobe_device_open_cl: queue is out of order: an in-order queue is needed");
	return LOBE_OK;
}

/* Each handle is stored once its reference is taken, so that close_device gives back what was taken. */
static lobe_status retain(lobe_cl_device *device, cl_context context, cl_device_id id, cl_command_queue queue)
{
	const lobe_cl_functions *const cl = device->cl;
	cl_int error = cl->clRetainDevice(id);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clRetainDevice", error);
	device->id = id;
	error = cl->clRetainContext(context);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clRetainContext", error);
	device->context = context;
	error = cl->clRetainCommandQueue(queue);
	if (error != CL_SUCCESS)
		return lobe_cl_fail("clRetainCommandQueue", error);
	device->lane[0].queue = queue;
	return LOBE_OK;
}

lobe_status lobe_device_open_cl(lobe_device **out, struct _cl_context *context, struct _cl_device_id *id,
				struct _cl_command_queue *queue)
{
	const lobe_cl_functions *cl;
	lobe_cl_device *device;
	lobe_status status;

	if (!out)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_open_cl: out is NULL");
	if (!context)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_open_cl: context is NULL");
	if (!id)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_open_cl: device is NULL");
	if (!queue)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_open_cl: queue is NULL");
	cl = lobe_cl_load();
	if (!cl)
		return no_runtime();
	status = check_handles(cl, context, id, queue);
	if (status != LOBE_OK)
		return status;
	device = new_device(cl);
	if (!device)
		return lobe_out_of_memory("an OpenCL device");
	status = retain(device, context, id, queue);
	if (status == LOBE_OK)
		status = inspect(device, "opencl");
	if (status == LOBE_OK)
		*out = &device->base;
	else
		close_device(&device->base);
	return status;
}

lobe_status lobe_device_cl(const lobe_device *base, struct _cl_context **context, struct _cl_device_id **id,
			   struct _cl_command_queue **queue)
{
	const lobe_cl_device *const device = (const lobe_cl_device *)base;
	if (!base)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_cl: device is NULL");
	if (base->ops != &ops)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_cl: device \"%s\" is not one OpenCL device",
				 base->name);
	if (context)
		*context = device->context;
	if (id)
		*id = device->id;
	if (queue)
		*queue = device->lane[0].queue;
	return LOBE_OK;
}
