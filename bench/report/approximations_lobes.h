/* approximations_lobes.h - lobes timed in single and in double precision. */
#ifndef LOBE_BENCH_REPORT_APPROXIMATIONS_LOBES_H
#define LOBE_BENCH_REPORT_APPROXIMATIONS_LOBES_H

#include <stddef.h>

/* X(NAME, name, parameters of its make function, tests/cases_make.h) */
#define APPROXIMATIONS_LOBES(X)                                                                                        \
	X(LAMBERT, lambert, 0.8, 0.4, 0.1)                                                                             \
	X(GGX_CONDUCTOR, ggx_conductor, 0.25, 0.25, 0.1556, 0.4241, 1.383, 3.602, 2.472, 1.915)                        \
	X(GGX_DIELECTRIC, ggx_dielectric, 0.3, 0.3, 1.5, 0)                                                            \
	X(GGX_SCHLICK, ggx_schlick, 0.3, 0.3, 0.04, 0.04, 0.04, 1, 1, 1)                                               \
	X(BECKMANN_CONDUCTOR, beckmann_conductor, 0.25, 0.25, 0.1556, 0.4241, 1.383, 3.602, 2.472, 1.915)              \
	X(BECKMANN_DIELECTRIC, beckmann_dielectric, 0.3, 0.3, 1.5, 0)                                                  \
	X(IRIDESCENT_CONDUCTOR, iridescent_conductor, 0.2, 0.2, 400, 1.5, 2.741, 2.542, 2.267, 3.814, 3.435, 3.038)

enum { VERB_EVAL, VERB_PDF, VERB_SAMPLE };

extern const char *const approximations_lobe_names[];
extern const char *const approximations_verbs[3];
extern const size_t approximations_lobe_count;

/* Seconds of that many rounds over the same directions; *calls: how many calls of the verb those were. */
typedef double (*approximations_timer)(size_t lobe, int verb, int vector, int rounds, double *calls);
double approximations_single_time(size_t lobe, int verb, int vector, int rounds, double *calls);
double approximations_double_time(size_t lobe, int verb, int vector, int rounds, double *calls);

#endif
