/* strategies_reference.c - what the techniques should find, in two ways that share nothing but the light: many points
 * of the power heuristic, and quadrature of the textbook's formula in double precision. */
#include <math.h>

#include "pi.h"
#include "quadrature.h"
#include "random.h"
#include "strategies.h"
#include "textbook.h"

double strategies_reference(const strategies_case *c, uint32_t n, uint32_t runs, uint32_t seed, double *error)
{
	const strategies_compiled *const only = strategies_compiled_for(c);
	double sum = 0.0, squares = 0.0;
	for (uint32_t run = 0; run < runs; run++) {
		double of_run = 0.0;
		for (uint32_t i = 0; i < n; i++) {
			const struct random_key key = {seed, run, i, 0};
			float u[3], v[3];
			random_spread(key, RANDOM_LOBE, u);
			random_spread(key, RANDOM_LIGHT, v);
			of_run += (double)only->estimate[STRATEGIES_POWER](c, u, v);
		}
		sum += of_run / n;
		squares += of_run / n * (of_run / n);
	}
	const double mean = sum / runs;
	*error = sqrt(fmax(squares / runs - mean * mean, 0.0) / (runs - 1.0));
	return mean;
}

/* --- quadrature --------------------------------------------------------------------------------------------------- */

typedef struct {
	const strategies_case *c;
	strategies_light light; /* a part alone */
	direction_map map;
	double ax, ay, wo[3];
} integrand;

static double seen(const integrand *g, const double wi[3])
{
	static const double weight[3] = {0.2126, 0.7152, 0.0722};
	const lobe_fresnel_model f = g->c->lobe[0].fresnel;
	const double n[3] = {(double)f.a.r, (double)f.a.g, (double)f.a.b},
		     k[3] = {(double)f.b.r, (double)f.b.g, (double)f.b.b};
	const textbook_ndf ndf = strategies_ndf(g->c->material) ? TEXTBOOK_BECKMANN : TEXTBOOK_GGX;
	double sum = 0.0;
	if (!(wi[2] > 0.0))
		return 0.0;
	for (int i = 0; i < 3; i++)
		sum += weight[i] * textbook_rough_metal(ndf, g->ax, g->ay, n[i], k[i], g->wo, wi);
	return sum;
}

/* Of a light without edges: over the facets. */
static double over_facets(void *context, double x, double y)
{
	const integrand *g = context;
	double wi[3];
	float pdf;
	const double area = map_direction(&g->map, x, y, wi);
	if (!(area > 0.0))
		return 0.0;
	strategies_radiance(&g->light, lobe_vec3_make((float)wi[0], (float)wi[1], (float)wi[2]), &pdf);
	return area * (double)pdf * seen(g, wi);
}

static double edge_facets(void *context, double x, double y)
{
	return map_edge(&((const integrand *)context)->map, x, y);
}

/* Of a disk: over the disk, in 1 - cos and azimuth; x squared, for narrow lobes are in its middle. */
static void in_disk(const integrand *g, double x, double y, double wi[3])
{
	const strategies_part *p = &g->light.part[0];
	const double h = (double)p->a * x * x, r = sqrt(h * (2.0 - h)), z = 1.0 - h;
	const double cx = r * cos(2.0 * PI * y), cy = r * sin(2.0 * PI * y);
	wi[0] = cx * (double)p->frame.t.x + cy * (double)p->frame.b.x + z * (double)p->frame.n.x;
	wi[1] = cx * (double)p->frame.t.y + cy * (double)p->frame.b.y + z * (double)p->frame.n.y;
	wi[2] = cx * (double)p->frame.t.z + cy * (double)p->frame.b.z + z * (double)p->frame.n.z;
	textbook_normalize(wi);
}

static double over_disk(void *context, double x, double y)
{
	const integrand *g = context;
	double wi[3];
	in_disk(g, x, y, wi);
	return 2.0 * x * (double)g->light.part[0].share * seen(g, wi);
}

static double edge_disk(void *context, double x, double y)
{
	double wi[3];
	in_disk(context, x, y, wi);
	return wi[2];
}

double strategies_quadrature(const strategies_case *c, double *error)
{
	double sum = 0.0;
	integrand g;
	*error = 0.0;
	if (c->light.probe)
		return 0.0;
	g.c = c;
	g.ax = (double)(float)c->alpha;
	g.ay = c->material == STRATEGIES_BRUSHED ? (double)(0.25f * (float)c->alpha) : g.ax;
	g.wo[0] = (double)c->wo.x;
	g.wo[1] = (double)c->wo.y;
	g.wo[2] = (double)c->wo.z;
	textbook_normalize(g.wo);
	g.map = map_make(MAP_REFLECT, g.wo, g.ax, g.ay, 1.0);
	for (int i = 0; i < c->light.parts; i++) {
		g.light = c->light;
		g.light.parts = 1;
		g.light.part[0] = c->light.part[i];
		const int disk = g.light.part[0].kind == STRATEGIES_CONE;
		quadrature q = {
			disk ? over_disk : over_facets, disk ? edge_disk : edge_facets, NULL, &g, 0.0, 1e-6, 9, 0.0};
		/* A first look, so that what hardly counts is not refined. */
		q.depth = 5;
		const double rough = quadrature_box(&q, 0.0, 1.0, 0.0, 1.0);
		q.absolute = 1e-8 * rough;
		q.depth = 9;
		q.error = 0.0;
		for (int y = 0; y < 4; y++)
			for (int x = 0; x < 4; x++)
				sum += quadrature_box(&q, 0.25 * x, 0.25 * (x + 1), 0.25 * y, 0.25 * (y + 1));
		*error += q.error;
	}
	return sum;
}
