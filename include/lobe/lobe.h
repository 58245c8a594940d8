/* lobe.h - the whole C API: the shading functions of shading.h, the batches of batch.h, and what a host prepares for
 * them: tables of distributions (profile_table.h), metals by name (optics_names.h), moments of slopes (slopes.h).
 *
 * To use one lobe alone include its header, e.g. "lobe/lobes/ggx_conductor.h"; there is nothing to link but libm. */
#ifndef LOBE_H
#define LOBE_H

#include "shading.h"
#include "batch.h"
#include "profile_table.h"
#include "optics_names.h"
#include "slopes.h"

#endif
