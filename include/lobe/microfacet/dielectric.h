/* dielectric.h - rough glass: reflection and refraction by a microsurface, from both sides. The body of <ndf>_dielectric.
 *
 * Walter et al. 2007, "Microfacet models for refraction through rough surfaces", with visible-normal sampling (Heitz and
 * d'Eon 2014; Dupuy and Benyoub 2023): a visible facet m, then reflection with probability F(o.m), else refraction.
 *
 * Joint masking: height-correlated on one side (Heitz 2014 eq. 99). Across the surface G1(o) G1(i), as Walter: the exact
 * value for Smith's uncorrelated heights is Beta(1 + Lambda_o, 1 + Lambda_i), to which the product is nearer than the
 * 1/(1 + Lambda_o + Lambda_i) of one side; tests/test_lobes_energy.c measures the distance. Single scattering: what would
 * hit the microsurface again is lost.
 *
 * Near eta = 1. A facet turns light by about |eta - 1|, so refracted light spreads over alpha |eta - 1|. Where that is
 * below LOBE_DIELECTRIC_DELTA, 32 roundings of a unit vector, no float direction can resolve the lobe: refraction is
 * then an event of LOBE_EVENT_DELTA, still through the sampled facet, and is not masked: at eta = 1 light passes
 * straight with weight 1 and nothing is reflected. The price is a step where that begins, up to G1(wo), which
 * tests/test_lobes_index.c prints: this close to 1 the model's masking is loss that only multiple scattering would
 * return. */
#ifndef LOBE_MICROFACET_DIELECTRIC_H
#define LOBE_MICROFACET_DIELECTRIC_H

#include "../core/event.h"
#include "../core/fresnel.h"
#include "delta.h"
#include "ndf.h"
#include "stretch.h"

/* ndf: LOBE_NDF_*, a constant. stretch: widths along tangent and bitangent. eta: index below over index above the surface, in [1/1000, 1000]; inv_eta is
 * 1/eta. transport: LOBE_TRANSPORT_*. delta: refraction is a delta event. */
typedef struct {
	lobe_stretch stretch;
	lobe_real eta, inv_eta;
	lobe_uint transport, delta;
} lobe_rough_dielectric;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. Carries radiance; see lobe_rough_dielectric_transport. */
LOBE_FN lobe_rough_dielectric lobe_rough_dielectric_make(lobe_real alpha_x, lobe_real alpha_y, lobe_real eta)
{
	lobe_rough_dielectric p;
	p.stretch = lobe_stretch_make(alpha_x, alpha_y);
	p.eta = eta;
	p.inv_eta = LOBE_R(1.0) / eta + (eta - eta); /* NaN for an infinite eta, not 0 */
	p.transport = LOBE_TRANSPORT_RADIANCE;
	p.delta = (lobe_uint)lobe_dielectric_is_delta(lobe_max(p.stretch.alpha_x, p.stretch.alpha_y), eta);
	return p;
}

/* The same surface for LOBE_TRANSPORT_RADIANCE or LOBE_TRANSPORT_IMPORTANCE (core/event.h). */
LOBE_FN lobe_rough_dielectric lobe_rough_dielectric_transport(lobe_rough_dielectric p, lobe_uint transport)
{
	p.transport = transport;
	return p;
}

LOBE_FN lobe_real lobe_rough_dielectric_t(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 w)
{
	return lobe_ndf_t(ndf, lobe_stretch_direction(p.stretch, w));
}

/* The interface seen from wo's side, with wo above: e is the far index over the near one. */
typedef struct {
	lobe_vec3 o;
	lobe_real e, inv_e, t_o, scale;
} lobe_rough_dielectric_view;

LOBE_FN lobe_rough_dielectric_view lobe_rough_dielectric_view_make(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo)
{
	const int above = wo.z > LOBE_R(0.0);
	lobe_rough_dielectric_view v;
	v.o = lobe_vec3_make(wo.x, wo.y, lobe_abs(wo.z));
	v.e = above ? p.eta : p.inv_eta;
	v.inv_e = above ? p.inv_eta : p.eta;
	v.t_o = lobe_rough_dielectric_t(ndf, p, wo);
	v.scale = p.transport == LOBE_TRANSPORT_RADIANCE ? v.inv_e * v.inv_e : LOBE_R(1.0);
	return v;
}

/* The facet that takes o to i. c: o.m, at most 1, for Fresnel. density: its density dm/di D(m) o.m [1/sr], times
 * sigma(o). Both events are one formula in the unnormalised half vector H = o + e_r i, e_r = 1 for reflection:
 *	D(m) o.m |dm/di| = norm e_r^2 |o.H| |i.H| D1(H)
 * in which every power of |H| has cancelled (D1: lobe_ndf_density of the facet). facing > 0 where there is such a facet: both directions see its front, or
 * for a refraction one its front and one its back. (A number, as compilers make more of a minimum than of a chain of
 * truth values.) */
typedef struct {
	lobe_real c, density, facing;
	int reflects;
} lobe_rough_dielectric_facet;

LOBE_FN lobe_rough_dielectric_facet lobe_rough_dielectric_facet_make(lobe_uint ndf, lobe_rough_dielectric p,
								     lobe_rough_dielectric_view v, lobe_vec3 i)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const int reflects = i.z > zero;
	const lobe_real e_r = reflects ? one : v.e;
	const lobe_vec3 h = lobe_vec3_fma(e_r, i, v.o);
	const lobe_real h2 = lobe_dot(h, h);
	const lobe_real up = h.z < zero ? -one : one;
	const lobe_real oh = reflects ? LOBE_R(0.5) * h2 : up * lobe_dot(v.o, h);
	const lobe_real ih = reflects ? LOBE_R(0.5) * h2 : up * lobe_dot(i, h);
	const lobe_facet_density d = lobe_ndf_density_over(ndf, lobe_stretch_facet(p.stretch, h), LOBE_R(1.0));
	const lobe_real x = e_r * d.inv;
	const lobe_real refracts = lobe_min(lobe_min(oh, -ih), -i.z);
	const lobe_real refracts_to_density = p.delta == 0u ? refracts : zero;
	const lobe_real sees = reflects ? i.z : refracts_to_density;
	lobe_rough_dielectric_facet f;
	f.reflects = reflects;
	f.facing = lobe_min(v.o.z, sees);
	f.c = lobe_min(oh / lobe_sqrt(h2), one);
	f.density = p.stretch.norm * (oh * x) * (lobe_abs(ih) * x) * d.factor;
	return f;
}

/* F or 1 - F, by the event. */
LOBE_FN lobe_real lobe_rough_dielectric_prob(lobe_rough_dielectric_facet m, lobe_fresnel fr)
{
	return m.reflects ? fr.reflectance : fr.transmittance;
}

/* i as v sees it. */
LOBE_FN lobe_vec3 lobe_rough_dielectric_flip(lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_vec3_make(wi.x, wi.y, wo.z > LOBE_R(0.0) ? wi.z : -wi.z);
}

/* G2/z_o: height-correlated for a reflection, G1(o) G1(i) for a refraction, by one division. */
LOBE_FN lobe_real lobe_rough_dielectric_g2_over_cos(lobe_uint ndf, lobe_rough_dielectric p,
						    lobe_rough_dielectric_view v, lobe_vec3 i, int reflects)
{
	const lobe_real z_i = lobe_abs(i.z);
	const lobe_real t_i = lobe_rough_dielectric_t(ndf, p, i);
	const lobe_real num = reflects ? z_i + z_i : LOBE_R(4.0) * z_i;
	const lobe_real den = reflects ? lobe_fma(z_i, v.t_o, v.o.z * t_i) : (z_i + t_i) * (v.o.z + v.t_o);
	return num / den;
}

/* x, which is >= 0 where m is a facet, or 0 where it is none or x is no finite number. */
LOBE_FN lobe_real lobe_rough_dielectric_keep(lobe_rough_dielectric_facet m, lobe_real x)
{
	const lobe_real there = m.facing > LOBE_R(0.0) ? x : LOBE_R(0.0);
	return lobe_abs(there) <= LOBE_REAL_MAX ? there : LOBE_R(0.0);
}

/* f |cos theta_i| [1/sr] of a facet of which the share prob is reflected or refracted. */
LOBE_FN lobe_real lobe_rough_dielectric_eval_at(lobe_rough_dielectric_view v, lobe_rough_dielectric_facet m,
						lobe_real prob, lobe_real g2_over_cos)
{
	const lobe_real scale = m.reflects ? LOBE_R(1.0) : v.scale;
	return lobe_rough_dielectric_keep(m, prob * scale * m.density * g2_over_cos);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_rough_dielectric_eval(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p, wo);
	const lobe_vec3 i = lobe_rough_dielectric_flip(wo, wi);
	const lobe_rough_dielectric_facet m = lobe_rough_dielectric_facet_make(ndf, p, v, i);
	const lobe_real prob = lobe_rough_dielectric_prob(m, lobe_fresnel_dielectric(m.c, v.e));
	const lobe_real g = lobe_rough_dielectric_g2_over_cos(ndf, p, v, i, m.reflects);
	const lobe_real kept = lobe_rough_dielectric_eval_at(v, m, prob, g);
	return lobe_rgb_make(kept, kept, kept);
}

/* [1/sr], the event being chosen with probability prob. */
LOBE_FN lobe_real lobe_rough_dielectric_pdf_at(lobe_rough_dielectric_view v, lobe_rough_dielectric_facet m,
					       lobe_real prob)
{
	const lobe_real two_sigma = v.o.z + v.t_o;
	const lobe_real pdf = prob * (m.density + m.density) / two_sigma;
	return lobe_rough_dielectric_keep(m, pdf);
}

/* [1/sr] */
LOBE_FN lobe_real lobe_rough_dielectric_pdf(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p, wo);
	const lobe_rough_dielectric_facet m =
		lobe_rough_dielectric_facet_make(ndf, p, v, lobe_rough_dielectric_flip(wo, wi));
	return lobe_rough_dielectric_pdf_at(v, m, lobe_rough_dielectric_prob(m, lobe_fresnel_dielectric(m.c, v.e)));
}

/* The facet that a sample leaves by: a visible one, its cosine, and what it does to light. */
typedef struct {
	lobe_vec3 m;
	lobe_real c;
	lobe_fresnel fr;
} lobe_rough_dielectric_choice;

LOBE_FN lobe_rough_dielectric_choice lobe_rough_dielectric_choose(lobe_uint ndf, lobe_rough_dielectric p,
								  lobe_rough_dielectric_view v, lobe_vec3 u)
{
	const lobe_vec3 facet =
		lobe_ndf_visible_above(ndf, lobe_stretch_direction(p.stretch, v.o), v.t_o, lobe_vec2_make(u.x, u.y));
	lobe_rough_dielectric_choice s;
	s.m = lobe_normalize(lobe_stretch_normal(p.stretch, facet));
	s.c = lobe_min(lobe_dot(v.o, s.m), LOBE_R(1.0));
	s.fr = lobe_fresnel_dielectric(s.c, v.e);
	return s;
}

/* Where the light goes, with wo above. right_side > 0 where that is a sample. */
typedef struct {
	lobe_vec3 i;
	lobe_real right_side;
} lobe_rough_dielectric_exit;

LOBE_FN lobe_rough_dielectric_exit lobe_rough_dielectric_leave(lobe_rough_dielectric_view v,
							       lobe_rough_dielectric_choice s, int reflects)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_vec3 mirrored = lobe_reflect(v.o, s.m, s.c);
	const lobe_vec3 bent = lobe_refract(v.o, s.m, v.inv_e, s.fr);
	/* Towards the thinner side the rounding of c grows by 1/e^2; else bent is unit, and at e = 1 it is -o. */
	const lobe_real inv_length = one / lobe_sqrt(lobe_dot(bent, bent));
	const lobe_real to_unit = v.e < one ? inv_length : one;
	const lobe_vec3 refracted = lobe_vec3_scale(bent, to_unit);
	lobe_rough_dielectric_exit x;
	x.i = lobe_vec3_make(reflects ? mirrored.x : refracted.x, reflects ? mirrored.y : refracted.y,
			     reflects ? mirrored.z : refracted.z);
	/* Rounding can turn a facet away from wo where the cap's rim meets its opposite: c <= 0. */
	const lobe_real outwards = reflects ? x.i.z : -x.i.z;
	x.right_side = lobe_min(lobe_min(v.o.z, s.c), outwards);
	return x;
}

/* The weight of a sample whose event has probability F or 1 - F. */
LOBE_FN lobe_real lobe_rough_dielectric_weight(lobe_uint ndf, lobe_rough_dielectric p, lobe_rough_dielectric_view v,
					       lobe_vec3 i, int reflects)
{
	const lobe_real two_sigma = v.o.z + v.t_o;
	const lobe_real masked = LOBE_R(0.5) * two_sigma * lobe_rough_dielectric_g2_over_cos(ndf, p, v, i, reflects);
	const lobe_real refracts_weight = v.scale * (p.delta != 0u ? LOBE_R(1.0) : masked);
	return lobe_finite_or_zero(reflects ? masked : refracts_weight);
}

LOBE_FN lobe_uint lobe_rough_dielectric_event(lobe_rough_dielectric p, int reflects)
{
	const lobe_uint refracts =
		p.delta != 0u ? LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA : LOBE_EVENT_TRANSMIT | LOBE_EVENT_GLOSSY;
	return reflects ? LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY : refracts;
}

/* Uses u.x and u.y for the facet and u.z to choose between reflection and refraction. No sample when the facet sends the
 * light to the wrong side of the surface. With LOBE_EVENT_DELTA pdf is 1 - F of the sampled facet. */
LOBE_FN lobe_sample lobe_rough_dielectric_sample(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p, wo);
	const lobe_rough_dielectric_choice s = lobe_rough_dielectric_choose(ndf, p, v, u);
	const int reflects = u.z < s.fr.reflectance;
	const lobe_rough_dielectric_exit x = lobe_rough_dielectric_leave(v, s, reflects);
	const lobe_vec3 wi = lobe_rough_dielectric_flip(wo, x.i);
	const lobe_real density = lobe_rough_dielectric_pdf(ndf, p, wo, wi);
	const lobe_real refracts_pdf = p.delta != 0u ? s.fr.transmittance : density;
	const lobe_real pdf = reflects ? density : refracts_pdf;
	const lobe_real w = lobe_rough_dielectric_weight(ndf, p, v, x.i, reflects);
	return lobe_sample_select(lobe_min(x.right_side, pdf) > LOBE_R(0.0), wi, lobe_rgb_make(w, w, w), pdf,
				  lobe_rough_dielectric_event(p, reflects));
}

#endif
