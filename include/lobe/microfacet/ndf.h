/* ndf.h - the distributions that production lobes are built from, chosen by a constant.
 *
 * Every call site passes LOBE_NDF_*, so that a compiler folds the choice: one source of each formula, no cost. What no
 * lobe of a build uses is not compiled (config.h). Lobes that choose at run time, among more distributions, do so in
 * distribution.h with the same numbers. */
#ifndef LOBE_MICROFACET_NDF_H
#define LOBE_MICROFACET_NDF_H

#include "../config.h"
#include "facet.h"
#include "shape.h"
#if LOBE_HAS_NDF_GGX
#include "ggx.h"
#endif
#if LOBE_HAS_NDF_BECKMANN
#include "beckmann.h"
#endif

#if LOBE_HAS_NDF_GGX
#define LOBE_NDF_IS_BECKMANN(ndf) ((ndf) == LOBE_NDF_BECKMANN)
#else
#define LOBE_NDF_IS_BECKMANN(ndf) 1
#endif

/* lobe_X_density(h) of facet.h with inv over s, which shares its division; from the squares of h. */
LOBE_FN lobe_facet_density lobe_ndf_density_over(lobe_uint ndf, lobe_vec3 h2, lobe_real s)
{
	(void)ndf;
#if LOBE_HAS_NDF_BECKMANN
	if (LOBE_NDF_IS_BECKMANN(ndf))
		return lobe_beckmann_density_over(h2, s);
#endif
#if LOBE_HAS_NDF_GGX
	return lobe_ggx_density_over(h2, s);
#endif
}

/* t(v) of facet.h. */
LOBE_FN lobe_real lobe_ndf_t(lobe_uint ndf, lobe_vec3 v)
{
	(void)ndf;
#if LOBE_HAS_NDF_BECKMANN
	if (LOBE_NDF_IS_BECKMANN(ndf))
		return lobe_beckmann_t(v);
#endif
#if LOBE_HAS_NDF_GGX
	return lobe_ggx_t(v);
#endif
}

/* What a reflection need not sample of the facets visible from wo; narrow2: the square of the lesser width. */
LOBE_FN lobe_facet_bound lobe_ndf_bound(lobe_uint ndf, lobe_real narrow2, lobe_vec3 wo)
{
	(void)ndf;
	(void)narrow2;
	(void)wo;
#if LOBE_HAS_NDF_BECKMANN
	if (LOBE_NDF_IS_BECKMANN(ndf))
		return lobe_facet_bound_none();
#endif
#if LOBE_HAS_NDF_GGX
	return lobe_ggx_bound(narrow2, wo);
#endif
}

/* A normal visible from v, v.z > 0; t: lobe_ndf_t(ndf, v). */
LOBE_FN lobe_vec3 lobe_ndf_visible_above(lobe_uint ndf, lobe_vec3 v, lobe_real t, lobe_vec2 u)
{
	(void)ndf;
	(void)t;
#if LOBE_HAS_NDF_BECKMANN
	if (LOBE_NDF_IS_BECKMANN(ndf))
		return lobe_beckmann_visible_above(v, u);
#endif
#if LOBE_HAS_NDF_GGX
	return lobe_ggx_visible_above(v, t, u);
#endif
}

/* The same of those that b leaves, which is lobe_ndf_bound's. */
LOBE_FN lobe_vec3 lobe_ndf_visible_bounded(lobe_uint ndf, lobe_vec3 v, lobe_real t, lobe_facet_bound b, lobe_vec2 u)
{
	(void)ndf;
	(void)t;
	(void)b;
#if LOBE_HAS_NDF_BECKMANN
	if (LOBE_NDF_IS_BECKMANN(ndf))
		return lobe_beckmann_visible_above(v, u);
#endif
#if LOBE_HAS_NDF_GGX
	return lobe_ggx_visible_bounded(v, t, b, u);
#endif
}

#endif
