/* shape.h - the parameters of a distribution of microfacet normals that is chosen at run time. */
#ifndef LOBE_MICROFACET_SHAPE_H
#define LOBE_MICROFACET_SHAPE_H

#include "../core/table.h"

/* ndf: LOBE_NDF_* (distribution.h). exponent: gamma of GTR and Student-T, n of Phong. width: GTR's alpha, which no
 * stretch can stand for. norm: prepared from them. table: profile.h, for distributions that need one. */
typedef struct {
	lobe_uint ndf;
	lobe_real exponent, width, norm;
	lobe_table table;
} lobe_distribution;

#endif
