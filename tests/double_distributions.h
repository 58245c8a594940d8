/* double_distributions.h - the distributions of microfacet normals compiled with LOBE_DOUBLE=1. */
#ifndef LOBE_TESTS_DOUBLE_DISTRIBUTIONS_H
#define LOBE_TESTS_DOUBLE_DISTRIBUTIONS_H

#include <stdint.h>

/* The fields of a lobe_distribution. */
typedef struct {
	uint32_t ndf;
	double exponent, width, norm;
	const float *table;
} double_distribution;

/* pi |h|^-4 D; hidden; tail and its inverse; a visible normal. */
double double_distribution_density(double_distribution d, const double h[3]);
double double_distribution_hidden(double_distribution d, const double v[3]);
double double_distribution_tail(double_distribution d, double t2);
double double_distribution_tail_inverse(double_distribution d, double q);
void double_distribution_visible(double_distribution d, const double v[3], const double u[2], double m[3]);

#endif
