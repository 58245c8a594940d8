/* vcavity.h - a surface of symmetric V-shaped cavities, each by itself: masking, and sampling of what is visible.
 *
 * Torrance and Sparrow 1967; Cook and Torrance 1982; as a microsurface like Smith's by Heitz 2014, section 6.2 and
 * Heitz and d'Eon 2014, "Importance sampling microfacet-based BSDFs using the distribution of visible normals". On the
 * surface of width 1 the two sides of a cavity have slopes s and -s, that is, normals m and m' mirrored about the
 * vertical. What share of a side is seen is not changed by a linear map that keeps verticals vertical, so all below is
 * in terms of that surface: the mapped cavity's sides have slopes mean +- A s. v and m may have any length, m.z > 0.
 *
 * z: the mean plane's area as seen from v, max(v.z, 0). Cavities cannot be seen from behind their mean plane: where z
 * is 0 so is everything. */
#ifndef LOBE_MICROFACET_VCAVITY_H
#define LOBE_MICROFACET_VCAVITY_H

#include "../core/warp.h"

/* G1(v, m)/z = min(1/z, 2 m.z/(v.m)) where v.m = facing > 0. */
LOBE_FN lobe_real lobe_vcavity_g1_over_cos(lobe_real z, lobe_real facing, lobe_real m_z)
{
	const lobe_real g = lobe_min(LOBE_R(1.0) / z, (m_z + m_z) / facing);
	return lobe_min(z, facing) > LOBE_R(0.0) ? g : LOBE_R(0.0);
}

LOBE_FN lobe_real lobe_vcavity_g1(lobe_real z, lobe_real facing, lobe_real m_z)
{
	const lobe_real g = lobe_min(LOBE_R(1.0), (m_z + m_z) * (z / facing));
	return lobe_min(z, facing) > LOBE_R(0.0) ? g : LOBE_R(0.0);
}

/* What is not seen of it, 1 - G1(v, m), which does not cancel: the share of the side that the other one, facing away,
 * covers. Where v sees nothing of the side this means nothing. */
LOBE_FN lobe_real lobe_vcavity_hidden(lobe_real z, lobe_real facing, lobe_real m_z)
{
	return lobe_max(lobe_fma(-(m_z + m_z), z, facing), LOBE_R(0.0)) / facing;
}

/* A side m of a cavity whose sides are drawn with density D(m) m.z, or the other side instead, by their visible areas:
 * v.m + v.m' = 2 v.z m.z while both face v, so that m comes with density G1(v, m) max(0, v.m) D(m)/z. choice in [0,1);
 * rest: what is left of it as a random number. */
typedef struct {
	lobe_vec3 m;
	lobe_real rest;
} lobe_vcavity_side;

LOBE_FN lobe_vcavity_side lobe_vcavity_visible(lobe_vec3 v, lobe_vec3 m, lobe_real choice)
{
	const lobe_real zero = LOBE_R(0.0);
	const lobe_vec3 other = lobe_vec3_make(-m.x, -m.y, m.z);
	const lobe_real area = lobe_max(lobe_dot(v, m), zero);
	const lobe_real area_other = lobe_max(lobe_dot(v, other), zero);
	const lobe_real sum = area + area_other;
	const lobe_real keep = sum > zero ? area / sum : LOBE_R(1.0);
	const int kept = choice < keep;
	const lobe_real rest = kept ? choice / keep : (choice - keep) / (LOBE_R(1.0) - keep);
	lobe_vcavity_side side;
	side.m = lobe_vec3_make(kept ? m.x : other.x, kept ? m.y : other.y, m.z);
	side.rest = lobe_clamp(rest, zero, LOBE_BELOW_ONE);
	return side;
}

#endif
