/* optics_check.c - domains of a Fresnel model's numbers and of a film on glass, which depend on other fields: those of
 * the functions that make them. */
#include <float.h>

#include "internal.h"

/* Roundings of make are allowed at the ends. */
#define A_LITTLE 1e-6

typedef struct {
	double min, max;
} range;

/* Of a, b, c and d, by model (core/fresnel_model.h). A dip is at most as deep as the curve is high, a bulge as high. */
typedef struct {
	range a, b, c, d;
} model_domain;

#define ANY                                                                                                            \
	{                                                                                                              \
		-(double)FLT_MAX, (double)FLT_MAX                                                                      \
	}
static const model_domain model_domains[LOBE_FRESNEL_LAST + 1] = {
	[LOBE_FRESNEL_EXACT] = {{0.99999e-3, 1000.0}, {0.0, 1000.0}, ANY, ANY},
	[LOBE_FRESNEL_SCHLICK] = {{0.0, 1.0}, {0.0, 1.0}, ANY, ANY},
	[LOBE_FRESNEL_CONSTANT] = {{0.0, 1.0}, ANY, ANY, ANY},
	[LOBE_FRESNEL_POWER] = {{0.0, 1.0}, {0.0, 1.0}, {(double)FLT_MIN, 1e6}, ANY},
	[LOBE_FRESNEL_F82] = {{0.0, 1.0}, {-1.0, 1.0 + A_LITTLE}, ANY, ANY},
	[LOBE_FRESNEL_FILM] = {{0.99999e-3, 1000.0}, {0.0, 1000.0}, {0.0, 1e6}, {1.0 - A_LITTLE, 1.0001e6}},
};

static lobe_status check(size_t i, const char *lobe, const char *name, lobe_real value, range r)
{
	if ((double)value >= r.min && (double)value <= r.max)
		return LOBE_OK;
	return lobe_fail(LOBE_ERROR_PARAMETER, "materials[%zu]: field %s of lobe_%s is %g, outside [%.3g, %.3g]", i,
			 name, lobe, (double)value, r.min, r.max);
}

/* opaque: a and b may be the index of a metal; else it is glass, which has one of its own. */
static lobe_status check_model(size_t i, const char *lobe, lobe_fresnel_model f, int opaque)
{
	const int of_glass = !opaque && (f.model == LOBE_FRESNEL_EXACT || f.model == LOBE_FRESNEL_FILM);
	const model_domain *const m = &model_domains[f.model];
	const struct {
		const char *name;
		lobe_real value;
		range domain;
	} number[] = {{"fresnel.a.r", f.a.r, m->a}, {"fresnel.a.g", f.a.g, m->a}, {"fresnel.a.b", f.a.b, m->a},
		      {"fresnel.b.r", f.b.r, m->b}, {"fresnel.b.g", f.b.g, m->b}, {"fresnel.b.b", f.b.b, m->b},
		      {"fresnel.c", f.c, m->c},     {"fresnel.d", f.d, m->d}};
	lobe_status status = LOBE_OK;
	for (size_t k = of_glass ? 6 : 0; status == LOBE_OK && k < sizeof number / sizeof *number; k++)
		status = check(i, lobe, number[k].name, number[k].value, number[k].domain);
	return status;
}

/* A film as the thinner of its two media sees it: times and over that one's index. */
static lobe_status check_film(size_t i, const char *lobe, const char *thickness, const char *index, lobe_film film,
			      lobe_real eta)
{
	const double thinner = eta < 1.0f ? (double)eta : 1.0;
	const range thick = {0.0, 1e6 * thinner * (1.0 + A_LITTLE)};
	const range dense = {1.0 - A_LITTLE, 1000.0 / thinner * (1.0 + A_LITTLE)};
	const lobe_status status = check(i, lobe, thickness, film.thickness, thick);
	return status == LOBE_OK ? check(i, lobe, index, film.index, dense) : status;
}

lobe_status lobe_check_optics(const lobe_bsdf *materials, size_t i, const char *lobe)
{
	const lobe_bsdf *const b = &materials[i];
	const lobe_microfacet_dielectric *const glass = &b->as.microfacet_dielectric;
	lobe_status status;
	switch (b->kind) {
	case LOBE_KIND_IRIDESCENT_DIELECTRIC:
		return check_film(i, lobe, "film.thickness", "film.index", b->as.iridescent_dielectric.film,
				  b->as.iridescent_dielectric.glass.eta);
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return check_model(i, lobe, b->as.microfacet_conductor.fresnel, 1);
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		status = check_model(i, lobe, glass->fresnel, 0);
		if (status != LOBE_OK || glass->fresnel.model != LOBE_FRESNEL_FILM)
			return status;
		return check_film(i, lobe, "fresnel.c", "fresnel.d", lobe_film_make(glass->fresnel.c, glass->fresnel.d),
				  glass->eta);
	default:
		return LOBE_OK;
	}
}
