/* real.h - elementary functions with the same bits on every backend.
 *
 * lobe_sincos_2pi lobe_sin lobe_cos lobe_tan lobe_asin lobe_acos lobe_atan lobe_atan2   trig.h
 * lobe_exp lobe_exp2 lobe_log lobe_log2 lobe_pow                                        explog.h
 * lobe_erf lobe_erfcx lobe_ierfcx lobe_erfinv                                           erf.h
 *
 * Where more is known of the argument: lobe_sincos_2pi_small, lobe_exp_normal, lobe_exp_or_zero, lobe_log_normal,
 * lobe_log_rough.
 *
 * In single precision each is a few polynomials without a branch, a loop, a table or a call into libm, so that a row
 * loop over them vectorises. What could be ill defined is selected away before it happens: no float leaves the range of
 * the integer it is converted to.
 *
 * Errors are in ulp: |result - exact| over the distance of floats at the exact value (2^-149 for a subnormal one).
 * "Measured" is the maximum over all 2^32 arguments, found by tests/long_real.c; for two arguments it is over
 * 3e7 random ones (tests/test_real.c holds a smaller number to it). Polynomials were fitted by sollya's fpminimax with
 * single-precision coefficients.
 *
 * A NaN argument gives a NaN, and so does one outside the domain; it has the same bits everywhere (except from
 * lobe_sincos_2pi, which does not spend the two selects). Subnormal numbers must not be flushed to zero.
 *
 * With LOBE_DOUBLE the same names are those of libm in double. */
#ifndef LOBE_CORE_REAL_H
#define LOBE_CORE_REAL_H

#include "../backend/backend.h"

typedef struct {
	lobe_real s, c;
} lobe_sincos;

typedef struct {
	lobe_real num, den;
} lobe_quotient;

#if LOBE_DOUBLE

LOBE_FN lobe_real lobe_times_sign(lobe_real x, lobe_real s) { return signbit(s) ? -x : x; }
LOBE_FN lobe_real lobe_sin(lobe_real x) { return sin(x); }
LOBE_FN lobe_real lobe_cos(lobe_real x) { return cos(x); }
LOBE_FN lobe_real lobe_tan(lobe_real x) { return tan(x); }
LOBE_FN lobe_real lobe_asin(lobe_real x) { return asin(x); }
LOBE_FN lobe_real lobe_acos(lobe_real x) { return acos(x); }
LOBE_FN lobe_real lobe_atan(lobe_real x) { return atan(x); }
LOBE_FN lobe_real lobe_atan2(lobe_real y, lobe_real x) { return atan2(y, x); }
LOBE_FN lobe_real lobe_exp(lobe_real x) { return exp(x); }
LOBE_FN lobe_real lobe_exp_normal(lobe_real x) { return exp(x); }
LOBE_FN lobe_real lobe_exp_or_zero(lobe_real x) { return exp(x); }
LOBE_FN lobe_real lobe_exp2(lobe_real x) { return exp2(x); }
LOBE_FN lobe_real lobe_log(lobe_real x) { return log(x); }
LOBE_FN lobe_real lobe_log_rough(lobe_real x) { return log(x); }
LOBE_FN lobe_real lobe_log2(lobe_real x) { return log2(x); }
LOBE_FN lobe_real lobe_pow(lobe_real x, lobe_real y) { return x < 0.0 && y != 0.0 ? (double)NAN : pow(fabs(x), y); }
LOBE_FN lobe_real lobe_erf(lobe_real x) { return erf(x); }

/* The quarter turn is taken off exactly before 2 pi, which is not a double, comes in. */
LOBE_FN lobe_sincos lobe_sincos_2pi(lobe_real u)
{
	const lobe_real turn = u - rint(u);
	const lobe_real quarter = rint(4.0 * turn);
	const lobe_real angle = 0x1.921fb54442d18p+2 * (turn - 0.25 * quarter);
	const lobe_real s = sin(angle);
	const lobe_real c = cos(angle);
	lobe_sincos r;
	r.s = quarter == 0.0 ? s : quarter == 1.0 ? c : quarter == -1.0 ? -c : -s;
	r.c = quarter == 0.0 ? c : quarter == 1.0 ? -s : quarter == -1.0 ? s : -c;
	return r;
}
LOBE_FN lobe_sincos lobe_sincos_2pi_small(lobe_real u) { return lobe_sincos_2pi(u); }

LOBE_FN lobe_real lobe_sqrt_above(lobe_real x)
{
	uint64_t bits;
	memcpy(&bits, &x, sizeof bits);
	bits = (bits >> 1) + UINT64_C(0x1ff8000000000000);
	memcpy(&x, &bits, sizeof x);
	return x;
}

/* From x = 3 on by the tail T = (1/2)/(x + 1/(x + (3/2)/(x + ... of the continued fraction sqrt(pi) erfcx(x) = 1/(x +
 * T), good to a rounding; below, by the definitions. */
LOBE_FN lobe_real lobe_erfcx_tail(lobe_real x)
{
	lobe_real t = 0.0;
	for (int k = 60; k > 0; k--)
		t = 0.5 * k / (x + t);
	return t;
}

LOBE_FN lobe_real lobe_erfcx(lobe_real x)
{
	const lobe_real v = x < 3.0 ? exp(x * x) * erfc(x) : 0x1.20dd750429b6dp-1 / (x + lobe_erfcx_tail(x));
	return x >= 0.0 ? v : (double)NAN;
}

LOBE_FN lobe_quotient lobe_erfcx_quotient(lobe_real x)
{
	lobe_quotient r;
	r.num = lobe_erfcx(x);
	r.den = 1.0;
	return r;
}

LOBE_FN lobe_real lobe_ierfcx(lobe_real x)
{
	const lobe_real t = lobe_erfcx_tail(x);
	const lobe_real inner = 0x1.20dd750429b6dp-1 - x * (exp(x * x) * erfc(x));
	const lobe_real outer = 0x1.20dd750429b6dp-1 / (x + t) * t;
	return x >= 0.0 ? (x < 3.0 ? inner : outer) : (double)NAN;
}

/* One step of Halley's method on erf(y) = a, or on erfc(y) = c, c = 1 - a, whose relative error stays small
 * near a = 1. */
LOBE_FN lobe_real lobe_erfinv_halley(lobe_real a, lobe_real c, lobe_real y)
{
	const lobe_real residual = a < 0.5 ? erf(y) - a : c - erfc(y);
	const lobe_real step = residual * exp(y * y) * 0x1.c5bf891b4ef6bp-1;
	return y - step / (1.0 + y * step);
}

/* The y with erf(y) = x, |x| < 1, from d = 1 - x^2. Starts with Winitzki 2008, "A handy approximation for the error
 * function and its inverse" (2e-3). */
LOBE_FN lobe_real lobe_erfinv_from(lobe_real x, lobe_real d)
{
	const lobe_real a = fabs(x);
	const lobe_real c = d / (1.0 + a);
	const lobe_real l = (a < 0.5 ? log1p(-(a * a)) : log(d)) / 2.0;
	const lobe_real b = 4.330746750799873 + l;
	const lobe_real e = -2.0 * l / 0.147;
	lobe_real y = sqrt(e / (sqrt(b * b + e) + b));
	y = lobe_erfinv_halley(a, c, y);
	y = lobe_erfinv_halley(a, c, y);
	y = lobe_erfinv_halley(a, c, y);
	return copysign(y, x);
}

LOBE_FN lobe_real lobe_erfinv(lobe_real x)
{
	const lobe_real a = fabs(x);
	const lobe_real y = lobe_erfinv_from(x, (1.0 - a) * (1.0 + a));
	return a < 1.0 ? y : a == 1.0 ? x * HUGE_VAL : (double)NAN;
}

#else

LOBE_FN lobe_real lobe_real_nan(void) { return lobe_from_bits(0x7fc00000u); }
LOBE_FN lobe_real lobe_real_inf(void) { return lobe_from_bits(0x7f800000u); }
/* v, or the one NaN that every function returns: what arithmetic does to a NaN's bits differs between processors. */
LOBE_FN lobe_real lobe_nan_or(lobe_real x, lobe_real v) { return x == x ? v : lobe_real_nan(); }

LOBE_FN lobe_uint lobe_sign_bit(lobe_real x) { return lobe_to_bits(x) & 0x80000000u; }
LOBE_FN lobe_real lobe_flip_sign(lobe_real x, lobe_uint sign_bit) { return lobe_from_bits(lobe_to_bits(x) ^ sign_bit); }
/* x, or -x where s carries a minus. */
LOBE_FN lobe_real lobe_times_sign(lobe_real x, lobe_real s) { return lobe_flip_sign(x, lobe_sign_bit(s)); }

/* The root of x >= 0 from above, by at most 1/16 of it and 1e-19, but for the last bit: half the bits are half the exponent, and of the
 * fraction what makes the least of the tangents to the root at the powers of 4. Two integer operations. */
LOBE_FN lobe_real lobe_sqrt_above(lobe_real x) { return lobe_from_bits((lobe_to_bits(x) >> 1) + 0x1fc00000u); }

#include "trig.h"
#include "explog.h"
#include "erf.h"

#endif
#endif
