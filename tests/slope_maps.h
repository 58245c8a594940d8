/* slope_maps.h - maps of heights for tests of slopes.h, and distances between moments. */
#ifndef LOBE_TESTS_SLOPE_MAPS_H
#define LOBE_TESTS_SLOPE_MAPS_H

#include "lobe/lobe.h"

#include <stddef.h>

/* A map of heights f(i, j), or of zeros where f is NULL, with texels of width 1 that wrap. It takes the memory of the
 * map before, whose texels are gone. */
lobe_slope_map heights(size_t width, size_t height, double (*f)(double, double));

/* Its texels, for tests that read or spoil them; and for the end of a program. */
extern float *texels;
void heights_free(void);

/* Moments of a map that has some. */
lobe_slope_stats measure(lobe_slope_map map);

/* The largest distance of n numbers, infinite where one of a is none. */
double worst_of(const double *a, const double *b, int n);
double moments_differ(lobe_slope_moments a, lobe_slope_moments b);

/* mean x, y, variance x, y, covariance */
double central_differ(lobe_slope_stats s, double x, double y, double xx, double yy, double xy);

enum { WIDTH = 96, HEIGHT = 60 };
extern const int wave[3][2];
extern const double amplitude[3];

/* Three waves that fit a map of WIDTH x HEIGHT: wave[k] of them along x and y. */
double waves(double i, double j);

/* Random heights on a slope. */
double noise(double i, double j);

#endif
