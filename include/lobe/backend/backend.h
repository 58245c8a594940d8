/* backend.h - the one place that asks which compiler reads the source. */
#ifndef LOBE_BACKEND_H
#define LOBE_BACKEND_H

#include "../config.h"

#ifdef __OPENCL_VERSION__
#include "opencl.h"
#else
#include "c99.h"
#endif

#endif
