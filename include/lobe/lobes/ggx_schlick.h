/* ggx_schlick.h - what engines shade with: GGX microsurface, Schlick's Fresnel from f0 to f90, single scattering.
 *
 * The model and its parameters: microfacet/schlick.h; its distribution: microfacet/ggx.h. Opaque and reciprocal. For a
 * dielectric coat f0 = ((eta - 1)/(eta + 1))^2 and f90 = 1; for a metal f0 is its colour. How far Schlick's curve is
 * from the exact ones: core/fresnel_schlick.h. Light that would scatter more than once on the microsurface is lost. */
#ifndef LOBE_LOBES_GGX_SCHLICK_H
#define LOBE_LOBES_GGX_SCHLICK_H

#include "../microfacet/schlick.h"

typedef lobe_rough_schlick lobe_ggx_schlick;

/* alpha_x, alpha_y: widths along tangent and bitangent, clamped to [LOBE_ALPHA_MIN, 1]. f0, f90: reflectance at normal
 * and at grazing incidence, each channel in [0, 1]. */
LOBE_FN lobe_ggx_schlick lobe_ggx_schlick_make(lobe_real alpha_x, lobe_real alpha_y, lobe_rgb f0, lobe_rgb f90)
{
	return lobe_rough_schlick_make(alpha_x, alpha_y, f0, f90);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_ggx_schlick_eval(lobe_ggx_schlick p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rough_schlick_eval(LOBE_NDF_GGX, p, wo, wi);
}

/* [1/sr] */
LOBE_FN lobe_real lobe_ggx_schlick_pdf(lobe_ggx_schlick p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rough_schlick_pdf(LOBE_NDF_GGX, p, wo, wi);
}

/* Uses u.x and u.y. No sample when the facet reflects below the surface. */
LOBE_FN lobe_sample lobe_ggx_schlick_sample(lobe_ggx_schlick p, lobe_vec3 wo, lobe_vec3 u)
{
	return lobe_rough_schlick_sample(LOBE_NDF_GGX, p, wo, u);
}

#endif
