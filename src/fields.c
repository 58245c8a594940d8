/* fields.c - the fields of every lobe with their domains, so that the host can refuse a bad one by name.
 *
 * Fields that make prepares are listed too: a struct that was not made by its make function is refused. */
#include <float.h>
#include <math.h>
#include <stddef.h>

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

/* One float rounding is allowed at the ends. */
#define ALPHA_MIN 0.99999e-4
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

/* Its film's index is over the thinner medium's. */
static const field fields_iridescent_dielectric[] = {
	STRETCH(iridescent_dielectric, glass.stretch), INDEX(iridescent_dielectric, glass.eta),
	INDEX(iridescent_dielectric, glass.inv_eta),   TRANSPORT(iridescent_dielectric, glass.transport),
	CHOICE(DELTA, iridescent_dielectric, glass.delta, 1), CHOICE(DENSE, iridescent_dielectric, glass.dense, 1),
	FILM(iridescent_dielectric, 1.0001e6)};

/* A table's handle has no domain here: lobe_check_table sees to it. */
/* microfacet/linear.h */
#define SLOPES  100.01
#define INVERSE 1e6
#define LINEAR(lobe, map)                                                                                              \
	REAL(lobe, map.xx, -SLOPES, SLOPES), REAL(lobe, map.xy, -SLOPES, SLOPES), REAL(lobe, map.yx, -SLOPES, SLOPES), \
		REAL(lobe, map.yy, -SLOPES, SLOPES), REAL(lobe, map.mean_x, -SLOPES, SLOPES),                          \
		REAL(lobe, map.mean_y, -SLOPES, SLOPES), REAL(lobe, map.ixx, -INVERSE, INVERSE),                       \
		REAL(lobe, map.ixy, -INVERSE, INVERSE), REAL(lobe, map.iyx, -INVERSE, INVERSE),                        \
		REAL(lobe, map.iyy, -INVERSE, INVERSE), REAL(lobe, map.norm, 3e-5, 1e10)
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
/* What they are is told by the model. Of a and b the widest is the index of a conductor, and a dip's depth may be
 * negative; of c and d a film's thickness and index. */
#define FRESNEL(lobe)                                                                                                  \
	CHOICE(FRESNEL, lobe, fresnel.model, LOBE_FRESNEL_LAST), RGB(lobe, fresnel.a, 0, 1000),                        \
		RGB(lobe, fresnel.b, -1, 1000), REAL(lobe, fresnel.c, 0, 1e6), REAL(lobe, fresnel.d, 0, 1.0001e6)

static const field fields_microfacet_conductor[] = {
	MICROSURFACE(microfacet_conductor), FRESNEL(microfacet_conductor),
	CHOICE(STRATEGY, microfacet_conductor, strategy, LOBE_STRATEGY_LAST)};

static const field fields_microfacet_dielectric[] = {
	MICROSURFACE(microfacet_dielectric),
	FRESNEL(microfacet_dielectric),
	REAL(microfacet_dielectric, eta, 0.99999e-3, 1000.01),
	REAL(microfacet_dielectric, inv_eta, 0.99999e-3, 1000.01),
	CHOICE(STRATEGY, microfacet_dielectric, strategy, LOBE_STRATEGY_LAST),
	UINT(microfacet_dielectric, transport, LOBE_TRANSPORT_IMPORTANCE),
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
		const unsigned char *at = (const unsigned char *)&materials[i].as + f->offset;
		double value;
		if (f->type == REAL_FIELD) {
			float x;
			memcpy(&x, at, sizeof x);
			value = (double)x;
		} else {
			uint32_t u;
			memcpy(&u, at, sizeof u);
			value = (double)u;
		}
		if (!(value >= f->min && value <= f->max))
			return lobe_fail(LOBE_ERROR_PARAMETER,
					 "materials[%zu]: field %s of lobe_%s is %g, outside [%.5g, %.5g]; "
					 "parameters come from lobe_%s_make",
					 i, f->name, lobe_param_name[index], value, f->min, f->max,
					 lobe_param_name[index]);
	}
	return LOBE_OK;
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
