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
#if LOBE_HAS_GGX_SCHLICK
#include "ggx_schlick.h"
#endif
#if LOBE_HAS_MIRROR
#include "mirror.h"
#endif
#if LOBE_HAS_SMOOTH_CONDUCTOR
#include "smooth_conductor.h"
#endif
#if LOBE_HAS_SMOOTH_DIELECTRIC
#include "smooth_dielectric.h"
#endif
#if LOBE_HAS_THIN_DIELECTRIC
#include "thin_dielectric.h"
#endif
#if LOBE_HAS_IRIDESCENT_CONDUCTOR
#include "iridescent_conductor.h"
#endif
#if LOBE_HAS_IRIDESCENT_DIELECTRIC
#include "iridescent_dielectric.h"
#endif
#if LOBE_HAS_MICROFACET_CONDUCTOR
#include "microfacet_conductor.h"
#endif
#if LOBE_HAS_MICROFACET_DIELECTRIC
#include "microfacet_dielectric.h"
#endif
#if LOBE_HAS_MICROFACET_DIFFUSE
#include "microfacet_diffuse.h"
#endif

#endif
