/* stability_textbook.h - lobes as their papers print them, in one wide type. A template without a guard: included once
 * for each type by stability_reference.c, with
 *
 *	REAL			the type
 *	REAL_(name)		name with the type's suffix
 *	REAL_SQRT, REAL_EXP, REAL_ERFC, REAL_SIN, REAL_COS, REAL_FABS, REAL_PI
 *
 * Nothing here is the library's code or algebra: normalised half vectors, slopes, tangents, Lambda, complex roots, and
 * cancellation wherever the papers have it, which is what the type's digits are for. tests/textbook.h is the same idea
 * in double, for what does not cancel.
 *
 * Directions come as they are, not quite unit: the half vector is normalised, as the papers say, they are not. So what
 * a rounding of a direction does to the answer, its length included, is a property of these formulas that
 * stability_measure.c finds by asking them again. Cosines above 1 count as 1, but to a rough metal, whose formula goes
 * on; of a reflection the cosine to the facet is the mean of o.m and i.m, which for a pair of directions of not quite
 * the same length are not one, and at grazing angles not even near. */

#include "stability_textbook_facets.h"

/* --- the lobes: parameters as in tests/cases_make.h --------------------------------------------------------------- */

static REAL_(surface) REAL_(surface_of)(lobe_uint kind, const REAL *p)
{
	const int linear = kind == LOBE_KIND_MICROFACET_CONDUCTOR || kind == LOBE_KIND_MICROFACET_DIELECTRIC;
	REAL_(surface) s;
	s.xx = p[0];
	s.yy = p[1];
	s.xy = linear ? p[11] : 0;
	s.yx = linear ? p[12] : 0;
	s.mean_x = linear ? p[13] : 0;
	s.mean_y = linear ? p[14] : 0;
	s.beckmann = kind == LOBE_KIND_BECKMANN_CONDUCTOR || kind == LOBE_KIND_BECKMANN_DIELECTRIC ||
		     (linear && p[8] == LOBE_NDF_BECKMANN);
	return s;
}

static REAL REAL_(at_most_1)(REAL c) { return c > 1 ? 1 : c; }

static REAL REAL_(opaque)(stability_question q, const REAL *o, const REAL *i, const REAL *p)
{
	const int linear = q.kind == LOBE_KIND_MICROFACET_CONDUCTOR;
	const REAL_(surface) s = REAL_(surface_of)(q.kind, p);
	const REAL k = s.beckmann || linear ? 1 : REAL_(bounded)(s, o);
	const REAL_(facet) f = REAL_(reflection)(s, o, i, linear && p[16] == LOBE_JOINT_SEPARABLE, k);
	const REAL a = p[2 + q.channel], b = p[5 + q.channel];
	if (!f.there)
		return 0;
	if (q.verb == STABILITY_PDF)
		return f.pdf;
	if (q.white)
		return q.verb == STABILITY_EVAL ? f.eval : f.weight;
	return (q.verb == STABILITY_EVAL ? f.eval : f.weight) *
	       (q.kind == LOBE_KIND_GGX_SCHLICK ? REAL_(schlick)(REAL_(at_most_1)(f.cosine), a, b)
						: REAL_(fresnel_conductor)(f.cosine, a, b));
}

/* From below all is seen through the point, and the indices change places. */
static REAL REAL_(glass)(stability_question q, const REAL *wo, const REAL *wi, const REAL *p)
{
	const int linear = q.kind == LOBE_KIND_MICROFACET_DIELECTRIC;
	const REAL_(surface) s = REAL_(surface_of)(q.kind, p);
	const REAL side = wo[2] > 0 ? 1 : -1, e = wo[2] > 0 ? p[2] : 1 / p[2];
	const REAL scale = p[3] == LOBE_TRANSPORT_RADIANCE ? 1 / (e * e) : 1;
	REAL o[3], i[3];
	for (int k = 0; k < 3; k++) {
		o[k] = side * wo[k];
		i[k] = side * wi[k];
	}
	/* Unmasked, through a facet that no one knows any more. */
	if (q.straight)
		return q.verb == STABILITY_WEIGHT ? scale : 0;
	if (i[2] > 0) {
		const REAL_(facet) f = REAL_(reflection)(s, o, i, linear && p[16] == LOBE_JOINT_SEPARABLE, 1);
		const REAL share = !f.there  ? 0
				   : q.white ? 1
					     : REAL_(fresnel)(REAL_(at_most_1)(f.cosine + (REAL)q.nudge), e);
		return q.verb == STABILITY_WEIGHT ? f.weight : share * (q.verb == STABILITY_PDF ? f.pdf : f.eval);
	}
	if (q.delta)
		return 0;
	const REAL_(facet) f = REAL_(refraction)(s, o, i, e, 1);
	const REAL share = !f.there  ? 0
			   : q.white ? 1
				     : REAL_(transmittance)(REAL_(at_most_1)(f.cosine + (REAL)q.nudge), e);
	return q.verb == STABILITY_WEIGHT ? scale * f.weight
	       : q.verb == STABILITY_PDF  ? share * f.pdf
					  : share * scale * f.eval;
}

/* Delta lobes: q.reflects is the sample's event. pdf and weight of it. */
static REAL REAL_(smooth)(stability_question q, const REAL *wo, const REAL *p)
{
	const REAL z = REAL_FABS(wo[2]), c = REAL_(at_most_1)(z);
	if (q.verb == STABILITY_EVAL || !(z > 0))
		return 0;
	if (q.white)
		return 1;
	switch (q.kind) {
	case LOBE_KIND_MIRROR:
		return q.verb == STABILITY_PDF ? 1 : p[q.channel];
	case LOBE_KIND_SMOOTH_CONDUCTOR:
		return q.verb == STABILITY_PDF ? 1 : REAL_(fresnel_conductor)(c, p[q.channel], p[3 + q.channel]);
	case LOBE_KIND_SMOOTH_DIELECTRIC: {
		const REAL e = wo[2] > 0 ? p[0] : 1 / p[0];
		if (q.verb == STABILITY_WEIGHT)
			return !q.reflects && p[1] == LOBE_TRANSPORT_RADIANCE ? 1 / (e * e) : 1;
		return q.reflects ? REAL_(fresnel)(c, e) : REAL_(transmittance)(c, e);
	}
	default: { /* a pane: both interfaces and all between them */
		const REAL f = REAL_(fresnel)(c, p[0]);
		if (q.verb == STABILITY_WEIGHT)
			return 1;
		return q.reflects ? 2 * f / (1 + f) : (1 - f) / (1 + f);
	}
	}
}

static REAL REAL_(lobe)(stability_question q, const REAL *wo, const REAL *wi, const REAL *p)
{
	switch (q.kind) {
	case LOBE_KIND_LAMBERT:
		if (!(wo[2] * wi[2] > 0))
			return 0;
		return q.verb == STABILITY_WEIGHT
			       ? p[q.channel]
			       : REAL_FABS(wi[2]) / REAL_PI * (q.verb == STABILITY_PDF ? 1 : p[q.channel]);
	case LOBE_KIND_GGX_CONDUCTOR:
	case LOBE_KIND_BECKMANN_CONDUCTOR:
	case LOBE_KIND_GGX_SCHLICK:
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return REAL_(opaque)(q, wo, wi, p);
	case LOBE_KIND_GGX_DIELECTRIC:
	case LOBE_KIND_BECKMANN_DIELECTRIC:
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return REAL_(glass)(q, wo, wi, p);
	default:
		return REAL_(smooth)(q, wo, p);
	}
}

/* --- where a sample goes: component q.channel of wi --------------------------------------------------------------- */

/* Dupuy and Benyoub 2023: a point of the spherical cap that o, stretched, sees, plus o, stretched back. k: how much of
 * the cap below the horizon. The point moved by dx and dy. */
static void REAL_(visible_normal)(REAL_(surface) s, const REAL *o, REAL k, const REAL *u, REAL dx, REAL dy, REAL m[3])
{
	REAL v[3] = {s.xx * o[0], s.yy * o[1], o[2]};
	const REAL length = REAL_SQRT(REAL_(dot)(v, v));
	for (int j = 0; j < 3; j++)
		v[j] /= length;
	const REAL phi = 2 * REAL_PI * u[0], z = (1 - u[1]) * (1 + k * v[2]) - k * v[2], r = REAL_SQRT(1 - z * z);
	m[0] = s.xx * (r * REAL_COS(phi) + v[0] + dx);
	m[1] = s.yy * (r * REAL_SIN(phi) + v[1] + dy);
	m[2] = z + v[2];
	const REAL size = REAL_SQRT(REAL_(dot)(m, m));
	for (int j = 0; j < 3; j++)
		m[j] /= size;
}

static void REAL_(mirrored)(const REAL *o, const REAL *m, REAL c, REAL i[3])
{
	for (int k = 0; k < 3; k++)
		i[k] = 2 * c * m[k] - o[k];
}

/* Snell's law; Walter et al. 2007, eq. 40. Made unit where the library does: towards the thinner side. */
static void REAL_(refracted)(const REAL *o, const REAL *m, REAL e, REAL i[3])
{
	const REAL c = REAL_(at_most_1)(REAL_(dot)(o, m)), g2 = e * e - 1 + c * c, g = g2 > 0 ? REAL_SQRT(g2) : 0;
	for (int k = 0; k < 3; k++)
		i[k] = ((c - g) * m[k] - o[k]) / e;
	const REAL length = REAL_SQRT(REAL_(dot)(i, i));
	for (int k = 0; k < 3 && e < 1; k++)
		i[k] /= length;
}

/* Malley's and Shirley and Chiu's (1997) maps, of the middle of u's cell. */
static void REAL_(cosine)(const REAL *wo, const REAL *u, REAL i[3])
{
	const REAL cell = (REAL)(0x1p-24), a = 2 * u[0] - 1 + cell, b = 2 * u[1] - 1 + cell;
	const int wide = REAL_FABS(a) > REAL_FABS(b);
	const REAL r = wide ? a : b, phi = r == 0 ? 0 : wide ? REAL_PI / 4 * b / a : REAL_PI / 2 - REAL_PI / 4 * a / b;
	i[0] = r * REAL_COS(phi);
	i[1] = r * REAL_SIN(phi);
	i[2] = REAL_SQRT(1 - r * r) * (wo[2] < 0 ? -1 : 1);
}

static REAL REAL_(direction)(stability_question q, const REAL *wo, const REAL *u, const REAL *p)
{
	const REAL side = wo[2] > 0 ? 1 : -1, up[3] = {0, 0, 1};
	const REAL_(surface) s = REAL_(surface_of)(q.kind, p);
	const REAL o[3] = {wo[0], wo[1], side * wo[2]}, dx = q.white ? 0 : (REAL)q.nudge,
		   dy = q.white ? (REAL)q.nudge : 0;
	REAL i[3], m[3];
	switch (q.kind) {
	case LOBE_KIND_LAMBERT:
		REAL_(cosine)(wo, u, i);
		return i[q.channel];
	case LOBE_KIND_GGX_CONDUCTOR:
	case LOBE_KIND_GGX_SCHLICK:
		REAL_(visible_normal)(s, o, REAL_(bounded)(s, o), u, dx, dy, m);
		REAL_(mirrored)(o, m, REAL_(dot)(o, m), i);
		return i[q.channel];
	case LOBE_KIND_GGX_DIELECTRIC:
		REAL_(visible_normal)(s, o, 1, u, dx, dy, m);
		if (q.reflects)
			REAL_(mirrored)(o, m, REAL_(at_most_1)(REAL_(dot)(o, m)), i);
		else
			REAL_(refracted)(o, m, wo[2] > 0 ? p[2] : 1 / p[2], i);
		return (q.channel == 2 ? side : 1) * i[q.channel];
	case LOBE_KIND_SMOOTH_DIELECTRIC:
		if (q.reflects)
			REAL_(mirrored)(o, up, o[2], i);
		else
			REAL_(refracted)(o, up, wo[2] > 0 ? p[0] : 1 / p[0], i);
		return (q.channel == 2 ? side : 1) * i[q.channel];
	case LOBE_KIND_THIN_DIELECTRIC:
		return q.channel == 2 ? (q.reflects ? wo[2] : -wo[2]) : -wo[q.channel];
	default:
		return q.channel == 2 ? wo[2] : -wo[q.channel];
	}
}
