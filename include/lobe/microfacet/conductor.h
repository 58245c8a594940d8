/* conductor.h - a rough metal: reflection.h with the exact Fresnel term of a conductor. The body of <ndf>_conductor. */
#ifndef LOBE_MICROFACET_CONDUCTOR_H
#define LOBE_MICROFACET_CONDUCTOR_H

#include "reflection.h"

/* stretch: widths along tangent and bitangent. eta, k: complex index n + ik per channel over that of the outside, eta
 * in [1/1000, 1000], k in [0, 1000] (core/optics.h has those of real metals). */
typedef struct {
	lobe_stretch stretch;
	lobe_rgb eta, k;
} lobe_rough_conductor;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. */
LOBE_FN lobe_rough_conductor lobe_rough_conductor_make(lobe_real alpha_x, lobe_real alpha_y, lobe_rgb eta, lobe_rgb k)
{
	lobe_rough_conductor p;
	p.stretch = lobe_stretch_make(alpha_x, alpha_y);
	p.eta = eta;
	p.k = k;
	return p;
}

LOBE_FN lobe_real lobe_rough_conductor_params(lobe_rough_conductor p)
{
	return p.stretch.norm + p.eta.r + p.eta.g + p.eta.b + p.k.r + p.k.g + p.k.b;
}

/* x times the reflectance; h2: |wo + wi|^2 = 4 c^2. */
LOBE_FN lobe_rgb lobe_rough_conductor_fresnel(lobe_rough_conductor p, lobe_real h2, lobe_real x)
{
	return lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle_make(LOBE_R(0.25) * h2), p.eta, p.k, x);
}

/* f |cos theta_i| [1/sr]. ndf: LOBE_NDF_*, a constant, here and below. */
LOBE_FN lobe_rgb lobe_rough_conductor_eval(lobe_uint ndf, lobe_rough_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_reflection_eval r = lobe_reflection_eval_at(ndf, p.stretch, lobe_rough_conductor_params(p), wo, wi);
	return lobe_reflection_eval_result(r, lobe_rough_conductor_fresnel(p, r.h2, r.value));
}

/* [1/sr] */
LOBE_FN lobe_real lobe_rough_conductor_pdf(lobe_uint ndf, lobe_rough_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_reflection_pdf(ndf, p.stretch, lobe_rough_conductor_params(p), wo, wi);
}

/* Uses u.x and u.y. No sample where the facet reflects below the surface. */
LOBE_FN lobe_sample lobe_rough_conductor_sample(lobe_uint ndf, lobe_rough_conductor p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_reflection_sample r =
		lobe_reflection_sample_at(ndf, p.stretch, lobe_rough_conductor_params(p), wo, u);
	return lobe_reflection_sample_result(r, lobe_rough_conductor_fresnel(p, r.h2, r.weight));
}

#endif
