/* event.c - batches that run behind the caller: each device that is asked has a thread, which runs them one after
 * another as the plain calls would. That serves every kind of device alike; what a device can do at the same time,
 * copies beside kernels or many threads, it does within each batch. */
#define _POSIX_C_SOURCE 200809L
#include "event.h"

#include <pthread.h>
#include <stdlib.h>

#include "strides.h"
#include "thread.h"

struct lobe_event {
	lobe_event *next; /* in the queue */
	lobe_scene *scene;
	lobe_job job;

	pthread_mutex_t lock;
	pthread_cond_t changed;
	int done;
	lobe_status status;
	lobe_message *message; /* of a failure; NULL also when there was no memory for it */
};

struct lobe_worker {
	pthread_t thread;
	pthread_mutex_t lock;
	pthread_cond_t changed;
	lobe_event *first, *last; /* not begun yet */
	int stop;                 /* when the queue is empty */
};

/* --- events ------------------------------------------------------------------------------------------------------- */

static lobe_event *new_event(lobe_scene *scene, const lobe_job *job)
{
	lobe_event *const e = calloc(1, sizeof *e);
	if (!e)
		return NULL;
	e->scene = scene;
	e->job = *job;
	if (pthread_mutex_init(&e->lock, NULL) != 0) {
		free(e);
		return NULL;
	}
	if (pthread_cond_init(&e->changed, NULL) != 0) {
		pthread_mutex_destroy(&e->lock);
		free(e);
		return NULL;
	}
	return e;
}

/* Runs in the worker. Once the lock is given back the event may be gone. */
static void run(lobe_event *e)
{
	const lobe_status status = lobe_run_job(e->scene, &e->job);
	lobe_message *message = NULL;
	if (status != LOBE_OK && (message = malloc(sizeof *message)) != NULL)
		lobe_message_get(message);
	pthread_mutex_lock(&e->lock);
	e->status = status;
	e->message = message;
	e->done = 1;
	pthread_cond_broadcast(&e->changed);
	pthread_mutex_unlock(&e->lock);
}

static void await(lobe_event *e)
{
	pthread_mutex_lock(&e->lock);
	while (!e->done)
		pthread_cond_wait(&e->changed, &e->lock);
	pthread_mutex_unlock(&e->lock);
}

lobe_status lobe_event_wait(lobe_event *e)
{
	if (!e)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_event_wait: event is NULL");
	await(e);
	if (e->message)
		lobe_message_set(e->message);
	else if (e->status != LOBE_OK)
		lobe_set_error_message("the batch failed, and there was no memory for the reason");
	return e->status;
}

int lobe_event_done(lobe_event *e)
{
	int done = 1;
	if (e) {
		pthread_mutex_lock(&e->lock);
		done = e->done;
		pthread_mutex_unlock(&e->lock);
	}
	return done;
}

void lobe_event_release(lobe_event *e)
{
	if (!e)
		return;
	await(e);
	pthread_cond_destroy(&e->changed);
	pthread_mutex_destroy(&e->lock);
	free(e->message);
	free(e);
}

/* --- the thread --------------------------------------------------------------------------------------------------- */

static void *work(void *argument)
{
	lobe_worker *const w = argument;
	pthread_mutex_lock(&w->lock);
	for (;;) {
		lobe_event *const e = w->first;
		if (e) {
			w->first = e->next;
			pthread_mutex_unlock(&w->lock);
			run(e);
			pthread_mutex_lock(&w->lock);
		} else if (w->stop) {
			break;
		} else {
			pthread_cond_wait(&w->changed, &w->lock);
		}
	}
	pthread_mutex_unlock(&w->lock);
	return NULL;
}

static lobe_worker *new_worker(void)
{
	lobe_worker *const w = calloc(1, sizeof *w);
	if (!w)
		return NULL;
	if (pthread_mutex_init(&w->lock, NULL) == 0) {
		if (pthread_cond_init(&w->changed, NULL) == 0) {
			if (lobe_thread_create(&w->thread, work, w) == 0)
				return w;
			pthread_cond_destroy(&w->changed);
		}
		pthread_mutex_destroy(&w->lock);
	}
	free(w);
	return NULL;
}

/* The device's worker, started by the first batch that needs it. */
static lobe_worker *get_worker(lobe_device *device)
{
	static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
	lobe_worker *w;
	pthread_mutex_lock(&lock);
	if (!device->worker)
		device->worker = new_worker();
	w = device->worker;
	pthread_mutex_unlock(&lock);
	return w;
}

lobe_status lobe_event_begin(lobe_event **out, lobe_scene *scene, const lobe_job *job)
{
	lobe_event *const e = new_event(scene, job);
	lobe_worker *const w = job->count ? get_worker(scene->device) : NULL;
	if (!e || (job->count && !w)) {
		if (e)
			e->done = 1;
		lobe_event_release(e);
		return lobe_fail(LOBE_ERROR_MEMORY, "no memory or thread for a batch that is not waited for");
	}
	*out = e;
	if (!w) {
		e->done = 1; /* nothing to do */
		return LOBE_OK;
	}
	pthread_mutex_lock(&w->lock);
	if (w->first)
		w->last->next = e;
	else
		w->first = e;
	w->last = e;
	pthread_cond_signal(&w->changed);
	pthread_mutex_unlock(&w->lock);
	return LOBE_OK;
}

void lobe_worker_end(lobe_worker *w)
{
	if (!w)
		return;
	pthread_mutex_lock(&w->lock);
	w->stop = 1;
	pthread_cond_signal(&w->changed);
	pthread_mutex_unlock(&w->lock);
	pthread_join(w->thread, NULL);
	pthread_cond_destroy(&w->changed);
	pthread_mutex_destroy(&w->lock);
	free(w);
}
