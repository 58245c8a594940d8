/* profile_table.c - from a density of slopes to the table of microfacet/profile.h. */
#include "slope_measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A curve is followed until it has fallen to LOWEST of its largest value, and no farther than X_MAX. */
#define LOWEST       1e-36
#define TAIL_X_MAX   1e34
#define HIDDEN_X_MAX 1e10

/* Pieces narrower than a few steps of a float's log X tell nothing apart. */
#define NARROWEST 1e-6

/* log value and its fall at a place, both as functions of l = log X. */
typedef struct {
	double l, log_value, slope;
} knot;

/* One of the two curves; t0: the square of the steepness that its places are counted in. */
typedef struct {
	const lobe_slope_measure *s;
	double t0;
	int hidden;
} curve;

static double log_of_r(const curve *c, double l)
{
	const double x = expm1(l);
	return c->hidden ? log(x) + 0.5 * log(c->t0) : 0.5 * (log(x) + log(c->t0));
}

static double l_of_r(const curve *c, double u)
{
	return log1p(c->hidden ? exp(u) / sqrt(c->t0) : exp(2.0 * u) / c->t0);
}

static knot knot_at(const curve *c, double l)
{
	const double u = l > 0.0 ? log_of_r(c, l) : LOBE_SLOPE_U_MIN;
	knot k;
	k.l = l;
	if (c->hidden) {
		/* d log h/dl = (dh/dz)(z + r0)/h */
		double h, fall;
		lobe_slope_hidden(c->s, l > 0.0 ? exp(u) : 0.0, &h, &fall);
		k.log_value = log(h);
		k.slope = fall * exp(l) * sqrt(c->t0) / h;
	} else {
		/* d log Q/dl = -(dQ/du) (du/dl)/Q with du/dl = X/(2 (X - 1)); at l = 0 both vanish and dQ/du ~ X -
		 * 1. */
		const double q = lobe_slope_tail(c->s, u), r2 = exp(2.0 * u) / c->t0;
		k.log_value = log(q);
		k.slope = lobe_slope_density(c->s, u) * (1.0 + r2) / (2.0 * r2 * q);
	}
	return k;
}

/* Slopes of a monotone cubic are at most 3 times the mean (Fritsch and Carlson 1980). */
static double limited(double slope, double width, double fall)
{
	const double s = slope * width;
	return s < 3.0 * fall ? s : 3.0 * fall;
}

typedef struct {
	knot a, b;
	double error;
} piece;

/* What a piece is worth splitting for: the error of its cubic, and that of its slope, which is the density; less where
 * hardly any slopes are, and a share for its width, which the sampler's sums are over. */
static double piece_error(const curve *c, const piece *p, double log_top)
{
	const double width = p->b.l - p->a.l, fall = p->a.log_value - p->b.log_value;
	if (width < NARROWEST)
		return 0.0;
	const double m0 = limited(p->a.slope, width, fall), m1 = limited(p->b.slope, width, fall);
	const double cubic = m0 + m1 - 2.0 * fall, square = fall - m0 - cubic;
	double worst = 0.0;
	for (int i = 1; i < 4; i++) {
		const double t = 0.25 * i;
		const knot k = knot_at(c, p->a.l + t * width);
		const double value = t * (m0 + t * (square + t * cubic));
		const double slope = (m0 + t * (2.0 * square + t * 3.0 * cubic)) / width;
		const double off = fabs(value - (p->a.log_value - k.log_value));
		const double slope_off = c->hidden ? 0.0 : fabs(slope - k.slope) / (fabs(k.slope) + 1e-3);
		const double error = off > slope_off ? off : slope_off;
		worst = error > worst ? error : worst;
	}
	worst = worst < 1.0 ? worst : 1.0;
	const double depth = log_top - p->a.log_value;
	/* In the first piece steepness is a square root of the place. */
	const double sums = p->a.l > 0.0 ? 1e-3 * pow(width, 4.0) : 1e-2 * pow(width, 1.5);
	const double share = c->hidden ? 0.0 : sums * exp(-0.5 * depth);
	return worst * exp(-0.1 * depth) * fmin(width / 0.02, 1.0) + share + 1e-12 * width;
}

/* The largest place where the curve has not yet fallen to LOWEST of its largest value. */
static double last_l(const curve *c)
{
	const double log_lowest = knot_at(c, 0.0).log_value + log(LOWEST);
	double lo = 0.0, hi = log(c->hidden ? HIDDEN_X_MAX : TAIL_X_MAX);
	const double edge = l_of_r(c, c->s->edge[c->s->panels]);
	hi = edge < hi ? edge : hi;
	if (knot_at(c, hi).log_value >= log_lowest)
		return hi;
	for (int i = 0; i < 60; i++) {
		const double middle = 0.5 * (lo + hi);
		if (knot_at(c, middle).log_value >= log_lowest)
			lo = middle;
		else
			hi = middle;
	}
	return lo;
}

/* Between two places, where X is a float: what is known of the curve at a knot is then known of where the table has
 * it. */
static double middle_l(double a, double b) { return log((double)(float)exp(0.5 * (a + b))); }

/* Splits the worst piece until there are enough, in order. */
static void fit(const curve *c, piece *pieces, size_t count)
{
	const double end = last_l(c), log_top = knot_at(c, 0.0).log_value;
	size_t n = 1;
	pieces[0].a = knot_at(c, 0.0);
	pieces[0].b = knot_at(c, end);
	pieces[0].error = 1.0;
	while (n < count) {
		size_t worst = 0;
		for (size_t i = 1; i < n; i++)
			if (pieces[i].error > pieces[worst].error)
				worst = i;
		piece *p = &pieces[worst];
		memmove(p + 1, p, (n - worst) * sizeof *p);
		n++;
		p[0].b = p[1].a = knot_at(c, middle_l(p[0].a.l, p[0].b.l));
		p[0].error = piece_error(c, &p[0], log_top);
		p[1].error = piece_error(c, &p[1], log_top);
	}
}

static void write_curve(const piece *pieces, float *words)
{
	for (size_t i = 0; i <= LOBE_PROFILE_LEAVES; i++) {
		const knot k = i < LOBE_PROFILE_LEAVES ? pieces[i].a : pieces[i - 1].b;
		float *w = words + i * LOBE_KNOT_WORDS;
		w[LOBE_KNOT_X] = (float)exp(k.l);
		w[LOBE_KNOT_VALUE] = (float)exp(k.log_value);
		if (i == LOBE_PROFILE_LEAVES)
			break;
		const piece *p = &pieces[i];
		const double width = p->b.l - p->a.l, fall = fmax(p->a.log_value - p->b.log_value, 0.0);
		w[LOBE_KNOT_WIDTH] = (float)width;
		w[LOBE_KNOT_FALL] = (float)fall;
		w[LOBE_KNOT_SLOPE0] = (float)limited(p->a.slope, width, fall);
		w[LOBE_KNOT_SLOPE1] = (float)limited(p->b.slope, width, fall);
	}
}

/* What the rules of the steeper halves of the tree over the pieces are made from, and where they go. */
typedef struct {
	const double *s, *m;  /* 1/r and r dF of every ring, from the flattest on */
	const size_t *starts; /* [piece]: its first ring; one more for the end */
	float *words;
} ring_list;

static void write_rules(const ring_list *rings, size_t node, size_t first, size_t size)
{
	double x[LOBE_PROFILE_GAUSS], w[LOBE_PROFILE_GAUSS];
	if (size < 2)
		return;
	const size_t middle = first + size / 2, from = rings->starts[middle], to = rings->starts[first + size];
	lobe_gauss_of_measure(LOBE_PROFILE_GAUSS, rings->s + from, rings->m + from, to - from, x, w);
	for (size_t g = 0; g < LOBE_PROFILE_GAUSS; g++) {
		rings->words[node * LOBE_PROFILE_RULE_WORDS + 2 * g] = (float)x[g];
		rings->words[node * LOBE_PROFILE_RULE_WORDS + 2 * g + 1] = (float)w[g];
	}
	write_rules(rings, 2 * node, first, size / 2);
	write_rules(rings, 2 * node + 1, middle, size / 2);
}

static lobe_status make_rules(const curve *tail, const piece *pieces, float *words)
{
	/* Every panel may be cut by a knot. */
	const size_t room = (tail->s->panels + 2 * LOBE_PROFILE_LEAVES + 2) * LOBE_PANEL_POINTS;
	double *s = malloc(room * sizeof *s), *m = malloc(room * sizeof *m);
	size_t starts[LOBE_PROFILE_LEAVES + 1], n = 0;
	if (!s || !m) {
		free(s);
		free(m);
		return lobe_fail(LOBE_ERROR_MEMORY, "no memory to integrate a distribution");
	}
	for (size_t i = 0; i < LOBE_PROFILE_LEAVES; i++) {
		const double u0 = pieces[i].a.l > 0.0 ? log_of_r(tail, pieces[i].a.l) : tail->s->edge[0];
		const double u1 = i + 1 < LOBE_PROFILE_LEAVES ? log_of_r(tail, pieces[i].b.l) : HUGE_VAL;
		starts[i] = n;
		n += lobe_slope_rings(tail->s, u0, u1, s + n, m + n, room - n);
	}
	starts[LOBE_PROFILE_LEAVES] = n;
	for (size_t i = 0; i < n; i++) {
		m[i] *= s[i];
		s[i] = 1.0 / s[i];
	}
	const ring_list rings = {s, m, starts, words};
	write_rules(&rings, 1, 0, LOBE_PROFILE_LEAVES);
	free(s);
	free(m);
	return LOBE_OK;
}

/* tan^2 of tail q. */
static double quantile(const lobe_slope_measure *s, double q)
{
	double lo = s->edge[0], hi = s->edge[s->panels];
	for (int i = 0; i < 60; i++) {
		const double middle = 0.5 * (lo + hi);
		if (lobe_slope_tail(s, middle) > q)
			lo = middle;
		else
			hi = middle;
	}
	return exp(2.0 * lo);
}

static lobe_status build(const lobe_slope_measure *s, piece *pieces, float *words)
{
	const double t0 = quantile(s, 15.0 / 16.0), r0 = sqrt(quantile(s, 0.5));
	if (!(t0 > 1e-24 && r0 < 1e12))
		return lobe_fail(LOBE_ERROR_PARAMETER, "the median of tan_theta is %g: rescale f to a width of about 1",
				 r0);
	const curve tail = {s, t0, 0}, hidden = {s, r0 * r0, 1};
	words[0] = (float)LOBE_PROFILE_WORDS;
	words[LOBE_PROFILE_T0] = (float)t0;
	words[LOBE_PROFILE_INV_T0] = (float)(1.0 / t0);
	words[LOBE_PROFILE_INV_R0] = (float)(1.0 / r0);
	fit(&hidden, pieces, LOBE_PROFILE_LEAVES);
	write_curve(pieces, words + LOBE_PROFILE_HIDDEN);
	fit(&tail, pieces, LOBE_PROFILE_LEAVES);
	write_curve(pieces, words + LOBE_PROFILE_TAIL);
	return make_rules(&tail, pieces, words + LOBE_PROFILE_RULES);
}

lobe_status lobe_profile_make(float *table, lobe_profile_function f, void *context)
{
	lobe_slope_measure s;
	piece pieces[LOBE_PROFILE_LEAVES];
	float *words = calloc(LOBE_PROFILE_WORDS, sizeof *words);
	lobe_status status = lobe_slope_measure_make(&s, f, context);
	if (status == LOBE_OK && !words)
		status = lobe_fail(LOBE_ERROR_MEMORY, "no memory for a table");
	if (status == LOBE_OK)
		status = build(&s, pieces, words);
	if (status == LOBE_OK)
		memcpy(table, words, LOBE_PROFILE_WORDS * sizeof *words);
	lobe_slope_measure_free(&s);
	free(words);
	return status;
}
