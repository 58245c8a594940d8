/* beckmann.h - Beckmann: normally distributed slopes of variance 1/2 each, stretched to any width.
 *
 * Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014. The functions are those that facet.h
 * explains. With r^2 = x^2 + y^2 and c = |z|/r, the cotangent of v's angle,
 *	sigma(v) = (z erfc(-z/r) + r exp(-c^2)/sqrt(pi))/2,   hidden(v) = r ierfc(c)/2
 * where ierfc is the integral of the complement of erf from c to infinity (core/erf.h has both, scaled by exp(c^2)).
 *
 * Visible normals. Turned so that v lies in the xz-plane, a visible normal (X, Y, 1) has independent X and Y, of
 * densities (r X + z) exp(-X^2)/(sqrt(pi) sigma) from X = -z/r on, and exp(-Y^2)/sqrt(pi) (Heitz and d'Eon 2014). Y is
 * an inverted erf. The distribution of X is inverted to rounding by a start in closed form and two steps of a method
 * of fourth order, for every v and u; X rises as u falls, without a jump.
 *
 * Errors, measured by tests/test_beckmann.c, with u = 2^-24 and t^2 = tan^2 of h:
 *	density  relative, 3.6 (1 + t^2) u
 *	hidden   relative, 9 u + 6.2 c^2 u while it is a normal number
 *	t        relative, 6.5 u
 *	visible  of the cumulative distribution of X, absolute, 6.2e-7 above and 5.7e-7 below the horizon
 *	         (a step of u: 6e-8) */
#ifndef LOBE_MICROFACET_BECKMANN_H
#define LOBE_MICROFACET_BECKMANN_H

#include "../core/constants.h"
#include "../core/real.h"
#include "../core/warp.h"
#include "facet.h"

#define LOBE_SQRT_PI     LOBE_R(1.77245385090551602730)
#define LOBE_INV_SQRT_PI LOBE_R(0.564189583547756286948)

/* pi D = exp(-tan^2)/cos^4, inv over s. Infinite or NaN for h.z = 0. */
LOBE_FN lobe_facet_density lobe_beckmann_density_over(lobe_vec3 h, lobe_real s)
{
	lobe_facet_density d;
	const lobe_real inv = LOBE_R(1.0) / (h.z * h.z);
	d.inv = inv / s; /* apart, as the exponential is long enough without waiting for s */
	d.factor = lobe_exp(-lobe_fma(h.x, h.x, h.y * h.y) * inv);
	return d;
}

LOBE_FN lobe_facet_density lobe_beckmann_density(lobe_vec3 h) { return lobe_beckmann_density_over(h, LOBE_R(1.0)); }

LOBE_FN lobe_real lobe_beckmann_tail(lobe_real t2) { return lobe_exp(-t2); }

/* q in (0, 1]. */
LOBE_FN lobe_real lobe_beckmann_tail_inverse(lobe_real q) { return -lobe_log(q); }

/* r, 1/r and c of a direction. c stops at 27, from where on exp(-c^2) is 0, also in double: so it is finite along the
 * normal too, where r = 0. */
typedef struct {
	lobe_real r, inv_r, c;
} lobe_beckmann_angle;

LOBE_FN lobe_beckmann_angle lobe_beckmann_angle_of(lobe_vec3 v)
{
	lobe_beckmann_angle a;
	a.r = lobe_sqrt(lobe_fma(v.x, v.x, v.y * v.y));
	a.inv_r = LOBE_R(1.0) / a.r;
	a.c = lobe_min(lobe_abs(v.z) * a.inv_r, LOBE_R(27.0));
	return a;
}

LOBE_FN lobe_real lobe_beckmann_hidden(lobe_vec3 v)
{
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	return LOBE_R(0.5) * a.r * (lobe_exp(-a.c * a.c) * lobe_ierfcx(a.c));
}

/* ierfc(c), c >= 0, to what c + ierfc(c) needs: masking adds it to that. One polynomial up to 7/2, where it is 3e-8 and
 * stays; fitted like those of core/erf.h. */
LOBE_FN lobe_real lobe_beckmann_ierfc(lobe_real c)
{
#if LOBE_DOUBLE
	return lobe_exp(-c * c) * lobe_ierfcx(c);
#else
	const lobe_real s = lobe_fma(lobe_min(c, LOBE_R(3.5)), LOBE_R(0x1.24924ap-1), LOBE_R(-1.0));
	lobe_real p = LOBE_R(0x1.68e4fp-11);
	p = lobe_fma(p, s, LOBE_R(0x1.8f488ep-9));
	p = lobe_fma(p, s, LOBE_R(-0x1.a309fcp-8));
	p = lobe_fma(p, s, LOBE_R(-0x1.a3e2dcp-7));
	p = lobe_fma(p, s, LOBE_R(0x1.e6c62ap-6));
	p = lobe_fma(p, s, LOBE_R(0x1.0d832cp-7));
	p = lobe_fma(p, s, LOBE_R(-0x1.1d7138p-4));
	p = lobe_fma(p, s, LOBE_R(0x1.0e1218p-4));
	p = lobe_fma(p, s, LOBE_R(0x1.0b6514p-5));
	p = lobe_fma(p, s, LOBE_R(-0x1.43fba4p-3));
	p = lobe_fma(p, s, LOBE_R(0x1.b0a654p-3));
	p = lobe_fma(p, s, LOBE_R(-0x1.51da56p-3));
	p = lobe_fma(p, s, LOBE_R(0x1.4b09a4p-4));
	p = lobe_fma(p, s, LOBE_R(-0x1.7e288p-6));
	return lobe_fma(p, s, LOBE_R(0x1.91741ep-9));
#endif
}

LOBE_FN lobe_real lobe_beckmann_t(lobe_vec3 v)
{
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	return lobe_fma(a.r, lobe_beckmann_ierfc(a.c), lobe_abs(v.z));
}

/* Walter's rational Lambda (2007, section 5.2), in place of hidden: an alternative that needs no exponential. It is 0
 * from c = 1.6 on, where the fit would rise again. G1 is off by at most .0031 (at c = 1.34). */
LOBE_FN lobe_real lobe_beckmann_hidden_rational(lobe_vec3 v)
{
	const lobe_real r = lobe_sqrt(lobe_fma(v.x, v.x, v.y * v.y));
	const lobe_real z = lobe_abs(v.z);
	/* |z| Lambda with c = z/r: one division. */
	const lobe_real num = lobe_fma(r, r, z * lobe_fma(LOBE_R(0.396), z, LOBE_R(-1.259) * r));
	const lobe_real den = lobe_fma(LOBE_R(2.181), z, LOBE_R(3.535) * r);
	return z < LOBE_R(1.6) * r ? num / den : LOBE_R(0.0);
}

/* The distribution of X from above, times what makes it finite for every v: its complement, the share of what v sees
 * that has a larger X, is
 *	S(X) = area_r exp(-X^2)/sqrt(pi) + area_z erfc(X),   area_r = r/(2 sigma), area_z = z/(2 sigma)
 * and S(X) = share is to be solved; rest = 1 - share, and hidden: 2 hidden/(2 sigma). */
typedef struct {
	lobe_real area_r, area_z, hidden, share, rest;
} lobe_beckmann_slope;

/* One step of Householder's method of third order, whose error goes with the fourth power of the last. The density
 * p = 2 facing exp(-X^2)/sqrt(pi), facing = area_r X + area_z, gives all derivatives; with f = S - share the step is
 *	(f/p) (1 + b/2)/(1 + b + c/6),   b = f p'/p^2,   c = f^2 p''/p^3
 * here as one quotient, that of erfcx included. For X < 0 f is 1 - S against rest, so that both tails keep their
 * precision. */
LOBE_FN lobe_real lobe_beckmann_slope_step(lobe_beckmann_slope s, lobe_real x)
{
	const int positive = x >= LOBE_R(0.0);
	const lobe_real gauss = lobe_exp(-x * x);
	const lobe_quotient tail = lobe_erfcx_quotient(lobe_abs(x));
	const lobe_real side = positive ? s.area_z : -s.area_z;
	const lobe_real target = positive ? s.share : s.hidden - s.rest;
	const lobe_real scaled = lobe_fma(side, tail.num, s.area_r * LOBE_INV_SQRT_PI * tail.den);
	const lobe_real f = lobe_fma(gauss, scaled, -target * tail.den);
	const lobe_real facing = lobe_fma(s.area_r, x, s.area_z);
	const lobe_real two_x = x + x;
	/* p, p'/p and p''/(6p), each times facing */
	const lobe_real p = LOBE_R(2.0) * LOBE_INV_SQRT_PI * facing * facing * gauss * tail.den;
	const lobe_real first = lobe_fma(-two_x, facing, s.area_r);
	const lobe_real second = lobe_fma(-two_x, first + s.area_r, LOBE_R(-2.0) * facing);
	const lobe_real b = f * first;
	const lobe_real c = f * facing * LOBE_R(0x1.555556p-3) * f * second;
	const lobe_real step = f * facing * lobe_fma(LOBE_R(0.5), b, p) / lobe_fma(p, p + b, c);
	/* The start is within a quarter of X + z/r. What would go further is rounding, where share and S are 1 to it. */
	return lobe_abs(step) * s.area_r < LOBE_R(0.5) * facing ? x + step : x;
}

/* X where the complement of its distribution is u, for v.z >= 0.
 *
 * The start. With y = erf(X) and y0 = erf(-z/r), w = (y - y0)/(1 - y0) goes from 0 to 1; 1 - S begins as w^2/m and is w
 * in the limit of normal incidence. 1 - S = w^2/(m + (1 - m) w), a quadratic equation, is right there and at w = 1. */
LOBE_FN lobe_real lobe_beckmann_slope_above(lobe_vec3 v, lobe_real t, lobe_real u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	const lobe_real ierfc = lobe_beckmann_ierfc(a.c);
	const lobe_real inv = one / (v.z + t);
	lobe_beckmann_slope s;
	s.area_r = a.r * inv;
	s.area_z = v.z * inv;
	s.hidden = s.area_r * ierfc;
	/* The middle of the cell that u is the lower end of (core/warp.h). */
	s.share = u + LOBE_R(0x1p-25);
	s.rest = (one - u) - LOBE_R(0x1p-25);

	const lobe_real gauss = lobe_exp(-a.c * a.c);
	const lobe_quotient erfcx = lobe_erfcx_quotient(a.c);
	const lobe_real tail = gauss * erfcx.num / erfcx.den; /* 1 + y0 */
	const lobe_real range = LOBE_R(2.0) - tail;
	const lobe_real m = LOBE_R(4.0) * LOBE_INV_SQRT_PI * gauss * (a.c + a.c + ierfc) / (range * range);
	const lobe_real k = (one - m) * s.rest;
	const lobe_real root = lobe_sqrt(lobe_fma(k, k, LOBE_R(4.0) * m * s.rest));
	const lobe_real w = LOBE_R(0.5) * (k + root);
	const lobe_real one_minus_w = (s.share + s.share) / ((LOBE_R(2.0) - k) + root);
	const lobe_real below_1 = range * one_minus_w;            /* 1 - y */
	const lobe_real above_minus_1 = lobe_fma(range, w, tail); /* 1 + y */
	const lobe_real start = lobe_erfinv_from(LOBE_R(0.5) * (above_minus_1 - below_1), above_minus_1 * below_1);
	return lobe_beckmann_slope_step(s, lobe_beckmann_slope_step(s, start));
}

/* X - c, c = |v.z|/r, where the complement of the distribution of X is u, for v.z < 0: there X begins at c. With
 * f = X - c and l = f (f + 2 c), all scaled by exp(c^2) so that nothing underflows,
 *	S = exp(-l) (ierfcx(X) + f erfcx(X))/ierfcx(c),
 * S = exp(-l) at the horizon. The start adds to l = -log u what makes it right for u near 1, and nearly so elsewhere. */
LOBE_FN lobe_real lobe_beckmann_slope_below(lobe_real c, lobe_real u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real share = u + LOBE_R(0x1p-25), rest = (one - u) - LOBE_R(0x1p-25);
	const lobe_real whole = lobe_ierfcx(c);
	/* -log(share), with the series of log(1 - rest) where share is 1 to rounding */
	const lobe_real series = rest * lobe_fma(rest, lobe_fma(rest, LOBE_R(0.333333333), LOBE_R(0.5)), one);
	const lobe_real l0 = rest < LOBE_R(0x1p-8) ? series : -lobe_log(share);
	const lobe_real g = lobe_sqrt(l0);
	const lobe_real slope = LOBE_R(2.0) * c * lobe_sqrt(LOBE_SQRT_PI * whole);
	const lobe_real l = l0 + slope * g / lobe_fma(LOBE_R(0.36), g, one);
	lobe_real f = l / (c + lobe_sqrt(lobe_fma(c, c, l)));
	for (int i = 0; i < 2; i++) {
		const lobe_real x = c + f;
		const lobe_real gauss = lobe_exp(-f * (f + (c + c)));
		const lobe_real s = gauss * lobe_fma(f, lobe_erfcx(x), lobe_ierfcx(x));
		const lobe_real n = LOBE_R(0.5) * LOBE_SQRT_PI * lobe_fma(-share, whole, s) / (f * f * gauss);
		const lobe_real xf = x * f;
		const lobe_real bn = n * (one - (xf + xf));
		const lobe_real c2 = lobe_fma(LOBE_R(4.0) * xf, xf - one, LOBE_R(-2.0) * f * f);
		const lobe_real num = lobe_fma(LOBE_R(0.5), bn, one);
		const lobe_real den = lobe_fma(n * n, c2 * LOBE_R(0x1.555556p-3), one + bn);
		const lobe_real step = n * num / den;
		f = lobe_abs(step) < LOBE_R(0.5) ? lobe_fma(f, step, f) : f;
	}
	return f;
}

/* (x, Y, 1) turned back from v's plane to the frame of v. */
LOBE_FN lobe_vec3 lobe_beckmann_normal(lobe_vec3 v, lobe_real x, lobe_real u)
{
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	const lobe_real cos_phi = a.r > LOBE_R(0.0) ? v.x * a.inv_r : LOBE_R(1.0);
	const lobe_real sin_phi = a.r > LOBE_R(0.0) ? v.y * a.inv_r : LOBE_R(0.0);
	const lobe_real y = lobe_erfinv(lobe_fma(LOBE_R(2.0), u, -LOBE_BELOW_ONE));
	return lobe_vec3_make(lobe_fma(cos_phi, x, -sin_phi * y), lobe_fma(sin_phi, x, cos_phi * y), LOBE_R(1.0));
}

/* t: lobe_beckmann_t(v); u in [0,1)^2. v.z > 0. */
LOBE_FN lobe_vec3 lobe_beckmann_visible_above(lobe_vec3 v, lobe_real t, lobe_vec2 u)
{
	return lobe_beckmann_normal(v, lobe_beckmann_slope_above(v, t, u.x), u.y);
}

/* The same for v on either side. Nothing is visible from straight below, where the normal is merely steep. */
LOBE_FN lobe_vec3 lobe_beckmann_visible(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	const lobe_vec3 up = lobe_vec3_make(v.x, v.y, lobe_abs(v.z));
	const lobe_real c = lobe_min(lobe_abs(v.z) * a.inv_r, LOBE_R(1e6));
	const lobe_real above = lobe_beckmann_slope_above(up, lobe_beckmann_t(up), u.x);
	const lobe_real below = c + lobe_beckmann_slope_below(c, u.x);
	return lobe_beckmann_normal(v, v.z < LOBE_R(0.0) ? below : above, u.y);
}

#endif
