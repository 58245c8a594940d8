/* opencl_none.c - in place of the OpenCL backend in a library built with LOBE_OPENCL=0. */
#include "internal.h"

static lobe_status without_opencl(const char *call)
{
	return lobe_fail(LOBE_ERROR_DEVICE, "%s: this library was built without the OpenCL backend (LOBE_OPENCL=0)",
			 call);
}

lobe_status lobe_opencl_count(size_t *count)
{
	*count = 0;
	return LOBE_OK;
}

lobe_status lobe_opencl_open(lobe_device **out, size_t index)
{
	(void)out;
	(void)index;
	return without_opencl("lobe_device_open");
}

lobe_status lobe_opencl_open_all(lobe_device **out)
{
	(void)out;
	return without_opencl("lobe_device_open");
}

lobe_status lobe_device_open_cl(lobe_device **out, struct _cl_context *context, struct _cl_device_id *device,
				struct _cl_command_queue *queue)
{
	(void)out;
	(void)context;
	(void)device;
	(void)queue;
	return without_opencl("lobe_device_open_cl");
}

lobe_status lobe_device_cl(const lobe_device *device, struct _cl_context **context, struct _cl_device_id **id,
			   struct _cl_command_queue **queue)
{
	(void)device;
	(void)context;
	(void)id;
	(void)queue;
	return without_opencl("lobe_device_cl");
}

const char *lobe_opencl_source(void) { return ""; }
