/* slope_measure.h - a density of slopes told by a callback, integrated once: its tail and its masking at any
 * steepness. */
#ifndef LOBE_SLOPE_MEASURE_H
#define LOBE_SLOPE_MEASURE_H

#include "gauss_rule.h"
#include "internal.h"

/* Range of u = log r. */
#define LOBE_SLOPE_U_MIN -40.0
#define LOBE_SLOPE_U_MAX 44.0

enum { LOBE_PANEL_POINTS = 10, LOBE_MOMENTS = 5 };

/* Steepness is told by u = log r throughout. Panel k holds the rings from edge[k] to edge[k + 1], as LOBE_PANEL_POINTS
 * rings of steepness r[] and share m[]; the shares of all panels and of the rings beyond the last edge add up to 1.
 * above[k]: the share of panel k and all beyond. beyond: that of the rings beyond the last edge, at mean steepness
 * beyond_r. */
typedef struct {
	lobe_profile_function f;
	void *context;
	double scale; /* what makes f a density of u: scale r^2 f(r) */
	size_t panels;
	double *edge, *above, *r, *m;
	double (*moment)[LOBE_MOMENTS]; /* [k]: of panel k and all beyond, the sums of m r^(1 - 2j), j = 0, 1, ... */
	double beyond, beyond_r;
	double x[LOBE_GAUSS_MAX], w[LOBE_GAUSS_MAX];           /* the panels' rule */
	double fine_x[LOBE_GAUSS_MAX], fine_w[LOBE_GAUSS_MAX]; /* one of LOBE_GAUSS_MAX points */
} lobe_slope_measure;

/* To be released by lobe_slope_measure_free, after failure too. */
lobe_status lobe_slope_measure_make(lobe_slope_measure *s, lobe_profile_function f, void *context);
void lobe_slope_measure_free(lobe_slope_measure *s);

/* Share of rings steeper than r = exp(u), and its fall per step of u. */
double lobe_slope_tail(const lobe_slope_measure *s, double u);
double lobe_slope_density(const lobe_slope_measure *s, double u);

/* h(z) of profile.h, and -dh/dz. */
void lobe_slope_hidden(const lobe_slope_measure *s, double z, double *h, double *fall);

/* The rings between u0 and u1 as points: writes up to `room` of them and tells how many there are. */
size_t lobe_slope_rings(const lobe_slope_measure *s, double u0, double u1, double *r, double *m, size_t room);

/* The table of microfacet/profile.h for a density of slopes f, up to a factor; untouched on failure. (profile_table.c)
 * */
lobe_status lobe_profile_make(float *table, lobe_profile_function f, void *context);

#endif
