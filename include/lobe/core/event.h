/* event.h - what sample returns. */
#ifndef LOBE_CORE_EVENT_H
#define LOBE_CORE_EVENT_H

#include "vec.h"

enum {
	LOBE_EVENT_REFLECT = 1,
	LOBE_EVENT_TRANSMIT = 2,
	LOBE_EVENT_DELTA = 4, /* pdf is a probability, eval and pdf of the direction are 0 */
	LOBE_EVENT_DIFFUSE = 8,
	LOBE_EVENT_GLOSSY = 16
};

/* What a transmitted path carries. Radiance is scaled by (n_o/n_i)^2 when it crosses an interface, importance
 * (photons, adjoint paths) is not: Veach 1997, section 5.2. */
enum { LOBE_TRANSPORT_RADIANCE = 0, LOBE_TRANSPORT_IMPORTANCE = 1 };

/* wi: unit direction. weight = f |cos theta_i| / pdf. pdf: per solid angle [1/sr], or a probability with
 * LOBE_EVENT_DELTA. event: bits as above; 0 means no sample, and then every field is 0. */
typedef struct {
	lobe_vec3 wi;
	lobe_rgb weight;
	lobe_real pdf;
	lobe_uint event;
} lobe_sample;

LOBE_FN lobe_sample lobe_sample_none(void)
{
	const lobe_real zero = LOBE_R(0.0);
	lobe_sample s;
	s.wi = lobe_vec3_make(zero, zero, zero);
	s.weight = lobe_rgb_make(zero, zero, zero);
	s.pdf = zero;
	s.event = 0u;
	return s;
}

/* A sample that is kept where ok, and all zero elsewhere, without a branch. */
LOBE_FN lobe_sample lobe_sample_select(int ok, lobe_vec3 wi, lobe_rgb weight, lobe_real pdf, lobe_uint event)
{
	const lobe_real zero = LOBE_R(0.0);
	lobe_sample s;
	s.wi.x = ok ? wi.x : zero;
	s.wi.y = ok ? wi.y : zero;
	s.wi.z = ok ? wi.z : zero;
	s.weight.r = ok ? weight.r : zero;
	s.weight.g = ok ? weight.g : zero;
	s.weight.b = ok ? weight.b : zero;
	s.pdf = ok ? pdf : zero;
	s.event = ok ? event : 0u;
	return s;
}

#endif
