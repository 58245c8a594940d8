/* strategies_curves.c - error against the number of samples, of telling cases, with independent and with Owen-scrambled
 * points, over many repetitions.
 *
 * A repetition takes 4096 samples and looks at the mean after 1, 4, 16 ... of them: any such beginning of the scrambled
 * sequence is itself one. The error is the root of the mean square over repetitions; its own standard deviation comes
 * from the spread of the squares. */
#include <math.h>
#include <stdio.h>

#include "random.h"
#include "strategies.h"

enum { COUNTS = 7, LAST = 4096, RANDOM_FIRST = 16 /* uses beyond those of random.h */ };

/* light < 0: the probe from the end of the list, or the sky with sun where there is none. */
typedef struct {
	int material, light;
	double alpha, cosine;
} telling;

/* The first four make the figure; the others are in the CSV. */
static const telling cases[] = {
	{STRATEGIES_GGX, 6, 0.1, 0.7},      {STRATEGIES_GGX, 9, 0.5, 0.3},      {STRATEGIES_GGX, 2, 0.1, 0.5},
	{STRATEGIES_BRUSHED, -1, 0.2, 0.5}, {STRATEGIES_GGX, 0, 0.003, 0.7},    {STRATEGIES_GGX, 1, 0.3, 0.5},
	{STRATEGIES_GGX, 10, 1.0, 0.9},     {STRATEGIES_GGX, 8, 0.05, 0.1},     {STRATEGIES_GGX, 4, 0.3, 0.05},
	{STRATEGIES_BECKMANN, 9, 0.4, 0.3}, {STRATEGIES_BECKMANN, 2, 0.1, 0.7}, {STRATEGIES_GGX, -1, 0.03, 0.7},
};

static size_t units(int quick) { return quick ? 4 : sizeof cases / sizeof *cases; }

static void point(int spread, uint32_t technique, uint32_t repetition, uint32_t i, float u[3], float v[3])
{
	const struct random_key key = {11, repetition, i, technique};
	if (spread) {
		random_spread(key, RANDOM_LOBE, u);
		random_spread(key, RANDOM_LIGHT, v);
		return;
	}
	for (uint32_t k = 0; k < 3; k++) {
		u[k] = random_plain(key, RANDOM_FIRST + k);
		v[k] = random_plain(key, RANDOM_FIRST + 3 + k);
	}
}

typedef struct {
	double truth, error, quadrature, quadrature_error;
} references;

static void run_technique(int quick, const strategies_case *c, int technique, double variance, const references *r,
			  report_rows *rows)
{
	const uint32_t repetitions = quick ? 96 : 256;
	const strategies_compiled *const only = strategies_compiled_for(c);
	for (int spread = 0; spread < 2; spread++) {
		double sum[COUNTS] = {0}, square[COUNTS] = {0}, fourth[COUNTS] = {0};
		for (uint32_t k = 0; k < repetitions; k++) {
			double total = 0.0;
			uint32_t next = 1;
			int at = 0;
			for (uint32_t i = 0; i < LAST; i++) {
				float u[3], v[3];
				point(spread, (uint32_t)technique, k, i, u, v);
				total += (double)only->estimate[technique](c, u, v);
				if (i + 1 < next)
					continue;
				const double off = total / next - r->truth;
				sum[at] += off;
				square[at] += off * off;
				fourth[at] += off * off * off * off;
				next *= 4;
				at++;
			}
		}
		for (int k = 0; k < COUNTS; k++) {
			const double n = repetitions, mse = square[k] / n;
			const double mse_error = sqrt(fmax(fourth[k] / n - mse * mse, 0.0) / n);
			report_row(rows, "%s,%s,%g,%g,%s,%s,%d,%u,%.6g,%.3g,%.4g,%.6g,%.8g,%.2g,%.8g,%.2g",
				   strategies_material_name(c->material), c->light.name, c->alpha, c->cosine,
				   strategies_name(technique), spread ? "sobol" : "random", 1 << 2 * k, repetitions,
				   sqrt(mse) / r->truth, 0.5 * mse_error / sqrt(mse) / r->truth, sum[k] / n / r->truth,
				   sqrt(variance / (1 << 2 * k)) / r->truth, r->truth, r->error, r->quadrature,
				   r->quadrature_error);
		}
	}
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const telling *t = &cases[unit];
	const size_t lights = strategies_lights(quick), analytic = strategies_analytic_lights();
	const size_t light = t->light >= 0 ? (size_t)t->light : lights > analytic ? lights - 1 : 6;
	const strategies_case c = strategies_case_make(t->material, t->alpha, t->cosine, light);
	const strategies_moments m = strategies_moments_of(&c, quick ? 4096 : 16384, 8, 2);
	references r;
	r.truth = strategies_reference(&c, quick ? 1u << 17 : 1u << 19, 16, 3, &r.error);
	r.quadrature = strategies_quadrature(&c, &r.quadrature_error);
	for (int technique = 0; technique < STRATEGIES_TECHNIQUES; technique++)
		run_technique(quick, &c, technique, m.variance[technique], &r, rows);
	return 0;
}

const report_study strategies_curves_study = {
	"strategies_curves",
	"material,light,alpha,cosine,technique,points,samples,repetitions,relative_rmse,relative_rmse_error,relative_"
	"bias,"
	"predicted_random,reference,reference_error,quadrature,quadrature_error",
	0,
	units,
	run,
	strategies_settings,
};
