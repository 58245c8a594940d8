#include "ggx_integral.h"

#include <gsl/gsl_integration.h>
#include <math.h>

/* A normal of the surface from one of the unit hemisphere that is stretched onto it, and the ratio of their solid
 * angles: m = M h/|M h| with M = diag(ax, ay, 1), dm/dh = det M/|M h|^3. However narrow D is, it is smooth in h. */
static lobe_vec3 stretched(lobe_stretch d, ggx_vector h, double *jacobian)
{
	const double ax = (double)d.alpha_x, ay = (double)d.alpha_y;
	const double x = ax * h.x, y = ay * h.y, len = sqrt(x * x + y * y + h.z * h.z);
	*jacobian = ax * ay / (len * len * len);
	return lobe_vec3_make((float)(x / len), (float)(y / len), (float)(h.z / len));
}

double ggx_weight_normal(lobe_vec3 w, lobe_vec3 m)
{
	(void)w;
	return (double)m.z;
}

double ggx_weight_visible(lobe_vec3 w, lobe_vec3 m)
{
	const double c = (double)w.x * (double)m.x + (double)w.y * (double)m.y + (double)w.z * (double)m.z;
	return c > 0.0 ? c : 0.0;
}

double ggx_integral_at(const ggx_integral *f, double z, double phi)
{
	const double s = sqrt((1.0 - z) * (1.0 + z));
	const ggx_vector h = {s * cos(phi), s * sin(phi), z};
	double jacobian;
	const lobe_vec3 m = stretched(f->d, h, &jacobian);
	return f->weight(f->w, m) * (double)stretched_ggx_d(f->d, m) * jacobian;
}

double ggx_integrate(const ggx_integral *f, double z0, double z1, double phi0, double phi1, size_t n)
{
	gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(n);
	double sum = 0.0;
	for (size_t i = 0; i < n; i++) {
		double z, z_weight;
		gsl_integration_glfixed_point(z0, z1, i, &z, &z_weight, rule);
		for (size_t j = 0; j < n; j++) {
			double phi, phi_weight;
			gsl_integration_glfixed_point(phi0, phi1, j, &phi, &phi_weight, rule);
			sum += z_weight * phi_weight * ggx_integral_at(f, z, phi);
		}
	}
	gsl_integration_glfixed_table_free(rule);
	return sum;
}
