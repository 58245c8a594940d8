/* slope_measure.c - panels of log r, split until Gauss-Legendre sums agree with those of their halves. */
#include "slope_measure.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From 4e-18 to 1.3e19, by 1/4, and by 1/16 between 6e-8 and 1e3, where a distribution's peak would be. */
#define U_MIN  LOBE_SLOPE_U_MIN
#define U_MAX  LOBE_SLOPE_U_MAX
#define U_FINE 16.0
#define U_PEAK 7.0

/* An f with jumps is split at each of them down to MIN_WIDTH; MAX_PANELS bounds what a noisy one costs. */
#define MAX_PANELS 16384u
/* Of them, those that fill() begins with (612) find room however much was split before them. */
#define RESERVED   2048u
#define MAX_DEPTH  60 /* a panel of 1/4, halved as often, is below every rounding of u */
#define MIN_WIDTH  1e-7
#define TOLERANCE  1e-11

#define PI 3.14159265358979323846

static double value(const lobe_slope_measure *s, double u)
{
	const double r = exp(u);
	return r * r * s->f(s->context, r);
}

static double panel_sum(const lobe_slope_measure *s, double u0, double u1)
{
	const double middle = 0.5 * (u0 + u1), half = 0.5 * (u1 - u0);
	double sum = 0.0;
	for (int i = 0; i < LOBE_PANEL_POINTS; i++)
		sum += s->w[i] * value(s, middle + half * s->x[i]);
	return half * sum;
}

/* The first value of a panel that cannot be one of a density, in *r, or 0. */
static int panel_is_bad(const lobe_slope_measure *s, double u0, double u1, double *r)
{
	for (int i = 0; i < LOBE_PANEL_POINTS; i++) {
		*r = exp(0.5 * (u0 + u1) + 0.5 * (u1 - u0) * s->x[i]);
		const double v = s->f(s->context, *r);
		if (!(v >= 0.0 && v <= DBL_MAX))
			return 1;
	}
	return 0;
}

static void add_panel(lobe_slope_measure *s, double u0, double u1)
{
	const size_t k = s->panels++;
	const double middle = 0.5 * (u0 + u1), half = 0.5 * (u1 - u0);
	for (int i = 0; i < LOBE_PANEL_POINTS; i++) {
		const double u = middle + half * s->x[i];
		s->r[k * LOBE_PANEL_POINTS + (size_t)i] = exp(u);
		s->m[k * LOBE_PANEL_POINTS + (size_t)i] = half * s->w[i] * value(s, u);
	}
	s->edge[k] = u0;
	s->edge[k + 1] = u1;
}

/* Halves are kept on a stack, flatter ones on top, so that panels come out in order. */
static lobe_status split(lobe_slope_measure *s, double u0, double u1)
{
	struct {
		double u0, u1, sum;
	} stack[MAX_DEPTH + 2], now;
	int depth = 0;
	double r;
	if (panel_is_bad(s, u0, u1, &r))
		return lobe_fail(LOBE_ERROR_PARAMETER, "f(%g) is not a finite number >= 0", r);
	stack[depth].u0 = u0;
	stack[depth].u1 = u1;
	stack[depth++].sum = panel_sum(s, u0, u1);
	while (depth > 0) {
		now = stack[--depth];
		const double middle = 0.5 * (now.u0 + now.u1);
		if (panel_is_bad(s, now.u0, middle, &r) || panel_is_bad(s, middle, now.u1, &r))
			return lobe_fail(LOBE_ERROR_PARAMETER, "f(%g) is not a finite number >= 0", r);
		const double a = panel_sum(s, now.u0, middle), b = panel_sum(s, middle, now.u1);
		const int done = fabs(a + b - now.sum) <= TOLERANCE * (a + b) || now.u1 - now.u0 < MIN_WIDTH ||
				 s->panels + (size_t)depth > MAX_PANELS - RESERVED || depth > MAX_DEPTH;
		if (done) {
			add_panel(s, now.u0, now.u1);
			continue;
		}
		stack[depth].u0 = middle;
		stack[depth].u1 = now.u1;
		stack[depth++].sum = b;
		stack[depth].u0 = now.u0;
		stack[depth].u1 = middle;
		stack[depth++].sum = a;
	}
	return LOBE_OK;
}

/* Rings beyond U_MAX, where f is taken to go on as the power r^-a that it falls by there: their share is that of
 * r^2 f/(a - 2), their mean steepness (a - 2)/(a - 3). */
static lobe_status close_tail(lobe_slope_measure *s)
{
	const double last = value(s, U_MAX), before = value(s, U_MAX - 1.0);
	s->beyond = 0.0;
	s->beyond_r = exp(U_MAX);
	if (!(last > 0.0) || !(before > 0.0))
		return LOBE_OK;
	const double a = 2.0 + log(before / last);
	if (!(a > 2.0))
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "f cannot be integrated: it falls as tan_theta^-%.4g, and not faster "
				 "than tan_theta^-2",
				 a);
	if (!(a >= 3.0015))
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "the mean slope is infinite: f falls as tan_theta^-%.4g, and not "
				 "faster than tan_theta^-3",
				 a);
	s->beyond = last / (a - 2.0);
	s->beyond_r = exp(U_MAX) * (a - 2.0) / (a - 3.0);
	return LOBE_OK;
}

static void add_moments(double *moment, double r, double m)
{
	double power = m * r;
	for (int j = 0; j < LOBE_MOMENTS; j++) {
		moment[j] += power;
		power /= r * r;
	}
}

static void sum_moments(lobe_slope_measure *s)
{
	double moment[LOBE_MOMENTS] = {0};
	add_moments(moment, s->beyond_r, s->beyond);
	memcpy(s->moment[s->panels], moment, sizeof moment);
	for (size_t k = s->panels; k-- > 0;) {
		for (size_t i = k * LOBE_PANEL_POINTS; i < (k + 1) * LOBE_PANEL_POINTS; i++)
			add_moments(moment, s->r[i], s->m[i]);
		memcpy(s->moment[k], moment, sizeof moment);
	}
}

static lobe_status fill(lobe_slope_measure *s)
{
	lobe_status status = LOBE_OK;
	for (double u = U_MIN; u < U_MAX && status == LOBE_OK;) {
		const double step = u >= -U_FINE && u < U_PEAK ? 0.0625 : 0.25;
		status = split(s, u, u + step);
		u += step;
	}
	if (status == LOBE_OK)
		status = close_tail(s);
	if (status != LOBE_OK)
		return status;
	/* From the steepest rings down, so that small shares keep their digits. */
	double sum = s->beyond;
	for (size_t k = s->panels; k-- > 0;) {
		s->above[k + 1] = sum;
		for (size_t i = 0; i < LOBE_PANEL_POINTS; i++)
			sum += s->m[k * LOBE_PANEL_POINTS + i];
	}
	s->above[0] = sum;
	if (!(sum > 0.0))
		return lobe_fail(LOBE_ERROR_PARAMETER, "f is 0 everywhere");
	if (!(sum <= DBL_MAX) || !(1.0 / sum <= DBL_MAX))
		return lobe_fail(LOBE_ERROR_PARAMETER, "f is too large or too small to be integrated: %g", sum);
	/* A density that is not integrable at the normal would show as a share of its first panel. */
	if (s->above[0] - s->above[1] > 1e-3 * sum)
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "f cannot be integrated: it grows too fast towards tan_theta = 0");
	s->scale = 1.0 / sum;
	s->beyond /= sum;
	for (size_t k = 0; k <= s->panels; k++)
		s->above[k] /= sum;
	for (size_t i = 0; i < s->panels * LOBE_PANEL_POINTS; i++)
		s->m[i] /= sum;
	sum_moments(s);
	return LOBE_OK;
}

lobe_status lobe_slope_measure_make(lobe_slope_measure *s, lobe_profile_function f, void *context)
{
	s->f = f;
	s->context = context;
	s->scale = 1.0;
	s->panels = 0;
	s->edge = malloc((MAX_PANELS + 1) * sizeof *s->edge);
	s->above = malloc((MAX_PANELS + 1) * sizeof *s->above);
	s->r = malloc(MAX_PANELS * LOBE_PANEL_POINTS * sizeof *s->r);
	s->m = malloc(MAX_PANELS * LOBE_PANEL_POINTS * sizeof *s->m);
	s->moment = malloc((MAX_PANELS + 1) * sizeof *s->moment);
	if (!s->edge || !s->above || !s->r || !s->m || !s->moment)
		return lobe_fail(LOBE_ERROR_MEMORY, "no memory to integrate a distribution");
	lobe_gauss_legendre(LOBE_PANEL_POINTS, s->x, s->w);
	lobe_gauss_legendre(LOBE_GAUSS_MAX, s->fine_x, s->fine_w);
	return fill(s);
}

void lobe_slope_measure_free(lobe_slope_measure *s)
{
	free(s->edge);
	free(s->above);
	free(s->r);
	free(s->m);
	free(s->moment);
}

/* The panel that holds u. */
static size_t panel_of(const lobe_slope_measure *s, double u)
{
	size_t lo = 0, hi = s->panels - 1;
	while (lo < hi) {
		const size_t middle = (lo + hi + 1) / 2;
		if (s->edge[middle] <= u)
			lo = middle;
		else
			hi = middle - 1;
	}
	return lo;
}

double lobe_slope_density(const lobe_slope_measure *s, double u) { return s->scale * value(s, u); }

double lobe_slope_tail(const lobe_slope_measure *s, double u)
{
	if (u <= U_MIN)
		return 1.0;
	if (u >= U_MAX)
		return s->beyond;
	const size_t k = panel_of(s, u);
	return s->above[k + 1] + s->scale * panel_sum(s, u, s->edge[k + 1]);
}

/* r k(z/r) and the derivative of that by z, -acos(z/r)/pi; k as (sin a - a cos a)/pi with cos a = z/r. */
static void ring_hidden(double r, double z, double *h, double *fall)
{
	const double d = r > z ? (r - z) / r : 0.0;
	const double a = 2.0 * asin(sqrt(0.5 * d)), a2 = a * a;
	const double series = a * a2 * (1.0 / 3.0 - a2 * (1.0 / 30.0 - a2 * (1.0 / 840.0 - a2 / 45360.0)));
	*h = r * (a < 0.1 ? series : sin(a) - a * cos(a)) / PI;
	*fall = a / PI;
}

/* Adds what the rings from r0 >= z to r1 hide. Near z the kernel's power 3/2 would spoil a panel's own rule; in w with
 * r = z + w^2 it is smooth. */
static void add_near(const lobe_slope_measure *s, double z, double r0, double r1, double *h, double *fall)
{
	const double w0 = sqrt(r0 - z), w1 = sqrt(r1 - z);
	for (int i = 0; i < LOBE_GAUSS_MAX; i++) {
		const double w = 0.5 * (w0 + w1) + 0.5 * (w1 - w0) * s->fine_x[i], r = z + w * w;
		const double share = s->fine_w[i] * (w1 - w0) * w * s->scale * r * s->f(s->context, r);
		double ring, ring_fall;
		ring_hidden(r, z, &ring, &ring_fall);
		*h += share * ring;
		*fall += share * ring_fall;
	}
}

/* Adds what the rings of panel k and all beyond hide, for x = z/r <= 1/8 there, by the series
 *	pi k(x) = 1 - pi x/2 + x^2/2 + x^4/24 + x^6/80 + 5 x^8/896 + ...   (next: 4e-12) */
static void add_far(const lobe_slope_measure *s, double z, size_t k, double *h, double *fall)
{
	static const double term[LOBE_MOMENTS] = {1.0, 1.0 / 2.0, 1.0 / 24.0, 1.0 / 80.0, 5.0 / 896.0};
	double power = 1.0, even = 0.0, slope = 0.0;
	for (int j = 0; j < LOBE_MOMENTS; j++) {
		even += term[j] * power * s->moment[k][j];
		if (j + 1 < LOBE_MOMENTS)
			slope += 2.0 * (j + 1) * term[j + 1] * power * z * s->moment[k][j + 1];
		power *= z * z;
	}
	*h += even / PI - 0.5 * z * s->above[k];
	*fall += 0.5 * s->above[k] - slope / PI;
}

void lobe_slope_hidden(const lobe_slope_measure *s, double z, double *h, double *fall)
{
	const double u = z > 0.0 ? log(z) : U_MIN - 1.0;
	size_t k = u > U_MIN  ? panel_of(s, u) : 0;
	*h = *fall = 0.0;
	for (int near = 0; near < 3 && u > U_MIN  && k < s->panels; near++, k++) {
		const double r0 = exp(s->edge[k]), r1 = exp(s->edge[k + 1]);
		if (r1 > z)
			add_near(s, z, r0 > z ? r0 : z, r1, h, fall);
	}
	for (; k < s->panels && exp(s->edge[k]) < 8.0 * z; k++) {
		for (size_t i = k * LOBE_PANEL_POINTS; i < (k + 1) * LOBE_PANEL_POINTS; i++) {
			double ring, ring_fall;
			ring_hidden(s->r[i], z, &ring, &ring_fall);
			*h += s->m[i] * ring;
			*fall += s->m[i] * ring_fall;
		}
	}
	if (k < s->panels || s->beyond_r >= 8.0 * z)
		add_far(s, z, k, h, fall);
}

size_t lobe_slope_rings(const lobe_slope_measure *s, double u0, double u1, double *r, double *m, size_t room)
{
	size_t n = 0;
	if (u0 < U_MIN)
		u0 = U_MIN;
	for (size_t k = panel_of(s, u0); k < s->panels && s->edge[k] < u1; k++) {
		const double a = s->edge[k] > u0 ? s->edge[k] : u0, b = s->edge[k + 1] < u1 ? s->edge[k + 1] : u1;
		for (int i = 0; i < LOBE_PANEL_POINTS && n < room; i++) {
			const double u = 0.5 * (a + b) + 0.5 * (b - a) * s->x[i];
			r[n] = exp(u);
			m[n++] = 0.5 * (b - a) * s->w[i] * lobe_slope_density(s, u);
		}
	}
	if (u1 >= U_MAX && n < room) {
		r[n] = s->beyond_r;
		m[n++] = s->beyond;
	}
	return n;
}
