/* microsurface_cases.h - microsurfaces chosen at run time, and integrals over their facets, for tests of masking and
 * of strategies. */
#ifndef LOBE_TESTS_MICROSURFACE_CASES_H
#define LOBE_TESTS_MICROSURFACE_CASES_H

#include "directions.h"
#include "distribution_tables.h"
#include "lobe/shading.h"
#include "quadrature.h"

#include <math.h>

/* A distribution of every number in distributions.def that this build has. */
typedef struct {
	const char *name;
	uint32_t ndf;
	double exponent, width;
} shape_case;

static const shape_case shapes[] = {
	{"GGX", LOBE_NDF_GGX, 0, 1},
	{"Beckmann", LOBE_NDF_BECKMANN, 0, 1},
	{"Phong 20", LOBE_NDF_PHONG, 20, 1},
	{"GTR 1.5 .3", LOBE_NDF_GTR, 1.5, 0.3},
	{"GTR 3 .5", LOBE_NDF_GTR, 3, 0.5},
	{"Student-T 1.8", LOBE_NDF_STUDENT_T, 1.8, 1},
	{"Student-T 4", LOBE_NDF_STUDENT_T, 4, 1},
	{"exponential", LOBE_NDF_TABULATED, 0, 1},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static inline lobe_distribution shape_make(const shape_case *c)
{
	const distribution_table t = distribution_table_of(c->ndf, c->exponent, c->width);
	lobe_distribution d = lobe_distribution_make(c->ndf);
	d.exponent = (lobe_real)c->exponent;
	d.width = (lobe_real)c->width;
	d.norm = (lobe_real)t.norm;
	d.table = lobe_table_at(t.table);
	return d;
}

static inline lobe_linear stretch(double ax, double ay)
{
	return lobe_linear_make((float)ax, 0.0f, 0.0f, (float)ay, 0.0f, 0.0f);
}

static inline lobe_microsurface ggx(double alpha)
{
	return lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), stretch(alpha, alpha));
}

/* (x, y) of the unit square as the facet of the mapped surface whose slopes are those of the GGX surface of the same
 * width: mean + A like r (cos, sin)(2 pi y), r = sqrt(1/x^6 - 1), which is smooth where a tail is long. Unit; returns
 * its solid angle per area of the square. */
static inline double surface_facet(const lobe_microsurface *s, double x_in, double y, double m[3])
{
	const double root = fmax(x_in, 1e-4), x = root * root * root, like = (double)s->like;
	const double r = like * sqrt((1.0 - x) * (1.0 + x)) / x;
	const double u = r * cos(TWO_PI * y), v = r * sin(TWO_PI * y);
	const double sx = (double)s->map.xx * u + (double)s->map.xy * v - (double)s->map.mean_x;
	const double sy = (double)s->map.yx * u + (double)s->map.yy * v - (double)s->map.mean_y;
	const double z = 1.0 / sqrt(1.0 + sx * sx + sy * sy);
	const double det = fabs((double)s->map.xx * (double)s->map.yy - (double)s->map.xy * (double)s->map.yx);
	m[0] = sx * z;
	m[1] = sy * z;
	m[2] = z;
	return 3.0 * root * root * TWO_PI * like * like * det * z * z * z / (x * x * x);
}

/* D(m) [1/sr] */
static inline double surface_d(const lobe_microsurface *s, const double m[3])
{
	const lobe_vec3 h = lobe_vec3_make((float)m[0], (float)m[1], (float)m[2]);
	const lobe_facet_density d = lobe_distribution_density(s->distribution, lobe_linear_facet(s->map, h));
	return (double)s->map.norm * (double)d.inv * (double)d.inv * (double)d.factor;
}

static inline double integrate_square(quadrature *q, int side)
{
	double sum = 0.0;
	for (int i = 0; i < side; i++)
		for (int k = 0; k < side; k++)
			sum += quadrature_box(q, (double)i / side, (i + 1.0) / side, (double)k / side,
					      (k + 1.0) / side);
	return sum;
}

#endif
