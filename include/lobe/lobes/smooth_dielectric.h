/* smooth_dielectric.h - polished glass: reflection and refraction by a smooth interface, from both sides.
 *
 * Fresnel (core/fresnel.h) decides between the two, Snell's law bends. The limit of ggx_dielectric for alpha to 0. A
 * delta lobe: eval and pdf are 0; a sample's pdf is the probability of its event, F or 1 - F, and its weight is 1, but
 * for refracted radiance, which is scaled by the square of the index (core/event.h). eta = 1 is no interface: light
 * passes straight, to the bit. */
#ifndef LOBE_LOBES_SMOOTH_DIELECTRIC_H
#define LOBE_LOBES_SMOOTH_DIELECTRIC_H

#include "../core/event.h"
#include "../core/fresnel.h"

/* eta: index below over index above the surface, in [1/1000, 1000]; inv_eta is 1/eta. transport: LOBE_TRANSPORT_*. */
typedef struct {
	lobe_real eta, inv_eta;
	lobe_uint transport;
} lobe_smooth_dielectric;

/* Carries radiance; see lobe_smooth_dielectric_transport. */
LOBE_FN lobe_smooth_dielectric lobe_smooth_dielectric_make(lobe_real eta)
{
	lobe_smooth_dielectric p;
	p.eta = eta;
	p.inv_eta = LOBE_R(1.0) / eta + (eta - eta); /* NaN for an infinite eta, not 0 */
	p.transport = LOBE_TRANSPORT_RADIANCE;
	return p;
}

/* The same surface for LOBE_TRANSPORT_RADIANCE or LOBE_TRANSPORT_IMPORTANCE (core/event.h). */
LOBE_FN lobe_smooth_dielectric lobe_smooth_dielectric_transport(lobe_smooth_dielectric p, lobe_uint transport)
{
	p.transport = transport;
	return p;
}

LOBE_FN lobe_rgb lobe_smooth_dielectric_eval(lobe_smooth_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_real lobe_smooth_dielectric_pdf(lobe_smooth_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return LOBE_R(0.0);
}

/* Uses u.z: below F it reflects. No sample for a wo in the surface.
 *
 * The refracted tangent is that of wo over e, the cosine Fresnel's own, which does not cancel near total reflection;
 * both together are unit but for what a rounding of wo's length becomes towards the thinner side, which is divided
 * out. */
LOBE_FN lobe_sample lobe_smooth_dielectric_sample(lobe_smooth_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const int above = wo.z > zero;
	const lobe_real e = above ? p.eta : p.inv_eta;
	const lobe_real inv_e = above ? p.inv_eta : p.eta;
	const lobe_real z = lobe_abs(wo.z);
	const lobe_real c = lobe_min(z, one);
	const lobe_fresnel fr = lobe_fresnel_dielectric(c, e);
	const int reflects = u.z < fr.reflectance;
	const lobe_real down = e == one ? z : fr.cos_t;
	const lobe_vec3 bent = lobe_vec3_make(-wo.x * inv_e, -wo.y * inv_e, above ? -down : down);
	const lobe_real inv_length = one / lobe_sqrt(lobe_dot(bent, bent));
	const lobe_real to_unit = e < one ? inv_length : one;
	const lobe_vec3 wi = lobe_vec3_make(reflects ? -wo.x : bent.x * to_unit, reflects ? -wo.y : bent.y * to_unit,
					    reflects ? wo.z : bent.z * to_unit);
	const lobe_real pdf = reflects ? fr.reflectance : fr.transmittance;
	const lobe_real scale = p.transport == LOBE_TRANSPORT_RADIANCE ? inv_e * inv_e : one;
	const lobe_real w = reflects ? one : scale;
	return lobe_sample_select((lobe_min(z, pdf) > zero) & lobe_vec3_is_number(wo), wi, lobe_rgb_make(w, w, w), pdf,
				  LOBE_EVENT_DELTA | (reflects ? LOBE_EVENT_REFLECT : LOBE_EVENT_TRANSMIT));
}

#endif
