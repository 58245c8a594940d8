/* smooth_conductor.h - a polished metal: the mirrored direction with the exact conductor Fresnel term (core/fresnel.h).
 * Opaque; nothing from below. The limit of ggx_conductor for alpha to 0. A delta lobe: eval and pdf are 0, and the one
 * sample has probability 1 and weight F. */
#ifndef LOBE_LOBES_SMOOTH_CONDUCTOR_H
#define LOBE_LOBES_SMOOTH_CONDUCTOR_H

#include "../core/event.h"
#include "../core/fresnel.h"

/* eta, k: complex index n + ik per channel over that of the outside, eta in [1/1000, 1000], k in [0, 1000]
 * (core/optics.h has those of real metals). */
typedef struct {
	lobe_rgb eta, k;
} lobe_smooth_conductor;

LOBE_FN lobe_smooth_conductor lobe_smooth_conductor_make(lobe_rgb eta, lobe_rgb k)
{
	lobe_smooth_conductor p;
	p.eta = eta;
	p.k = k;
	return p;
}

LOBE_FN lobe_rgb lobe_smooth_conductor_eval(lobe_smooth_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_real lobe_smooth_conductor_pdf(lobe_smooth_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return LOBE_R(0.0);
}

/* Uses nothing of u. No sample for a wo in the surface or below, and none where a parameter is no finite number. */
LOBE_FN lobe_sample lobe_smooth_conductor_sample(lobe_smooth_conductor p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_real params = p.eta.r + p.eta.g + p.eta.b + p.k.r + p.k.g + p.k.b;
	const int ok = lobe_is_number(params) & lobe_vec3_is_number(wo) & (wo.z > zero);
	const lobe_real c = lobe_min(wo.z, one);
	(void)u;
	return lobe_sample_select(ok, lobe_vec3_make(-wo.x, -wo.y, wo.z),
				  lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle_make(c * c), p.eta, p.k, one), one,
				  LOBE_EVENT_REFLECT | LOBE_EVENT_DELTA);
}

#endif
