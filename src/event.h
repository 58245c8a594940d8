/* event.h - batches that run behind the caller. */
#ifndef LOBE_EVENT_H
#define LOBE_EVENT_H

#include "internal.h"

/* Queues a job that has been checked, behind those that the device has been given before. count may be 0. */
lobe_status lobe_event_begin(lobe_event **out, lobe_scene *scene, const lobe_job *job);

/* Ends a device's thread once it has done what it was given. NULL does nothing. */
void lobe_worker_end(lobe_worker *worker);

#endif
