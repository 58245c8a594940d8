/* real_reference.h - what core/real.h promises, and the exact values to hold it to: for test_real.c and long_real.c. */
#ifndef LOBE_TESTS_REAL_REFERENCE_H
#define LOBE_TESTS_REAL_REFERENCE_H

#include "../include/lobe/core/real.h"

#include "double_reference.h"

#include <mpfr.h>
#include <stddef.h>

#define REFERENCE_BITS 96

/* Every function of one argument. name, symmetry (1: f(-x) = f(x), -1: f(-x) = -f(x), 0: neither), the bound in ulp
 * that the header states, and the value. */
#define REAL_FUNCTIONS(X)                                                                                              \
	X(sin_2pi, -1, 1.41, lobe_sincos_2pi(x).s)                                                                     \
	X(cos_2pi, 1, 1.42, lobe_sincos_2pi(x).c)                                                                      \
	X(sin, -1, 1.14, lobe_sin(x))                                                                                  \
	X(cos, 1, 1.14, lobe_cos(x))                                                                                   \
	X(tan, -1, 1.74, lobe_tan(x))                                                                                  \
	X(asin, -1, 1.68, lobe_asin(x))                                                                                \
	X(acos, 0, 1.16, lobe_acos(x))                                                                                 \
	X(atan, -1, 1.40, lobe_atan(x))                                                                                \
	X(exp, 0, 0.90, lobe_exp(x))                                                                                   \
	X(exp2, 0, 0.88, lobe_exp2(x))                                                                                 \
	X(log, 0, 0.86, lobe_log(x))                                                                                   \
	X(log2, 0, 1.60, lobe_log2(x))                                                                                 \
	X(erf, -1, 1.28, lobe_erf(x))                                                                                  \
	X(erfcx, 0, 6.45, lobe_erfcx(x))                                                                               \
	X(ierfcx, 0, 7.29, lobe_ierfcx(x))                                                                             \
	X(erfinv, -1, 2.40, lobe_erfinv(x))
/* Sampled, not exhausted: a little above the measured maximum. */
#define REAL_ATAN2_BOUND 1.75
#define REAL_POW_BOUND   1.0

/* To REFERENCE_BITS bits. */

static inline void exact_sincos_2pi(mpfr_t v, float u, int cosine)
{
	const double turn = (double)u - rint((double)u);
	const double quarter = rint(4 * turn);
	const int quadrant = ((int)quarter + cosine) & 3;
	mpfr_const_pi(v, MPFR_RNDN);
	mpfr_mul_d(v, v, 2 * (turn - 0.25 * quarter), MPFR_RNDN);
	if (quadrant & 1)
		mpfr_cos(v, v, MPFR_RNDN);
	else
		mpfr_sin(v, v, MPFR_RNDN);
	if (quadrant & 2)
		mpfr_neg(v, v, MPFR_RNDN);
}

static inline void exact_sin_2pi(mpfr_t v, float u)
{
	if (isfinite(u))
		exact_sincos_2pi(v, u, 0);
	else
		mpfr_set_nan(v);
}

static inline void exact_cos_2pi(mpfr_t v, float u)
{
	if (isfinite(u))
		exact_sincos_2pi(v, u, 1);
	else
		mpfr_set_nan(v);
}

#define EXACT_BY_MPFR(name)                                                                                            \
	static inline void exact_##name(mpfr_t v, float x)                                                             \
	{                                                                                                              \
		mpfr_set_flt(v, x, MPFR_RNDN);                                                                         \
		mpfr_##name(v, v, MPFR_RNDN);                                                                          \
	}
EXACT_BY_MPFR(sin)
EXACT_BY_MPFR(cos)
EXACT_BY_MPFR(tan)
EXACT_BY_MPFR(asin)
EXACT_BY_MPFR(acos)
EXACT_BY_MPFR(atan)
EXACT_BY_MPFR(exp)
EXACT_BY_MPFR(exp2)
EXACT_BY_MPFR(log)
EXACT_BY_MPFR(log2)
EXACT_BY_MPFR(erf)

/* From the definitions with as many more bits as they cancel, up to where the first omitted term of the asymptotic
 * series 1 - 1/(2 x^2) + 3/(4 x^4) - ... is below 2^-80; ierfcx: 1/2 - 3/(4 x^2) + 15/(8 x^4) - ... */
static inline void exact_erfcx_times(mpfr_t v, float x, int integral)
{
	mpfr_t a, b;
	if (!(x >= 0)) {
		mpfr_set_nan(v);
		return;
	}
	mpfr_inits2(REFERENCE_BITS + 80, a, b, (mpfr_ptr)0);
	if (x < 4096) {
		mpfr_set_flt(a, x, MPFR_RNDN);
		mpfr_erfc(b, a, MPFR_RNDN);
		mpfr_sqr(a, a, MPFR_RNDN);
		mpfr_exp(a, a, MPFR_RNDN);
		mpfr_mul(b, b, a, MPFR_RNDN);
		if (integral) {
			mpfr_mul_d(b, b, -(double)x, MPFR_RNDN);
			mpfr_const_pi(a, MPFR_RNDN);
			mpfr_rec_sqrt(a, a, MPFR_RNDN);
			mpfr_add(b, b, a, MPFR_RNDN);
		}
	} else {
		const double s = 1 / ((double)x * (double)x);
		mpfr_const_pi(b, MPFR_RNDN);
		mpfr_rec_sqrt(b, b, MPFR_RNDN);
		mpfr_div_d(b, b, (double)x, MPFR_RNDN);
		if (integral)
			mpfr_div_d(b, b, (double)x, MPFR_RNDN);
		mpfr_mul_d(b, b, integral ? 0.5 - s * (0.75 - 1.875 * s) : 1 - s * (0.5 - 0.75 * s), MPFR_RNDN);
	}
	mpfr_set(v, b, MPFR_RNDN);
	mpfr_clears(a, b, (mpfr_ptr)0);
}

static inline void exact_erfcx(mpfr_t v, float x) { exact_erfcx_times(v, x, 0); }
static inline void exact_ierfcx(mpfr_t v, float x) { exact_erfcx_times(v, x, 1); }

/* One step of Newton's method from the value in double, on erfc where 1 - |x| is exact. */
static inline void exact_erfinv(mpfr_t v, float x)
{
	const double a = fabs((double)x);
	const double y = reference_erfinv(a);
	mpfr_set_d(v, y, MPFR_RNDN);
	if (a < 1 && a > 0) {
		mpfr_t f, d;
		mpfr_inits2(REFERENCE_BITS, f, d, (mpfr_ptr)0);
		if (a < 0.5) {
			mpfr_erf(f, v, MPFR_RNDN);
			mpfr_sub_d(f, f, a, MPFR_RNDN);
		} else {
			mpfr_erfc(f, v, MPFR_RNDN);
			mpfr_d_sub(f, 1 - a, f, MPFR_RNDN);
		}
		mpfr_sqr(d, v, MPFR_RNDN);
		mpfr_exp(d, d, MPFR_RNDN);
		mpfr_mul(f, f, d, MPFR_RNDN);
		mpfr_const_pi(d, MPFR_RNDN);
		mpfr_sqrt(d, d, MPFR_RNDN);
		mpfr_div_ui(d, d, 2, MPFR_RNDN);
		mpfr_mul(f, f, d, MPFR_RNDN);
		mpfr_sub(v, v, f, MPFR_RNDN);
		mpfr_clears(f, d, (mpfr_ptr)0);
	}
	if (signbit(x))
		mpfr_neg(v, v, MPFR_RNDN);
}

/* One loop for each function, so that the compiler may vectorise it as it does in a shading loop. */
#define REAL_ROW(name, symmetry, bound, value)                                                                         \
	static void row_##name(size_t n, const float *restrict in, float *restrict out)                                \
	{                                                                                                              \
		for (size_t i = 0; i < n; i++) {                                                                       \
			const float x = in[i];                                                                         \
			out[i] = value;                                                                                \
		}                                                                                                      \
	}
REAL_FUNCTIONS(REAL_ROW)

typedef struct {
	const char *name;
	int symmetry;
	double bound;
	void (*row)(size_t n, const float *restrict in, float *restrict out);
	double (*reference)(double x);
	void (*exact)(mpfr_t v, float x);
} real_function;

#define REAL_ENTRY(name, symmetry, bound, value) {#name, symmetry, bound, row_##name, reference_##name, exact_##name},
static const real_function real_functions[] = {REAL_FUNCTIONS(REAL_ENTRY)};
#define REAL_FUNCTION_COUNT (sizeof real_functions / sizeof *real_functions)

/* |got - exact| in units of the distance of floats at the exact value. Infinity counts as 2^128 where the exact value
 * is finite, as the right answer where it rounds to infinity. A NaN on one side only is infinitely wrong. */
static inline double ulp_error(float got, mpfr_t exact)
{
	if (mpfr_nan_p(exact) || isnan(got))
		return mpfr_nan_p(exact) && isnan(got) ? 0 : HUGE_VAL;
	if (mpfr_inf_p(exact))
		return isinf(got) && (got > 0) == (mpfr_sgn(exact) > 0) ? 0 : HUGE_VAL;
	if (mpfr_zero_p(exact))
		return fabs((double)got) * 0x1p149;
	const mpfr_exp_t e = mpfr_get_exp(exact) - 1;
	const double to_ulps = ldexp(1, 23 - (int)(e < -126 ? -126 : e > 127 ? 127 : e));
	double value = (double)got;
	if (isinf(got)) {
		if (fabs(mpfr_get_d(exact, MPFR_RNDZ)) >= 0x1.ffffffp127 && (got > 0) == (mpfr_sgn(exact) > 0))
			return 0;
		value = got > 0 ? 0x1p128 : -0x1p128;
	}
	mpfr_t difference;
	mpfr_init2(difference, REFERENCE_BITS);
	mpfr_sub_d(difference, exact, value, MPFR_RNDN);
	const double d = mpfr_get_d(difference, MPFR_RNDN);
	mpfr_clear(difference);
	return fabs(d) * to_ulps;
}

/* The same measured from the value in double: 30 times as fast. */
static inline double ulp_error_double(float got, double exact)
{
	if (isnan(exact) || isnan(got))
		return isnan(exact) && isnan(got) ? 0 : HUGE_VAL;
	if (isinf(got) && fabs(exact) >= 0x1.ffffffp127 && (got > 0) == (exact > 0))
		return 0;
	if (isinf(exact))
		return HUGE_VAL;
	/* The power of two at or below the value: its bits without the mantissa. */
	uint64_t bits;
	memcpy(&bits, &exact, sizeof bits);
	bits &= UINT64_C(0x7ff0000000000000);
	double scale;
	memcpy(&scale, &bits, sizeof scale);
	scale = scale < 0x1p-126 ? 0x1p-126 : scale > 0x1p127 ? 0x1p127 : scale;
	const double value = isinf(got) ? copysign(0x1p128, (double)got) : (double)got;
	return fabs(value - exact) * (0x1p23 / scale);
}

#endif
