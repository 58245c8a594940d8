/* iridescent_conductor.h - a rough metal under a thin film: tempered steel, anodised titanium.
 *
 * GGX microsurface (microfacet/reflection.h, ggx.h) whose Fresnel term is that of the film on the metal in RGB
 * (core/thin_film.h: Belcour and Barla 2017). Opaque and reciprocal. At thickness 0, or with film index 1, it is
 * ggx_conductor to rounding. Light that would scatter more than once on the microsurface is lost. */
#ifndef LOBE_LOBES_IRIDESCENT_CONDUCTOR_H
#define LOBE_LOBES_IRIDESCENT_CONDUCTOR_H

#include "../core/thin_film.h"
#include "../microfacet/reflection.h"

/* stretch: widths along tangent and bitangent. eta, k: complex index of the metal per channel. film: its thickness
 * [nm], in [0, 1e6], and its index, in [1, 1000]. All indices are over that of the outside. */
typedef struct {
	lobe_stretch stretch;
	lobe_rgb eta, k;
	lobe_film film;
} lobe_iridescent_conductor;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. */
LOBE_FN lobe_iridescent_conductor lobe_iridescent_conductor_make(lobe_real alpha_x, lobe_real alpha_y,
								 lobe_real thickness, lobe_real film_index,
								 lobe_rgb eta, lobe_rgb k)
{
	lobe_iridescent_conductor p;
	p.stretch = lobe_stretch_make(alpha_x, alpha_y);
	p.eta = eta;
	p.k = k;
	p.film = lobe_film_make(thickness, film_index);
	return p;
}

LOBE_FN lobe_real lobe_iridescent_conductor_params(lobe_iridescent_conductor p)
{
	return p.stretch.norm + p.eta.r + p.eta.g + p.eta.b + p.k.r + p.k.g + p.k.b + p.film.thickness + p.film.index;
}

/* h2: |wo + wi|^2. */
LOBE_FN lobe_rgb lobe_iridescent_conductor_fresnel(lobe_iridescent_conductor p, lobe_real h2)
{
	const lobe_real c = lobe_reflection_cosine(h2);
	return lobe_thin_film_conductor_rgb(c, p.film, p.eta, p.k);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_iridescent_conductor_eval(lobe_iridescent_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_real params = lobe_iridescent_conductor_params(p);
	const lobe_reflection_eval r = lobe_reflection_eval_at(LOBE_NDF_GGX, p.stretch, params, wo, wi);
	return lobe_reflection_tint(r, lobe_iridescent_conductor_fresnel(p, r.h2));
}

/* [1/sr] */
LOBE_FN lobe_real lobe_iridescent_conductor_pdf(lobe_iridescent_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_reflection_pdf(LOBE_NDF_GGX, p.stretch, lobe_iridescent_conductor_params(p), wo, wi);
}

/* Uses u.x and u.y. No sample when the facet reflects below the surface. */
LOBE_FN lobe_sample lobe_iridescent_conductor_sample(lobe_iridescent_conductor p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_real params = lobe_iridescent_conductor_params(p);
	const lobe_reflection_sample r = lobe_reflection_sample_at(LOBE_NDF_GGX, p.stretch, params, wo, u);
	return lobe_reflection_tint_sample(r, lobe_iridescent_conductor_fresnel(p, r.h2));
}

#endif
