/* stability_ascend.c - the search for a worst case: uphill by the simplex method, then ulp by ulp. */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>
#include <math.h>
#include <string.h>

#include "stability.h"
#include "support.h"

/* Where the simplex is: factors on the tangent of wo, on the slope of the facet and on each parameter (eta's distance
 * from 1), as logarithms, and turns of the two about the normal. */
enum { ANGLES = 4, DIMENSIONS_MAX = ANGLES + CASE_PARAMETERS };

typedef struct {
	stability_measure_ratio ratio;
	stability_verb verb;
	stability_case start, best;
	double best_ratio;
	int parameter[CASE_PARAMETERS];
	size_t parameters;
	unsigned tried;
} ascent;

static double try(ascent *a, const stability_case *c)
{
	const stability_result r = stability_measure(c, a->verb);
	const double ratio = a->ratio(&r);
	a->tried++;
	if (ratio > a->best_ratio) {
		a->best_ratio = ratio;
		a->best = *c;
	}
	return ratio;
}

static void normalise(double v[3])
{
	const double n = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
	for (int k = 0; k < 3; k++)
		v[k] /= n;
}

/* The direction w with its tangent times exp(stretch), turned by phi. */
static void turn(const double w[3], double stretch, double phi, double out[3])
{
	const double s = exp(stretch), c = cos(phi), t = sin(phi);
	out[0] = s * (w[0] * c - w[1] * t);
	out[1] = s * (w[0] * t + w[1] * c);
	out[2] = w[2];
	normalise(out);
}

/* wi about the facet m as wo is, or refracted by it; e: far index over near index as wo sees it. */
static int scatter(const double o[3], const double m_in[3], double e, int across, double i[3])
{
	double m[3], c = 0.0;
	memcpy(m, m_in, sizeof m);
	for (int k = 0; k < 3; k++)
		c += o[k] * m[k];
	const double g2 = e * e - 1.0 + c * c;
	if (across && g2 < 0.0)
		return 0;
	const double bend = across ? ((c > 0.0 ? 1.0 : -1.0) * sqrt(g2) - c) / -e : 2.0 * c;
	for (int k = 0; k < 3; k++)
		i[k] = across ? bend * m[k] - o[k] / e : bend * m[k] - o[k];
	normalise(i);
	return 1;
}

static int transmits_at(lobe_uint kind)
{
	return kind == LOBE_KIND_GGX_DIELECTRIC || kind == LOBE_KIND_BECKMANN_DIELECTRIC ||
			       kind == LOBE_KIND_MICROFACET_DIELECTRIC
		       ? 2
	       : kind == LOBE_KIND_IRIDESCENT_DIELECTRIC ? 4
							 : 0;
}

static double within(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }

/* Parameter k moved by a factor, and kept in its domain. */
static double moved(lobe_uint kind, int k, double old, double log_factor)
{
	const int eta = transmits_at(kind),
		  smooth = kind == LOBE_KIND_SMOOTH_DIELECTRIC || kind == LOBE_KIND_THIN_DIELECTRIC;
	const double factor = exp(within(log_factor, -20.0, 20.0));
	const int colour = kind == LOBE_KIND_LAMBERT || kind == LOBE_KIND_MIRROR || kind == LOBE_KIND_GGX_SCHLICK ||
			   kind == LOBE_KIND_MICROFACET_DIFFUSE;
	const int free = kind == LOBE_KIND_MICROFACET_CONDUCTOR || kind == LOBE_KIND_MICROFACET_DIELECTRIC ||
			 kind == LOBE_KIND_MICROFACET_DIFFUSE;
	const int film = kind == LOBE_KIND_IRIDESCENT_CONDUCTOR || kind == LOBE_KIND_IRIDESCENT_DIELECTRIC;
	double x = old * factor;
	if ((eta && k == eta) || smooth)
		x = within(1.0 + (old - 1.0) * factor, 1e-3, 1e3);
	else if (kind == LOBE_KIND_SMOOTH_CONDUCTOR || (film && k >= 4))
		x = within(x, k >= (film ? 7 : 3) ? 0.0 : 1e-3, 100.0);
	else if (film && k == 2)
		x = within(x, 0.0, 1e6);
	else if (film && k == 3)
		x = within(x, 1e-3, 1e3);
	else if (k < 2)
		x = colour && kind != LOBE_KIND_GGX_SCHLICK && !free ? within(x, 0.0, 1.0)
								     : within(x, free ? 1e-6 : 1e-4, 1.0);
	else if (k >= 11)
		x = within(x, -100.0, 100.0);
	else if (colour)
		x = within(x, 0.0, 1.0);
	else
		x = within(x, k >= 5 ? 0.0 : 1e-3, 100.0);
	return (double)(float)x;
}

/* Films: not rarer than both sides, nor of an index that no film has. */
static int in_domain(const stability_case *c)
{
	const double *p = c->parameter;
	if (c->kind == LOBE_KIND_IRIDESCENT_CONDUCTOR)
		return p[3] >= 1.0 && p[3] <= 4.0;
	return c->kind != LOBE_KIND_IRIDESCENT_DIELECTRIC || (p[3] >= fmin(p[4], 1.0) && p[3] <= 4.0 * fmin(p[4], 1.0));
}

static int place(const ascent *a, const gsl_vector *v, stability_case *c)
{
	double o[3], i[3], m[3], wo[3], facet[3], wi[3];
	*c = a->start;
	for (size_t k = 0; k < a->parameters; k++) {
		const int at = a->parameter[k];
		c->parameter[at] = moved(c->kind, at, c->parameter[at], gsl_vector_get(v, ANGLES + k));
	}
	const int eta_at = transmits_at(c->kind);
	for (int k = 0; k < 3; k++) {
		o[k] = (double)a->start.wo[k];
		i[k] = (double)a->start.wi[k];
	}
	const int across = o[2] * i[2] < 0.0 && eta_at;
	const double old = eta_at ? a->start.parameter[eta_at] : 1.0, now = eta_at ? c->parameter[eta_at] : 1.0;
	const double e_old = across ? (o[2] > 0.0 ? old : 1.0 / old) : 1.0,
		     e_now = across ? (o[2] > 0.0 ? now : 1.0 / now) : 1.0;
	for (int k = 0; k < 3; k++)
		m[k] = o[k] + e_old * i[k];
	if (m[0] == 0.0 && m[1] == 0.0 && m[2] == 0.0)
		return 0;
	normalise(m);
	turn(o, gsl_vector_get(v, 0), gsl_vector_get(v, 1), wo);
	turn(m, gsl_vector_get(v, 2), gsl_vector_get(v, 3), facet);
	if (!scatter(wo, facet, e_now, across, wi))
		return 0;
	for (int k = 0; k < 3; k++) {
		c->wo[k] = (float)wo[k];
		c->wi[k] = (float)wi[k];
	}
	return 1;
}

static double descend(const gsl_vector *v, void *context)
{
	ascent *a = context;
	stability_case c;
	if (!place(a, v, &c) || !in_domain(&c)) {
		a->tried++;
		return 100.0;
	}
	return -log(try(a, &c) + 1e-3);
}

static void simplex(ascent *a, unsigned steps)
{
	const size_t n = ANGLES + a->parameters;
	gsl_vector *at = gsl_vector_calloc(n), *size = gsl_vector_alloc(n);
	gsl_multimin_fminimizer *s = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, n);
	gsl_multimin_function f = {descend, n, a};
	gsl_vector_set_all(size, 0.7);
	gsl_vector_set(size, 1, 0.3);
	gsl_vector_set(size, 3, 0.3);
	a->start = a->best;
	const unsigned until = a->tried + steps;
	gsl_multimin_fminimizer_set(s, &f, at, size);
	while (a->tried < until && gsl_multimin_fminimizer_iterate(s) == GSL_SUCCESS &&
	       gsl_multimin_fminimizer_size(s) > 1e-9)
		;
	gsl_multimin_fminimizer_free(s);
	gsl_vector_free(size);
	gsl_vector_free(at);
}

static float ulps(float x, int n)
{
	for (; n > 0; n--)
		x = nextafterf(x, INFINITY);
	for (; n < 0; n++)
		x = nextafterf(x, -INFINITY);
	return x;
}

/* One to three inputs by up to 16 ulp each, kept where that is worse. */
static void climb(ascent *a, unsigned steps, uint64_t seed)
{
	uint64_t at = seed << 20;
	for (unsigned n = 0; n < steps; n++) {
		stability_case c = a->best;
		for (uint32_t moves = 1 + test_bits(7500, at++) % 3; moves > 0; moves--) {
			const uint32_t which = test_bits(7500, at++) % (uint32_t)(6 + a->parameters);
			const int by = (int)(test_bits(7500, at++) % 33) - 16;
			if (which < 3)
				c.wo[which] = ulps(c.wo[which], by);
			else if (which < 6 && a->verb >= STABILITY_WEIGHT)
				c.u[which - 3] = (float)within((double)ulps(c.u[which - 3], by), 0.0, 0x1.fffffep-1);
			else if (which < 6)
				c.wi[which - 3] = ulps(c.wi[which - 3], by);
			else {
				const int k = a->parameter[which - 6];
				const double x = (double)ulps((float)c.parameter[k], by);
				/* Ends of domains stay. */
				if (moved(c.kind, k, x, 0.0) == x)
					c.parameter[k] = x;
			}
		}
		/* Units of length: directions stay within four ulp of it. */
		double o = 0.0, i = 0.0;
		for (int k = 0; k < 3; k++) {
			o += (double)c.wo[k] * (double)c.wo[k];
			i += (double)c.wi[k] * (double)c.wi[k];
		}
		if (fabs(o - 1.0) < 1e-6 && fabs(i - 1.0) < 1e-6 && in_domain(&c))
			try(a, &c);
	}
}

stability_case stability_ascend(stability_measure_ratio ratio, stability_case c, stability_verb verb, unsigned steps,
				uint64_t seed)
{
	ascent a;
	memset(&a, 0, sizeof a);
	a.ratio = ratio;
	a.verb = verb;
	a.best = c;
	a.parameters = stability_parameters_of(&c, a.parameter);
	try(&a, &c);
	/* What a sample is asked about is not wi but what u makes of wo: ulps are all there is to move. */
	if (verb < STABILITY_WEIGHT)
		simplex(&a, steps / 2);
	climb(&a, verb < STABILITY_WEIGHT ? steps / 2 : steps, seed);
	return a.best;
}
