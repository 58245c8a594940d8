/* tabulated.h - any isotropic distribution that the user tells by its density as a function of tan theta.
 *
 * Heitz 2014, section 5.2: D(m) = f(tan theta/alpha)/(pi alpha^2 cos^4 theta), whatever f: then Lambda depends on
 * cot theta/alpha alone, which a stretch (stretch.h) makes true by construction. The functions are those that facet.h
 * explains, all from one table (profile.h) that lobe_distribution_tabulated() makes of f.
 *
 * Largest relative error against quadrature of f (tests/test_distributions.c), for two Gaussians, an exponential,
 * rings, and steps with gaps: hidden 5e-6 where it is above 1e-4 of its largest and 3e-5 down to 1e-33 of it; tail 4e-6
 * and 2e-5; density, where it is above 1e-4 of its largest, 3e-5, or 1e-4 where f jumps elsewhere, or 5e-4 at a cusp at
 * the normal. A ring whose width is a hundredth of its steepness is near the resolution of a float: 1e-4. */
#ifndef LOBE_MICROFACET_TABULATED_H
#define LOBE_MICROFACET_TABULATED_H

#include "profile_visible.h"
#include "shape.h"

LOBE_FN lobe_facet_density lobe_tabulated_density(lobe_distribution d, lobe_vec3 h)
{
	return lobe_profile_density(d.table, h);
}
LOBE_FN lobe_real lobe_tabulated_hidden(lobe_distribution d, lobe_vec3 v) { return lobe_profile_hidden(d.table, v); }
LOBE_FN lobe_real lobe_tabulated_tail(lobe_distribution d, lobe_real t2) { return lobe_profile_tail(d.table, t2); }
LOBE_FN lobe_real lobe_tabulated_tail_inverse(lobe_distribution d, lobe_real q)
{
	return lobe_profile_tail_inverse(d.table, q);
}
LOBE_FN lobe_vec3 lobe_tabulated_visible(lobe_distribution d, lobe_vec3 v, lobe_vec2 u)
{
	return lobe_profile_visible(d.table, v, u);
}

#endif
