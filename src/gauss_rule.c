/* gauss_rule.c - the recurrence of the measure's orthogonal polynomials (Stieltjes 1884, on the points themselves; see
 * Gautschi 2004, "Orthogonal Polynomials", 2.2.3), then points and weights as eigenvalues and eigenvectors of its
 * tridiagonal matrix (Golub and Welsch 1969), which for so small a matrix Jacobi's rotations find. */
#include "gauss_rule.h"

#include <math.h>

/* Eigenvalues of the symmetric n x n matrix a on its diagonal, and the first components of its eigenvectors. */
static void jacobi(int n, double a[LOBE_GAUSS_MAX][LOBE_GAUSS_MAX], double *first)
{
	for (int i = 0; i < n; i++)
		first[i] = i == 0;
	for (int sweep = 0; sweep < 40; sweep++) {
		double off = 0.0;
		for (int p = 0; p < n; p++) {
			for (int q = p + 1; q < n; q++) {
				off += fabs(a[p][q]);
				if (a[p][q] == 0.0)
					continue;
				const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
				const double t = (theta < 0.0 ? -1.0 : 1.0) / (fabs(theta) + hypot(theta, 1.0));
				const double c = 1.0 / hypot(t, 1.0), s = t * c;
				for (int k = 0; k < n; k++) {
					const double x = a[k][p], y = a[k][q];
					a[k][p] = c * x - s * y;
					a[k][q] = s * x + c * y;
				}
				for (int k = 0; k < n; k++) {
					const double x = a[p][k], y = a[q][k];
					a[p][k] = c * x - s * y;
					a[q][k] = s * x + c * y;
				}
				const double x = first[p], y = first[q];
				first[p] = c * x - s * y;
				first[q] = s * x + c * y;
				a[p][q] = a[q][p] = 0.0;
			}
		}
		if (off < 1e-300)
			return;
	}
}

/* From recurrence coefficients: diagonal, off-diagonal squared, total weight. */
static void rule_from_recurrence(int n, const double *diagonal, const double *square, double total, double *x, double *w)
{
	double a[LOBE_GAUSS_MAX][LOBE_GAUSS_MAX] = {{0}}, first[LOBE_GAUSS_MAX];
	for (int i = 0; i < n; i++) {
		a[i][i] = diagonal[i];
		if (i > 0)
			a[i][i - 1] = a[i - 1][i] = sqrt(square[i]);
	}
	jacobi(n, a, first);
	for (int i = 0; i < n; i++) {
		x[i] = a[i][i];
		w[i] = total * first[i] * first[i];
	}
}

void lobe_gauss_legendre(int n, double *x, double *w)
{
	double diagonal[LOBE_GAUSS_MAX] = {0}, square[LOBE_GAUSS_MAX];
	for (int i = 0; i < n; i++)
		square[i] = (double)i * i / (4.0 * i * i - 1.0);
	rule_from_recurrence(n, diagonal, square, 2.0, x, w);
}

void lobe_gauss_of_measure(int n, const double *s, const double *m, size_t count, double *x, double *w)
{
	double total = 0.0, lo = HUGE_VAL, hi = -HUGE_VAL;
	for (int i = 0; i < n; i++)
		x[i] = w[i] = 0.0;
	for (size_t k = 0; k < count; k++)
		total += m[k];
	if (!(total > 0.0))
		return;
	for (size_t k = 0; k < count; k++) {
		if (m[k] > 1e-30 * total) {
			lo = s[k] < lo ? s[k] : lo;
			hi = s[k] > hi ? s[k] : hi;
		}
	}
	const double middle = 0.5 * (lo + hi), scale = hi > lo ? 0.5 * (hi - lo) : 1.0;
	double diagonal[LOBE_GAUSS_MAX] = {0}, square[LOBE_GAUSS_MAX] = {0}, norm = total;
	int used = 0;
	while (used < n) {
		/* Polynomial number `used` at each point by the recurrence so far. */
		double sum = 0.0, moment = 0.0;
		for (size_t k = 0; k < count; k++) {
			const double y = (s[k] - middle) / scale;
			double p = 1.0, before = 0.0;
			for (int j = 0; j < used; j++) {
				const double next = (y - diagonal[j]) * p - square[j] * before;
				before = p;
				p = next;
			}
			sum += m[k] * p * p;
			moment += m[k] * p * p * y;
		}
		if (used > 0)
			square[used] = sum / norm;
		/* The measure has no more points than this, as far as double precision can tell. */
		if (!(sum > 1e-22 * total))
			break;
		diagonal[used] = moment / sum;
		norm = sum;
		used++;
	}
	rule_from_recurrence(used, diagonal, square, total, x, w);
	for (int i = 0; i < used; i++)
		x[i] = middle + scale * x[i];
}
