/* lobe_condition.h - by how much a lobe amplifies the rounding of its parts, from its formulas. */
#ifndef LOBE_TESTS_LOBE_CONDITION_H
#define LOBE_TESTS_LOBE_CONDITION_H

#include "cases.h"

/* The condition of each part; their sum is what u is multiplied by, beside 1. */
typedef struct {
	double fresnel, index, input, tail;
	int undecided; /* total reflection hangs on the last bit */
} conditions;

/* inexact: how far the directions themselves are off, in u (0 where both sides get the same ones). */
conditions condition_of(const test_case *c, lobe_vec3 wo_f, lobe_vec3 wi_f, double inexact);

/* The same direction in double. */
static inline void widen(lobe_vec3 w, double v[3])
{
	v[0] = (double)w.x;
	v[1] = (double)w.y;
	v[2] = (double)w.z;
}

#endif
