/* device.c - devices by name. */
#include "event.h"

lobe_status lobe_device_count(const char *backend, size_t *count)
{
	if (!backend || !count)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_count: %s is NULL", backend ? "count" : "backend");
	if (strcmp(backend, "native") == 0)
		return lobe_native_count(count);
	if (strcmp(backend, "opencl") == 0)
		return lobe_opencl_count(count);
	return lobe_fail(LOBE_ERROR_DEVICE, "lobe_device_count: no backend \"%s\"; there are \"native\" and \"opencl\"",
			 backend);
}

/* The number behind "backend:" in name; 0 and *given = 0 for "backend" alone. Returns 0 when name is something else. */
static int parse_name(const char *name, const char *backend, size_t *number, int *given)
{
	const size_t length = strlen(backend);
	*number = 0;
	*given = 0;
	if (strncmp(name, backend, length) != 0)
		return 0;
	const char *s = name + length;
	if (!*s)
		return 1;
	if (*s++ != ':' || !*s)
		return 0;
	for (; *s >= '0' && *s <= '9' && *number < 1000000; s++)
		*number = *number * 10 + (size_t)(*s - '0');
	*given = 1;
	return !*s;
}

static lobe_status open_native(lobe_device **out, const char *name, size_t threads, int given)
{
	if (given && (threads < 1 || threads > 1024))
		return lobe_fail(LOBE_ERROR_DEVICE, "lobe_device_open: \"%s\": threads must be 1 to 1024", name);
	return lobe_native_open(out, threads);
}

static lobe_status bad_name(const char *name)
{
	return lobe_fail(LOBE_ERROR_DEVICE,
			 "lobe_device_open: no device \"%s\"; names are native, native:THREADS, opencl, opencl:INDEX, "
			 "opencl:all, and one of opencl followed by ,native or ,native:THREADS",
			 name);
}

/* "opencl:INDEX,native:THREADS" and the like; rest is what comes after the comma. */
static lobe_status open_fallback(lobe_device **out, const char *name, const char *rest)
{
	const size_t length = (size_t)(rest - 1 - name);
	lobe_device *first = NULL, *native;
	char head[32];
	size_t threads, index;
	int given, all;
	if (length >= sizeof head || !parse_name(rest, "native", &threads, &given))
		return bad_name(name);
	memcpy(head, name, length);
	head[length] = '\0';
	all = strcmp(head, "opencl:all") == 0;
	if (!all && !parse_name(head, "opencl", &index, &(int){0}))
		return bad_name(name);
	lobe_status status = open_native(&native, name, threads, given);
	if (status != LOBE_OK)
		return status;
	lobe_message before;
	lobe_message_get(&before);
	status = all ? lobe_opencl_open_all(&first) : lobe_opencl_open(&first, index);
	status = lobe_fallback_open(out, status == LOBE_OK ? first : NULL, native);
	if (status == LOBE_OK) {
		lobe_message_set(&before);
	} else {
		lobe_device_close(first);
		lobe_device_close(native);
	}
	return status;
}

lobe_status lobe_device_open(lobe_device **out, const char *name)
{
	size_t number;
	int given;
	if (!out || !name)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_open: %s is NULL", out ? "name" : "out");
	const char *const comma = strchr(name, ',');
	if (comma)
		return open_fallback(out, name, comma + 1);
	if (parse_name(name, "native", &number, &given))
		return open_native(out, name, number, given);
	if (strcmp(name, "opencl:all") == 0)
		return lobe_opencl_open_all(out);
	if (parse_name(name, "opencl", &number, &given))
		return lobe_opencl_open(out, number);
	return bad_name(name);
}

const char *lobe_device_name(const lobe_device *device) { return device ? device->name : ""; }

void lobe_device_close(lobe_device *device)
{
	if (!device || __atomic_fetch_sub(&device->scenes, 1, __ATOMIC_ACQ_REL) != 0)
		return;
	lobe_worker_end(device->worker);
	device->ops->close(device);
}
