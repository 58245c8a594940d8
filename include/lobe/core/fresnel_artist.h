/* fresnel_artist.h - a metal's complex index from the colour it should have facing and at grazing angles.
 *
 * Gulbrandsen 2014, "Artist friendly metallic Fresnel", JCGT 3(4). r is the reflectance at normal incidence, g ("edge
 * tint") chooses among the indices n + ik that have it: at g = 0 n is largest and k = 0, the reflectance rises late and
 * dips before it; at g = 1 n is small, k large, and it rises from r at once. For make functions: the index goes into
 * the exact conductor. */
#ifndef LOBE_CORE_FRESNEL_ARTIST_H
#define LOBE_CORE_FRESNEL_ARTIST_H

#include "vec.h"

typedef struct {
	lobe_real n, k;
} lobe_fresnel_index;

typedef struct {
	lobe_rgb eta, k;
} lobe_fresnel_index_rgb;

/* Above this reflectance n could leave the domain of the exact conductor, which ends at 1000. */
#define LOBE_FRESNEL_ARTIST_MAX LOBE_R(0.996)

/* r: clamped to [0, LOBE_FRESNEL_ARTIST_MAX]. g: clamped to [0, 1].
 *
 * With s = sqrt(r) the ends are N = (1 + s)/(1 - s) and M = (1 - r)/(1 + r), n = M + (1 - g)(N - M), and the k that
 * gives r is
 *	k^2 = (r (n + 1)^2 - (n - 1)^2)/(1 - r) = (N - n)(n - 1/N).
 * Both factors are formed from
 *	N - M = 2 s (1 + s)/((1 - s)(1 + r)),   M - 1/N = 2 s (1 - s)/((1 + r)(1 + s)),
 * so that nothing cancels but 1 - r, which is exact where it is small. n and k are off by 3.5e-7 relative, the
 * reflectance that they have from r by 1.1e-7 (tests/test_fresnel_schlick.c). */
LOBE_FN lobe_fresnel_index lobe_fresnel_artist(lobe_real r, lobe_real g)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real f = lobe_clamp(r, LOBE_R(0.0), LOBE_FRESNEL_ARTIST_MAX);
	const lobe_real edge = lobe_clamp(g, LOBE_R(0.0), one);
	const lobe_real s = lobe_sqrt(f);
	const lobe_real more = one + s;
	const lobe_real less = (one - f) / more; /* 1 - s */
	const lobe_real across = (s + s) / (one + f);
	const lobe_real span = across * more / less;
	const lobe_real above_least = (one - edge) * span;
	lobe_fresnel_index i;
	i.n = (one - f) / (one + f) + above_least;
	i.k = lobe_sqrt(edge * span * lobe_fma(across, less / more, above_least));
	return i;
}

LOBE_FN lobe_fresnel_index_rgb lobe_fresnel_artist_rgb(lobe_rgb r, lobe_rgb g)
{
	const lobe_fresnel_index red = lobe_fresnel_artist(r.r, g.r);
	const lobe_fresnel_index green = lobe_fresnel_artist(r.g, g.g);
	const lobe_fresnel_index blue = lobe_fresnel_artist(r.b, g.b);
	lobe_fresnel_index_rgb i;
	i.eta = lobe_rgb_make(red.n, green.n, blue.n);
	i.k = lobe_rgb_make(red.k, green.k, blue.k);
	return i;
}

#endif
