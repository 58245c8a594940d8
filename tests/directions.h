/* directions.h - test directions as the library takes them: rounded from double, and three numbers as a vector. */
#ifndef LOBE_TESTS_DIRECTIONS_H
#define LOBE_TESTS_DIRECTIONS_H

#include <math.h>

#include "lobe/core/vec.h"
#include "support.h"

static inline lobe_vec3 vec3(const float v[3]) { return lobe_vec3_make(v[0], v[1], v[2]); }

static inline lobe_vec3 rounded(const double v[3]) { return lobe_vec3_make((float)v[0], (float)v[1], (float)v[2]); }

/* The direction whose cosine to the normal is z, at azimuth phi. */
static inline lobe_vec3 direction_at(double z, double phi)
{
	const double s = sqrt((1.0 - z) * (1.0 + z));
	return lobe_vec3_make((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
}

/* The direction of length `length` whose cotangent to the normal is c. */
static inline lobe_vec3 at_cotangent(double c, double phi, double length)
{
	const double s = length / sqrt(1.0 + c * c);
	return lobe_vec3_make((float)(s * cos(phi)), (float)(s * sin(phi)), (float)(c * s));
}

/* test_direction as a vector. */
static inline lobe_vec3 random_direction(uint32_t stream, uint64_t i)
{
	float w[3];
	test_direction(stream, i, w);
	return vec3(w);
}

#endif
