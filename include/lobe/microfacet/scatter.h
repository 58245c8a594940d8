/* scatter.h - two directions and the facet that takes one to the other, on a microsurface chosen at run time.
 *
 * What eval, pdf and the weight of a sample share, so that they agree to the last few roundings. In the unnormalised
 * half vector H = o + e_r i, e_r = 1 for a reflection, the facet's density is (Walter et al. 2007)
 *	D(m) |o.m| |dm/di| = norm e_r^2 |o.H| |i.H| D1(H)
 * without any power of |H|, D1 being the density on the surface of width 1. With it
 *	f |cos theta_i| = F density G2/z_o,   pdf = P density_s rate,   weight = F/P (density/density_s) (G2/z_o)/rate
 * where F is the share that the event has of the light, P that of the samples, and _s are the strategy's. */
#ifndef LOBE_MICROFACET_SCATTER_H
#define LOBE_MICROFACET_SCATTER_H

#include "../core/fresnel.h"
#include "masking.h"
#include "strategy.h"

/* facing: > 0 where there is such a facet and both directions see the sides of it that they should. cosine, cosine_i: |o.m|
 * and |i.m|. sine2: |o x m|^2, see lobe_sine2. density [1/sr] times F and g2_over_cos is f |cos theta_i|. sampled: density_s
 * rate [1/sr]. gain: (density/density_s) g2_over_cos/rate. */
typedef struct {
	lobe_real facing, cosine, cosine_i, sine2, density, g2_over_cos, sampled, gain;
} lobe_scatter;

/* o.z > 0. i is above for a reflection and below for a refraction; e: index of the far side over that of o's (any for a
 * reflection). transmits: the lobe does, and its strategy has to reach both sides. */
LOBE_FN_APART lobe_scatter lobe_scatter_at(lobe_microsurface s, lobe_uint strategy, lobe_vec3 o, lobe_vec3 i,
					   lobe_real e, int transmits)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const int across = i.z < zero;
	const lobe_real e_r = across ? e : one;
	const lobe_vec3 sum = lobe_vec3_fma(e_r, i, o);
	const lobe_real up = sum.z < zero ? -one : one;
	const lobe_vec3 h = lobe_vec3_scale(sum, up);
	const lobe_real h2 = lobe_dot(h, h);
	/* Of a reflection both are |H|^2/2, which does not cancel. */
	lobe_seen_facet m;
	m.o = across ? lobe_dot(o, h) : LOBE_R(0.5) * h2;
	m.i = across ? -lobe_dot(i, h) : LOBE_R(0.5) * h2;
	m.z = h.z;
	m.length2 = h2;
	const lobe_vec3 f = lobe_linear_facet(s.map, h);
	const lobe_seen seen_o = lobe_see(s, o, one);
	const lobe_seen seen_i = lobe_see(s, i, across ? -one : one);
	const lobe_facet_density d = lobe_distribution_density(s.distribution, f);
	const lobe_facet_density d_s = lobe_strategy_density(strategy, s, f, d);
	const lobe_real x = e_r * d.inv, x_s = e_r * d_s.inv;
	lobe_scatter r;
	const lobe_real facing = lobe_min(lobe_min(o.z, across ? -i.z : i.z), lobe_min(lobe_min(m.o, m.i), m.z));
	r.facing = lobe_is_number(h2) ? facing : zero;
	r.cosine = lobe_min(m.o / lobe_sqrt(h2), one);
	r.cosine_i = lobe_min(m.i / lobe_sqrt(h2), one);
	/* (o + e i) x o = e i x o; of a reflection (o - i)/2 is as long, and the same for both. */
	const lobe_vec3 bent = lobe_vec3_scale(lobe_cross(i, o), e_r / lobe_sqrt(h2));
	const lobe_vec3 mirrored = lobe_vec3_scale(lobe_vec3_fma(-one, i, o), LOBE_R(0.5));
	r.sine2 = lobe_sine2(r.cosine, e, lobe_vec3_select(across, bent, mirrored));
	r.density = s.map.norm * (m.o * x) * (m.i * x) * d.factor;
	r.g2_over_cos = lobe_masking_g2_over_cos(s, seen_o, seen_i, m, across);
	if (lobe_strategy_of_directions(strategy)) {
		r.sampled = lobe_strategy_direction_pdf(strategy, transmits, i);
		r.gain = r.density * r.g2_over_cos / r.sampled;
	} else {
		const lobe_real rate = lobe_strategy_rate(strategy, s, seen_o, o, transmits, m);
		r.sampled = s.map.norm * (m.o * x_s) * (m.i * x_s) * d_s.factor * rate;
		r.gain = lobe_strategy_ratio(d, d_s) * r.g2_over_cos / rate;
	}
	return r;
}

#endif
