/* cases.h - the parameter sets that every lobe is tested with, and the directions it is seen from.
 *
 *	for (size_t i = 0; i < case_count(); i++) {
 *		const test_case *c = case_at(i);
 *		for (size_t k = 0; k < case_wo_count(c); k++)
 *			... lobe_bsdf_eval(c->bsdf, case_wo(k), ...)
 *
 * A lobe of lobes.def without a table in case_recipes.c, or a description in cases.c, does not compile. */
#ifndef LOBE_TESTS_CASES_H
#define LOBE_TESTS_CASES_H

#include "lobe/shading.h"
#include "textbook.h"

#include <stddef.h>

enum {
	CASE_TWO_SIDED = 1, /* shades from below too */
	CASE_TRANSMITS = 2,
	CASE_RECIPROCAL = 4,  /* f(wo,wi) = f(wi,wo), across the surface with the square of the index */
	CASE_DELTA = 8,       /* some samples are LOBE_EVENT_DELTA */
	CASE_DELTA_ONLY = 16, /* all are: eval and pdf are 0 */
	CASE_COLOURED = 32, /* reflects or refracts by the mean over the channels, which is what a weight's mean keeps to */
	CASE_HEAVY = 64 /* weights above 1: samples other than by visible normals, or masking that is too bright */
};

#define CASE_PARAMETERS 22

/* parameter: the arguments of make in order (cases_make.h), each one a float, so that the double build means the same
 * lobe. alpha_x, alpha_y: the width of a microsurface, 0 for a lobe without one; eta: index below over index above, 0
 * where nothing is transmitted. Both serve to find coordinates in which the lobe is wide. transport_at: which parameter
 * of a lobe that transmits is its LOBE_TRANSPORT_*. */
typedef struct {
	const char *name;
	lobe_uint kind;
	double parameter[CASE_PARAMETERS];
	lobe_bsdf bsdf;
	unsigned flags;
	double alpha_x, alpha_y, eta;
	int transport_at;
	textbook_ndf ndf; /* of a lobe with a microsurface */
} test_case;

size_t case_count(void);
const test_case *case_at(size_t i);

/* Directions from cos 1 down to 1e-6; the second half of the list is below the surface. */
size_t case_wo_count(const test_case *c);
lobe_vec3 case_wo(size_t i);

/* How far half a rounding of wi moves it within the lobe seen from wo, in widths of the lobe. Float directions form a
 * lattice: where this is below CASE_SMOOTH, its steps stay within the noise of 1M samples in some hundred bins, and
 * samples can be compared with the density bin by bin. */
#define CASE_SMOOTH 1e-3
double case_rounding(const test_case *c, lobe_vec3 wo);

/* Whether it carries radiance, and the same lobe for the other transport. */
int case_carries_radiance(const test_case *c);
lobe_bsdf case_with_other_transport(const test_case *c);

/* How much a rounding of an angle counts in a lobe's Fresnel term: the phase of its film, twice OPD/wavelength in
 * radians, where that is more than 1, or 1. */
double case_film_condition(const test_case *c);

#endif
