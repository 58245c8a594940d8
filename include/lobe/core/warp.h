/* warp.h - maps of the unit square to disk, hemisphere and cap, each with its density and its inverse.
 *
 * u lies in [0,1)^2. A float u is taken as the lower end of a cell 2^-24 wide, and the maps that would otherwise reach
 * the rim of the disk or the horizon use the middle of the cell: so u = 0 gives a direction with a density above 0, and
 * opposite ends of [0,1) give mirrored results. */
#ifndef LOBE_CORE_WARP_H
#define LOBE_CORE_WARP_H

#include "constants.h"
#include "real.h"
#include "vec.h"

typedef struct {
	lobe_real x, y;
} lobe_vec2;

/* The largest float below 1: 1 - 2^-24. */
#define LOBE_BELOW_ONE LOBE_R(0x1.fffffep-1)

LOBE_FN lobe_vec2 lobe_vec2_make(lobe_real x, lobe_real y)
{
	lobe_vec2 v;
	v.x = x;
	v.y = y;
	return v;
}

/* v with each coordinate in [0,1), where rounding has put it just outside. */
LOBE_FN lobe_vec2 lobe_vec2_into_square(lobe_vec2 v)
{
	const lobe_real zero = LOBE_R(0.0);
	return lobe_vec2_make(lobe_clamp(v.x, zero, LOBE_BELOW_ONE), lobe_clamp(v.y, zero, LOBE_BELOW_ONE));
}

/* A point of the unit disk as a signed radius and an angle in turns: (x, y) = r (cos, sin)(2 pi turns). */
typedef struct {
	lobe_real r, turns;
} lobe_disk_polar;

/* The concentric map of Shirley and Chiu 1997, "A low distortion map between disk and square", with the radius signed
 * (Cline) so that one formula serves opposite sectors. */
LOBE_FN lobe_disk_polar lobe_concentric_polar(lobe_vec2 u)
{
	const lobe_real centre = LOBE_BELOW_ONE; /* see the top of the file */
	const lobe_real a = lobe_fma(LOBE_R(2.0), u.x, -centre);
	const lobe_real b = lobe_fma(LOBE_R(2.0), u.y, -centre);
	const int wide = lobe_abs(a) > lobe_abs(b);
	const lobe_real num = wide ? b : a;
	const lobe_real den = wide ? a : b;
	const lobe_real eighth = LOBE_R(0.125) * num / (den == LOBE_R(0.0) ? LOBE_R(1.0) : den);
	lobe_disk_polar p;
	p.r = den;
	p.turns = wide ? eighth : LOBE_R(0.25) - eighth;
	return p;
}

/* Uniform point of the unit disk; rounding may put it 2.5e-7 outside. */
LOBE_FN lobe_vec2 lobe_concentric_disk(lobe_vec2 u)
{
	const lobe_disk_polar p = lobe_concentric_polar(u);
	const lobe_sincos sc = lobe_sincos_2pi_small(p.turns);
	return lobe_vec2_make(p.r * sc.c, p.r * sc.s);
}

/* Its density per area: 1/pi everywhere. */
LOBE_FN lobe_real lobe_concentric_disk_pdf(void) { return LOBE_INV_PI; }

/* u of a point of the unit disk; the centre gives (1/2, 1/2). */
LOBE_FN lobe_vec2 lobe_concentric_disk_inverse(lobe_vec2 d)
{
	const lobe_real half_centre = LOBE_R(0x1.fffffep-2);
	const lobe_real len = lobe_sqrt(lobe_fma(d.x, d.x, d.y * d.y));
	const int wide = lobe_abs(d.x) > lobe_abs(d.y);
	const lobe_real major = wide ? d.x : d.y;
	const lobe_real minor = wide ? d.y : d.x;
	const lobe_real r = major < LOBE_R(0.0) ? -len : len;
	const lobe_real safe = len > LOBE_R(0.0) ? major : LOBE_R(1.0);
	const lobe_real other = r * (LOBE_R(4.0) * LOBE_INV_PI) * lobe_atan(minor / safe);
	const lobe_real a = wide ? r : other;
	const lobe_real b = wide ? other : r;
	return lobe_vec2_into_square(
		lobe_vec2_make(lobe_fma(LOBE_R(0.5), a, half_centre), lobe_fma(LOBE_R(0.5), b, half_centre)));
}

/* Direction about +z with density cos(theta)/pi: the disk lifted to the hemisphere (Malley). z > 3e-4. */
LOBE_FN lobe_vec3 lobe_cosine_hemisphere(lobe_vec2 u)
{
	const lobe_disk_polar p = lobe_concentric_polar(u);
	const lobe_sincos sc = lobe_sincos_2pi_small(p.turns);
	const lobe_real one = LOBE_R(1.0);
	return lobe_vec3_make(p.r * sc.c, p.r * sc.s, lobe_sqrt((one - p.r) * (one + p.r)));
}

/* [1/sr]; 0 at and below the horizon. */
LOBE_FN lobe_real lobe_cosine_hemisphere_pdf(lobe_vec3 w)
{
	return w.z > LOBE_R(0.0) ? w.z * LOBE_INV_PI : LOBE_R(0.0);
}

/* The point of the square that lobe_cosine_hemisphere takes to w. */
LOBE_FN lobe_vec2 lobe_cosine_hemisphere_inverse(lobe_vec3 w)
{
	return lobe_concentric_disk_inverse(lobe_vec2_make(w.x, w.y));
}

/* Point uniform over the cap radius - z <= height about +z of a sphere; height in (0, 2 radius]. u.x goes round, u.y
 * from the pole to the rim. Off the axis by the root of h (2 radius - h), h = u.y height, whose second factor is what
 * is left of the sphere below the cap and of the cap below the point: two terms that keep their precision at the far
 * pole. */
LOBE_FN lobe_vec3 lobe_sphere_cap(lobe_vec2 u, lobe_real radius, lobe_real height)
{
	const lobe_real below = lobe_fma(LOBE_R(1.0) - u.y, height, (radius + radius) - height);
	const lobe_real s = lobe_sqrt(u.y * height * below);
	const lobe_sincos sc = lobe_sincos_2pi_small(u.x);
	return lobe_vec3_make(s * sc.c, s * sc.s, lobe_fma(-u.y, height, radius));
}

/* Direction uniform over the spherical cap 1 - z <= height; height in (0, 2] is 1 - cos of the cap's half angle
 * (1: hemisphere, 2: sphere). */
LOBE_FN lobe_vec3 lobe_spherical_cap(lobe_vec2 u, lobe_real height) { return lobe_sphere_cap(u, LOBE_R(1.0), height); }

/* [1/sr], inside the cap. */
LOBE_FN lobe_real lobe_spherical_cap_pdf(lobe_real height) { return LOBE_R(1.0) / (LOBE_2PI * height); }

/* The point of the square that lobe_spherical_cap takes to w, a direction inside the cap. */
LOBE_FN lobe_vec2 lobe_spherical_cap_inverse(lobe_vec3 w, lobe_real height)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real s2 = lobe_vec3_xy2(w);
	const lobe_real turns = lobe_atan2(w.y, w.x) / LOBE_2PI;
	/* 1 - z above the equator as (x^2 + y^2)/(1 + z). */
	const lobe_real h = w.z > LOBE_R(0.0) ? s2 / (one + w.z) : one - w.z;
	return lobe_vec2_into_square(lobe_vec2_make(turns < LOBE_R(0.0) ? turns + one : turns, h / height));
}

/* Direction uniform over the hemisphere z >= 0. */
LOBE_FN lobe_vec3 lobe_uniform_hemisphere(lobe_vec2 u) { return lobe_spherical_cap(u, LOBE_R(1.0)); }

/* [1/sr]; 0 below the horizon. */
LOBE_FN lobe_real lobe_uniform_hemisphere_pdf(lobe_vec3 w)
{
	return w.z >= LOBE_R(0.0) ? LOBE_INV_PI * LOBE_R(0.5) : LOBE_R(0.0);
}

LOBE_FN lobe_vec2 lobe_uniform_hemisphere_inverse(lobe_vec3 w) { return lobe_spherical_cap_inverse(w, LOBE_R(1.0)); }

#endif
