/* fresnel_model.h - a Fresnel term chosen at run time. For comparison lobes; production lobes call theirs by name. */
#ifndef LOBE_CORE_FRESNEL_MODEL_H
#define LOBE_CORE_FRESNEL_MODEL_H

#include "fresnel.h"
#include "fresnel_artist.h"
#include "fresnel_schlick.h"
#include "thin_film.h"

/* Stable across versions. a, b, c, d are the fields of lobe_fresnel_model. */
enum {
	LOBE_FRESNEL_EXACT = 0,    /* a conductor of index a + ib; a dielectric of the lobe's eta */
	LOBE_FRESNEL_SCHLICK = 1,  /* a, b: reflectance at normal incidence and at grazing */
	LOBE_FRESNEL_CONSTANT = 2, /* a: reflectance */
	LOBE_FRESNEL_POWER = 3,    /* Schlick's curve with exponent c */
	LOBE_FRESNEL_F82 = 4,      /* a: reflectance at normal incidence, b: depth of the dip (fresnel_schlick.h) */
	LOBE_FRESNEL_FILM =
		5, /* a film of thickness c [nm] and index d; under it a conductor as above or a dielectric */
	LOBE_FRESNEL_LAST = LOBE_FRESNEL_FILM
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

LOBE_FN lobe_fresnel_model lobe_fresnel_model_constant(lobe_rgb reflectance)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_CONSTANT, reflectance, reflectance, LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_fresnel_model lobe_fresnel_model_schlick(lobe_rgb f0, lobe_rgb f90)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_SCHLICK, f0, f90, LOBE_R(0.0), LOBE_R(0.0));
}

LOBE_FN lobe_fresnel_model lobe_fresnel_model_power(lobe_rgb f0, lobe_rgb f90, lobe_real exponent)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_POWER, f0, f90, exponent, LOBE_R(0.0));
}

/* tint: reflectance at 81.8 degrees over Schlick's there. */
LOBE_FN lobe_fresnel_model lobe_fresnel_model_f82(lobe_rgb f0, lobe_rgb tint)
{
	const lobe_rgb depth = lobe_rgb_make(lobe_fresnel_f82_depth(f0.r, tint.r), lobe_fresnel_f82_depth(f0.g, tint.g),
					     lobe_fresnel_f82_depth(f0.b, tint.b));
	return lobe_fresnel_model_make(LOBE_FRESNEL_F82, f0, depth, LOBE_R(0.0), LOBE_R(0.0));
}

/* Gulbrandsen's metal of that colour and edge tint, which is an index. */
LOBE_FN lobe_fresnel_model lobe_fresnel_model_artist(lobe_rgb reflectance, lobe_rgb edge)
{
	const lobe_fresnel_index_rgb i = lobe_fresnel_artist_rgb(reflectance, edge);
	return lobe_fresnel_model_conductor(i.eta, i.k);
}

/* A film of thickness [nm] and index, over a conductor. */
LOBE_FN lobe_fresnel_model lobe_fresnel_model_film_on_conductor(lobe_real thickness, lobe_real index, lobe_rgb eta,
								lobe_rgb k)
{
	return lobe_fresnel_model_make(LOBE_FRESNEL_FILM, eta, k, thickness, index);
}

/* The same over a dielectric of the lobe's eta: kept as the thinner of its two media sees it, as in
 * lobes/iridescent_dielectric.h. */
LOBE_FN lobe_fresnel_model lobe_fresnel_model_film_on_dielectric(lobe_real thickness, lobe_real index, lobe_real eta)
{
	const lobe_real thinner = lobe_at_most(eta, LOBE_R(1.0));
	const lobe_rgb unused = lobe_rgb_make(LOBE_R(1.0), LOBE_R(1.0), LOBE_R(1.0));
	return lobe_fresnel_model_make(LOBE_FRESNEL_FILM, unused, unused, thickness * thinner, index / thinner);
}

/* No finite number where a parameter is none. */
LOBE_FN lobe_real lobe_fresnel_model_params(lobe_fresnel_model f)
{
	return f.a.r + f.a.g + f.a.b + f.b.r + f.b.g + f.b.b + f.c + f.d;
}

LOBE_FN lobe_rgb lobe_rgb_all(lobe_real x) { return lobe_rgb_make(x, x, x); }

/* Reflectance of an opaque surface; c: cosine to the facet. */
LOBE_FN_APART lobe_rgb lobe_fresnel_model_opaque(lobe_fresnel_model f, lobe_real c)
{
	switch (LOBE_CHOSEN(f.model, LOBE_ONLY_FRESNEL)) {
	case LOBE_FRESNEL_EXACT:
		return lobe_fresnel_conductor_rgb(c, f.a, f.b);
	case LOBE_FRESNEL_SCHLICK:
		return lobe_fresnel_schlick_f90_rgb(c, f.a, f.b);
	case LOBE_FRESNEL_CONSTANT:
		return f.a;
	case LOBE_FRESNEL_POWER:
		return lobe_fresnel_schlick_power_rgb(c, f.a, f.b, f.c);
	case LOBE_FRESNEL_F82:
		return lobe_fresnel_f82_rgb(c, f.a, f.b);
	case LOBE_FRESNEL_FILM:
		return lobe_thin_film_conductor_rgb(c, lobe_film_make(f.c, f.d), f.a, f.b);
	default:
		return lobe_rgb_all(LOBE_R(0.0));
	}
}

/* 1 less that, where it does not depend on a base. Of Schlick's, (1 - f90) + (f90 - f0)(1 - (1-c)^5), whose last factor
 * is c times a sum: no cancellation at grazing angles. */
LOBE_FN lobe_rgb lobe_fresnel_model_rest(lobe_fresnel_model f, lobe_real c, lobe_rgb reflectance)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real m = one - c;
	const lobe_real rise = c * lobe_fma(m, lobe_fma(m, lobe_fma(m, one + m, one), one), one);
	const lobe_rgb schlick =
		lobe_rgb_make(lobe_fma(f.b.r - f.a.r, rise, one - f.b.r), lobe_fma(f.b.g - f.a.g, rise, one - f.b.g),
			      lobe_fma(f.b.b - f.a.b, rise, one - f.b.b));
	const lobe_rgb other = lobe_rgb_make(one - reflectance.r, one - reflectance.g, one - reflectance.b);
	return LOBE_CHOSEN(f.model, LOBE_ONLY_FRESNEL) == LOBE_FRESNEL_SCHLICK ? schlick : other;
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

/* An interface at a unit normal. What a model says of normal incidence holds from both sides; from the denser one it is
 * taken at the refracted angle, and reflection is total where it is. */
LOBE_FN_APART lobe_fresnel_split lobe_fresnel_model_interface(lobe_fresnel_model f, lobe_fresnel_interface at)
{
	const lobe_real c = at.c, e = at.eta;
	const lobe_real one = LOBE_R(1.0), zero = LOBE_R(0.0);
	const lobe_uint model = LOBE_CHOSEN(f.model, LOBE_ONLY_FRESNEL);
	lobe_fresnel_split s;
	s.exact = lobe_fresnel_dielectric_at(at);
	const int total = s.exact.transmittance == zero;
	const lobe_real thin = e < one ? s.exact.cos_t : c;
	if (model == LOBE_FRESNEL_EXACT) {
		s.reflectance = lobe_rgb_all(s.exact.reflectance);
		s.transmittance = lobe_rgb_all(s.exact.transmittance);
	} else if (model == LOBE_FRESNEL_FILM) {
		const lobe_film_fresnel film =
			lobe_thin_film_dielectric_rgb(thin, lobe_film_make(f.c, f.d), e < one ? one / e : e);
		s.reflectance = total ? lobe_rgb_all(one) : film.reflectance;
		s.transmittance = lobe_rgb_select(!total, film.transmittance);
	} else {
		const lobe_rgb r = lobe_fresnel_model_opaque(f, thin);
		s.reflectance = total ? lobe_rgb_all(one) : r;
		s.transmittance = lobe_rgb_select(!total, lobe_fresnel_model_rest(f, thin, r));
	}
	s.reflect = lobe_fresnel_mean(s.reflectance);
	s.transmit = lobe_fresnel_mean(s.transmittance);
	return s;
}

#endif
