/* lobe_histogram.h - samples of a lobe in bins, beside what its density expects in them.
 *
 * Bins and quadrature live in the coordinates of quadrature.h. A bin's probability is the integral of the lobe's own
 * pdf at directions rounded to float; the bins are a grid of reflected and one of transmitted directions, one bin of
 * delta events, whose probability comes from the textbook's Fresnel and facet distribution, and one of rejected
 * samples. */
#ifndef LOBE_TESTS_LOBE_HISTOGRAM_H
#define LOBE_TESTS_LOBE_HISTOGRAM_H

#include "cases.h"
#include "chi_square.h"
#include "quadrature.h"

#include <stdint.h>

#define SIDE    20
#define GRID    (SIDE * SIDE)
#define BINS    (2 * GRID + 2)
#define DELTA   (2 * GRID)
#define REJECT  (2 * GRID + 1)
#define SAMPLES 1000000u

/* One lobe from one direction. in_double: the LOBE_DOUBLE build of it. wrong: what pdf is replaced by to see whether
 * the test notices; 0 for the true one. */
enum { RIGHT, WRONG_SCALE, WRONG_ALPHA };

typedef struct {
	const test_case *c;
	lobe_vec3 wo;
	int in_double, wrong;
	lobe_bsdf wrong_bsdf;
	direction_map reflect, transmit;
} scene;

typedef struct {
	double expected[BINS], quadrature_error;
	uint32_t observed[BINS];
} histogram;

scene scene_make(const test_case *c, lobe_vec3 wo, int in_double, int wrong);

/* The density at wi; x: its coordinate in the square, for WRONG_SCALE. */
double pdf_at(const scene *s, const double wi[3], double x);

/* Fills in expected and quadrature_error, the rest with zeros; then observed, with SAMPLES samples, between batch_open
 * and batch_close. */
void expect(const scene *s, histogram *h);
void observe(const scene *s, uint32_t stream, histogram *h);

/* What is rejected is expected by difference: a density that does not integrate to 1 less that shows there. */
chi_square fit_of(const histogram *h);

/* What observe takes samples of the single precision build with. */
void batch_open(void);
void batch_close(void);

#endif
