/* delta.h - where refraction by a rough interface is too narrow for directions of floats. */
#ifndef LOBE_MICROFACET_DELTA_H
#define LOBE_MICROFACET_DELTA_H

#include "../core/vec.h"

/* A facet turns light by about |eta - 1|, so refracted light spreads over alpha |eta - 1|: 32 roundings of a unit
 * vector. */
#define LOBE_DIELECTRIC_DELTA LOBE_R(2e-6)

/* alpha: the wider width. */
LOBE_FN int lobe_dielectric_is_delta(lobe_real alpha, lobe_real eta)
{
	return alpha * lobe_abs(eta - LOBE_R(1.0)) < LOBE_DIELECTRIC_DELTA;
}

#endif
