/* warp_points.h - points of the unit square, and heights of caps, that tests of core/warp.h go through. */
#ifndef LOBE_TESTS_WARP_POINTS_H
#define LOBE_TESTS_WARP_POINTS_H

#include <math.h>
#include <stdint.h>

#include "lobe/core/warp.h"

#define U     0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */
#define CASES 500000u

/* Half angles from a thousandth of a degree to the whole sphere. */
enum { HEIGHTS = 6 };
extern const float cap_heights[HEIGHTS];

/* Number i of a list that begins with all pairs of corners, goes on along the edges, and ends in random points. */
lobe_vec2 point(uint64_t i);

/* Of a point of the disk. */
static inline double radius(lobe_vec2 d) { return sqrt((double)d.x * (double)d.x + (double)d.y * (double)d.y); }

#endif
