/* dielectric.h - rough glass: reflection and refraction by a microsurface, from both sides. The body of
 * <ndf>_dielectric.
 *
 * Walter et al. 2007, "Microfacet models for refraction through rough surfaces", with visible-normal sampling (Heitz
 * and d'Eon 2014; Dupuy and Benyoub 2023): a visible facet m, then reflection with probability F(o.m), else refraction.
 *
 * Joint masking: height-correlated on one side (Heitz 2014 eq. 99). Across the surface G1(o) G1(i), as Walter: the
 * exact value for Smith's uncorrelated heights is Beta(1 + Lambda_o, 1 + Lambda_i), to which the product is nearer than
 * the 1/(1 + Lambda_o + Lambda_i) of one side; tests/test_lobes_energy.c measures the distance. Single scattering: what
 * would hit the microsurface again is lost.
 *
 * Near eta = 1. A facet turns light by about |eta - 1|, so refracted light spreads over alpha |eta - 1|. Where that is
 * below LOBE_DIELECTRIC_DELTA, 32 roundings of a unit vector, no float direction can resolve the lobe: refraction is
 * then an event of LOBE_EVENT_DELTA, still through the sampled facet, and is not masked: at eta = 1 light passes
 * straight with weight 1 and nothing is reflected. The price is a step where that begins, up to G1(wo), which
 * tests/test_lobes_index.c prints: this close to 1 the model's masking is loss that only multiple scattering would
 * return. */
#ifndef LOBE_MICROFACET_DIELECTRIC_H
#define LOBE_MICROFACET_DIELECTRIC_H

#include "../core/event.h"
#include "../core/fresnel.h"
#include "delta.h"
#include "ndf.h"
#include "stretch.h"

/* ndf: LOBE_NDF_*, a constant. stretch: widths along tangent and bitangent. eta: index below over index above the
 * surface, in [1/1000, 1000]; inv_eta is 1/eta. transport: LOBE_TRANSPORT_*. delta: refraction is a delta event. dense:
 * one of the indices is above twice the other, so that from within 1 - sin^2 is what is left of two numbers near 1. */
typedef struct {
	lobe_stretch stretch;
	lobe_real eta, inv_eta;
	lobe_uint transport, delta, dense;
} lobe_rough_dielectric;

/* Clamps alpha_x and alpha_y to [LOBE_ALPHA_MIN, 1]. Carries radiance; see lobe_rough_dielectric_transport. */
LOBE_FN lobe_rough_dielectric lobe_rough_dielectric_make(lobe_real alpha_x, lobe_real alpha_y, lobe_real eta)
{
	lobe_rough_dielectric p;
	p.stretch = lobe_stretch_make(alpha_x, alpha_y);
	p.eta = eta;
	p.inv_eta = LOBE_R(1.0) / eta + (eta - eta); /* NaN for an infinite eta, not 0 */
	p.transport = LOBE_TRANSPORT_RADIANCE;
	p.delta = (lobe_uint)lobe_dielectric_is_delta(lobe_max(p.stretch.alpha_x, p.stretch.alpha_y), eta);
	p.dense = (lobe_uint) !(lobe_max(eta, p.inv_eta) <= LOBE_R(2.0));
	return p;
}

/* The two, as far as the build does not know them (config.h). */
LOBE_FN int lobe_rough_dielectric_delta(lobe_rough_dielectric p)
{
	return LOBE_CHOSEN(p.delta, LOBE_ONLY_DELTA) != 0u;
}

LOBE_FN int lobe_rough_dielectric_dense(lobe_rough_dielectric p)
{
	return LOBE_CHOSEN(p.dense, LOBE_ONLY_DENSE) != 0u;
}

/* Most glass is neither delta nor dense: loops over one material leave out what only the rest needs (src/rows.c). */
LOBE_FN int lobe_rough_dielectric_is_plain(lobe_rough_dielectric p) { return (p.delta | p.dense) == 0u; }

/* One that is, as the compiler is to see it. */
LOBE_FN lobe_rough_dielectric lobe_rough_dielectric_plain(lobe_rough_dielectric p)
{
	p.delta = p.dense = 0u;
	return p;
}

/* The same surface for LOBE_TRANSPORT_RADIANCE or LOBE_TRANSPORT_IMPORTANCE (core/event.h). */
LOBE_FN lobe_rough_dielectric lobe_rough_dielectric_transport(lobe_rough_dielectric p, lobe_uint transport)
{
	p.transport = transport;
	return p;
}

LOBE_FN lobe_real lobe_rough_dielectric_t(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 w)
{
	return lobe_ndf_t(ndf, lobe_stretch_direction(p.stretch, w));
}

/* The interface seen from one side. at: without an angle yet; its eta is the far index over the near one, e. scale: of
 * what refraction carries. A refracted direction is -1/e times w + bend m, whose squared length is e^2 and what |w|^2
 * is above 1, w being a few ulp off. Where e < 1, which makes more of that, a step of Newton's method takes it off
 * again: 1/e less step times that excess. From within dense glass roundings count as well, up to 1e-4 where e is
 * 1/1000, and the length itself is taken: step |w + bend m|^2 + start. At e = 1 exactly -w is left. g2_first and
 * g2_second add up to k; where that is near -1, without the rounding that would be one of e. */
typedef struct {
	lobe_fresnel_interface at;
	lobe_real inv_e, scale, step, start, g2_first, g2_second;
} lobe_rough_dielectric_side;

LOBE_FN lobe_rough_dielectric_side lobe_rough_dielectric_side_make(lobe_real e, lobe_real inv_e, lobe_uint transport)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_real inv_e2 = inv_e * inv_e;
	lobe_rough_dielectric_side s;
	s.at = lobe_fresnel_interface_make(e);
	s.inv_e = inv_e;
	s.scale = transport == LOBE_TRANSPORT_RADIANCE ? inv_e2 : one;
	s.step = e < one ? LOBE_R(0.5) * inv_e2 * inv_e : zero;
	s.start = (e < one ? LOBE_R(-1.5) : -one) * inv_e;
	s.g2_first = s.at.eta2 < LOBE_R(0.5) ? -one : s.at.k;
	s.g2_second = s.at.eta2 < LOBE_R(0.5) ? s.at.eta2 : zero;
	return s;
}

/* With wo above. Each side is worked out for itself, which takes it out of loops over one material. t_o: lobe_ndf_t of
 * o. */
typedef struct {
	lobe_vec3 o;
	lobe_real t_o;
	lobe_rough_dielectric_side side;
} lobe_rough_dielectric_view;

LOBE_FN lobe_rough_dielectric_view lobe_rough_dielectric_view_make(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo)
{
	const int above = wo.z > LOBE_R(0.0);
	const lobe_rough_dielectric_side a = lobe_rough_dielectric_side_make(p.eta, p.inv_eta, p.transport);
	const lobe_rough_dielectric_side b = lobe_rough_dielectric_side_make(p.inv_eta, p.eta, p.transport);
	lobe_rough_dielectric_view v;
	v.o = lobe_vec3_make(wo.x, wo.y, lobe_abs(wo.z));
	v.t_o = lobe_rough_dielectric_t(ndf, p, wo);
	v.side.at = lobe_fresnel_interface_select(above, a.at, b.at);
	v.side.inv_e = above ? a.inv_e : b.inv_e;
	v.side.scale = above ? a.scale : b.scale;
	v.side.step = above ? a.step : b.step;
	v.side.start = above ? a.start : b.start;
	v.side.g2_first = above ? a.g2_first : b.g2_first;
	v.side.g2_second = above ? a.g2_second : b.g2_second;
	return v;
}

/* The facet that takes o to i, by the unnormalised half vector H = o + e_r i, e_r = 1 for reflection: at is its
 * interface for normal H. density: its density dm/di D(m) o.m/sigma(o) [1/sr]. Both events are one formula,
 *	D(m) o.m |dm/di| = norm e_r^2 |o.H| |i.H| D1(H)
 * in which every power of |H| has cancelled (D1: lobe_ndf_density of the facet). side, seen: > 0 where i is on its
 * side, and where both directions see the front of the facet, or for a refraction one its front and one its back.
 * (Numbers, as compilers make more of a minimum than of a chain of truth values.) */
typedef struct {
	lobe_fresnel_interface at;
	lobe_real density, side, seen;
	int reflects;
} lobe_rough_dielectric_facet;

LOBE_FN lobe_rough_dielectric_facet lobe_rough_dielectric_facet_make(lobe_uint ndf, lobe_rough_dielectric p,
								     lobe_rough_dielectric_view v, lobe_vec3 i,
								     int reflects)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real e_r = reflects ? one : v.side.at.eta;
	const lobe_vec3 h = lobe_vec3_fma(e_r, i, v.o);
	const lobe_vec3 squares = lobe_vec3_squares(h);
	const lobe_real h2 = lobe_vec3_sum(squares);
	const lobe_real half_h2 = LOBE_R(0.5) * h2;
	/* The facet looks up. Of a refraction the half vector knows both cosines. Of a reflection its length gives all:
	 * c = m2/2, s^2 = m2 (1 - m2/4) and g^2 = c^2 + k m2; of dense glass from these, so that a rounding of m2 is
	 * one of the angle and no more, and s^2 >= 0. */
	const lobe_real m2 = lobe_rough_dielectric_dense(p) ? lobe_min(h2, LOBE_R(4.0)) : h2;
	const lobe_real half_m2 = LOBE_R(0.5) * m2;
	const lobe_real minus_s2 = lobe_fma(LOBE_R(0.25), m2, -one);
	const lobe_real dense_g2 = lobe_fma(LOBE_R(0.25), m2, v.side.g2_first) + v.side.g2_second;
	const lobe_real plain_g2 = lobe_fma(LOBE_R(0.25), m2, v.side.at.k);
	const lobe_real reflects_g = lobe_fresnel_g(m2 * (lobe_rough_dielectric_dense(p) ? dense_g2 : plain_g2));
	const lobe_real refracts_oh = lobe_times_sign(lobe_dot(v.o, h), h.z);
	const lobe_real refracts_g = lobe_times_sign(v.side.at.eta * -lobe_dot(i, h), h.z);
	const lobe_real c = reflects ? half_m2 : refracts_oh;
	const lobe_real oh = reflects ? half_h2 : refracts_oh;
	const lobe_real e2_ih = reflects ? half_h2 : v.side.at.eta * refracts_g;
	const lobe_real g = reflects ? reflects_g : refracts_g;
	const lobe_real dense_x = half_m2 * (g + (minus_s2 + minus_s2));
	const lobe_real plain_x = lobe_fma(c, c + g, -m2);
	const lobe_real x = lobe_rough_dielectric_dense(p) ? dense_x : plain_x;
	const lobe_real two_sigma = v.o.z + v.t_o;
	const lobe_facet_density d =
		lobe_ndf_density_over(ndf, lobe_stretch_facet_squares(p.stretch, squares), two_sigma);
	lobe_rough_dielectric_facet f;
	f.reflects = reflects;
	f.at = lobe_fresnel_interface_at(v.side.at, c, g, x, reflects ? m2 : h2);
	f.side = reflects ? i.z : -i.z;
	f.seen = lobe_min(oh, e2_ih);
	f.density = ((p.stretch.norm + p.stretch.norm) * two_sigma) * (oh * d.inv) * (e2_ih * d.inv) * d.factor;
	return f;
}

/* The facet that eval and pdf see; there is none for a delta event. */
LOBE_FN lobe_rough_dielectric_facet lobe_rough_dielectric_facet_of(lobe_uint ndf, lobe_rough_dielectric p,
								   lobe_rough_dielectric_view v, lobe_vec3 i)
{
	const int reflects = i.z > LOBE_R(0.0);
	lobe_rough_dielectric_facet f = lobe_rough_dielectric_facet_make(ndf, p, v, i, reflects);
	f.seen = (reflects | !lobe_rough_dielectric_delta(p)) ? f.seen : LOBE_R(0.0);
	return f;
}

/* x where m is a facet and x a finite number, else 0. */
LOBE_FN lobe_real lobe_rough_dielectric_keep(lobe_rough_dielectric_view v, lobe_rough_dielectric_facet m, lobe_real x)
{
	const int there = lobe_min(lobe_min(v.o.z, m.side), m.seen) > LOBE_R(0.0);
	const int number = lobe_abs(x) <= LOBE_REAL_MAX;
	return there & number ? x : LOBE_R(0.0);
}

/* F or 1 - F, by the event. */
LOBE_FN lobe_real lobe_rough_dielectric_prob(lobe_rough_dielectric_facet m)
{
	return lobe_fresnel_share(m.at, m.reflects);
}

/* i as v sees it. */
LOBE_FN lobe_vec3 lobe_rough_dielectric_flip(lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_vec3_make(wi.x, wi.y, lobe_times_sign(wi.z, wo.z));
}

/* The weight of a sample whose event has probability F or 1 - F: G2/G1(o), height-correlated for a reflection and G1(i)
 * for a refraction, with what that carries; by one division. */
LOBE_FN lobe_real lobe_rough_dielectric_weight(lobe_uint ndf, lobe_rough_dielectric p, lobe_rough_dielectric_view v,
					       lobe_vec3 i, int reflects)
{
	const lobe_real z_i = lobe_abs(i.z);
	const lobe_real t_i = lobe_rough_dielectric_t(ndf, p, i);
	const lobe_real num = reflects ? v.o.z + v.t_o : v.side.scale + v.side.scale;
	const lobe_real den = reflects ? lobe_smith_sum(v.o.z, v.t_o, z_i, t_i) : z_i + t_i;
	return z_i * num / den;
}

/* f |cos theta_i| [1/sr] of a facet of which the share prob is reflected or refracted: density times weight of a
 * sample. */
LOBE_FN lobe_real lobe_rough_dielectric_eval_at(lobe_rough_dielectric_view v, lobe_rough_dielectric_facet m,
						lobe_real prob, lobe_real weight)
{
	return lobe_rough_dielectric_keep(v, m, prob * m.density * weight);
}

/* f |cos theta_i| [1/sr] */
LOBE_FN lobe_rgb lobe_rough_dielectric_eval(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p, wo);
	const lobe_vec3 i = lobe_rough_dielectric_flip(wo, wi);
	const lobe_rough_dielectric_facet m = lobe_rough_dielectric_facet_of(ndf, p, v, i);
	const lobe_real weight = lobe_rough_dielectric_weight(ndf, p, v, i, m.reflects);
	const lobe_real kept = lobe_rough_dielectric_eval_at(v, m, lobe_rough_dielectric_prob(m), weight);
	return lobe_rgb_make(kept, kept, kept);
}

/* [1/sr], the event being chosen with probability prob. */
LOBE_FN lobe_real lobe_rough_dielectric_pdf_at(lobe_rough_dielectric_view v, lobe_rough_dielectric_facet m,
					       lobe_real prob)
{
	return lobe_rough_dielectric_keep(v, m, prob * m.density);
}

/* [1/sr] */
LOBE_FN lobe_real lobe_rough_dielectric_pdf(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p, wo);
	const lobe_rough_dielectric_facet m =
		lobe_rough_dielectric_facet_of(ndf, p, v, lobe_rough_dielectric_flip(wo, wi));
	return lobe_rough_dielectric_pdf_at(v, m, lobe_rough_dielectric_prob(m));
}

/* The facet that a sample leaves by: a visible one, of any length. c: o.m. */
typedef struct {
	lobe_vec3 m;
	lobe_real c;
	lobe_fresnel_interface at;
	lobe_fresnel_amplitudes r;
} lobe_rough_dielectric_choice;

LOBE_FN lobe_rough_dielectric_choice lobe_rough_dielectric_choose(lobe_uint ndf, lobe_rough_dielectric p,
								  lobe_rough_dielectric_view v, lobe_vec3 u)
{
	const lobe_vec3 stretched = lobe_stretch_direction(p.stretch, v.o);
	const lobe_vec3 facet = lobe_ndf_visible_above(ndf, stretched, v.t_o, lobe_vec2_make(u.x, u.y));
	lobe_rough_dielectric_choice s;
	s.m = lobe_stretch_normal(p.stretch, facet);
	s.c = lobe_dot(stretched, facet);
	const lobe_real c2 = s.c * s.c, m2 = lobe_dot(s.m, s.m);
	const lobe_vec3 across = lobe_vec3_fma(-s.c, v.o, s.m);
	/* From within dense glass the sine decides, and it is small. */
	const lobe_real s2 = lobe_rough_dielectric_dense(p) ? lobe_dot(across, across) : m2 - c2;
	const lobe_real dense_g2 = lobe_fma(v.side.at.eta2, c2, v.side.at.k * s2);
	const lobe_real g = lobe_fresnel_g(lobe_rough_dielectric_dense(p) ? dense_g2 : lobe_fma(v.side.at.k, m2, c2));
	s.at = lobe_fresnel_interface_at(v.side.at, s.c, g, lobe_fma(s.c, g, -s2), m2);
	s.r = lobe_fresnel_amplitudes_make(s.at);
	return s;
}

/* Where the light goes, with wo above: 2 (o.m) m - o or refracted. (Both are worked out before it is known which: a
 * sample is one long chain of operations that wait for each other.) */
LOBE_FN lobe_vec3 lobe_rough_dielectric_leave(lobe_rough_dielectric p, lobe_rough_dielectric_view v,
					      lobe_rough_dielectric_choice s, int reflects)
{
	const lobe_vec3 bent = lobe_vec3_fma(s.r.bend, s.m, v.o);
	const lobe_real excess =
		lobe_fma(v.o.x, v.o.x, lobe_fma(v.o.y, v.o.y, lobe_fma(v.o.z, v.o.z, -LOBE_R(1.0))));
	const lobe_real dense_scale = lobe_fma(v.side.step, lobe_dot(bent, bent), v.side.start);
	const lobe_real scale = lobe_rough_dielectric_dense(p) ? dense_scale : lobe_fma(v.side.step, excess, -v.side.inv_e);
	const lobe_vec3 mirrored =
		lobe_vec3_fma((s.c + s.c) / s.at.m2, s.m, lobe_vec3_make(-v.o.x, -v.o.y, -v.o.z));
	return lobe_vec3_select(reflects, mirrored, lobe_vec3_scale(bent, scale));
}

/* The facet of a sample as pdf finds it again. There is none for a delta event, which keeps the sampled one's
 * interface, with the density that it is given. */
LOBE_FN lobe_rough_dielectric_facet lobe_rough_dielectric_facet_again(lobe_uint ndf, lobe_rough_dielectric p,
								      lobe_rough_dielectric_view v,
								      lobe_rough_dielectric_choice s, lobe_vec3 i,
								      int reflects, lobe_real delta_density)
{
	const int straight = lobe_rough_dielectric_delta(p) & !reflects;
	lobe_rough_dielectric_facet m = lobe_rough_dielectric_facet_make(ndf, p, v, i, reflects);
	m.at = lobe_fresnel_interface_select(straight, s.at, m.at);
	m.density = straight ? delta_density : m.density;
	m.seen = straight ? s.c : m.seen;
	return m;
}

/* The weight of that sample. A delta event is not masked. */
LOBE_FN lobe_real lobe_rough_dielectric_sample_weight(lobe_uint ndf, lobe_rough_dielectric p,
						      lobe_rough_dielectric_view v, lobe_vec3 i, int reflects)
{
	const int straight = lobe_rough_dielectric_delta(p) & !reflects;
	return straight ? v.side.scale : lobe_rough_dielectric_weight(ndf, p, v, i, reflects);
}

LOBE_FN lobe_uint lobe_rough_dielectric_event(lobe_rough_dielectric p, int reflects)
{
	const lobe_uint refracts =
		lobe_rough_dielectric_delta(p) ? LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA : LOBE_EVENT_TRANSMIT | LOBE_EVENT_GLOSSY;
	return reflects ? LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY : refracts;
}

/* Uses u.x and u.y for the facet and u.z to choose between reflection and refraction. No sample when the facet sends
 * the light to the wrong side of the surface. With LOBE_EVENT_DELTA pdf is 1 - F of the sampled facet. */
LOBE_FN lobe_sample lobe_rough_dielectric_sample(lobe_uint ndf, lobe_rough_dielectric p, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_rough_dielectric_view v = lobe_rough_dielectric_view_make(ndf, p, wo);
	const lobe_rough_dielectric_choice s = lobe_rough_dielectric_choose(ndf, p, v, u);
	const int reflects = lobe_fresnel_reflects(s.at, s.r, u.z);
	const lobe_vec3 i = lobe_rough_dielectric_leave(p, v, s, reflects);
	/* Without an interface the probability to pass is 1, not 1 - F with its roundings. */
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_real surely = p.eta == one ? one : zero, perhaps = p.eta == one ? zero : one;
	const lobe_rough_dielectric_facet m = lobe_rough_dielectric_facet_again(ndf, p, v, s, i, reflects, perhaps);
	const lobe_real pdf = lobe_fma(lobe_rough_dielectric_prob(m), m.density, surely);
	const lobe_real w = lobe_rough_dielectric_sample_weight(ndf, p, v, i, reflects);
	const lobe_real there = lobe_min(lobe_min(lobe_min(v.o.z, m.side), m.seen), pdf);
	const lobe_real finite = LOBE_REAL_MAX - (pdf + w); /* last, so that a NaN stays one */
	return lobe_sample_select(lobe_min(there, finite) > zero, lobe_rough_dielectric_flip(wo, i),
				  lobe_rgb_make(w, w, w), pdf, lobe_rough_dielectric_event(p, reflects));
}

#endif
