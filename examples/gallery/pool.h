/* pool.h - threads that share the elements of a loop. Which thread does what never shows in the results. */
#ifndef GALLERY_POOL_H
#define GALLERY_POOL_H

#include <stddef.h>

enum { POOL_CHUNK = 2048 };

/* Elements [begin, end) of a loop; begin is a multiple of POOL_CHUNK, end - begin at most that. */
typedef void pool_work(void *context, size_t begin, size_t end);

struct pool;

/* threads 0: as many as this process may use, at most 256. NULL when memory or threads run out. */
struct pool *pool_create(size_t threads);
void pool_destroy(struct pool *pool);

/* Calls work for all chunks of [0, count), this thread helping, and returns when they are done. */
void pool_for(struct pool *pool, size_t count, pool_work *work, void *context);

#endif
