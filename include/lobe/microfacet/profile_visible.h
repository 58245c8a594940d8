/* profile_visible.h - visible normals of any isotropic distribution of slopes, from the table of profile.h.
 *
 * The steepness r first, then the azimuth on its ring: one random number each, every step monotone in its own.
 *
 * Ring. What v sees of the ring r is max(v.z, 0) + s r k(|v.z|/(s r)) (profile.h). For r < v.z/s that is v.z, and the
 * tail alone is inverted. The steeper rings are searched from the steepest down: a binary tree over the pieces of the
 * tail curve, and at each node the area that is seen of the pieces in its steeper half. For that half the host has an
 * 8-point Gauss rule for the measure r dF in the variable 1/r, for which k is a smooth function however the rings are
 * distributed; only halves that are steeper than |v.z|/s as a whole are ever evaluated, so that k's singular point, (1
 * - x)^(3/2), is an end point at worst (Gauss: 1e-6 of that half's area). What remains for the last piece is the
 * difference from sigma(v), and inside it the area is a 4-point Gauss-Legendre sum, solved by Newton's method. Nothing
 * cancels below the horizon, where max(v.z, 0) is 0 and all terms are positive.
 *
 * Largest distance of u.x from the true cumulative distribution of the ring 3e-6, of u.y from that of the azimuth 1e-6
 * (tests/test_distributions_visible.c; a ring whose width is a hundredth of its steepness: 4e-5).
 *
 * Azimuth. Density proportional to max(0, v.z + s r cos psi), psi from the azimuth of v: a Kepler equation. */
#ifndef LOBE_MICROFACET_PROFILE_VISIBLE_H
#define LOBE_MICROFACET_PROFILE_VISIBLE_H

#include "../core/constants.h"
#include "../core/warp.h"
#include "profile.h"

/* k as a function of d = 1 - x in [0, 1]: d^(3/2) times a polynomial, relative error 2e-8 before rounding. */
LOBE_FN lobe_real lobe_profile_kernel(lobe_real d)
{
	lobe_real p = LOBE_R(7.4634554e-05);
	p = lobe_fma(p, d, LOBE_R(-5.608631495e-05));
	p = lobe_fma(p, d, LOBE_R(2.362693249e-04));
	p = lobe_fma(p, d, LOBE_R(5.278484159e-04));
	p = lobe_fma(p, d, LOBE_R(2.416836967e-03));
	p = lobe_fma(p, d, LOBE_R(1.500493536e-02));
	p = lobe_fma(p, d, LOBE_R(3.001054422e-01));
	return d * lobe_sqrt(d) * p;
}

/* What is seen, divided by s, of the rings of rule n: above times their share, and the sum over r k(z/r). */
LOBE_FN lobe_real lobe_profile_rule(lobe_table t, lobe_uint n, lobe_real z)
{
	const lobe_uint at = LOBE_PROFILE_RULES + n * LOBE_PROFILE_RULE_WORDS;
	lobe_real sum = LOBE_R(0.0);
	for (lobe_uint g = 0u; g < LOBE_PROFILE_GAUSS; g++) {
		const lobe_real x = z * lobe_table_fetch(t, at + 2u * g);
		const lobe_real d = lobe_max(LOBE_R(1.0) - x, LOBE_R(0.0));
		sum = lobe_fma(lobe_table_fetch(t, at + 2u * g + 1u), lobe_profile_kernel(d), sum);
	}
	return sum;
}

/* A point of a piece of the tail curve: its steepness, and what is seen of rings there per step of p, divided by s. */
typedef struct {
	lobe_real r, seen;
} lobe_profile_ring;

LOBE_FN lobe_profile_ring lobe_profile_ring_at(lobe_profile_piece c, lobe_real t0, lobe_real above, lobe_real z,
					       lobe_real p)
{
	const lobe_real x = c.x * lobe_exp(p * c.width);
	lobe_profile_ring o;
	o.r = lobe_sqrt(t0 * lobe_max(x - LOBE_R(1.0), LOBE_R(0.0)));
	const lobe_real d = o.r > z ? (o.r - z) / o.r : LOBE_R(0.0);
	const lobe_real share = c.value * lobe_exp(-lobe_profile_fall(c, p)) * lobe_profile_fall_rate(c, p);
	o.seen = share * lobe_fma(o.r, lobe_profile_kernel(d), above);
	return o;
}

/* What is seen of the part of a piece from p to its end. */
LOBE_FN lobe_real lobe_profile_seen(lobe_profile_piece c, lobe_real t0, lobe_real above, lobe_real z, lobe_real p)
{
	const lobe_real extent = LOBE_R(0.5) * (LOBE_R(1.0) - p);
	const lobe_real middle = LOBE_R(0.5) * (LOBE_R(1.0) + p);
	const lobe_real outer = LOBE_R(0.861136311594052575) * extent;
	const lobe_real inner = LOBE_R(0.339981043584856265) * extent;
	const lobe_real a = lobe_profile_ring_at(c, t0, above, z, middle - outer).seen +
			    lobe_profile_ring_at(c, t0, above, z, middle + outer).seen;
	const lobe_real b = lobe_profile_ring_at(c, t0, above, z, middle - inner).seen +
			    lobe_profile_ring_at(c, t0, above, z, middle + inner).seen;
	return extent * lobe_fma(LOBE_R(0.347854845137453857), a, LOBE_R(0.652145154862546143) * b);
}

/* The ring r > z above which `rest` is seen, divided by s as z and above are. */
LOBE_FN lobe_real lobe_profile_steep_ring(lobe_table t, lobe_real above, lobe_real z, lobe_real rest)
{
	const lobe_real t0 = lobe_table_fetch(t, LOBE_PROFILE_T0);
	const lobe_real x = lobe_profile_x(t, z * z);
	const lobe_uint first = lobe_profile_find(t, LOBE_PROFILE_TAIL, LOBE_R(1.0) + x);
	lobe_uint i = 0u, node = 1u;
	lobe_real tail = LOBE_R(0.0);
	for (lobe_uint step = LOBE_PROFILE_LEAVES / 2; step > 0u; step >>= 1) {
		const lobe_uint middle = i + step;
		const lobe_real q = lobe_profile_knot(t, LOBE_PROFILE_TAIL, middle, LOBE_KNOT_VALUE);
		const lobe_real seen = lobe_fma(above, q - tail, lobe_profile_rule(t, node, z));
		const int covered = first >= middle; /* nothing is seen of the flatter half */
		const int steeper = covered | (rest < seen);
		rest = steeper ? rest : rest - seen;
		tail = steeper ? tail : q;
		i = steeper ? middle : i;
		node = node + node + (steeper ? 1u : 0u);
	}

	const lobe_profile_piece c = lobe_profile_piece_at(t, LOBE_PROFILE_TAIL, i);
	const lobe_real one = LOBE_R(1.0);
	lobe_real lo = first == i ? lobe_clamp(lobe_profile_place(c, x), LOBE_R(0.0), one) : LOBE_R(0.0);
	lobe_real hi = one;
	const lobe_real all = lobe_profile_seen(c, t0, above, z, lo);
	const lobe_real left = lobe_max(one - rest / all, LOBE_R(0.0));
	/* Below the horizon, and in the piece where rings begin to be seen, the area grows as (p - lo)^(5/2). */
	const int grows = (first == i) & (above == LOBE_R(0.0)) & (left > LOBE_R(0.0));
	lobe_real p = lobe_fma(hi - lo, grows ? lobe_exp(LOBE_R(0.4) * lobe_log(left)) : left, lo);
	for (lobe_uint step = 0u; step < 5u; step++) {
		const lobe_real off = lobe_profile_seen(c, t0, above, z, p) - rest;
		lo = off > LOBE_R(0.0) ? p : lo;
		hi = off > LOBE_R(0.0) ? hi : p;
		const lobe_real next = p + off / lobe_profile_ring_at(c, t0, above, z, p).seen;
		p = ((next >= lo) & (next <= hi)) ? next : LOBE_R(0.5) * (lo + hi);
	}
	/* Beyond the last knot nothing is told apart; the ring must be seen. */
	return lobe_max(lobe_profile_ring_at(c, t0, above, z, p).r, z * LOBE_R(1.000001));
}

/* (psi - sin psi)/psi^3 as a polynomial in psi^2, 0 <= psi <= pi; relative error 3e-9 before rounding. */
LOBE_FN lobe_real lobe_sine_deficit(lobe_real square)
{
	lobe_real p = LOBE_R(-1.394234467e-10);
	p = lobe_fma(p, square, LOBE_R(2.482227289e-08));
	p = lobe_fma(p, square, LOBE_R(-2.754568016e-06));
	p = lobe_fma(p, square, LOBE_R(1.984100209e-04));
	p = lobe_fma(p, square, LOBE_R(-8.333331074e-03));
	return lobe_fma(p, square, LOBE_R(1.666666664e-01));
}

/* sum psi - reach (psi - sin psi) */
LOBE_FN lobe_real lobe_kepler(lobe_real sum, lobe_real reach, lobe_real psi)
{
	const lobe_real square = psi * psi;
	return psi * lobe_fma(-reach * square, lobe_sine_deficit(square), sum);
}

/* Sine and cosine of psi with density proportional to max(0, z + reach cos psi), reach >= 0, z + reach > 0; u in [0,1).
 *
 * The cumulative z psi + reach sin psi is written with z + reach, which may be small, and psi - sin psi. It is odd and,
 * on the half that is solved, concave; the start solves the cubic that it becomes where z + reach is small, which has
 * the square root of the end that Newton's method alone would creep along, and 5 steps of Halley's method leave
 * 3e-7. */
LOBE_FN lobe_sincos lobe_visible_azimuth(lobe_real z, lobe_real reach, lobe_real u)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real one_half = LOBE_R(0.5);
	const lobe_real scale = one / lobe_max(z, reach);
	const lobe_real sum = (z + reach) * scale;
	const lobe_real b = reach * scale;
	const lobe_real share = lobe_min(one_half * sum / lobe_max(b, LOBE_R(1e-30)), one);
	const lobe_real end = z >= reach ? LOBE_PI : LOBE_R(2.0) * lobe_asin(lobe_sqrt(share));
	/* The middle of u's cell: the two halves mirror each other. */
	const lobe_real centred = lobe_fma(LOBE_R(2.0), u, -LOBE_BELOW_ONE);
	const lobe_real y = lobe_abs(centred);
	const lobe_real target = y * lobe_kepler(sum, b, end);
	const lobe_real third = LOBE_R(0.333333333333333333) * lobe_asin(y);
	lobe_real lo = LOBE_R(0.0), hi = end;
	lobe_real psi = LOBE_R(2.0) * end * lobe_sin(third);
	for (lobe_uint step = 0u; step < 5u; step++) {
		const lobe_real off = lobe_kepler(sum, b, psi) - target;
		const lobe_sincos h = lobe_sincos_2pi(psi * (one_half / LOBE_2PI));
		lo = off < LOBE_R(0.0) ? psi : lo;
		hi = off < LOBE_R(0.0) ? hi : psi;
		const lobe_real rate = lobe_fma(LOBE_R(-2.0) * b * h.s, h.s, sum);
		const lobe_real bend = LOBE_R(-2.0) * b * h.s * h.c;
		const lobe_real newton = off / rate;
		const lobe_real next = psi - newton / lobe_fma(LOBE_R(-0.5) * newton, bend / rate, one);
		psi = ((next >= lo) & (next <= hi)) ? next : one_half * (lo + hi);
	}
	lobe_sincos r = lobe_sincos_2pi(psi / LOBE_2PI);
	r.s = centred < LOBE_R(0.0) ? -r.s : r.s;
	return r;
}

/* A normal visible from v, on either side of the horizon. Straight from below nothing is visible: (0, 0, 1). */
LOBE_FN lobe_vec3 lobe_profile_visible(lobe_table t, lobe_vec3 v, lobe_vec2 u)
{
	const lobe_real zero = LOBE_R(0.0);
	const lobe_real one = LOBE_R(1.0);
	const lobe_real s = lobe_sqrt(lobe_vec3_xy2(v));
	const lobe_real above = lobe_max(v.z, zero);
	const lobe_real hidden = lobe_profile_hidden(t, v);
	const lobe_real seen = (one - u.x) * (above + hidden);
	const lobe_real z = lobe_min(lobe_abs(v.z) / s, LOBE_R(1e+18));
	const lobe_real steep = hidden + above * lobe_profile_tail(t, z * z);
	if (!(seen > zero))
		return lobe_vec3_make(zero, zero, one);
	const int flat = (seen > steep) | !(s > zero);
	const lobe_real r = flat ? lobe_sqrt(lobe_profile_tail_inverse(t, lobe_min((seen - hidden) / above, one)))
				 : lobe_profile_steep_ring(t, above / s, z, seen / s);
	const lobe_sincos a = lobe_visible_azimuth(v.z, s * r, u.y);
	const lobe_real dx = s > zero ? v.x / s : one;
	const lobe_real dy = s > zero ? v.y / s : zero;
	const lobe_real height = one / (one + r);
	const lobe_real reach = r * height;
	return lobe_vec3_make(reach * lobe_fma(a.c, dx, -a.s * dy), reach * lobe_fma(a.c, dy, a.s * dx), height);
}

#endif
