/* optics.h - measured optical constants by name: metals as RGB, dielectrics as one index. The numbers and their sources
 * are in optics.def. */
#ifndef LOBE_CORE_OPTICS_H
#define LOBE_CORE_OPTICS_H

#include "vec.h"

/* LOBE_METAL_GOLD ... , LOBE_METAL_COUNT; LOBE_GLASS_WATER ... , LOBE_GLASS_COUNT */
enum {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb) LOBE_METAL_##NAME,
#define LOBE_GLASS(NAME, name, n)
#include "optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
	LOBE_METAL_COUNT
};

enum {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb)
#define LOBE_GLASS(NAME, name, n) LOBE_GLASS_##NAME,
#include "optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
	LOBE_GLASS_COUNT
};

/* Real part n of a metal's complex index n + ik. metal: LOBE_METAL_*; anything else gives 1. */
LOBE_FN lobe_rgb lobe_metal_eta(lobe_uint metal)
{
	switch (metal) {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb)                                                                 \
	case LOBE_METAL_##NAME:                                                                                        \
		return lobe_rgb_make(LOBE_R(nr), LOBE_R(ng), LOBE_R(nb));
#define LOBE_GLASS(NAME, name, n)
#include "optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
	default:
		return lobe_rgb_make(LOBE_R(1.0), LOBE_R(1.0), LOBE_R(1.0));
	}
}

/* Imaginary part k (absorption). metal: LOBE_METAL_*; anything else gives 0. */
LOBE_FN lobe_rgb lobe_metal_k(lobe_uint metal)
{
	switch (metal) {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb)                                                                 \
	case LOBE_METAL_##NAME:                                                                                        \
		return lobe_rgb_make(LOBE_R(kr), LOBE_R(kg), LOBE_R(kb));
#define LOBE_GLASS(NAME, name, n)
#include "optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
	default:
		return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
	}
}

/* Index of a transparent solid or liquid over air. glass: LOBE_GLASS_*; anything else gives 1. */
LOBE_FN lobe_real lobe_glass_eta(lobe_uint glass)
{
	switch (glass) {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb)
#define LOBE_GLASS(NAME, name, n)                                                                                      \
	case LOBE_GLASS_##NAME:                                                                                        \
		return LOBE_R(n);
#include "optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
	default:
		return LOBE_R(1.0);
	}
}

#endif
