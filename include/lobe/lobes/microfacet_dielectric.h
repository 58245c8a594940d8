/* microfacet_dielectric.h - rough glass of which everything is chosen at run time: distribution, linear map, masking,
 * Fresnel term, sampling strategy. To compare models with, not for speed: what has settled is better served by
 * ggx_dielectric and its like.
 *
 * Walter et al. 2007. From both sides: from below all is seen through the point: wo and wi are turned round, the facets
 * stay, the indices change places. Reciprocal (with the square of the index) where the map has no shear.
 *
 * Facets are sampled, then reflect with probability F (the mean of its colours), or refract. UNIFORM and COSINE choose
 * a direction on either side; where no facet can take the light there is no sample and pdf is 0. BOUNDED_CAP is
 * VISIBLE_CAP here, since refraction needs the facets that the bound leaves out.
 *
 * Where refraction is too narrow for float directions (microfacet/delta.h) it is an event of
 * LOBE_EVENT_DELTA and strategies of directions, which would never find it, become VISIBLE. */
#ifndef LOBE_LOBES_MICROFACET_DIELECTRIC_H
#define LOBE_LOBES_MICROFACET_DIELECTRIC_H

#include "../core/event.h"
#include "../core/fresnel_model.h"
#include "../microfacet/delta.h"
#include "../microfacet/scatter.h"

/* strategy: LOBE_STRATEGY_*. eta: index below over index above the surface, in [1/1000, 1000]; inv_eta is 1/eta.
 * transport: LOBE_TRANSPORT_*. delta: refraction is a delta event. */
typedef struct {
	lobe_microsurface surface;
	lobe_fresnel_model fresnel;
	lobe_real eta, inv_eta;
	lobe_uint strategy, transport, delta;
} lobe_microfacet_dielectric;

/* Carries radiance; see lobe_microfacet_dielectric_transport. */
LOBE_FN lobe_microfacet_dielectric lobe_microfacet_dielectric_make(lobe_microsurface surface,
								   lobe_fresnel_model fresnel, lobe_real eta,
								   lobe_uint strategy)
{
	lobe_microfacet_dielectric p;
	p.surface = surface;
	p.fresnel = fresnel;
	p.eta = eta;
	p.inv_eta = LOBE_R(1.0) / eta + (eta - eta); /* NaN for an infinite eta, not 0 */
	p.transport = LOBE_TRANSPORT_RADIANCE;
	p.delta = (lobe_uint)lobe_dielectric_is_delta(lobe_microsurface_wide(surface), eta);
	p.strategy = p.delta && lobe_strategy_of_directions(strategy) ? (lobe_uint)LOBE_STRATEGY_VISIBLE : strategy;
	return p;
}

/* The same surface for LOBE_TRANSPORT_RADIANCE or LOBE_TRANSPORT_IMPORTANCE (core/event.h). */
LOBE_FN lobe_microfacet_dielectric lobe_microfacet_dielectric_transport(lobe_microfacet_dielectric p,
									lobe_uint transport)
{
	p.transport = transport;
	return p;
}

/* Every parameter is a number. */
LOBE_FN int lobe_microfacet_dielectric_params(lobe_microfacet_dielectric p)
{
	return lobe_is_number(lobe_microsurface_params(p.surface) + lobe_fresnel_model_params(p.fresnel) + p.eta +
			      p.inv_eta);
}

/* From wo's side: side is 1 or -1, e the far index over the near one, scale that of transmitted light. */
typedef struct {
	lobe_vec3 o;
	lobe_real side, e, inv_e, scale;
} lobe_microfacet_dielectric_view;

LOBE_FN lobe_microfacet_dielectric_view lobe_microfacet_dielectric_view_make(lobe_microfacet_dielectric p, lobe_vec3 wo)
{
	const int above = wo.z > LOBE_R(0.0);
	lobe_microfacet_dielectric_view v;
	v.side = above ? LOBE_R(1.0) : LOBE_R(-1.0);
	v.o = lobe_vec3_scale(wo, v.side);
	v.e = above ? p.eta : p.inv_eta;
	v.inv_e = above ? p.inv_eta : p.eta;
	v.scale = p.transport == LOBE_TRANSPORT_RADIANCE ? v.inv_e * v.inv_e : LOBE_R(1.0);
	return v;
}

/* The share of light and of samples that goes from v.o to i, as this lobe has it. */
typedef struct {
	lobe_rgb f, weight;
	lobe_real pdf;
} lobe_microfacet_dielectric_result;

LOBE_FN_APART lobe_microfacet_dielectric_result lobe_microfacet_dielectric_at(lobe_microfacet_dielectric p,
									      lobe_microfacet_dielectric_view v,
									      lobe_vec3 i)
{
	const lobe_uint strategy = LOBE_CHOSEN(p.strategy, LOBE_ONLY_STRATEGY);
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_scatter r = lobe_scatter_at(p.surface, strategy, v.o, i, v.e, 1);
	const int reflects = i.z > zero;
	const lobe_fresnel_interface by_cosine = lobe_fresnel_interface_unit(r.cosine, r.sine2, v.e);
	const lobe_fresnel_interface across = lobe_fresnel_interface_across(by_cosine, r.sine2, r.cosine_i);
	const lobe_fresnel_split split = lobe_fresnel_model_interface(
		p.fresnel, lobe_fresnel_interface_select(reflects, by_cosine, across));
	const int there = lobe_microfacet_dielectric_params(p) & (r.facing > zero) & (reflects | (p.delta == 0u));
	const lobe_rgb share = reflects ? split.reflectance : split.transmittance;
	const lobe_real scale = reflects ? one : v.scale;
	const lobe_real chosen = lobe_strategy_of_directions(strategy) ? one
				 : reflects                              ? split.reflect
									 : split.transmit;
	const lobe_real inv_chosen = chosen > zero ? one / chosen : zero;
	const lobe_real pdf = lobe_finite_or_zero(chosen * r.sampled);
	lobe_microfacet_dielectric_result result;
	result.f = lobe_rgb_select(there,
				   lobe_rgb_finite_or_zero(lobe_rgb_scale(share, scale * (r.density * r.g2_over_cos))));
	result.weight =
		lobe_rgb_select(there, lobe_rgb_finite_or_zero(lobe_rgb_scale(share, inv_chosen * (scale * r.gain))));
	result.pdf = there ? pdf : zero;
	return result;
}

/* f |cos theta_i| [1/sr] */
LOBE_FN_APART lobe_rgb lobe_microfacet_dielectric_eval(lobe_microfacet_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_microfacet_dielectric_view v = lobe_microfacet_dielectric_view_make(p, wo);
	return lobe_microfacet_dielectric_at(p, v, lobe_vec3_scale(wi, v.side)).f;
}

/* [1/sr] */
LOBE_FN_APART lobe_real lobe_microfacet_dielectric_pdf(lobe_microfacet_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_microfacet_dielectric_view v = lobe_microfacet_dielectric_view_make(p, wo);
	return lobe_microfacet_dielectric_at(p, v, lobe_vec3_scale(wi, v.side)).pdf;
}

/* The sample that passes through facet m (on the surface of width 1) as a delta event; c: o.m. Nothing is masked, as in
 * microfacet/dielectric.h, so that visible facets weigh 1 and all others what makes them so: D |o.m|/sigma over their
 * own density. */
LOBE_FN_APART lobe_sample lobe_microfacet_dielectric_straight(lobe_microfacet_dielectric p,
							      lobe_microfacet_dielectric_view v, lobe_seen o,
							      lobe_vec3 facet, lobe_vec3 m, lobe_real c,
							      lobe_fresnel_split split)
{
	const lobe_uint strategy = LOBE_CHOSEN(p.strategy, LOBE_ONLY_STRATEGY);
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_vec3 bent = lobe_refract(v.o, m, v.inv_e, split.exact);
	const lobe_vec3 i = v.e < one ? lobe_normalize(bent) : bent;
	const lobe_seen_facet seen = lobe_seen_facet_make(o.v, o.v, facet);
	const lobe_real rate = lobe_strategy_rate(strategy, p.surface, o, v.o, 1, seen);
	const lobe_facet_density d = lobe_distribution_density(p.surface.distribution, facet);
	const lobe_real ratio = lobe_strategy_ratio(d, lobe_strategy_density(strategy, p.surface, facet, d));
	const lobe_rgb weight =
		lobe_rgb_scale(split.transmittance, v.scale * ratio * (one / o.sigma / rate) / split.transmit);
	const int numbers = lobe_microfacet_dielectric_params(p) & lobe_vec3_is_number(i);
	const int ok = numbers & (lobe_min(lobe_min(v.o.z, c), lobe_min(-i.z, rate)) > zero);
	return lobe_sample_select(ok & (split.transmit > zero), lobe_vec3_scale(i, v.side),
				  lobe_rgb_finite_or_zero(weight), split.transmit,
				  LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA);
}

/* Uses u.x and u.y for the facet, u.z to choose between reflection and refraction (with LOBE_STRATEGY_VCAVITY between
 * the sides of a cavity first). No sample when the facet is hidden or sends the light to the wrong side of the surface.
 * With LOBE_EVENT_DELTA pdf is the share of samples that the facet transmits. */
LOBE_FN_APART lobe_sample lobe_microfacet_dielectric_sample(lobe_microfacet_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_uint strategy = LOBE_CHOSEN(p.strategy, LOBE_ONLY_STRATEGY);
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_microfacet_dielectric_view v = lobe_microfacet_dielectric_view_make(p, wo);
	lobe_vec3 i;
	if (lobe_strategy_of_directions(strategy)) {
		i = lobe_strategy_direction(strategy, 1, u);
	} else {
		const lobe_seen o = lobe_see(p.surface, v.o, one);
		const lobe_strategy_facet f = lobe_strategy_sample(strategy, p.surface, o, v.o, 1, u);
		const lobe_vec3 m = lobe_normalize(lobe_linear_normal(p.surface.map, f.m));
		const lobe_real c = lobe_min(lobe_dot(v.o, m), one);
		const lobe_real s2 = lobe_sine2(c, v.e, lobe_cross(v.o, m));
		const lobe_fresnel_split split =
			lobe_fresnel_model_interface(p.fresnel, lobe_fresnel_interface_unit(c, s2, v.e));
		const int reflects = f.rest < split.reflect;
		if (!reflects && p.delta != 0u)
			return lobe_microfacet_dielectric_straight(p, v, o, f.m, m, c, split);
		/* Towards the thinner side the rounding of c grows by 1/e^2; else the refracted direction is unit. */
		const lobe_vec3 bent = lobe_refract(v.o, m, v.inv_e, split.exact);
		const lobe_vec3 refracted = v.e < one ? lobe_normalize(bent) : bent;
		i = reflects ? lobe_reflect(v.o, m, c) : refracted;
		/* A facet that turned away, or one that sends light through itself. */
		if (!(lobe_min(c, reflects ? i.z : -i.z) > zero))
			return lobe_sample_none();
	}
	const lobe_microfacet_dielectric_result r = lobe_microfacet_dielectric_at(p, v, i);
	const lobe_uint way = i.z > zero ? LOBE_EVENT_REFLECT : LOBE_EVENT_TRANSMIT;
	const int ok = (r.pdf > zero) & lobe_vec3_is_number(i);
	return lobe_sample_select(ok, lobe_vec3_scale(i, v.side), r.weight, r.pdf, way | LOBE_EVENT_GLOSSY);
}

#endif
