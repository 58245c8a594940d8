/* kernels.cl - loops over shading.h; compiled after it, in the same program.
 *
 * For every lobe and every verb (LOBE_VERBS in src/internal.h) there are three kernels, by how an element finds its
 * parameters:
 *
 *	lobe_kernel_<lobe>_<verb>_one	table[0] for every element
 *	lobe_kernel_<lobe>_<verb>_many	table[slot[material[element]]]
 *	lobe_kernel_<lobe>_<verb>_mixed	the same, for the elements that order[] lists: those of this lobe
 *
 * the last only where LOBE_MIXED is 1: the scene has several lobes. A processor has one for each verb in place of them,
 * lobe_kernel_mixed_<verb> (mixed.cl).
 *
 * Each runs the indices [first, last), LOBE_RUN of them in one work-item. On a GPU that is 1, so that adjacent
 * work-items touch adjacent memory, and the loop turns into an `if` for the padded global size. On a processor, where
 * LOBE_LOOPS is 1, it is the argument run, many, and the groups hold one work-item: then the compiler sees an ordinary
 * loop and vectorises it, as it does the native ones. (PoCL 3.1 would rather not: left to loop over work-items itself,
 * it first packs the three colours of one element into a vector, and gives up on every body with a guard in it. That is
 * 5 to 20 times slower.)
 *
 * The loop's body has no branch. In "many" a material without a lobe (slot LOBE_NO_SLOT) or out of range shades with
 * table[0] and the result is replaced by 0.
 *
 * src/opencl_launch.c sets the arguments in the order in which they stand here. */

#ifndef LOBE_LOOPS
#define LOBE_LOOPS 0
#endif
/* LOBE_STACK: the widest vector, which is of no use but that its place is aligned. PoCL's compiler leaves the frame
 * pointer out of the function that it puts a kernel into, finds too late that vectors go to the stack, and puts them
 * there aligned to 16 bytes, across cache lines: a sample of beckmann_dielectric took 1.24 times as long. */
#if LOBE_LOOPS
#define LOBE_RUN   run
#define LOBE_STACK volatile float16 aligned = (float16)(0.0f);
#else
#define LOBE_RUN (ulong)1
#define LOBE_STACK
#endif
#ifndef LOBE_MIXED
#define LOBE_MIXED 1
#endif

#define LOBE_NO_SLOT 0xFFFFFFFFu

/* For AVX-512, clang (PoCL's compiler) would take vectors of half its registers' width, and of those one at a time.
 * Whole ones take two thirds of the time, and of a sample, which is one long chain of dependent operations, two in
 * flight half of it (ggx_dielectric on Zen 4: 10.7, 6.9 and 5.4 ns). The shorter chains of eval and pdf overlap of
 * themselves, and two of them would not find room in the registers. Elsewhere the compiler chooses: with AVX2 its
 * vectors are whole. It passes over a loop twice and warns when the first pass has left it alone. */
#if defined(__clang__) && defined(__AVX512VL__)
#pragma clang diagnostic ignored "-Wpass-failed"
#define LOBE_WIDE __attribute__((min_vector_width(512)))
#define LOBE_LOOP_ONCE _Pragma("clang loop vectorize_width(16) interleave_count(1)")
#define LOBE_LOOP_TWICE _Pragma("clang loop vectorize_width(16) interleave_count(2)")
#else
#define LOBE_WIDE
#define LOBE_LOOP_ONCE
#define LOBE_LOOP_TWICE
#endif

/* Before a loop of a verb. */
#define LOBE_LOOP_eval_f     LOBE_LOOP_ONCE
#define LOBE_LOOP_eval_pdf   LOBE_LOOP_ONCE
#define LOBE_LOOP_eval_f_pdf LOBE_LOOP_ONCE
#define LOBE_LOOP_sample     LOBE_LOOP_TWICE
#define LOBE_LOOP_sample_wi  LOBE_LOOP_TWICE

/* One work-item's share of [first, last), and the loop over it. */
#define LOBE_SHARE                                                                                                     \
	LOBE_STACK                                                                                                     \
	const ulong begin = first + get_global_id(0) * LOBE_RUN;                                                       \
	const ulong end = min(begin + LOBE_RUN, last);
#define LOBE_FOR(i, loop) LOBE_SHARE loop for (ulong i = begin; i < end; i++)

#define LOBE_INPUT(a) __global const float *restrict a##_x, __global const float *restrict a##_y, \
		      __global const float *restrict a##_z
#define LOBE_OUTPUT(a, x, y, z) __global float *restrict a##_##x, __global float *restrict a##_##y, \
				__global float *restrict a##_##z
#define LOBE_LOAD(a) lobe_vec3_make(a##_x[e], a##_y[e], a##_z[e])
#define LOBE_STORE(to, value) to[e] = ok ? (value) : 0.0f

/* --- verbs: arrays and body. e: element; p: its parameters; ok: whether it has any. --- */

#define LOBE_ARRAYS_eval_f LOBE_INPUT(wo), LOBE_INPUT(wi), LOBE_OUTPUT(f, r, g, b)
#define LOBE_ARRAYS_eval_pdf LOBE_INPUT(wo), LOBE_INPUT(wi), __global float *restrict pdf
#define LOBE_ARRAYS_eval_f_pdf LOBE_ARRAYS_eval_f, __global float *restrict pdf
#define LOBE_ARRAYS_sample LOBE_INPUT(wo), LOBE_INPUT(u), LOBE_OUTPUT(wi, x, y, z), LOBE_OUTPUT(weight, r, g, b), \
		__global float *restrict pdf, __global uint *restrict event
#define LOBE_ARRAYS_sample_wi LOBE_INPUT(wo), LOBE_INPUT(u), LOBE_OUTPUT(wi, x, y, z), __global uint *restrict event

#define LOBE_BODY_eval_f(lobe)                                                                                         \
	const lobe_rgb f = lobe_##lobe##_eval(p, LOBE_LOAD(wo), LOBE_LOAD(wi));                                        \
	LOBE_STORE(f_r, f.r);                                                                                          \
	LOBE_STORE(f_g, f.g);                                                                                          \
	LOBE_STORE(f_b, f.b);

#define LOBE_BODY_eval_pdf(lobe)                                                                                       \
	const lobe_real density = lobe_##lobe##_pdf(p, LOBE_LOAD(wo), LOBE_LOAD(wi));                                  \
	LOBE_STORE(pdf, density);

#define LOBE_BODY_eval_f_pdf(lobe) LOBE_BODY_eval_f(lobe) LOBE_BODY_eval_pdf(lobe)

#define LOBE_BODY_sample_wi(lobe)                                                                                      \
	const lobe_sample s = lobe_##lobe##_sample(p, LOBE_LOAD(wo), LOBE_LOAD(u));                                    \
	LOBE_STORE(wi_x, s.wi.x);                                                                                      \
	LOBE_STORE(wi_y, s.wi.y);                                                                                      \
	LOBE_STORE(wi_z, s.wi.z);                                                                                      \
	event[e] = ok ? s.event : 0u;

#define LOBE_BODY_sample(lobe)                                                                                         \
	LOBE_BODY_sample_wi(lobe)                                                                                      \
	LOBE_STORE(weight_r, s.weight.r);                                                                              \
	LOBE_STORE(weight_g, s.weight.g);                                                                              \
	LOBE_STORE(weight_b, s.weight.b);                                                                              \
	LOBE_STORE(pdf, s.pdf);

/* --- parameters: where they are, and number i of them. A lobe that may carry a table (core/table.h) finds in its handle
 * the place of the table in the scene's flat buffer, in bytes; here it becomes an address. --- */

#define LOBE_TABLE_plain(lobe) __global const lobe_##lobe *restrict table
#define LOBE_TABLE_tabled(lobe) __global const lobe_##lobe *restrict table, __global const float *restrict tables
#define LOBE_AT_plain(lobe, i) table[i]
#define LOBE_AT_tabled(lobe, i) lobe_tabled_##lobe(table[i], (ulong)tables)
#define LOBE_X(NAME, lobe, kind)
#define LOBE_X_TABLED(NAME, lobe, kind)                                                                                \
	LOBE_FN lobe_##lobe lobe_tabled_##lobe(lobe_##lobe p, ulong tables)                                            \
	{                                                                                                              \
		const lobe_table t = p.surface.distribution.table;                                                     \
		p.surface.distribution.table = lobe_table_at(tables + lobe_table_address(t));                          \
		return p;                                                                                              \
	}
#include "../include/lobe/lobes/lobes.def"
#undef LOBE_X

/* --- kernels --- */

#if LOBE_MIXED && !LOBE_LOOPS
#define LOBE_KERNEL_MIXED(lobe, verb, form)                                                                            \
	__kernel LOBE_WIDE void lobe_kernel_##lobe##_##verb##_mixed(                                                   \
		ulong first, ulong last, ulong run, LOBE_TABLE_##form(lobe),                                           \
		__global const uint *restrict slot, __global const uint *restrict material,                            \
		__global const uint *restrict order, ulong base, LOBE_ARRAYS_##verb)                                   \
	{                                                                                                              \
		LOBE_FOR(i, LOBE_LOOP_##verb) {                                                                        \
			const ulong e = base + order[i];                                                               \
			const bool ok = true;                                                                          \
			const lobe_##lobe p = LOBE_AT_##form(lobe, slot[material[e]]);                                 \
			LOBE_BODY_##verb(lobe)                                                                         \
		}                                                                                                      \
	}
#else
#define LOBE_KERNEL_MIXED(lobe, verb, form)
#endif

#define LOBE_KERNELS(lobe, verb, form)                                                                                 \
	__kernel LOBE_WIDE void lobe_kernel_##lobe##_##verb##_one(                                                     \
		ulong first, ulong last, ulong run, LOBE_TABLE_##form(lobe), LOBE_ARRAYS_##verb)                       \
	{                                                                                                              \
		LOBE_FOR(e, LOBE_LOOP_##verb) {                                                                        \
			const bool ok = true;                                                                          \
			const lobe_##lobe p = LOBE_AT_##form(lobe, 0);                                                 \
			LOBE_BODY_##verb(lobe)                                                                         \
		}                                                                                                      \
	}                                                                                                              \
	__kernel LOBE_WIDE void lobe_kernel_##lobe##_##verb##_many(                                                    \
		ulong first, ulong last, ulong run, LOBE_TABLE_##form(lobe),                                           \
		__global const uint *restrict slot, uint slot_count, __global const uint *restrict material,           \
		LOBE_ARRAYS_##verb)                                                                                    \
	{                                                                                                              \
		LOBE_FOR(e, LOBE_LOOP_##verb) {                                                                        \
			const uint m = material[e];                                                                    \
			const uint place = slot[m < slot_count ? m : 0u];                                              \
			const bool ok = (m < slot_count) & (place != LOBE_NO_SLOT);                                    \
			const lobe_##lobe p = LOBE_AT_##form(lobe, ok ? place : 0u);                                   \
			LOBE_BODY_##verb(lobe)                                                                         \
		}                                                                                                      \
	}                                                                                                              \
	LOBE_KERNEL_MIXED(lobe, verb, form)

#define LOBE_KERNELS_OF(lobe, form)                                                                                    \
	LOBE_KERNELS(lobe, eval_f, form)                                                                               \
	LOBE_KERNELS(lobe, eval_pdf, form)                                                                             \
	LOBE_KERNELS(lobe, eval_f_pdf, form)                                                                           \
	LOBE_KERNELS(lobe, sample, form)                                                                               \
	LOBE_KERNELS(lobe, sample_wi, form)

#define LOBE_X(NAME, lobe, kind) LOBE_KERNELS_OF(lobe, plain)
#define LOBE_X_TABLED(NAME, lobe, kind) LOBE_KERNELS_OF(lobe, tabled)
#include "../include/lobe/lobes/lobes.def"
#undef LOBE_X

/* Elements whose material is LOBE_KIND_NONE: 0, whose bits are the same for every type. */
__kernel void lobe_kernel_zero(ulong first, ulong last, ulong run, __global uint *restrict out)
{
	LOBE_FOR(e, LOBE_LOOP_ONCE)
		out[e] = 0u;
}

#if LOBE_MIXED && LOBE_LOOPS
#define LOBE_VERB eval_f
#include "mixed.cl"
#define LOBE_VERB eval_pdf
#include "mixed.cl"
#define LOBE_VERB eval_f_pdf
#include "mixed.cl"
#define LOBE_VERB sample
#include "mixed.cl"
#define LOBE_VERB sample_wi
#include "mixed.cl"
#elif LOBE_MIXED
__kernel void lobe_kernel_zero_mixed(ulong first, ulong last, ulong run, __global const uint *restrict order,
				     ulong base, __global uint *restrict out)
{
	LOBE_FOR(i, LOBE_LOOP_ONCE)
		out[base + order[i]] = 0u;
}
#endif
