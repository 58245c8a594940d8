/* distribution_cases.h - distributions of microfacet normals to test, each beside a density of slopes written here from
 * the textbooks, in double, and what quadrature makes of that density: nothing of the library's tables or closed
 * forms. */
#ifndef LOBE_TESTS_DISTRIBUTION_CASES_H
#define LOBE_TESTS_DISTRIBUTION_CASES_H

#include <stddef.h>

#include "lobe/lobe.h"

enum { DISTRIBUTION_CASES_MAX = 40 };

/* p22: density of slopes at tan theta = r of a surface with parameters a and b. breaks: where it is not smooth, 0
 * ends. */
typedef struct distribution_case {
	const char *name;
	double (*p22)(const struct distribution_case *c, double r);
	double a, b, breaks[4];
	int smooth; /* 0: the table has to smooth f */
	lobe_distribution d;
} distribution_case;

/* All of them, made once; NULL (and the message printed) when the library refuses one. */
const distribution_case *distribution_cases(size_t *count);
const distribution_case *distribution_case_named(const char *name);

/* By Gauss-Legendre sums over panels of log(r - z), 16 points (GSL): the integral of weight(context, r) 2 pi r P22 dr
 * over [r0, r1], r1 up to infinity, panels growing away from r0 in either direction of scale. */
double ring_integral(const distribution_case *c, double r0, double r1, double (*weight)(void *context, double r),
		     void *context);

/* The tail at r, and the projected area that v hides: both with small relative error. */
double reference_tail(const distribution_case *c, double r);
double reference_hidden(const distribution_case *c, double s, double z);

/* The azimuth kernel sigma = int D sin K of a ring at tan theta = r, per cos theta_m, seen from (s, 0, z), z of either
 * sign: int max(0, z - s r cos phi) dphi. */
double reference_kernel(double s, double z, double r);

#endif
