/* microfacet_diffuse.h - a rough surface of ideal diffuse facets, of which everything is chosen at run time:
 * distribution, linear map, masking (microfacet/microsurface.h).
 *
 * Heitz 2014, eq. 31, for facets with the BRDF reflectance/pi: there is no half vector, and every facet that both
 * directions see has its part,
 *	f(o, i) cos theta_i = reflectance/pi int D(m) max(0, o.m) max(0, i.m) G2(o, i, m)/z_o dm
 *			    = reflectance/pi E[sigma(o) max(0, i.m) G2(o, i, m)/z_o],   m visible from o.
 * Oren and Nayar 1994 fitted this integral for V-cavities of normally distributed slopes. It has no closed form:
 *
 *	lobe_microfacet_diffuse_eval_one	the bracket at one visible normal: unbiased, for Monte Carlo
 *	lobe_microfacet_diffuse_eval		its mean over LOBE_DIFFUSE_FACETS normals, always the same ones, so that eval is a
 *						function of the directions; what that is off by is stated there
 *
 * Sampled with density cos/pi. Opaque, single scattering. For comparison, not for speed. */
#ifndef LOBE_LOBES_MICROFACET_DIFFUSE_H
#define LOBE_LOBES_MICROFACET_DIFFUSE_H

#include "../core/event.h"
#include "../core/warp.h"
#include "../microfacet/masking.h"

/* Points of a Fibonacci lattice, and the number before it in that sequence. */
#define LOBE_DIFFUSE_FACETS   55u
#define LOBE_DIFFUSE_FACETS_1 34u

/* reflectance: albedo of a facet, each channel in [0, 1]. */
typedef struct {
	lobe_microsurface surface;
	lobe_rgb reflectance;
} lobe_microfacet_diffuse;

LOBE_FN lobe_microfacet_diffuse lobe_microfacet_diffuse_make(lobe_microsurface surface, lobe_rgb reflectance)
{
	lobe_microfacet_diffuse p;
	p.surface = surface;
	p.reflectance = reflectance;
	return p;
}

/* Both directions above the surface, every parameter a number. */
LOBE_FN int lobe_microfacet_diffuse_ok(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_real params =
		lobe_microsurface_params(p.surface) + p.reflectance.r + p.reflectance.g + p.reflectance.b;
	return lobe_is_number(params) & (lobe_min(wo.z, wi.z) > LOBE_R(0.0));
}

/* (i.m)/pi G2/z_o of a facet that faces both directions, or 0. */
LOBE_FN_APART lobe_real lobe_microfacet_diffuse_facet(lobe_microsurface s, lobe_seen o, lobe_seen i, lobe_seen_facet m)
{
	const lobe_real f = LOBE_INV_PI * (m.i / lobe_sqrt(m.length2)) * lobe_masking_g2_over_cos(s, o, i, m, 0);
	return lobe_min(m.o, m.i) > LOBE_R(0.0) ? f : LOBE_R(0.0);
}

/* The facet of u that is visible from a direction which sees v, as wo and wi see it. */
LOBE_FN_APART lobe_seen_facet lobe_microfacet_diffuse_visible(lobe_microsurface s, lobe_vec3 v, lobe_vec3 wo,
							      lobe_vec3 wi, lobe_vec2 u)
{
	const lobe_vec3 h = lobe_linear_normal(s.map, lobe_distribution_visible(s.distribution, v, u));
	return lobe_seen_facet_make(wo, wi, h);
}

/* f |cos theta_i| [1/sr], unbiased: its mean over u.x and u.y, uniform in [0,1), is the integral above. */
LOBE_FN lobe_rgb lobe_microfacet_diffuse_eval_one(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi, lobe_vec2 u)
{
	const lobe_seen o = lobe_see(p.surface, wo, LOBE_R(1.0));
	const lobe_seen i = lobe_see(p.surface, wi, LOBE_R(1.0));
	const lobe_seen_facet m = lobe_microfacet_diffuse_visible(p.surface, o.v, wo, wi, u);
	const lobe_real f = lobe_finite_or_zero(o.sigma * lobe_microfacet_diffuse_facet(p.surface, o, i, m));
	return lobe_rgb_select(lobe_microfacet_diffuse_ok(p, wo, wi), lobe_rgb_scale(p.reflectance, f));
}

/* The same integral by one of two facets, weighted as Veach's balance heuristic would: facets come with densities
 * D (o.m)/sigma_o and D (i.m)/sigma_i, so that (o.m)/(their sum) is left, which is symmetric. */
LOBE_FN lobe_real lobe_microfacet_diffuse_balanced(lobe_microsurface s, lobe_seen o, lobe_seen i, lobe_seen_facet m)
{
	const lobe_real sum = lobe_fma(m.o, i.sigma, m.i * o.sigma);
	const lobe_real f = m.o * o.sigma * (i.sigma / sum) * lobe_microfacet_diffuse_facet(s, o, i, m);
	return lobe_min(m.o, m.i) > LOBE_R(0.0) ? f : LOBE_R(0.0);
}

/* f |cos theta_i| [1/sr], by LOBE_DIFFUSE_FACETS facets visible from wo and as many from wi. Of what the smooth surface
 * would have, reflectance/pi cos theta_i, it is off by up to .023 for widths from .1 and angles up to 86 degrees. Where
 * both directions graze a smoother surface, 3 degrees and less above one of width .02 to .1, by up to .26, which is a
 * tenth of the value there (tests/test_microfacet_diffuse.c). Reciprocal where the masking is. */
LOBE_FN lobe_rgb lobe_microfacet_diffuse_eval(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_real middle = LOBE_R(0.5), scale = LOBE_R(1.0) / (lobe_real)LOBE_DIFFUSE_FACETS;
	lobe_real sum_o = LOBE_R(0.0), sum_i = LOBE_R(0.0);
	if (!lobe_microfacet_diffuse_ok(p, wo, wi))
		return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
	const lobe_seen o = lobe_see(p.surface, wo, LOBE_R(1.0));
	const lobe_seen i = lobe_see(p.surface, wi, LOBE_R(1.0));
	for (lobe_uint k = 0u; k < LOBE_DIFFUSE_FACETS; k++) {
		const lobe_uint across = k * LOBE_DIFFUSE_FACETS_1 % LOBE_DIFFUSE_FACETS;
		const lobe_vec2 u = lobe_vec2_make(((lobe_real)k + middle) * scale, ((lobe_real)across + middle) * scale);
		sum_o += lobe_microfacet_diffuse_balanced(
			p.surface, o, i, lobe_microfacet_diffuse_visible(p.surface, o.v, wo, wi, u));
		sum_i += lobe_microfacet_diffuse_balanced(
			p.surface, o, i, lobe_microfacet_diffuse_visible(p.surface, i.v, wo, wi, u));
	}
	return lobe_rgb_scale(p.reflectance, lobe_finite_or_zero((sum_o + sum_i) * scale));
}

/* [1/sr] */
LOBE_FN lobe_real lobe_microfacet_diffuse_pdf(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_real pdf = lobe_finite_or_zero(lobe_cosine_hemisphere_pdf(wi));
	return lobe_microfacet_diffuse_ok(p, wo, wi) ? pdf : LOBE_R(0.0);
}

/* Uses u.x and u.y. weight is that of eval. */
LOBE_FN lobe_sample lobe_microfacet_diffuse_sample(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_vec3 wi = lobe_cosine_hemisphere(lobe_vec2_make(u.x, u.y));
	const lobe_real pdf = lobe_microfacet_diffuse_pdf(p, wo, wi);
	const lobe_rgb f = lobe_microfacet_diffuse_eval(p, wo, wi);
	const lobe_rgb weight = lobe_rgb_finite_or_zero(lobe_rgb_scale(f, LOBE_R(1.0) / pdf));
	const int ok = (pdf > LOBE_R(0.0)) & lobe_vec3_is_number(wi);
	return lobe_sample_select(ok, wi, weight, pdf, LOBE_EVENT_REFLECT | LOBE_EVENT_DIFFUSE);
}

#endif
