/* approximations_single.c - the timed lobes in single precision. */
#define LOBE_FN       static inline __attribute__((always_inline, unused))
#define LOBE_FN_APART static __attribute__((noinline, unused))
#define PRECISION     approximations_single_time

#include "approximations_lobes_loops.h"

#define NAME_ENTRY(NAME, name, ...) #name,
const char *const approximations_lobe_names[] = {APPROXIMATIONS_LOBES(NAME_ENTRY)};
const char *const approximations_verbs[3] = {"eval", "pdf", "sample"};
const size_t approximations_lobe_count = sizeof approximations_lobe_names / sizeof *approximations_lobe_names;
