/* approximations_double.c - the timed lobes in double precision, whose elementary functions are libm's. */
#define LOBE_FN       static inline __attribute__((always_inline, unused))
#define LOBE_FN_APART static __attribute__((noinline, unused))
#define PRECISION     approximations_double_time

#include "lobe/shading.h"

#if !LOBE_DOUBLE
#error "compile with -DLOBE_DOUBLE=1"
#endif

#include "approximations_lobes_loops.h"
