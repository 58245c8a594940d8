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
#include "core/optics.h"
/* The rest of the toolbox, for a program that has not said which lobes it wants. Each lobe brings what it needs. */
#if LOBE_HAS_DEFAULT
#include "core/fresnel_schlick.h"
#include "core/fresnel_artist.h"
#include "core/airy.h"
#include "core/thin_film.h"
#include "microfacet/ggx.h"
#include "microfacet/beckmann.h"
#include "microfacet/distribution.h"
#include "microfacet/smith.h"
#include "recommend.h"
#endif
#include "bsdf.h"

#endif
