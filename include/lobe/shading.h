/* shading.h - the single source: all that both C99 and OpenCL C compile. */
#ifndef LOBE_SHADING_H
#define LOBE_SHADING_H

#include "backend/backend.h"
#include "core/real.h"
#include "core/constants.h"
#include "core/vec.h"
#include "core/event.h"
#include "core/frame.h"
#include "core/warp.h"
#include "core/fresnel.h"
#include "core/fresnel_schlick.h"
#include "core/fresnel_artist.h"
#include "core/airy.h"
#include "core/thin_film.h"
#include "core/optics.h"
#include "microfacet/ggx.h"
#include "microfacet/distribution.h"
#include "bsdf.h"

#endif
