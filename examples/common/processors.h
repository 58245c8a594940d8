/* processors.h - how many threads find a processor of their own. */
#ifndef COMMON_PROCESSORS_H
#define COMMON_PROCESSORS_H

#include <stddef.h>

/* Processors that this process may run on: fewer than are online under taskset or in a container. At least 1. */
size_t processor_count(void);

#endif
