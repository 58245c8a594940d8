/* reflection.h - a rough mirror: all of an opaque microfacet lobe but its Fresnel term.
 *
 * Cook and Torrance 1982 with the height-correlated masking and shadowing of Heitz 2014 (eq. 99) and visible-normal
 * sampling (Heitz and d'Eon 2014; for GGX by spherical caps, Dupuy and Benyoub 2023):
 *	f = F D G2/(4 z_o z_i),   pdf = D/(4 sigma(wo)),   weight = F G2/G1(wo)
 * 0 when either direction is at or below the surface. Everything is written with the unnormalised half vector
 * H = wo + wi, h2 = |H|^2, and o.h = |H|/2, which for unit directions does not cancel as the dot product does when both
 * graze.
 *
 * ndf: LOBE_NDF_*, a constant. params: the sum of the lobe's parameters; where that is no finite number every result is
 * 0 (out of a loop over one material it is taken once). */
#ifndef LOBE_MICROFACET_REFLECTION_H
#define LOBE_MICROFACET_REFLECTION_H

#include "../core/event.h"
#include "../core/fresnel.h"
#include "ndf.h"
#include "stretch.h"

/* Both directions above the surface, every parameter a number and the density x too; x is then >= 0. */
LOBE_FN int lobe_reflection_ok(lobe_real params, lobe_vec3 wo, lobe_vec3 wi, lobe_real x)
{
	const int numbers = params - params == LOBE_R(0.0);
	return numbers & (lobe_min(wo.z, wi.z) > LOBE_R(0.0)) & (x <= LOBE_REAL_MAX);
}

LOBE_FN lobe_real lobe_reflection_t(lobe_uint ndf, lobe_stretch s, lobe_vec3 w)
{
	return lobe_ndf_t(ndf, lobe_stretch_direction(s, w));
}

/* D(h)/(4 sigma(wo)) [1/sr], two_sigma = 2 sigma(wo). NaN for H = 0. */
LOBE_FN lobe_real lobe_reflection_density(lobe_uint ndf, lobe_stretch s, lobe_vec3 h, lobe_real h2, lobe_real two_sigma)
{
	const lobe_facet_density d = lobe_ndf_density_over(ndf, lobe_stretch_facet(s, h), two_sigma);
	const lobe_real x = h2 * d.inv;
	return s.norm * x * x * (LOBE_R(0.5) * two_sigma) * d.factor;
}

/* G2/G1(wo) */
LOBE_FN lobe_real lobe_reflection_weight(lobe_uint ndf, lobe_stretch s, lobe_real z_o, lobe_real t_o, lobe_vec3 wi)
{
	return LOBE_R(0.5) * (z_o + t_o) * lobe_smith_g2_over_cos(z_o, t_o, wi.z, lobe_reflection_t(ndf, s, wi));
}

/* f |cos theta_i|/F [1/sr], and |H|^2 for Fresnel. ok: else the lobe is 0. */
typedef struct {
	lobe_real value, h2;
	int ok;
} lobe_reflection_eval;

/* As the density of a sample times its weight, of which pdf and sample compute the same. */
LOBE_FN lobe_reflection_eval lobe_reflection_eval_at(lobe_uint ndf, lobe_stretch s, lobe_real params, lobe_vec3 wo,
						     lobe_vec3 wi)
{
	const lobe_vec3 h = lobe_vec3_add(wo, wi);
	const lobe_real t_o = lobe_reflection_t(ndf, s, wo);
	lobe_reflection_eval r;
	r.h2 = lobe_dot(h, h);
	r.value = lobe_reflection_density(ndf, s, h, r.h2, wo.z + t_o) * lobe_reflection_weight(ndf, s, wo.z, t_o, wi);
	r.ok = lobe_reflection_ok(params, wo, wi, r.value);
	return r;
}

/* [1/sr] */
LOBE_FN lobe_real lobe_reflection_pdf(lobe_uint ndf, lobe_stretch s, lobe_real params, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_vec3 h = lobe_vec3_add(wo, wi);
	const lobe_real two_sigma = wo.z + lobe_reflection_t(ndf, s, wo);
	const lobe_real pdf = lobe_reflection_density(ndf, s, h, lobe_dot(h, h), two_sigma);
	const int ok = lobe_reflection_ok(params, wo, wi, pdf);
	return ok ? pdf : LOBE_R(0.0);
}

/* weight: that of F = 1. No sample where pdf is 0. */
typedef struct {
	lobe_vec3 wi;
	lobe_real pdf, weight, h2;
} lobe_reflection_sample;

/* Uses u.x and u.y. */
LOBE_FN lobe_reflection_sample lobe_reflection_sample_at(lobe_uint ndf, lobe_stretch s, lobe_real params, lobe_vec3 wo,
							 lobe_vec3 u)
{
	const lobe_vec3 v = lobe_stretch_direction(s, wo);
	const lobe_real t_o = lobe_ndf_t(ndf, v);
	const lobe_vec3 m = lobe_stretch_normal(s, lobe_ndf_visible_above(ndf, v, t_o, lobe_vec2_make(u.x, u.y)));
	lobe_reflection_sample r;
	r.wi = lobe_reflect(wo, m, lobe_dot(wo, m) / lobe_dot(m, m));
	r.pdf = lobe_reflection_pdf(ndf, s, params, wo, r.wi);
	const lobe_vec3 h = lobe_vec3_add(wo, r.wi);
	r.h2 = lobe_dot(h, h);
	r.weight = lobe_finite_or_zero(lobe_reflection_weight(ndf, s, wo.z, t_o, r.wi));
	return r;
}

/* The lobe's own results, given its Fresnel reflectance f. */
LOBE_FN lobe_rgb lobe_reflection_tint(lobe_reflection_eval r, lobe_rgb f)
{
	return lobe_rgb_select(r.ok, lobe_rgb_scale(f, r.value));
}

LOBE_FN lobe_sample lobe_reflection_tint_sample(lobe_reflection_sample r, lobe_rgb f)
{
	return lobe_sample_select(r.pdf > LOBE_R(0.0), r.wi, lobe_rgb_scale(f, r.weight), r.pdf,
				  LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY);
}

#endif
