/* measured.h - measured maxima beside their bounds: all of a test's are printed before it fails for one. */
#ifndef LOBE_TESTS_MEASURED_H
#define LOBE_TESTS_MEASURED_H

#include <math.h>

/* Prints value beside bound, and remembers the first that is outside. */
void measured(const char *what, double value, double bound);

/* For setUp: forgets. For tearDown: what was outside, "" for nothing. */
void measured_reset(void);
const char *measured_outside(void);

static inline double larger(double a, double b) { return a > b ? a : b; }

/* A NaN is larger than everything. */
static inline double worse(double a, double b) { return isnan(b) ? HUGE_VAL : larger(a, b); }

#endif
