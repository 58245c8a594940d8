/* profile_table.h - makes the distributions of microfacet normals that need a table (C only).
 *
 *	static float table[LOBE_PROFILE_WORDS];
 *	lobe_distribution d;
 *	if (lobe_distribution_gtr(&d, table, LOBE_PROFILE_WORDS, 1.5f, 0.2f) != LOBE_OK)
 *		puts(lobe_error_message());
 *
 * The table belongs to the caller, who keeps it unchanged as long as functions of d or of a lobe made with it are
 * called; a scene keeps a copy from its creation on. It depends on the distribution alone, not on the stretch or map
 * that is put on it. Making one takes some milliseconds, in double precision, and allocates a megabyte or so meanwhile.
 *
 * On failure *out and the table are left as they were. */
#ifndef LOBE_PROFILE_TABLE_H
#define LOBE_PROFILE_TABLE_H

#include <stddef.h>

#include "batch.h"
#include "microfacet/distribution.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Phong and Blinn-Phong with exponent n in [0, 2e8] (phong.h). words: how many floats table has, LOBE_PROFILE_WORDS or
 * more; here and below. */
LOBE_API lobe_status lobe_distribution_phong(lobe_distribution *out, float *table, size_t words, float n);

/* GTR with gamma in [0.01, 100] and alpha in [1e-4, 1] (gtr.h). The width is alpha: stretch by 1. */
LOBE_API lobe_status lobe_distribution_gtr(lobe_distribution *out, float *table, size_t words, float gamma,
					   float alpha);

/* Student-T of width 1 with gamma in [1.501, 1e8] (student_t.h). */
LOBE_API lobe_status lobe_distribution_student_t(lobe_distribution *out, float *table, size_t words, float gamma);

/* Relative density of slopes at steepness tan_theta > 0: a finite number >= 0, the same for the same tan_theta. */
typedef double (*lobe_profile_function)(void *context, double tan_theta);

/* Any isotropic distribution of width 1: D(m) cos^4 theta = c f(tan theta), with the factor c that makes it one. f is
 * asked for tan_theta between 4e-18 and 1.3e19. It may be 0 in parts, may jump, and may have peaks, if they are wider
 * than 1/100 of their own steepness. Between knots f is smoothed: the density that lobe_distribution_density() gives is
 * that of the table.
 *
 * LOBE_ERROR_PARAMETER where f is negative or no finite number, is 0 everywhere, cannot be integrated over the plane of
 * slopes, or falls more slowly than tan_theta^-3.002, for then the mean slope, and with it the area seen at grazing, is
 * infinite. */
LOBE_API lobe_status lobe_distribution_tabulated(lobe_distribution *out, float *table, size_t words,
						 lobe_profile_function f, void *context);

#ifdef __cplusplus
}
#endif

#endif
