/* recommend.h - which way to sample a microfacet lobe under a light: by which strategy of microfacet/strategy.h, and
 * whether from the lobe, from the light, or from both.
 *
 *	lobe_light_shape sun = lobe_light_shape_disk(axis, 6.7e-5f, 0.8f);
 *	lobe_recommendation r = lobe_recommend_strategy(surface, wo, sun, lobe_recommend_cost_samples());
 *	p = lobe_microfacet_conductor_make(surface, fresnel, r.strategy);	and r.from says what to draw from
 *
 * Of a reflecting lobe. The light is described by a disk and a glow around one direction (in the shading frame, unit),
 * their solid angles, and how much of all light comes from each; the rest is a sky over the surface. A light that is
 * not like that - lamps here and there, a probe - is asked itself, at directions of the lobe's and of its own drawing:
 *
 *	lobe_recommend_sums s = lobe_recommend_start(LOBE_RECOMMEND_POINTS);
 *	for (int pass = 0; pass < 2; pass++)
 *		for (lobe_uint i = 1; i <= LOBE_RECOMMEND_POINTS; i++) {
 *			lobe_vec3 b = lobe_recommend_direction(surface, wo, i), l = my_light_draw(lobe_recommend_u(i));
 *			s = lobe_recommend_add(s, pass, i, surface, wo, b, my_light(b), l, my_light(l));
 *		}
 *	lobe_recommendation r = lobe_recommend_answer(s, surface, lobe_recommend_cost_samples());
 *
 * The variance that each technique would have is then an integral, and that is what is compared: integrated with points
 * of a lattice from the lobe and as many from the light, all techniques on the same ones (power heuristic between the
 * two). A technique's efficiency is 1/(variance cost). Nearly equal ones go to the first of VISIBLE, BOUNDED_CAP and
 * the rest.
 *
 * It takes about a millisecond: a question to ask for a material, an angle and a light, not for a sample. How often
 * it is right, and how far off when it is not: `make report`, section strategies; tests/test_recommend.c. */
#ifndef LOBE_RECOMMEND_H
#define LOBE_RECOMMEND_H

#include "light_shape.h"
#include "microfacet/scatter.h"

enum { LOBE_RECOMMEND_POINTS = 512 };

/* What to draw directions from. With both, a direction of each, weighted by the balance or the power heuristic (Veach
 * 1997). Stable across versions. */
enum { LOBE_SAMPLE_LOBE = 0, LOBE_SAMPLE_LIGHT = 1, LOBE_SAMPLE_BOTH_BALANCE = 2, LOBE_SAMPLE_BOTH_POWER = 3 };

/* What a sample costs, in any unit: from the lobe by each strategy, from the light, and what weighting adds to the
 * two. */
typedef struct {
	lobe_real lobe[LOBE_STRATEGY_LAST + 1];
	lobe_real light, weighting;
} lobe_recommend_cost;

/* Every direction costs the same: what holds where a ray is traced along each. */
LOBE_FN lobe_recommend_cost lobe_recommend_cost_samples(void)
{
	lobe_recommend_cost c;
	for (int i = 0; i <= LOBE_STRATEGY_LAST; i++)
		c.lobe[i] = LOBE_R(1.0);
	c.light = LOBE_R(1.0);
	c.weighting = LOBE_R(0.0);
	return c;
}

/* from: LOBE_SAMPLE_*. strategy: LOBE_STRATEGY_*, also where the lobe is not drawn from (then VISIBLE). deviation:
 * expected standard deviation of one sample (of BOTH: a direction of each) over its mean; 0 also for a light that the
 * lobe does not see; -1: no answer, as the light or the surface is none. */
typedef struct {
	lobe_uint strategy, from;
	lobe_real deviation;
} lobe_recommendation;

/* --- integrals ---------------------------------------------------------------------------------------------------- */

/* What is looked at: the lobe's strategies, the light, and both with VISIBLE by either heuristic and with BOUNDED_CAP
 * by the balance heuristic. */
enum {
	LOBE_RECOMMEND_LIGHT = LOBE_STRATEGY_LAST + 1,
	LOBE_RECOMMEND_DENSITIES,
	LOBE_RECOMMEND_BALANCE = LOBE_RECOMMEND_DENSITIES,
	LOBE_RECOMMEND_POWER,
	LOBE_RECOMMEND_BALANCE_BOUNDED,
	LOBE_RECOMMEND_TECHNIQUES
};

/* value: f L |cos|, Fresnel's term left out. pdf: of each density. */
typedef struct {
	lobe_real value;
	lobe_real pdf[LOBE_RECOMMEND_DENSITIES];
} lobe_recommend_point;

/* What is seen of the light in a direction: its radiance (of three channels the luminance; in any unit), and the
 * density with which its own sampling draws that direction [1/sr]. */
typedef struct {
	lobe_real radiance, pdf;
} lobe_light_seen;

/* part: 1 over the number of points. mean, and of each technique what the first pass finds of it (mass of the
 * densities; of BOTH the lobe's part of the mean) and the second (variance). */
typedef struct {
	lobe_real part, mean;
	lobe_real first[LOBE_RECOMMEND_TECHNIQUES];
	lobe_real rejected[LOBE_RECOMMEND_DENSITIES];
	lobe_real variance[LOBE_RECOMMEND_TECHNIQUES];
} lobe_recommend_sums;

/* VISIBLE_SLOPES, VISIBLE_ELLIPSOID and VISIBLE_CAP have VISIBLE's density (of GGX), or are no better (of others). */
LOBE_FN int lobe_recommend_looks_at(int strategy)
{
	return (strategy < LOBE_STRATEGY_VISIBLE_SLOPES) | (strategy > LOBE_STRATEGY_VISIBLE_CAP);
}

/* Densities of which the points from the lobe see all, so that what is missing of them is what the surface rejects. */
LOBE_FN int lobe_recommend_covered(int k, lobe_microsurface s)
{
	return (k != LOBE_STRATEGY_UNIFORM) & (k != LOBE_STRATEGY_COSINE) & !lobe_strategy_borrows_ggx((lobe_uint)k, s);
}

/* Point i of a lattice that fills the cube evenly (Roberts 2018, "The unreasonable effectiveness of quasirandom
 * sequences"). */
LOBE_FN lobe_vec3 lobe_recommend_u(lobe_uint i)
{
	const lobe_real unit = LOBE_R(0x1p-24);
	return lobe_vec3_make((lobe_real)((i * 0xd1b54a33u + 0x80000000u) >> 8) * unit,
			      (lobe_real)((i * 0xabc98389u + 0x80000000u) >> 8) * unit,
			      (lobe_real)((i * 0x8cb92ba7u + 0x80000000u) >> 8) * unit);
}

LOBE_FN_APART lobe_recommend_point lobe_recommend_at(lobe_microsurface s, lobe_vec3 wo, lobe_vec3 wi,
						     lobe_light_seen light)
{
	const lobe_real zero = LOBE_R(0.0);
	lobe_recommend_point p;
	p.value = zero;
	for (int k = 0; k < LOBE_STRATEGY_LAST + 1; k++) {
		p.pdf[k] = zero;
		if (!lobe_recommend_looks_at(k) | !(wi.z > zero))
			continue;
		const lobe_scatter r = lobe_scatter_at(s, (lobe_uint)k, wo, wi, LOBE_R(1.0), 0);
		p.pdf[k] = r.facing > zero ? lobe_finite_or_zero(r.sampled) : zero;
		if (k == LOBE_STRATEGY_VISIBLE)
			p.value = r.facing > zero ? lobe_finite_or_zero(r.density * r.g2_over_cos) : zero;
	}
	p.pdf[LOBE_RECOMMEND_LIGHT] = light.pdf;
	p.value *= light.radiance;
	return p;
}

/* What a point drawn by density own, where the other technique has other, counts: by the power heuristic. */
LOBE_FN lobe_real lobe_recommend_weight(lobe_real part, lobe_real own, lobe_real other)
{
	const lobe_real ratio = other / own;
	const lobe_real w = LOBE_R(1.0) / (own * lobe_fma(ratio, ratio, LOBE_R(1.0)));
	return own > LOBE_R(0.0) ? w * part : LOBE_R(0.0);
}

/* The strategy that technique t takes the lobe's direction from. */
LOBE_FN int lobe_recommend_strategy_of(int t)
{
	return t == LOBE_RECOMMEND_BALANCE_BOUNDED ? LOBE_STRATEGY_BOUNDED_CAP
						   : (t < LOBE_RECOMMEND_LIGHT ? t : LOBE_STRATEGY_VISIBLE);
}

/* Weight of the lobe's direction in technique t. */
LOBE_FN lobe_real lobe_recommend_share(int t, lobe_real lobe, lobe_real light)
{
	const lobe_real ratio = light / lobe;
	const lobe_real r = t == LOBE_RECOMMEND_POWER ? ratio * ratio : ratio;
	return lobe > LOBE_R(0.0) ? LOBE_R(1.0) / (LOBE_R(1.0) + r) : LOBE_R(0.0);
}

LOBE_FN_APART lobe_recommend_sums lobe_recommend_first(lobe_recommend_sums s, lobe_recommend_point p, lobe_real w)
{
	s.mean += w * p.value;
	for (int k = 0; k < LOBE_RECOMMEND_DENSITIES; k++)
		s.first[k] += w * p.pdf[k];
	for (int t = LOBE_RECOMMEND_BALANCE; t < LOBE_RECOMMEND_TECHNIQUES; t++)
		s.first[t] +=
			w * p.value *
			lobe_recommend_share(t, p.pdf[lobe_recommend_strategy_of(t)], p.pdf[LOBE_RECOMMEND_LIGHT]);
	return s;
}

/* (x/p - mean)^2 p */
LOBE_FN lobe_real lobe_recommend_spread(lobe_real x, lobe_real p, lobe_real mean)
{
	const lobe_real off = x / p - mean;
	return p > LOBE_R(0.0) ? off * off * p : LOBE_R(0.0);
}

LOBE_FN_APART lobe_recommend_sums lobe_recommend_second(lobe_recommend_sums s, lobe_recommend_point p, lobe_real w)
{
	const lobe_real light = p.pdf[LOBE_RECOMMEND_LIGHT];
	for (int k = 0; k < LOBE_RECOMMEND_DENSITIES; k++)
		s.variance[k] += w * lobe_recommend_spread(p.value, p.pdf[k], s.mean);
	for (int t = LOBE_RECOMMEND_BALANCE; t < LOBE_RECOMMEND_TECHNIQUES; t++) {
		const lobe_real b = p.pdf[lobe_recommend_strategy_of(t)];
		const lobe_real share = lobe_recommend_share(t, b, light);
		const lobe_real of_light =
			lobe_recommend_spread((LOBE_R(1.0) - share) * p.value, light, s.mean - s.first[t]);
		s.variance[t] += w * (lobe_recommend_spread(share * p.value, b, s.first[t]) + of_light);
	}
	return s;
}

/* A direction of strategy k, (0, 0, 0) for none. */
LOBE_FN_APART lobe_vec3 lobe_recommend_draw(lobe_microsurface s, lobe_uint k, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_seen o = lobe_see(s, wo, one);
	const lobe_vec3 m = lobe_linear_normal(s.map, lobe_strategy_sample(k, s, o, wo, 0, u).m);
	const lobe_real twice = LOBE_R(2.0) * lobe_dot(wo, m) / lobe_dot(m, m);
	const lobe_vec3 wi = lobe_vec3_fma(twice, m, lobe_vec3_scale(wo, -one));
	const int seen = (wi.z > zero) & (lobe_dot(wo, m) > zero);
	return seen ? wi : lobe_vec3_make(zero, zero, zero);
}

/* Where the lobe looks at point i; (0, 0, 0): nowhere, and what the light is there does not matter. */
LOBE_FN lobe_vec3 lobe_recommend_direction(lobe_microsurface surface, lobe_vec3 wo, lobe_uint i)
{
	return lobe_recommend_draw(surface, LOBE_STRATEGY_VISIBLE, wo, lobe_recommend_u(i));
}

/* count: of points. The more uneven a light, the more of them it takes. */
LOBE_FN lobe_recommend_sums lobe_recommend_start(lobe_uint count)
{
	lobe_recommend_sums s;
	s.part = LOBE_R(1.0) / (lobe_real)count;
	s.mean = LOBE_R(0.0);
	for (int t = 0; t < LOBE_RECOMMEND_TECHNIQUES; t++)
		s.first[t] = s.variance[t] = LOBE_R(0.0);
	for (int k = 0; k < LOBE_RECOMMEND_DENSITIES; k++)
		s.rejected[k] = LOBE_R(0.0);
	return s;
}

/* Point i, from 1 on, of pass 0 over all of them, then of pass 1, which takes what the first has found. b:
 * lobe_recommend_direction; l: drawn from the light with lobe_recommend_u(i), of its sampling's own density. */
LOBE_FN_APART lobe_recommend_sums lobe_recommend_add(lobe_recommend_sums s, int pass, lobe_uint i,
						     lobe_microsurface surface, lobe_vec3 wo, lobe_vec3 b,
						     lobe_light_seen at_b, lobe_vec3 l, lobe_light_seen at_l)
{
	const lobe_vec3 u = lobe_recommend_u(i);
	const lobe_recommend_point of_b = lobe_recommend_at(surface, wo, b, at_b);
	const lobe_recommend_point of_l = lobe_recommend_at(surface, wo, l, at_l);
	const lobe_real w_b =
		lobe_recommend_weight(s.part, of_b.pdf[LOBE_STRATEGY_VISIBLE], of_b.pdf[LOBE_RECOMMEND_LIGHT]);
	const lobe_real w_l =
		lobe_recommend_weight(s.part, of_l.pdf[LOBE_RECOMMEND_LIGHT], of_l.pdf[LOBE_STRATEGY_VISIBLE]);
	if (pass)
		return lobe_recommend_second(lobe_recommend_second(s, of_b, w_b), of_l, w_l);
	s = lobe_recommend_first(lobe_recommend_first(s, of_b, w_b), of_l, w_l);
	for (int k = 0; k < LOBE_STRATEGY_LAST + 1; k++)
		if (lobe_recommend_looks_at(k) & lobe_recommend_covered(k, surface))
			s.rejected[k] += lobe_recommend_draw(surface, (lobe_uint)k, wo, u).z > LOBE_R(0.0) ? LOBE_R(0.0)
													   : s.part;
	return s;
}

/* All of it under a light of that shape. */
LOBE_FN_APART lobe_recommend_sums lobe_recommend_integrate(lobe_microsurface surface, lobe_vec3 wo,
							   lobe_light_shape light)
{
	lobe_recommend_sums s = lobe_recommend_start(LOBE_RECOMMEND_POINTS);
	for (int pass = 0; pass < 2; pass++)
		for (lobe_uint i = 1; i <= LOBE_RECOMMEND_POINTS; i++) {
			const lobe_vec3 b = lobe_recommend_direction(surface, wo, i);
			const lobe_vec3 l = lobe_light_shape_draw(light, lobe_recommend_u(i));
			lobe_light_seen at_b, at_l;
			/* Drawn in proportion to its radiance. */
			at_b.radiance = at_b.pdf = lobe_light_shape_density(light, b);
			at_l.radiance = at_l.pdf = lobe_light_shape_density(light, l);
			s = lobe_recommend_add(s, pass, i, surface, wo, b, at_b, l, at_l);
		}
	return s;
}

/* --- the answer --------------------------------------------------------------------------------------------------- */

/* Of both passes. A light that the lobe does not see at all (mean 0 to the last digit) is drawn from. */
LOBE_FN_APART lobe_recommendation lobe_recommend_answer(lobe_recommend_sums s, lobe_microsurface surface,
							lobe_recommend_cost cost)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	/* The default first, and its nearest. Others have to be better by more than the integrals are good for; by
	 * still more where weights have no bound, whose rare large ones the points may miss. */
	const lobe_real clearly = LOBE_R(0.985), unbounded = LOBE_R(0.93);
	lobe_recommendation best;
	best.strategy = LOBE_STRATEGY_VISIBLE;
	best.from = LOBE_SAMPLE_LIGHT;
	best.deviation = s.mean == zero ? zero : -one;
	lobe_real least = -one;
	for (int i = 0; i < LOBE_RECOMMEND_TECHNIQUES; i++) {
		/* VISIBLE, BOUNDED_CAP, then what is left. */
		const int t = i == 1 ? LOBE_STRATEGY_BOUNDED_CAP : (i == LOBE_STRATEGY_BOUNDED_CAP ? 1 : i);
		const int k = lobe_recommend_strategy_of(t);
		const int both = t >= LOBE_RECOMMEND_BALANCE, of_light = t == LOBE_RECOMMEND_LIGHT;
		if (!(both | of_light) & !lobe_recommend_looks_at(t))
			continue;
		/* Samples that find nothing: of covered densities those that the surface rejects. */
		const lobe_real unseen = lobe_max(one - s.first[k], zero);
		const lobe_real nothing =
			of_light ? zero : (lobe_recommend_covered(k, surface) ? s.rejected[k] : unseen);
		const lobe_real part = both ? s.first[t] : s.mean;
		const lobe_real variance = lobe_fma(nothing * part, part, s.variance[t]);
		const lobe_real price =
			both ? cost.lobe[k] + cost.light + cost.weighting : (of_light ? cost.light : cost.lobe[k]);
		const lobe_real loss = variance * price;
		const int heavy = !(both | of_light) & (k >= LOBE_STRATEGY_NDF) & (k != LOBE_STRATEGY_BOUNDED_CAP);
		if ((s.mean > zero) & ((least < zero) | (loss < (heavy ? unbounded : clearly) * least))) {
			least = loss;
			best.strategy = (lobe_uint)(of_light ? LOBE_STRATEGY_VISIBLE : k);
			best.from = t == LOBE_RECOMMEND_POWER
					    ? LOBE_SAMPLE_BOTH_POWER
					    : (both ? LOBE_SAMPLE_BOTH_BALANCE
						    : (of_light ? LOBE_SAMPLE_LIGHT : LOBE_SAMPLE_LOBE));
			best.deviation = lobe_sqrt(variance) / s.mean;
		}
	}
	return best;
}

/* surface: of the lobe. wo: unit; from below the surface no light is seen. Where a parameter is no number, or the light's
 * disk has no size, there is no answer: deviation -1. */
LOBE_FN_APART lobe_recommendation lobe_recommend_strategy(lobe_microsurface surface, lobe_vec3 wo,
							  lobe_light_shape light, lobe_recommend_cost cost)
{
	const lobe_real numbers = lobe_microsurface_params(surface) + lobe_vec3_sum(wo) + lobe_vec3_sum(light.axis) +
				  light.disk + light.glow + light.exponent + light.slope;
	lobe_recommendation r = lobe_recommend_answer(lobe_recommend_integrate(surface, wo, light), surface, cost);
	if (!(lobe_is_number(numbers) & (light.solid_angle > LOBE_R(0.0))))
		r.deviation = LOBE_R(-1.0);
	return r;
}

#endif
