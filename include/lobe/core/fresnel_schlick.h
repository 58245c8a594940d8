/* fresnel_schlick.h - reflectances that are set, not derived: Schlick's curve and what artists' tools have made of it.
 *
 * c as in fresnel.h, in [0, 1]. Every argument that is a reflectance lies in [0, 1], and so does every result. All of
 * them keep f0 at normal incidence exactly.
 *
 *	constant         f
 *	schlick          f0 + (1 - f0)(1 - c)^5                         Schlick 1994
 *	schlick_f90      f0 + (f90 - f0)(1 - c)^5                       f90 = f0: constant, to the bit
 *	schlick_power    f0 + (f90 - f0)(1 - c)^e                       any exponent
 *	f82              schlick - b c (1 - c)^6                        Kutz et al. 2021, Hoffman 2019
 *	hoffman          schlick_power - b c (1 - c)^6
 *
 * In the last two, c (1 - c)^6 is largest at c = 1/7 (81.8 degrees), where metals dip below Schlick's curve, and b is
 * found from what the lobe is there: as a fraction of Schlick's value ("tint") or outright.
 *
 * Schlick's largest distance from the exact dielectric is .21 at index 1.1, .060 at 1.33, .036 at 1.5, .044 at 2 and
 * .20 at 4; from the metals of optics.def .21 (tungsten), where f82 fitted at 1/7 stays within .033. Single precision
 * adds 2.4e-7 (tests/test_fresnel_schlick.c): of 1, and so it is for a curve that falls to an f90 below f0 at grazing
 * angles. Its f0 (1 - w) + f90 w, with 1 - w as c times a sum of powers, would be exact to itself; it is not done, as
 * every other curve would pay for it. From the dense side use the transmitted cosine as c. */
#ifndef LOBE_CORE_FRESNEL_SCHLICK_H
#define LOBE_CORE_FRESNEL_SCHLICK_H

#include "real.h"
#include "vec.h"

LOBE_FN lobe_rgb lobe_fresnel_constant_rgb(lobe_real c, lobe_rgb f)
{
	(void)c;
	return f;
}

/* (1 - c)^5 */
LOBE_FN lobe_real lobe_fresnel_schlick_weight(lobe_real c)
{
	const lobe_real m = LOBE_R(1.0) - c;
	const lobe_real m2 = m * m;
	return m2 * m2 * m;
}

/* f0 at weight 0, f90 at weight 1. */
LOBE_FN lobe_real lobe_fresnel_schlick_mix(lobe_real weight, lobe_real f0, lobe_real f90)
{
	return lobe_fma(f90 - f0, weight, f0);
}

LOBE_FN lobe_rgb lobe_fresnel_schlick_mix_rgb(lobe_real weight, lobe_rgb f0, lobe_rgb f90)
{
	return lobe_rgb_make(lobe_fresnel_schlick_mix(weight, f0.r, f90.r),
			     lobe_fresnel_schlick_mix(weight, f0.g, f90.g),
			     lobe_fresnel_schlick_mix(weight, f0.b, f90.b));
}

/* Schlick's reflectance f0 + (f90 - f0) (1 - c)^5 at the cosine c in [0, 1]; f0, f90 in [0, 1]: at normal incidence and
 * at grazing, 1 where it is not given. _rgb: of three colours. */
LOBE_FN lobe_real lobe_fresnel_schlick(lobe_real c, lobe_real f0)
{
	return lobe_fresnel_schlick_mix(lobe_fresnel_schlick_weight(c), f0, LOBE_R(1.0));
}

LOBE_FN lobe_rgb lobe_fresnel_schlick_rgb(lobe_real c, lobe_rgb f0)
{
	const lobe_real one = LOBE_R(1.0);
	return lobe_fresnel_schlick_mix_rgb(lobe_fresnel_schlick_weight(c), f0, lobe_rgb_make(one, one, one));
}

LOBE_FN lobe_real lobe_fresnel_schlick_f90(lobe_real c, lobe_real f0, lobe_real f90)
{
	return lobe_fresnel_schlick_mix(lobe_fresnel_schlick_weight(c), f0, f90);
}

LOBE_FN lobe_rgb lobe_fresnel_schlick_f90_rgb(lobe_real c, lobe_rgb f0, lobe_rgb f90)
{
	return lobe_fresnel_schlick_mix_rgb(lobe_fresnel_schlick_weight(c), f0, f90);
}

/* exponent: > 0. At 5 off from schlick_f90 by a few roundings. */
LOBE_FN lobe_real lobe_fresnel_schlick_power(lobe_real c, lobe_real f0, lobe_real f90, lobe_real exponent)
{
	return lobe_fresnel_schlick_mix(lobe_pow(LOBE_R(1.0) - c, exponent), f0, f90);
}

LOBE_FN lobe_rgb lobe_fresnel_schlick_power_rgb(lobe_real c, lobe_rgb f0, lobe_rgb f90, lobe_real exponent)
{
	return lobe_fresnel_schlick_mix_rgb(lobe_pow(LOBE_R(1.0) - c, exponent), f0, f90);
}

/* c (1 - c)^6 divided by its largest value, (6/7)^6/7. */
LOBE_FN lobe_real lobe_fresnel_dip_weight(lobe_real c)
{
	const lobe_real m = LOBE_R(1.0) - c;
	const lobe_real m2 = m * m;
	return LOBE_R(17.651384602194787) * c * (m2 * m2 * m2);
}

/* (6/7)^5, the weight of f90 in Schlick's curve where the dip is deepest. */
#define LOBE_FRESNEL_DIP_SCHLICK LOBE_R(0.46266436603795)

/* How deep the dip of f82 is, b times the largest value of c (1 - c)^6. tint: the reflectance at 81.8 degrees over that
 * of Schlick's curve, 1 for no dip. */
LOBE_FN lobe_real lobe_fresnel_f82_depth(lobe_real f0, lobe_real tint)
{
	return lobe_fresnel_schlick_mix(LOBE_FRESNEL_DIP_SCHLICK, f0, LOBE_R(1.0)) * (LOBE_R(1.0) - tint);
}

/* The same from the reflectance at 81.8 degrees itself; above Schlick's curve the depth is negative, a bulge. */
LOBE_FN lobe_real lobe_fresnel_f82_depth_from_value(lobe_real f0, lobe_real f82)
{
	return lobe_fresnel_schlick_mix(LOBE_FRESNEL_DIP_SCHLICK, f0, LOBE_R(1.0)) - f82;
}

/* The same for lobe_fresnel_hoffman, whose curve has an end and an exponent of its own. */
LOBE_FN lobe_real lobe_fresnel_hoffman_depth(lobe_real f0, lobe_real f90, lobe_real exponent, lobe_real tint)
{
	const lobe_real weight = lobe_pow(LOBE_R(0.857142857142857143), exponent);
	return lobe_fresnel_schlick_mix(weight, f0, f90) * (LOBE_R(1.0) - tint);
}

/* curve - depth times the dip's weight, which a deep dip may carry below 0 and a bulge above 1. */
LOBE_FN lobe_real lobe_fresnel_dip(lobe_real dip_weight, lobe_real curve, lobe_real depth)
{
	return lobe_clamp(lobe_fma(-depth, dip_weight, curve), LOBE_R(0.0), LOBE_R(1.0));
}

/* depth: lobe_fresnel_f82_depth or _from_value. */
LOBE_FN lobe_real lobe_fresnel_f82(lobe_real c, lobe_real f0, lobe_real depth)
{
	return lobe_fresnel_dip(lobe_fresnel_dip_weight(c), lobe_fresnel_schlick(c, f0), depth);
}

LOBE_FN lobe_rgb lobe_fresnel_f82_rgb(lobe_real c, lobe_rgb f0, lobe_rgb depth)
{
	const lobe_real weight = lobe_fresnel_dip_weight(c);
	const lobe_rgb curve = lobe_fresnel_schlick_rgb(c, f0);
	return lobe_rgb_make(lobe_fresnel_dip(weight, curve.r, depth.r), lobe_fresnel_dip(weight, curve.g, depth.g),
			     lobe_fresnel_dip(weight, curve.b, depth.b));
}

/* depth: lobe_fresnel_hoffman_depth. */
LOBE_FN lobe_real lobe_fresnel_hoffman(lobe_real c, lobe_real f0, lobe_real f90, lobe_real exponent, lobe_real depth)
{
	return lobe_fresnel_dip(lobe_fresnel_dip_weight(c), lobe_fresnel_schlick_power(c, f0, f90, exponent), depth);
}

LOBE_FN lobe_rgb lobe_fresnel_hoffman_rgb(lobe_real c, lobe_rgb f0, lobe_rgb f90, lobe_real exponent, lobe_rgb depth)
{
	const lobe_real weight = lobe_fresnel_dip_weight(c);
	const lobe_rgb curve = lobe_fresnel_schlick_power_rgb(c, f0, f90, exponent);
	return lobe_rgb_make(lobe_fresnel_dip(weight, curve.r, depth.r), lobe_fresnel_dip(weight, curve.g, depth.g),
			     lobe_fresnel_dip(weight, curve.b, depth.b));
}

#endif
