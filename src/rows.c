/* rows.c - the native loops of one lobe for one instruction set: compiled once for each pair, with
 *	LOBE_ROW      the lobe, e.g. ggx_conductor
 *	LOBE_ROW_ISA  the instruction set, a suffix, e.g. avx2
 * and that instruction set's compiler options.
 *
 * A loop vectorises when all of it is inlined and straight-line, and when the compiler knows that outputs do not alias
 * inputs: hence the always-inline LOBE_FN, and one noinline function per loop whose arrays are restrict parameters.
 * tests/test_vectorised.sh reads the compilers' remarks for the lines ROW_... below. */
#define LOBE_FN static inline __attribute__((always_inline))

/* Functions that choose at run time stay calls; their lobes' loops do not vectorise. */
#ifdef __GNUC__
#define LOBE_FN_APART static __attribute__((noinline, unused))
#endif

#include "rows.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
#define PARAMS       PASTE(lobe_, LOBE_ROW)
#define CALL(verb)   PASTE(PARAMS, verb)

#define NOINLINE static __attribute__((noinline))

/* Parameters of element i: the same for all, or by slot. They are fetched word by word from an array of words, each
 * put where it belongs: clang would fetch a small struct the way it passes one, two floats in a register, and gcc does
 * not see that a struct behind a pointer keeps clear of the outputs; either then gives up vectorising. */
typedef float __attribute__((may_alias)) word;
enum { WORDS = sizeof(PARAMS) / 4, WORDS_MAX = 64 };
typedef char words_max_is_enough[WORDS <= WORDS_MAX ? 1 : -1];

#define ONE  0
#define MANY slot[i] * (size_t)WORDS

#define FETCH_1(k, which)                                                                                              \
	if ((k) < WORDS) {                                                                                             \
		const word w = words[(which) + (k)];                                                                   \
		memcpy((char *)&p + 4 * (k), &w, 4);                                                                   \
	}
#define FETCH_4(k, which) FETCH_1(k, which) FETCH_1(k + 1, which) FETCH_1(k + 2, which) FETCH_1(k + 3, which)
/* clang-format off */
#define FETCH(which)                                                                                                   \
	PARAMS p;                                                                                                      \
	FETCH_4(0, which) FETCH_4(4, which) FETCH_4(8, which) FETCH_4(12, which)                                       \
	FETCH_4(16, which) FETCH_4(20, which) FETCH_4(24, which) FETCH_4(28, which)                                    \
	FETCH_4(32, which) FETCH_4(36, which) FETCH_4(40, which) FETCH_4(44, which)                                    \
	FETCH_4(48, which) FETCH_4(52, which) FETCH_4(56, which) FETCH_4(60, which)
/* clang-format on */

/* clang's cost model would leave a cheap lobe's gathers scalar on SSE2. Of a loop that calls (LOBE_FN_APART) it would
 * say that it does as it must. */
#ifdef __clang__
#pragma clang diagnostic ignored "-Wpass-failed"
#define VECTORISE _Pragma("clang loop vectorize(enable)")
#else
#define VECTORISE
#endif

/* A sample is one long chain of dependent operations, longer than a processor looks ahead: gcc schedules two vectors of
 * them into each other. With SSE2 there are too few registers. clang does so of its own accord where it sees fit. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX2__)
#define TWICE _Pragma("GCC unroll 2")
#else
#define TWICE VECTORISE
#endif

#define INPUTS                                                                                                         \
	const word *restrict words, const uint32_t *restrict slot, size_t n, const float *restrict ox,                 \
		const float *restrict oy, const float *restrict oz, const float *restrict ix,                          \
		const float *restrict iy, const float *restrict iz
#define INPUT_ARGS table, slot, n, in[0], in[1], in[2], in[3], in[4], in[5]
#define WO         lobe_vec3_make(ox[i], oy[i], oz[i])
#define WI_OR_U    lobe_vec3_make(ix[i], iy[i], iz[i])
#define F_OUTPUTS  float *restrict fr, float *restrict fg, float *restrict fb
#define WI_OUTPUTS float *restrict wx, float *restrict wy, float *restrict wz, uint32_t *restrict event
#define STORE_3(x, y, z, v, a, b, c)                                                                                   \
	do {                                                                                                           \
		x[i] = (v).a;                                                                                          \
		y[i] = (v).b;                                                                                          \
		z[i] = (v).c;                                                                                          \
	} while (0)

/* KIND_LOOP defines the loop of a verb, KIND_ARGS is what it takes. */
#define EVAL_F_LOOP(name, which, plain)                                                                                \
	NOINLINE void name(INPUTS, F_OUTPUTS)                                                                          \
	{                                                                                                              \
		(void)slot;                                                                                            \
		VECTORISE for (size_t i = 0; i < n; i++)                                                               \
		{                                                                                                      \
			FETCH(which)                                                                                   \
			plain const lobe_rgb f = CALL(_eval)(p, WO, WI_OR_U);                                          \
			STORE_3(fr, fg, fb, f, r, g, b);                                                               \
		}                                                                                                      \
	}
#define EVAL_F_ARGS INPUT_ARGS, out[0], out[1], out[2]

#define EVAL_PDF_LOOP(name, which, plain)                                                                              \
	NOINLINE void name(INPUTS, float *restrict pdf)                                                                \
	{                                                                                                              \
		(void)slot;                                                                                            \
		VECTORISE for (size_t i = 0; i < n; i++)                                                               \
		{                                                                                                      \
			FETCH(which)                                                                                   \
			plain pdf[i] = CALL(_pdf)(p, WO, WI_OR_U);                                                     \
		}                                                                                                      \
	}
#define EVAL_PDF_ARGS INPUT_ARGS, out[LOBE_OUT_PDF]

#define EVAL_F_PDF_LOOP(name, which, plain)                                                                            \
	NOINLINE void name(INPUTS, F_OUTPUTS, float *restrict pdf)                                                     \
	{                                                                                                              \
		(void)slot;                                                                                            \
		VECTORISE for (size_t i = 0; i < n; i++)                                                               \
		{                                                                                                      \
			FETCH(which)                                                                                   \
			plain const lobe_rgb f = CALL(_eval)(p, WO, WI_OR_U);                                          \
			STORE_3(fr, fg, fb, f, r, g, b);                                                               \
			pdf[i] = CALL(_pdf)(p, WO, WI_OR_U);                                                           \
		}                                                                                                      \
	}
#define EVAL_F_PDF_ARGS INPUT_ARGS, out[0], out[1], out[2], out[LOBE_OUT_PDF]

#define SAMPLE_LOOP(name, which, plain)                                                                                \
	NOINLINE void name(INPUTS, WI_OUTPUTS, F_OUTPUTS, float *restrict pdf)                                         \
	{                                                                                                              \
		(void)slot;                                                                                            \
		TWICE for (size_t i = 0; i < n; i++)                                                                   \
		{                                                                                                      \
			FETCH(which)                                                                                   \
			plain const lobe_sample s = CALL(_sample)(p, WO, WI_OR_U);                                     \
			STORE_3(wx, wy, wz, s.wi, x, y, z);                                                            \
			STORE_3(fr, fg, fb, s.weight, r, g, b);                                                        \
			pdf[i] = s.pdf;                                                                                \
			event[i] = s.event;                                                                            \
		}                                                                                                      \
	}
#define SAMPLE_ARGS                                                                                                    \
	INPUT_ARGS, out[0], out[1], out[2], out[LOBE_OUT_EVENT], out[3], out[4], out[5], out[LOBE_OUT_SAMPLE_PDF]

#define SAMPLE_WI_LOOP(name, which, plain)                                                                             \
	NOINLINE void name(INPUTS, WI_OUTPUTS)                                                                         \
	{                                                                                                              \
		(void)slot;                                                                                            \
		TWICE for (size_t i = 0; i < n; i++)                                                                   \
		{                                                                                                      \
			FETCH(which)                                                                                   \
			plain const lobe_sample s = CALL(_sample)(p, WO, WI_OR_U);                                     \
			STORE_3(wx, wy, wz, s.wi, x, y, z);                                                            \
			event[i] = s.event;                                                                            \
		}                                                                                                      \
	}
#define SAMPLE_WI_ARGS INPUT_ARGS, out[0], out[1], out[2], out[LOBE_OUT_EVENT]

/* Loops over one material come a second time without what few materials need, whose selections take time from all
 * others: where the Makefile names the prefix of the lobe's functions that tell, _is_plain and _plain. */
#ifdef LOBE_ROW_PLAIN
#define IS_PLAIN(table) PASTE(LOBE_ROW_PLAIN, _is_plain)(*(const PARAMS *)(table))
#define PLAIN           p = PASTE(LOBE_ROW_PLAIN, _plain)(p);
#else
#define IS_PLAIN(table) 0
#define PLAIN
#endif

#define ROW_ONE(name, kind)                                                                                            \
	kind##_LOOP(name##_loop, ONE, ) kind##_LOOP(name##_plain_loop, ONE, PLAIN) static void name(                   \
		const void *table, const uint32_t *slot, size_t n, const float *const *in, void *const *out)           \
	{                                                                                                              \
		if (IS_PLAIN(table))                                                                                   \
			name##_plain_loop(kind##_ARGS);                                                                \
		else                                                                                                   \
			name##_loop(kind##_ARGS);                                                                      \
	}

#define ROW_MANY(name, kind)                                                                                           \
	kind##_LOOP(name##_loop, MANY, ) static void name(const void *table, const uint32_t *slot, size_t n,           \
							  const float *const *in, void *const *out)                    \
	{                                                                                                              \
		name##_loop(kind##_ARGS);                                                                              \
	}

#define ROW_EVAL_ONE    ROW_ONE
#define ROW_EVAL_MANY   ROW_MANY
#define ROW_SAMPLE_ONE  ROW_ONE
#define ROW_SAMPLE_MANY ROW_MANY

ROW_EVAL_ONE(eval_f_one, EVAL_F)
ROW_EVAL_ONE(eval_pdf_one, EVAL_PDF)
ROW_EVAL_ONE(eval_f_pdf_one, EVAL_F_PDF)
ROW_SAMPLE_ONE(sample_one, SAMPLE)
ROW_SAMPLE_ONE(sample_wi_one, SAMPLE_WI)
ROW_EVAL_MANY(eval_f_many, EVAL_F)
ROW_EVAL_MANY(eval_pdf_many, EVAL_PDF)
ROW_EVAL_MANY(eval_f_pdf_many, EVAL_F_PDF)
ROW_SAMPLE_MANY(sample_many, SAMPLE)
ROW_SAMPLE_MANY(sample_wi_many, SAMPLE_WI)

const lobe_rows PASTE(PASTE(PASTE(lobe_rows_, LOBE_ROW_ISA), _), LOBE_ROW) = {
#define LOBE_VERB(NAME, name) {name##_one, name##_many},
	{LOBE_VERBS(LOBE_VERB)}
#undef LOBE_VERB
};
