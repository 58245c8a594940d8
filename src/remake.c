/* remake.c - a material as its make function would make it from what it holds: where the two differ, a field was
 * changed after make, or was never prepared. */
#include <math.h>

#include "internal.h"

static lobe_microsurface remake_surface(lobe_microsurface s)
{
	const lobe_microsurface made = lobe_microsurface_make(s.distribution, s.map);
	return lobe_microsurface_joint(lobe_microsurface_masking(made, s.masking), s.joint, s.across);
}

/* clang-format off */
#define REMAKE(name) static lobe_##name remake_##name(lobe_##name p)
REMAKE(lambert) { return lobe_lambert_make(p.reflectance); }
REMAKE(ggx_conductor) { return lobe_ggx_conductor_make(p.stretch.alpha_x, p.stretch.alpha_y, p.eta, p.k); }
REMAKE(ggx_dielectric)
{
	return lobe_ggx_dielectric_transport(lobe_ggx_dielectric_make(p.stretch.alpha_x, p.stretch.alpha_y, p.eta), p.transport);
}
REMAKE(beckmann_conductor) { return lobe_beckmann_conductor_make(p.stretch.alpha_x, p.stretch.alpha_y, p.eta, p.k); }
REMAKE(beckmann_dielectric)
{
	return lobe_beckmann_dielectric_transport(
		lobe_beckmann_dielectric_make(p.stretch.alpha_x, p.stretch.alpha_y, p.eta), p.transport);
}
REMAKE(ggx_schlick) { return lobe_ggx_schlick_make(p.stretch.alpha_x, p.stretch.alpha_y, p.f0, p.f90); }
REMAKE(mirror) { return lobe_mirror_make(p.reflectance); }
REMAKE(smooth_conductor) { return lobe_smooth_conductor_make(p.eta, p.k); }
REMAKE(smooth_dielectric) { return lobe_smooth_dielectric_transport(lobe_smooth_dielectric_make(p.eta), p.transport); }
REMAKE(thin_dielectric) { return lobe_thin_dielectric_make(p.eta); }
REMAKE(iridescent_conductor)
{
	return lobe_iridescent_conductor_make(p.stretch.alpha_x, p.stretch.alpha_y, p.film.thickness, p.film.index, p.eta, p.k);
}
/* clang-format on */

REMAKE(iridescent_dielectric)
{
	const lobe_rough_dielectric made =
		lobe_rough_dielectric_make(p.glass.stretch.alpha_x, p.glass.stretch.alpha_y, p.glass.eta);
	p.glass = lobe_rough_dielectric_transport(made, p.glass.transport);
	return p;
}

REMAKE(microfacet_conductor)
{
	p.surface = remake_surface(p.surface);
	return p;
}

REMAKE(microfacet_dielectric)
{
	const lobe_microfacet_dielectric made =
		lobe_microfacet_dielectric_make(remake_surface(p.surface), p.fresnel, p.eta, p.strategy);
	return lobe_microfacet_dielectric_transport(made, p.transport);
}

REMAKE(microfacet_diffuse)
{
	p.surface = remake_surface(p.surface);
	return p;
}

lobe_bsdf lobe_remake(const lobe_bsdf *material)
{
	lobe_bsdf b = *material;
	switch (material->kind) {
#define LOBE_X(NAME, name, kind)                                                                                       \
	case kind:                                                                                                     \
		b.as.name = remake_##name(b.as.name);                                                                  \
		break;
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	default:
		break;
	}
	return b;
}

/* --- linear maps ------------------------------------------------------------------------------------------------- */

/* Several functions make one, with roundings of their own, so its inverse is told by their product. a b + c d = sum,
 * but for single precision. */
static int is_sum(double a, double b, double c, double d, double sum)
{
	return fabs(a * b + c * d - sum) <= 1e-5 * (fabs(a * b) + fabs(c * d) + fabs(sum));
}

static int map_is_whole(lobe_linear m)
{
	const double xx = (double)m.xx, xy = (double)m.xy, yx = (double)m.yx, yy = (double)m.yy;
	const double det = 0.318309886183790671538 / (double)m.norm;
	const double signed_det = xx * yy < xy * yx ? -det : det;
	return is_sum(xx, (double)m.ixx, xy, (double)m.iyx, 1.0) && is_sum(xx, (double)m.ixy, xy, (double)m.iyy, 0.0) &&
	       is_sum(yx, (double)m.ixx, yy, (double)m.iyx, 0.0) && is_sum(yx, (double)m.ixy, yy, (double)m.iyy, 1.0) &&
	       is_sum(xx, yy, -xy, yx, signed_det);
}

int lobe_map_is_whole(const lobe_bsdf *material)
{
	switch (material->kind) {
#define LOBE_X(NAME, name, kind)
#define LOBE_X_TABLED(NAME, name, kind)                                                                                \
	case kind:                                                                                                     \
		return map_is_whole(material->as.name.surface.map);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	default:
		return 1;
	}
}
