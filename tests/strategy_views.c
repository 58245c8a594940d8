#include "strategy_views.h"

#include "textbook.h"

const char *const strategy_names[STRATEGIES] = {"visible",   "uniform", "cosine",  "ndf",      "slopes",
						"ellipsoid", "cap",     "bounded", "v-cavity", "hemisphere"};

lobe_microsurface surface(int k)
{
	static const shape_case beside_ggx[] = {{"Beckmann", LOBE_NDF_BECKMANN, 0, 1},
						{"GTR 1.5 .3", LOBE_NDF_GTR, 1.5, 0.3}};
	const lobe_linear maps[] = {
		stretch(0.05, 0.05),
		stretch(0.5, 0.5),
		stretch(1, 1),
		stretch(0.1, 0.6),
		lobe_linear_make(0.4f, 0.2f, -0.1f, 0.3f, 0.0f, 0.0f),
		lobe_linear_make(0.4f, 0.1f, 0.05f, 0.3f, 0.5f, -0.3f),
		stretch(0.4, 0.3),
		lobe_linear_make(0.8f, 0.3f, 0.1f, 0.7f, 0.1f, 0.2f),
	};
	const lobe_distribution d = k < 6 ? lobe_distribution_make(LOBE_NDF_GGX) : shape_make(&beside_ggx[k - 6]);
	return lobe_microsurface_make(d, maps[k]);
}

lobe_microfacet_conductor mirror(lobe_microsurface s, lobe_uint strategy)
{
	const lobe_rgb white = lobe_rgb_make(1.0f, 1.0f, 1.0f);
	return lobe_microfacet_conductor_make(s, lobe_fresnel_model_constant(white), strategy);
}

view make_view(lobe_microsurface s, lobe_uint strategy, double z, double phi)
{
	view v;
	v.p = v.compared = mirror(s, strategy);
	v.wo = direction_at(z, phi);
	v.o[0] = (double)v.wo.x;
	v.o[1] = (double)v.wo.y;
	v.o[2] = (double)v.wo.z;
	textbook_normalize(v.o);
	return v;
}

lobe_vec3 reflected(const view *v, const double m[3])
{
	const double c = 2.0 * textbook_dot(v->o, m);
	return lobe_vec3_make((float)(c * m[0] - v->o[0]), (float)(c * m[1] - v->o[1]), (float)(c * m[2] - v->o[2]));
}

double view_edge(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	surface_facet(&v->p.surface, x, y, m);
	const double c = textbook_dot(v->o, m);
	return fmin(c, 2.0 * c * m[2] - v->o[2]);
}
