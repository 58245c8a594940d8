/* mixed.cl - the kernel of a verb for batches of several lobes, on a processor. A template without a guard, that
 * kernels.cl includes once for each LOBE_VERB.
 *
 *	lobe_kernel_mixed_<verb>	lobe_table[slot[material[element]]], of the lobe number[material[element]]
 *
 * A work-item brings LOBE_SORT elements at a time together by their lobes' numbers, which are those of lobes.def as the
 * program has them, with LOBE_NUMBER_NONE for materials that have none; shades each lobe's where they lie side by side;
 * and puts the results back. The caller's arrays are walked through in order, which a processor foresees, and what is at
 * random stays in its first-level cache. LOBE_BODY finds the work-item's own arrays under the names of the kernel's,
 * which are far_ here. Where all of a lobe's elements are of one material, as most are in a scene that has one of each
 * lobe, its parameters stay in registers. */

#if !defined LOBE_SORT
#define LOBE_SORT    1024u
#define LOBE_VECTORS 32u /* elements that a vectorised loop takes at a time: each lobe's begin at a multiple of it */
#define LOBE_ROOM    (LOBE_SORT + LOBE_NUMBERS * LOBE_VECTORS)

enum {
#define LOBE_X(NAME, lobe, kind) LOBE_NUMBER_##lobe,
#include "../include/lobe/lobes/lobes.def"
#undef LOBE_X
	LOBE_NUMBER_NONE,
	LOBE_NUMBERS
};

#define LOBE_DIRECTIONS(M, a)    M(a##_x) M(a##_y) M(a##_z)
#define LOBE_INPUTS_eval_f(M)    LOBE_DIRECTIONS(M, wo) LOBE_DIRECTIONS(M, wi)
#define LOBE_INPUTS_eval_pdf(M)  LOBE_INPUTS_eval_f(M)
#define LOBE_INPUTS_eval_f_pdf(M) LOBE_INPUTS_eval_f(M)
#define LOBE_INPUTS_sample(M)    LOBE_DIRECTIONS(M, wo) LOBE_DIRECTIONS(M, u)
#define LOBE_INPUTS_sample_wi(M) LOBE_INPUTS_sample(M)
/* EVENT: what M is to floats. */
#define LOBE_OUTPUTS_eval_f(M, EVENT)     M(f_r) M(f_g) M(f_b)
#define LOBE_OUTPUTS_eval_pdf(M, EVENT)   M(pdf)
#define LOBE_OUTPUTS_eval_f_pdf(M, EVENT) LOBE_OUTPUTS_eval_f(M, EVENT) M(pdf)
#define LOBE_OUTPUTS_sample(M, EVENT)     LOBE_OUTPUTS_sample_wi(M, EVENT) M(weight_r) M(weight_g) M(weight_b) M(pdf)
#define LOBE_OUTPUTS_sample_wi(M, EVENT)  LOBE_DIRECTIONS(M, wi) EVENT(event)

#define LOBE_FAR_IN(a)     __global const float *restrict far_##a = a;
#define LOBE_FAR_OUT(a)    __global float *restrict far_##a = a;
#define LOBE_FAR_EVENT(a)  __global uint *restrict far_##a = a;
#define LOBE_NEAR(a)       float a[LOBE_ROOM];
#define LOBE_NEAR_EVENT(a) uint a[LOBE_ROOM];
#define LOBE_FETCH(a)      a[to] = far_##a[base + j];
#define LOBE_FILL(a)       a[e] = a[begin[k]];
#define LOBE_PUT(a)        far_##a[base + j] = a[rank[j]];
#define LOBE_ZERO(a)       a[e] = 0;

#ifdef __clang__
#define LOBE_ONE_BY_ONE _Pragma("clang loop vectorize(disable)")
#else
#define LOBE_ONE_BY_ONE
#endif

#define LOBE_MIXED_TABLE_plain(lobe)  __global const lobe_##lobe *restrict table_##lobe
#define LOBE_MIXED_TABLE_tabled(lobe) LOBE_MIXED_TABLE_plain(lobe), __global const float *restrict tables_##lobe
#define LOBE_MIXED_FIND_plain(lobe)   __global const lobe_##lobe *restrict table = table_##lobe;
#define LOBE_MIXED_FIND_tabled(lobe)                                                                                   \
	LOBE_MIXED_FIND_plain(lobe) __global const float *restrict tables = tables_##lobe;

/* The elements of a lobe, and those that fill its last vectors, but of a lobe that chooses at run time: it has none. */
#define LOBE_MIXED_STOP_plain(lobe)  begin[LOBE_NUMBER_##lobe + 1]
#define LOBE_MIXED_STOP_tabled(lobe) next[LOBE_NUMBER_##lobe]
#define LOBE_MIXED_LOBE(verb, lobe, form)                                                                              \
	if (begin[LOBE_NUMBER_##lobe] < begin[LOBE_NUMBER_##lobe + 1]) {                                               \
		LOBE_MIXED_FIND_##form(lobe)                                                                           \
		const uint start = begin[LOBE_NUMBER_##lobe], stop = LOBE_MIXED_STOP_##form(lobe);                     \
		uint differ = 0u;                                                                                      \
		for (uint e = start; e < stop; e++)                                                                    \
			differ |= place[e] ^ place[start];                                                             \
		if (differ == 0u) {                                                                                    \
			const lobe_##lobe p = LOBE_AT_##form(lobe, place[start]);                                      \
			LOBE_LOOP_##verb for (uint e = start; e < stop; e++) {                                         \
				LOBE_BODY_##verb(lobe)                                                                 \
			}                                                                                              \
		} else {                                                                                               \
			LOBE_LOOP_##verb for (uint e = start; e < stop; e++) {                                         \
				const lobe_##lobe p = LOBE_AT_##form(lobe, place[e]);                                  \
				LOBE_BODY_##verb(lobe)                                                                 \
			}                                                                                              \
		}                                                                                                      \
	}

/* With LOBE_VERB in place of its name. */
#define LOBE_OF_VERB_(name, verb) name##verb
#define LOBE_OF_VERB(name, verb)  LOBE_OF_VERB_(name, verb)
#define LOBE_MIXED_LOBE_OF(verb, lobe, form) LOBE_MIXED_LOBE(verb, lobe, form)
#endif

__kernel LOBE_WIDE void LOBE_OF_VERB(lobe_kernel_mixed_, LOBE_VERB)(
	ulong first, ulong last, ulong run,
#define LOBE_X(NAME, lobe, kind)        LOBE_MIXED_TABLE_plain(lobe),
#define LOBE_X_TABLED(NAME, lobe, kind) LOBE_MIXED_TABLE_tabled(lobe),
#include "../include/lobe/lobes/lobes.def"
#undef LOBE_X
	__global const uint *restrict number, __global const uint *restrict slot,
	__global const uint *restrict material, LOBE_OF_VERB(LOBE_ARRAYS_, LOBE_VERB))
{
	LOBE_OF_VERB(LOBE_INPUTS_, LOBE_VERB)(LOBE_FAR_IN)
	LOBE_OF_VERB(LOBE_OUTPUTS_, LOBE_VERB)(LOBE_FAR_OUT, LOBE_FAR_EVENT)
	const bool ok = true;
	const ulong mine = first + get_global_id(0) * LOBE_RUN, finish = min(mine + LOBE_RUN, last);
	for (ulong base = mine; base < finish; base += LOBE_SORT) {
		const uint count = (uint)min(finish - base, (ulong)LOBE_SORT);
		uint begin[LOBE_NUMBERS + 1], next[LOBE_NUMBERS], key[LOBE_SORT], rank[LOBE_SORT], place[LOBE_ROOM];
		LOBE_OF_VERB(LOBE_INPUTS_, LOBE_VERB)(LOBE_NEAR)
		LOBE_OF_VERB(LOBE_OUTPUTS_, LOBE_VERB)(LOBE_NEAR, LOBE_NEAR_EVENT)
		for (uint k = 0u; k < LOBE_NUMBERS; k++)
			next[k] = 0u;
		LOBE_ONE_BY_ONE for (uint j = 0u; j < count; j++) {
			key[j] = number[material[base + j]];
			next[key[j]]++;
		}
		begin[0] = 0u;
		for (uint k = 0u; k < LOBE_NUMBERS; k++) {
			begin[k + 1u] = begin[k] + (next[k] + LOBE_VECTORS - 1u) / LOBE_VECTORS * LOBE_VECTORS;
			next[k] = begin[k];
		}
		LOBE_ONE_BY_ONE for (uint j = 0u; j < count; j++) {
			const uint to = next[key[j]]++;
			rank[j] = to;
			place[to] = slot[material[base + j]];
			LOBE_OF_VERB(LOBE_INPUTS_, LOBE_VERB)(LOBE_FETCH)
		}
		for (uint k = 0u; k < LOBE_NUMBERS; k++)
			for (uint e = next[k]; e < begin[k + 1u]; e++) {
				place[e] = place[begin[k]];
				LOBE_OF_VERB(LOBE_INPUTS_, LOBE_VERB)(LOBE_FILL)
			}
#define LOBE_X(NAME, lobe, kind)        LOBE_MIXED_LOBE_OF(LOBE_VERB, lobe, plain)
#define LOBE_X_TABLED(NAME, lobe, kind) LOBE_MIXED_LOBE_OF(LOBE_VERB, lobe, tabled)
#include "../include/lobe/lobes/lobes.def"
#undef LOBE_X
		for (uint e = begin[LOBE_NUMBER_NONE]; e < begin[LOBE_NUMBERS]; e++) {
			LOBE_OF_VERB(LOBE_OUTPUTS_, LOBE_VERB)(LOBE_ZERO, LOBE_ZERO)
		}
		for (uint j = 0u; j < count; j++) {
			LOBE_OF_VERB(LOBE_OUTPUTS_, LOBE_VERB)(LOBE_PUT, LOBE_PUT)
		}
	}
}
#undef LOBE_VERB
