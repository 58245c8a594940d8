/* field.h - random height fields whose slopes are prescribed. */
#ifndef HEIGHTFIELD_FIELD_H
#define HEIGHTFIELD_FIELD_H

#include <stdint.h>

/* What the slopes of a field shall be. floor 0: normally distributed, with variances alpha^2/2 and correlation rho.
 * floor > 0: of patches, each Gaussian, of all widths alpha/sqrt(E + floor), E exponentially distributed. A mixture
 * with floor = 0 would be GGX of width alpha; the floor cuts its tail where slopes exceed alpha/sqrt(floor). */
struct wanted {
	const char *name;
	double alpha_x, alpha_y, rho, mean_x, mean_y, floor;
};

/* The density P22 of slopes (x, y) of such a surface; and the mean of 1/(E + floor), by which variances exceed those of
 * the Gaussian with the same alpha (1 for floor 0). */
double wanted_p22(const struct wanted *w, double x, double y);
double wanted_spread(const struct wanted *w);

/* size x size heights in texels, row by row: repeating ones and the plane (mean_x, mean_y) on top, whose slopes repeat
 * and heights do not. */
struct field {
	int size;
	float *heights;
	double var_x, var_y, cov; /* what central differences should find: a little less than wanted */
};

/* size: a power of 2. 0, or -1 when out of memory. */
int field_make(struct field *field, const struct wanted *w, int size, uint32_t seed);
void field_free(struct field *field);

#endif
