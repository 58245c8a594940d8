/* fit.h - microsurfaces from the slopes of a height field. */
#ifndef HEIGHTFIELD_FIT_H
#define HEIGHTFIELD_FIT_H

#include "lobe/lobe.h"
#include "lobe/microfacet/smith.h"

enum { FIT_BECKMANN, FIT_GGX, FIT_GGX_MEDIAN, FITS };

extern const char *const fit_name[FITS];

struct fits {
	lobe_smith surface[FITS];
};

/* From the statistics, and for the last one the texels too: a GGX surface whose moments do not matter, as those of GGX
 * are infinite, but of which half the area is flatter than what half of the field is. 0, or -1 when out of memory. */
int fit_all(struct fits *fits, const lobe_slope_stats *stats, const lobe_slope_moments *slopes, size_t count);

#endif
