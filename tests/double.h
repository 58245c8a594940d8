/* double.h - the same lobes compiled with LOBE_DOUBLE=1, as a reference for single precision. */
#ifndef LOBE_TESTS_DOUBLE_H
#define LOBE_TESTS_DOUBLE_H

#include <stdint.h>

typedef struct {
	double wi[3], weight[3], pdf;
	uint32_t event;
} double_sample;

/* kind: LOBE_KIND_*. parameter: the arguments of its make function, as in test_case. */
void double_eval(uint32_t kind, const double *parameter, const double wo[3], const double wi[3], double f[3]);
double double_pdf(uint32_t kind, const double *parameter, const double wo[3], const double wi[3]);
double_sample double_sample_at(uint32_t kind, const double *parameter, const double wo[3], const double u[3]);

#endif
