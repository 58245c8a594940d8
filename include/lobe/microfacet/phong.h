/* phong.h - Phong: normals about the mean normal with density D = (n + 2)/(2 pi) cos^n. The normals of Blinn-Phong are
 * the same, as half vectors are normals: an exponent of Blinn 1977 is this n.
 *
 * Phong 1975; Blinn 1977; Walter et al. 2007, section 5.2. The functions are those that facet.h explains. As slopes it
 * is (n + 2)/(2 pi) (1 + r^2)^(-(n + 4)/2): exactly Student-T (student_t.h) with gamma = (n + 4)/2 and width
 * lobe_phong_alpha(n), so its masking is Student-T's, and at n = 0 it is GGX of width 1. n is a shape, not a width: no
 * stretch turns one exponent into another.
 *
 * Largest relative error, single precision against quadrature, n = 0 to 2e8 (tests/test_distributions.c): density 2e-6,
 * hidden 3e-6, tail 2e-6 where the value is above 1e-4 of its largest; 2e-5 each down to 1e-33 of it. */
#ifndef LOBE_MICROFACET_PHONG_H
#define LOBE_MICROFACET_PHONG_H

#include "beckmann.h"
#include "../core/powers.h"
#include "profile_visible.h"
#include "shape.h"

/* Smallest and largest exponent: those of widths 1 and 1e-4. */
#define LOBE_PHONG_N_MAX LOBE_R(2e+8)

/* The width of the Beckmann surface with the same D at its peak (Walter et al. 2007): sqrt(2/(n + 2)), n in [0,
 * LOBE_PHONG_N_MAX]; and the exponent of a width alpha in [1e-4, 1]. */
LOBE_FN lobe_real lobe_phong_alpha(lobe_real n) { return lobe_sqrt(LOBE_R(2.0) / (n + LOBE_R(2.0))); }
LOBE_FN lobe_real lobe_phong_exponent(lobe_real alpha)
{
	const lobe_real one = LOBE_R(1.0);
	return LOBE_R(2.0) * ((one - alpha) * (one + alpha)) / (alpha * alpha);
}

/* d.exponent: n. d.norm: 1 + n/2. */
LOBE_FN lobe_facet_density lobe_phong_density(lobe_distribution d, lobe_vec3 h)
{
	const lobe_real r2 = lobe_vec3_xy2(h);
	const lobe_real z2 = h.z * h.z;
	lobe_facet_density f;
	f.inv = LOBE_R(1.0) / (r2 + z2);
	f.factor = d.norm * lobe_decay(r2 / z2, LOBE_R(0.5) * d.exponent);
	return f;
}

LOBE_FN lobe_real lobe_phong_hidden(lobe_distribution d, lobe_vec3 v) { return lobe_profile_hidden(d.table, v); }
LOBE_FN lobe_real lobe_phong_tail(lobe_distribution d, lobe_real t2) { return lobe_decay(t2, d.norm); }
LOBE_FN lobe_real lobe_phong_tail_inverse(lobe_distribution d, lobe_real q)
{
	return lobe_decay_inverse(q, LOBE_R(1.0) / d.norm);
}
LOBE_FN lobe_vec3 lobe_phong_visible(lobe_distribution d, lobe_vec3 v, lobe_vec2 u)
{
	return lobe_profile_visible(d.table, v, u);
}

/* For comparison, hidden(v) by the approximation of Walter et al. 2007: their rational fit to Beckmann's masking, at a
 * = sqrt(n/2 + 1)/tan theta, cut off at a = 1.6. Error of G1 against the exact masking: .047 at n = 5, .015 at 20, .004
 * at 100, and the fit's own .0032 beyond. */
LOBE_FN lobe_real lobe_phong_hidden_walter(lobe_distribution d, lobe_vec3 v)
{
	const lobe_real alpha = LOBE_R(1.0) / lobe_sqrt(d.norm);
	return lobe_beckmann_hidden_rational(lobe_vec3_make(alpha * v.x, alpha * v.y, v.z));
}

#endif
