/* strategies_estimate.h - one estimate of the luminance, by each kind of technique: from the lobe, from the light, from
 * both.
 *
 * Included where the strategy is chosen at run time (strategies_case.c) and where it is a constant
 * (strategies_only.h). */
#ifndef LOBE_REPORT_STRATEGIES_ESTIMATE_H
#define LOBE_REPORT_STRATEGIES_ESTIMATE_H

#include "strategies.h"

LOBE_FN lobe_rgb strategies_times(lobe_rgb a, lobe_rgb b) { return lobe_rgb_make(a.r * b.r, a.g * b.g, a.b * b.b); }

LOBE_FN float strategies_from_lobe(const strategies_case *c, lobe_microfacet_conductor p, const float u[3])
{
	const lobe_sample s = lobe_microfacet_conductor_sample(p, c->wo, lobe_vec3_make(u[0], u[1], u[2]));
	float pdf;
	if (!s.event)
		return 0.0f;
	return strategies_luminance(strategies_times(s.weight, strategies_radiance(&c->light, s.wi, &pdf)));
}

LOBE_FN float strategies_from_light(const strategies_case *c, lobe_microfacet_conductor p, const float v[3])
{
	const struct light_sample s = strategies_draw(&c->light, v[0], v[1]);
	if (!(s.wi.z > 0.0f && s.pdf > 0.0f))
		return 0.0f;
	const lobe_rgb f = lobe_microfacet_conductor_eval(p, c->wo, s.wi);
	return strategies_luminance(strategies_times(f, s.radiance)) / s.pdf;
}

/* Weight of a direction drawn with density a where the other technique has b. By the ratio: a square would overflow. */
LOBE_FN float strategies_heuristic(int technique, float a, float b)
{
	const float ratio = b / a;
	return 1.0f / (1.0f + (technique == STRATEGIES_POWER ? ratio * ratio : ratio));
}

LOBE_FN float strategies_from_both(const strategies_case *c, int technique, lobe_microfacet_conductor p,
				   const float u[3], const float v[3])
{
	const lobe_sample s = lobe_microfacet_conductor_sample(p, c->wo, lobe_vec3_make(u[0], u[1], u[2]));
	const struct light_sample l = strategies_draw(&c->light, v[0], v[1]);
	float sum = 0.0f, pdf;
	if (s.event) {
		const lobe_rgb radiance = strategies_radiance(&c->light, s.wi, &pdf);
		sum = strategies_luminance(strategies_times(s.weight, radiance)) *
		      strategies_heuristic(technique, s.pdf, pdf);
	}
	if (l.wi.z > 0.0f && l.pdf > 0.0f) {
		const lobe_rgb f = lobe_microfacet_conductor_eval(p, c->wo, l.wi);
		pdf = lobe_microfacet_conductor_pdf(p, c->wo, l.wi);
		sum += strategies_luminance(strategies_times(f, l.radiance)) / l.pdf *
		       strategies_heuristic(technique, l.pdf, pdf);
	}
	return sum;
}

LOBE_FN float strategies_by(const strategies_case *c, int technique, lobe_microfacet_conductor p, const float u[3],
			    const float v[3])
{
	if (technique < STRATEGIES_LOBE)
		return strategies_from_lobe(c, p, u);
	return technique == STRATEGIES_LIGHT ? strategies_from_light(c, p, v)
					     : strategies_from_both(c, technique, p, u, v);
}

#endif
