/* hand.h - ggx_conductor by the library against loops without it: written by hand over the lobe's header, and what an
 * engine has today, one element at a time with libm. */
#ifndef LOBE_BENCH_HAND_H
#define LOBE_BENCH_HAND_H

#include "race.h"

/* Prints the table, one thread and the first OpenCL device, and writes it to path. 0 after a failure. */
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

/* On the first OpenCL device: racer[0] the library with device buffers, racer[1] a kernel by hand. 0 after a failure,
 * which it reports; -1: no such device. (hand_opencl.c) */
int bench_hand_opencl(const bench_arrays *a, int verb, size_t n, size_t runs, bench_racer racer[2]);

#endif
