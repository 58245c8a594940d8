/* cases_make.h - a lobe from the list of numbers that its make function takes, in the order of its arguments.
 *
 * Compiled twice: in single precision by cases.c, in double by double.c. A lobe of lobes.def without a function here
 * does not compile. */
#ifndef LOBE_TESTS_CASES_MAKE_H
#define LOBE_TESTS_CASES_MAKE_H

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
