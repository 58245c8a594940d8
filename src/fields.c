/* fields.c - the fields of every lobe with their domains, so that the host can refuse a bad one by name.
 *
 * Fields that make prepares are listed too: a struct that was not made by its make function is refused. */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "internal.h"

typedef struct {
	const char *name;
	size_t offset;
	int type; /* REAL_FIELD, UINT_FIELD, or CHOICE_FIELD + LOBE_CHOICE_*, which is an unsigned integer too */
	double min, max;
} field;

enum { REAL_FIELD, UINT_FIELD, CHOICE_FIELD };

#define REAL(lobe, member, min, max)                                                                                   \
	{                                                                                                              \
#member, offsetof(lobe_##lobe, member), REAL_FIELD, min, max                                           \
	}
#define UINT(lobe, member, max)                                                                                        \
	{                                                                                                              \
#member, offsetof(lobe_##lobe, member), UINT_FIELD, 0, max                                             \
	}
#define CHOICE(NAME, lobe, member, max)                                                                                \
	{                                                                                                              \
#member, offsetof(lobe_##lobe, member), CHOICE_FIELD + LOBE_CHOICE_##NAME, 0, max                      \
	}
#define RGB(lobe, member, min, max)                                                                                    \
	REAL(lobe, member.r, min, max), REAL(lobe, member.g, min, max), REAL(lobe, member.b, min, max)

/* Roundings are allowed at the ends, here and below: those of make, and of who wrote 1e-4f or 1/1.5f. */
#define ALPHA_MIN (0.99999 * (double)LOBE_ALPHA_MIN)
/* norm = 1/(pi alpha_x alpha_y) */
#define STRETCH(lobe, member)                                                                                          \
	REAL(lobe, member.alpha_x, ALPHA_MIN, 1), REAL(lobe, member.alpha_y, ALPHA_MIN, 1),                            \
		REAL(lobe, member.inv_alpha_x, 1, 1 / ALPHA_MIN), REAL(lobe, member.inv_alpha_y, 1, 1 / ALPHA_MIN),    \
		REAL(lobe, member.norm, 0.3, 1 / (ALPHA_MIN * ALPHA_MIN))
#define INDEX(lobe, member)     REAL(lobe, member, 0.99999e-3, 1000.01)
#define METAL(lobe)             RGB(lobe, eta, 0.99999e-3, 1000), RGB(lobe, k, 0, 1000)
#define FILM(lobe, index_max)   REAL(lobe, film.thickness, 0, 1e6), REAL(lobe, film.index, 0.999999, index_max)
#define TRANSPORT(lobe, member) UINT(lobe, member, LOBE_TRANSPORT_IMPORTANCE)

static const field fields_lambert[] = {RGB(lambert, reflectance, 0, 1)};

static const field fields_ggx_conductor[] = {STRETCH(ggx_conductor, stretch), METAL(ggx_conductor)};

static const field fields_ggx_dielectric[] = {STRETCH(ggx_dielectric, stretch), INDEX(ggx_dielectric, eta),
					      INDEX(ggx_dielectric, inv_eta),   TRANSPORT(ggx_dielectric, transport),
					      CHOICE(DELTA, ggx_dielectric, delta, 1), CHOICE(DENSE, ggx_dielectric, dense, 1)};

static const field fields_beckmann_conductor[] = {STRETCH(beckmann_conductor, stretch), METAL(beckmann_conductor)};

static const field fields_beckmann_dielectric[] = {
	STRETCH(beckmann_dielectric, stretch), INDEX(beckmann_dielectric, eta),
	INDEX(beckmann_dielectric, inv_eta),   TRANSPORT(beckmann_dielectric, transport),
	CHOICE(DELTA, beckmann_dielectric, delta, 1), CHOICE(DENSE, beckmann_dielectric, dense, 1)};

static const field fields_ggx_schlick[] = {STRETCH(ggx_schlick, stretch), RGB(ggx_schlick, f0, 0, 1),
					   RGB(ggx_schlick, f90, 0, 1)};

static const field fields_mirror[] = {RGB(mirror, reflectance, 0, 1)};

static const field fields_smooth_conductor[] = {METAL(smooth_conductor)};

static const field fields_smooth_dielectric[] = {INDEX(smooth_dielectric, eta), INDEX(smooth_dielectric, inv_eta),
						 TRANSPORT(smooth_dielectric, transport)};

static const field fields_thin_dielectric[] = {INDEX(thin_dielectric, eta)};

static const field fields_iridescent_conductor[] = {STRETCH(iridescent_conductor, stretch), METAL(iridescent_conductor),
						    FILM(iridescent_conductor, 1000)};

/* Its film's index is over the thinner medium's: lobe_check_optics. */
static const field fields_iridescent_dielectric[] = {
	STRETCH(iridescent_dielectric, glass.stretch), INDEX(iridescent_dielectric, glass.eta),
	INDEX(iridescent_dielectric, glass.inv_eta),   TRANSPORT(iridescent_dielectric, glass.transport),
	CHOICE(DELTA, iridescent_dielectric, glass.delta, 1), CHOICE(DENSE, iridescent_dielectric, glass.dense, 1),
	FILM(iridescent_dielectric, 1.0001e6)};

/* microfacet/linear.h: slopes and widths to 100; of two widths 1e-4 that are correlated by .9999 the inverse is up to
 * 1/(1e-4 sqrt(1 - .9999^2)) = 7.1e5, and norm = 1/(pi det) is from 1/(pi 100^2) to 2.3e9. */
#define SLOPES  100.01
#define INVERSE 1e6
#define LINEAR(lobe, map)                                                                                              \
	REAL(lobe, map.xx, -SLOPES, SLOPES), REAL(lobe, map.xy, -SLOPES, SLOPES), REAL(lobe, map.yx, -SLOPES, SLOPES), \
		REAL(lobe, map.yy, -SLOPES, SLOPES), REAL(lobe, map.mean_x, -SLOPES, SLOPES),                          \
		REAL(lobe, map.mean_y, -SLOPES, SLOPES), REAL(lobe, map.ixx, -INVERSE, INVERSE),                       \
		REAL(lobe, map.ixy, -INVERSE, INVERSE), REAL(lobe, map.iyx, -INVERSE, INVERSE),                        \
		REAL(lobe, map.iyy, -INVERSE, INVERSE), REAL(lobe, map.norm, 3e-5, 1e10)
/* A table's handle has no domain here: lobe_check_table sees to it. */
#define DISTRIBUTION(lobe, member)                                                                                     \
	CHOICE(NDF, lobe, member.ndf, LOBE_NDF_TABULATED),                                                             \
		REAL(lobe, member.exponent, -(double)FLT_MAX, (double)FLT_MAX), REAL(lobe, member.width, 0, 1000),     \
		REAL(lobe, member.norm, 0, (double)FLT_MAX), UINT(lobe, member.table.low, UINT32_MAX),                 \
		UINT(lobe, member.table.high, UINT32_MAX)
#define MICROSURFACE(lobe)                                                                                             \
	DISTRIBUTION(lobe, surface.distribution), LINEAR(lobe, surface.map),                                           \
		CHOICE(MASKING, lobe, surface.masking, LOBE_MASKING_LAST),                                             \
		CHOICE(JOINT, lobe, surface.joint, LOBE_JOINT_LAST),                                                   \
		CHOICE(ACROSS, lobe, surface.across, LOBE_ACROSS_BETA), REAL(lobe, surface.like, 1e-5, 10),            \
		REAL(lobe, surface.alpha, 1e-10, 1000), REAL(lobe, surface.narrow, 1e-10, 1000)
/* The widest of all models: of a and b the index of a conductor, and a dip's depth may be negative; of c and d a film's
 * thickness and index. lobe_check_optics knows each model's. */
#define FRESNEL(lobe)                                                                                                  \
	CHOICE(FRESNEL, lobe, fresnel.model, LOBE_FRESNEL_LAST), RGB(lobe, fresnel.a, 0, 1000),                        \
		RGB(lobe, fresnel.b, -1, 1000), REAL(lobe, fresnel.c, 0, 1e6), REAL(lobe, fresnel.d, 0, 1.0001e6)

static const field fields_microfacet_conductor[] = {
	MICROSURFACE(microfacet_conductor), FRESNEL(microfacet_conductor),
	CHOICE(STRATEGY, microfacet_conductor, strategy, LOBE_STRATEGY_LAST)};

static const field fields_microfacet_dielectric[] = {
	MICROSURFACE(microfacet_dielectric),
	FRESNEL(microfacet_dielectric),
	INDEX(microfacet_dielectric, eta),
	INDEX(microfacet_dielectric, inv_eta),
	CHOICE(STRATEGY, microfacet_dielectric, strategy, LOBE_STRATEGY_LAST),
	TRANSPORT(microfacet_dielectric, transport),
	UINT(microfacet_dielectric, delta, 1)};

static const field fields_microfacet_diffuse[] = {MICROSURFACE(microfacet_diffuse),
						  RGB(microfacet_diffuse, reflectance, 0, 1)};

static const struct {
	uint32_t kind;
	const field *fields;
	size_t count;
} lobes[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) {kind, fields_##name, sizeof fields_##name / sizeof *fields_##name},
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};

/* Every member of a lobe is 4 bytes, so a field that the list above forgot shows here, at compile time. */
#define LOBE_X(NAME, name, kind)                                                                                       \
	typedef char every_field_of_##name[sizeof(lobe_##name) == 4 * (sizeof fields_##name / sizeof *fields_##name)   \
						   ? 1                                                                 \
						   : -1];
#include "lobe/lobes/lobes.def"
#undef LOBE_X

const size_t lobe_param_size[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) sizeof(lobe_##name),
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};

const char *const lobe_param_name[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) #name,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};

int lobe_index_of_kind(uint32_t kind)
{
	if (kind == LOBE_KIND_NONE)
		return LOBE_INDEX_NONE;
	for (int i = 0; i < LOBE_COUNT; i++)
		if (lobes[i].kind == kind)
			return i;
	return -1;
}

static double value_of(const field *f, const lobe_bsdf *material)
{
	const unsigned char *const at = (const unsigned char *)&material->as + f->offset;
	uint32_t u;
	float x;
	memcpy(&u, at, sizeof u);
	memcpy(&x, at, sizeof x);
	return f->type == REAL_FIELD ? (double)x : (double)u;
}

/* What make prepares belongs to the rest: of a material whose fields were changed afterwards it would shade something
 * in between. make gives the same bits everywhere, so all but a rounding is a change. */
static lobe_status check_prepared(const lobe_bsdf *materials, size_t i, int index)
{
	const lobe_bsdf made = lobe_remake(&materials[i]);
	for (size_t k = 0; k < lobes[index].count; k++) {
		const field *f = &lobes[index].fields[k];
		const double value = value_of(f, &materials[i]), expected = value_of(f, &made);
		if (fabs(value - expected) > 1e-6 * fabs(expected))
			return lobe_fail(LOBE_ERROR_PARAMETER,
					 "materials[%zu]: field %s of lobe_%s is %g, but lobe_%s_make gives %g for the "
					 "others: make it anew instead of changing fields",
					 i, f->name, lobe_param_name[index], value, lobe_param_name[index], expected);
	}
	if (!lobe_map_is_whole(&materials[i]))
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "materials[%zu]: surface.map of lobe_%s is not as lobe_linear_make and its like make it: "
				 "the inverse does not belong to the matrix",
				 i, lobe_param_name[index]);
	return LOBE_OK;
}

static lobe_status out_of_domain(const field *f, size_t i, const char *lobe, double value)
{
	char text[32];
	if (f->type == REAL_FIELD)
		snprintf(text, sizeof text, "%g", value);
	else
		snprintf(text, sizeof text, "%.0f", value);
	return lobe_fail(LOBE_ERROR_PARAMETER,
			 "materials[%zu]: field %s of lobe_%s is %s, outside [%.3g, %.3g]; parameters come from lobe_%s_make", i,
			 f->name, lobe, text, f->min, f->max, lobe);
}

lobe_status lobe_check_material(const lobe_bsdf *materials, size_t i)
{
	const int index = lobe_index_of_kind(materials[i].kind);
	if (index < 0)
		return lobe_fail(LOBE_ERROR_PARAMETER, "materials[%zu].kind = %u is no lobe of this library", i,
				 materials[i].kind);
	if (index == LOBE_INDEX_NONE)
		return LOBE_OK;
	for (size_t k = 0; k < lobes[index].count; k++) {
		const field *f = &lobes[index].fields[k];
		const double value = value_of(f, &materials[i]);
		if (!(value >= f->min && value <= f->max))
			return out_of_domain(f, i, lobe_param_name[index], value);
	}
	const lobe_status status = lobe_check_optics(materials, i, lobe_param_name[index]);
	return status == LOBE_OK ? check_prepared(materials, i, index) : status;
}

int lobe_add_choices(const lobe_bsdf *material, uint32_t used[LOBE_CHOICES_COUNT])
{
	const int index = lobe_index_of_kind(material->kind);
	int any = 0;
	for (size_t k = 0; index >= 0 && index != LOBE_INDEX_NONE && k < lobes[index].count; k++) {
		const field *f = &lobes[index].fields[k];
		uint32_t value;
		if (f->type < CHOICE_FIELD)
			continue;
		memcpy(&value, (const unsigned char *)&material->as + f->offset, sizeof value);
		used[f->type - CHOICE_FIELD] |= UINT32_C(1) << value;
		any = 1;
	}
	return any;
}
