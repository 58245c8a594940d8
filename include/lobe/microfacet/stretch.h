/* stretch.h - a microsurface stretched by alpha_x along the tangent and alpha_y along the bitangent.
 *
 * The Jacobian is all one needs (Heitz 2014, section 5.3; Atanasov et al. 2022, "Efficient microfacet
 * transformations"): slopes scale by alpha, directions and normals of the stretched surface turn into those of the
 * isotropic surface of width 1 by the maps below, and everything else - D, masking, projected area, sampling - is that
 * surface's (ggx.h, beckmann.h). Maps are linear and nothing is normalised: what the length does is undone by whoever
 * uses it.
 *
 * Production lobes use this. Rotation, correlated slopes and a tilted mean plane are linear.h, of which this is the
 * special case with a third of the arithmetic. */
#ifndef LOBE_MICROFACET_STRETCH_H
#define LOBE_MICROFACET_STRETCH_H

#include "../core/constants.h"
#include "../core/vec.h"

/* Narrowest microsurface: make functions clamp alpha to [LOBE_ALPHA_MIN, 1]. */
#define LOBE_ALPHA_MIN LOBE_R(1e-4)

LOBE_FN lobe_real lobe_clamp_alpha(lobe_real alpha) { return lobe_clamp(alpha, LOBE_ALPHA_MIN, LOBE_R(1.0)); }

/* alpha_x, alpha_y: widths in [LOBE_ALPHA_MIN, 1]. The rest is prepared from them. */
typedef struct {
	lobe_real alpha_x, alpha_y;
	lobe_real inv_alpha_x, inv_alpha_y;
	lobe_real norm; /* 1/(pi alpha_x alpha_y) */
} lobe_stretch;

/* Clamps the widths to their domain; a NaN stays NaN. */
LOBE_FN lobe_stretch lobe_stretch_make(lobe_real alpha_x, lobe_real alpha_y)
{
	lobe_stretch s;
	s.alpha_x = lobe_clamp_alpha(alpha_x);
	s.alpha_y = lobe_clamp_alpha(alpha_y);
	s.inv_alpha_x = LOBE_R(1.0) / s.alpha_x;
	s.inv_alpha_y = LOBE_R(1.0) / s.alpha_y;
	s.norm = LOBE_INV_PI * s.inv_alpha_x * s.inv_alpha_y;
	return s;
}

/* The square of the lesser width. */
LOBE_FN lobe_real lobe_stretch_narrow2(lobe_stretch s)
{
	const lobe_real narrow = lobe_min(s.alpha_x, s.alpha_y);
	return narrow * narrow;
}

/* The direction in which the surface of width 1 is seen, when the stretched one is seen from w. */
LOBE_FN lobe_vec3 lobe_stretch_direction(lobe_stretch s, lobe_vec3 w)
{
	return lobe_vec3_make(s.alpha_x * w.x, s.alpha_y * w.y, w.z);
}

/* The normal on the surface of width 1 that the stretch turns into h. */
LOBE_FN lobe_vec3 lobe_stretch_facet(lobe_stretch s, lobe_vec3 h)
{
	return lobe_vec3_make(s.inv_alpha_x * h.x, s.inv_alpha_y * h.y, h.z);
}

/* The same of squares of components, of which lengths are sums. */
LOBE_FN lobe_vec3 lobe_stretch_facet_squares(lobe_stretch s, lobe_vec3 h2)
{
	return lobe_vec3_make(s.inv_alpha_x * s.inv_alpha_x * h2.x, s.inv_alpha_y * s.inv_alpha_y * h2.y, h2.z);
}

/* The normal that m, one of the surface of width 1, turns into. */
LOBE_FN lobe_vec3 lobe_stretch_normal(lobe_stretch s, lobe_vec3 m)
{
	return lobe_vec3_make(s.alpha_x * m.x, s.alpha_y * m.y, m.z);
}

#endif
