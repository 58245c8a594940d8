/* furnaces_integral.c - integrals over the facets that a direction sees.
 *
 * In polar coordinates of the slopes. Along each azimuth the interval is split where facets begin or cease to count -
 * to be seen, to send light to this side - and where the integrand has a kink; the azimuths are split where that
 * pattern changes. All of these points are found by bisection, and between them everything is smooth, so that Gauss
 * points converge fast. The radius is r = y/(1 - y)^tail, which is odd where a distribution is even, and makes a long
 * tail, r^-2.6 dr of a Student-T's, smooth at its end. Azimuths crowd at the ends of their intervals, where roots
 * begin, and where facets face sideways, whose fate changes within a narrow turn when seen at a grazing angle. */
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>

#include "furnaces.h"
#include "pi.h"

enum { NODES_MAX = 128, ROOTS_MAX = 32, TURNS_MAX = 32 };

/* Slopes end at 1e12 widths, 1e4 where there is no long tail: 6e-8 of the facets seen of the longest is beyond. */
#define LAST 0.9999

/* Where an azimuth is split, both ends included, and a number that tells patterns of splits apart. */
typedef struct {
	double at[ROOTS_MAX];
	furnaces_cut by[ROOTS_MAX];
	int count;
	unsigned pattern;
} splits;

static double radius(const furnaces_integrand *f, double y, double *slope)
{
	const double rest = 1.0 - y, power = f->tail == 1 ? rest : rest * rest * rest;
	*slope = (1.0 + (f->tail - 1) * y) / (power * rest);
	return y / power;
}

/* With more tilt facets cease to be seen once, and so do those that reflect light to this side: of these there is one
 * pattern at all azimuths. */
static int is_simple(const furnaces_integrand *f)
{
	return !((f->bounds | f->kinks) & ~(1u << FURNACES_VISIBLE | 1u << FURNACES_REFLECTED));
}

/* What lies between two zeros that are nearer than a step is missed: more points look closer, so that it shows in the
 * change. */
static int steps_of(const furnaces_integrand *f, size_t n) { return is_simple(f) ? 8 : 16 + (int)n; }

static furnaces_facet facet_at(const furnaces_integrand *f, double c, double s, double y)
{
	double slope;
	const double r = radius(f, y, &slope);
	furnaces_facet m;
	m.s[0] = f->ax * r * c;
	m.s[1] = f->ay * r * s;
	m.s[2] = 1.0;
	m.length2 = m.s[0] * m.s[0] + m.s[1] * m.s[1] + 1.0;
	m.facing = f->o[0] * m.s[0] + f->o[2];
	return m;
}

static double cut(const furnaces_integrand *f, furnaces_cut k, const furnaces_facet *m)
{
	const double step2 = (f->e - 1.0) * (f->e + 1.0);
	const double up = 2.0 * m->facing - f->o[2] * m->length2; /* of the reflected direction, times length2 */
	switch (k) {
	case FURNACES_VISIBLE:
		return m->facing;
	case FURNACES_REFLECTED:
		return up;
	case FURNACES_LEVEL:
		return up - f->o[2] * m->length2;
	case FURNACES_CAVITY_O:
		return 2.0 * f->o[2] - m->facing;
	case FURNACES_CAVITY_I:
		return 2.0 * up - m->facing * m->length2;
	case FURNACES_TOTAL:
		return m->facing * m->facing + step2 * m->length2;
	case FURNACES_REFRACTED: {
		const double length = sqrt(m->length2), c = m->facing / length, g2 = c * c + step2;
		return g2 < 0.0 ? -1.0 : f->o[2] + step2 / (sqrt(g2) + c) / length;
	}
	default:
		return 1.0;
	}
}

static int counts(const furnaces_integrand *f, const furnaces_facet *m)
{
	for (int k = 0; k < FURNACES_CUTS; k++)
		if ((f->bounds & 1u << k) && !(cut(f, (furnaces_cut)k, m) > 0.0))
			return 0;
	return 1;
}

static double zero_between(const furnaces_integrand *f, furnaces_cut k, double c, double s, double lo, double hi,
			   int positive)
{
	for (int j = 0; j < 40; j++) {
		const double middle = 0.5 * (lo + hi);
		const furnaces_facet m = facet_at(f, c, s, middle);
		if ((cut(f, k, &m) > 0.0) == positive)
			lo = middle;
		else
			hi = middle;
	}
	return 0.5 * (lo + hi);
}

static void add_split(splits *all, double at, furnaces_cut by)
{
	int i = all->count;
	if (i == ROOTS_MAX)
		return;
	for (; i > 0 && all->at[i - 1] > at; i--) {
		all->at[i] = all->at[i - 1];
		all->by[i] = all->by[i - 1];
	}
	all->at[i] = at;
	all->by[i] = by;
	all->count++;
}

static splits split(const furnaces_integrand *f, double c, double s, int steps)
{
	splits all = {.count = 0};
	add_split(&all, 0.0, FURNACES_CUTS);
	add_split(&all, LAST, FURNACES_CUTS);
	for (int k = 0; k < FURNACES_CUTS; k++) {
		if (!((f->bounds | f->kinks) & 1u << k))
			continue;
		int last = 0;
		for (int i = 0; i <= steps; i++) {
			const double y = (double)i / steps * LAST;
			const furnaces_facet m = facet_at(f, c, s, y);
			const int positive = cut(f, (furnaces_cut)k, &m) > 0.0;
			if (i > 0 && positive != last)
				add_split(
					&all,
					zero_between(f, (furnaces_cut)k, c, s, (double)(i - 1) / steps * LAST, y, last),
					(furnaces_cut)k);
			last = positive;
		}
	}
	for (int i = 0; i + 1 < all.count; i++) {
		const furnaces_facet m = facet_at(f, c, s, 0.5 * (all.at[i] + all.at[i + 1]));
		all.pattern = all.pattern * 31u + 2u * (unsigned)all.by[i] + (unsigned)counts(f, &m);
	}
	return all;
}

/* Where light begins to be refracted everything goes with the root of the distance: points crowd at the ends of such
 * pieces as v^2 (3 - 2 v). */
static void along(const furnaces_integrand *f, double phi, double weight, const double (*nodes)[2], size_t n,
		  double sum[3])
{
	const double c = cos(phi), s = sin(phi);
	const splits all = split(f, c, s, steps_of(f, n));
	const int roots = ((f->bounds | f->kinks) & 1u << FURNACES_TOTAL) != 0;
	for (int p = 0; p + 1 < all.count; p++) {
		const double from = all.at[p], width = all.at[p + 1] - from;
		furnaces_facet m = facet_at(f, c, s, from + 0.5 * width);
		if (!(width > 1e-11) || !counts(f, &m))
			continue;
		for (size_t i = 0; i < n; i++) {
			const double v = nodes[i][0];
			const double t = roots ? v * v * (3.0 - 2.0 * v) : v;
			const double dt = roots ? 6.0 * v * (1.0 - v) : 1.0;
			const double y = from + width * t;
			double slope;
			const double r = radius(f, y, &slope);
			m = facet_at(f, c, s, y);
			/* dm = m.z^3 d(slopes) */
			const double area = f->ax * f->ay * r * slope / (m.length2 * sqrt(m.length2));
			f->add(f, &m, weight * nodes[i][1] * dt * width * area, sum);
		}
	}
}

/* Azimuths in (0, pi) at which the pattern changes, and pi/2. How many with both ends. */
static int turns_of(const furnaces_integrand *f, int steps, double at[TURNS_MAX])
{
	int n = 0;
	unsigned last = 0;
	at[n++] = 0.0;
	if (is_simple(f)) {
		at[n++] = 0.5 * PI;
		at[n++] = PI;
		return n;
	}
	for (int i = 0; i < steps; i++) {
		const double phi = PI * (i + 0.5) / steps;
		const unsigned pattern = split(f, cos(phi), sin(phi), steps).pattern;
		if (2 * i == steps)
			at[n++] = 0.5 * PI;
		if (i > 0 && pattern != last && n < TURNS_MAX - 2) {
			double lo = PI * (i - 0.5) / steps, hi = phi;
			for (int j = 0; j < 30; j++) {
				const double middle = 0.5 * (lo + hi);
				if (split(f, cos(middle), sin(middle), steps).pattern == last)
					lo = middle;
				else
					hi = middle;
			}
			at[n++] = 0.5 * (lo + hi);
		}
		last = pattern;
	}
	at[n++] = PI;
	/* One change may have been found on either side of pi/2 within the same step. */
	for (int i = 1; i + 1 < n; i++)
		if (at[i] > at[i + 1]) {
			const double swapped = at[i];
			at[i] = at[i + 1];
			at[i + 1] = swapped;
		}
	return n;
}

static void integrate(const furnaces_integrand *f, size_t n, double sum[3])
{
	double nodes[NODES_MAX][2], at[TURNS_MAX];
	const int turns = turns_of(f, steps_of(f, n), at) - 1;
	gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(n);
	for (size_t i = 0; i < n; i++)
		gsl_integration_glfixed_point(0.0, 1.0, i, &nodes[i][0], &nodes[i][1], table);
	gsl_integration_glfixed_table_free(table);
	sum[0] = sum[1] = sum[2] = 0.0;
	for (int k = 0; k < turns; k++)
		for (size_t i = 0; i < n; i++) {
			const double v = nodes[i][0], width = at[k + 1] - at[k];
			const double t = v * v * v * (10.0 - 15.0 * v + 6.0 * v * v);
			const double dt = 30.0 * v * v * (1.0 - v) * (1.0 - v);
			/* Twice: the other half of the turn. */
			along(f, at[k] + width * t, 2.0 * nodes[i][1] * dt * width, (const double(*)[2])nodes, n, sum);
		}
}

double furnaces_integral(const furnaces_integrand *f, double scale, double tolerance, size_t most, double sum[3])
{
	static const size_t points[] = {8, 12, 16, 24, 32, 48, 64};
	double before[2][3], change = HUGE_VAL;
	integrate(f, points[0], before[0]);
	integrate(f, points[1], before[1]);
	for (size_t i = 2; i < sizeof points / sizeof *points && points[i] <= most && !(change < tolerance); i++) {
		integrate(f, points[i], sum);
		change = 0.0;
		for (int k = 0; k < 3; k++) {
			change = fmax(change,
				      2.0 * scale * fmax(fabs(sum[k] - before[0][k]), fabs(sum[k] - before[1][k])));
			before[0][k] = before[1][k];
			before[1][k] = sum[k];
		}
	}
	for (int k = 0; k < 3; k++)
		sum[k] *= scale;
	return change;
}
