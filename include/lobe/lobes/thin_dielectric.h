/* thin_dielectric.h - a pane: two parallel dielectric interfaces so close that light leaves where it came in.
 *
 * With F of one interface, T = 1 - F, all interreflections inside the slab add up to
 *	R' = F + T^2 F/(1 - F^2) = 2F/(1 + F),   T' = T^2/(1 - F^2) = T/(1 + F)
 * and what passes goes straight on, in the medium that it came from: radiance and importance alike. Both sides alike.
 * The slab is thick against the coherence length of light (else: iridescent_dielectric) and does not absorb. F is that
 * of unpolarised light, as in other renderers; with each polarisation summed by itself R' of glass would be lower, by
 * at most .0222, at 74 degrees (tests/test_delta.c).
 *
 * A delta lobe: eval and pdf are 0; a sample's pdf is the probability of its event and its weight is 1. */
#ifndef LOBE_LOBES_THIN_DIELECTRIC_H
#define LOBE_LOBES_THIN_DIELECTRIC_H

#include "../core/event.h"
#include "../core/fresnel.h"

/* eta: index of the slab over that around it, in [1/1000, 1000]. */
typedef struct {
	lobe_real eta;
} lobe_thin_dielectric;

LOBE_FN lobe_thin_dielectric lobe_thin_dielectric_make(lobe_real eta)
{
	lobe_thin_dielectric p;
	p.eta = eta;
	return p;
}

LOBE_FN lobe_rgb lobe_thin_dielectric_eval(lobe_thin_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_real lobe_thin_dielectric_pdf(lobe_thin_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return LOBE_R(0.0);
}

/* Uses u.z: below R' it reflects. No sample for a wo in the surface, and none where eta is no finite number. */
LOBE_FN lobe_sample lobe_thin_dielectric_sample(lobe_thin_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_real z = lobe_abs(wo.z);
	const lobe_fresnel fr = lobe_fresnel_dielectric(lobe_min(z, one), p.eta);
	const lobe_real inv = one / (one + fr.reflectance);
	const lobe_real reflectance = lobe_at_most((fr.reflectance + fr.reflectance) * inv, one);
	const lobe_real transmittance = fr.transmittance * inv;
	const int reflects = u.z < reflectance;
	const lobe_vec3 wi = lobe_vec3_make(-wo.x, -wo.y, reflects ? wo.z : -wo.z);
	const lobe_real pdf = reflects ? reflectance : transmittance;
	const int numbers = lobe_is_number(p.eta) & lobe_vec3_is_number(wo);
	return lobe_sample_select(numbers & (lobe_min(z, pdf) > zero), wi, lobe_rgb_make(one, one, one), pdf,
				  LOBE_EVENT_DELTA | (reflects ? LOBE_EVENT_REFLECT : LOBE_EVENT_TRANSMIT));
}

#endif
