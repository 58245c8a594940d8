/* peak.h - what a thread of this processor can do, vector instruction by vector instruction. */
#ifndef LOBE_BENCH_PEAK_H
#define LOBE_BENCH_PEAK_H

/* Seconds of one vector instruction among independent ones of its kind; 0: not known here. */
typedef struct {
	int lanes;
	double arithmetic; /* a product; sums and fused ones go the same way */
	double division, root;
} bench_peak;

void bench_peak_baseline(bench_peak *peak);
#ifdef LOBE_X86
void bench_peak_avx2(bench_peak *peak);
void bench_peak_avx512(bench_peak *peak);
#endif

#endif
