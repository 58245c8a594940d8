/* fresnel_model.h - a Fresnel term chosen at run time. For comparison lobes; production lobes call theirs by name. */
#ifndef LOBE_CORE_FRESNEL_MODEL_H
#define LOBE_CORE_FRESNEL_MODEL_H

#include "fresnel.h"

/* Stable across versions. a, b, c, d below are those of lobe_fresnel_model. */
enum {
	LOBE_FRESNEL_EXACT = 0,     /* a conductor of index a + ib; a dielectric of the lobe's eta */
	LOBE_FRESNEL_SCHLICK = 1,   /* a: reflectance at normal incidence */
	LOBE_FRESNEL_CONSTANT = 2,  /* a: reflectance */
	LOBE_FRESNEL_LAST = LOBE_FRESNEL_CONSTANT
};

/* model: LOBE_FRESNEL_*. The rest by the model. */
typedef struct {
	lobe_uint model;
	lobe_rgb a, b;
	lobe_real c, d;
} lobe_fresnel_model;

LOBE_FN lobe_fresnel_model lobe_fresnel_model_make(lobe_uint model, lobe_rgb a, lobe_rgb b, lobe_real c, lobe_real d)
{
	lobe_fresnel_model f;
	f.model = model;
	f.a = a;
	f.b = b;
	f.c = c;
	f.d = d;
	return f;
}

/* Of a conductor of index eta + ik. */
LOBE_FN lobe_fresnel_model lobe_fresnel_model_conductor(lobe_rgb eta, lobe_rgb k)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_EXACT, eta, k, LOBE_R(0.0), LOBE_R(0.0));
}

/* Of a dielectric: the lobe knows its index. */
LOBE_FN lobe_fresnel_model lobe_fresnel_model_dielectric(void)
{
	const lobe_rgb unused = lobe_rgb_make(LOBE_R(1.0), LOBE_R(1.0), LOBE_R(1.0));
	return lobe_fresnel_model_make(LOBE_FRESNEL_EXACT, unused, unused, LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_fresnel_model lobe_fresnel_model_schlick(lobe_rgb f0)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_SCHLICK, f0, f0, LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_fresnel_model lobe_fresnel_model_constant(lobe_rgb reflectance)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_CONSTANT, reflectance, reflectance, LOBE_R(0.0), LOBE_R(0.0));
}

/* No finite number where a parameter is none. */
LOBE_FN lobe_real lobe_fresnel_model_params(lobe_fresnel_model f)
{
	return f.a.r + f.a.g + f.a.b + f.b.r + f.b.g + f.b.b + f.c + f.d;
}

/* 1 - f */
LOBE_FN lobe_rgb lobe_rgb_rest(lobe_rgb f)
{
	const lobe_real one = LOBE_R(1.0);
	return lobe_rgb_make(one - f.r, one - f.g, one - f.b);
}

/* Reflectance of an opaque surface; c: cosine to the facet. */
LOBE_FN_APART lobe_rgb lobe_fresnel_model_opaque(lobe_fresnel_model f, lobe_real c)
{
	switch (f.model) {
	case LOBE_FRESNEL_EXACT:
		return lobe_fresnel_conductor_rgb(c, f.a, f.b);
	case LOBE_FRESNEL_SCHLICK:
		return lobe_fresnel_schlick_rgb(c, f.a);
	case LOBE_FRESNEL_CONSTANT:
		return f.a;
	default:
		return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
	}
}

/* 1 less that; of Schlick's (1 - f0)(1 - (1-c)^5), whose second factor is c times a sum, without the cancellation at
 * grazing angles. */
LOBE_FN lobe_rgb lobe_fresnel_model_rest(lobe_fresnel_model f, lobe_real c, lobe_rgb reflectance)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real m = one - c;
	const lobe_real sum = lobe_fma(m, lobe_fma(m, lobe_fma(m, one + m, one), one), one);
	return f.model == LOBE_FRESNEL_SCHLICK ? lobe_rgb_scale(lobe_rgb_rest(f.a), c * sum) : lobe_rgb_rest(reflectance);
}

/* What an interface does with light. reflect, transmit: probabilities by which a sample chooses, the means of the two
 * colours. exact: the interface without the model, which says where light goes. */
typedef struct {
	lobe_rgb reflectance, transmittance;
	lobe_real reflect, transmit;
	lobe_fresnel exact;
} lobe_fresnel_split;

/* The mean of the three, exactly the value where they are one. */
LOBE_FN lobe_real lobe_fresnel_mean(lobe_rgb f)
{
	return lobe_fma(LOBE_R(1.0) / LOBE_R(3.0), (f.g - f.r) + (f.b - f.r), f.r);
}

/* An interface of index e, the far side's over the near one's. What a model says of normal incidence holds from both
 * sides; from the denser one it is taken at the refracted angle, and reflection is total where it is. */
LOBE_FN_APART lobe_fresnel_split lobe_fresnel_model_interface(lobe_fresnel_model f, lobe_real c, lobe_real e)
{
	const lobe_real one = LOBE_R(1.0), zero = LOBE_R(0.0);
	lobe_fresnel_split s;
	s.exact = lobe_fresnel_dielectric(c, e);
	if (f.model == LOBE_FRESNEL_EXACT) {
		const lobe_real r = s.exact.reflectance, t = s.exact.transmittance;
		s.reflectance = lobe_rgb_make(r, r, r);
		s.transmittance = lobe_rgb_make(t, t, t);
	} else {
		const int total = s.exact.transmittance == zero;
		const lobe_real thin = e < one ? s.exact.cos_t : c;
		const lobe_rgb r = lobe_fresnel_model_opaque(f, thin);
		s.reflectance = total ? lobe_rgb_make(one, one, one) : r;
		s.transmittance = lobe_rgb_select(!total, lobe_fresnel_model_rest(f, thin, r));
	}
	s.reflect = lobe_fresnel_mean(s.reflectance);
	s.transmit = lobe_fresnel_mean(s.transmittance);
	return s;
}

#endif
