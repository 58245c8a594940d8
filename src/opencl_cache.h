/* opencl_cache.h - files that outlive the process: what was expensive to make, found again by all that it was made
 * from.
 *
 * The folder is $LOBE_CACHE_DIR, else $XDG_CACHE_HOME/lobe, else $HOME/.cache/lobe; with LOBE_CACHE_DIR empty, or no
 * folder that can be written, there is no cache. Nothing here fails: what cannot be read is not there, and what cannot
 * be written is not kept. */
#ifndef LOBE_OPENCL_CACHE_H
#define LOBE_OPENCL_CACHE_H

#include <stddef.h>

/* Whether LOBE_CACHE_DIR is set, and not to "". */
int lobe_cl_cache_asked_for(void);

/* The data last put under key, the caller's to free, and *size; NULL when there is none or the file is not whole. */
void *lobe_cl_cache_get(const char *key, size_t key_size, size_t *size);

/* Keeps data under key, and the whole cache within its bound by removing what has not been used for longest. Processes
 * and threads may do so at the same time. */
void lobe_cl_cache_put(const char *key, size_t key_size, const void *data, size_t size);

#endif
