/* stability_reference.h - exact answers for stability.h: the textbook in two wide types, and the library's double build
 * for what the textbook does not have. */
#ifndef LOBE_BENCH_STABILITY_REFERENCE_H
#define LOBE_BENCH_STABILITY_REFERENCE_H

#include "stability.h"

/* wo, wi (for STABILITY_DIRECTION u) and parameters in one array, so that each can be moved: x[0..2], x[3..5],
 * x[6..]. */
enum { STABILITY_INPUTS = 6 + CASE_PARAMETERS };

long double stability_exact(stability_question q, const long double x[STABILITY_INPUTS]);

/* The same in 113 bits, rounded; where the compiler has no such type, in long double. */
long double stability_exacter(stability_question q, const long double x[STABILITY_INPUTS]);

/* The library's own answer in double. */
double stability_double_build(stability_question q, const long double x[STABILITY_INPUTS]);

/* Parts of a lobe and their inputs. */
typedef enum {
	STABILITY_PART_D,          /* wo, wi, alpha: GGX's D of the half vector */
	STABILITY_PART_LAMBDA,     /* w, alpha: GGX's Lambda */
	STABILITY_PART_REFRACTION, /* wo above, wi below, alpha, eta: f |cos| of light refracted by GGX, radiance */
	STABILITY_PART_CONDUCTOR,  /* c, n, k: reflectance */
	STABILITY_PART_DIELECTRIC, /* c, eta: reflectance */
	STABILITY_PARTS
} stability_part;

long double stability_exact_part(stability_part part, const long double *x);

/* Half the distance of floats at x; 0 at 0. */
long double stability_half_ulp(long double x);

#endif
