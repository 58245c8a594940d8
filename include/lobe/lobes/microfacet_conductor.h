/* microfacet_conductor.h - a rough mirror of which everything is chosen at run time: distribution, linear map, masking,
 * Fresnel term, sampling strategy. To compare models with, not for speed: what has settled is better served by
 * ggx_conductor and its like.
 *
 * Cook and Torrance 1982 as Heitz 2014 has it: f = F D G2/(4 z_o z_i). Opaque: 0 when either direction is at or below
 * the surface. Reciprocal where the map has no shear; with one, directions are masked as the tilted mean plane sees
 * them (microfacet/masking.h). With Smith's or the V-cavities' masking no energy is gained; the other maskings do not
 * care.
 *
 *	lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), map);
 *	s = lobe_microsurface_joint(s, LOBE_JOINT_SEPARABLE, LOBE_ACROSS_SEPARABLE);
 *	p = lobe_microfacet_conductor_make(s, lobe_fresnel_model_conductor(eta, k), LOBE_STRATEGY_BOUNDED_CAP); */
#ifndef LOBE_LOBES_MICROFACET_CONDUCTOR_H
#define LOBE_LOBES_MICROFACET_CONDUCTOR_H

#include "../core/event.h"
#include "../core/fresnel_model.h"
#include "../microfacet/scatter.h"

/* strategy: LOBE_STRATEGY_*. */
typedef struct {
	lobe_microsurface surface;
	lobe_fresnel_model fresnel;
	lobe_uint strategy;
} lobe_microfacet_conductor;

LOBE_FN lobe_microfacet_conductor lobe_microfacet_conductor_make(lobe_microsurface surface, lobe_fresnel_model fresnel,
								 lobe_uint strategy)
{
	lobe_microfacet_conductor p;
	p.surface = surface;
	p.fresnel = fresnel;
	p.strategy = strategy;
	return p;
}

LOBE_FN int lobe_microfacet_conductor_ok(lobe_microfacet_conductor p, lobe_vec3 wo, lobe_vec3 wi, lobe_real facing)
{
	const lobe_real params = lobe_microsurface_params(p.surface) + lobe_fresnel_model_params(p.fresnel);
	return lobe_is_number(params) & (lobe_min(lobe_min(wo.z, wi.z), facing) > LOBE_R(0.0));
}

/* f |cos theta_i| [1/sr] */
LOBE_FN_APART lobe_rgb lobe_microfacet_conductor_eval(lobe_microfacet_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_uint strategy = LOBE_CHOSEN(p.strategy, LOBE_ONLY_STRATEGY);
	const lobe_scatter r = lobe_scatter_at(p.surface, strategy, wo, wi, LOBE_R(1.0), 0);
	const lobe_rgb f = lobe_fresnel_model_opaque(p.fresnel, r.cosine);
	const int ok = lobe_microfacet_conductor_ok(p, wo, wi, r.facing);
	return lobe_rgb_select(ok, lobe_rgb_finite_or_zero(lobe_rgb_scale(f, r.density * r.g2_over_cos)));
}

/* [1/sr] */
LOBE_FN_APART lobe_real lobe_microfacet_conductor_pdf(lobe_microfacet_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_uint strategy = LOBE_CHOSEN(p.strategy, LOBE_ONLY_STRATEGY);
	const lobe_scatter r = lobe_scatter_at(p.surface, strategy, wo, wi, LOBE_R(1.0), 0);
	const int ok = lobe_microfacet_conductor_ok(p, wo, wi, r.facing);
	return ok ? lobe_finite_or_zero(r.sampled) : LOBE_R(0.0);
}

/* Uses u.x and u.y, and with LOBE_STRATEGY_VCAVITY u.z. No sample when the facet is hidden or reflects below the
 * surface.
 */
LOBE_FN_APART lobe_sample lobe_microfacet_conductor_sample(lobe_microfacet_conductor p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_uint strategy = LOBE_CHOSEN(p.strategy, LOBE_ONLY_STRATEGY);
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	lobe_vec3 wi;
	if (lobe_strategy_of_directions(strategy)) {
		wi = lobe_strategy_direction(strategy, 0, u);
	} else {
		const lobe_seen o = lobe_see(p.surface, wo, one);
		const lobe_strategy_facet f = lobe_strategy_sample(strategy, p.surface, o, wo, 0, u);
		const lobe_vec3 m = lobe_linear_normal(p.surface.map, f.m);
		wi = lobe_reflect(wo, m, lobe_dot(wo, m) / lobe_dot(m, m));
	}
	const lobe_scatter r = lobe_scatter_at(p.surface, strategy, wo, wi, one, 0);
	const lobe_rgb f = lobe_fresnel_model_opaque(p.fresnel, r.cosine);
	const int ok = lobe_microfacet_conductor_ok(p, wo, wi, r.facing);
	const lobe_real pdf = ok ? lobe_finite_or_zero(r.sampled) : zero;
	const int there = (pdf > zero) & lobe_vec3_is_number(wi);
	return lobe_sample_select(there, wi, lobe_rgb_finite_or_zero(lobe_rgb_scale(f, r.gain)), pdf,
				  LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY);
}

#endif
