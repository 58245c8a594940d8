/* slopes.h - statistics of slopes measured on a height field or a normal map (C only): what a microsurface must have to
 * look like the surface from afar.
 *
 *	lobe_slope_map map = {.kind = LOBE_SLOPES_HEIGHT, .texels = heights, .width = 512, .height = 512,
 *			      .texel_x = 0.01, .texel_y = 0.01, .edge = LOBE_EDGE_WRAP};
 *	lobe_slope_stats stats;
 *	if (lobe_slope_stats_measure(&stats, &map) == LOBE_OK)
 *		surface = lobe_slope_linear(stats);
 *
 * The five moments are those of LEAN mapping (Olano and Baker 2010, "LEAN mapping"): they are means, so that averaging
 * those of parts of a surface gives those of the whole. Dupuy et al. 2013 ("Linear efficient antialiased displacement
 * and reflectance mapping") make the microsurface of linear.h from them. Sums are taken in double.
 *
 * Every call returns a lobe_status; one that fails leaves its outputs as they were, and lobe_error_message() names the
 * argument, or the texel that is no number. */
#ifndef LOBE_SLOPES_H
#define LOBE_SLOPES_H

#include "batch.h"
#include "microfacet/linear.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Means over an area, of slopes (x, y) = dz/dx, dz/dy: E[x], E[y], E[x^2], E[y^2], E[xy]. */
typedef struct {
	double x, y, xx, yy, xy;
} lobe_slope_moments;

/* The moments, and those about the mean, which are not computed as differences of them. */
typedef struct {
	lobe_slope_moments moments;
	double mean_x, mean_y, var_x, var_y, cov;
} lobe_slope_stats;

/* What the texels are: heights, one float a texel; or normals in tangent space, three floats a texel, of any length and
 * with z > 0, as they are (-1 to 1) or as a picture stores them (n/2 + 1/2, so that 0 is at 0.5; 8 bits have no such
 * value, and 128/255 for 0 is a slope of 0.004). */
typedef enum { LOBE_SLOPES_HEIGHT, LOBE_SLOPES_NORMAL, LOBE_SLOPES_NORMAL_PICTURE } lobe_slope_kind;

/* Heights at the edges. Wrap: the map repeats. Clamp: it ends, and the slope at its edge is that of the last two
 * texels. (Repeating the last texel, as textures clamp, would halve the slope there.) */
typedef enum { LOBE_EDGE_WRAP, LOBE_EDGE_CLAMP } lobe_slope_edge;

/* x grows along a row, y from row to row; with flip_y from the last row to the first. So for a picture whose top row
 * comes first and a bitangent that points up: flip_y for heights; and flip_y for normals whose y (green) points down.
 *
 * Heights: the slope at a texel is the central difference of its two neighbours. That is exact for planes, and scales
 * the slope of a wave with k radians a texel by sin(k)/k: 1 - k^2/6, less than 1 % off for waves longer than 26 texels,
 * 0 for those of 2. Measure heights that are sampled finely enough, or filter before they are sampled. */
typedef struct {
	lobe_slope_kind kind;
	const float *texels;
	size_t width, height;
	size_t stride;           /* floats from a row to the next; 0: rows follow each other */
	double texel_x, texel_y; /* for heights: distance of neighbours, in the unit of the heights */
	lobe_slope_edge edge;    /* for heights */
	int flip_y;
} lobe_slope_map;

/* Of the whole map. Two passes: about the mean, nothing is lost however steep the mean is. */
LOBE_API lobe_status lobe_slope_stats_measure(lobe_slope_stats *stats, const lobe_slope_map *map);

/* --- pyramid ---------------------------------------------------------------------------------------------------- */

/* Level 0 has the map's size, each next one half of it, rounded down but at least 1, down to 1 x 1. Levels follow each
 * other in one array, rows without gaps. Texels cover equal areas of the map, and the moments of one are the means over
 * its area: where a side is odd, texels of the finer level are split between their two parents by area. Thus the last
 * level is the mean of the first, whatever the size. */

/* Levels of a pyramid; 0 for an empty map. */
LOBE_API size_t lobe_slope_levels(size_t width, size_t height);

/* Where a level begins in the array, and its size; level lobe_slope_levels(): the end, that is, how many elements the
 * array needs (about 4/3 of the map's texels, of 40 bytes). Sizes may be NULL. */
LOBE_API lobe_status lobe_slope_level(size_t *offset, size_t *level_width, size_t *level_height, size_t width,
				      size_t height, size_t level);

/* Writes all levels to pyramid[0..count), memory of the caller's. When texels fail, what was written is unspecified. */
LOBE_API lobe_status lobe_slope_pyramid(lobe_slope_moments *pyramid, size_t count, const lobe_slope_map *map);

/* --- moments ---------------------------------------------------------------------------------------------------- */

/* Of bumps factor times as high: slopes scale by it, squares by its square. */
LOBE_API lobe_slope_moments lobe_slope_scale(lobe_slope_moments m, double factor);

/* Of two independent layers of bumps on each other, whose slopes add: E[(a + b)^2] = E[a^2] + E[b^2] + 2 E[a] E[b]. */
LOBE_API lobe_slope_moments lobe_slope_add(lobe_slope_moments a, lobe_slope_moments b);

/* Of a material's own roughness, a layer below all measured ones: a Beckmann surface of these widths. */
LOBE_API lobe_slope_moments lobe_slope_roughness(double alpha_x, double alpha_y);

/* Variances from means of squares, each less the square of the mean: what is left has lost (mean/deviation)^2 units of
 * the last place. A variance that comes out negative is 0. */
LOBE_API lobe_slope_stats lobe_slope_central(lobe_slope_moments m);

/* The microsurface with these moments: alpha^2 = 2 Var, as lobe_linear_from_moments tells. */
LOBE_API lobe_linear lobe_slope_linear(lobe_slope_stats stats);

#ifdef __cplusplus
}
#endif

#endif
