/* ggx.h - the anisotropic GGX (Trowbridge-Reitz) microsurface with Smith masking.
 *
 * Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014, "Understanding the masking-shadowing function".
 * Everything is written with t(w) = sqrt(ax^2 x^2 + ay^2 y^2 + z^2) in place of Lambda = (t/|z| - 1)/2: no tangent, no
 * division by a cosine, no cancellation at small roughness. For z > 0
 *	sigma(w) = (z + t)/2         projected area of the visible facets
 *	G1(w)    = z/sigma = 2z/(z + t)
 *	G2       = 2 z_o z_i/(z_i t_o + z_o t_i)     height-correlated, both directions on one side */
#ifndef LOBE_MICROFACET_GGX_H
#define LOBE_MICROFACET_GGX_H

#include "../core/constants.h"
#include "../core/warp.h"

/* Narrowest microsurface: make functions clamp alpha to [LOBE_ALPHA_MIN, 1]. */
#define LOBE_ALPHA_MIN LOBE_R(1e-4)

LOBE_FN lobe_real lobe_clamp_alpha(lobe_real alpha) { return lobe_clamp(alpha, LOBE_ALPHA_MIN, LOBE_R(1.0)); }

/* alpha_x, alpha_y: widths in [LOBE_ALPHA_MIN, 1]. The rest is prepared from them. */
typedef struct {
	lobe_real alpha_x, alpha_y;
	lobe_real inv_alpha_x, inv_alpha_y;
	lobe_real norm; /* 1/(pi alpha_x alpha_y) */
} lobe_ggx;

/* Clamps the widths to their domain; a NaN stays NaN. */
LOBE_FN lobe_ggx lobe_ggx_make(lobe_real alpha_x, lobe_real alpha_y)
{
	lobe_ggx d;
	d.alpha_x = lobe_clamp_alpha(alpha_x);
	d.alpha_y = lobe_clamp_alpha(alpha_y);
	d.inv_alpha_x = LOBE_R(1.0) / d.alpha_x;
	d.inv_alpha_y = LOBE_R(1.0) / d.alpha_y;
	d.norm = LOBE_INV_PI * d.inv_alpha_x * d.inv_alpha_y;
	return d;
}

/* t(w). */
LOBE_FN lobe_real lobe_ggx_t(lobe_ggx d, lobe_vec3 w)
{
	const lobe_real x = d.alpha_x * w.x;
	const lobe_real y = d.alpha_y * w.y;
	return lobe_sqrt(lobe_fma(x, x, lobe_fma(y, y, w.z * w.z)));
}

/* 1/Q(h), Q = (hx/ax)^2 + (hy/ay)^2 + hz^2, for a half vector of any length: D(h/|h|) = norm |h|^4/Q^2, so whatever
 * multiplies D takes its share of the length and nothing is normalised. Infinite for h = 0, where there is no half
 * vector. */
LOBE_FN lobe_real lobe_ggx_inv_q(lobe_ggx d, lobe_vec3 h)
{
	const lobe_real x = d.inv_alpha_x * h.x;
	const lobe_real y = d.inv_alpha_y * h.y;
	return LOBE_R(1.0) / lobe_fma(x, x, lobe_fma(y, y, h.z * h.z));
}

/* D(m), density of microfacet area per solid angle of m [1/sr]; |m| = 1, 0 for m.z <= 0. */
LOBE_FN lobe_real lobe_ggx_d(lobe_ggx d, lobe_vec3 m)
{
	const lobe_real x = lobe_ggx_inv_q(d, m);
	return m.z > LOBE_R(0.0) ? d.norm * x * x : LOBE_R(0.0);
}

/* A microfacet normal seen from w (w.z > 0, unit), times a positive number: distributed as D(m) max(0, w.m)/sigma(w).
 * t: lobe_ggx_t(d, w). u in [0,1)^2.
 *
 * Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps": in the space where the surface is a unit
 * hemisphere a point c uniform on the cap c.z >= -w'.z gives the normal c + w'. Its z, (1 - u.y)(1 + w'.z), is formed
 * directly and stays above 0. */
LOBE_FN lobe_vec3 lobe_ggx_sample_visible(lobe_ggx d, lobe_vec3 w, lobe_real t, lobe_vec2 u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real inv_t = one / t;
	const lobe_real height = lobe_fma(w.z, inv_t, one);
	const lobe_vec3 c = lobe_spherical_cap(u, height);
	const lobe_real x = lobe_fma(d.alpha_x * w.x, inv_t, c.x);
	const lobe_real y = lobe_fma(d.alpha_y * w.y, inv_t, c.y);
	return lobe_vec3_make(d.alpha_x * x, d.alpha_y * y, (one - u.y) * height);
}

/* G2/z_o, both directions above the surface: 2 z_i/(z_i t_o + z_o t_i). */
LOBE_FN lobe_real lobe_ggx_g2_over_cos(lobe_real z_o, lobe_real t_o, lobe_real z_i, lobe_real t_i)
{
	return (z_i + z_i) / lobe_fma(z_i, t_o, z_o * t_i);
}

#endif
