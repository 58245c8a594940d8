/* double_distributions.c - compiled with -DLOBE_DOUBLE=1, as double.c is. */
#include "double_distributions.h"

#include "lobe/shading.h"

#if !LOBE_DOUBLE
#error "compile tests/double_distributions.c with -DLOBE_DOUBLE=1"
#endif

static lobe_distribution made(double_distribution d)
{
	lobe_distribution r;
	r.ndf = d.ndf;
	r.exponent = d.exponent;
	r.width = d.width;
	r.norm = d.norm;
	r.table = lobe_table_at((lobe_uint64)(uintptr_t)d.table);
	return r;
}

double double_distribution_density(double_distribution d, const double h[3])
{
	const lobe_facet_density f = lobe_distribution_density(made(d), lobe_vec3_make(h[0], h[1], h[2]));
	return f.inv * f.inv * f.factor;
}

double double_distribution_hidden(double_distribution d, const double v[3])
{
	return lobe_distribution_hidden(made(d), lobe_vec3_make(v[0], v[1], v[2]));
}

double double_distribution_tail(double_distribution d, double t2) { return lobe_distribution_tail(made(d), t2); }

double double_distribution_tail_inverse(double_distribution d, double q)
{
	return lobe_distribution_tail_inverse(made(d), q);
}

void double_distribution_visible(double_distribution d, const double v[3], const double u[2], double m[3])
{
	const lobe_vec3 r =
		lobe_distribution_visible(made(d), lobe_vec3_make(v[0], v[1], v[2]), lobe_vec2_make(u[0], u[1]));
	m[0] = r.x;
	m[1] = r.y;
	m[2] = r.z;
}
