/* ggx_conductor.h - a rough metal: GGX microsurface, exact conductor Fresnel, single scattering.
 *
 * The model and its parameters: microfacet/conductor.h; its distribution: microfacet/ggx.h. Opaque and reciprocal.
 * Light that would scatter more than once on the microsurface is lost (at alpha 1 up to 69 %). */
#ifndef LOBE_LOBES_GGX_CONDUCTOR_H
#define LOBE_LOBES_GGX_CONDUCTOR_H

#include "../microfacet/conductor.h"

typedef lobe_rough_conductor lobe_ggx_conductor;

/* alpha_x, alpha_y: widths along tangent and bitangent, clamped to [LOBE_ALPHA_MIN, 1]. eta, k: complex index n + ik
 * per channel over that of the outside, eta in [1/1000, 1000], k in [0, 1000]. */
LOBE_FN lobe_ggx_conductor lobe_ggx_conductor_make(lobe_real alpha_x, lobe_real alpha_y, lobe_rgb eta, lobe_rgb k)
{
	return lobe_rough_conductor_make(alpha_x, alpha_y, eta, k);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_ggx_conductor_eval(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rough_conductor_eval(LOBE_NDF_GGX, p, wo, wi);
}

/* [1/sr] */
LOBE_FN lobe_real lobe_ggx_conductor_pdf(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rough_conductor_pdf(LOBE_NDF_GGX, p, wo, wi);
}

/* Uses u.x and u.y. No sample when the facet reflects below the surface. */
LOBE_FN lobe_sample lobe_ggx_conductor_sample(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 u)
{
	return lobe_rough_conductor_sample(LOBE_NDF_GGX, p, wo, u);
}

#endif
