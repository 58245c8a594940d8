/* stretched_ggx.h - the anisotropic GGX as tests speak of it: stretch.h on top of ggx.h. */
#ifndef LOBE_TESTS_STRETCHED_GGX_H
#define LOBE_TESTS_STRETCHED_GGX_H

#include "lobe/microfacet/ggx.h"
#include "lobe/microfacet/stretch.h"

/* D(m) [1/sr], |m| = 1; 0 below the horizon. */
static inline lobe_real stretched_ggx_d(lobe_stretch s, lobe_vec3 m)
{
	const lobe_facet_density d = lobe_ggx_density(lobe_stretch_facet(s, m));
	return m.z > 0 ? s.norm * d.inv * d.inv : 0;
}

/* t(w) = sigma(w) + sigma(-w). */
static inline lobe_real stretched_ggx_t(lobe_stretch s, lobe_vec3 w)
{
	return lobe_ggx_t(lobe_stretch_direction(s, w));
}

/* A normal visible from w, w.z > 0, times a positive number: t times as long as the sum of a cap's point and the unit
 * vector of the stretched w is. t: stretched_ggx_t(s, w). */
static inline lobe_vec3 stretched_ggx_visible(lobe_stretch s, lobe_vec3 w, lobe_real t, lobe_vec2 u)
{
	return lobe_stretch_normal(s, lobe_ggx_visible_above(lobe_stretch_direction(s, w), t, u));
}

#endif
