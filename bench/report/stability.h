/* stability.h - lobes at the ends of their domain: what single precision loses, and what nobody could keep.
 *
 *	stability_case c = stability_draw(kind, n);			the n-th of an endless list of corners
 *	stability_result r = stability_measure(&c, STABILITY_PDF);
 *	r.error/r.floor						how much of the error is the library's own
 *
 * The floor of a case is how much the exact answer moves when an input moves by half a unit in its last place: the root
 * of the sum of the squares over all inputs (components of the directions, parameters), and at least half an ulp of the
 * answer itself (of a direction, of 1), which no result in single precision can undercut. A result that is off by a few
 * floors is as good as the question; one that is off by a hundred has a cancellation that another form would not
 * have. */
#ifndef LOBE_BENCH_STABILITY_H
#define LOBE_BENCH_STABILITY_H

#include <stddef.h>
#include <stdint.h>

#include "cases.h"

/* f |cos|; density; weight of a sample in the direction that it returned; that direction, one component of it, of lobes
 * whose samplers are maps with a name (not Beckmann's inverted distribution, nor the choices of the comparison lobes).
 * For delta lobes pdf is the probability of the sample's event. */
typedef enum { STABILITY_EVAL, STABILITY_PDF, STABILITY_WEIGHT, STABILITY_DIRECTION, STABILITY_VERBS } stability_verb;

extern const char *const stability_verb_names[STABILITY_VERBS];

/* parameter: as in tests/cases_make.h. wi: for eval and pdf; sample replaces it by what it returns. */
typedef struct {
	lobe_uint kind;
	int channel;
	double parameter[CASE_PARAMETERS];
	float wo[3], wi[3], u[3];
} stability_case;

/* Case n of a lobe: alpha 1e-4 .. 1, anisotropy to 1:1e4, cosines to 1e-7 on both sides and to 1, indices 1 +- 1e-7 ..
 * 1000, k to 100, mean slopes to 100, correlations to +-0.9999, u at the ends of [0, 1) and subnormal, directions off
 * unit length by up to four ulp; wi mostly where the lobe is. A function of its arguments. */
stability_case stability_draw(lobe_uint kind, uint64_t n);

/* The parts of that: parameters alone, and directions for a lobe that is there, wi without a look at it. */
void stability_draw_parameters(lobe_uint kind, uint64_t n, double parameter[CASE_PARAMETERS]);
void stability_draw_anywhere(stability_case *c, uint64_t n);
lobe_bsdf stability_bsdf(const stability_case *c);

/* What is asked of a reference. reflects: the event of a sample of a delta lobe; delta: refraction is one (a property
 * of the parameters); straight: the sample is that one; white: as if everything were reflected or transmitted; nudge:
 * added to the cosine to the facet; of a direction, to x (white: to y) of the point of the unit sphere that a visible
 * normal is made of. */
typedef struct {
	lobe_uint kind;
	stability_verb verb;
	int channel, reflects, delta, straight, white;
	double nudge;
} stability_question;

/* Mirrors and smooth interfaces, which have no eval. */
int stability_is_delta_only(lobe_uint kind);

/* 1: the textbook (stability_textbook.h) has the lobe with these parameters; 0: only the double build does. */
int stability_is_textbook(const stability_case *c);

/* Why a result is above 16 floors without a defect of the library's arithmetic; each is computed from the case. */
typedef enum {
	STABILITY_PLAIN, /* none of these: unexplained */
	/* The floor is above a tenth of the answer: rounding the inputs decides what the answer is, and the floor,
	 * which moves one input at a time by half an ulp, is no more than a lower limit of that. Of a weight also where
	 * that is so of the density in the sampled direction: it is made of the same facet. */
	STABILITY_UNDETERMINED,
	/* Below 1e-30 of the density's peak: factors underflow on the way. The error is as small. */
	STABILITY_TINY,
	/* The value is the exact answer to inputs that are off by at most two ulps each: the answer bends too much over
	 * a rounding for the floor, which is made of its differences along one input at a time. */
	STABILITY_BENT,
	/* Directions are up to four ulp off unit, and the value is between what formulas make of them as they are and
	 * as unit ones, to 16 floors: the textbook's, and the library's own in double where these agree on unit ones. */
	STABILITY_LENGTH,
	/* The rest is within 16 of what a rounding of something that is of the size of 1 does, which stability_of_one
	 * finds by asking the reference again. The reflectance of a metal (core/fresnel.h promises it so) ... */
	STABILITY_METAL,
	STABILITY_SCHLICK,      /* ... a Schlick curve that falls (core/fresnel_schlick.h) ... */
	STABILITY_INTERFERENCE, /* ... waves in a film, by 2^-22 for each time to and fro (core/airy.h) ... */
	STABILITY_INTERFACE,    /* ... reflectance or transmittance of glass ... */
	STABILITY_COSINE, /* ... the cosine to the facet: light leaves eta = 1000 by a cone of 1 - cos = 5e-7 ... */
	STABILITY_RIM, /* ... the two points of a sphere, opposite near its rim, that add up to a visible normal ... */
	STABILITY_FACETS, /* ... cosines, or the smooth surface's value, in a sum over facets (microfacet_diffuse.h) ... */
	STABILITY_LOGARITHM, /* ... the logarithm that a beta function is the exponential of (core/beta.h) ... */
	STABILITY_SHAPE, /* ... or the density and hidden area of a distribution: what its header says that they are good for,
			  * and of Beckmann's the exponent of a tail. */
	STABILITY_CLASSES
} stability_class;

/* Their names, in that order: a list of X(name). */
#define STABILITY_CLASS_LIST(X)                                                                                        \
	X("plain")                                                                                                     \
	X("undetermined")                                                                                              \
	X("tiny")                                                                                                      \
	X("bent")                                                                                                      \
	X("length")                                                                                                    \
	X("metal")                                                                                                     \
	X("falling Schlick")                                                                                           \
	X("interference")                                                                                              \
	X("interface")                                                                                                 \
	X("cosine")                                                                                                    \
	X("rim")                                                                                                       \
	X("facets")                                                                                                    \
	X("logarithm")                                                                                                 \
	X("shape")
extern const char *const stability_class_names[STABILITY_CLASSES];

/* error: |value - exact|. floor, and the part of it that the directions alone make; floor_of_one: the same with a
 * rounding of 1 where there is one, and of what. ulp: distance of floats at the exact answer, and size, what is small
 * against it: the answer, or 1 for a direction. peak: at least 1; what densities are at most. defined: 0 where the case
 * asks nothing (no sample; no reference; a tilted surface that shows less than 1e-18 of itself, where densities and
 * areas underflow). */
typedef struct {
	double value, exact, error, floor, floor_directions, floor_of_one, ulp, size, peak;
	stability_class of_one;
	int defined;
} stability_result;

/* Why a result of c is above 16 floors, or STABILITY_PLAIN for one that nothing explains (or that is not above). */
stability_class stability_explain(const stability_case *c, stability_verb verb, const stability_result *r);

/* A lobe to measure: what of c's verb comes out. */
typedef double (*stability_lobe)(const stability_case *c, stability_verb verb);
double stability_library(const stability_case *c, stability_verb verb);

/* With lobe in place of the library, whose samples it measures nevertheless. */
stability_result stability_measure_of(stability_lobe lobe, const stability_case *c, stability_verb verb);
stability_result stability_measure(const stability_case *c, stability_verb verb);

/* The same answer to more digits (113 bits where the compiler has them), to see how good the reference itself is: how
 * far it is off, in floors. 0 for what only the double build answers. */
double stability_own_error(const stability_case *c, stability_verb verb, const stability_result *r);

/* error/floor; the same, but 0 for what is undetermined or tiny; and that with floor_of_one. */
double stability_ratio(const stability_result *r);
double stability_ratio_determined(const stability_result *r);
double stability_ratio_of_one(const stability_result *r);

enum { STABILITY_LIMIT = 16 };

/* Batches of corners, on one thread of the native device. elements: of eval and of sample; kept: samples that are one.
 * What must be 0: results that are no finite number, negative ones, and samples whose pdf is not the bits of pdf(). */
typedef struct {
	uint64_t elements, kept, non_finite, negative, pdf_differs;
} stability_counts;

/* Batch number batch of a lobe, of STABILITY_BATCH elements (microfacet_diffuse, which is slow, a tenth), added to
 * counts. Not 0: failed, after a message on stderr. */
enum { STABILITY_BATCH = 32768 };
int stability_count(lobe_uint kind, uint64_t batch, stability_counts *counts);

/* The parts of a lobe in single precision, as the textbook prints them and as the library has them, and exactly. */
typedef struct {
	double x, exact, floor, ours, textbook; /* x: what the plot is over */
} stability_form_result;
typedef struct {
	const char *name, *ours, *textbook, *x;
} stability_form;
enum { STABILITY_FORMS = 6 };
extern const stability_form stability_forms[STABILITY_FORMS];
stability_form_result stability_form_at(int form, uint64_t n);

/* Copies of lobes with a defect, for the sweep to find: ggx_conductor with D by 1 - cos^2, and with Lambda from the
 * tangent that 1 - cos^2 gives. */
double stability_defect_d(const stability_case *c, stability_verb verb);
double stability_defect_lambda(const stability_case *c, stability_verb verb);

/* The worst case that an ascent from c finds, by ratio: the simplex method on the logarithms of the parameters and the
 * angles of wo and of the facet, then on single ulps. steps: about how many cases it tries. */
typedef double (*stability_measure_ratio)(const stability_result *r);
stability_case stability_ascend(stability_measure_ratio ratio, stability_case c, stability_verb verb, unsigned steps,
				uint64_t seed);

/* The parameters that c's answer depends on continuously, as places in c.parameter; and c as text, all that makes it:
 * hexadecimal floats, a space apart, of the parameters those that are not 0. */
size_t stability_parameters_of(const stability_case *c, int at[CASE_PARAMETERS]);
void stability_print(const stability_case *c, stability_verb verb, char *text, size_t size);

/* Every lobe of lobes.def. */
enum {
	STABILITY_LOBES = 0
#define LOBE_X(NAME, name, value) +1
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};
extern const lobe_uint stability_kinds[STABILITY_LOBES];
extern const char *const stability_lobe_names[STABILITY_LOBES];

#endif
