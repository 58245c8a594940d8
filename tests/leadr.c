#include "leadr.h"

#include "support.h"

#include <math.h>

double leadr_tail(leadr_kind kind, double t2) { return kind == LEADR_GGX ? 1.0 / (1.0 + t2) : exp(-t2); }

double leadr_tail_inverse(leadr_kind kind, double q) { return kind == LEADR_GGX ? 1.0 / q - 1.0 : -log(q); }

/* Squared length of the whitened slopes. */
static double whitened(const leadr *s, double slope_x, double slope_y)
{
	const double x = slope_x - s->tx, y = slope_y - s->ty, root = sqrt(1.0 - s->rho * s->rho);
	const double p = x / s->ax, q = (s->ax * y - s->rho * s->ay * x) / (s->ax * s->ay * root);
	return p * p + q * q;
}

double leadr_p22(const leadr *s, double x, double y)
{
	const double r2 = whitened(s, x, y), det = s->ax * s->ay * sqrt(1.0 - s->rho * s->rho);
	return (s->kind == LEADR_GGX ? 1.0 / ((1.0 + r2) * (1.0 + r2)) : exp(-r2)) / (PI * det);
}

double leadr_d(const leadr *s, const double m[3])
{
	if (m[2] <= 0.0)
		return 0.0;
	return leadr_p22(s, -m[0] / m[2], -m[1] / m[2]) / (m[2] * m[2] * m[2] * m[2]);
}

double leadr_steepness(const leadr *s, const double m[3])
{
	return s->kind == LEADR_GGX ? 1.0 : 1.0 + whitened(s, -m[0] / m[2], -m[1] / m[2]);
}

void leadr_direction(const leadr *s, const double k[3], double v[3])
{
	v[0] = k[0] * s->ax + k[1] * s->ay * s->rho;
	v[1] = k[1] * s->ay * sqrt(1.0 - s->rho * s->rho);
	v[2] = k[2] - k[0] * s->tx - k[1] * s->ty;
}

double leadr_sigma(const leadr *s, const double k[3])
{
	double v[3];
	leadr_direction(s, k, v);
	const double sine = hypot(v[0], v[1]), len = hypot(sine, v[2]);
	if (s->kind == LEADR_GGX)
		return v[2] >= 0.0 ? 0.5 * (v[2] + len) : 0.5 * sine * sine / (len - v[2]);
	if (sine == 0.0)
		return fmax(v[2], 0.0);
	const double cot = v[2] / sine;
	return 0.5 * (v[2] * erfc(-cot) + sine * exp(-cot * cot) / sqrt(PI));
}

double leadr_lambda(leadr_kind kind, const double v[3])
{
	const double tangent = hypot(v[0], v[1]) / v[2], a = 1.0 / tangent;
	if (kind == LEADR_GGX)
		return 0.5 * (sqrt(1.0 + tangent * tangent) - 1.0);
	return 0.5 * (erf(a) - 1.0) + exp(-a * a) / (2.0 * a * sqrt(PI));
}

double leadr_condition(const leadr *s)
{
	/* Eigenvalues of (ax^2, rho ax ay; rho ax ay, ay^2). */
	const double d = 0.5 * (s->ax * s->ax - s->ay * s->ay), c = s->rho * s->ax * s->ay;
	const double large = 0.5 * (s->ax * s->ax + s->ay * s->ay) + hypot(d, c);
	return large / (s->ax * s->ay * sqrt((1.0 - s->rho) * (1.0 + s->rho)));
}
