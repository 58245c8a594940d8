/* thread.c - a new thread takes its mask of signals from the one that starts it. */
#define _POSIX_C_SOURCE 200809L
#include "thread.h"

#include <signal.h>

int lobe_thread_create(pthread_t *thread, void *(*work)(void *), void *context)
{
	sigset_t all, before;
	sigfillset(&all);
	int error = pthread_sigmask(SIG_SETMASK, &all, &before);
	if (error)
		return error;
	error = pthread_create(thread, NULL, work, context);
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	return error;
}
