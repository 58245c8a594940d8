/* ggx_conductor.h - a rough metal: GGX microsurface, exact conductor Fresnel, single scattering.
 *
 * Cook and Torrance 1982 with the distribution of Walter et al. 2007, the height-correlated masking and shadowing of
 * Heitz 2014 (eq. 99) and visible-normal sampling by spherical caps (Dupuy and Benyoub 2023):
 *	f = F D G2/(4 z_o z_i),   pdf = D/(4 sigma(wo)),   weight = F G2/G1(wo)
 * Opaque: 0 when either direction is at or below the surface. Reciprocal. Light that would scatter more than once on the
 * microsurface is lost (at alpha 1 up to 69 %). */
#ifndef LOBE_LOBES_GGX_CONDUCTOR_H
#define LOBE_LOBES_GGX_CONDUCTOR_H

#include "../core/event.h"
#include "../core/fresnel.h"
#include "../microfacet/ggx.h"

/* ggx: widths along tangent and bitangent. eta, k: complex index n + ik per channel over that of the outside, eta in
 * [1/1000, 1000], k in [0, 1000] (core/optics.h has those of real metals). */
typedef struct {
	lobe_ggx ggx;
	lobe_rgb eta, k;
} lobe_ggx_conductor;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. */
LOBE_FN lobe_ggx_conductor lobe_ggx_conductor_make(lobe_real alpha_x, lobe_real alpha_y, lobe_rgb eta, lobe_rgb k)
{
	lobe_ggx_conductor p;
	p.ggx = lobe_ggx_make(alpha_x, alpha_y);
	p.eta = eta;
	p.k = k;
	return p;
}

/* D(h)/4 for the half vector H = wo + wi, h2 = |H|^2. NaN for H = 0. */
LOBE_FN lobe_real lobe_ggx_conductor_quarter_d(lobe_ggx_conductor p, lobe_vec3 h, lobe_real h2)
{
	const lobe_real x = LOBE_R(0.5) * h2 * lobe_ggx_inv_q(p.ggx, h);
	return p.ggx.norm * x * x;
}

/* Fresnel at o.h = |H|/2, which for unit directions does not cancel as the dot product does when both graze. */
LOBE_FN lobe_rgb lobe_ggx_conductor_fresnel(lobe_ggx_conductor p, lobe_real h2)
{
	return lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle_from_cos2(LOBE_R(0.25) * h2), p.eta, p.k);
}

/* Both directions above the surface, every parameter a number (out of a loop over one material that is taken once) and
 * the density x too; x is then >= 0. */
LOBE_FN int lobe_ggx_conductor_ok(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 wi, lobe_real x)
{
	const lobe_real sum = p.ggx.norm + p.eta.r + p.eta.g + p.eta.b + p.k.r + p.k.g + p.k.b;
	const int numbers = sum - sum == LOBE_R(0.0);
	return numbers & (lobe_min(wo.z, wi.z) > LOBE_R(0.0)) & (x <= LOBE_REAL_MAX);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_ggx_conductor_eval(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_vec3 h = lobe_vec3_add(wo, wi);
	const lobe_real h2 = lobe_dot(h, h);
	const lobe_real g = lobe_ggx_g2_over_cos(wo.z, lobe_ggx_t(p.ggx, wo), wi.z, lobe_ggx_t(p.ggx, wi));
	const lobe_real dg = lobe_ggx_conductor_quarter_d(p, h, h2) * g;
	return lobe_rgb_select(lobe_ggx_conductor_ok(p, wo, wi, dg),
			       lobe_rgb_scale(lobe_ggx_conductor_fresnel(p, h2), dg));
}

/* [1/sr] */
LOBE_FN lobe_real lobe_ggx_conductor_pdf(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_vec3 h = lobe_vec3_add(wo, wi);
	const lobe_real quarter_d = lobe_ggx_conductor_quarter_d(p, h, lobe_dot(h, h));
	const lobe_real two_sigma = wo.z + lobe_ggx_t(p.ggx, wo);
	const lobe_real pdf = (quarter_d + quarter_d) / two_sigma;
	const int ok = lobe_ggx_conductor_ok(p, wo, wi, pdf);
	return ok ? pdf : LOBE_R(0.0);
}

/* Uses u.x and u.y. No sample when the facet reflects below the surface. */
LOBE_FN lobe_sample lobe_ggx_conductor_sample(lobe_ggx_conductor p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_real t_o = lobe_ggx_t(p.ggx, wo);
	const lobe_vec3 m = lobe_ggx_sample_visible(p.ggx, wo, t_o, lobe_vec2_make(u.x, u.y));
	const lobe_vec3 wi = lobe_reflect(wo, m, lobe_dot(wo, m) / lobe_dot(m, m));
	const lobe_real pdf = lobe_ggx_conductor_pdf(p, wo, wi);
	const lobe_vec3 h = lobe_vec3_add(wo, wi);
	const lobe_rgb f = lobe_ggx_conductor_fresnel(p, lobe_dot(h, h));
	const lobe_real two_sigma = wo.z + t_o;
	const lobe_real g2_over_g1 =
		LOBE_R(0.5) * two_sigma * lobe_ggx_g2_over_cos(wo.z, t_o, wi.z, lobe_ggx_t(p.ggx, wi));
	return lobe_sample_select(pdf > LOBE_R(0.0), wi, lobe_rgb_scale(f, lobe_finite_or_zero(g2_over_g1)), pdf,
				  LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY);
}

#endif
