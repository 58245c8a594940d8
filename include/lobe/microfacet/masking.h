/* masking.h - how much of a facet two directions see: every masking function that microsurface.h names.
 *
 * All are given as G2/z_o, where z_o is the mean plane's area as seen from o (o.z without a shear), so that a
 * reflection is f |cos theta_i| = F D/4 G2/z_o, in which nothing goes to infinity with the view at the horizon. In
 * projected areas (facet.h), z for the mean plane's and h = z Lambda for what is hidden:
 *
 * SMITH			Smith 1967; Heitz 2014. G1 = z/(z + h). Together for directions on one side,
 *   SEPARABLE			G1(o) G1(i)
 *   HEIGHT			1/(1 + Lo + Li): high facets are seen and lit more (Ross et al. 2005; Heitz eq. 99)
 *   DIRECTION			l G1(o) G1(i) + (1 - l) min: what one sees is what lights the other when they agree (Ashikhmin
 *				et al. 2000; Heitz eq. 98), here with van Ginneken's l of the azimuth p between them
 *   HEIGHT_DIRECTION		1/(1 + max(Lo, Li) + l min(Lo, Li)), l = 4.41 p/(4.41 p + 1), p in [0, pi] (van Ginneken et al.
 *				1998, "Diffuse and specular reflectance from rough surfaces"); p is taken on the isotropic surface
 *   and across the surface,
 *   SEPARABLE			G1(o) G1(i) (Walter et al. 2007)
 *   BETA			B(1 + Lo, 1 + Li), exact for Smith's heights (Heitz et al. 2016)
 * SMITH_RATIONAL		the same with Walter's rational Lambda of Beckmann, whose G1 it misses by .0031; other
 *				distributions are taken for Beckmann's of the width that they are like
 * VCAVITY			vcavity.h: min(1, G1(o, m), G1(i, m)); across, where the view sees the upper part of a side
 *				and the light its lower part, what is common to both: max(0, G1(o, m) + G1(i, m) - 1)
 *
 * Of these but SMITH_RATIONAL, which is off by its G1, the weak furnace is 1: all that is seen of the facets is as
 * large as the mean plane. Those that follow are no microsurface's. They are here to be compared, as functions of the
 * cosine c to the mean plane (with its shear undone), the same across the surface as on one side, and, where they have
 * a width, of the geometric mean of the map's two.
 *
 * NONE				1. Too bright: at grazing angles without bound
 * IMPLICIT			c_o c_i, which cancels the cosines of the denominator. Too dark
 * SCHLICK_SMITH		c/(c (1-k) + k) of each, k = alpha sqrt(2/pi) (Schlick 1994). Too dark for GGX
 * SCHLICK_GGX			k = alpha/2 (Karis 2013, "Real shading in Unreal Engine 4", for image-based light)
 * SCHLICK_GGX_LIGHTS		k = (r + 1)^2/8, r = sqrt(alpha) (the same, for analytic lights). Too dark where smooth
 * KELEMEN			c_o c_i/((o.m)(i.m)) (Kelemen and Szirmay-Kalos 2001, V-cavities without their minimum). Above 1
 *				and too bright where a facet is steep
 * NEUMANN			c_o c_i/max(c_o, c_i) (Neumann et al. 1999). Knows no width: too dark where smooth
 * DISNEY			GGX's Smith, separable, of width (1/2 + r/2)^2, r = sqrt(alpha) (Burley 2012). Too dark where smooth
 *
 * Their weak furnaces and albedos are asserted in tests/test_masking.c.
 *
 * A shear can turn the mean plane's back to o that is above the horizon (z_o = 0). Smith's surface still shows facets
 * then, sigma(o) = h_o of them: outgoing light is the average over the visible, int F Dv(m; o) G(i|o) L, with G(i|o) =
 * G2/G1(o) as it is when o grazes, Lambda_o infinite, so that nothing jumps where the plane turns. A light that is
 * behind the mean plane lights nothing. The other maskings are 0 in both cases. */
#ifndef LOBE_MICROFACET_MASKING_H
#define LOBE_MICROFACET_MASKING_H

#include "../core/beta.h"
#include "microsurface.h"
#include "vcavity.h"

/* van Ginneken's factor l of the azimuth between o and i, apart: 0 where they are one, .93 where opposite; and 1 -
 * l. */
typedef struct {
	lobe_real apart, together;
} lobe_masking_azimuth;

LOBE_FN lobe_masking_azimuth lobe_masking_azimuth_make(lobe_vec3 o, lobe_vec3 i)
{
	const lobe_real cross = lobe_abs(lobe_diff_of_products(o.x, i.y, o.y, i.x));
	const lobe_real p = LOBE_R(4.41) * lobe_atan2(cross, lobe_fma(o.x, i.x, o.y * i.y));
	lobe_masking_azimuth a;
	a.together = LOBE_R(1.0) / (p + LOBE_R(1.0));
	a.apart = p * a.together;
	return a;
}

/* One side. With products in place of quotients by z: z_o z_i Lambda_o = h_o z_i. */
LOBE_FN lobe_real lobe_masking_smith(lobe_uint joint, lobe_seen o, lobe_seen i)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real sum_o = o.z + o.hides, sum_i = i.z + i.hides;
	const lobe_real ho = o.hides * i.z, hi = i.hides * o.z;
	const lobe_real product = i.z / (sum_o * sum_i);
	const lobe_real height = i.z / lobe_fma(sum_o, i.z, hi);
	switch (LOBE_CHOSEN(joint, LOBE_ONLY_JOINT)) {
	case LOBE_JOINT_SEPARABLE:
		return product;
	case LOBE_JOINT_HEIGHT:
		return height;
	case LOBE_JOINT_DIRECTION: {
		const lobe_masking_azimuth a = lobe_masking_azimuth_make(o.v, i.v);
		const lobe_real least = one / lobe_max(sum_o, sum_i * (o.z / i.z));
		return lobe_fma(a.apart, product, a.together * least);
	}
	case LOBE_JOINT_HEIGHT_DIRECTION: {
		const lobe_real apart = lobe_masking_azimuth_make(o.v, i.v).apart;
		return i.z / lobe_fma(o.z, i.z, lobe_fma(apart, lobe_min(ho, hi), lobe_max(ho, hi)));
	}
	default:
		return LOBE_R(0.0);
	}
}

/* (1 + Lambda) as far as it matters: B(a, b) is 0 long before. */
LOBE_FN lobe_real lobe_masking_one_plus_lambda(lobe_seen d)
{
	return lobe_clamp((d.z + d.hides) / d.z, LOBE_R(1.0), LOBE_R(0x1p60));
}

/* i on the other side. G2/z_o with z_o as the visible area over 1 + Lambda_o. From the back of the mean plane, whose
 * limit BETA's 0 is, the tops of the facets are seen, and nothing comes through there. */
LOBE_FN lobe_real lobe_masking_smith_across(lobe_uint across, lobe_seen o, lobe_seen i)
{
	const lobe_real sum_o = o.z + o.hides;
	const lobe_real a = lobe_masking_one_plus_lambda(o), b = lobe_masking_one_plus_lambda(i);
	const lobe_real exact = o.z > LOBE_R(0.0) ? lobe_beta(a, b) * a / sum_o : LOBE_R(0.0);
	return LOBE_CHOSEN(across, LOBE_ONLY_ACROSS) == LOBE_ACROSS_BETA ? exact : i.z / (sum_o * (i.z + i.hides));
}

/* Across, G1(o) + G1(i) - 1 is the lesser less what is hidden of the greater, which is nothing where that sees all. */
LOBE_FN lobe_real lobe_masking_vcavity(lobe_seen o, lobe_seen i, lobe_seen_facet m, int across)
{
	const lobe_real g_o = lobe_vcavity_g1_over_cos(o.z, m.o, m.z);
	const lobe_real g_i = lobe_vcavity_g1(i.z, m.i, m.z);
	const lobe_real o_less = g_o - lobe_vcavity_hidden(i.z, m.i, m.z) / o.z;
	const lobe_real i_less = (g_i - lobe_vcavity_hidden(o.z, m.o, m.z)) / o.z;
	const lobe_real common = lobe_max(g_o * o.z < g_i ? o_less : i_less, LOBE_R(0.0));
	return across ? common : lobe_min(g_o, g_i / o.z);
}

/* Schlick's c/(c (1-k) + k), without its c. */
LOBE_FN lobe_real lobe_masking_schlick(lobe_seen d, lobe_real k)
{
	return LOBE_R(1.0) / lobe_fma(d.cosine, LOBE_R(1.0) - k, k);
}

/* GGX's G1, without its cosine, of width a: 2/(c + t). */
LOBE_FN lobe_real lobe_masking_ggx(lobe_seen d, lobe_real a)
{
	const lobe_real c = d.cosine;
	const lobe_real s2 = (LOBE_R(1.0) - c) * (LOBE_R(1.0) + c);
	return LOBE_R(2.0) / (c + lobe_sqrt(lobe_fma(a * a, s2, c * c)));
}

/* The width that k or Disney's remapping makes of the surface's. */
LOBE_FN lobe_real lobe_masking_width(lobe_microsurface s)
{
	const lobe_real r = LOBE_R(0.5) + LOBE_R(0.5) * lobe_sqrt(s.alpha);
	switch (LOBE_CHOSEN(s.masking, LOBE_ONLY_MASKING)) {
	case LOBE_MASKING_SCHLICK_SMITH:
		return s.alpha * LOBE_R(0.797884560802865355880); /* sqrt(2/pi) */
	case LOBE_MASKING_SCHLICK_GGX:
		return LOBE_R(0.5) * s.alpha;
	case LOBE_MASKING_SCHLICK_GGX_LIGHTS:
		return LOBE_R(0.5) * r * r;
	default:
		return r * r;
	}
}

/* G2/z_o. o and i from lobe_see; across: i is on the other side. 0 where i sees the back of the mean plane. */
LOBE_FN_APART lobe_real lobe_masking_g2_over_cos(lobe_microsurface s, lobe_seen o, lobe_seen i, lobe_seen_facet m,
						 int across)
{
	const lobe_real zero = LOBE_R(0.0);
	const lobe_uint masking = LOBE_CHOSEN(s.masking, LOBE_ONLY_MASKING);
	if (!(i.z > zero))
		return zero;
	if ((masking == LOBE_MASKING_SMITH) | (masking == LOBE_MASKING_SMITH_RATIONAL))
		return across ? lobe_masking_smith_across(s.across, o, i) : lobe_masking_smith(s.joint, o, i);
	if (!(o.z > zero))
		return zero;
	const lobe_real k = lobe_masking_width(s);
	switch (masking) {
	case LOBE_MASKING_VCAVITY:
		return lobe_masking_vcavity(o, i, m, across);
	case LOBE_MASKING_NONE:
		return LOBE_R(1.0) / o.z;
	case LOBE_MASKING_IMPLICIT:
		return o.inv_length * i.cosine;
	case LOBE_MASKING_SCHLICK_SMITH:
	case LOBE_MASKING_SCHLICK_GGX:
	case LOBE_MASKING_SCHLICK_GGX_LIGHTS:
		return o.inv_length * i.cosine * lobe_masking_schlick(o, k) * lobe_masking_schlick(i, k);
	case LOBE_MASKING_KELEMEN:
		return o.inv_length * i.cosine / ((m.o / m.length2) * m.i);
	case LOBE_MASKING_NEUMANN:
		return o.inv_length * i.cosine / lobe_max(o.cosine, i.cosine);
	case LOBE_MASKING_DISNEY:
		return o.inv_length * i.cosine * lobe_masking_ggx(o, k) * lobe_masking_ggx(i, k);
	default:
		return zero;
	}
}

#endif
