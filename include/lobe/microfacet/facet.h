/* facet.h - what every distribution of microfacet normals tells, and the Smith masking that follows from it.
 *
 * A distribution X is the isotropic surface of width 1; linear maps (stretch.h, linear.h) make all others from it. Its
 * header has, for directions v and normals h of any length,
 *
 *	lobe_X_density(h)       pi |h|^-4 D(h/|h|), as inv^2 factor, of degree -4 in h: at unit h it is pi D, and at
 *	                        (slope, 0, 1) it is pi P22, the density of slopes
 *	lobe_X_hidden(v)        |v.z| Lambda(v), degree 1: the projected area of the facets that face away from v above the
 *	                        horizon. The same for v and -v
 *	lobe_X_tail(t2)         the fraction of the mean plane under facets steeper than tan^2 = t2
 *	lobe_X_tail_inverse(q)  the t2 of that
 *	lobe_X_visible(v, u)    a normal with density D(m) max(0, v.m)/sigma(v), v on either side of the horizon
 *
 * From them: sigma(v) = max(v.z, 0) + hidden(v), the projected area of all facets that face v, and
 *	t(v) = |v.z| + 2 hidden(v) = sigma(v) + sigma(-v),
 * in which Smith's masking needs no tangent and has no cancellation (v.z > 0):
 *	sigma = (z + t)/2,   G1 = 2z/(z + t),   G2 = 2 z_o z_i/(z_i t_o + z_o t_i)   (height-correlated, one side) */
#ifndef LOBE_MICROFACET_FACET_H
#define LOBE_MICROFACET_FACET_H

#include "../core/vec.h"

typedef struct {
	lobe_real inv, factor;
} lobe_facet_density;

LOBE_FN lobe_facet_density lobe_facet_density_none(void)
{
	lobe_facet_density d;
	d.inv = LOBE_R(0.0);
	d.factor = LOBE_R(0.0);
	return d;
}

/* What is left of the facets that a direction sees, where those are left out that reflect it below the horizon: of the
 * part of sigma below the mean plane, z/2 of (t + z)/2, this share. In (0, 1]; 1 leaves out nothing. */
typedef struct {
	lobe_real part, whole;
} lobe_facet_bound;

LOBE_FN lobe_facet_bound lobe_facet_bound_none(void)
{
	lobe_facet_bound b;
	b.part = LOBE_R(1.0);
	b.whole = LOBE_R(1.0);
	return b;
}

/* Twice the area that is left, times whole. */
LOBE_FN lobe_real lobe_facet_bound_sum(lobe_facet_bound b, lobe_real z, lobe_real t)
{
	return lobe_fma(t, b.whole, z * b.part);
}

/* z_i t_o + z_o t_i, the denominator of G2. */
LOBE_FN lobe_real lobe_smith_sum(lobe_real z_o, lobe_real t_o, lobe_real z_i, lobe_real t_i)
{
	return lobe_fma(z_i, t_o, z_o * t_i);
}

/* G2/z_o, both directions above the surface: 2 z_i/(z_i t_o + z_o t_i). Heitz 2014, eq. 99. */
LOBE_FN lobe_real lobe_smith_g2_over_cos(lobe_real z_o, lobe_real t_o, lobe_real z_i, lobe_real t_i)
{
	return (z_i + z_i) / lobe_smith_sum(z_o, t_o, z_i, t_i);
}

#endif
