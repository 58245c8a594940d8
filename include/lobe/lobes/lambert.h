/* lambert.h - the ideal diffuse reflector: f = reflectance/pi on the side of wo, on both sides of the surface.
 *
 * Lambert 1760. Sampled with density cos/pi, so that the weight is the reflectance. */
#ifndef LOBE_LOBES_LAMBERT_H
#define LOBE_LOBES_LAMBERT_H

#include "../core/event.h"
#include "../core/warp.h"

/* reflectance: albedo, each channel in [0, 1]. */
typedef struct {
	lobe_rgb reflectance;
} lobe_lambert;

LOBE_FN lobe_lambert lobe_lambert_make(lobe_rgb reflectance)
{
	lobe_lambert p;
	p.reflectance = reflectance;
	return p;
}

/* [1/sr] */
LOBE_FN lobe_real lobe_lambert_pdf(lobe_lambert p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_real zero = LOBE_R(0.0);
	const int same_side = ((wo.z > zero) & (wi.z > zero)) | ((wo.z < zero) & (wi.z < zero));
	const lobe_real pdf = lobe_finite_or_zero(lobe_abs(wi.z) * LOBE_INV_PI);
	(void)p;
	return same_side ? pdf : zero;
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_lambert_eval(lobe_lambert p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rgb_finite_or_zero(lobe_rgb_scale(p.reflectance, lobe_lambert_pdf(p, wo, wi)));
}

/* Uses u.x and u.y. */
LOBE_FN lobe_sample lobe_lambert_sample(lobe_lambert p, lobe_vec3 wo, lobe_vec3 u)
{
	lobe_vec3 wi = lobe_cosine_hemisphere(lobe_vec2_make(u.x, u.y));
	wi.z = wo.z < LOBE_R(0.0) ? -wi.z : wi.z;
	const lobe_real pdf = lobe_lambert_pdf(p, wo, wi);
	/* 0, or NaN where the random numbers are none. One comparison: of two gcc makes a branch. */
	const lobe_real number = (wi.x + wi.y) - (wi.x + wi.y);
	const int ok = pdf + number > LOBE_R(0.0);
	return lobe_sample_select(ok, wi, lobe_rgb_finite_or_zero(p.reflectance), pdf,
				  LOBE_EVENT_REFLECT | LOBE_EVENT_DIFFUSE);
}

#endif
