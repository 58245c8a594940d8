/* hand.h - ggx_conductor by the library against loops without it: written by hand over the lobe's header, and what an engine
 * has today, one element at a time with libm. */
#ifndef LOBE_BENCH_HAND_H
#define LOBE_BENCH_HAND_H

#include "lobe/lobe.h"

/* Prints the table of one thread and writes it to path. 0 after a failure. */
int bench_hand(size_t n, size_t runs, const char *path);

/* eval+pdf and sample of the whole batch. (hand_rows.c, for each instruction set) */
typedef void (*bench_hand_loop)(const lobe_ggx_conductor *p, const lobe_batch *b);
void bench_hand_eval_baseline(const lobe_ggx_conductor *p, const lobe_batch *b);
void bench_hand_sample_baseline(const lobe_ggx_conductor *p, const lobe_batch *b);
#ifdef LOBE_X86
void bench_hand_eval_avx2(const lobe_ggx_conductor *p, const lobe_batch *b);
void bench_hand_sample_avx2(const lobe_ggx_conductor *p, const lobe_batch *b);
void bench_hand_eval_avx512(const lobe_ggx_conductor *p, const lobe_batch *b);
void bench_hand_sample_avx512(const lobe_ggx_conductor *p, const lobe_batch *b);
#endif

/* The same with libm, element by element. (hand_naive.c) */
void bench_naive_eval(const lobe_ggx_conductor *p, const lobe_batch *b);
void bench_naive_sample(const lobe_ggx_conductor *p, const lobe_batch *b);

#endif
