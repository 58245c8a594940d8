/* ggx_dielectric.h - rough glass: reflection and refraction by a GGX microsurface, from both sides.
 *
 * The model, its parameters and what it does near eta = 1: microfacet/dielectric.h; its distribution: microfacet/ggx.h.
 * Single scattering: what would hit the microsurface again is lost. */
#ifndef LOBE_LOBES_GGX_DIELECTRIC_H
#define LOBE_LOBES_GGX_DIELECTRIC_H

#include "../microfacet/dielectric.h"

typedef lobe_rough_dielectric lobe_ggx_dielectric;

/* alpha_x, alpha_y: widths along tangent and bitangent, clamped to [LOBE_ALPHA_MIN, 1]. eta: index below over index
 * above the surface, in [1/1000, 1000]. Carries radiance; see lobe_ggx_dielectric_transport. */
LOBE_FN lobe_ggx_dielectric lobe_ggx_dielectric_make(lobe_real alpha_x, lobe_real alpha_y, lobe_real eta)
{
	return lobe_rough_dielectric_make(alpha_x, alpha_y, eta);
}

/* The same surface for LOBE_TRANSPORT_RADIANCE or LOBE_TRANSPORT_IMPORTANCE (core/event.h). */
LOBE_FN lobe_ggx_dielectric lobe_ggx_dielectric_transport(lobe_ggx_dielectric p, lobe_uint transport)
{
	return lobe_rough_dielectric_transport(p, transport);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_ggx_dielectric_eval(lobe_ggx_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rough_dielectric_eval(LOBE_NDF_GGX, p, wo, wi);
}

/* [1/sr] */
LOBE_FN lobe_real lobe_ggx_dielectric_pdf(lobe_ggx_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rough_dielectric_pdf(LOBE_NDF_GGX, p, wo, wi);
}

/* Uses u.x and u.y for the facet and u.z to choose between reflection and refraction. No sample when the facet sends
 * the light to the wrong side of the surface. With LOBE_EVENT_DELTA pdf is 1 - F of the sampled facet. */
LOBE_FN lobe_sample lobe_ggx_dielectric_sample(lobe_ggx_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	return lobe_rough_dielectric_sample(LOBE_NDF_GGX, p, wo, u);
}

#endif
