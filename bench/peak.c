/* peak.c - how many vector instructions of a kind a thread can do in a second: compiled with the options of the
 * library's loops, once for each instruction set, LOBE_ROW_ISA. */
#include "peak.h"
#include "timing.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

#if defined(__AVX512F__)
enum { LANES = 16 };
#elif defined(__AVX2__)
enum { LANES = 8 };
#else
enum { LANES = 4 };
#endif
typedef float vector __attribute__((vector_size(4 * LANES)));

/* Chains enough to hide any latency, few enough for the registers. */
enum { CHAINS = 10, ROUNDS = 20000 };

#if defined(__AVX512F__)
#define ROOT(x)        __asm__ volatile("vsqrtps %0, %0" : "+v"(x))
#define QUOTIENT(x, y) __asm__ volatile("vdivps %1, %0, %0" : "+v"(x) : "v"(y))
#define PRODUCT(x, y)  __asm__ volatile("vmulps %1, %0, %0" : "+v"(x) : "v"(y))
#elif defined(__AVX2__)
#define ROOT(x)        __asm__ volatile("vsqrtps %0, %0" : "+x"(x))
#define QUOTIENT(x, y) __asm__ volatile("vdivps %1, %0, %0" : "+x"(x) : "x"(y))
#define PRODUCT(x, y)  __asm__ volatile("vmulps %1, %0, %0" : "+x"(x) : "x"(y))
#elif defined(__SSE2__)
#define ROOT(x)        __asm__ volatile("sqrtps %0, %0" : "+x"(x))
#define QUOTIENT(x, y) __asm__ volatile("divps %1, %0" : "+x"(x) : "x"(y))
#define PRODUCT(x, y)  __asm__ volatile("mulps %1, %0" : "+x"(x) : "x"(y))
#endif

#ifdef ROOT

#define LOOP(name, STEP)                                                                                               \
	static double name(void)                                                                                       \
	{                                                                                                              \
		vector x[CHAINS], y;                                                                                   \
		for (int k = 0; k < LANES; k++)                                                                        \
			y[k] = 1.0f;                                                                                   \
		for (int c = 0; c < CHAINS; c++)                                                                       \
			x[c] = y;                                                                                      \
		vector a = x[0], b = x[1], d = x[2], e = x[3], f = x[4], g = x[5], h = x[6], i = x[7], j = x[8],       \
		       l = x[9];                                                                                       \
		const double start = bench_now();                                                                      \
		for (int r = 0; r < ROUNDS; r++) {                                                                     \
			STEP(a);                                                                                       \
			STEP(b);                                                                                       \
			STEP(d);                                                                                       \
			STEP(e);                                                                                       \
			STEP(f);                                                                                       \
			STEP(g);                                                                                       \
			STEP(h);                                                                                       \
			STEP(i);                                                                                       \
			STEP(j);                                                                                       \
			STEP(l);                                                                                       \
		}                                                                                                      \
		return (bench_now() - start) / (ROUNDS * (double)CHAINS);                                              \
	}

#define STEP_ROOT(v)     ROOT(v)
#define STEP_QUOTIENT(v) QUOTIENT(v, y)
#define STEP_PRODUCT(v)  PRODUCT(v, y)
LOOP(roots, STEP_ROOT)
LOOP(quotients, STEP_QUOTIENT)
LOOP(products, STEP_PRODUCT)

#else

static double roots(void) { return 0.0; }
static double quotients(void) { return 0.0; }
static double products(void) { return 0.0; }

#endif

/* The shortest of some: what the processor can, not what others left of it. */
static double shortest(double (*time)(void))
{
	double best = time();
	for (int i = 0; i < 20; i++) {
		const double again = time();
		best = again < best ? again : best;
	}
	return best;
}

void PASTE(bench_peak_, LOBE_ROW_ISA)(bench_peak *peak)
{
	peak->lanes = LANES;
	peak->arithmetic = shortest(products);
	peak->division = shortest(quotients);
	peak->root = shortest(roots);
}
