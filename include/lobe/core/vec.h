/* vec.h - directions, colours and the result of sampling. Small structs, passed by value. */
#ifndef LOBE_CORE_VEC_H
#define LOBE_CORE_VEC_H

#include "../backend/backend.h"

typedef struct {
	lobe_real x, y, z;
} lobe_vec3;

typedef struct {
	lobe_real r, g, b;
} lobe_rgb;

LOBE_FN lobe_vec3 lobe_vec3_make(lobe_real x, lobe_real y, lobe_real z)
{
	lobe_vec3 v;
	v.x = x;
	v.y = y;
	v.z = z;
	return v;
}

LOBE_FN lobe_vec3 lobe_vec3_add(lobe_vec3 a, lobe_vec3 b) { return lobe_vec3_make(a.x + b.x, a.y + b.y, a.z + b.z); }
LOBE_FN lobe_vec3 lobe_vec3_scale(lobe_vec3 a, lobe_real s) { return lobe_vec3_make(a.x * s, a.y * s, a.z * s); }

/* s*a + b, each component rounded once. */
LOBE_FN lobe_vec3 lobe_vec3_fma(lobe_real s, lobe_vec3 a, lobe_vec3 b)
{
	return lobe_vec3_make(lobe_fma(s, a.x, b.x), lobe_fma(s, a.y, b.y), lobe_fma(s, a.z, b.z));
}

/* a where first, else b. */
LOBE_FN lobe_vec3 lobe_vec3_select(int first, lobe_vec3 a, lobe_vec3 b)
{
	return lobe_vec3_make(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

LOBE_FN lobe_real lobe_dot(lobe_vec3 a, lobe_vec3 b) { return lobe_fma(a.x, b.x, lobe_fma(a.y, b.y, a.z * b.z)); }

LOBE_FN lobe_vec3 lobe_vec3_squares(lobe_vec3 v) { return lobe_vec3_make(v.x * v.x, v.y * v.y, v.z * v.z); }
LOBE_FN lobe_real lobe_vec3_sum(lobe_vec3 v) { return v.x + v.y + v.z; }

/* x^2 + y^2: of a direction the square of its sine to z. */
LOBE_FN lobe_real lobe_vec3_xy2(lobe_vec3 v) { return lobe_fma(v.x, v.x, v.y * v.y); }

/* Neither infinite nor NaN. Of a sum it says so of each term, unless they overflow together. */
LOBE_FN int lobe_is_number(lobe_real x) { return x - x == LOBE_R(0.0); }
LOBE_FN int lobe_vec3_is_number(lobe_vec3 v) { return lobe_is_number(lobe_vec3_sum(v)); }

/* a*b - c*d without the cancellation of two rounded products (Kahan; 1.5 ulp by Jeannerod et al. 2013). */
LOBE_FN lobe_real lobe_diff_of_products(lobe_real a, lobe_real b, lobe_real c, lobe_real d)
{
	const lobe_real cd = c * d;
	return lobe_fma(a, b, -cd) + lobe_fma(-c, d, cd);
}

LOBE_FN lobe_vec3 lobe_cross(lobe_vec3 a, lobe_vec3 b)
{
	return lobe_vec3_make(lobe_diff_of_products(a.y, b.z, a.z, b.y), lobe_diff_of_products(a.z, b.x, a.x, b.z),
			      lobe_diff_of_products(a.x, b.y, a.y, b.x));
}

/* v/|v|. Domain: 1e-18 < |v| < 1e18, so that the square of the length neither underflows nor overflows. */
LOBE_FN lobe_vec3 lobe_normalize(lobe_vec3 v) { return lobe_vec3_scale(v, LOBE_R(1.0) / lobe_sqrt(lobe_dot(v, v))); }

LOBE_FN lobe_rgb lobe_rgb_make(lobe_real r, lobe_real g, lobe_real b)
{
	lobe_rgb c;
	c.r = r;
	c.g = g;
	c.b = b;
	return c;
}

LOBE_FN lobe_rgb lobe_rgb_scale(lobe_rgb c, lobe_real s) { return lobe_rgb_make(c.r * s, c.g * s, c.b * s); }

LOBE_FN lobe_real lobe_rgb_mean(lobe_rgb c) { return (c.r + c.g + c.b) * LOBE_R(0.333333333333333333); }

/* c where ok, else 0. */
LOBE_FN lobe_rgb lobe_rgb_select(int ok, lobe_rgb c)
{
	const lobe_real zero = LOBE_R(0.0);
	return lobe_rgb_make(ok ? c.r : zero, ok ? c.g : zero, ok ? c.b : zero);
}

LOBE_FN lobe_real lobe_min(lobe_real a, lobe_real b) { return a < b ? a : b; }
LOBE_FN lobe_real lobe_max(lobe_real a, lobe_real b) { return a > b ? a : b; }

/* x where it is not above hi; a NaN stays a NaN, which lobe_min(x, hi) would turn into hi. */
LOBE_FN lobe_real lobe_at_most(lobe_real x, lobe_real hi) { return x > hi ? hi : x; }

/* x limited to [lo, hi]; a NaN stays a NaN, so that the host can refuse it by name. */
LOBE_FN lobe_real lobe_clamp(lobe_real x, lobe_real lo, lobe_real hi) { return x < lo ? lo : (x > hi ? hi : x); }

/* The last step of every result: what is not a finite number >= 0 (from NaN or infinite parameters) becomes 0. */
LOBE_FN lobe_real lobe_finite_or_zero(lobe_real x)
{
	const int ok = (x >= LOBE_R(0.0)) & (x <= LOBE_REAL_MAX);
	return ok ? x : LOBE_R(0.0);
}

LOBE_FN lobe_rgb lobe_rgb_finite_or_zero(lobe_rgb c)
{
	return lobe_rgb_make(lobe_finite_or_zero(c.r), lobe_finite_or_zero(c.g), lobe_finite_or_zero(c.b));
}

#endif
