/* stability_measure.c - one case: the library's result beside the exact one and beside what the inputs allow. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "stability_of_one.h"
#include "support.h"

const char *const stability_verb_names[STABILITY_VERBS] = {"eval", "pdf", "weight", "direction"};
const lobe_uint stability_kinds[STABILITY_LOBES] = {
#define LOBE_X(NAME, name, value) value,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};
const char *const stability_lobe_names[STABILITY_LOBES] = {
#define LOBE_X(NAME, name, value) #name,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};
#define NAME(name) name,
const char *const stability_class_names[STABILITY_CLASSES] = {STABILITY_CLASS_LIST(NAME)};
#define ONE(name) +1
typedef char every_class_has_a_name[STABILITY_CLASSES == 0 STABILITY_CLASS_LIST(ONE) ? 1 : -1];

static lobe_vec3 vec3(const float w[3]) { return lobe_vec3_make(w[0], w[1], w[2]); }

int stability_is_delta_only(lobe_uint kind)
{
	return kind == LOBE_KIND_MIRROR || kind == LOBE_KIND_SMOOTH_CONDUCTOR || kind == LOBE_KIND_SMOOTH_DIELECTRIC ||
	       kind == LOBE_KIND_THIN_DIELECTRIC;
}

int stability_is_textbook(const stability_case *c)
{
	const double *p = c->parameter;
	switch (c->kind) {
	case LOBE_KIND_IRIDESCENT_CONDUCTOR:
	case LOBE_KIND_IRIDESCENT_DIELECTRIC:
	case LOBE_KIND_MICROFACET_DIFFUSE:
		return 0;
	case LOBE_KIND_MICROFACET_CONDUCTOR:
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return (p[8] == LOBE_NDF_GGX || p[8] == LOBE_NDF_BECKMANN) && p[15] == LOBE_MASKING_SMITH &&
		       p[16] <= LOBE_JOINT_SEPARABLE && p[17] == LOBE_ACROSS_SEPARABLE &&
		       p[18] == LOBE_STRATEGY_VISIBLE && p[19] == LOBE_FRESNEL_EXACT;
	default:
		return 1;
	}
}

/* Refraction by this lobe is a delta event, as its parameters have it. */
static int refraction_is_delta(const lobe_bsdf *b)
{
	switch (b->kind) {
	case LOBE_KIND_GGX_DIELECTRIC:
		return b->as.ggx_dielectric.delta != 0u;
	case LOBE_KIND_BECKMANN_DIELECTRIC:
		return b->as.beckmann_dielectric.delta != 0u;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return b->as.microfacet_dielectric.delta != 0u;
	default:
		return 0;
	}
}

static double channel_of(lobe_rgb f, int channel) { return (double)(channel == 0 ? f.r : channel == 1 ? f.g : f.b); }

double stability_library(const stability_case *c, stability_verb verb)
{
	const lobe_bsdf b = stability_bsdf(c);
	if (verb >= STABILITY_WEIGHT || (verb == STABILITY_PDF && stability_is_delta_only(c->kind))) {
		const lobe_sample s = lobe_bsdf_sample(b, vec3(c->wo), vec3(c->u));
		if (verb == STABILITY_DIRECTION)
			return (double)(c->channel == 0 ? s.wi.x : c->channel == 1 ? s.wi.y : s.wi.z);
		return verb == STABILITY_PDF ? (double)s.pdf : channel_of(s.weight, c->channel);
	}
	return verb == STABILITY_PDF ? (double)lobe_bsdf_pdf(b, vec3(c->wo), vec3(c->wi))
				     : channel_of(lobe_bsdf_eval(b, vec3(c->wo), vec3(c->wi)), c->channel);
}

/* The places in x of what c's answer depends on continuously: of a delta lobe wo alone. */
static size_t inputs_of(const stability_case *c, stability_verb verb, int at[STABILITY_INPUTS])
{
	int parameters[CASE_PARAMETERS];
	const size_t length = stability_parameters_of(c, parameters);
	size_t n = 0;
	for (int k = 0; k < (stability_is_delta_only(c->kind) ? 3 : verb == STABILITY_DIRECTION ? 5 : 6); k++)
		at[n++] = k;
	for (size_t k = 0; k < length; k++)
		at[n++] = 6 + parameters[k];
	return n;
}

long double stability_half_ulp(long double x)
{
	int e;
	if (x == 0.0L)
		return 0.0L;
	frexpl(x, &e);
	return ldexpl(1.0L, e - 25 < -150 ? -150 : e - 25);
}

long double stability_answer(int textbook, stability_question q, const long double *x)
{
	return textbook ? stability_exact(q, x) : (long double)stability_double_build(q, x);
}

/* x moved to a place where the question has no meaning: a film that is thinner than both sides. */
static int outside(lobe_uint kind, const long double *x)
{
	if (kind == LOBE_KIND_IRIDESCENT_CONDUCTOR)
		return x[6 + 3] < 1.0L;
	return kind == LOBE_KIND_IRIDESCENT_DIELECTRIC && x[6 + 3] < (x[6 + 4] < 1.0L ? x[6 + 4] : 1.0L);
}

/* A tilted surface that shows less of itself than a float can say: of widths of Beckmann's, all of it hides behind
 * itself. There is nothing to divide by, and results are 0. */
static int is_invisible(const stability_case *c, const lobe_bsdf *b, const float *wi)
{
	const lobe_real least = 1e-18f, side = c->wo[2] > 0.0f ? 1.0f : -1.0f;
	switch (b->kind) {
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return lobe_see(b->as.microfacet_conductor.surface, vec3(c->wo), side).sigma < least;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return lobe_see(b->as.microfacet_dielectric.surface, vec3(c->wo), side).sigma < least;
	case LOBE_KIND_MICROFACET_DIFFUSE:
		return lobe_see(b->as.microfacet_diffuse.surface, vec3(c->wo), side).sigma < least ||
		       lobe_see(b->as.microfacet_diffuse.surface, vec3(wi), side).sigma < least;
	default:
		return 0;
	}
}

static int has_direction(lobe_uint kind)
{
	return kind == LOBE_KIND_LAMBERT || kind == LOBE_KIND_GGX_CONDUCTOR || kind == LOBE_KIND_GGX_SCHLICK ||
	       kind == LOBE_KIND_GGX_DIELECTRIC || stability_is_delta_only(kind);
}

/* The question of a case, and its inputs; 0 where there is none. */
static int ask(const stability_case *c, stability_verb verb, stability_question *q, long double x[STABILITY_INPUTS])
{
	const lobe_bsdf b = stability_bsdf(c);
	const float *wi = c->wi;
	float sampled[3];
	memset(q, 0, sizeof *q);
	q->kind = c->kind;
	q->verb = verb;
	q->channel = c->channel;
	q->delta = refraction_is_delta(&b);
	if ((verb == STABILITY_EVAL && stability_is_delta_only(c->kind)) ||
	    (verb == STABILITY_DIRECTION && !has_direction(c->kind)))
		return 0;
	if (verb >= STABILITY_WEIGHT || stability_is_delta_only(c->kind)) {
		const lobe_sample s = lobe_bsdf_sample(b, vec3(c->wo), vec3(c->u));
		if (s.event == 0u)
			return 0;
		q->reflects = (s.event & LOBE_EVENT_REFLECT) != 0u;
		q->straight = (s.event & LOBE_EVENT_DELTA) != 0u;
		/* The double build knows no weight of a delta event. */
		if (q->straight && !stability_is_textbook(c))
			return 0;
		sampled[0] = s.wi.x;
		sampled[1] = s.wi.y;
		sampled[2] = s.wi.z;
		wi = verb == STABILITY_DIRECTION ? c->u : sampled;
	}
	if (is_invisible(c, &b, wi))
		return 0;
	for (int k = 0; k < 3; k++) {
		x[k] = (long double)c->wo[k];
		x[3 + k] = (long double)wi[k];
	}
	for (int k = 0; k < CASE_PARAMETERS; k++)
		x[6 + k] = (long double)c->parameter[k];
	return 1;
}

/* Facets turn what they refract by so little where indices are alike that its density is that of facets times 1/(1 -
 * eta)^2, seen from below, or eta^2 of that (Walter et al. 2007, eq. 17, along the normal). */
static double concentration(double eta)
{
	const double spread = fmax(fabs(eta - 1.0), 0x1p-24);
	return fmax(1.0, fmax(1.0, eta * eta) / (spread * spread));
}

/* 1/(pi |det A|), where the surface has widths; Phong's distribution before that has (n + 2)/(2 pi). refracts: of the
 * density of a refraction. */
static double peak_of(const stability_case *c, int refracts)
{
	const double *p = c->parameter, shape = p[8] == LOBE_NDF_PHONG ? 1.0 + 0.5 * p[9] : 1.0;
	const double turned = refracts ? concentration(p[2]) : 1.0;
	switch (c->kind) {
	case LOBE_KIND_LAMBERT:
	case LOBE_KIND_MIRROR:
	case LOBE_KIND_SMOOTH_CONDUCTOR:
	case LOBE_KIND_SMOOTH_DIELECTRIC:
	case LOBE_KIND_THIN_DIELECTRIC:
		return 1.0;
	case LOBE_KIND_GGX_DIELECTRIC:
	case LOBE_KIND_BECKMANN_DIELECTRIC:
		return turned * fmax(1.0, 0.318309886183790672 / (p[0] * p[1]));
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return turned * fmax(1.0, shape * 0.318309886183790672 / fabs(p[0] * p[1] - p[11] * p[12]));
	case LOBE_KIND_MICROFACET_CONDUCTOR:
	case LOBE_KIND_MICROFACET_DIFFUSE:
		return fmax(1.0, shape * 0.318309886183790672 / fabs(p[0] * p[1] - p[11] * p[12]));
	default:
		return fmax(1.0, 0.318309886183790672 / (p[0] * p[1]));
	}
}

stability_result stability_measure_of(stability_lobe lobe, const stability_case *c, stability_verb verb)
{
	stability_result r;
	stability_question q;
	long double x[STABILITY_INPUTS], directions = 0.0L, parameters = 0.0L;
	int at[STABILITY_INPUTS];
	memset(&r, 0, sizeof r);
	if (!ask(c, verb, &q, x))
		return r;
	const int textbook = stability_is_textbook(c);
	long double exact = stability_answer(textbook, q, x);
	const size_t n = inputs_of(c, verb, at);
	for (size_t k = 0; k < n; k++) {
		/* A u is a cell of 2^-24 (core/warp.h), whatever its bits below that. */
		const int of_u = verb == STABILITY_DIRECTION && at[k] >= 3 && at[k] < 6;
		const long double old = x[at[k]], step = fmaxl(stability_half_ulp(old), of_u ? 0x1p-25L : 0.0L);
		long double most = 0.0L;
		for (int side = -1; side <= 1 && step > 0.0L; side += 2) {
			x[at[k]] = old + (long double)side * step;
			if (!outside(c->kind, x))
				most = fmaxl(most, fabsl(stability_answer(textbook, q, x) - exact));
		}
		x[at[k]] = old;
		*(at[k] < 6 ? &directions : &parameters) += most * most;
	}
	r.defined = 1;
	r.value = lobe(c, verb);
	/* Steeply tilted surfaces cancel in long double too: no case is blamed on the library by fewer than 113
	 * bits. */
	if (textbook && fabsl((long double)r.value - exact) > 4.0L * sqrtl(directions + parameters))
		exact = stability_exacter(q, x);
	r.exact = (double)exact;
	r.error = (double)fabsl((long double)r.value - exact);
	/* A component of a direction is a part of 1, none is small. */
	r.size = verb == STABILITY_DIRECTION ? 1.0 : (double)exact;
	r.ulp = verb == STABILITY_DIRECTION ? 0x1p-24
					    : 2.0 * (double)(exact == 0.0L ? 0x1p-150L : stability_half_ulp(exact));
	r.floor = fmax((double)sqrtl(directions + parameters), 0.5 * r.ulp);
	r.floor_directions = (double)sqrtl(directions);
	r.floor_of_one = r.floor;
	r.peak = peak_of(c, verb <= STABILITY_PDF && x[2] * x[5] < 0.0L);
	if (r.error > r.floor) {
		const stability_of_one one = stability_of_one_make(c, q, x);
		r.of_one = one.cause;
		r.floor_of_one = fmax(r.floor, one.size);
	}
	return r;
}

stability_result stability_measure(const stability_case *c, stability_verb verb)
{
	return stability_measure_of(stability_library, c, verb);
}

double stability_own_error(const stability_case *c, stability_verb verb, const stability_result *r)
{
	stability_question q;
	long double x[STABILITY_INPUTS];
	if (!ask(c, verb, &q, x) || !stability_is_textbook(c))
		return 0.0;
	return fabs((double)(stability_exacter(q, x) - (long double)r->exact)) / r->floor;
}

double stability_ratio(const stability_result *r) { return r->defined ? r->error / r->floor : 0.0; }

static int is_tiny(const stability_result *r) { return r->size < 1e-30 * r->peak && r->value < 1e-30 * r->peak; }
static int is_undetermined(const stability_result *r) { return !(r->floor < 0.1 * r->size); }

double stability_ratio_determined(const stability_result *r)
{
	return is_tiny(r) || is_undetermined(r) ? 0.0 : stability_ratio(r);
}

double stability_ratio_of_one(const stability_result *r)
{
	return r->defined && !is_tiny(r) && !is_undetermined(r) ? r->error / r->floor_of_one : 0.0;
}

/* The facet of a weight: whether rounding the directions decides its density. */
static int facet_is_undetermined(const stability_case *c)
{
	stability_case sampled = *c;
	const lobe_vec3 wi = lobe_bsdf_sample(stability_bsdf(c), vec3(c->wo), vec3(c->u)).wi;
	sampled.wi[0] = wi.x;
	sampled.wi[1] = wi.y;
	sampled.wi[2] = wi.z;
	const stability_result r = stability_measure(&sampled, STABILITY_PDF);
	return r.defined && is_undetermined(&r);
}

/* Answers above and below the value, at inputs moved all together by up to four half ulps: the answer is continuous, so
 * it is the value in between. */
static int is_bent(const stability_case *c, stability_verb verb, double value)
{
	enum { MOVES = 500, HALF_ULPS = 4, STREAM = 7700 };
	stability_question q;
	long double x[STABILITY_INPUTS], y[STABILITY_INPUTS];
	int at[STABILITY_INPUTS], above = 0, below = 0;
	uint64_t draw = 0;
	if (!ask(c, verb, &q, x))
		return 0;
	const int textbook = stability_is_textbook(c);
	const size_t n = inputs_of(c, verb, at);
	for (int move = 0; move < MOVES && !(above && below); move++) {
		memcpy(y, x, sizeof y);
		for (size_t k = 0; k < n; k++) {
			const double by = HALF_ULPS * (2.0 * test_bits(STREAM, draw++) * 0x1p-32 - 1.0);
			y[at[k]] += (long double)by * stability_half_ulp(x[at[k]]);
		}
		const long double moved = outside(c->kind, y) ? -1.0L : stability_answer(textbook, q, y);
		above |= moved >= (long double)value;
		below |= moved >= 0.0L && moved <= (long double)value;
	}
	return above && below;
}

/* Directions are up to four ulp off unit. The textbook takes them as they are: whether the value is within the limit of
 * what lies between its answers to them, to wo, wi or both made unit, to the cosine that wo would have if it were, and
 * the library's formulas in double, if they give the textbook's answer to unit directions. */
static int is_length(const stability_case *c, stability_verb verb, const stability_result *r)
{
	enum { WO_UNIT = 1, WI_UNIT = 2, COSINE_UNIT = 4, READINGS = 8 };
	stability_question q;
	long double x[STABILITY_INPUTS], y[STABILITY_INPUTS];
	long double low = (long double)r->exact, high = low;
	if (!ask(c, verb, &q, x) || !stability_is_textbook(c))
		return 0;
	for (int reading = 1; reading < READINGS; reading++) {
		long double length[2];
		if (verb == STABILITY_DIRECTION && reading != WO_UNIT) /* a u has no length, a map no cosine */
			continue;
		memcpy(y, x, sizeof y);
		for (int w = 0; w < 2; w++) {
			long double *d = y + 3 * w;
			length[w] = sqrtl(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
			for (int k = 0; k < 3 && (reading & (w ? WI_UNIT : WO_UNIT)); k++)
				d[k] /= length[w];
		}
		q.nudge = reading & COSINE_UNIT ? (double)(1.0L - length[0]) : 0.0;
		const long double answer = stability_exacter(q, y);
		low = fminl(low, answer);
		high = fmaxl(high, answer);
		/* Formulas that are the same on the unit sphere differ off it. */
		if (verb <= STABILITY_PDF && reading == (WO_UNIT | WI_UNIT) &&
		    fabsl((long double)stability_double_build(q, y) - answer) <= (long double)r->floor) {
			const long double own = (long double)stability_double_build(q, x);
			low = fminl(low, own);
			high = fmaxl(high, own);
		}
	}
	const long double room = STABILITY_LIMIT * (long double)r->floor_of_one;
	return (long double)r->value >= low - room && (long double)r->value <= high + room;
}

stability_class stability_explain(const stability_case *c, stability_verb verb, const stability_result *r)
{
	if (!r->defined || r->error <= STABILITY_LIMIT * r->floor)
		return STABILITY_PLAIN;
	if (is_tiny(r))
		return STABILITY_TINY;
	if (is_undetermined(r))
		return STABILITY_UNDETERMINED;
	if (r->error <= STABILITY_LIMIT * r->floor_of_one)
		return r->of_one;
	if (verb == STABILITY_WEIGHT && facet_is_undetermined(c))
		return STABILITY_UNDETERMINED;
	if (is_length(c, verb, r))
		return STABILITY_LENGTH;
	return verb != STABILITY_DIRECTION && is_bent(c, verb, r->value) ? STABILITY_BENT : STABILITY_PLAIN;
}
