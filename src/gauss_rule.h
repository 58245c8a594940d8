/* gauss_rule.h - Gauss quadrature: for a plain interval, and for any measure that is a sum of points. */
#ifndef LOBE_GAUSS_RULE_H
#define LOBE_GAUSS_RULE_H

#include <stddef.h>

enum { LOBE_GAUSS_MAX = 16 };

/* Gauss-Legendre: n points x in (-1, 1) with weights w, n <= LOBE_GAUSS_MAX. */
void lobe_gauss_legendre(int n, double *x, double *w);

/* The n points and weights that integrate polynomials of degree 2n - 1 as the `count` points s with weights m >= 0 do.
 * Fewer points than n suffice where the measure has no more: the others get weight 0. */
void lobe_gauss_of_measure(int n, const double *s, const double *m, size_t count, double *x, double *w);

#endif
