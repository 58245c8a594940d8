/* lobes.h - the headers of the lobes that config.h asks for. */
#ifndef LOBE_LOBES_H
#define LOBE_LOBES_H

#include "../config.h"

#if LOBE_HAS_LAMBERT
#include "lambert.h"
#endif
#if LOBE_HAS_GGX_CONDUCTOR
#include "ggx_conductor.h"
#endif
#if LOBE_HAS_GGX_DIELECTRIC
#include "ggx_dielectric.h"
#endif
#if LOBE_HAS_BECKMANN_CONDUCTOR
#include "beckmann_conductor.h"
#endif
#if LOBE_HAS_BECKMANN_DIELECTRIC
#include "beckmann_dielectric.h"
#endif

#endif
