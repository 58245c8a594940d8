/* double_reference.h - the functions of core/real.h in double precision, good to about 1e-8 ulp of a float. */
#ifndef LOBE_TESTS_DOUBLE_REFERENCE_H
#define LOBE_TESTS_DOUBLE_REFERENCE_H

#include "support.h"

#include <math.h>

static inline double reference_sincos_2pi(double u, int cosine)
{
	const double turn = u - rint(u);
	const double quarter = rint(4.0 * turn);
	const double angle = TWO_PI * (turn - 0.25 * quarter);
	const int quadrant = ((int)quarter + cosine) & 3;
	const double v = quadrant & 1 ? cos(angle) : sin(angle);
	return quadrant & 2 ? -v : v;
}

static inline double reference_sin_2pi(double u) { return reference_sincos_2pi(u, 0); }
static inline double reference_cos_2pi(double u) { return reference_sincos_2pi(u, 1); }
static inline double reference_sin(double x) { return sin(x); }
static inline double reference_cos(double x) { return cos(x); }
static inline double reference_tan(double x) { return tan(x); }
static inline double reference_asin(double x) { return asin(x); }
static inline double reference_acos(double x) { return acos(x); }
static inline double reference_atan(double x) { return atan(x); }
static inline double reference_exp(double x) { return exp(x); }
static inline double reference_exp2(double x) { return exp2(x); }
static inline double reference_log(double x) { return log(x); }
static inline double reference_log2(double x) { return log2(x); }
static inline double reference_erf(double x) { return erf(x); }

/* From 2 on by the tail T of sqrt(pi) erfcx(x) = 1/(x + T), T = (1/2)/(x + 1/(x + (3/2)/(x + ... */
static inline double reference_erfcx_tail(double x)
{
	double t = 0;
	for (int k = x < 4 ? 200 : x < 100 ? 30 : 4; k > 0; k--)
		t = 0.5 * k / (x + t);
	return t;
}

static inline double reference_erfcx(double x)
{
	const double inv_sqrt_pi = 0.5641895835477562869;
	if (!(x >= 0))
		return (double)NAN;
	return x < 2 ? exp(x * x) * erfc(x) : inv_sqrt_pi / (x + reference_erfcx_tail(x));
}

static inline double reference_ierfcx(double x)
{
	const double inv_sqrt_pi = 0.5641895835477562869;
	if (!(x >= 0))
		return (double)NAN;
	if (x < 2)
		return inv_sqrt_pi - x * reference_erfcx(x);
	const double t = reference_erfcx_tail(x);
	return inv_sqrt_pi / (x + t) * t;
}

/* Halley's method on erf or erfc, from the closed formula of Winitzki; near 0 the first terms of the series. */
static inline double reference_erfinv(double x)
{
	const double a = fabs(x);
	if (a < 0x1p-12) {
		const double t = a * a;
		return x * 0.8862269254527580137 * (1 + t * (0.2617993877991494365 + t * 0.1439317308490399));
	}
	if (!(a < 1))
		return a > 1 ? (double)NAN : x * HUGE_VAL;
	const double l = log1p(-a * a) / 2;
	const double b = 2 / (PI * 0.147) + l;
	double y = sqrt(sqrt(b * b - 2 * l / 0.147) - b);
	for (int i = 0; i < 3; i++) {
		const double residual = a < 0.5 ? erf(y) - a : (1 - a) - erfc(y);
		const double step = residual * exp(y * y) * 0.8862269254527580137;
		y -= step / (1 + y * step);
	}
	return copysign(y, x);
}

#endif
