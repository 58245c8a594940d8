/* ggx.h - GGX (Trowbridge-Reitz): the surface of a unit hemisphere, whose tangents stretch to any width.
 *
 * Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014, "Understanding the masking-shadowing function". The functions
 * are those that facet.h explains. With v stretched, t(v) = |v|: Lambda = (|v|/|v.z| - 1)/2. */
#ifndef LOBE_MICROFACET_GGX_H
#define LOBE_MICROFACET_GGX_H

#include "../core/warp.h"
#include "facet.h"

LOBE_FN lobe_real lobe_ggx_t(lobe_vec3 v) { return lobe_sqrt(lobe_fma(v.x, v.x, lobe_fma(v.y, v.y, v.z * v.z))); }

/* pi D = 1/|h|^4. Infinite for h = 0, where there is no normal. */
LOBE_FN lobe_facet_density lobe_ggx_density(lobe_vec3 h)
{
	lobe_facet_density d;
	d.inv = LOBE_R(1.0) / lobe_fma(h.x, h.x, lobe_fma(h.y, h.y, h.z * h.z));
	d.factor = LOBE_R(1.0);
	return d;
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
 * of the unit sphere gives the normal c + v/t. Its z, (1 - u.y)(1 + v.z/t), is formed directly and stays above 0. */
LOBE_FN lobe_vec3 lobe_ggx_visible_above(lobe_vec3 v, lobe_real t, lobe_vec2 u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real inv_t = one / t;
	const lobe_real height = lobe_fma(v.z, inv_t, one);
	const lobe_vec3 c = lobe_spherical_cap(u, height);
	const lobe_real x = lobe_fma(v.x, inv_t, c.x);
	const lobe_real y = lobe_fma(v.y, inv_t, c.y);
	return lobe_vec3_make(x, y, (one - u.y) * height);
}

/* The same for v on either side: below the horizon 1 + v.z/t is (x^2 + y^2)/(t (t - v.z)). */
LOBE_FN lobe_vec3 lobe_ggx_visible(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real t = lobe_ggx_t(v);
	const lobe_real inv_t = one / t;
	const lobe_real r2 = lobe_fma(v.x, v.x, v.y * v.y);
	const lobe_real below = r2 * inv_t / (t + lobe_abs(v.z));
	const lobe_real above = lobe_fma(v.z, inv_t, one);
	const lobe_real height = v.z < LOBE_R(0.0) ? below : above;
	const lobe_vec3 c = lobe_spherical_cap(u, height);
	const lobe_real x = lobe_fma(v.x, inv_t, c.x);
	const lobe_real y = lobe_fma(v.y, inv_t, c.y);
	return lobe_vec3_make(x, y, (one - u.y) * height);
}

#endif
