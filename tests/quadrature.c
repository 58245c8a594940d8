#include "quadrature.h"

#include "support.h"
#include "textbook.h"

#include <math.h>

static double gauss(const quadrature *q, double x0, double x1, double y0, double y1)
{
	static const double node[4] = {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
				       0.86113631159405258};
	static const double weight[4] = {0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
					 0.34785484513745386};
	const double cx = 0.5 * (x0 + x1), hx = 0.5 * (x1 - x0);
	const double cy = 0.5 * (y0 + y1), hy = 0.5 * (y1 - y0);
	double sum = 0.0;
	for (int i = 0; i < 4; i++)
		for (int k = 0; k < 4; k++)
			sum += weight[i] * weight[k] * q->f(q->context, cx + hx * node[i], cy + hy * node[k]);
	return sum * hx * hy;
}

/* 1: f is positive all over the cell, -1: negative, 0: it may change sign there, which it is taken to where it comes
 * nearer to 0 than it varies. */
static int sign_over(quadrature_integrand f, void *context, double x0, double x1, double y0, double y1)
{
	double lo = HUGE_VAL, hi = -HUGE_VAL;
	if (!f)
		return 1;
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++) {
			const double e = f(context, x0 + 0.5 * i * (x1 - x0), y0 + 0.5 * k * (y1 - y0));
			lo = fmin(lo, e);
			hi = fmax(hi, e);
		}
	return lo > 0.5 * (hi - lo) ? 1 : hi < -0.5 * (hi - lo) ? -1 : 0;
}

static double refine(quadrature *q, double x0, double x1, double y0, double y1, double whole, int depth)
{
	const int side = sign_over(q->edge, q->context, x0, x1, y0, y1);
	if (side < 0)
		return 0.0;
	const int smooth = side > 0 && sign_over(q->kink, q->context, x0, x1, y0, y1) != 0;
	const double xm = 0.5 * (x0 + x1), ym = 0.5 * (y0 + y1);
	const double a = gauss(q, x0, xm, y0, ym), b = gauss(q, xm, x1, y0, ym);
	const double c = gauss(q, x0, xm, ym, y1), d = gauss(q, xm, x1, ym, y1);
	const double sum = a + b + c + d;
	const double change = fabs(sum - whole);
	if (depth == 0 || (smooth && change <= fmax(q->absolute, q->relative * fabs(sum)))) {
		q->error += change;
		return sum;
	}
	return refine(q, x0, xm, y0, ym, a, depth - 1) + refine(q, xm, x1, y0, ym, b, depth - 1) +
	       refine(q, x0, xm, ym, y1, c, depth - 1) + refine(q, xm, x1, ym, y1, d, depth - 1);
}

double quadrature_box(quadrature *q, double x0, double x1, double y0, double y1)
{
	return refine(q, x0, x1, y0, y1, gauss(q, x0, x1, y0, y1), q->depth);
}

direction_map map_make(map_kind kind, const double wo[3], double ax, double ay, double eta)
{
	direction_map m;
	m.kind = kind;
	m.side = wo[2] < 0.0 ? -1.0 : 1.0;
	for (int k = 0; k < 3; k++)
		m.o[k] = wo[k];
	m.o[2] *= m.side;
	textbook_normalize(m.o);
	m.ax = ax;
	m.ay = ay;
	m.e = m.side > 0.0 ? eta : 1.0 / eta;
	return m;
}

double map_facet(const direction_map *m, double x_in, double y, double facet[3])
{
	const double x = fmax(x_in, 1e-12);
	const double r = sqrt((1.0 - x) * (1.0 + x)) / x;
	facet[0] = m->ax * r * cos(TWO_PI * y);
	facet[1] = m->ay * r * sin(TWO_PI * y);
	facet[2] = 1.0;
	textbook_normalize(facet);
	/* dm = m.z^3 d(slopes), and the area of slopes is ax ay pi d(r^2) dy with r^2 = 1/x^2 - 1. */
	const double z_over_x = facet[2] / x;
	return TWO_PI * m->ax * m->ay * z_over_x * z_over_x * z_over_x;
}

/* Both of the functions below in one. */
static double map_point(const direction_map *m, double x, double y, double wi[3], double *edge)
{
	double facet[3];
	if (m->kind == MAP_SPHERE) {
		const double z = 2.0 * x - 1.0, s = sqrt((1.0 - z) * (1.0 + z));
		wi[0] = s * cos(TWO_PI * y);
		wi[1] = s * sin(TWO_PI * y);
		wi[2] = z;
		*edge = 1.0;
		return 4.0 * PI;
	}
	const double area = map_facet(m, x, y, facet);
	const double c = textbook_dot(m->o, facet);
	double jacobian;
	if (m->kind == MAP_REFLECT) {
		for (int k = 0; k < 3; k++)
			wi[k] = 2.0 * c * facet[k] - m->o[k];
		jacobian = 4.0 * c;
		*edge = fmin(c, wi[2]);
	} else {
		const double step2 = (m->e - 1.0) * (m->e + 1.0);
		const double g2 = c * c + step2;
		*edge = fmin(c, g2);
		if (*edge <= 0.0)
			return 0.0;
		const double g = sqrt(g2);
		const double step = step2 / (g + c); /* g - c = -(o.m + e i.m) */
		for (int k = 0; k < 3; k++)
			wi[k] = -(m->o[k] + step * facet[k]) / m->e;
		jacobian = step * step / (m->e * g);
		*edge = fmin(*edge, -wi[2]);
	}
	wi[2] *= m->side;
	return *edge > 0.0 ? area * jacobian : 0.0;
}

double map_direction(const direction_map *m, double x, double y, double wi[3])
{
	double edge;
	return map_point(m, x, y, wi, &edge);
}

double map_edge(const direction_map *m, double x, double y)
{
	double wi[3], edge;
	map_point(m, x, y, wi, &edge);
	return edge;
}

double map_kink(const direction_map *m, double x, double y)
{
	double facet[3];
	map_facet(m, x, y, facet);
	const double c = textbook_dot(m->o, facet);
	return c * c + (m->e - 1.0) * (m->e + 1.0);
}

void map_coordinates(const direction_map *m, const double wi[3], double *x, double *y)
{
	double h[3];
	if (m->kind == MAP_SPHERE) {
		*x = 0.5 + 0.5 * wi[2];
		*y = atan2(wi[1], wi[0]) / TWO_PI;
	} else {
		const double e = m->kind == MAP_REFLECT ? 1.0 : m->e;
		for (int k = 0; k < 3; k++)
			h[k] = m->o[k] + e * wi[k] * (k == 2 ? m->side : 1.0);
		/* Slopes; the sign of h falls out. */
		const double sx = h[0] / (m->ax * h[2]), sy = h[1] / (m->ay * h[2]);
		*x = 1.0 / sqrt(1.0 + sx * sx + sy * sy);
		*y = atan2(sy, sx) / TWO_PI;
	}
	if (*y < 0.0)
		*y += 1.0;
}
