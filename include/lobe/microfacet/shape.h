/* shape.h - the names of the distributions of microfacet normals, and the parameters of one chosen at run time. */
#ifndef LOBE_MICROFACET_SHAPE_H
#define LOBE_MICROFACET_SHAPE_H

#include "../core/table.h"

/* Numbers of distributions.def. */
enum {
#define LOBE_NDF_FIXED(NAME, name, number)  LOBE_NDF_##NAME = number,
#define LOBE_NDF_SHAPED(NAME, name, number) LOBE_NDF_##NAME = number,
#include "distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	LOBE_NDF_LIMIT = 256
};

/* ndf: LOBE_NDF_*. exponent: gamma of GTR and Student-T, n of Phong. width: GTR's alpha, which no stretch can stand
 * for. norm: prepared from them. table: profile.h, for distributions that need one. */
typedef struct {
	lobe_uint ndf;
	lobe_real exponent, width, norm;
	lobe_table table;
} lobe_distribution;

#endif
