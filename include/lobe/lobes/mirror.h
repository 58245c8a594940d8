/* mirror.h - the ideal mirror: all light goes to the mirrored direction, whatever the angle. Opaque, on both sides of
 * the surface. A delta lobe: eval and pdf are 0, and the one sample has probability 1 and weight reflectance. */
#ifndef LOBE_LOBES_MIRROR_H
#define LOBE_LOBES_MIRROR_H

#include "../core/event.h"

/* reflectance: each channel in [0, 1]. */
typedef struct {
	lobe_rgb reflectance;
} lobe_mirror;

LOBE_FN lobe_mirror lobe_mirror_make(lobe_rgb reflectance)
{
	lobe_mirror p;
	p.reflectance = reflectance;
	return p;
}

LOBE_FN lobe_rgb lobe_mirror_eval(lobe_mirror p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_real lobe_mirror_pdf(lobe_mirror p, lobe_vec3 wo, lobe_vec3 wi)
{
	(void)p;
	(void)wo;
	(void)wi;
	return LOBE_R(0.0);
}

/* Uses nothing of u. No sample for a wo in the surface or that is none. */
LOBE_FN lobe_sample lobe_mirror_sample(lobe_mirror p, lobe_vec3 wo, lobe_vec3 u)
{
	const int ok = (lobe_abs(wo.z) > LOBE_R(0.0)) & lobe_vec3_is_number(wo);
	(void)u;
	return lobe_sample_select(ok, lobe_vec3_make(-wo.x, -wo.y, wo.z),
				  lobe_rgb_finite_or_zero(p.reflectance), LOBE_R(1.0),
				  LOBE_EVENT_REFLECT | LOBE_EVENT_DELTA);
}

#endif
