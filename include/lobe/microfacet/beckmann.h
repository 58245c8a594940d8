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

/* Walter et al. 2007: (1 - 1.259 a + .396 a^2)/(3.535 a + 2.181 a^2) below a = 1.6, 0 above; a = cot/width. */
LOBE_FN lobe_real lobe_beckmann_hidden_rational(lobe_vec3 v)
{
	const lobe_real r = lobe_sqrt(lobe_fma(v.x, v.x, v.y * v.y));
	const lobe_real z = lobe_abs(v.z);
	const lobe_real num = lobe_fma(LOBE_R(0.396) * z, z, lobe_fma(LOBE_R(-1.259) * z, r, r * r));
	const lobe_real den = lobe_fma(LOBE_R(2.181), z, LOBE_R(3.535) * r);
	return z < LOBE_R(1.6) * r ? num / den : LOBE_R(0.0);
}

LOBE_FN lobe_real lobe_beckmann_tail(lobe_real t2) { return lobe_exp(-t2); }

#endif
