/* iridescent_dielectric.h - rough glass under a thin film: coated lenses, oil on water; with eta = 1 a soap film.
 *
 * The microsurface, both events and both sides are those of microfacet/dielectric.h, with GGX; the share that a facet
 * reflects is that of the film in RGB (core/thin_film.h: Belcour and Barla 2017), and the rest passes, bent by the base
 * alone. Which of the two a sample is, the mean of the share over the channels decides; its weight carries the colour,
 * so one channel of it, but for radiance's scale, can be up to 3 while the mean of the three is at most 1. At thickness
 * 0 it is ggx_dielectric to rounding. A film does not turn light, so with eta = 1 what passes is a delta event,
 * straight on. */
#ifndef LOBE_LOBES_IRIDESCENT_DIELECTRIC_H
#define LOBE_LOBES_IRIDESCENT_DIELECTRIC_H

#include "../core/thin_film.h"
#include "../microfacet/dielectric.h"

/* glass: the surface without its film. film: as seen from the medium of lower index, into which there is no total
 * reflection: thickness [nm] times that index, film's index over it, in [1, 1e6]. */
typedef struct {
	lobe_rough_dielectric glass;
	lobe_film film;
} lobe_iridescent_dielectric;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. thickness: [nm], in [0, 1e6]. film_index and eta: film and inside
 * over the outside, in [1/1000, 1000]; film_index >= min(1, eta), as light would not get across a film that is rarer
 * than both sides. Carries radiance; see lobe_iridescent_dielectric_transport. */
LOBE_FN lobe_iridescent_dielectric lobe_iridescent_dielectric_make(lobe_real alpha_x, lobe_real alpha_y,
								   lobe_real thickness, lobe_real film_index,
								   lobe_real eta)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real thinner = lobe_at_most(eta, one);
	lobe_iridescent_dielectric p;
	p.glass = lobe_rough_dielectric_make(alpha_x, alpha_y, eta);
	p.film = lobe_film_make(thickness * thinner, film_index / thinner);
	return p;
}

/* The same surface for LOBE_TRANSPORT_RADIANCE or LOBE_TRANSPORT_IMPORTANCE (core/event.h). */
LOBE_FN lobe_iridescent_dielectric lobe_iridescent_dielectric_transport(lobe_iridescent_dielectric p,
									lobe_uint transport)
{
	p.glass = lobe_rough_dielectric_transport(p.glass, transport);
	return p;
}

/* What a facet does to light, from its interface without the film. The film is looked at from the thinner medium: at
 * total reflection from within the cosine there is 0, where everything is reflected. */
LOBE_FN lobe_film_fresnel lobe_iridescent_dielectric_film(lobe_iridescent_dielectric p, lobe_rough_dielectric_view v,
							  lobe_fresnel_interface at)
{
	const int inside = v.side.at.eta < LOBE_R(1.0);
	const lobe_real c = (inside ? at.g * v.side.inv_e : at.c) / lobe_sqrt(at.m2);
	return lobe_thin_film_dielectric_rgb(lobe_at_most(c, LOBE_R(1.0)), p.film,
					     inside ? v.side.inv_e : v.side.at.eta);
}

/* The share of an event and its mean. */
typedef struct {
	lobe_rgb rgb;
	lobe_real mean;
} lobe_iridescent_share;

LOBE_FN lobe_iridescent_share lobe_iridescent_share_make(lobe_film_fresnel f, int reflects)
{
	lobe_iridescent_share s;
	s.rgb = lobe_rgb_make(reflects ? f.reflectance.r : f.transmittance.r,
			      reflects ? f.reflectance.g : f.transmittance.g,
			      reflects ? f.reflectance.b : f.transmittance.b);
	s.mean = reflects ? f.mean_reflectance : f.mean_transmittance;
	return s;
}

LOBE_FN lobe_iridescent_share lobe_iridescent_dielectric_share(lobe_iridescent_dielectric p,
							       lobe_rough_dielectric_view v,
							       lobe_rough_dielectric_facet m)
{
	return lobe_iridescent_share_make(lobe_iridescent_dielectric_film(p, v, m.at), m.reflects);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_iridescent_dielectric_eval(lobe_iridescent_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_uint ndf = LOBE_NDF_GGX;
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p.glass, wo);
	const lobe_vec3 i = lobe_rough_dielectric_flip(wo, wi);
	const lobe_rough_dielectric_facet m = lobe_rough_dielectric_facet_of(ndf, p.glass, v, i);
	const lobe_iridescent_share s = lobe_iridescent_dielectric_share(p, v, m);
	const lobe_real weight = lobe_rough_dielectric_weight(ndf, p.glass, v, i, m.reflects);
	return lobe_rgb_make(lobe_rough_dielectric_eval_at(v, m, s.rgb.r, weight),
			     lobe_rough_dielectric_eval_at(v, m, s.rgb.g, weight),
			     lobe_rough_dielectric_eval_at(v, m, s.rgb.b, weight));
}

/* [1/sr] */
LOBE_FN lobe_real lobe_iridescent_dielectric_pdf(lobe_iridescent_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_uint ndf = LOBE_NDF_GGX;
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p.glass, wo);
	const lobe_vec3 i = lobe_rough_dielectric_flip(wo, wi);
	const lobe_rough_dielectric_facet m = lobe_rough_dielectric_facet_of(ndf, p.glass, v, i);
	return lobe_rough_dielectric_pdf_at(v, m, lobe_iridescent_dielectric_share(p, v, m).mean);
}

/* Uses u.x and u.y for the facet and u.z to choose between reflection and refraction. No sample when the facet sends
 * the light to the wrong side of the surface. With LOBE_EVENT_DELTA pdf is the mean transmittance of the sampled
 * facet. */
LOBE_FN lobe_sample lobe_iridescent_dielectric_sample(lobe_iridescent_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_uint ndf = LOBE_NDF_GGX;
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p.glass, wo);
	const lobe_rough_dielectric_choice s = lobe_rough_dielectric_choose(ndf, p.glass, v, u);
	const lobe_film_fresnel f = lobe_iridescent_dielectric_film(p, v, s.at);
	const int reflects = u.z < f.mean_reflectance;
	const lobe_vec3 i = lobe_rough_dielectric_leave(p.glass, v, s, reflects);
	const lobe_rough_dielectric_facet m =
		lobe_rough_dielectric_facet_again(ndf, p.glass, v, s, i, reflects, LOBE_R(1.0));
	const lobe_iridescent_share share = lobe_iridescent_dielectric_share(p, v, m);
	const lobe_real pdf = lobe_rough_dielectric_pdf_at(v, m, share.mean);
	const lobe_real w = lobe_rough_dielectric_sample_weight(ndf, p.glass, v, i, reflects);
	return lobe_sample_select(pdf > LOBE_R(0.0), lobe_rough_dielectric_flip(wo, i),
				  lobe_rgb_finite_or_zero(lobe_rgb_scale(share.rgb, w / share.mean)), pdf,
				  lobe_rough_dielectric_event(p.glass, reflects));
}

#endif
