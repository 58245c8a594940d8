/* pool.c - see pool.h. */
#define _POSIX_C_SOURCE 200809L
#include "pool.h"

#include "processors.h"

#include <pthread.h>
#include <stdlib.h>

struct pool {
	pthread_mutex_t mutex;
	pthread_cond_t start, done;
	pool_work *work;
	void *context;
	size_t count, next, busy; /* elements, first one nobody has taken, threads at work */
	unsigned loop;            /* number of the loop, so that a thread joins each once */
	int stop;
	size_t threads;
	pthread_t thread[];
};

/* Takes chunks until there are none. Called and returns with the mutex held. */
static void run_chunks(struct pool *pool)
{
	while (pool->next < pool->count) {
		const size_t begin = pool->next;
		const size_t end = pool->count - begin < POOL_CHUNK ? pool->count : begin + POOL_CHUNK;
		pool->next = end;
		pthread_mutex_unlock(&pool->mutex);
		pool->work(pool->context, begin, end);
		pthread_mutex_lock(&pool->mutex);
	}
}

static void *thread_main(void *argument)
{
	struct pool *pool = argument;
	unsigned seen = 0;
	pthread_mutex_lock(&pool->mutex);
	while (!pool->stop) {
		if (pool->loop == seen) {
			pthread_cond_wait(&pool->start, &pool->mutex);
			continue;
		}
		seen = pool->loop;
		pool->busy++;
		run_chunks(pool);
		if (--pool->busy == 0)
			pthread_cond_signal(&pool->done);
	}
	pthread_mutex_unlock(&pool->mutex);
	return NULL;
}

struct pool *pool_create(size_t threads)
{
	if (threads == 0) {
		threads = processor_count();
		threads = threads > 256 ? 256 : threads;
	}
	struct pool *pool = calloc(1, sizeof *pool + (threads - 1) * sizeof pool->thread[0]);
	if (!pool)
		return NULL;
	pthread_mutex_init(&pool->mutex, NULL);
	pthread_cond_init(&pool->start, NULL);
	pthread_cond_init(&pool->done, NULL);
	for (; pool->threads < threads - 1; pool->threads++)
		if (pthread_create(&pool->thread[pool->threads], NULL, thread_main, pool) != 0) {
			pool_destroy(pool);
			return NULL;
		}
	return pool;
}

void pool_destroy(struct pool *pool)
{
	if (!pool)
		return;
	pthread_mutex_lock(&pool->mutex);
	pool->stop = 1;
	pthread_cond_broadcast(&pool->start);
	pthread_mutex_unlock(&pool->mutex);
	for (size_t i = 0; i < pool->threads; i++)
		pthread_join(pool->thread[i], NULL);
	pthread_cond_destroy(&pool->start);
	pthread_cond_destroy(&pool->done);
	pthread_mutex_destroy(&pool->mutex);
	free(pool);
}

void pool_for(struct pool *pool, size_t count, pool_work *work, void *context)
{
	pthread_mutex_lock(&pool->mutex);
	pool->work = work;
	pool->context = context;
	pool->count = count;
	pool->next = 0;
	pool->loop++;
	if (count > POOL_CHUNK)
		pthread_cond_broadcast(&pool->start);
	run_chunks(pool);
	while (pool->busy > 0)
		pthread_cond_wait(&pool->done, &pool->mutex);
	/* A thread that wakes up only now finds nothing left to take. */
	pthread_mutex_unlock(&pool->mutex);
}
