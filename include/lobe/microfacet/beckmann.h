/* beckmann.h - Beckmann: normally distributed slopes of variance 1/2 each, stretched to any width.
 *
 * Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014. The functions are those that facet.h
 * explains. With r^2 = x^2 + y^2 and c = |z|/r, the cotangent of v's angle,
 *	sigma(v) = (z erfc(-z/r) + r exp(-c^2)/sqrt(pi))/2,   hidden(v) = r ierfc(c)/2
 * where ierfc is the integral of the complement of erf from c to infinity (core/erf.h has both, scaled by exp(c^2)).
 *
 * Visible normals. Turned so that v lies in the xz-plane, a visible normal (X, Y, 1) has independent X and Y, of
 * densities (r X + z) exp(-X^2)/(sqrt(pi) sigma) from X = -z/r on, and exp(-Y^2)/sqrt(pi) (Heitz and d'Eon 2014). Y is
 * an inverted erf. The distribution of X is inverted to rounding by a fitted start and one step of a method of fifth
 * order, for every v and u; X rises as u falls, without a jump.
 *
 * Errors, measured by tests/test_beckmann.c, with u = 2^-24 and t^2 = tan^2 of h:
 *	density  relative, 3.6 (1 + t^2) u
 *	hidden   relative, 9 u + 6.2 c^2 u while it is a normal number
 *	t        relative, 6.5 u
 *	visible  of the cumulative distribution of X, absolute, 5.0e-7 above and 5.1e-7 below the horizon
 *	         (a step of u: 6e-8), and above relative to itself where it is less than 1/2, 2.9e-6 */
#ifndef LOBE_MICROFACET_BECKMANN_H
#define LOBE_MICROFACET_BECKMANN_H

#include "../core/constants.h"
#include "../core/real.h"
#include "../core/warp.h"
#include "facet.h"

#define LOBE_SQRT_PI     LOBE_R(1.77245385090551602730)
#define LOBE_INV_SQRT_PI LOBE_R(0.564189583547756286948)

/* pi D = exp(-tan^2)/cos^4. Infinite or NaN for h.z = 0. */
LOBE_FN lobe_facet_density lobe_beckmann_density(lobe_vec3 h)
{
	const lobe_vec3 h2 = lobe_vec3_squares(h);
	lobe_facet_density d;
	d.inv = LOBE_R(1.0) / h2.z;
	d.factor = lobe_exp(-(h2.x + h2.y) * d.inv);
	return d;
}

/* The same with inv over s, from the squares of h; 0 where the exponential is below 1.6e-38. */
LOBE_FN lobe_facet_density lobe_beckmann_density_over(lobe_vec3 h2, lobe_real s)
{
	lobe_facet_density d;
	const lobe_real inv = LOBE_R(1.0) / h2.z;
	d.inv = inv * (LOBE_R(1.0) / s); /* apart, as the exponential is long enough without waiting for s */
	d.factor = lobe_exp_or_zero(-(h2.x + h2.y) * inv);
	return d;
}

LOBE_FN lobe_real lobe_beckmann_tail(lobe_real t2) { return lobe_exp(-t2); }

/* q in (0, 1]. */
LOBE_FN lobe_real lobe_beckmann_tail_inverse(lobe_real q) { return -lobe_log(q); }

/* r, 1/r and c of a direction. c stops at 2^26, from where on nothing depends on it: so it is finite along the normal
 * too, where r = 0. */
typedef struct {
	lobe_real r, inv_r, c;
} lobe_beckmann_angle;

LOBE_FN lobe_beckmann_angle lobe_beckmann_angle_of(lobe_vec3 v)
{
	lobe_beckmann_angle a;
	a.r = lobe_sqrt(lobe_vec3_xy2(v));
	a.inv_r = LOBE_R(1.0) / a.r;
	a.c = lobe_min(lobe_abs(v.z) * a.inv_r, LOBE_R(0x1p+26));
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
 * from c = 1.6 on, where the fit would rise again. G1 is off by at most .0031 (at c = 1.34).
 *
 * The numerator, 1 - 1.259 c + .396 c^2, is written as .396 (c - 1.548133)(c - 1.631160), each root the sum of two
 * floats: it ends at the first of them, and as a sum it would lose all its digits there. */
LOBE_FN lobe_real lobe_beckmann_hidden_rational(lobe_vec3 v)
{
	const lobe_real r = lobe_sqrt(lobe_vec3_xy2(v));
	const lobe_real z = lobe_abs(v.z);
	/* |z| Lambda with c = z/r: one division. */
	const lobe_real first = lobe_fma(LOBE_R(-0x1.8c5274p+0), r, z) - LOBE_R(-0x1.3a1c96p-27) * r;
	const lobe_real second = lobe_fma(LOBE_R(-0x1.a193bp+0), r, z) - LOBE_R(0x1.6becacp-26) * r;
	const lobe_real num = LOBE_R(0.396) * first * second;
	const lobe_real den = lobe_fma(LOBE_R(2.181), z, LOBE_R(3.535) * r);
	return z < LOBE_R(1.6) * r ? num / den : LOBE_R(0.0);
}

/* The distribution of X from above: its complement, the share of what v sees that has a larger X, is
 *	S(X) = (exp(-X^2)/sqrt(pi) + c erfc(X))/n,   n = 2 c + ierfc(c)
 * and S(X) = share is to be solved; rest = 1 - share, q = 1/n. */
typedef struct {
	lobe_real c, ierfc, n, q, share, rest;
} lobe_beckmann_slope;

/* One step of Householder's method of fourth order, whose error goes with the fifth power of the last. The density p =
 * 2 f exp(-X^2)/(sqrt(pi) n), f = X + c, has derivatives that are p times rational functions; with e = (S - share)/p
 * the step is
 *	e (1 + b + c/6)/(1 + 3/2 b + b^2/4 + c/3 + d/24),   b = e p'/p,   c = e^2 p''/p,   d = e^3 p'''/p
 * For X < 0 S - share is rest - (1 - S), so that both tails keep their precision. */
LOBE_FN lobe_real lobe_beckmann_slope_step(lobe_beckmann_slope s, lobe_real x)
{
	const lobe_real one = LOBE_R(1.0), two = LOBE_R(2.0);
	const int positive = x >= LOBE_R(0.0);
	const lobe_real x2 = x * x;
	const lobe_real gauss = lobe_exp_normal(-x2);
	const lobe_quotient tail = lobe_erfcx_quotient(lobe_abs(x));
	const lobe_real side = positive ? s.c : -s.c;
	const lobe_real target = positive ? s.n * s.share : lobe_fma(-s.n, s.rest, s.ierfc);
	const lobe_real scaled = lobe_fma(side, tail.num, LOBE_INV_SQRT_PI * tail.den);
	const lobe_real num = lobe_fma(gauss, scaled, -target * tail.den);
	const lobe_real f = x + s.c;
	const lobe_real relative = num / (two * LOBE_INV_SQRT_PI * f * f * gauss * tail.den); /* e/f */
	const lobe_real e = relative * f;
	const lobe_real xf = x * f;
	const lobe_real h = lobe_fma(LOBE_R(4.0), x2, -two);
	const lobe_real re = relative * e;
	const lobe_real b = lobe_fma(-two * xf, relative, relative);
	const lobe_real c = re * lobe_fma(h, f, LOBE_R(-4.0) * x);
	const lobe_real d = re * e * lobe_fma(xf, lobe_fma(-two, h, LOBE_R(8.0)), LOBE_R(3.0) * h);
	const lobe_real above = lobe_fma(LOBE_R(0.166666667), c, one + b);
	const lobe_real linear = lobe_fma(LOBE_R(0.333333333), c, lobe_fma(LOBE_R(0.0416666667), d, one));
	const lobe_real below = lobe_fma(b, lobe_fma(LOBE_R(0.25), b, LOBE_R(1.5)), linear);
	const lobe_real step = e * above / below;
	/* The start is that near. What would go further is rounding, where share and S are 1 to it. */
	return lobe_abs(step) < LOBE_R(0.75) * f ? x + step : x;
}

/* A start within .08 of X for share and rest above 1e-3, and beyond within a quarter of f = X + c and a fifth of
 * erfc(X): enough for the step to leave 4e-8 of the distribution. Where c > 3 and rest < 2e-5 it is up to .6 off, and
 * 8e-8 are left.
 *
 * With y = erf(X) and y0 = erf(-c), w = (y - y0)/(1 - y0) goes from 0 to 1; 1 - S begins as w^2/m and is w in the limit
 * of normal incidence. 1 - S = w^2/(m + (1 - m) w), a quadratic equation, is right there and at w = 1. 1 + y0 and m are
 * ierfc(c) times polynomials up to c = 7/2, from where on X hardly reaches that far down. Back to X by an inverse of
 * erf as x p(sqrt(-log(1 - x^2))), to 3.5e-5. This is too low by up to .22, as a rational function of f and q tells
 * that vanishes with f^2 and q. X + c is at least erf's increase over its largest slope. Fitted like the polynomials of
 * core/erf.h; the rational function by iterated linear least squares. */
LOBE_FN lobe_real lobe_beckmann_slope_start(lobe_beckmann_slope s)
{
	const lobe_real one = LOBE_R(1.0), two = LOBE_R(2.0);
	const lobe_real c = lobe_min(s.c, LOBE_R(3.5));
	const lobe_real ierfc = lobe_max(s.ierfc, LOBE_R(1e-7));
	lobe_real tail = LOBE_R(-0x1.16aa46p-5);
	tail = lobe_fma(tail, c, LOBE_R(0x1.fde196p-3));
	tail = lobe_fma(tail, c, LOBE_R(0x1.248744p+0));
	tail = ierfc * lobe_fma(tail, c, LOBE_R(0x1.c5bc46p+0));
	lobe_real m = LOBE_R(0x1.0089ap+2);
	m = lobe_fma(m, c, LOBE_R(0x1.3a4f0cp-2));
	m = lobe_fma(m, c, LOBE_R(0x1.b89484p+1));
	m = ierfc * lobe_fma(m, c, LOBE_R(0x1.1e9a96p+1));
	const lobe_real range = two - tail;
	const lobe_real k = (one - m) * s.rest;
	const lobe_real root = lobe_sqrt(lobe_fma(k, k, LOBE_R(4.0) * m * s.rest));
	const lobe_real above = LOBE_R(0.5) * range * (k + root);             /* y - y0 */
	const lobe_real below_1 = two * range * s.share / ((two - k) + root); /* 1 - y */
	const lobe_real above_minus_1 = tail + above;                         /* 1 + y */
	const lobe_real v = lobe_sqrt(lobe_abs(lobe_log_rough(below_1 * above_minus_1)));
	lobe_real p = LOBE_R(-0x1.77ac9cp-15);
	p = lobe_fma(p, v, LOBE_R(0x1.00199ap-10));
	p = lobe_fma(p, v, LOBE_R(-0x1.2172eep-7));
	p = lobe_fma(p, v, LOBE_R(0x1.5a02ccp-5));
	p = lobe_fma(p, v, LOBE_R(-0x1.cb5972p-4));
	p = lobe_fma(p, v, LOBE_R(0x1.42caa4p-3));
	p = lobe_fma(p, v, LOBE_R(-0x1.b386bep-4));
	p = lobe_fma(p, v, LOBE_R(0x1.00ece6p-5));
	p = lobe_fma(p, v, LOBE_R(0x1.f1364ap-3));
	p = lobe_fma(p, v, LOBE_R(-0x1.e853bp-8));
	p = lobe_fma(p, v, LOBE_R(0x1.c63d1cp-1));
	const lobe_real x = LOBE_R(0.5) * (above_minus_1 - below_1) * p;
	const lobe_real low = lobe_fma(LOBE_R(0.5) * LOBE_SQRT_PI, above, -s.c);
	const lobe_real start = x > low ? x : low;

	const lobe_real f = start + s.c, q = s.q;
	lobe_real num = lobe_fma(q, LOBE_R(-0x1.65c39ap-5), LOBE_R(0x1.67c1bep-3));
	num = lobe_fma(num, q, LOBE_R(0x1.e16cd4p-2));
	num = lobe_fma(q * f, LOBE_R(-0x1.c660acp-5), num);
	lobe_real free = lobe_fma(q, LOBE_R(-0x1.0a6b4cp+3), LOBE_R(0x1.45790ap+4));
	free = lobe_fma(free, q, LOBE_R(-0x1.3a12e6p+3));
	free = lobe_fma(free, q, LOBE_R(0x1.9b5aaep+0));
	lobe_real linear = lobe_fma(q, LOBE_R(-0x1.d2f7ep+0), LOBE_R(0x1.33e85cp+3));
	linear = lobe_fma(linear, q, LOBE_R(-0x1.518dbcp+1));
	const lobe_real den = lobe_fma(f, f + linear, free);
	return lobe_fma(q * f * f, num / den, start);
}

/* X where the complement of its distribution is u, for v.z >= 0. */
LOBE_FN lobe_real lobe_beckmann_slope_above(lobe_vec3 v, lobe_real u)
{
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	lobe_beckmann_slope s;
	s.c = a.c;
	s.ierfc = lobe_beckmann_ierfc(a.c);
	s.n = a.c + a.c + s.ierfc;
	s.q = LOBE_R(1.0) / s.n;
	/* The middle of the cell that u is the lower end of (core/warp.h). */
	s.share = u + LOBE_R(0x1p-25);
	s.rest = (LOBE_R(1.0) - u) - LOBE_R(0x1p-25);
	const lobe_real x = lobe_beckmann_slope_step(s, lobe_beckmann_slope_start(s));
#if LOBE_DOUBLE
	return lobe_beckmann_slope_step(s, x);
#else
	return x;
#endif
}

/* X - c, c = |v.z|/r, where the complement of the distribution of X is u, for v.z < 0: there X begins at c. With
 * f = X - c and l = f (f + 2 c), all scaled by exp(c^2) so that nothing underflows,
 *	S = exp(-l) (ierfcx(X) + f erfcx(X))/ierfcx(c),
 * S = exp(-l) at the horizon. The start adds to l = -log u what makes it right for u near 1, and nearly so
 * elsewhere. */
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
	const lobe_real erf_y = lobe_fma(LOBE_R(2.0), u, -LOBE_BELOW_ONE);
	const lobe_real y = lobe_erfinv_from(erf_y, lobe_fma(-erf_y, erf_y, LOBE_R(1.0)));
	return lobe_vec3_make(lobe_fma(cos_phi, x, -sin_phi * y), lobe_fma(sin_phi, x, cos_phi * y), LOBE_R(1.0));
}

/* u in [0,1)^2. v.z > 0. */
LOBE_FN lobe_vec3 lobe_beckmann_visible_above(lobe_vec3 v, lobe_vec2 u)
{
	return lobe_beckmann_normal(v, lobe_beckmann_slope_above(v, u.x), u.y);
}

/* The same for v on either side. Nothing is visible from straight below, where the normal is merely steep. */
LOBE_FN lobe_vec3 lobe_beckmann_visible(lobe_vec3 v, lobe_vec2 u)
{
	const lobe_beckmann_angle a = lobe_beckmann_angle_of(v);
	const lobe_vec3 up = lobe_vec3_make(v.x, v.y, lobe_abs(v.z));
	const lobe_real c = lobe_min(lobe_abs(v.z) * a.inv_r, LOBE_R(1e6));
	const lobe_real above = lobe_beckmann_slope_above(up, u.x);
	const lobe_real below = c + lobe_beckmann_slope_below(c, u.x);
	return lobe_beckmann_normal(v, v.z < LOBE_R(0.0) ? below : above, u.y);
}

#endif
