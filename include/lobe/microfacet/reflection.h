/* reflection.h - a rough mirror: all of an opaque microfacet lobe but its Fresnel term.
 *
 * Cook and Torrance 1982 with the height-correlated masking and shadowing of Heitz 2014 (eq. 99) and visible-normal
 * sampling (Heitz and d'Eon 2014; for GGX by spherical caps, Dupuy and Benyoub 2023, of which the part that reflects
 * below the horizon is mostly left out, Eto and Tokuyoshi 2023):
 *	f = F D G2/(4 z_o z_i),   pdf = D/(4 area),   weight = F G2 area/z_o = 2 F z_i area/(z_i t_o + z_o t_i)
 * area being sigma(wo), of which GGX leaves (t + k z)/2. 0 when either direction is at or below the surface. Everything is written with the unnormalised half vector
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

/* Both directions above the surface and every parameter a number. */
LOBE_FN int lobe_reflection_ok(lobe_real params, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_is_number(params) & (lobe_min(wo.z, wi.z) > LOBE_R(0.0));
}

LOBE_FN lobe_real lobe_reflection_t(lobe_uint ndf, lobe_stretch s, lobe_vec3 w)
{
	return lobe_ndf_t(ndf, lobe_stretch_direction(s, w));
}

/* o.m of the facet between the two, from h2 = |wo + wi|^2, which is 4 times its square and which rounding can carry
 * above 4. */
LOBE_FN lobe_real lobe_reflection_cosine(lobe_real h2) { return lobe_min(LOBE_R(0.5) * lobe_sqrt(h2), LOBE_R(1.0)); }

/* The squares of H = wo + wi. */
LOBE_FN lobe_vec3 lobe_reflection_half(lobe_vec3 wo, lobe_vec3 wi) { return lobe_vec3_squares(lobe_vec3_add(wo, wi)); }

/* x y D(h)/(2 s^2) [1/sr]; h: those squares. x and y over s are near 1 where s is small. NaN for H = 0. */
LOBE_FN lobe_real lobe_reflection_density(lobe_uint ndf, lobe_stretch stretch, lobe_vec3 h, lobe_real s, lobe_real x,
					  lobe_real y)
{
	const lobe_facet_density d = lobe_ndf_density_over(ndf, lobe_stretch_facet_squares(stretch, h), s);
	const lobe_real root = lobe_vec3_sum(h) * d.inv;
	return (LOBE_R(0.5) * stretch.norm) * (x * root) * (y * root) * d.factor;
}

/* f |cos theta_i|/F [1/sr], and |H|^2 for Fresnel. ok: else the lobe is 0. */
typedef struct {
	lobe_real value;
	lobe_real h2;
	int ok;
} lobe_reflection_eval;

LOBE_FN lobe_reflection_eval lobe_reflection_eval_at(lobe_uint ndf, lobe_stretch s, lobe_real params, lobe_vec3 wo,
						     lobe_vec3 wi)
{
	const lobe_vec3 h = lobe_reflection_half(wo, wi);
	const lobe_real t_o = lobe_reflection_t(ndf, s, wo);
	lobe_reflection_eval r;
	const lobe_real sum = lobe_smith_sum(wo.z, t_o, wi.z, lobe_reflection_t(ndf, s, wi));
	r.h2 = lobe_vec3_sum(h);
	r.value = lobe_reflection_density(ndf, s, h, sum, wi.z, sum);
	r.ok = lobe_reflection_ok(params, wo, wi);
	return r;
}

/* [1/sr] */
LOBE_FN lobe_real lobe_reflection_pdf(lobe_uint ndf, lobe_stretch s, lobe_real params, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_facet_bound b = lobe_ndf_bound(ndf, lobe_stretch_narrow2(s), wo);
	const lobe_real area = lobe_facet_bound_sum(b, wo.z, lobe_reflection_t(ndf, s, wo));
	const lobe_real pdf = lobe_reflection_density(ndf, s, lobe_reflection_half(wo, wi), area, b.whole, area);
	const int ok = lobe_reflection_ok(params, wo, wi) & (pdf <= LOBE_REAL_MAX);
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
	const lobe_facet_bound b = lobe_ndf_bound(ndf, lobe_stretch_narrow2(s), wo);
	const lobe_real area = lobe_facet_bound_sum(b, wo.z, t_o);
	const lobe_vec3 m = lobe_stretch_normal(s, lobe_ndf_visible_bounded(ndf, v, t_o, b, lobe_vec2_make(u.x, u.y)));
	lobe_reflection_sample r;
	r.wi = lobe_reflect(wo, m, lobe_dot(wo, m) / lobe_dot(m, m));
	r.pdf = lobe_reflection_pdf(ndf, s, params, wo, r.wi);
	r.h2 = lobe_vec3_sum(lobe_reflection_half(wo, r.wi));
	const lobe_real sum = lobe_smith_sum(wo.z, t_o, r.wi.z, lobe_reflection_t(ndf, s, r.wi));
	r.weight = lobe_finite_or_zero((r.wi.z * area) / (b.whole * sum));
	return r;
}

/* The lobe's own results, given what its Fresnel term makes of value or weight. */
LOBE_FN lobe_rgb lobe_reflection_eval_result(lobe_reflection_eval r, lobe_rgb f)
{
	return lobe_rgb_select(r.ok & (r.value <= LOBE_REAL_MAX), f);
}

LOBE_FN lobe_sample lobe_reflection_sample_result(lobe_reflection_sample r, lobe_rgb weight)
{
	return lobe_sample_select(r.pdf > LOBE_R(0.0), r.wi, weight, r.pdf, LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY);
}

/* Or given its reflectance f. */
LOBE_FN lobe_rgb lobe_reflection_tint(lobe_reflection_eval r, lobe_rgb f)
{
	return lobe_reflection_eval_result(r, lobe_rgb_scale(f, r.value));
}

LOBE_FN lobe_sample lobe_reflection_tint_sample(lobe_reflection_sample r, lobe_rgb f)
{
	return lobe_reflection_sample_result(r, lobe_rgb_scale(f, r.weight));
}

#endif
