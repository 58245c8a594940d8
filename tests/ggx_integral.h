/* ggx_integral.h - integrals of the GGX distribution over normals, in coordinates in which it is flat. */
#ifndef LOBE_TESTS_GGX_INTEGRAL_H
#define LOBE_TESTS_GGX_INTEGRAL_H

#include <stddef.h>

#include "stretched_ggx.h"

typedef struct {
	double x, y, z;
} ggx_vector;

/* What is integrated: D(m) times cos of m and w. */
typedef struct {
	lobe_stretch d;
	lobe_vec3 w;
	double (*weight)(lobe_vec3 w, lobe_vec3 m);
} ggx_integral;

double ggx_weight_normal(lobe_vec3 w, lobe_vec3 m);
double ggx_weight_visible(lobe_vec3 w, lobe_vec3 m);

/* At a normal h of the unit hemisphere that is stretched onto the surface, given by its height and azimuth; and over
 * z0..z1 and phi0..phi1 of h, n Gauss points each way. */
double ggx_integral_at(const ggx_integral *f, double z, double phi);
double ggx_integrate(const ggx_integral *f, double z0, double z1, double phi0, double phi1, size_t n);

#endif
