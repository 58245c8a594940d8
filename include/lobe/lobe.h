/* lobe.h - the whole C API: the shading functions of shading.h and the batches of batch.h.
 *
 * To use one lobe alone include its header, e.g. "lobe/lobes/ggx_conductor.h"; there is nothing to link. */
#ifndef LOBE_H
#define LOBE_H

#include "shading.h"
#include "batch.h"
#include "profile_table.h"
#include "optics_names.h"

#endif
