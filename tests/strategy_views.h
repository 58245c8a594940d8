/* strategy_views.h - white metals of any surface and sampling strategy seen from one direction, for tests of strategies
 * by quadrature over their facets (microsurface_cases.h). */
#ifndef LOBE_TESTS_STRATEGY_VIEWS_H
#define LOBE_TESTS_STRATEGY_VIEWS_H

#include "microsurface_cases.h"

enum { STRATEGIES = LOBE_STRATEGY_LAST + 1 };
extern const char *const strategy_names[STRATEGIES];

/* Surface k: GGX's from narrow to wide, stretched, skewed and tilted, and two of other distributions. */
enum { SURFACES = 8 };
lobe_microsurface surface(int k);

lobe_microfacet_conductor mirror(lobe_microsurface s, lobe_uint strategy);

/* p from wo, which is o in double and unit. compared: whose density samples of p are compared with; p itself, until a
 * test plants another. */
typedef struct {
	lobe_microfacet_conductor p, compared;
	lobe_vec3 wo;
	double o[3];
} view;

view make_view(lobe_microsurface s, lobe_uint strategy, double z, double phi);

/* wo reflected by the facet m. */
lobe_vec3 reflected(const view *v, const double m[3]);

/* For integrals over the square in SIDE x SIDE boxes: negative at facets that reflect nothing to the upper side. */
enum { SIDE = 12 };
double view_edge(void *context, double x, double y);

#endif
