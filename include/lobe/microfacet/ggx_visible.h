/* ggx_visible.h - GGX's visible normals by the ways that came before spherical caps (ggx.h).
 *
 * For comparison. All are of the surface of width 1 seen from v, of any length and on either side of the horizon. With
 * o = v/t, c = o.z and e the horizontal direction of v, everything happens in the plane of e and z: a visible normal is
 *	q (x e + z up) + p T,   x, z = sqrt(1 - y^2) o - y (c e - s up)
 * with T across that plane and y uniform on [-c, 1]: the cut of the hemisphere by a plane parallel to it, seen from v.
 * What differs is how p and q = sqrt(1 - p^2), the cut, are drawn. */
#ifndef LOBE_MICROFACET_GGX_VISIBLE_H
#define LOBE_MICROFACET_GGX_VISIBLE_H

#include "ggx.h"

/* The normal at y = u (1 + c) - c. Its z is 0 at u = 0; where its two terms have opposite signs it is the difference of
 * squares (y + c)(y - c) over what does not cancel. */
LOBE_FN lobe_vec3 lobe_ggx_visible_cut(lobe_vec3 v, lobe_real u, lobe_real p, lobe_real q)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_real inv_t = one / lobe_ggx_t(v);
	const lobe_real length = lobe_sqrt(lobe_vec3_xy2(v));
	const lobe_real inv_length = one / length;
	const lobe_real ex = length > zero ? v.x * inv_length : one;
	const lobe_real ey = length > zero ? v.y * inv_length : zero;
	const lobe_real c = v.z * inv_t, s = length * inv_t;
	/* 1 + c and 1 - c, the lesser as s^2 over the greater. */
	const lobe_real more = one + lobe_abs(c);
	const lobe_real less = s * s / more;
	const lobe_real height = c < zero ? less : more;
	const lobe_real depth = c < zero ? more : less;
	const lobe_real y = lobe_fma(u, height, -c);
	const lobe_real root = lobe_sqrt((one - u) * height * lobe_fma(u, height, depth));
	const lobe_real a = c * root, b = s * y;
	const lobe_real quotient = u * height * ((y - c) / (b - a));
	const lobe_real x = lobe_fma(s, root, -c * y);
	const lobe_real z = lobe_min(c, y) < zero ? quotient : a + b;
	const lobe_real qx = q * x;
	return lobe_vec3_make(lobe_fma(qx, ex, -p * ey), lobe_fma(qx, ey, p * ex), q * z);
}

/* Heitz 2018, "Sampling the GGX distribution of visible normals": the hemisphere's projection along v is a half disk
 * and a half ellipse, of which a disk's points are moved to. */
LOBE_FN lobe_vec3 lobe_ggx_visible_ellipsoid(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real one = LOBE_R(1.0);
	/* Of each cell of u.x the middle: a point on the rim would be a normal at the horizon. */
	const lobe_real r2 = lobe_fma(u.x, LOBE_BELOW_ONE, LOBE_R(0x1p-25));
	const lobe_real r = lobe_sqrt(r2);
	const lobe_sincos sc = lobe_sincos_2pi(u.y);
	const lobe_real p = r * sc.c, y = r * sc.s;
	const lobe_real q = lobe_sqrt((one - p) * (one + p));
	/* (1 + y/q)/2, near y = -q as (1 - r^2)/(2 q (q - y)). */
	const lobe_real behind = LOBE_R(0.5) * (one - r2) / (q * (q - y));
	const lobe_real before = lobe_fma(LOBE_R(0.5), y / q, LOBE_R(0.5));
	return lobe_ggx_visible_cut(v, y < LOBE_R(0.0) ? behind : before, p, q);
}

/* w of w - sin w = 2 pi u, u in [0, 1/2], as a polynomial in the square of its leading term. Relative error 4e-8. */
LOBE_FN lobe_real lobe_ggx_kepler(lobe_real u)
{
	const lobe_real s = lobe_pow(LOBE_R(12.0) * LOBE_PI * u, LOBE_R(1.0) / LOBE_R(3.0));
	const lobe_real t = s * s;
	lobe_real p = LOBE_R(0x1.cee6eep-33);
	p = lobe_fma(p, t, LOBE_R(-0x1.4cc108p-28));
	p = lobe_fma(p, t, LOBE_R(0x1.c211e6p-25));
	p = lobe_fma(p, t, LOBE_R(-0x1.33f718p-22));
	p = lobe_fma(p, t, LOBE_R(0x1.3f9098p-20));
	p = lobe_fma(p, t, LOBE_R(0x1.c91ed6p-22));
	p = lobe_fma(p, t, LOBE_R(0x1.609dfcp-15));
	p = lobe_fma(p, t, LOBE_R(0x1.75ca26p-11));
	p = lobe_fma(p, t, LOBE_R(0x1.11124ap-6));
	return s * lobe_fma(p, t, LOBE_R(1.0));
}

/* Heitz and d'Eon 2014, "Importance sampling microfacet-based BSDFs using the distribution of visible normals": the
 * slope along v, then the slope across given that one. Both distributions are inverted as they are. The first, with psi
 * the slope's angle and theta that of v, is (cos theta + sin(psi + theta))/2, the line y above. The second is 1/(1 +
 * k^2)^2 in k = slope/sqrt(1 + (first)^2) = cot(w/2), whose integral is Kepler's equation at eccentricity 1; the
 * paper's supplement has a rational fit of it, which samples a density slightly other than the one it divides by. */
LOBE_FN lobe_vec3 lobe_ggx_visible_slopes(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real along = lobe_fma(u.x, LOBE_BELOW_ONE, LOBE_R(0x1p-25));
	const lobe_real across = lobe_fma(u.y, LOBE_BELOW_ONE, LOBE_R(0x1p-25));
	const int left = across < LOBE_R(0.5);
	const lobe_real w = lobe_ggx_kepler(left ? across : one - across);
	const lobe_sincos sc = lobe_sincos_2pi(w * (LOBE_R(0.5) / LOBE_2PI));
	return lobe_ggx_visible_cut(v, along, left ? -sc.c : sc.c, sc.s);
}

#endif
