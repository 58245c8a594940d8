/* opencl.h - the shared source as OpenCL C 1.2 or later. Single precision only.
 *
 * Build with -cl-fp32-correctly-rounded-divide-sqrt and without any relaxed-math option (lobe_opencl_options() gives
 * the full list): then + - * / sqrt and fma are IEEE 754 and every result has the same bits as in C. */
#ifndef LOBE_BACKEND_OPENCL_H
#define LOBE_BACKEND_OPENCL_H

#pragma OPENCL FP_CONTRACT OFF

typedef float lobe_real;
typedef uint lobe_uint;
typedef int lobe_int;
typedef ulong lobe_uint64;

#define LOBE_R(x)     x##f
#define LOBE_REAL_MAX 0x1.fffffep+127f

/* Word i of the table (core/table.h) at that address. */
#define LOBE_FETCH_FLOAT(address, i) (((__global const float *)(size_t)(address))[i])

/* Where the compiler is clang for x86-64 (PoCL) a struct of floats would travel as <2 x float>, and what is not inlined
 * stays a call: either stops its loop vectoriser. */
#ifndef LOBE_FN
#if defined(__clang__) && defined(__x86_64__)
#define LOBE_FN static inline __attribute__((always_inline, regcall))
#else
#define LOBE_FN static inline
#endif
#endif

/* Large functions that choose at run time: calls, so that a program with them builds in seconds. Where all is chosen
 * before, they are as small as any. */
#if LOBE_ONLY_ONE
#define LOBE_FN_APART LOBE_FN
#elif defined(__clang__)
#define LOBE_FN_APART static __attribute__((noinline))
#else
#define LOBE_FN_APART static
#endif

LOBE_FN lobe_real lobe_fma(lobe_real a, lobe_real b, lobe_real c) { return fma(a, b, c); }
LOBE_FN lobe_real lobe_sqrt(lobe_real x) { return sqrt(x); }
LOBE_FN lobe_real lobe_abs(lobe_real x) { return fabs(x); }
LOBE_FN lobe_uint lobe_to_bits(lobe_real x) { return as_uint(x); }
LOBE_FN lobe_real lobe_from_bits(lobe_uint b) { return as_float(b); }

#endif
