/* strategy.h - the ways to sample a microfacet lobe, with the exact density of each.
 *
 * Most sample a facet m, which then reflects or refracts. Their density is written as D_s(m) |o.m| rate, D_s being the
 * distribution itself or, for what only GGX has, that of the GGX surface of the same linear map; then D cancels in a
 * weight, where two huge numbers would be divided otherwise. rate is 1/sigma for visible normals.
 *
 * VISIBLE		the distribution's own visible normals: what production lobes do but for reflections by GGX
 * UNIFORM, COSINE	no facet: a direction uniform over what the lobe can reach, a hemisphere or, where it transmits, the
 *			sphere; or by its cosine, on either side with probability 1/2
 * NDF			D(m) m.z (Walter et al. 2007): facets whether visible or not
 * VISIBLE_SLOPES	GGX's visible normals, slope by slope (Heitz and d'Eon 2014)
 * VISIBLE_ELLIPSOID	the same on the projected ellipsoid (Heitz 2018)
 * VISIBLE_CAP		the same by spherical caps (Dupuy and Benyoub 2023)
 * BOUNDED_CAP		those of them that reflect above the horizon, and few others (Eto and Tokuyoshi 2023): what
 *			production lobes of GGX do that only reflect. The bound is one of reflection by a surface without
 *			shear; for any other it is VISIBLE_CAP
 * VCAVITY		the visible sides of V-cavities (Heitz and d'Eon 2014). Nothing where the mean plane shows its back
 * HEMISPHERE		a point of the disk under the standard hemisphere, whose normal the map turns into one of the
 *			surface (Atanasov et al. 2022): 1/pi per area, times z to a solid angle of normals, times
 *			|det M| |M^-1..|^-3 to one of mapped normals
 *
 * Every one serves any distribution and any masking, unbiased: its density is that of what it samples, be that GGX's,
 * and nothing that the surface can do is out of its reach (but VCAVITY's, where the mean plane shows its back). With a
 * distribution whose tail is longer than GGX's the variance of GGX's samplers is infinite all the same. */
#ifndef LOBE_MICROFACET_STRATEGY_H
#define LOBE_MICROFACET_STRATEGY_H

#include "ggx_visible.h"
#include "microsurface.h"
#include "vcavity.h"

/* Stable across versions. */
enum {
	LOBE_STRATEGY_VISIBLE = 0,
	LOBE_STRATEGY_UNIFORM = 1,
	LOBE_STRATEGY_COSINE = 2,
	LOBE_STRATEGY_NDF = 3,
	LOBE_STRATEGY_VISIBLE_SLOPES = 4,
	LOBE_STRATEGY_VISIBLE_ELLIPSOID = 5,
	LOBE_STRATEGY_VISIBLE_CAP = 6,
	LOBE_STRATEGY_BOUNDED_CAP = 7,
	LOBE_STRATEGY_VCAVITY = 8,
	LOBE_STRATEGY_HEMISPHERE = 9,
	LOBE_STRATEGY_LAST = LOBE_STRATEGY_HEMISPHERE
};

/* Directions are sampled, not facets. */
LOBE_FN int lobe_strategy_of_directions(lobe_uint strategy)
{
	return (strategy == LOBE_STRATEGY_UNIFORM) | (strategy == LOBE_STRATEGY_COSINE);
}

/* Facets of the GGX surface of the same map are sampled, and the distribution is another. */
LOBE_FN int lobe_strategy_borrows_ggx(lobe_uint strategy, lobe_microsurface s)
{
	const int of_ggx = ((strategy >= LOBE_STRATEGY_VISIBLE_SLOPES) & (strategy <= LOBE_STRATEGY_BOUNDED_CAP)) |
			   (strategy == LOBE_STRATEGY_HEMISPHERE);
	return of_ggx & (LOBE_CHOSEN(s.distribution.ndf, LOBE_ONLY_NDF) != LOBE_NDF_GGX);
}

/* s.like, which of GGX itself is 1. */
LOBE_FN lobe_real lobe_strategy_like(lobe_microsurface s)
{
	return LOBE_CHOSEN(s.distribution.ndf, LOBE_ONLY_NDF) == LOBE_NDF_GGX ? LOBE_R(1.0) : s.like;
}

/* A direction and a normal of the surface of width 1, as the GGX surface of that width has them. */
LOBE_FN lobe_vec3 lobe_strategy_ggx_direction(lobe_microsurface s, lobe_vec3 v)
{
	const lobe_real like = lobe_strategy_like(s);
	return lobe_vec3_make(like * v.x, like * v.y, v.z);
}

LOBE_FN lobe_vec3 lobe_strategy_ggx_facet(lobe_microsurface s, lobe_vec3 h)
{
	const lobe_real inv = LOBE_R(1.0) / lobe_strategy_like(s);
	return lobe_vec3_make(inv * h.x, inv * h.y, h.z);
}

/* D_s(h) of facet.h, given D's own. */
LOBE_FN lobe_facet_density lobe_strategy_density(lobe_uint strategy, lobe_microsurface s, lobe_vec3 h,
						 lobe_facet_density own)
{
	lobe_facet_density ggx = lobe_ggx_density(lobe_strategy_ggx_facet(s, h));
	ggx.factor = LOBE_R(1.0) / (lobe_strategy_like(s) * lobe_strategy_like(s));
	return lobe_strategy_borrows_ggx(strategy, s) ? ggx : own;
}

/* D/D_s */
LOBE_FN lobe_real lobe_strategy_ratio(lobe_facet_density d, lobe_facet_density d_s)
{
	const lobe_real x = d.inv / d_s.inv;
	return x * x * (d.factor / d_s.factor);
}

/* For wo above the surface; transmits: the lobe refracts too. */
LOBE_FN lobe_facet_bound lobe_strategy_bound(lobe_uint strategy, lobe_microsurface s, lobe_vec3 wo, lobe_real z,
					     int transmits)
{
	const lobe_real zero = LOBE_R(0.0);
	const int sheared = (s.map.mean_x != zero) | (s.map.mean_y != zero);
	const int bounded = (strategy == LOBE_STRATEGY_BOUNDED_CAP) & !sheared & !transmits & (z > zero);
	const lobe_real narrow = lobe_min(s.narrow, LOBE_R(1.0));
	return bounded ? lobe_ggx_bound(narrow * narrow, wo) : lobe_facet_bound_none();
}

/* m: a normal of the surface of width 1, of any length. rest: of u.z, a random number still. */
typedef struct {
	lobe_vec3 m;
	lobe_real rest;
} lobe_strategy_facet;

/* A facet seen from o, whose direction is wo. Uses u.x and u.y, and VCAVITY a part of u.z. */
LOBE_FN_APART lobe_strategy_facet lobe_strategy_sample(lobe_uint strategy, lobe_microsurface s, lobe_seen o,
						       lobe_vec3 wo, int transmits, lobe_vec3 u)
{
	const lobe_vec2 u2 = lobe_vec2_make(u.x, u.y);
	const lobe_vec3 v = lobe_strategy_ggx_direction(s, o.v);
	const lobe_facet_bound b = lobe_strategy_bound(strategy, s, wo, o.v.z, transmits);
	lobe_strategy_facet f;
	f.rest = u.z;
	switch (strategy) {
	case LOBE_STRATEGY_VISIBLE:
		f.m = lobe_distribution_visible(s.distribution, o.v, u2);
		return f;
	case LOBE_STRATEGY_NDF:
		f.m = lobe_distribution_plain(s.distribution, u2);
		return f;
	case LOBE_STRATEGY_VCAVITY: {
		const lobe_vcavity_side side =
			lobe_vcavity_visible(o.v, lobe_distribution_plain(s.distribution, u2), u.z);
		f.m = side.m;
		f.rest = side.rest;
		return f;
	}
	case LOBE_STRATEGY_VISIBLE_SLOPES:
		f.m = lobe_ggx_visible_slopes(v, u2);
		break;
	case LOBE_STRATEGY_VISIBLE_ELLIPSOID:
		f.m = lobe_ggx_visible_ellipsoid(v, u2);
		break;
	case LOBE_STRATEGY_HEMISPHERE:
		f.m = lobe_cosine_hemisphere(u2);
		break;
	default:
		f.m = b.part < b.whole ? lobe_ggx_visible_bounded(v, lobe_ggx_t(v), b, u2) : lobe_ggx_visible(v, u2);
		break;
	}
	f.m = lobe_strategy_ggx_direction(s, f.m); /* a normal scales like a direction, towards the wider surface */
	return f;
}

/* Density of m over D_s(m) |o.m|, m.o > 0. */
LOBE_FN_APART lobe_real lobe_strategy_rate(lobe_uint strategy, lobe_microsurface s, lobe_seen o, lobe_vec3 wo,
					   int transmits, lobe_seen_facet m)
{
	const lobe_real one = LOBE_R(1.0), zero = LOBE_R(0.0);
	const lobe_vec3 v = lobe_strategy_ggx_direction(s, o.v);
	const lobe_real sigma = o.z + lobe_ggx_hidden(v);
	const lobe_facet_bound b = lobe_strategy_bound(strategy, s, wo, o.v.z, transmits);
	switch (strategy) {
	case LOBE_STRATEGY_VISIBLE:
		return one / o.sigma;
	case LOBE_STRATEGY_NDF:
	case LOBE_STRATEGY_HEMISPHERE:
		return m.z / m.o;
	case LOBE_STRATEGY_VCAVITY:
		return lobe_vcavity_g1_over_cos(o.z, m.o, m.z);
	case LOBE_STRATEGY_BOUNDED_CAP:
		return b.part < b.whole ? (b.whole + b.whole) / lobe_facet_bound_sum(b, o.v.z, lobe_ggx_t(v))
					: one / sigma;
	case LOBE_STRATEGY_VISIBLE_SLOPES:
	case LOBE_STRATEGY_VISIBLE_ELLIPSOID:
	case LOBE_STRATEGY_VISIBLE_CAP:
		return one / sigma;
	default:
		return zero;
	}
}

/* Of strategies of directions: i on the same side as wo, or below where the lobe transmits. Uses u.x and u.y, and
 * COSINE u.z to choose a side. */
LOBE_FN lobe_vec3 lobe_strategy_direction(lobe_uint strategy, int transmits, lobe_vec3 u)
{
	const lobe_vec2 u2 = lobe_vec2_make(u.x, u.y);
	const lobe_vec3 uniform = lobe_spherical_cap(u2, transmits ? LOBE_R(2.0) : LOBE_R(1.0));
	const lobe_vec3 cosine = lobe_cosine_hemisphere(u2);
	const int below = transmits & (u.z >= LOBE_R(0.5));
	const lobe_real z = below ? -cosine.z : cosine.z;
	return strategy == LOBE_STRATEGY_UNIFORM ? uniform : lobe_vec3_make(cosine.x, cosine.y, z);
}

/* [1/sr] */
LOBE_FN lobe_real lobe_strategy_direction_pdf(lobe_uint strategy, int transmits, lobe_vec3 i)
{
	const lobe_real both = transmits ? LOBE_R(0.5) : LOBE_R(1.0);
	return both * LOBE_INV_PI * (strategy == LOBE_STRATEGY_UNIFORM ? LOBE_R(0.5) : lobe_abs(i.z));
}

#endif
