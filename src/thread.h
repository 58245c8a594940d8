/* thread.h - threads of the library's own. */
#ifndef LOBE_THREAD_H
#define LOBE_THREAD_H

#include <pthread.h>

/* pthread_create with every signal blocked in the new thread: the program's signals are for its own. */
int lobe_thread_create(pthread_t *thread, void *(*work)(void *), void *context);

#endif
