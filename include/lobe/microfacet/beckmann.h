/* beckmann.h - Beckmann: normally distributed slopes of variance 1/2 each, stretched to any width.
 *
 * Beckmann and Spizzichino 1963; Walter et al. 2007; Heitz 2014. The functions are those that facet.h explains. */
#ifndef LOBE_MICROFACET_BECKMANN_H
#define LOBE_MICROFACET_BECKMANN_H

#include "../core/real.h"
#include "facet.h"

/* pi D = exp(-tan^2)/cos^4. Infinite or NaN for h.z = 0. */
LOBE_FN lobe_facet_density lobe_beckmann_density(lobe_vec3 h)
{
	lobe_facet_density d;
	d.inv = LOBE_R(1.0) / (h.z * h.z);
	d.factor = lobe_exp(-lobe_fma(h.x, h.x, h.y * h.y) * d.inv);
	return d;
}

LOBE_FN lobe_real lobe_beckmann_tail(lobe_real t2) { return lobe_exp(-t2); }

#endif
