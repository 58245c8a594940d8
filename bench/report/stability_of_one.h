/* stability_of_one.h - what a rounding of something of the size of 1 does to an answer, and which. */
#ifndef LOBE_BENCH_STABILITY_OF_ONE_H
#define LOBE_BENCH_STABILITY_OF_ONE_H

#include "stability_reference.h"

/* The largest of them. */
typedef struct {
	double size;
	stability_class cause;
} stability_of_one;

stability_of_one stability_of_one_make(const stability_case *c, stability_question q,
				       const long double x[STABILITY_INPUTS]);

/* The textbook's answer or the double build's. */
long double stability_answer(int textbook, stability_question q, const long double *x);

#endif
