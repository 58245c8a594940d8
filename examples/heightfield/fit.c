/* fit.c - see fit.h. */
#include "fit.h"

#include <stdlib.h>
#include <string.h>

const char *const fit_name[FITS] = {"Beckmann", "GGX, moments", "GGX, median"};

/* LOBE_NDF_* of a name; what is in no list has no facets, and shades to 0. */
static lobe_uint distribution_named(const char *name)
{
	static const struct {
		lobe_uint ndf;
		const char *name;
	} list[] = {
#define LOBE_NDF_FIXED(NAME, name, number)  {number, #name},
#define LOBE_NDF_SHAPED(NAME, name, number) {number, #name},
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	};
	for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
		if (!strcmp(list[i].name, name))
			return list[i].ndf;
	return LOBE_NDF_LIMIT;
}

static int ascending(const void *a, const void *b)
{
	const float x = *(const float *)a, y = *(const float *)b;
	return (x > y) - (x < y);
}

int fit_all(struct fits *fits, const lobe_slope_stats *stats, const lobe_slope_moments *slopes, size_t count)
{
	const lobe_linear map = lobe_slope_linear(*stats);
	const lobe_distribution ggx = lobe_distribution_make(distribution_named("ggx"));
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
	fits->surface[FIT_BECKMANN] = lobe_smith_make(lobe_distribution_make(distribution_named("beckmann")), map);
	fits->surface[FIT_GGX] = lobe_smith_make(ggx, map);
	fits->surface[FIT_GGX_MEDIAN] =
		lobe_smith_make(ggx, lobe_linear_compose(map, lobe_linear_stretch(alpha, alpha)));
	return 0;
}
