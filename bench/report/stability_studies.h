/* stability_studies.h - the studies of the section "stability", and how their rows are added up. */
#ifndef LOBE_BENCH_STABILITY_STUDIES_H
#define LOBE_BENCH_STABILITY_STUDIES_H

#include "report.h"
#include "stability.h"

/* Bins of error/floor, eight an octave from 2^-8 on; bin 0 is 0. */
enum { STABILITY_BINS = 512 };

/* Results of one lobe, verb and reference. cases: asked; compared: where not both are 0; above: beyond 16 floors, and
 * why. bins: of what is neither undetermined nor tiny, which go to bin 0. */
typedef struct {
	unsigned long cases, compared, non_finite, negative, above, classes[STABILITY_CLASSES]; /* 0: none of them */
	unsigned long bins[STABILITY_BINS], bins_of_one[STABILITY_BINS];
	double worst_ulp, worst, worst_of_one, own_error;
} stability_tally;

/* The sum of the classes that are a rounding of 1. */
unsigned long stability_of_one_count(const stability_tally *t);

/* n: the case's number. */
void stability_tally_add(stability_tally *t, const stability_case *c, stability_verb verb, const stability_result *r,
			 uint64_t n);

/* The upper end of the bin that the fraction at of bins lies in, without bin 0's 0. */
double stability_percentile(const unsigned long *bins, double at);

/* Cell column of a row is value. */
int stability_is(const report_table *t, size_t row, const char *column, const char *value);

/* The section's part on errors: tables, findings. */
void stability_write_errors(report_page *page, const report_table *t);

extern const report_study stability_sweep, stability_counting, stability_worst, stability_maps, stability_forming;

#endif
