/* chi_square.c - the rule for cells that expect little.
 *
 * A count o of a cell that expects e is Poisson's, of which (o - e)^2/e has mean 1 and variance 2 + 1/e; the chi-square
 * law takes it for the square of a normal variable, with variance 2. Where e is 5 the difference is a tenth of it and
 * the statistic's own deviation a twentieth too large; below, the tail of the law soon is not that of the statistic.
 *
 * So cells that expect fewer than 5 are taken together. If they expect 5 by then, they are one more cell of the
 * statistic. If they do not, their count keeps its own law: it is Poisson's, whose upper tail is known, and too few of
 * 5 say nothing. p then is the lesser of the two, corrected for being the lesser of two. */
#include "chi_square.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static const double enough = 5.0;

/* Where next to nothing is expected quadrature cannot tell how little: less than one sample counts as one. */
static const double least = 1.0;

static double poisson_tail(double expected, double count)
{
	const double mean = fmax(expected, least);
	return count > 0.0 ? gsl_cdf_poisson_Q((unsigned)count - 1u, mean) : 1.0;
}

static void add_cell(chi_square *t, double expected, double count, double slack)
{
	const double off = fmax(fabs(count - expected) - slack, 0.0);
	t->chi2 += off * off / expected;
	t->dof++;
}

chi_square chi_square_with_rest(const double *probability, const uint32_t *observed, size_t cells, size_t rest,
				double slack)
{
	double samples = 0.0, pool_expected = 0.0, pool_count = 0.0;
	size_t pooled = 0;
	/* Sums over all cells agree, which takes one degree of freedom. */
	chi_square t = {1.0, 0.0, -1};
	for (size_t i = 0; i < cells; i++)
		samples += (double)observed[i];
	for (size_t i = 0; i < cells; i++) {
		const double expected = samples * probability[i];
		if (expected >= enough) {
			add_cell(&t, expected, (double)observed[i], i == rest ? slack : 0.0);
		} else {
			pool_expected += fmax(expected, 0.0); /* what is left of 1 may be less than nothing */
			pool_count += (double)observed[i];
			pooled++;
		}
	}
	const int pool_is_cell = pool_expected >= enough;
	if (pool_is_cell)
		add_cell(&t, pool_expected, pool_count, 0.0);
	if (t.dof > 0)
		t.p = gsl_cdf_chisq_Q(t.chi2, (double)t.dof);
	if (pooled && !pool_is_cell) {
		const double p = fmin(t.p, poisson_tail(pool_expected, pool_count));
		t.p = p * (2.0 - p); /* 1 - (1 - p)^2 */
	}
	return t;
}

chi_square chi_square_of(const double *probability, const uint32_t *observed, size_t cells)
{
	return chi_square_with_rest(probability, observed, cells, cells, 0.0);
}
