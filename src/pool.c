/* pool.c - threads are started once and sleep between jobs; chunks are handed out one by one under the lock, which is
 * cheap beside a chunk's thousands of elements. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdlib.h>

#include "pool.h"
#include "thread.h"

struct lobe_pool {
	pthread_mutex_t lock;
	pthread_cond_t wake, idle;
	pthread_t *workers;
	size_t worker_count;

	/* Under the lock. */
	lobe_pool_work work;
	void *context;
	size_t next, chunks; /* chunks [next, chunks) are not taken yet */
	size_t running;      /* chunks taken and not done */
	size_t joined;       /* workers that have taken a number */
	int stop;
};

/* Takes and does chunks until none is left. Called and returns with the lock held. */
static void drain(lobe_pool *pool, size_t thread)
{
	while (pool->next < pool->chunks) {
		const size_t chunk = pool->next++;
		const lobe_pool_work work = pool->work;
		void *context = pool->context;
		pool->running++;
		pthread_mutex_unlock(&pool->lock);
		work(context, chunk, thread);
		pthread_mutex_lock(&pool->lock);
		pool->running--;
	}
	if (pool->running == 0)
		pthread_cond_signal(&pool->idle);
}

static void *worker(void *argument)
{
	lobe_pool *pool = argument;
	pthread_mutex_lock(&pool->lock);
	const size_t thread = ++pool->joined;
	while (!pool->stop) {
		drain(pool, thread);
		if (!pool->stop)
			pthread_cond_wait(&pool->wake, &pool->lock);
	}
	pthread_mutex_unlock(&pool->lock);
	return NULL;
}

/* 0: the system has none left, and none is kept. */
static int create_locks(lobe_pool *pool)
{
	if (pthread_mutex_init(&pool->lock, NULL) != 0)
		return 0;
	if (pthread_cond_init(&pool->wake, NULL) == 0) {
		if (pthread_cond_init(&pool->idle, NULL) == 0)
			return 1;
		pthread_cond_destroy(&pool->wake);
	}
	pthread_mutex_destroy(&pool->lock);
	return 0;
}

lobe_pool *lobe_pool_create(size_t threads)
{
	lobe_pool *pool = calloc(1, sizeof *pool);
	if (!pool || !create_locks(pool)) {
		free(pool);
		return NULL;
	}
	pool->workers = calloc(threads, sizeof *pool->workers);
	if (!pool->workers) {
		lobe_pool_destroy(pool);
		return NULL;
	}
	for (size_t i = 1; i < threads; i++) {
		if (lobe_thread_create(&pool->workers[pool->worker_count], worker, pool) != 0) {
			lobe_pool_destroy(pool);
			return NULL;
		}
		pool->worker_count++;
	}
	return pool;
}

void lobe_pool_destroy(lobe_pool *pool)
{
	if (!pool)
		return;
	pthread_mutex_lock(&pool->lock);
	pool->stop = 1;
	pthread_cond_broadcast(&pool->wake);
	pthread_mutex_unlock(&pool->lock);
	for (size_t i = 0; i < pool->worker_count; i++)
		pthread_join(pool->workers[i], NULL);
	pthread_cond_destroy(&pool->idle);
	pthread_cond_destroy(&pool->wake);
	pthread_mutex_destroy(&pool->lock);
	free(pool->workers);
	free(pool);
}

void lobe_pool_run(lobe_pool *pool, lobe_pool_work work, void *context, size_t chunks)
{
	pthread_mutex_lock(&pool->lock);
	pool->work = work;
	pool->context = context;
	pool->next = 0;
	pool->chunks = chunks;
	/* No more than can find a chunk beside the caller. */
	for (size_t i = 1; i < chunks && i <= pool->worker_count; i++)
		pthread_cond_signal(&pool->wake);
	drain(pool, 0);
	while (pool->running > 0)
		pthread_cond_wait(&pool->idle, &pool->lock);
	pthread_mutex_unlock(&pool->lock);
}
