/* tabulated.h - any isotropic distribution that the user tells by its density as a function of tan theta.
 *
 * Heitz 2014, section 5.2: D(m) = f(tan theta/alpha)/(pi alpha^2 cos^4 theta), whatever f: then Lambda depends on
 * cot theta/alpha alone, which a stretch (stretch.h) makes true by construction. The functions are those that facet.h
 * explains, all from one table (profile.h) that lobe_distribution_tabulated() makes of f.
 *
 * Largest relative error of density, hidden and tail against quadrature of f: 1e-5 for a smooth f
 * (tests/test_distributions.c); what an f with jumps costs is said there too. */
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
