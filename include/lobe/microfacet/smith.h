/* smith.h - Smith's microsurface: a distribution of normals (distribution.h) under a linear map (linear.h), with D,
 * projected area, masking and visible normals of a stretched, skewed and tilted surface.
 *
 * For shading normals that face away. The mean plane of a tilted surface may face away from a w above the horizon:
 * v.z <= 0 with w.z > 0. Some facets still face w, and visible normals with the density D(m) max(0, w.m)/sigma(w) are
 * drawn from them as from any other direction, because sigma(w) = max(v.z, 0) + hidden(v) is their area and nothing is
 * divided by a cosine (Tokuyoshi 2021, "Unbiased VNDF sampling for backfacing shading normals"; G1/|cos| in its place
 * would not integrate to 1 there). What is seen of the surface as a whole is the mean plane's share v.z of that area:
 * masking is G1 = v.z/sigma, and 0 where v.z <= 0.
 *
 * Directions and normals are unit. Each function is 0 where a parameter is no number. */
#ifndef LOBE_MICROFACET_SMITH_H
#define LOBE_MICROFACET_SMITH_H

#include "distribution.h"
#include "linear.h"

typedef struct {
	lobe_distribution normals;
	lobe_linear map;
} lobe_smith;

/* A surface of these normals under this map, masked as Smith has it. Holds copies of both. */
LOBE_FN lobe_smith lobe_smith_make(lobe_distribution normals, lobe_linear map)
{
	lobe_smith s;
	s.normals = normals;
	s.map = map;
	return s;
}

/* D(m) [1/sr]: area of facets per area of the horizontal plane. 0 for m.z <= 0. */
LOBE_FN lobe_real lobe_smith_d(lobe_smith s, lobe_vec3 m)
{
	const lobe_facet_density d = lobe_distribution_density(s.normals, lobe_linear_facet(s.map, m));
	const lobe_real value = lobe_finite_or_zero(s.map.norm * d.inv * d.inv * d.factor);
	return m.z > LOBE_R(0.0) ? value : LOBE_R(0.0);
}

/* The same per slope: P22(x, y), area of the horizontal plane under facets of these slopes. Integrates to 1. */
LOBE_FN lobe_real lobe_smith_p22(lobe_smith s, lobe_real x, lobe_real y)
{
	return lobe_smith_d(s, lobe_vec3_make(-x, -y, LOBE_R(1.0)));
}

/* Projected area of all facets that face w, on either side of the horizon, per area of the horizontal plane. */
LOBE_FN lobe_real lobe_smith_sigma(lobe_smith s, lobe_vec3 w)
{
	return lobe_finite_or_zero(lobe_distribution_sigma(s.normals, lobe_linear_direction(s.map, w)));
}

/* Smith's masking: the fraction of that which is seen. */
LOBE_FN lobe_real lobe_smith_g1(lobe_smith s, lobe_vec3 w)
{
	const lobe_vec3 v = lobe_linear_direction(s.map, w);
	const lobe_real g1 = v.z / (v.z + lobe_distribution_hidden(s.normals, v));
	return v.z > LOBE_R(0.0) ? lobe_finite_or_zero(g1) : LOBE_R(0.0);
}

/* Masking and shadowing, height-correlated (Heitz 2014, eq. 99): seen from o and lit from i, both on the upper side. */
LOBE_FN lobe_real lobe_smith_g2(lobe_smith s, lobe_vec3 o, lobe_vec3 i)
{
	const lobe_real two = LOBE_R(2.0);
	const lobe_vec3 vo = lobe_linear_direction(s.map, o);
	const lobe_vec3 vi = lobe_linear_direction(s.map, i);
	const lobe_real t_o = lobe_fma(two, lobe_distribution_hidden(s.normals, vo), lobe_abs(vo.z));
	const lobe_real t_i = lobe_fma(two, lobe_distribution_hidden(s.normals, vi), lobe_abs(vi.z));
	const lobe_real g2 = lobe_finite_or_zero(vo.z * lobe_smith_g2_over_cos(vo.z, t_o, vi.z, t_i));
	return lobe_min(vo.z, vi.z) > LOBE_R(0.0) ? g2 : LOBE_R(0.0);
}

/* A normal visible from w; the zero vector where no facet faces w. */
LOBE_FN lobe_vec3 lobe_smith_visible(lobe_smith s, lobe_vec3 w, lobe_vec2 u)
{
	const lobe_vec3 n = lobe_distribution_visible(s.normals, lobe_linear_direction(s.map, w), u);
	const lobe_vec3 m = lobe_linear_normal(s.map, n);
	const lobe_real len2 = lobe_dot(m, m);
	const int ok = (len2 > LOBE_R(0.0)) & (len2 <= LOBE_REAL_MAX);
	return lobe_vec3_scale(ok ? m : lobe_vec3_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0)),
			       ok ? LOBE_R(1.0) / lobe_sqrt(len2) : LOBE_R(0.0));
}

/* Its density D(m) max(0, w.m)/sigma(w) [1/sr]. */
LOBE_FN lobe_real lobe_smith_visible_pdf(lobe_smith s, lobe_vec3 w, lobe_vec3 m)
{
	const lobe_real facing = lobe_max(lobe_dot(w, m), LOBE_R(0.0));
	return lobe_finite_or_zero(lobe_smith_d(s, m) * facing / lobe_smith_sigma(s, w));
}

#endif
