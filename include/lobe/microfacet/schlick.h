/* schlick.h - a rough surface of any colour: reflection.h with Schlick's Fresnel curve. The body of <ndf>_schlick. */
#ifndef LOBE_MICROFACET_SCHLICK_H
#define LOBE_MICROFACET_SCHLICK_H

#include "../core/fresnel_schlick.h"
#include "reflection.h"

/* stretch: widths along tangent and bitangent. f0, f90: reflectance at normal and at grazing incidence, in [0, 1]. */
typedef struct {
	lobe_stretch stretch;
	lobe_rgb f0, f90;
} lobe_rough_schlick;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. */
LOBE_FN lobe_rough_schlick lobe_rough_schlick_make(lobe_real alpha_x, lobe_real alpha_y, lobe_rgb f0, lobe_rgb f90)
{
	lobe_rough_schlick p;
	p.stretch = lobe_stretch_make(alpha_x, alpha_y);
	p.f0 = f0;
	p.f90 = f90;
	return p;
}

LOBE_FN lobe_real lobe_rough_schlick_params(lobe_rough_schlick p)
{
	return p.stretch.norm + p.f0.r + p.f0.g + p.f0.b + p.f90.r + p.f90.g + p.f90.b;
}

/* h2: |wo + wi|^2. */
LOBE_FN lobe_rgb lobe_rough_schlick_fresnel(lobe_rough_schlick p, lobe_real h2)
{
	const lobe_real c = lobe_reflection_cosine(h2);
	return lobe_fresnel_schlick_f90_rgb(c, p.f0, p.f90);
}

/* f |cos theta_i| [1/sr]. ndf: LOBE_NDF_*, a constant, here and below. */
LOBE_FN lobe_rgb lobe_rough_schlick_eval(lobe_uint ndf, lobe_rough_schlick p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_reflection_eval r = lobe_reflection_eval_at(ndf, p.stretch, lobe_rough_schlick_params(p), wo, wi);
	return lobe_reflection_tint(r, lobe_rough_schlick_fresnel(p, r.h2));
}

/* [1/sr] */
LOBE_FN lobe_real lobe_rough_schlick_pdf(lobe_uint ndf, lobe_rough_schlick p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_reflection_pdf(ndf, p.stretch, lobe_rough_schlick_params(p), wo, wi);
}

/* Uses u.x and u.y. No sample where the facet reflects below the surface. */
LOBE_FN lobe_sample lobe_rough_schlick_sample(lobe_uint ndf, lobe_rough_schlick p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_reflection_sample r = lobe_reflection_sample_at(ndf, p.stretch, lobe_rough_schlick_params(p), wo, u);
	return lobe_reflection_tint_sample(r, lobe_rough_schlick_fresnel(p, r.h2));
}

#endif
