/* gtr.h - generalised Trowbridge-Reitz: D = c/(alpha^2 cos^2 + sin^2)^gamma. gamma = 2 is GGX, 1 is Berry's (Disney's
 * clearcoat).
 *
 * Burley 2012, "Physically based shading at Disney", appendix B; Berry 1923; masking for whole gamma: Dimov 2015,
 * "Deriving the Smith shadowing function G1 for gamma in (0, 4]". The functions are those that facet.h explains. alpha
 * is part of the shape: unless gamma = 2, surfaces of two widths are not stretches of one another.
 *
 * With A = alpha^2, w = (A + t)/(1 + t) (t = tan^2) falls from 1 at t = infinity to A at t = 0, and everything is a
 * power of it. In l = -log w, a = -log A and b = gamma - 1:
 *	pi D = pi D(0) (A/w)^gamma,   pi D(0) = ((1 - A)/A) b/(1 - exp(-b a)),   tail = (exp(b l) - 1)/(exp(b a) - 1),
 * of which the limits b -> 0 and a -> 0, where the textbook form is 0/0, come out of (exp(x) - 1)/x and log(1 + x)/x.
 *
 * hidden is closed for gamma = 1, 2, 3, 4 and needs no table; any other gamma (3/2 leads to elliptic integrals) has it
 * from the table. Visible normals always come from the table.
 *
 * Largest relative error, single precision against quadrature, gamma = .5 to 10, alpha = 1e-4 to 1
 * (tests/test_distributions.c): density 2e-6, hidden 1e-6 (closed) or 3e-6, tail 2e-6 where the value is above 1e-4 of
 * its largest; 2e-5 each down to 1e-33 of it. */
#ifndef LOBE_MICROFACET_GTR_H
#define LOBE_MICROFACET_GTR_H

#include "../core/powers.h"
#include "profile_visible.h"
#include "shape.h"

/* Domain: gamma. */
#define LOBE_GTR_GAMMA_MIN LOBE_R(0.01)
#define LOBE_GTR_GAMMA_MAX LOBE_R(100.0)

/* d.exponent: gamma. d.width: alpha. d.norm: pi D(0). */
LOBE_FN lobe_real lobe_gtr_one_minus_a(lobe_distribution d)
{
	return (LOBE_R(1.0) - d.width) * (LOBE_R(1.0) + d.width);
}

/* (A/w)^gamma, with w/A - 1 = (1 - A) r^2/(A |h|^2) formed directly. */
LOBE_FN lobe_facet_density lobe_gtr_density(lobe_distribution d, lobe_vec3 h)
{
	const lobe_real a = d.width * d.width;
	const lobe_real r2 = lobe_vec3_xy2(h);
	const lobe_real z2 = h.z * h.z;
	const lobe_real len2 = r2 + z2;
	const lobe_real excess = lobe_gtr_one_minus_a(d) * r2 / (a * len2);
	lobe_facet_density f;
	f.inv = LOBE_R(1.0) / len2;
	f.factor = d.norm * lobe_decay(excess, d.exponent);
	return f;
}

LOBE_FN lobe_real lobe_gtr_tail(lobe_distribution d, lobe_real t2)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real b = d.exponent - one;
	const lobe_real all = lobe_gtr_one_minus_a(d);
	const lobe_real inv = one / (one + t2);
	const lobe_real a = -LOBE_R(2.0) * lobe_log(d.width);
	/* l and a - l = log(w/A), each from the side on which it does not cancel; l/a without 0/0. */
	const lobe_real rest = lobe_log1p(t2 * inv * all / (d.width * d.width));
	const int nearer = all * inv > LOBE_R(0.5);
	const lobe_real l = nearer ? a - rest : -lobe_log1p(-all * inv);
	const lobe_real far_share = inv * lobe_log1p_over(-all * inv) * all / a;
	const lobe_real share = nearer ? l / a : (all == LOBE_R(0.0) ? inv : far_share);
	return share * lobe_expm1_over(-b * l) / lobe_expm1_over(-b * a) * lobe_exp(-b * rest);
}

/* l and a - l each from the side on which it does not cancel; then t = A (exp(a - l) - 1)/(1 - exp(-l)). */
LOBE_FN lobe_real lobe_gtr_tail_inverse(lobe_distribution d, lobe_real q)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real b = d.exponent - one;
	const lobe_real a = -LOBE_R(2.0) * lobe_log(d.width);
	const lobe_real ba = b * a;
	const lobe_real log_q = lobe_log(q);
	const lobe_real p = one - q;
	const lobe_real big = log_q + ba;
	const lobe_real bl_small = lobe_log1p(q * lobe_expm1(ba));
	const lobe_real bl_big = big > LOBE_R(60.0) ? big : lobe_log1p(lobe_exp(big));
	const lobe_real l = (ba < LOBE_R(60.0) ? bl_small : bl_big) / b;
	const lobe_real lost = -lobe_expm1(-ba);
	const lobe_real rest_near = -lobe_log1p(-p * lost) / b;
	const lobe_real rest_far = -lobe_log(lobe_fma(p, lobe_exp(-ba), q)) / b;
	const lobe_real rest = p * lost < LOBE_R(0.5) ? rest_near : rest_far;
	const lobe_real up = lobe_expm1(b == LOBE_R(0.0) ? p * a : rest);
	const lobe_real down = -lobe_expm1(b == LOBE_R(0.0) ? -q * a : -l);
	return a == LOBE_R(0.0) ? p / q : d.width * d.width * up / down;
}

/* hidden for gamma = 1, 2, 3, 4. With s^2 = v.x^2 + v.y^2, z = |v.z|, P = sqrt(z^2 + A s^2), w = A s^2/(z + P)^2 all
 * are sums of positive terms, but for the first, where half the leading term remains:
 *	1: N s^2/(P + Q) (1 - z/(z + P) log(1 + x)/x),   N = (1 - A)/a, Q = sqrt(z^2 + s^2), x = (Q - P)/(z + P)
 *	2: A s^2/(2 (z + P))
 *	3: A^2 s^2 (2 + (1 + A) s^2/(z + P)^2)/(4 (1 + A) P)
 *	4: A s^2 (z + P)^2 (A^2 (3 + 6w + 5w^2 + w^3) + A w (3 + 2w + w^2) + w^2 (2 + w))/(16 (1 + A + A^2) P^3) */
LOBE_FN lobe_real lobe_gtr_hidden_closed(lobe_distribution d, lobe_vec3 v)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real two = LOBE_R(2.0);
	const lobe_real three = LOBE_R(3.0);
	const lobe_real a = d.width * d.width;
	const lobe_real s2 = lobe_vec3_xy2(v);
	const lobe_real z = lobe_abs(v.z);
	const lobe_real big_p = lobe_sqrt(lobe_fma(a, s2, z * z));
	const lobe_real sum = z + big_p;
	if (d.exponent == LOBE_R(1.0)) {
		const lobe_real big_q = lobe_sqrt(lobe_fma(z, z, s2));
		const lobe_real both = big_p + big_q;
		const lobe_real x = lobe_gtr_one_minus_a(d) * s2 / (both * sum);
		return d.norm * a * (s2 / both) * lobe_fma(-z / sum, lobe_log1p_over(x), one);
	}
	if (d.exponent == LOBE_R(2.0))
		return LOBE_R(0.5) * a * s2 / sum;
	const lobe_real ratio = s2 / (sum * sum);
	if (d.exponent == LOBE_R(3.0))
		return a * a * (s2 / big_p) * lobe_fma(one + a, ratio, two) / (LOBE_R(4.0) * (one + a));
	const lobe_real w = a * ratio;
	const lobe_real c2 = lobe_fma(w, lobe_fma(w, w + LOBE_R(5.0), LOBE_R(6.0)), three);
	const lobe_real c1 = w * lobe_fma(w, w + two, three);
	const lobe_real c0 = w * w * (w + two);
	const lobe_real c = lobe_fma(a, lobe_fma(a, c2, c1), c0);
	const lobe_real k = LOBE_R(16.0) * lobe_fma(a, one + a, one);
	const lobe_real steep = sum / big_p;
	return a * (s2 / big_p) * steep * steep * c / k;
}

LOBE_FN int lobe_gtr_is_closed(lobe_distribution d)
{
	return (d.exponent == LOBE_R(1.0)) | (d.exponent == LOBE_R(2.0)) | (d.exponent == LOBE_R(3.0)) |
	       (d.exponent == LOBE_R(4.0));
}

LOBE_FN lobe_real lobe_gtr_hidden(lobe_distribution d, lobe_vec3 v)
{
	return lobe_gtr_is_closed(d) ? lobe_gtr_hidden_closed(d, v) : lobe_profile_hidden(d.table, v);
}

LOBE_FN lobe_vec3 lobe_gtr_visible(lobe_distribution d, lobe_vec3 v, lobe_vec2 u)
{
	return lobe_profile_visible(d.table, v, u);
}

#endif
