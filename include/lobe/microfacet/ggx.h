/* ggx.h - GGX (Trowbridge-Reitz): the surface of a unit hemisphere, whose tangents stretch to any width.
 *
 * Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014, "Understanding the masking-shadowing function". The functions
 * are those that facet.h explains. With v stretched, t(v) = |v|: Lambda = (|v|/|v.z| - 1)/2. */
#ifndef LOBE_MICROFACET_GGX_H
#define LOBE_MICROFACET_GGX_H

#include "../core/warp.h"
#include "facet.h"

LOBE_FN lobe_real lobe_ggx_t(lobe_vec3 v) { return lobe_sqrt(lobe_fma(v.x, v.x, lobe_fma(v.y, v.y, v.z * v.z))); }

/* pi D = 1/|h|^4, inv over s. h2: the squares of h. Infinite for h = 0, where there is no normal. */
LOBE_FN lobe_facet_density lobe_ggx_density_over(lobe_vec3 h2, lobe_real s)
{
	lobe_facet_density d;
	d.inv = LOBE_R(1.0) / (lobe_vec3_sum(h2) * s);
	d.factor = LOBE_R(1.0);
	return d;
}

LOBE_FN lobe_facet_density lobe_ggx_density(lobe_vec3 h)
{
	return lobe_ggx_density_over(lobe_vec3_squares(h), LOBE_R(1.0));
}

/* (t - |z|)/2 as (x^2 + y^2)/(2 (t + |z|)). */
LOBE_FN lobe_real lobe_ggx_hidden(lobe_vec3 v)
{
	const lobe_real r2 = lobe_fma(v.x, v.x, v.y * v.y);
	const lobe_real sum = lobe_ggx_t(v) + lobe_abs(v.z);
	return LOBE_R(0.5) * r2 / sum;
}

LOBE_FN lobe_real lobe_ggx_tail(lobe_real t2) { return LOBE_R(1.0) / (LOBE_R(1.0) + t2); }

/* q in (0, 1]. */
LOBE_FN lobe_real lobe_ggx_tail_inverse(lobe_real q) { return (LOBE_R(1.0) - q) / q; }

/* t: lobe_ggx_t(v); u in [0,1)^2. v.z > 0.
 *
 * Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps": a point c uniform on the cap c.z >= -v.z/t
 * of the unit sphere gives the normal c + v/t. Here all is t times as large, which saves the division. Its z,
 * (1 - u.y)(t + v.z), is formed directly and stays above 0. */
LOBE_FN lobe_vec3 lobe_ggx_visible_above(lobe_vec3 v, lobe_real t, lobe_vec2 u)
{
	const lobe_real height = v.z + t;
	const lobe_vec3 c = lobe_sphere_cap(u, t, height);
	return lobe_vec3_make(v.x + c.x, v.y + c.y, (LOBE_R(1.0) - u.y) * height);
}

/* The same for v on either side: below the horizon t + v.z is (x^2 + y^2)/(t - v.z). */
LOBE_FN lobe_vec3 lobe_ggx_visible(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real t = lobe_ggx_t(v);
	const lobe_real below = lobe_fma(v.x, v.x, v.y * v.y) / (t + lobe_abs(v.z));
	const lobe_real height = v.z < LOBE_R(0.0) ? below : v.z + t;
	const lobe_vec3 c = lobe_sphere_cap(u, t, height);
	return lobe_vec3_make(v.x + c.x, v.y + c.y, (LOBE_R(1.0) - u.y) * height);
}

#endif
