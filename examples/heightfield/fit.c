/* fit.c - see fit.h. */
#include "fit.h"

#include <stdlib.h>

const char *const fit_name[FITS] = {"Beckmann", "GGX, moments", "GGX, median"};

static int ascending(const void *a, const void *b)
{
	const float x = *(const float *)a, y = *(const float *)b;
	return (x > y) - (x < y);
}

int fit_all(struct fits *fits, const lobe_slope_stats *stats, const lobe_slope_moments *slopes, size_t count)
{
	const lobe_linear map = lobe_slope_linear(*stats);
	const lobe_distribution ggx = lobe_distribution_make(LOBE_NDF_GGX);
	float *steepness = malloc(count * sizeof *steepness);
	if (!steepness)
		return -1;
	/* Facets as they would be on the surface of width 1: tan^2 of each. */
	for (size_t i = 0; i < count; i++) {
		const lobe_vec3 h = lobe_vec3_make((float)-slopes[i].x, (float)-slopes[i].y, 1.0f);
		const lobe_vec3 n = lobe_linear_facet(map, h);
		steepness[i] = n.x * n.x + n.y * n.y;
	}
	qsort(steepness, count, sizeof *steepness, ascending);
	/* Of GGX of width alpha half the area is steeper than tan = alpha. */
	const float alpha = lobe_sqrt(steepness[count / 2]);
	free(steepness);
	fits->surface[FIT_BECKMANN] = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_BECKMANN), map);
	fits->surface[FIT_GGX] = lobe_microsurface_make(ggx, map);
	fits->surface[FIT_GGX_MEDIAN] =
		lobe_microsurface_make(ggx, lobe_linear_compose(map, lobe_linear_stretch(alpha, alpha)));
	return 0;
}
