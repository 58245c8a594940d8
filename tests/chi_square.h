/* chi_square.h - Pearson's test of counts against expectations, with one rule for cells that expect little. */
#ifndef LOBE_TESTS_CHI_SQUARE_H
#define LOBE_TESTS_CHI_SQUARE_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
	double p;    /* the probability that chance alone gives this much disagreement, or more */
	double chi2; /* Pearson's statistic of the cells that expect enough, and its degrees of freedom */
	int dof;
} chi_square;

/* probability: of each cell, by the model; those of all cells add up to 1. observed: samples in each cell, every sample
 * in one of them. */
chi_square chi_square_of(const double *probability, const uint32_t *observed, size_t cells);

/* The same where the cell `rest` is given what the others leave of 1, and so is off by whatever their quadratures are:
 * a disagreement of so many samples there counts for nothing. */
chi_square chi_square_with_rest(const double *probability, const uint32_t *observed, size_t cells, size_t rest,
				double slack);

#endif
