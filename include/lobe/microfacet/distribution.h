/* distribution.h - a distribution of microfacet normals that is chosen at run time: dispatch over distributions.def.
 *
 * For the comparison lobes and for whoever studies distributions. Production lobes choose at compile time, by the same
 * numbers (ndf.h). What each function means: facet.h. All are of the isotropic surface of width 1 (or of the width that
 * is part of a shape: GTR's alpha, Phong's exponent); stretch.h and linear.h make all others from it. */
#ifndef LOBE_MICROFACET_DISTRIBUTION_H
#define LOBE_MICROFACET_DISTRIBUTION_H

#include "../core/constants.h"
#include "../core/table.h"
#include "../core/warp.h"
#include "facet.h"
#include "shape.h"
#include "beckmann.h"
#include "ggx.h"
#include "gtr.h"
#include "phong.h"
#include "student_t.h"
#include "tabulated.h"

/* The surface of a distribution without a shape of its own: LOBE_NDF_GGX, LOBE_NDF_BECKMANN. */
LOBE_FN lobe_distribution lobe_distribution_make(lobe_uint ndf)
{
	lobe_distribution d;
	d.ndf = ndf;
	d.exponent = LOBE_R(0.0);
	d.width = LOBE_R(1.0);
	d.norm = LOBE_R(1.0);
	d.table = lobe_table_at(0);
	return d;
}

/* pi |h|^-4 D(h/|h|), as inv^2 factor. */
LOBE_FN_APART lobe_facet_density lobe_distribution_density(lobe_distribution d, lobe_vec3 h)
{
	switch (LOBE_CHOSEN(d.ndf, LOBE_ONLY_NDF)) {
#define LOBE_NDF_FIXED(NAME, name, number)                                                                             \
	case number:                                                                                                   \
		return lobe_##name##_density(h);
#define LOBE_NDF_SHAPED(NAME, name, number)                                                                            \
	case number:                                                                                                   \
		return lobe_##name##_density(d, h);
#include "distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	default:
		return lobe_facet_density_none();
	}
}

/* |v.z| Lambda(v) */
LOBE_FN_APART lobe_real lobe_distribution_hidden(lobe_distribution d, lobe_vec3 v)
{
	switch (LOBE_CHOSEN(d.ndf, LOBE_ONLY_NDF)) {
#define LOBE_NDF_FIXED(NAME, name, number)                                                                             \
	case number:                                                                                                   \
		return lobe_##name##_hidden(v);
#define LOBE_NDF_SHAPED(NAME, name, number)                                                                            \
	case number:                                                                                                   \
		return lobe_##name##_hidden(d, v);
#include "distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	default:
		return LOBE_R(0.0);
	}
}

/* The fraction of the mean plane under facets steeper than tan^2 = t2. */
LOBE_FN_APART lobe_real lobe_distribution_tail(lobe_distribution d, lobe_real t2)
{
	switch (LOBE_CHOSEN(d.ndf, LOBE_ONLY_NDF)) {
#define LOBE_NDF_FIXED(NAME, name, number)                                                                             \
	case number:                                                                                                   \
		return lobe_##name##_tail(t2);
#define LOBE_NDF_SHAPED(NAME, name, number)                                                                            \
	case number:                                                                                                   \
		return lobe_##name##_tail(d, t2);
#include "distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	default:
		return LOBE_R(0.0);
	}
}

/* The t2 of tail q, in (0, 1]. */
LOBE_FN_APART lobe_real lobe_distribution_tail_inverse(lobe_distribution d, lobe_real q)
{
	switch (LOBE_CHOSEN(d.ndf, LOBE_ONLY_NDF)) {
#define LOBE_NDF_FIXED(NAME, name, number)                                                                             \
	case number:                                                                                                   \
		return lobe_##name##_tail_inverse(q);
#define LOBE_NDF_SHAPED(NAME, name, number)                                                                            \
	case number:                                                                                                   \
		return lobe_##name##_tail_inverse(d, q);
#include "distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	default:
		return LOBE_R(0.0);
	}
}

/* A normal visible from v, on either side of the horizon: density D(m) max(0, v.m)/sigma(v). Of any length. */
LOBE_FN_APART lobe_vec3 lobe_distribution_visible(lobe_distribution d, lobe_vec3 v, lobe_vec2 u)
{
	switch (LOBE_CHOSEN(d.ndf, LOBE_ONLY_NDF)) {
#define LOBE_NDF_FIXED(NAME, name, number)                                                                             \
	case number:                                                                                                   \
		return lobe_##name##_visible(v, u);
#define LOBE_NDF_SHAPED(NAME, name, number)                                                                            \
	case number:                                                                                                   \
		return lobe_##name##_visible(d, v, u);
#include "distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	default:
		return lobe_vec3_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(1.0));
	}
}

/* Projected area of the facets that face v: max(v.z, 0) + |v.z| Lambda(v). Degree 1 in v. */
LOBE_FN lobe_real lobe_distribution_sigma(lobe_distribution d, lobe_vec3 v)
{
	return lobe_max(v.z, LOBE_R(0.0)) + lobe_distribution_hidden(d, v);
}

/* A normal with density D(m) m.z (Walter et al. 2007, section 5.3): (-slope, 1) with the steepness from u.x, the
 * azimuth from u.y. */
LOBE_FN lobe_vec3 lobe_distribution_plain(lobe_distribution d, lobe_vec2 u)
{
	const lobe_real steep = lobe_sqrt(lobe_distribution_tail_inverse(d, LOBE_R(1.0) - u.x));
	const lobe_sincos sc = lobe_sincos_2pi(u.y);
	return lobe_vec3_make(steep * sc.c, steep * sc.s, LOBE_R(1.0));
}

#endif
