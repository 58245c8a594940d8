/* bsdf.h - any lobe: a tagged union over lobes.def and its dispatch.
 *
 * For shading one point at a time. A batch (batch.h) runs each kind in a loop of its own instead. */
#ifndef LOBE_BSDF_H
#define LOBE_BSDF_H

#include "lobes/lobes.h"
#include "core/event.h"

enum {
	LOBE_KIND_NONE = 0, /* shades to nothing: eval and pdf 0, no sample */
#define LOBE_X(NAME, name, kind) LOBE_KIND_##NAME = kind,
#include "lobes/lobes.def"
#undef LOBE_X
	LOBE_KIND_LIMIT = 256 /* every kind is below this */
};

/* kind: LOBE_KIND_*. as: the parameters of that kind, as its make function prepared them. */
typedef struct {
	lobe_uint kind;
	union {
		lobe_real none;
#define LOBE_X(NAME, name, kind) lobe_##name name;
#include "lobes/lobes.def"
#undef LOBE_X
	} as;
} lobe_bsdf;

/* lobe_bsdf_from_<lobe>(p): the lobe with parameters p, as a lobe_bsdf. */
#define LOBE_X(NAME, name, value)                                                                                      \
	LOBE_FN lobe_bsdf lobe_bsdf_from_##name(lobe_##name p)                                                         \
	{                                                                                                              \
		lobe_bsdf b;                                                                                           \
		b.kind = LOBE_KIND_##NAME;                                                                             \
		b.as.name = p;                                                                                         \
		return b;                                                                                              \
	}
#include "lobes/lobes.def"
#undef LOBE_X

/* f(wo, wi) |cos theta_i| [1/sr] of any lobe. wo, wi: unit, away from the surface. An unknown kind gives 0. */
LOBE_FN lobe_rgb lobe_bsdf_eval(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 wi)
{
	switch (b.kind) {
#define LOBE_X(NAME, name, value)                                                                                      \
	case LOBE_KIND_##NAME:                                                                                         \
		return lobe_##name##_eval(b.as.name, wo, wi);
#include "lobes/lobes.def"
#undef LOBE_X
	default:
		return lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
	}
}

/* Density [1/sr] with which lobe_bsdf_sample(b, wo, .) returns wi. */
LOBE_FN lobe_real lobe_bsdf_pdf(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 wi)
{
	switch (b.kind) {
#define LOBE_X(NAME, name, value)                                                                                      \
	case LOBE_KIND_##NAME:                                                                                         \
		return lobe_##name##_pdf(b.as.name, wo, wi);
#include "lobes/lobes.def"
#undef LOBE_X
	default:
		return LOBE_R(0.0);
	}
}

/* lobe_bsdf_eval and lobe_bsdf_pdf of one pair of directions, which share most of their work: what multiple importance
 * sampling asks of a light's direction. The same bits as each alone. */
typedef struct {
	lobe_rgb f;
	lobe_real pdf;
} lobe_bsdf_value;

LOBE_FN lobe_bsdf_value lobe_bsdf_eval_pdf(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 wi)
{
	lobe_bsdf_value v;
	switch (b.kind) {
#define LOBE_X(NAME, name, value)                                                                                      \
	case LOBE_KIND_##NAME:                                                                                         \
		v.f = lobe_##name##_eval(b.as.name, wo, wi);                                                           \
		v.pdf = lobe_##name##_pdf(b.as.name, wo, wi);                                                          \
		return v;
#include "lobes/lobes.def"
#undef LOBE_X
	default:
		v.f = lobe_rgb_make(LOBE_R(0.0), LOBE_R(0.0), LOBE_R(0.0));
		v.pdf = LOBE_R(0.0);
		return v;
	}
}

/* A direction wi for wo from u, each of its three numbers in [0,1). */
LOBE_FN lobe_sample lobe_bsdf_sample(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 u)
{
	switch (b.kind) {
#define LOBE_X(NAME, name, value)                                                                                      \
	case LOBE_KIND_##NAME:                                                                                         \
		return lobe_##name##_sample(b.as.name, wo, u);
#include "lobes/lobes.def"
#undef LOBE_X
	default:
		return lobe_sample_none();
	}
}

#endif
