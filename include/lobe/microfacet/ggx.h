/* ggx.h - GGX (Trowbridge-Reitz): the surface of a unit hemisphere, whose tangents stretch to any width.
 *
 * Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014, "Understanding the masking-shadowing function". The
 * functions are those that facet.h explains. With v stretched, t(v) = |v|: Lambda = (|v|/|v.z| - 1)/2. */
#ifndef LOBE_MICROFACET_GGX_H
#define LOBE_MICROFACET_GGX_H

#include "../core/warp.h"
#include "facet.h"

/* x^2 + y^2, of which every user of t has a part to share. */

LOBE_FN lobe_real lobe_ggx_t(lobe_vec3 v) { return lobe_sqrt(lobe_fma(v.z, v.z, lobe_vec3_xy2(v))); }

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
	const lobe_real sum = lobe_ggx_t(v) + lobe_abs(v.z);
	return LOBE_R(0.5) * lobe_vec3_xy2(v) / sum;
}

LOBE_FN lobe_real lobe_ggx_tail(lobe_real t2) { return LOBE_R(1.0) / (LOBE_R(1.0) + t2); }

/* q in (0, 1]. */
LOBE_FN lobe_real lobe_ggx_tail_inverse(lobe_real q) { return (LOBE_R(1.0) - q) / q; }

/* The normal that the part of the cap above u.y makes; height: t + v.z, r2: lobe_vec3_xy2. In lobe_sphere_cap's terms,
 * all t times as large: the point's z and v.z add up to (1 - u.y) height, which stays above 0, and since what the cap
 * leaves of the sphere, t - v.z, is r2/height, the point is off the axis by the root of u.y (r2 + z height), without a
 * difference. */
LOBE_FN lobe_vec3 lobe_ggx_visible_cap(lobe_vec3 v, lobe_real height, lobe_real r2, lobe_vec2 u)
{
	const lobe_real z = (LOBE_R(1.0) - u.y) * height;
	const lobe_real s = lobe_sqrt(u.y * lobe_fma(z, height, r2));
	const lobe_sincos sc = lobe_sincos_2pi_small(u.x);
	return lobe_vec3_make(lobe_fma(s, sc.c, v.x), lobe_fma(s, sc.s, v.y), z);
}

/* t: lobe_ggx_t(v); u in [0,1)^2. v.z > 0.
 *
 * Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps": a point c uniform on the cap c.z >=
 * -v.z/t of the unit sphere gives the normal c + v/t. Here all is t times as large, which saves the division. */
LOBE_FN lobe_vec3 lobe_ggx_visible_above(lobe_vec3 v, lobe_real t, lobe_vec2 u)
{
	return lobe_ggx_visible_cap(v, v.z + t, lobe_vec3_xy2(v), u);
}

/* The same for v on either side: below the horizon t + v.z is (x^2 + y^2)/(t - v.z). */
LOBE_FN lobe_vec3 lobe_ggx_visible(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real t = lobe_ggx_t(v);
	const lobe_real r2 = lobe_vec3_xy2(v);
	return lobe_ggx_visible_cap(v, v.z < LOBE_R(0.0) ? r2 / (t + lobe_abs(v.z)) : v.z + t, r2, u);
}

/* Eto and Tokuyoshi 2023, "Bounded VNDF sampling for Smith-GGX reflections": facets that reflect wo below the horizon
 * lie in the lower part of the cap, and what of it has no other can be left out. Of its depth v.z/t remains the share
 *	k = (1 - a^2) s^2/(s^2 + a^2 z^2),   s = 1 + sin theta_o,
 * a being the lesser width. With s^2 + z^2 = 2 s, since wo is of length 1, s cancels out of
 *	k = (1 - a^2) s/((1 - a^2) s + 2 a^2)
 * A greater s is as right and leaves out a little less: the sine is taken from above, since a root would cost a tenth of
 * a sample.
 *
 * narrow2: a^2, in [0, 1]. wo: not stretched, wo.z >= 0. */
LOBE_FN lobe_facet_bound lobe_ggx_bound(lobe_real narrow2, lobe_vec3 wo)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real less = (one - narrow2) * lobe_sqrt_above(lobe_vec3_xy2(wo));
	lobe_facet_bound b;
	b.part = (one - narrow2) + less;
	b.whole = (one + narrow2) + less;
	return b;
}

/* Those that b leaves; v.z > 0. As above, all of it b.whole times as large. cut: what the bound takes off the cap's
 * height and gives to the normal's. */
LOBE_FN lobe_vec3 lobe_ggx_visible_bounded(lobe_vec3 v, lobe_real t, lobe_facet_bound b, lobe_vec2 u)
{
	const lobe_real cut = (b.whole - b.part) * v.z;
	const lobe_real height = lobe_facet_bound_sum(b, v.z, t);
	const lobe_real z = lobe_fma(LOBE_R(1.0) - u.y, height, cut);
	/* (t - v.z) height without its difference, which matters where nothing is cut. */
	const lobe_real above = lobe_fma(-cut, t - v.z, b.whole * lobe_vec3_xy2(v));
	const lobe_real s = lobe_sqrt(u.y * lobe_fma(z, height, b.whole * above));
	const lobe_sincos sc = lobe_sincos_2pi_small(u.x);
	return lobe_vec3_make(lobe_fma(s, sc.c, b.whole * v.x), lobe_fma(s, sc.s, b.whole * v.y), z);
}

#endif
