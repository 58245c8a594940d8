/* leadr_surfaces.h - surfaces under linear maps as leadr.c and as the library have them, with the same parameters. */
#ifndef LOBE_TESTS_LEADR_SURFACES_H
#define LOBE_TESTS_LEADR_SURFACES_H

#include "leadr.h"
#include "lobe/microfacet/smith.h"
#include "support.h"

#include <stddef.h>
#include <stdint.h>

static inline double uniform(uint32_t stream, uint64_t i) { return (double)test_uniform(stream, i); }

/* Correlations of slopes, to the ends of what a map may have. */
enum { RHOS = 8 };
extern const double rhos[RHOS];

/* The distributions without a shape that this build has. */
enum {
#define LOBE_NDF_FIXED(NAME, name, number) FIXED_##NAME,
#define LOBE_NDF_SHAPED(NAME, name, number)
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	FIXED
};

typedef struct {
	lobe_uint ndf;
	const char *name;
} fixed_distribution;

extern const fixed_distribution fixed[FIXED];

/* The leadr_kind of a distribution, -1 for one that leadr.c does not know. */
int kind_of(size_t distribution);

lobe_smith surface_of(const leadr *s, size_t distribution);

/* x as a float. */
double single(double x);

/* Parameters that are floats, so that both sides have the same. */
leadr as_floats(leadr s);

/* Anything in the domain: number i of stream. */
leadr random_surface(uint32_t stream, uint64_t i, leadr_kind kind);

#endif
