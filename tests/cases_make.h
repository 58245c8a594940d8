/* cases_make.h - a lobe from the list of numbers that its make function takes, in the order of its arguments.
 *
 * Compiled twice: in single precision by cases.c, in double by double.c. A lobe of lobes.def without a function here
 * does not compile. */
#ifndef LOBE_TESTS_CASES_MAKE_H
#define LOBE_TESTS_CASES_MAKE_H

#include "distribution_tables.h"
#include "lobe/shading.h"

static lobe_rgb make_rgb(const double *p) { return lobe_rgb_make((lobe_real)p[0], (lobe_real)p[1], (lobe_real)p[2]); }

/* r, g, b */
static lobe_lambert make_lambert(const double *p) { return lobe_lambert_make(make_rgb(p)); }

/* alpha_x, alpha_y, n.rgb, k.rgb */
static lobe_ggx_conductor make_ggx_conductor(const double *p)
{
	return lobe_ggx_conductor_make((lobe_real)p[0], (lobe_real)p[1], make_rgb(p + 2), make_rgb(p + 5));
}

/* alpha_x, alpha_y, eta, transport */
static lobe_ggx_dielectric make_ggx_dielectric(const double *p)
{
	return lobe_ggx_dielectric_transport(
		lobe_ggx_dielectric_make((lobe_real)p[0], (lobe_real)p[1], (lobe_real)p[2]), (lobe_uint)p[3]);
}

/* The same arguments. */
static lobe_beckmann_conductor make_beckmann_conductor(const double *p)
{
	return lobe_beckmann_conductor_make((lobe_real)p[0], (lobe_real)p[1], make_rgb(p + 2), make_rgb(p + 5));
}

static lobe_beckmann_dielectric make_beckmann_dielectric(const double *p)
{
	return lobe_beckmann_dielectric_transport(
		lobe_beckmann_dielectric_make((lobe_real)p[0], (lobe_real)p[1], (lobe_real)p[2]), (lobe_uint)p[3]);
}

/* alpha_x, alpha_y, f0.rgb, f90.rgb */
static lobe_ggx_schlick make_ggx_schlick(const double *p)
{
	return lobe_ggx_schlick_make((lobe_real)p[0], (lobe_real)p[1], make_rgb(p + 2), make_rgb(p + 5));
}

/* r, g, b */
static lobe_mirror make_mirror(const double *p) { return lobe_mirror_make(make_rgb(p)); }

/* n.rgb, k.rgb */
static lobe_smooth_conductor make_smooth_conductor(const double *p)
{
	return lobe_smooth_conductor_make(make_rgb(p), make_rgb(p + 3));
}

/* eta, transport */
static lobe_smooth_dielectric make_smooth_dielectric(const double *p)
{
	return lobe_smooth_dielectric_transport(lobe_smooth_dielectric_make((lobe_real)p[0]), (lobe_uint)p[1]);
}

/* eta */
static lobe_thin_dielectric make_thin_dielectric(const double *p) { return lobe_thin_dielectric_make((lobe_real)p[0]); }

/* alpha_x, alpha_y, thickness, film index, n.rgb, k.rgb */
static lobe_iridescent_conductor make_iridescent_conductor(const double *p)
{
	return lobe_iridescent_conductor_make((lobe_real)p[0], (lobe_real)p[1], (lobe_real)p[2], (lobe_real)p[3],
					      make_rgb(p + 4), make_rgb(p + 7));
}

/* alpha_x, alpha_y, thickness, film index, eta, transport */
static lobe_iridescent_dielectric make_iridescent_dielectric(const double *p)
{
	return lobe_iridescent_dielectric_transport(lobe_iridescent_dielectric_make((lobe_real)p[0], (lobe_real)p[1],
										    (lobe_real)p[2], (lobe_real)p[3],
										    (lobe_real)p[4]),
						    (lobe_uint)p[5]);
}

/* What the comparison lobes have in common, from p[8] on: distribution, exponent, width; map as xy, yx, mean slope x, y
 * (xx and yy are alpha_x and alpha_y); masking, joint, across; strategy, Fresnel model and its c and d. */
static lobe_microsurface make_microsurface(const double *p)
{
	const distribution_table t = distribution_table_of((lobe_uint)p[8], p[9], p[10]);
	lobe_distribution d = lobe_distribution_make((lobe_uint)p[8]);
	d.exponent = (lobe_real)p[9];
	d.width = (lobe_real)p[10];
	d.norm = (lobe_real)t.norm;
	d.table = lobe_table_at(t.table);
	const lobe_linear map = lobe_linear_make((lobe_real)p[0], (lobe_real)p[11], (lobe_real)p[12], (lobe_real)p[1],
						 (lobe_real)p[13], (lobe_real)p[14]);
	return lobe_microsurface_joint(lobe_microsurface_masking(lobe_microsurface_make(d, map), (lobe_uint)p[15]),
				       (lobe_uint)p[16], (lobe_uint)p[17]);
}

/* alpha_x, alpha_y, a.rgb, b.rgb of the Fresnel model, and as above */
static lobe_microfacet_conductor make_microfacet_conductor(const double *p)
{
	const lobe_fresnel_model f = lobe_fresnel_model_make((lobe_uint)p[19], make_rgb(p + 2), make_rgb(p + 5),
							     (lobe_real)p[20], (lobe_real)p[21]);
	return lobe_microfacet_conductor_make(make_microsurface(p), f, (lobe_uint)p[18]);
}

/* alpha_x, alpha_y, eta, transport, a.rgb, b of the Fresnel model, and as above */
static lobe_microfacet_dielectric make_microfacet_dielectric(const double *p)
{
	const lobe_rgb grazing = lobe_rgb_make((lobe_real)p[7], (lobe_real)p[7], (lobe_real)p[7]);
	const lobe_fresnel_model f = lobe_fresnel_model_make((lobe_uint)p[19], make_rgb(p + 4), grazing,
							     (lobe_real)p[20], (lobe_real)p[21]);
	return lobe_microfacet_dielectric_transport(
		lobe_microfacet_dielectric_make(make_microsurface(p), f, (lobe_real)p[2], (lobe_uint)p[18]),
		(lobe_uint)p[3]);
}

/* alpha_x, alpha_y, r, g, b, and as above but for strategy and Fresnel model */
static lobe_microfacet_diffuse make_microfacet_diffuse(const double *p)
{
	return lobe_microfacet_diffuse_make(make_microsurface(p), make_rgb(p + 2));
}

static lobe_bsdf make_bsdf(uint32_t kind, const double *p)
{
	lobe_bsdf none;
	switch (kind) {
#define LOBE_X(NAME, name, value)                                                                                      \
	case LOBE_KIND_##NAME:                                                                                         \
		return lobe_bsdf_from_##name(make_##name(p));
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	default:
		memset(&none, 0, sizeof none);
		return none;
	}
}

#endif
