/* sound.h - what eval, pdf and weights are wherever they are asked: finite and not negative. */
#ifndef LOBE_TESTS_SOUND_H
#define LOBE_TESTS_SOUND_H

#include "lobe/core/vec.h"

static inline int sound(lobe_real x) { return x >= 0.0f && x <= LOBE_REAL_MAX; }

static inline int sound_rgb(lobe_rgb c) { return sound(c.r) && sound(c.g) && sound(c.b); }

#endif
