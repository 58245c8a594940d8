/* native_none.c - in place of the native backend in a library built with LOBE_NATIVE=0. */
#include "internal.h"

lobe_status lobe_native_count(size_t *count)
{
	*count = 0;
	return LOBE_OK;
}

lobe_status lobe_native_open(lobe_device **out, size_t threads)
{
	(void)out;
	(void)threads;
	return lobe_fail(LOBE_ERROR_DEVICE,
			 "lobe_device_open: this library was built without the native backend (LOBE_NATIVE=0)");
}
