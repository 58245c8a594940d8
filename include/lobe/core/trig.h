/* trig.h - sine, cosine, tangent and their inverses; a part of real.h, to be included by that
 * alone. */
#ifndef LOBE_CORE_TRIG_H
#define LOBE_CORE_TRIG_H

/* Angles are reduced to `turn` whole turns, |turn| <= 1/8, plus a number of quarter turns. In turns the reduction of
 * lobe_sincos_2pi is exact and the one below ends in a fixed-point fraction. 2 pi is split into its nearest float C and
 * the rest, which is inside the first coefficient, so the leading term C*turn is rounded once, together with the rest.
 */
#define LOBE_TWO_PI_HI LOBE_R(0x1.921fb6p+2)

/* sin(2 pi turn) - C*turn, for square = turn*turn. */
LOBE_FN lobe_real lobe_sin_turn_rest(lobe_real turn, lobe_real square)
{
	lobe_real p = LOBE_R(-0x1.2d9e5ap+6);
	p = lobe_fma(p, square, LOBE_R(0x1.465edcp+6));
	p = lobe_fma(p, square, LOBE_R(-0x1.4abbbap+5));
	p = lobe_fma(p, square, LOBE_R(-0x1.9e5f06p-23));
	return turn * p;
}

/* Sine and cosine of 2 pi u for |u| <= 2^16, reduced exactly, so the zeros and +-1 at multiples of a quarter are exact.
 *
 * Adding 1.5*2^21 rounds to quarters, and their number is in the last bits of the sum. 12 floating-point operations, 7
 * of them fma, and 11 on integers. */
LOBE_FN lobe_sincos lobe_sincos_2pi_small(lobe_real u)
{
	const lobe_real quarters = LOBE_R(0x1.8p+21);
	const lobe_real shifted = u + quarters;
	const lobe_real turn = u - (shifted - quarters);
	const lobe_real square = turn * turn;
	const lobe_uint quadrant = lobe_to_bits(shifted);
	const lobe_real s = lobe_fma(turn, LOBE_TWO_PI_HI, lobe_sin_turn_rest(turn, square));
	lobe_real c = LOBE_R(-0x1.4eb114p+6);
	c = lobe_fma(c, square, LOBE_R(0x1.03b18ep+6));
	c = lobe_fma(c, square, LOBE_R(-0x1.3bd3a2p+4));
	c = lobe_fma(c, square, LOBE_R(1.0));

	const lobe_uint swap = quadrant & 1u;
	lobe_sincos r;
	r.s = lobe_flip_sign(swap ? c : s, (quadrant & 2u) << 30);
	r.c = lobe_flip_sign(swap ? s : c, ((quadrant + 1u) & 2u) << 30);
	return r;
}

/* The same for every finite u. Measured: sin 1.41 ulp at u = 0.12503843, cos 1.42 ulp at u = 0.124978222.
 *
 * Adding 1.5*2^24 rounds to multiples of 2 turns: the difference is exact, at most 1 for |u| < 2^23, and for larger u
 * (all whole numbers) whole. */
LOBE_FN lobe_sincos lobe_sincos_2pi(lobe_real u)
{
	const lobe_real twos = LOBE_R(0x1.8p+24);
	return lobe_sincos_2pi_small(u - ((u + twos) - twos));
}

/* An angle of `quadrant` quarter turns + (turn + rest) turns, and the sine and cosine of the second part with what
 * rounding took from them. */
typedef struct {
	lobe_real s, c, s_rest, c_rest;
	lobe_uint quadrant;
} lobe_reduced_angle;

/* 32 bits out of the 64 in (high, low), from bit `shift` < 32 on. */
LOBE_FN lobe_uint lobe_window(lobe_uint high, lobe_uint low, lobe_uint shift)
{
	return (high << shift) | ((low >> 1) >> (31u - shift));
}

/* |x| in radians, reduced for every float after Payne and Hanek 1983, "Radian reduction for trigonometric functions".
 *
 * x = m 2^(e-150) with a 24-bit integer m. x*2/pi modulo 4 needs only 96 bits of 2/pi, from the one that m's last bit
 * turns into 2 quarter turns on: those before it give multiples of 4, those after it less than 2^-70, while no float is
 * closer than 2^-31 to a quarter turn. The first 224 bits of 2/pi follow 32 zeros; the window starts at bit e-120 >= 6.
 * The product is kept as 64 bits of fixed point with 2 before the point.
 * Below 1/2 a product with 1/(2 pi) in two floats keeps the relative precision that fixed point would lose. */
LOBE_FN lobe_reduced_angle lobe_reduce_angle(lobe_real magnitude)
{
	const lobe_uint bits = lobe_to_bits(magnitude);
	const lobe_uint exponent = bits >> 23;
	const lobe_uint start = (exponent < 126u ? 126u : exponent) - 120u;
	const lobe_uint word = start >> 5;
	const lobe_uint shift = start & 31u;
	const lobe_uint b0 = 0u, b1 = 0xa2f9836eu, b2 = 0x4e441529u, b3 = 0xfc2757d1u;
	const lobe_uint b4 = 0xf534ddc0u, b5 = 0xdb629599u, b6 = 0x3c439041u, b7 = 0xfe5163abu;
	const lobe_uint c0 = word == 0u ? b0 : word == 1u ? b1 : word == 2u ? b2 : word == 3u ? b3 : b4;
	const lobe_uint c1 = word == 0u ? b1 : word == 1u ? b2 : word == 2u ? b3 : word == 3u ? b4 : b5;
	const lobe_uint c2 = word == 0u ? b2 : word == 1u ? b3 : word == 2u ? b4 : word == 3u ? b5 : b6;
	const lobe_uint c3 = word == 0u ? b3 : word == 1u ? b4 : word == 2u ? b5 : word == 3u ? b6 : b7;
	const lobe_uint w0 = lobe_window(c0, c1, shift);
	const lobe_uint w1 = lobe_window(c1, c2, shift);
	const lobe_uint w2 = lobe_window(c2, c3, shift);
	const lobe_uint m = (bits & 0x7fffffu) | 0x800000u;
	const lobe_uint64 product = ((lobe_uint64)(m * w0) << 32) + (lobe_uint64)m * w1 + (((lobe_uint64)m * w2) >> 32);

	/* The fraction, in two's complement so that it is at most half a quarter turn, in pieces of 24, 24 and 16 bits.
	 */
	const lobe_uint64 fraction = product << 2;
	const lobe_int top = (lobe_int)((lobe_uint)(fraction >> 40) ^ 0x800000u) - 0x800000;
	const lobe_int middle = (lobe_int)((lobe_uint)(fraction >> 16) & 0xffffffu);
	const lobe_int bottom = (lobe_int)((lobe_uint)fraction & 0xffffu);
	const lobe_real fixed_top = (lobe_real)top * LOBE_R(0x1p-26);
	const lobe_real fixed_middle = (lobe_real)middle * LOBE_R(0x1p-50);
	const lobe_real fixed = fixed_top + fixed_middle;
	const lobe_real fixed_rest = lobe_fma((lobe_real)bottom, LOBE_R(0x1p-66), fixed_middle - (fixed - fixed_top));

	const lobe_real inverse = LOBE_R(0x1.45f306p-3);
	const lobe_real little = magnitude * inverse;
	const lobe_real small_rest = lobe_fma(magnitude, LOBE_R(0x1.b9391p-28), lobe_fma(magnitude, inverse, -little));

	const lobe_uint is_small = exponent < 126u;
	const lobe_real turn = is_small ? little : fixed;
	const lobe_real rest = is_small ? small_rest : fixed_rest;
	const lobe_real square = turn * turn;
	lobe_reduced_angle r;
	r.quadrant = is_small ? 0u : (lobe_uint)(product >> 62) + ((lobe_uint)(product >> 61) & 1u);

	const lobe_real s_small = lobe_fma(rest, LOBE_TWO_PI_HI, lobe_sin_turn_rest(turn, square));
	r.s = lobe_fma(turn, LOBE_TWO_PI_HI, s_small);
	r.s_rest = lobe_fma(turn, LOBE_TWO_PI_HI, -r.s) + s_small;

	lobe_real q = LOBE_R(0x1.d61e28p+5);
	q = lobe_fma(q, square, LOBE_R(-0x1.55b684p+6));
	q = lobe_fma(q, square, LOBE_R(0x1.03c1b6p+6));
	q = lobe_fma(q, square, LOBE_R(-0x1.3bd3ccp+4));
	const lobe_real c_small = lobe_fma(q, square, -(rest * LOBE_TWO_PI_HI) * r.s);
	r.c = LOBE_R(1.0) + c_small;
	r.c_rest = c_small - (r.c - LOBE_R(1.0));
	return r;
}

/* Sine of x radians. Domain: every float; an infinity gives NaN. Measured: 1.14 ulp at x = 3.94333686e31. */
LOBE_FN lobe_real lobe_sin(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_reduced_angle r = lobe_reduce_angle(a);
	const lobe_real y = r.quadrant & 1u ? r.c : r.s;
	const lobe_real v = lobe_flip_sign(y, lobe_sign_bit(x) ^ ((r.quadrant & 2u) << 30));
	return a < LOBE_R(0x1p-13) ? x : (a <= LOBE_REAL_MAX ? v : lobe_real_nan());
}

/* Cosine of x radians. Domain: every float; an infinity gives NaN. Measured: 1.14 ulp at x = 4.65055066e14. */
LOBE_FN lobe_real lobe_cos(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_reduced_angle r = lobe_reduce_angle(a);
	const lobe_real y = r.quadrant & 1u ? r.s : r.c;
	const lobe_real v = lobe_flip_sign(y, ((r.quadrant + 1u) & 2u) << 30);
	return a <= LOBE_REAL_MAX ? v : lobe_real_nan();
}

/* Tangent of x radians. Domain: every float; an infinity gives NaN. Measured: 1.74 ulp at x = 1.3501991e16.
 * The quotient gets back, to first order, what was rounded off numerator, denominator and quotient. */
LOBE_FN lobe_real lobe_tan(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_reduced_angle r = lobe_reduce_angle(a);
	const lobe_uint odd = r.quadrant & 1u;
	const lobe_real num = odd ? r.c : r.s;
	const lobe_real den = odd ? r.s : r.c;
	const lobe_real num_rest = odd ? r.c_rest : r.s_rest;
	const lobe_real den_rest = odd ? r.s_rest : r.c_rest;
	const lobe_real inverse = LOBE_R(1.0) / den;
	const lobe_real t = num * inverse;
	const lobe_real remainder = lobe_fma(-t, den, num) + lobe_fma(-t, den_rest, num_rest);
	const lobe_real v = lobe_flip_sign(lobe_fma(remainder, inverse, t), lobe_sign_bit(x) ^ (odd << 31));
	return a < LOBE_R(0x1p-13) ? x : (a <= LOBE_REAL_MAX ? v : lobe_real_nan());
}

#define LOBE_HALF_PI_HI LOBE_R(0x1.921fb6p+0)
#define LOBE_HALF_PI_LO LOBE_R(-0x1.777a5cp-25)

/* asin(z) - z for 0 <= z <= 1/2 and square = z*z. */
LOBE_FN lobe_real lobe_asin_rest(lobe_real z, lobe_real square)
{
	lobe_real p = LOBE_R(0x1.5959aap-5);
	p = lobe_fma(p, square, LOBE_R(0x1.8c415ap-6));
	p = lobe_fma(p, square, LOBE_R(0x1.747b72p-5));
	p = lobe_fma(p, square, LOBE_R(0x1.330206p-4));
	p = lobe_fma(p, square, LOBE_R(0x1.5555c8p-3));
	return z * (p * square);
}

/* Arc sine. Domain: [-1, 1], NaN outside; asin(-0) = -0. Measured: 1.68 ulp at x = 0.528326213.
 * Above 1/2 it is pi/2 - 2 asin(sqrt((1 - |x|)/2)). */
LOBE_FN lobe_real lobe_asin(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_uint big = a > LOBE_R(0.5);
	const lobe_real square = big ? lobe_fma(LOBE_R(-0.5), a, LOBE_R(0.5)) : a * a;
	const lobe_real z = big ? lobe_sqrt(square) : a;
	const lobe_real rest = lobe_asin_rest(z, square);
	const lobe_real factor = big ? LOBE_R(-2.0) : LOBE_R(1.0);
	const lobe_real n = big ? LOBE_R(1.0) : LOBE_R(0.0);
	const lobe_real tail = lobe_fma(factor, z, lobe_fma(factor, rest, n * LOBE_HALF_PI_LO));
	const lobe_real v = lobe_fma(n, LOBE_HALF_PI_HI, tail);
	return a <= LOBE_R(1.0) ? lobe_flip_sign(v, lobe_sign_bit(x)) : lobe_real_nan();
}

/* Arc cosine. Domain: [-1, 1], NaN outside; acos(1) = +0. Measured: 1.16 ulp at x = 0.541320026.
 * n pi/2 + factor*asin(z): pi/2 - asin(x) in the middle, 2 asin(z) above 1/2 and pi - 2 asin(z) below -1/2. */
LOBE_FN lobe_real lobe_acos(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_uint big = a > LOBE_R(0.5);
	const lobe_uint negative = x < LOBE_R(0.0);
	const lobe_real square = big ? lobe_fma(LOBE_R(-0.5), a, LOBE_R(0.5)) : a * a;
	const lobe_real z = big ? lobe_sqrt(square) : x;
	const lobe_real rest = lobe_asin_rest(z, square);
	const lobe_real factor = big ? (negative ? LOBE_R(-2.0) : LOBE_R(2.0)) : LOBE_R(-1.0);
	const lobe_real n = big ? (negative ? LOBE_R(2.0) : LOBE_R(0.0)) : LOBE_R(1.0);
	const lobe_real tail = lobe_fma(factor, z, lobe_fma(factor, rest, n * LOBE_HALF_PI_LO));
	const lobe_real v = lobe_fma(n, LOBE_HALF_PI_HI, tail);
	return a <= LOBE_R(1.0) ? v : lobe_real_nan();
}

/* n pi/2 + factor*atan(z) for 0 <= z <= 1. The second coefficient was moved by 5 of its ulps, so that atan(1) comes out
 * as the float nearest to pi/4. */
LOBE_FN lobe_real lobe_atan_octant(lobe_real z, lobe_real factor, lobe_real n)
{
	const lobe_real square = z * z;
	lobe_real p = LOBE_R(-0x1.d5a1aap-10);
	p = lobe_fma(p, square, LOBE_R(0x1.6551ecp-7));
	p = lobe_fma(p, square, LOBE_R(-0x1.fe7d24p-6));
	p = lobe_fma(p, square, LOBE_R(0x1.da9c2ep-5));
	p = lobe_fma(p, square, LOBE_R(-0x1.5825f2p-4));
	p = lobe_fma(p, square, LOBE_R(0x1.c0946cp-4));
	p = lobe_fma(p, square, LOBE_R(-0x1.24211ap-3));
	p = lobe_fma(p, square, LOBE_R(0x1.9991ecp-3));
	p = lobe_fma(p, square, LOBE_R(-0x1.55553ep-2));
	const lobe_real rest = z * (p * square);
	const lobe_real head = lobe_fma(n, LOBE_HALF_PI_HI, factor * z);
	const lobe_real tail = lobe_fma(n, LOBE_HALF_PI_LO, factor * rest);
	return head + tail;
}

/* Arc tangent. Domain: every float; atan(-0) = -0, atan(+-inf) = +-pi/2. Measured: 1.40 ulp at x = 1.00501323. */
LOBE_FN lobe_real lobe_atan(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_uint big = a > LOBE_R(1.0);
	const lobe_real z = (big ? LOBE_R(1.0) : a) / (big ? a : LOBE_R(1.0));
	const lobe_real y = lobe_atan_octant(z, big ? LOBE_R(-1.0) : LOBE_R(1.0), big ? LOBE_R(1.0) : LOBE_R(0.0));
	return lobe_nan_or(x, lobe_flip_sign(y, lobe_sign_bit(x)));
}

/* The angle of the point (x, y), in [-pi, pi]. Domain: every pair of floats, with all the special values of C99: the
 * signs of zeros count (atan2(+-0, -0) = +-pi, atan2(+-0, +0) = +-0), infinities meet at +-pi/4 and +-3pi/4.
 * Measured: 1.64 ulp at (0x1.b1839ep-30, -0x1.774ed6p-31), of 3e7 random pairs. */
LOBE_FN lobe_real lobe_atan2(lobe_real y, lobe_real x)
{
	const lobe_real ax = lobe_abs(x);
	const lobe_real ay = lobe_abs(y);
	const lobe_uint swap = ay > ax;
	const lobe_uint left = lobe_sign_bit(x) != 0u;
	const lobe_real num = swap ? ax : ay;
	const lobe_real den = swap ? ay : ax;
	/* Two zeros and two infinities have no quotient of their own. */
	const lobe_uint equal = num == den;
	const lobe_real unit = den > LOBE_R(0.0) ? LOBE_R(1.0) : LOBE_R(0.0);
	const lobe_real z = (equal ? unit : num) / (equal ? LOBE_R(1.0) : den);
	const lobe_real factor = swap != left ? LOBE_R(-1.0) : LOBE_R(1.0);
	const lobe_real n = swap ? LOBE_R(1.0) : (left ? LOBE_R(2.0) : LOBE_R(0.0));
	const lobe_real v = lobe_flip_sign(lobe_atan_octant(z, factor, n), lobe_sign_bit(y));
	return ((x == x) & (y == y)) ? v : lobe_real_nan();
}

#endif
