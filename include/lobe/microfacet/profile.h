/* profile.h - any isotropic distribution of slopes, from a table that the host makes of its density (profile_table.h).
 *
 * A distribution is told by F, the fraction of the mean plane under facets less steep than r = tan theta; 1 - F is the
 * tail Q(r). From one ring of slopes of steepness r a direction v sees, averaged over the azimuth and with s = |v.xy|,
 *	max(v.z, 0) + s r k(|v.z|/(s r)),   k(x) = (sqrt(1 - x^2) - x acos x)/pi,   k = 0 for x >= 1,
 * so that hidden(v) = s h(|v.z|/s) with h(z) = int_z^inf r k(z/r) dF(r), of one variable: all that the masking of any
 * distribution of slopes is.
 *
 * The table holds Q as a function of X = 1 + r^2/t0 and h as one of X = 1 + z/r0, where r0 is the median of r, and t0
 * is r^2 of tail 15/16, so that a narrow peak on a broad base is resolved. Both fall from their largest value, often
 * over tens of decades: what is interpolated, by cubic polynomials with exact slopes at 257 knots that the host places,
 * is the logarithm of either in the logarithm of X. There powers and exponentials are (nearly) straight, and relative
 * accuracy holds however small a value is. Beyond the last knot both go on as powers.
 *
 * Errors: phong.h, gtr.h, student_t.h, tabulated.h; all measured by tests/test_distributions.c. */
#ifndef LOBE_MICROFACET_PROFILE_H
#define LOBE_MICROFACET_PROFILE_H

#include "../core/powers.h"
#include "../core/real.h"
#include "../core/table.h"
#include "../core/vec.h"
#include "facet.h"

/* Layout, in words. A curve is LOBE_PROFILE_LEAVES + 1 knots; rules: profile_visible.h. */
enum {
	LOBE_PROFILE_LEVELS = 8,
	LOBE_PROFILE_LEAVES = 1 << LOBE_PROFILE_LEVELS,
	LOBE_PROFILE_GAUSS = 8,

	LOBE_PROFILE_T0 = 1,
	LOBE_PROFILE_INV_T0 = 2, /* 1/t0 */
	LOBE_PROFILE_INV_R0 = 3, /* 1/r0 */
	LOBE_PROFILE_TAIL = 4,

	/* One knot and the piece from it to the next: place X and value V there; the piece's rise of log X; the falls
	 * of log V over it and, per piece, at its two ends. The last knot has the first two only. */
	LOBE_KNOT_X = 0,
	LOBE_KNOT_VALUE = 1,
	LOBE_KNOT_WIDTH = 2,
	LOBE_KNOT_FALL = 3,
	LOBE_KNOT_SLOPE0 = 4,
	LOBE_KNOT_SLOPE1 = 5,
	LOBE_KNOT_WORDS = 6,

	LOBE_PROFILE_CURVE_WORDS = (LOBE_PROFILE_LEAVES + 1) * LOBE_KNOT_WORDS,
	LOBE_PROFILE_HIDDEN = LOBE_PROFILE_TAIL + LOBE_PROFILE_CURVE_WORDS,
	LOBE_PROFILE_RULES = LOBE_PROFILE_HIDDEN + LOBE_PROFILE_CURVE_WORDS,
	LOBE_PROFILE_RULE_WORDS = 2 * LOBE_PROFILE_GAUSS,
	LOBE_PROFILE_WORDS = LOBE_PROFILE_RULES + LOBE_PROFILE_LEAVES * LOBE_PROFILE_RULE_WORDS
};

/* One piece of a curve. */
typedef struct {
	lobe_real x, value, width, fall, slope0, slope1;
} lobe_profile_piece;

/* curve: LOBE_PROFILE_TAIL or LOBE_PROFILE_HIDDEN. */
LOBE_FN lobe_real lobe_profile_knot(lobe_table t, lobe_uint curve, lobe_uint i, lobe_uint word)
{
	return lobe_table_fetch(t, curve + i * LOBE_KNOT_WORDS + word);
}

LOBE_FN lobe_profile_piece lobe_profile_piece_at(lobe_table t, lobe_uint curve, lobe_uint i)
{
	lobe_profile_piece p;
	p.x = lobe_profile_knot(t, curve, i, LOBE_KNOT_X);
	p.value = lobe_profile_knot(t, curve, i, LOBE_KNOT_VALUE);
	p.width = lobe_profile_knot(t, curve, i, LOBE_KNOT_WIDTH);
	p.fall = lobe_profile_knot(t, curve, i, LOBE_KNOT_FALL);
	p.slope0 = lobe_profile_knot(t, curve, i, LOBE_KNOT_SLOPE0);
	p.slope1 = lobe_profile_knot(t, curve, i, LOBE_KNOT_SLOPE1);
	return p;
}

/* The piece that holds x >= 1, or the last one where x is beyond all knots. */
LOBE_FN lobe_uint lobe_profile_find(lobe_table t, lobe_uint curve, lobe_real x)
{
	lobe_uint i = 0u;
	for (lobe_uint step = LOBE_PROFILE_LEAVES / 2; step > 0u; step >>= 1)
		i = lobe_profile_knot(t, curve, i + step, LOBE_KNOT_X) <= x ? i + step : i;
	return i;
}

/* How far log V has fallen at place p of a piece: 0 to 1, or more beyond the last knot. Monotone: the host keeps both
 * slopes below 3 fall (Fritsch and Carlson 1980). */
LOBE_FN lobe_real lobe_profile_fall(lobe_profile_piece c, lobe_real p)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real q = lobe_min(p, one);
	const lobe_real cubic = (c.slope0 + c.slope1) - (c.fall + c.fall);
	const lobe_real square = (c.fall - c.slope0) - cubic;
	const lobe_real inside = q * lobe_fma(q, lobe_fma(q, cubic, square), c.slope0);
	return p > one ? lobe_fma(c.slope1, p - one, c.fall) : inside;
}

/* Its derivative by p. */
LOBE_FN lobe_real lobe_profile_fall_rate(lobe_profile_piece c, lobe_real p)
{
	const lobe_real q = lobe_min(p, LOBE_R(1.0));
	const lobe_real cubic = (c.slope0 + c.slope1) - (c.fall + c.fall);
	const lobe_real square = (c.fall - c.slope0) - cubic;
	const lobe_real rate = lobe_fma(q, lobe_fma(q, LOBE_R(3.0) * cubic, square + square), c.slope0);
	return lobe_max(rate, LOBE_R(0.0));
}

/* The place of X = 1 + x in it: log(X/c.x)/width, whose logarithm keeps the digits that X loses to its 1. */
LOBE_FN lobe_real lobe_profile_place(lobe_profile_piece c, lobe_real x)
{
	return lobe_log1p((x - (c.x - LOBE_R(1.0))) / c.x) / c.width;
}

/* At X = 1 + x. */
LOBE_FN lobe_real lobe_profile_curve(lobe_table t, lobe_uint curve, lobe_real x)
{
	const lobe_profile_piece c = lobe_profile_piece_at(t, curve, lobe_profile_find(t, curve, LOBE_R(1.0) + x));
	return c.value * lobe_exp(-lobe_profile_fall(c, lobe_profile_place(c, x)));
}

/* X - 1: tan^2 in units of t0, which are numbers for h.z = 0 too. */
LOBE_FN lobe_real lobe_profile_x(lobe_table t, lobe_real t2)
{
	return lobe_min(t2, LOBE_R(1e+36) * lobe_table_fetch(t, LOBE_PROFILE_T0)) *
	       lobe_table_fetch(t, LOBE_PROFILE_INV_T0);
}

/* Q at tan^2 = t2. */
LOBE_FN lobe_real lobe_profile_tail(lobe_table t, lobe_real t2)
{
	return lobe_profile_curve(t, LOBE_PROFILE_TAIL, lobe_profile_x(t, t2));
}

/* tan^2 of tail q in (0, 1]: the piece by bisection, then 8 steps of Newton's method kept inside it. */
LOBE_FN lobe_real lobe_profile_tail_inverse(lobe_table t, lobe_real q)
{
	lobe_uint i = 0u;
	for (lobe_uint step = LOBE_PROFILE_LEAVES / 2; step > 0u; step >>= 1)
		i = lobe_profile_knot(t, LOBE_PROFILE_TAIL, i + step, LOBE_KNOT_VALUE) >= q ? i + step : i;
	const lobe_profile_piece c = lobe_profile_piece_at(t, LOBE_PROFILE_TAIL, i);
	const lobe_real one = LOBE_R(1.0);
	const lobe_real target = lobe_max(lobe_log(c.value / q), LOBE_R(0.0));
	lobe_real lo = LOBE_R(0.0), hi = one;
	lobe_real p = c.fall > target ? target / c.fall : one;
	for (lobe_uint step = 0u; step < 8u; step++) {
		const lobe_real off = lobe_profile_fall(c, p) - target;
		lo = off < LOBE_R(0.0) ? p : lo;
		hi = off < LOBE_R(0.0) ? hi : p;
		const lobe_real next = p - off / lobe_profile_fall_rate(c, p);
		p = ((next >= lo) & (next <= hi)) ? next : LOBE_R(0.5) * (lo + hi);
	}
	const lobe_real beyond = one + (target - c.fall) / c.slope1;
	p = target > c.fall ? (beyond <= LOBE_REAL_MAX ? beyond : one) : p;
	const lobe_real x = c.x * lobe_exp(lobe_min(p * c.width, LOBE_R(80.0)));
	return lobe_table_fetch(t, LOBE_PROFILE_T0) * lobe_max(x - one, LOBE_R(0.0));
}

/* hidden(v) of facet.h. 0 for v along the normal. */
LOBE_FN lobe_real lobe_profile_hidden(lobe_table t, lobe_vec3 v)
{
	const lobe_real s = lobe_sqrt(lobe_vec3_xy2(v));
	const lobe_real z = lobe_abs(v.z) * lobe_table_fetch(t, LOBE_PROFILE_INV_R0) / s;
	const lobe_real curve = lobe_profile_curve(t, LOBE_PROFILE_HIDDEN, lobe_min(z, LOBE_R(1e+36)));
	return s > LOBE_R(0.0) ? s * curve : LOBE_R(0.0);
}

/* density(h) of facet.h, as the exact derivative of the interpolated tail: -dQ/d tan^2 = pi P22. So the density, the
 * tail and all samples belong to one and the same surface. */
LOBE_FN lobe_facet_density lobe_profile_density(lobe_table t, lobe_vec3 h)
{
	const lobe_real r2 = lobe_vec3_xy2(h);
	const lobe_real z2 = h.z * h.z;
	const lobe_real x = lobe_profile_x(t, r2 / z2);
	const lobe_real whole = LOBE_R(1.0) + x;
	const lobe_profile_piece c =
		lobe_profile_piece_at(t, LOBE_PROFILE_TAIL, lobe_profile_find(t, LOBE_PROFILE_TAIL, whole));
	const lobe_real p = lobe_profile_place(c, x);
	const lobe_real rate = lobe_profile_fall_rate(c, p) / c.width;
	const lobe_real inv_t0 = lobe_table_fetch(t, LOBE_PROFILE_INV_T0);
	lobe_facet_density d;
	d.inv = LOBE_R(1.0) / lobe_fma(r2, inv_t0, z2);
	d.factor = c.value * lobe_exp(-lobe_profile_fall(c, p)) * rate * inv_t0 * whole;
	return d;
}

#endif
