/* pool.h - a fixed set of threads that share out the chunks of a job. */
#ifndef LOBE_POOL_H
#define LOBE_POOL_H

#include <stddef.h>

typedef struct lobe_pool lobe_pool;

/* Does chunk number chunk of context. thread: 0 .. threads-1, for scratch memory of its own. */
typedef void (*lobe_pool_work)(void *context, size_t chunk, size_t thread);

/* A pool of threads (1 or more), the caller's among them. NULL when the system has no more threads or memory. */
lobe_pool *lobe_pool_create(size_t threads);

/* Ends the threads. The pool must be idle. NULL does nothing. */
void lobe_pool_destroy(lobe_pool *pool);

/* Runs work for chunks [0, chunks), in any order and on any thread; returns when all are done. One call at a time. */
void lobe_pool_run(lobe_pool *pool, lobe_pool_work work, void *context, size_t chunks);

#endif
