/* approximations_shadow.c - errors of Beckmann's Lambda, of masking on a GGX surface, and of distributions from a
 * table. */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "approximations.h"
#include "csv.h"
#include "pi.h"
#include "support.h"
#include "textbook.h"

static const double alphas[] = {0.1, 0.3, 0.6, 1.0};
enum { ALPHAS = sizeof alphas / sizeof *alphas, SIDE = 64 };

static const int sides[2] = {SIDE / 2, SIDE};

static lobe_linear stretch(double a) { return lobe_linear_make((float)a, 0.0f, 0.0f, (float)a, 0.0f, 0.0f); }

static void run_loop(const approximations_way *way, const approximations_set *p, size_t n, const float *x,
		     const float *y, const float *z, const float *s, const float *t, float *r0, float *r1, float *r2)
{
	const float *const in[APPROXIMATIONS_IN] = {x, y, z, s, t};
	float *const out[APPROXIMATIONS_OUT] = {r0, r1, r2};
	way->scalar(p, n, in, out);
}

static float one(const approximations_way *way, const approximations_set *p, float x, float y, float z)
{
	float r = 0.0f;
	run_loop(way, p, 1, &x, &y, &z, &z, &z, &r, &r, &r);
	return r;
}

/* --- Lambda ------------------------------------------------------------------------------------------------------- */

/* 1/(1 + Lambda) of tangent r/z in the textbook's form, with erfc so that nothing cancels up to where it is 1. */
static double exact_g1(double r, double z)
{
	const double a = z / r;
	return 1.0 / (1.0 + 0.5 * (exp(-a * a) / (a * 1.77245385090551603) - erfc(a)));
}

static void lambda(int quick, report_rows *rows)
{
	const size_t samples = quick ? 20000u : 400000u;
	static const approximations_set p;
	for (size_t w = 0; w < approximations_way_count(); w++) {
		const approximations_way *way = &approximations_ways[w];
		approximations_error e = {0};
		if (way->group != GROUP_LAMBDA)
			continue;
		for (size_t i = 0; i < samples; i++) {
			/* cot theta/alpha from .01 to 10 */
			const float z = (float)(0.01 * pow(1000.0, ((double)i + 0.5) / (double)samples));
			const double got = (double)z / ((double)z + (double)one(way, &p, 1.0f, z, 0.0f));
			const double exact = exact_g1(1.0, (double)z);
			approximations_error_add(&e, got, exact, "cot/alpha %.3g", (double)z);
			if (i % 8 == 0)
				e.reference = fmax(e.reference, approximations_doubt_beckmann_g1(exact, (double)z));
		}
		for (int a = 0; a < ALBEDO_ALPHAS; a++)
			for (int m = 0; m < ALBEDO_COSINES; m++) {
				double off[2] = {0.0, 0.0};
				for (int level = 0; level < 2; level++) {
					albedo_nodes *nodes =
						albedo_nodes_make(LOBE_NDF_BECKMANN, NULL, albedo_alphas[a],
								  albedo_cosines[m], sides[level]);
					const double oz = (double)nodes->oz;
					const float or = fmaxf((float)albedo_alphas[a] * nodes->ox, 1e-10f);
					const double ho = (double)one(way, &p, or, nodes->oz, 0.0f);
					for (size_t i = 0; i < nodes->n; i++) {
						const double iz = (double)nodes->iz[i];
						const float ir = (float)albedo_alphas[a] *
								 sqrtf((1.0f - nodes->iz[i]) * (1.0f + nodes->iz[i]));
						const double hi =
							(double)one(way, &p, fmaxf(ir, 1e-10f), nodes->iz[i], 0.0f);
						const double g = iz / (oz * iz + ho * iz + hi * oz);
						off[level] += nodes->weight[i] * (g - nodes->smith[i]);
					}
					albedo_nodes_free(nodes);
				}
				approximations_error_albedo(&e, off[1], fabs(off[1] - off[0]) / 3.0, albedo_alphas[a],
							    albedo_cosines[m]);
			}
		approximations_error_row(rows, "lambda", way->name, "Beckmann", "G1; cot/alpha .01 to 10", &e);
	}
}

/* --- masking ------------------------------------------------------------------------------------------------------ */

/* Pairs of directions by equal steps of both cosines and the azimuth between; against Smith's height-correlated masking
 * or, across, the beta function, in double. */
static void masking(approximations_group group, double alpha, int quick, report_rows *rows)
{
	const int steps = quick ? 24 : 64;
	char of[32];
	approximations_set p;
	memset(&p, 0, sizeof p);
	p.surface = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), stretch(alpha));
	const double width = (double)p.surface.map.xx;
	for (size_t w = 0; w < approximations_way_count(); w++) {
		const approximations_way *way = &approximations_ways[w];
		approximations_error e = {0};
		if (way->group != group)
			continue;
		for (int i = 0; i < steps; i++)
			for (int k = 0; k < steps; k++)
				for (int f = 0; f < steps / 2; f++) {
					const double oz = (i + 0.5) / steps, iz = (k + 0.5) / steps;
					const double phi = PI * (f + 0.5) / (steps / 2);
					const double so = sqrt(1.0 - oz * oz), si = sqrt(1.0 - iz * iz);
					const double o[3] = {so, 0.0, oz}, in[3] = {si * cos(phi), si * sin(phi), iz};
					const double lo = textbook_ggx_lambda(width, width, o);
					const double li = textbook_ggx_lambda(width, width, in);
					const double exact = group == GROUP_ACROSS ? gsl_sf_beta(1.0 + lo, 1.0 + li)
										   : 1.0 / (1.0 + lo + li);
					const float x[5] = {(float)oz, (float)so, (float)iz, (float)in[0],
							    (float)in[1]};
					float r = 0.0f;
					run_loop(way, &p, 1, x, x + 1, x + 2, x + 3, x + 4, &r, &r, &r);
					approximations_error_add(&e, (double)r, exact, "cos %.3g %.3g; phi %.0f", oz,
								 iz, phi * 57.29577951);
					if (f == 0)
						e.reference = fmax(e.reference,
								   approximations_doubt_ggx_g2(exact, width, o, in,
											       group == GROUP_ACROSS));
				}
		for (int m = 0; m < ALBEDO_COSINES && group == GROUP_MASKING; m++) {
			double off[2] = {0.0, 0.0};
			for (int level = 0; level < 2; level++) {
				albedo_nodes *nodes =
					albedo_nodes_make(LOBE_NDF_GGX, NULL, alpha, albedo_cosines[m], sides[level]);
				for (size_t i = 0; i < nodes->n; i++) {
					float r = 0.0f;
					run_loop(way, &p, 1, &nodes->oz, &nodes->ox, nodes->iz + i, nodes->ix + i,
						 nodes->iy + i, &r, &r, &r);
					off[level] +=
						nodes->weight[i] * ((double)r / (double)nodes->oz - nodes->smith[i]);
				}
				albedo_nodes_free(nodes);
			}
			approximations_error_albedo(&e, off[1], fabs(off[1] - off[0]) / 3.0, alpha, albedo_cosines[m]);
		}
		snprintf(of, sizeof of, "alpha %g", alpha);
		approximations_error_row(rows, approximations_groups[group], way->name, of,
					 group == GROUP_MASKING ? "G2 of GGX; cos 0 to 1" : "G2 across GGX; cos 0 to 1",
					 &e);
	}
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

static double ggx_profile(void *context, double t)
{
	(void)context;
	return 1.0 / ((1.0 + t * t) * (1.0 + t * t));
}

static double beckmann_profile(void *context, double t)
{
	(void)context;
	return exp(-t * t);
}

/* x, y: points and weights of u.x and u.y. */
static double mean_facing(lobe_smith s, lobe_vec3 o, const double (*x)[2], const double (*y)[2], size_t n)
{
	double sum = 0.0;
	for (size_t i = 0; i < n; i++)
		for (size_t k = 0; k < n; k++) {
			const lobe_vec2 u = lobe_vec2_make((float)x[i][0], (float)y[k][0]);
			sum += x[i][1] * y[k][1] * (double)lobe_dot(o, lobe_smith_visible(s, o, u));
		}
	return sum;
}

/* The mean of o.m over visible normals of d, less that over ndf's own. By Gauss points of u = v^2 (3 - 2 v), which
 * crowd at both ends: there a distribution's tail is, and where facets turn away. GGX's own u.x is an azimuth: equal
 * steps. */
static double facing_off(lobe_distribution d, unsigned ndf, double alpha, double cosine, size_t n)
{
	double ends[2 * SIDE][2], turn[2 * SIDE][2];
	const lobe_smith tabled = lobe_smith_make(d, stretch(alpha));
	const lobe_smith own = lobe_smith_make(lobe_distribution_make(ndf), stretch(alpha));
	const lobe_vec3 o = lobe_vec3_make((float)sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0f, (float)cosine);
	gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(n);
	for (size_t i = 0; i < n; i++) {
		double v, weight;
		gsl_integration_glfixed_point(0.0, 1.0, i, &v, &weight, table);
		ends[i][0] = v * v * (3.0 - 2.0 * v);
		ends[i][1] = weight * 6.0 * v * (1.0 - v);
		turn[i][0] = ((double)i + 0.5) / (double)n;
		turn[i][1] = 1.0 / (double)n;
	}
	gsl_integration_glfixed_table_free(table);
	const double(*x)[2] = (const double(*)[2])(ndf == LOBE_NDF_GGX ? turn : ends);
	const double(*y)[2] = (const double(*)[2])ends;
	return mean_facing(tabled, o, y, y, n) - mean_facing(own, o, x, y, n);
}

static int tables(unsigned ndf, int quick, report_rows *rows)
{
	const char *const name = ndf == LOBE_NDF_GGX ? "GGX" : "Beckmann";
	const uint32_t samples = quick ? 20000u : 400000u;
	approximations_set p;
	approximations_error e[3] = {{.max = 0.0}, {.max = 0.0}, {.max = 0.0}};
	float *table = report_alloc(NULL, LOBE_PROFILE_WORDS * sizeof *table);
	memset(&p, 0, sizeof p);
	if (lobe_distribution_tabulated(&p.surface.distribution, table, LOBE_PROFILE_WORDS,
					ndf == LOBE_NDF_GGX ? ggx_profile : beckmann_profile, NULL) != LOBE_OK) {
		fprintf(stderr, "report: %s\n", lobe_error_message());
		free(table);
		return 1;
	}
	const lobe_distribution d = p.surface.distribution;
	for (uint32_t i = 0; i < samples; i++) {
		/* tan/alpha from .01 to 3 of a facet (D down to 1e-4 of its peak), cot/alpha from .01 to 3 of a
		 * direction: relative. */
		const double t = 0.01 * pow(300.0, ((double)i + 0.5) / (double)samples);
		const double x = (double)(float)t,
			     exact_d = ndf == LOBE_NDF_GGX ? ggx_profile(NULL, x) : beckmann_profile(NULL, x);
		const lobe_facet_density got = lobe_tabulated_density(d, lobe_vec3_make((float)x, 0.0f, 1.0f));
		approximations_error_add(&e[0], (double)got.inv * (double)got.inv * (double)got.factor / exact_d, 1.0,
					 "tan/alpha %.3g", x);
		const double exact_h =
			ndf == LOBE_NDF_GGX ? 0.5 / (sqrt(1.0 + x * x) + x) : x * (1.0 / exact_g1(1.0, x) - 1.0);
		approximations_error_add(
			&e[1], (double)lobe_tabulated_hidden(d, lobe_vec3_make(1.0f, 0.0f, (float)x)) / exact_h, 1.0,
			"cot/alpha %.3g", x);
		if (i % 8 == 0) {
			const int beckmann = ndf != LOBE_NDF_GGX;
			e[0].reference = fmax(e[0].reference, approximations_doubt_density(exact_d, beckmann, x));
			e[1].reference = fmax(e[1].reference, approximations_doubt_hidden(exact_h, beckmann, x));
		}
	}
	/* Albedo of the lobe with D and Lambda of the table. */
	for (int a = 0; a < ALBEDO_ALPHAS; a++)
		for (int m = 0; m < ALBEDO_COSINES; m++) {
			double all[2] = {0};
			for (int level = 0; level < 2; level++) {
				albedo_nodes *nodes =
					albedo_nodes_make(ndf, NULL, albedo_alphas[a], albedo_cosines[m], sides[level]);
				const lobe_smith exact =
					lobe_smith_make(lobe_distribution_make(ndf), stretch(albedo_alphas[a]));
				const lobe_smith tabled = lobe_smith_make(d, exact.map);
				const lobe_vec3 o = lobe_vec3_make(nodes->ox, 0.0f, nodes->oz);
				for (size_t i = 0; i < nodes->n; i++) {
					const lobe_vec3 h = lobe_vec3_make(nodes->hx[i], nodes->hy[i], nodes->hz[i]);
					const lobe_vec3 in = lobe_vec3_make(nodes->ix[i], nodes->iy[i], nodes->iz[i]);
					const double ratio =
						(double)lobe_smith_d(tabled, h) / (double)lobe_smith_d(exact, h);
					const double g = (double)lobe_smith_g2(tabled, o, in) / (double)o.z;
					all[level] += nodes->weight[i] * (ratio * g - nodes->smith[i]);
				}
				albedo_nodes_free(nodes);
			}
			approximations_error_albedo(&e[0], all[1], fabs(all[1] - all[0]) / 3.0, albedo_alphas[a],
						    albedo_cosines[m]);
			const double coarse = facing_off(d, ndf, albedo_alphas[a], albedo_cosines[m], SIDE);
			const double facing = facing_off(d, ndf, albedo_alphas[a], albedo_cosines[m], 2 * SIDE);
			approximations_error_add(&e[2], facing, 0.0, "alpha %g; cos %g", albedo_alphas[a],
						 albedo_cosines[m]);
			e[2].reference = fmax(e[2].reference, fabs(facing - coarse));
		}
	approximations_error_row(rows, "density", "table", name, "D; relative; tan/alpha .01 to 3", &e[0]);
	approximations_error_row(rows, "hidden", "table", name, "Lambda; relative; cot/alpha .01 to 3", &e[1]);
	approximations_error_row(rows, "visible", "table", name, "mean o.m of the visible normals", &e[2]);
	free(table);
	return 0;
}

static size_t units(void) { return 1 + 2 * ALPHAS + 2; }

static int run(int quick, size_t unit, report_rows *rows)
{
	if (unit == 0)
		lambda(quick, rows);
	else if (unit < 1 + ALPHAS)
		masking(GROUP_MASKING, alphas[unit - 1], quick, rows);
	else if (unit < 1 + 2 * ALPHAS)
		masking(GROUP_ACROSS, alphas[unit - 1 - ALPHAS], quick, rows);
	else
		return tables(unit == 1 + 2 * ALPHAS ? LOBE_NDF_GGX : LOBE_NDF_BECKMANN, quick, rows);
	return 0;
}

const approximations_part approximations_shadow = {units, run};
