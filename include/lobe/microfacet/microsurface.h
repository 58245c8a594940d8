/* microsurface.h - a rough surface of which everything is chosen at run time: distribution, linear map, masking.
 *
 * For comparing models; a production lobe has each of these as a constant. The parts below are those of every lobe that
 * chooses so (lobes/microfacet_*.h): masking.h and vcavity.h say how much of a facet is seen and lit, strategy.h how
 * facets or directions are sampled. */
#ifndef LOBE_MICROFACET_MICROSURFACE_H
#define LOBE_MICROFACET_MICROSURFACE_H

#include "beckmann.h"
#include "distribution.h"
#include "linear.h"

/* How facets hide each other; masking.h tells each. Stable across versions. */
enum {
	LOBE_MASKING_SMITH = 0,
	LOBE_MASKING_VCAVITY = 1,
	LOBE_MASKING_NONE = 2,
	LOBE_MASKING_IMPLICIT = 3,
	LOBE_MASKING_SCHLICK_SMITH = 4,
	LOBE_MASKING_SCHLICK_GGX = 5,
	LOBE_MASKING_SCHLICK_GGX_LIGHTS = 6,
	LOBE_MASKING_KELEMEN = 7,
	LOBE_MASKING_NEUMANN = 8,
	LOBE_MASKING_DISNEY = 9,
	LOBE_MASKING_SMITH_RATIONAL = 10,
	LOBE_MASKING_LAST = LOBE_MASKING_SMITH_RATIONAL
};

/* How Smith's masking of two directions on one side of the surface goes together, and of two on opposite sides. */
enum {
	LOBE_JOINT_HEIGHT = 0,
	LOBE_JOINT_SEPARABLE = 1,
	LOBE_JOINT_DIRECTION = 2,
	LOBE_JOINT_HEIGHT_DIRECTION = 3,
	LOBE_JOINT_LAST = LOBE_JOINT_HEIGHT_DIRECTION
};

enum { LOBE_ACROSS_SEPARABLE = 0, LOBE_ACROSS_BETA = 1 };

/* masking, joint, across: LOBE_MASKING_*, LOBE_JOINT_*, LOBE_ACROSS_*. Prepared: like, the width of the GGX surface
 * that the distribution is most like before the map; alpha, the one width that masking without directions takes for the
 * surface's: like times the geometric mean of the map's two widths; narrow: like times the lesser of the two. */
typedef struct {
	lobe_distribution distribution;
	lobe_linear map;
	lobe_uint masking, joint, across;
	lobe_real like, alpha, narrow;
} lobe_microsurface;

/* The lesser singular value of the map's matrix: with e, f, g, h half the sum and difference of diagonal and
 * antidiagonal, the two are |hypot(e, h) -+ hypot(f, g)|, of which the lesser is det over the greater. */
LOBE_FN lobe_real lobe_linear_narrow(lobe_linear m)
{
	const lobe_real e = m.xx + m.yy, f = m.xx - m.yy, g = m.yx + m.xy, h = m.yx - m.xy;
	const lobe_real wide = LOBE_R(0.5) * (lobe_sqrt(lobe_fma(e, e, h * h)) + lobe_sqrt(lobe_fma(f, f, g * g)));
	return LOBE_INV_PI / (m.norm * wide);
}

/* The width that the distribution has before the map, as a GGX surface would have it. */
LOBE_FN lobe_real lobe_distribution_like_ggx(lobe_distribution d)
{
	return d.ndf == LOBE_NDF_PHONG ? lobe_phong_alpha(d.exponent) : d.width;
}

/* Smith's masking, height-correlated on one side and separable across. */
LOBE_FN lobe_microsurface lobe_microsurface_make(lobe_distribution distribution, lobe_linear map)
{
	lobe_microsurface s;
	s.distribution = distribution;
	s.map = map;
	s.masking = LOBE_MASKING_SMITH;
	s.joint = LOBE_JOINT_HEIGHT;
	s.across = LOBE_ACROSS_SEPARABLE;
	s.like = lobe_distribution_like_ggx(distribution);
	s.alpha = s.like * lobe_sqrt(LOBE_INV_PI / map.norm);
	s.narrow = s.like * lobe_linear_narrow(map);
	return s;
}

/* The same surface with LOBE_MASKING_*. */
LOBE_FN lobe_microsurface lobe_microsurface_masking(lobe_microsurface s, lobe_uint masking)
{
	s.masking = masking;
	return s;
}

/* The same surface with LOBE_JOINT_* on one side and LOBE_ACROSS_* across. Masking other than Smith's knows neither. */
LOBE_FN lobe_microsurface lobe_microsurface_joint(lobe_microsurface s, lobe_uint joint, lobe_uint across)
{
	s.joint = joint;
	s.across = across;
	return s;
}

/* The greater of the map's widths, times like. */
LOBE_FN lobe_real lobe_microsurface_wide(lobe_microsurface s) { return s.alpha * (s.alpha / s.narrow); }

/* No finite number where a parameter is none. */
LOBE_FN lobe_real lobe_microsurface_params(lobe_microsurface s)
{
	const lobe_linear m = s.map;
	const lobe_real slopes = m.xx + m.xy + m.yx + m.yy + m.mean_x + m.mean_y;
	const lobe_real inverse = m.ixx + m.ixy + m.iyx + m.iyy + m.norm;
	const lobe_real shape = s.distribution.exponent + s.distribution.width + s.distribution.norm;
	return slopes + inverse + shape + s.like + s.alpha + s.narrow;
}

/* |v.z| Lambda(v) by which the surface masks: the distribution's own, but for LOBE_MASKING_SMITH_RATIONAL, which takes
 * it for Beckmann's of the width that it is like. */
LOBE_FN lobe_real lobe_microsurface_hides(lobe_microsurface s, lobe_vec3 v, lobe_real hidden)
{
	const lobe_vec3 like = lobe_vec3_make(s.like * v.x, s.like * v.y, v.z);
	return LOBE_CHOSEN(s.masking, LOBE_ONLY_MASKING) == LOBE_MASKING_SMITH_RATIONAL
		       ? lobe_beckmann_hidden_rational(like)
		       : hidden;
}

/* What masking and sampling ask of a direction. v: as it sees the surface of width 1. z: the mean plane's area as seen
 * from it, 0 where that shows its back. sigma: that of all facets which face it. hides: by Smith, of those that face
 * away. cosine: of the angle to the mean plane once the shear is undone (w.z where there is none), inv_length times
 * z. */
typedef struct {
	lobe_vec3 v;
	lobe_real z, sigma, hides, cosine, inv_length;
} lobe_seen;

/* side: 1 for a direction above the surface, -1 for one below, which sees the backs of the facets: for it v and z are
 * those of the opposite direction. */
LOBE_FN_APART lobe_seen lobe_see(lobe_microsurface s, lobe_vec3 w_in, lobe_real side)
{
	const lobe_vec3 w = lobe_vec3_scale(w_in, side);
	lobe_seen d;
	d.v = lobe_linear_direction(s.map, w);
	const lobe_real hidden = lobe_distribution_hidden(s.distribution, d.v);
	d.z = lobe_max(d.v.z, LOBE_R(0.0));
	d.sigma = d.z + hidden;
	d.hides = lobe_microsurface_hides(s, d.v, hidden);
	d.inv_length = LOBE_R(1.0) / lobe_sqrt(lobe_fma(w.x, w.x, lobe_fma(w.y, w.y, d.v.z * d.v.z)));
	d.cosine = d.z * d.inv_length;
	return d;
}

/* What they ask of a facet h of any length: |o.h| and |i.h|, which are products with v and with h on the surface of
 * width 1 as well; h.z > 0, the same there; |h|^2. */
typedef struct {
	lobe_real o, i, z, length2;
} lobe_seen_facet;

/* The facet of normal h, of any length, as two directions see it. */
LOBE_FN lobe_seen_facet lobe_seen_facet_make(lobe_vec3 o, lobe_vec3 i, lobe_vec3 h)
{
	lobe_seen_facet m;
	m.o = lobe_dot(o, h);
	m.i = lobe_dot(i, h);
	m.z = h.z;
	m.length2 = lobe_dot(h, h);
	return m;
}

#endif
