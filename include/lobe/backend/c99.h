/* c99.h - the shared source as C99 (and C++17).
 *
 * For the same bits as every other backend compile with -ffp-contract=off: where neither the option nor the pragma
 * below is honoured (gcc in GNU mode, on a processor with fused multiply-add) a compiler may fuse a*b+c by itself. */
#ifndef LOBE_BACKEND_C99_H
#define LOBE_BACKEND_C99_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#if defined(__cplusplus) && __cplusplus < 201703L && defined(__STRICT_ANSI__)
#error "lobe's constants are hexadecimal: C++ has them from C++17 on (-std=c++17)"
#endif

/* 16 and 32 are 0 in a compiler that has types narrower than float, or as narrow. */
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 && FLT_EVAL_METHOD != 32
#error "lobe needs float arithmetic in float: on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "lobe's bits and its guards against NaN do not survive -ffast-math"
#endif

#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

typedef uint32_t lobe_uint;
typedef int32_t lobe_int;
typedef uint64_t lobe_uint64;

/* Word i of the table (core/table.h) at that address. */
#define LOBE_FETCH_FLOAT(address, i) (((const float *)(uintptr_t)(address))[i])

/* A row loop sets LOBE_FN to an always-inline form, since a loop with a call in it does not vectorise. */
#ifndef LOBE_FN
#define LOBE_FN static inline
#endif

/* LOBE_FN_APART: large functions that choose at run time. They stay calls in loops too, which then do not vectorise but
 * compile in seconds. */
#ifndef LOBE_FN_APART
#define LOBE_FN_APART LOBE_FN
#endif

#if LOBE_DOUBLE

typedef double lobe_real;
#define LOBE_R(x)     x
#define LOBE_REAL_MAX DBL_MAX
LOBE_FN lobe_real lobe_fma(lobe_real a, lobe_real b, lobe_real c) { return fma(a, b, c); }
LOBE_FN lobe_real lobe_sqrt(lobe_real x) { return sqrt(x); }
LOBE_FN lobe_real lobe_abs(lobe_real x) { return fabs(x); }

#else

typedef float lobe_real;
#define LOBE_R(x)     x##f
#define LOBE_REAL_MAX FLT_MAX

LOBE_FN lobe_real lobe_sqrt(lobe_real x) { return sqrtf(x); }
LOBE_FN lobe_real lobe_abs(lobe_real x) { return fabsf(x); }

LOBE_FN lobe_uint lobe_to_bits(lobe_real x)
{
	lobe_uint b;
	memcpy(&b, &x, sizeof b);
	return b;
}

LOBE_FN lobe_real lobe_from_bits(lobe_uint b)
{
	lobe_real x;
	memcpy(&x, &b, sizeof x);
	return x;
}

/* clang has the instruction without saying so in __FP_FAST_FMAF. */
#if defined(__FP_FAST_FMAF) || defined(__FMA__) || defined(__ARM_FEATURE_FMA)

LOBE_FN lobe_real lobe_fma(lobe_real a, lobe_real b, lobe_real c) { return fmaf(a, b, c); }

#else

/* a*b + c rounded once, on a processor without the instruction; unlike libm's fmaf it vectorises.
 * The product of two floats is exact in double. The double sum is rounded to odd (Boldo and Melquiond 2008, "Emulation
 * of FMA and correctly rounded sums"): with the rounding error of the sum known exactly (Knuth's TwoSum) the sum is cut
 * off towards 0, and its last bit set where anything was lost. Rounding that to float is correct, since 53 >= 24 + 2.
 * An infinite or NaN sum has a NaN error and stays as it is. All on the bits, with what SSE2 has: no 64-bit comparison,
 * no signed shift, and nothing that a compiler would turn into a branch. */
LOBE_FN lobe_real lobe_fma(lobe_real a, lobe_real b, lobe_real c)
{
	const uint64_t sign = 0x8000000000000000u, magnitude = 0x7fffffffffffffffu, mantissa = 0x000fffffffffffffu;
	const double p = (double)a * (double)b;
	const double d = (double)c;
	const double s = p + d;
	const double dd = s - p;
	const double err = (p - (s - dd)) + (d - dd);
	uint64_t bits, err_bits;
	double odd;
	memcpy(&bits, &s, sizeof bits);
	memcpy(&err_bits, &err, sizeof err_bits);
	const uint64_t size = err_bits & magnitude;
	const uint64_t nan = (size + mantissa) >> 63;
	const uint64_t inexact = ((size + magnitude) >> 63) ^ nan;
	const uint64_t too_far = inexact & (((err_bits ^ bits) & sign) >> 63);
	bits = (bits - too_far) | inexact;
	memcpy(&odd, &bits, sizeof odd);
	/* gcc 12 at -O2 drops the rounding of a (float) that is used as a double again where it finds two side by side.
	 * The bits or-ed in are always 0, which it cannot know. */
	return lobe_from_bits(lobe_to_bits((lobe_real)odd) | (lobe_uint)(nan & inexact));
}

#endif
#endif
#endif
