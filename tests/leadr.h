/* leadr.h - correlated and tilted microsurfaces in double as Dupuy et al. 2013 ("Linear efficient antialiased
 * displacement and reflectance mapping") write them: whitened slopes and rho. No code or rearrangement is shared with
 * the library. */
#ifndef LOBE_TESTS_LEADR_H
#define LOBE_TESTS_LEADR_H

typedef enum { LEADR_GGX, LEADR_BECKMANN } leadr_kind;

/* Widths, correlation and mean of the slopes. */
typedef struct {
	leadr_kind kind;
	double ax, ay, rho, tx, ty;
} leadr;

/* P22 of the slopes (x, y), and D of a normal that need not be unit, of degree -4. */
double leadr_p22(const leadr *s, double x, double y);
double leadr_d(const leadr *s, const double m[3]);

/* k': the direction from which the surface of width 1 is seen; sigma(k) = sigma_1(k'). */
void leadr_direction(const leadr *s, const double k[3], double v[3]);
double leadr_sigma(const leadr *s, const double k[3]);

/* Smith's Lambda of the standard surface for a direction above its horizon, from the papers' tangents (Heitz 2014). */
double leadr_lambda(leadr_kind kind, const double v[3]);

/* The fraction of the plane under facets of the standard surface steeper than sqrt(t2), and its inverse. */
double leadr_tail(leadr_kind kind, double t2);
double leadr_tail_inverse(leadr_kind kind, double q);

/* By how much errors of the whitened slopes grow in P22 and D at m: 1, or 1 + r^2 where exp(-r^2) falls. */
double leadr_steepness(const leadr *s, const double m[3]);

/* Ratio of the largest to the smallest singular value of the map of slopes. */
double leadr_condition(const leadr *s);

#endif
