/* fallback.c - an OpenCL device with a native one behind it, "opencl,native": what the first fails to do the second
 * does. A batch that failed halfway runs again from its beginning: outputs overlap no inputs, so nothing is lost. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "internal.h"

typedef struct {
	lobe_device base;
	lobe_device *first, *native; /* first is NULL when it could not be opened */
	pthread_mutex_t lock;        /* of what follows */
	int lost;                    /* the first is not asked any more, ... */
	lobe_message reason;         /* ... and why; written once, before lost is set */
} pair_device;

/* scene->state: a scene on each */
typedef struct {
	lobe_scene first, native;
	int has_first;
} pair_scene;

static int is_lost(pair_device *device)
{
	pthread_mutex_lock(&device->lock);
	const int lost = device->lost;
	pthread_mutex_unlock(&device->lock);
	return lost;
}

/* After a failure of the first, whose message is this thread's. Memory may be there again for the next batch; after
 * anything else the device is given up. */
static void note(pair_device *device, lobe_status status)
{
	pthread_mutex_lock(&device->lock);
	if (!device->lost && status != LOBE_ERROR_MEMORY) {
		lobe_message_get(&device->reason);
		device->lost = 1;
	}
	pthread_mutex_unlock(&device->lock);
}

static void close_pair(lobe_device *base)
{
	pair_device *const device = (pair_device *)base;
	if (device->first)
		device->first->ops->close(device->first);
	if (device->native)
		device->native->ops->close(device->native);
	pthread_mutex_destroy(&device->lock);
	free(device);
}

/* The native scene comes last: it turns the places of tables in the parameters, which both share, into addresses. */
static lobe_status scene_create(lobe_scene *scene)
{
	pair_device *const device = (pair_device *)scene->device;
	pair_scene *const state = calloc(1, sizeof *state);
	if (!state)
		return lobe_out_of_memory("a scene of two devices");
	lobe_device *const first = is_lost(device) ? NULL : device->first;
	if (first) {
		lobe_message before;
		lobe_message_get(&before);
		const lobe_status status = lobe_scene_share(&state->first, scene, first);
		state->has_first = status == LOBE_OK;
		if (status != LOBE_OK) {
			note(device, status);
			lobe_message_set(&before);
		}
	}
	const lobe_status status = lobe_scene_share(&state->native, scene, device->native);
	if (status != LOBE_OK) {
		if (first && state->has_first)
			first->ops->scene_destroy(&state->first);
		free(state);
		return status;
	}
	scene->state = state;
	return LOBE_OK;
}

static void scene_destroy(lobe_scene *scene)
{
	pair_scene *const state = scene->state;
	if (state->has_first)
		state->first.device->ops->scene_destroy(&state->first);
	state->native.device->ops->scene_destroy(&state->native);
	free(state);
}

static lobe_status run(lobe_scene *scene, const lobe_job *job)
{
	pair_device *const device = (pair_device *)scene->device;
	pair_scene *const state = scene->state;
	if (state->has_first && !is_lost(device)) {
		lobe_message before;
		lobe_message_get(&before);
		const lobe_status status = device->first->ops->run(&state->first, job);
		if (status == LOBE_OK)
			return status;
		note(device, status);
		lobe_message_set(&before);
	}
	return device->native->ops->run(&state->native, job);
}

static const lobe_device_ops pair_ops = {close_pair, scene_create, scene_destroy, run, NULL};

lobe_status lobe_fallback_open(lobe_device **out, lobe_device *first, lobe_device *native)
{
	pair_device *const device = calloc(1, sizeof *device);
	if (!device || pthread_mutex_init(&device->lock, NULL) != 0) {
		free(device);
		return lobe_out_of_memory("a device");
	}
	device->base.ops = &pair_ops;
	device->first = first;
	device->native = native;
	if (first) {
		snprintf(device->base.name, sizeof device->base.name, "%.170s, or else %.60s", first->name, native->name);
	} else {
		note(device, LOBE_ERROR_DEVICE);
		snprintf(device->base.name, sizeof device->base.name, "%s", native->name);
	}
	*out = &device->base;
	return LOBE_OK;
}

const char *lobe_device_lost(const lobe_device *base)
{
	if (!base || base->ops != &pair_ops)
		return NULL;
	pair_device *const device = (pair_device *)(uintptr_t)base;
	return is_lost(device) ? device->reason.text : NULL;
}
