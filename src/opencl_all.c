/* opencl_all.c - every OpenCL device as one: a batch is cut into a part for each, as large as the device was fast.
 * Where the cuts fall makes no difference to an element, so results do not depend on it. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "internal.h"
#include "pool.h"
#include "opencl_split.h"

typedef struct {
	lobe_device base;
	size_t count;
	lobe_device **member; /* [count] */
	lobe_message *failed; /* [count] why each one's part failed */
	lobe_pool *pool;
	pthread_mutex_t lock; /* one batch at a time */
} all_device;

/* scene->state */
typedef struct {
	lobe_scene *member;                     /* [count] */
	lobe_cl_measure *measure[LOBE_VERB_COUNT]; /* [count] */
} all_scene;

/* A batch on its way. */
typedef struct {
	all_device *device;
	all_scene *scene;
	const lobe_job *job;
	size_t *cut;         /* [count + 1] member k has elements [cut[k], cut[k + 1]) */
	double *seconds;     /* [count] */
	lobe_status *status; /* [count] */
} all_run;

/* --- devices ------------------------------------------------------------------------------------------------------ */

static void close_all(lobe_device *base)
{
	all_device *const device = (all_device *)base;
	lobe_pool_destroy(device->pool);
	for (size_t i = 0; device->member && i < device->count; i++)
		lobe_device_close(device->member[i]);
	pthread_mutex_destroy(&device->lock);
	free(device->member);
	free(device->failed);
	free(device);
}

/* --- scenes ------------------------------------------------------------------------------------------------------- */

static void free_state(const all_device *device, all_scene *state, size_t made)
{
	while (made-- > 0)
		device->member[made]->ops->scene_destroy(&state->member[made]);
	for (int verb = 0; verb < LOBE_VERB_COUNT; verb++)
		free(state->measure[verb]);
	free(state->member);
	free(state);
}

static lobe_status scene_create(lobe_scene *scene)
{
	const all_device *const device = (const all_device *)scene->device;
	all_scene *const state = calloc(1, sizeof *state);
	if (!state)
		return lobe_out_of_memory("a scene of several devices");
	state->member = calloc(device->count, sizeof *state->member);
	int whole = state->member != NULL;
	for (int verb = 0; verb < LOBE_VERB_COUNT; verb++) {
		state->measure[verb] = calloc(device->count, sizeof *state->measure[verb]);
		whole = whole && state->measure[verb];
	}
	lobe_status status = whole ? LOBE_OK : lobe_out_of_memory("a scene of several devices");
	size_t made = 0;
	while (status == LOBE_OK && made < device->count) {
		status = lobe_scene_share(&state->member[made], scene, device->member[made]);
		made += status == LOBE_OK;
	}
	if (status != LOBE_OK)
		free_state(device, state, made);
	else
		scene->state = state;
	return status;
}

static void scene_destroy(lobe_scene *scene)
{
	const all_device *const device = (const all_device *)scene->device;
	free_state(device, scene->state, device->count);
}

/* --- batches ------------------------------------------------------------------------------------------------------ */

static double now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void run_part(void *context, size_t k, size_t thread)
{
	const all_run *const r = context;
	const size_t first = r->cut[k], n = r->cut[k + 1] - first;
	lobe_job part = *r->job;
	(void)thread;
	if (n == 0)
		return;
	part.count = n;
	part.material = part.material ? (const uint32_t *)part.material + first : NULL;
	for (int i = 0; i < LOBE_IN_COUNT; i++)
		part.in[i] = (const float *)part.in[i] + first;
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		part.out[i] = part.out[i] ? (unsigned char *)part.out[i] + 4 * first : NULL;
	const double start = now();
	r->status[k] = r->device->member[k]->ops->run(&r->scene->member[k], &part);
	r->seconds[k] = now() - start;
	if (r->status[k] != LOBE_OK)
		lobe_message_get(&r->device->failed[k]);
}

static lobe_status run_locked(all_run *r)
{
	all_device *const device = r->device;
	lobe_cl_measure *const m = r->scene->measure[r->job->verb];
	lobe_message before;
	lobe_cl_split(m, device->count, r->job->count, r->cut);
	lobe_message_get(&before);
	lobe_pool_run(device->pool, run_part, r, device->count);
	lobe_message_set(&before); /* of a part that ran on this thread */
	for (size_t k = 0; k < device->count; k++)
		if (r->status[k] != LOBE_OK)
			return lobe_fail(r->status[k], "%s: %.3800s", device->member[k]->name, device->failed[k].text);
	for (size_t k = 0; k < device->count; k++)
		if (r->cut[k + 1] > r->cut[k])
			lobe_cl_measure_add(&m[k], r->cut[k + 1] - r->cut[k], r->seconds[k]);
	return LOBE_OK;
}

static lobe_status run(lobe_scene *scene, const lobe_job *job)
{
	all_device *const device = (all_device *)scene->device;
	all_run r = {device, scene->state, job, NULL, NULL, NULL};
	r.cut = calloc(device->count + 1, sizeof *r.cut);
	r.seconds = calloc(device->count, sizeof *r.seconds);
	r.status = calloc(device->count, sizeof *r.status); /* zeros: LOBE_OK */
	lobe_status status = LOBE_ERROR_MEMORY;
	if (r.cut && r.seconds && r.status) {
		pthread_mutex_lock(&device->lock);
		status = run_locked(&r);
		pthread_mutex_unlock(&device->lock);
	} else {
		status = lobe_out_of_memory("a batch of several devices");
	}
	free(r.cut);
	free(r.seconds);
	free(r.status);
	return status;
}

static const lobe_device_ops all_ops = {close_all, scene_create, scene_destroy, run, NULL};

/* "opencl:all, 2 devices: A; B" */
static void name_all(all_device *device)
{
	char *const name = device->base.name;
	const size_t size = sizeof device->base.name;
	size_t at = (size_t)snprintf(name, size, "opencl:all, %zu device%s", device->count,
				     device->count == 1 ? "" : "s");
	for (size_t i = 0; i < device->count && at < size; i++)
		at += (size_t)snprintf(name + at, size - at, "%s%s", i ? "; " : ": ", device->member[i]->name);
}

/* Every device that can be used; the last refusal when there is none. */
static lobe_status open_members(all_device *device, size_t found)
{
	lobe_message before;
	lobe_status status = LOBE_OK;
	lobe_message_get(&before);
	for (size_t i = 0; i < found; i++) {
		const lobe_status opened = lobe_opencl_open(&device->member[device->count], i);
		device->count += opened == LOBE_OK;
		status = opened == LOBE_OK ? status : opened;
	}
	if (device->count == 0)
		return status;
	lobe_message_set(&before);
	return LOBE_OK;
}

lobe_status lobe_opencl_open_all(lobe_device **out)
{
	size_t found = 0;
	lobe_status status = lobe_opencl_count(&found);
	if (status != LOBE_OK)
		return status;
	if (found == 0)
		return lobe_opencl_open(out, 0); /* which says why */
	all_device *const device = calloc(1, sizeof *device);
	if (!device)
		return lobe_out_of_memory("several OpenCL devices");
	if (pthread_mutex_init(&device->lock, NULL) != 0) {
		free(device);
		return lobe_out_of_memory("several OpenCL devices");
	}
	device->base.ops = &all_ops;
	device->member = calloc(found, sizeof(lobe_device *));
	device->failed = calloc(found, sizeof *device->failed);
	status = device->member && device->failed ? open_members(device, found) : lobe_out_of_memory("several OpenCL devices");
	if (status == LOBE_OK && !(device->pool = lobe_pool_create(device->count)))
		status = lobe_out_of_memory("several OpenCL devices");
	if (status != LOBE_OK) {
		close_all(&device->base);
		return status;
	}
	name_all(device);
	*out = &device->base;
	return LOBE_OK;
}
