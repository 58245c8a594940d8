/* light_shape.h - a light as a disk and a glow around one direction and a sky over the surface: for recommend.h, and to
 * draw directions from. */
#ifndef LOBE_LIGHT_SHAPE_H
#define LOBE_LIGHT_SHAPE_H

#include "core/frame.h"
#include "core/warp.h"

/* disk, glow, in [0, 1], at most 1 together: their shares of the light. solid_angle [sr], in (0, 2 pi]: of the disk,
 * which has a sharp edge. exponent, >= 0: the n of a glow that falls off like ((1 + cos)/2)^n. slope, >= -1: the rest
 * is a sky of radiance 1 + slope cos(angle to the surface's normal): 2 for the CIE's overcast one, -2/3 for one three
 * times as bright at the horizon as overhead. */
typedef struct {
	lobe_vec3 axis;
	lobe_real disk, solid_angle, glow, exponent, slope;
} lobe_light_shape;

/* A sky alone; 0: the same from everywhere above. */
LOBE_FN lobe_light_shape lobe_light_shape_sky(lobe_real slope)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	lobe_light_shape s;
	s.axis = lobe_vec3_make(zero, zero, one);
	s.disk = s.glow = s.exponent = zero;
	s.solid_angle = one;
	s.slope = slope;
	return s;
}

/* A sun or a lamp; the rest comes evenly from above. */
LOBE_FN lobe_light_shape lobe_light_shape_disk(lobe_vec3 axis, lobe_real solid_angle, lobe_real share)
{
	lobe_light_shape s = lobe_light_shape_sky(LOBE_R(0.0));
	s.axis = axis;
	s.disk = share;
	s.solid_angle = solid_angle;
	return s;
}

/* The same with a glow around it: a veil, a window. solid_angle [sr]: of a uniform light as concentrated, (integral of
 * L)^2 over integral of L^2, which is 4 pi (2 n + 1)/(n + 1)^2. */
LOBE_FN lobe_light_shape lobe_light_shape_with_glow(lobe_light_shape s, lobe_real solid_angle, lobe_real share)
{
	const lobe_real q = lobe_max(LOBE_R(2.0) * LOBE_2PI / solid_angle, LOBE_R(1.0));
	s.glow = share;
	s.exponent = q - LOBE_R(1.0) + lobe_sqrt(q * (q - LOBE_R(1.0)));
	return s;
}

/* A glow alone, around axis, as lobe_light_shape_with_glow has it, and over it for the rest a sky that is the same from
 * everywhere above. */
LOBE_FN lobe_light_shape lobe_light_shape_glow(lobe_vec3 axis, lobe_real solid_angle, lobe_real share)
{
	const lobe_light_shape s = lobe_light_shape_disk(axis, LOBE_R(1.0), LOBE_R(0.0));
	return lobe_light_shape_with_glow(s, solid_angle, share);
}

/* With which the light's directions are drawn: its radiance over all of its power [1/sr]. */
LOBE_FN lobe_real lobe_light_shape_density(lobe_light_shape l, lobe_vec3 w)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	/* |w - axis|^2 = 2 (1 - cos) = solid angle/pi at the edge; |w + axis|^2 = 2 (1 + cos) */
	const lobe_vec3 chord = lobe_vec3_fma(-one, l.axis, w), other = lobe_vec3_add(l.axis, w);
	const int inside = lobe_dot(chord, chord) <= l.solid_angle * LOBE_INV_PI;
	const lobe_real n = l.exponent;
	const lobe_real glow =
		(n + one) * (LOBE_R(0.25) * LOBE_INV_PI) * lobe_pow(LOBE_R(0.25) * lobe_dot(other, other), n);
	const lobe_real sky = lobe_fma(l.slope, w.z, one) / (LOBE_2PI * lobe_fma(LOBE_R(0.5), l.slope, one));
	const lobe_real rest = w.z > zero ? (one - l.disk - l.glow) * sky : zero;
	return lobe_fma(l.glow, glow, lobe_fma(l.disk, inside ? one / l.solid_angle : zero, rest));
}

/* A direction of that density. u: in [0,1)^3; u.z chooses between disk, glow and sky. */
LOBE_FN lobe_vec3 lobe_light_shape_draw(lobe_light_shape l, lobe_vec3 u)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0), two = LOBE_R(2.0);
	/* 1 - cos of the point at fraction u.y, and z from z + slope z^2/2 = c. */
	const lobe_real disk = u.y * l.solid_angle / LOBE_2PI;
	const lobe_real glow = two * (one - lobe_pow(one - u.y, one / (l.exponent + one)));
	const lobe_real c = u.y * lobe_fma(LOBE_R(0.5), l.slope, one);
	const lobe_real z = lobe_min(two * c / (one + lobe_sqrt(lobe_max(lobe_fma(two * l.slope, c, one), zero))), one);
	const int around = u.z < l.disk + l.glow;
	const lobe_real height = u.z < l.disk ? disk : (around ? glow : one - z);
	/* The rim of a cap of this height. */
	const lobe_vec3 w = lobe_spherical_cap(lobe_vec2_make(u.x, one), height);
	return around ? lobe_frame_to_world(lobe_frame_from_normal(l.axis), w) : w;
}

#endif
