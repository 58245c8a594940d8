/* strategies.c - the report's section on sampling strategies: what follows from the rows.
 *
 * Efficiency is 1/(variance cost), where the cost of a sample is either a direction, as where each costs a ray, or the time
 * that the comparison lobe takes for it with the light's lookup, one sample after another on one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "strategies.h"

enum { LIGHTS_MAX = 32, SAMPLES = 0, TIME = 1, MEASURES = 2 };

/* What ties: within 2 %, or the noise of the times where that is more. */
#define TIE 1.02

typedef struct {
	int material;
	size_t light, alpha, cosine; /* of the grids */
	double mean, variance[STRATEGIES_TECHNIQUES], error[STRATEGIES_TECHNIQUES];
} cell;

typedef struct {
	int quick;
	size_t count;
	cell *cell;
	/* Over the default's, by distribution and light; half its 95 % interval, relative. */
	double time[2][LIGHTS_MAX][STRATEGIES_TECHNIQUES], noise[2][LIGHTS_MAX][STRATEGIES_TECHNIQUES];
} map;

/* --- rows --------------------------------------------------------------------------------------------------------- */

static int technique_of(const char *name)
{
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
		if (strcmp(name, strategies_name(t)) == 0)
			return t;
	return -1;
}

static size_t light_of(const map *m, const char *name)
{
	const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
	for (size_t i = 0; i < strategies_lights(m->quick); i++) {
		const strategies_light light = strategies_light_at(i, up);
		if (strcmp(light.name, name) == 0)
			return i;
	}
	return 0;
}

static int material_of(const char *name)
{
	for (int m = 0; m < STRATEGIES_MATERIALS; m++)
		if (strcmp(name, strategies_material_name(m)) == 0)
			return m;
	return 0;
}

static void read_times(map *m, const report_table *t)
{
	for (size_t i = 0; i < report_table_rows(t); i++) {
		const int technique = technique_of(report_cell(t, i, "technique"));
		const int ndf = strategies_ndf(material_of(report_cell(t, i, "material")));
		const size_t light = light_of(m, report_cell(t, i, "light"));
		if (technique < 0)
			continue;
		const double ratio = report_number(t, i, "of_default");
		m->time[ndf][light][technique] = ratio;
		m->noise[ndf][light][technique] =
			0.5 * (report_number(t, i, "of_default_high") - report_number(t, i, "of_default_low")) / ratio;
	}
}

/* Rows are in the order of the units: material, light, alpha, cosine, technique. */
static void read_map(map *m, const report_table *t)
{
	const size_t alphas = strategies_alphas(m->quick), cosines = strategies_cosines(m->quick);
	m->count = report_table_rows(t) / STRATEGIES_TECHNIQUES;
	m->cell = calloc(m->count + 1, sizeof *m->cell);
	if (!m->cell) {
		fputs("report: out of memory\n", stderr);
		exit(1);
	}
	for (size_t i = 0, first = 0; i < m->count; i++) {
		cell *c = &m->cell[i];
		c->material = material_of(report_cell(t, i * STRATEGIES_TECHNIQUES, "material"));
		if (i && c->material != m->cell[i - 1].material)
			first = i;
		c->cosine = (i - first) % cosines;
		c->alpha = (i - first) / cosines % alphas;
		c->light = strategies_light_of(m->quick, c->material, (i - first) / cosines / alphas);
		c->mean = report_number(t, i * STRATEGIES_TECHNIQUES, "mean");
		for (int k = 0; k < STRATEGIES_TECHNIQUES; k++) {
			c->variance[k] = report_number(t, i * STRATEGIES_TECHNIQUES + (size_t)k, "variance");
			c->error[k] = report_number(t, i * STRATEGIES_TECHNIQUES + (size_t)k, "variance_error");
		}
	}
}

/* --- who wins ----------------------------------------------------------------------------------------------------- */

static double cost(const map *m, const cell *c, int technique, int measure)
{
	if (measure == SAMPLES)
		return technique >= STRATEGIES_BALANCE ? 2.0 : 1.0;
	return m->time[strategies_ndf(c->material)][c->light][technique];
}

/* What is minimal for the best. */
static double loss(const map *m, const cell *c, int technique, int measure)
{
	return fmax(c->variance[technique], 1e-300) * cost(m, c, technique, measure);
}

/* Light that does not reach the viewer: all techniques find 0. */
static int dark(const cell *c) { return !(c->mean > 1e-25); }

/* The first of VISIBLE, BOUNDED_CAP and the rest that is as good as the best. techniques: how many are looked at. */
static int winner(const map *m, const cell *c, int techniques, int measure)
{
	int best = LOBE_STRATEGY_VISIBLE;
	for (int k = 1; k < techniques; k++)
		if (loss(m, c, k, measure) < loss(m, c, best, measure))
			best = k;
	const double enough = TIE * loss(m, c, best, measure);
	if (loss(m, c, LOBE_STRATEGY_VISIBLE, measure) <= enough)
		return LOBE_STRATEGY_VISIBLE;
	return loss(m, c, LOBE_STRATEGY_BOUNDED_CAP, measure) <= enough ? LOBE_STRATEGY_BOUNDED_CAP : best;
}

/* k is at least as efficient as every other lobe-sampling strategy, or what it lacks is within the noise. */
static int unbeaten(const map *m, const cell *c, int k, int measure)
{
	const int ndf = strategies_ndf(c->material);
	for (int other = 0; other < STRATEGIES_LOBE; other++) {
		const double noise =
			measure == TIME ? m->noise[ndf][c->light][other] + m->noise[ndf][c->light][k] : 0.0;
		const double of_variance = 2.0 * hypot(c->error[k] / fmax(c->variance[k], 1e-300),
						       c->error[other] / fmax(c->variance[other], 1e-300));
		const double tie = fmax(TIE, 1.0 + fmin(noise + fmin(of_variance, 0.05), 0.25));
		if (loss(m, c, k, measure) > tie * loss(m, c, other, measure))
			return 0;
	}
	return 1;
}

/* Where the lobe is what to sample: no technique that asks the light is clearly better. */
static int lobes_turn(const map *m, const cell *c, int measure)
{
	return winner(m, c, STRATEGIES_TECHNIQUES, measure) < STRATEGIES_LOBE;
}

typedef struct {
	double all, turn, cells, turns; /* shares in percent, and of how many */
} share;

static share share_of(const map *m, int k, int measure)
{
	share s = {0, 0, 0, 0};
	for (size_t i = 0; i < m->count; i++) {
		const cell *c = &m->cell[i];
		if (dark(c))
			continue;
		const int good = unbeaten(m, c, k, measure), turn = lobes_turn(m, c, measure);
		s.cells++;
		s.turns += turn;
		s.all += good;
		s.turn += good && turn;
	}
	s.all *= 100.0 / fmax(s.cells, 1.0);
	s.turn *= 100.0 / fmax(s.turns, 1.0);
	return s;
}

static int ascending(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static double quantile(double *values, size_t n, double q)
{
	if (n == 0)
		return NAN;
	qsort(values, n, sizeof *values, ascending);
	return values[(size_t)(q * (double)(n - 1) + 0.5)];
}

/* --- the recommendation ------------------------------------------------------------------------------------------- */

static int technique_recommended(lobe_recommendation r)
{
	if (r.from == LOBE_SAMPLE_LIGHT)
		return STRATEGIES_LIGHT;
	if (r.from == LOBE_SAMPLE_BOTH_POWER)
		return STRATEGIES_POWER;
	if (r.from == LOBE_SAMPLE_BOTH_BALANCE)
		return r.strategy == LOBE_STRATEGY_BOUNDED_CAP ? STRATEGIES_BALANCE_BOUNDED : STRATEGIES_BALANCE;
	return (int)r.strategy;
}

/* Loss over the best's in every cell that is not dark, by analytic lights and by probes: NAN where it is of the other. */
typedef struct {
	double *of[2]; /* [cells] */
	size_t n[2];
	double *of_default; /* the default's loss over the recommended one's */
	size_t defaults;
} regrets;

static lobe_recommend_cost costs_of(const map *m, const cell *c, int measure)
{
	lobe_recommend_cost p = lobe_recommend_cost_samples();
	const double *time = m->time[strategies_ndf(c->material)][c->light];
	if (measure == SAMPLES)
		return p;
	for (int k = 0; k < STRATEGIES_LOBE; k++)
		p.lobe[k] = (float)time[k];
	p.light = (float)time[STRATEGIES_LIGHT];
	p.weighting = (float)(time[STRATEGIES_BALANCE] - time[LOBE_STRATEGY_VISIBLE] - time[STRATEGIES_LIGHT]);
	return p;
}

static void recommend(const map *m, int measure, regrets *r)
{
	r->n[0] = r->n[1] = r->defaults = 0;
	for (size_t i = 0; i < m->count; i++) {
		const cell *c = &m->cell[i];
		if (dark(c))
			continue;
		const strategies_case s = strategies_case_make(c->material, strategies_alpha(m->quick, c->alpha),
							       strategies_cosine(m->quick, c->cosine), c->light);
		const int t = technique_recommended(lobe_recommend_strategy(
			s.lobe[0].surface, s.wo, strategies_shape(&s.light), costs_of(m, c, measure)));
		double best = HUGE_VAL;
		for (int k = 0; k < STRATEGIES_TECHNIQUES; k++)
			best = fmin(best, loss(m, c, k, measure));
		const int probe = s.light.probe != NULL;
		r->of[probe][r->n[probe]++] = loss(m, c, t, measure) / best;
		r->of_default[r->defaults++] = loss(m, c, LOBE_STRATEGY_VISIBLE, measure) / loss(m, c, t, measure);
	}
}

static double within(const double *values, size_t n, double limit)
{
	double k = 0.0;
	for (size_t i = 0; i < n; i++)
		k += values[i] <= limit;
	return n ? 100.0 * k / (double)n : (double)NAN;
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

/* A block for each light: rows of cosines, columns of roughness; the winner's number. */
static void write_winners(const map *m, const char *file, int techniques, int measure)
{
	FILE *f = report_open(file);
	const size_t cosines = strategies_cosines(m->quick);
	for (size_t i = 0; i < m->count && m->cell[i].material == STRATEGIES_GGX; i++) {
		const cell *c = &m->cell[i];
		const size_t last = strategies_alphas(m->quick) * cosines - 1;
		const int w = dark(c) ? -1 : winner(m, c, techniques, measure);
		fprintf(f, "%zu %zu %d\n", c->alpha, c->cosine, w);
		if (c->alpha * cosines + c->cosine == last)
			fprintf(f, "\n\n");
	}
	fclose(f);
}

static void write_names(const map *m)
{
	FILE *f = report_open("strategies_names.gp");
	fprintf(f, "array NAMES[%d] = [", STRATEGIES_TECHNIQUES);
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
		fprintf(f, "%s\"%s\"", t ? ", " : "", strategies_name(t));
	fprintf(f, "]\narray LIGHTS[%zu] = [", strategies_lights(m->quick));
	for (size_t i = 0; i < strategies_lights(m->quick); i++) {
		const strategies_light light = strategies_light_at(i, lobe_vec3_make(0.0f, 0.0f, 1.0f));
		fprintf(f, "%s\"%s\"", i ? ", " : "", light.name);
	}
	fprintf(f, "]\nset xtics (");
	for (size_t i = 0; i < strategies_alphas(m->quick); i += m->quick ? 2 : 4)
		fprintf(f, "%s\"%g\" %zu", i ? ", " : "", strategies_alpha(m->quick, i), i);
	fprintf(f, ")\nset ytics (");
	for (size_t i = 0; i < strategies_cosines(m->quick); i++)
		fprintf(f, "%s\"%g\" %zu", i ? ", " : "", strategies_cosine(m->quick, i), i);
	fprintf(f, ")\nset xrange [-0.5:%g]\nset yrange [%g:-0.5]\n", (double)strategies_alphas(m->quick) - 0.5,
		(double)strategies_cosines(m->quick) - 0.5);
	fclose(f);
}

static void write_maps(report_page *page, const map *m)
{
	static const char *const what[2][MEASURES] = {{"strategies_best_samples", "strategies_best_time"},
						      {"strategies_lobe_samples", "strategies_lobe_time"}};
	static const char *const said[2][MEASURES] = {
		{"What wins, a direction costing the same whatever it was drawn from (both: two).",
		 "What wins in equal time of shading alone, by the scalar functions."},
		{"The best of the strategies that sample the lobe alone, for the same number of samples.",
		 "The best of the strategies that sample the lobe alone, in equal time of shading alone."}};
	char file[64], definitions[512];
	write_names(m);
	for (int lobe = 0; lobe < 2; lobe++)
		for (int measure = 0; measure < MEASURES; measure++) {
			snprintf(file, sizeof file, "%s.dat", what[lobe][measure]);
			write_winners(m, file, lobe ? STRATEGIES_LOBE : STRATEGIES_TECHNIQUES, measure);
			snprintf(definitions, sizeof definitions, "OUT='%s.png'; DATA='%s'; TITLE='%s'",
				 what[lobe][measure], file, said[lobe][measure]);
			report_gnuplot(page, "strategies_map.gp", definitions);
			snprintf(file, sizeof file, "%s.png", what[lobe][measure]);
			report_figure(page, file,
				      "%s Isotropic GGX, over roughness and view cosine, a panel for each light; "
				      "within 2 %% of "
				      "the best the default has it, then the bounded cap.",
				      said[lobe][measure]);
		}
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

/* The default's place under each light. */
static void write_lights(report_page *page, const map *m)
{
	report_text(
		page,
		"| light | sr | default unbeaten, same samples | same time | bounded cap, same samples | same time | "
		"wins most cells, of all techniques | default's loss to it, median "
		"|\n|---|---|---|---|---|---|---|---|\n");
	for (size_t l = 0; l < strategies_lights(m->quick); l++) {
		const strategies_light light = strategies_light_at(l, lobe_vec3_make(0.0f, 0.0f, 1.0f));
		double n = 0.0, good[2][MEASURES] = {{0, 0}, {0, 0}};
		size_t wins[STRATEGIES_TECHNIQUES] = {0}, most = 0;
		double *lost = calloc(m->count + 1, sizeof *lost);
		size_t losses = 0;
		if (!lost)
			exit(1);
		for (size_t i = 0; i < m->count; i++) {
			const cell *c = &m->cell[i];
			if (c->light != l || dark(c))
				continue;
			n++;
			const int w = winner(m, c, STRATEGIES_TECHNIQUES, SAMPLES);
			wins[w]++;
			lost[losses++] = loss(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES) / loss(m, c, w, SAMPLES);
			for (int measure = 0; measure < MEASURES; measure++) {
				good[0][measure] += unbeaten(m, c, LOBE_STRATEGY_VISIBLE, measure);
				good[1][measure] += unbeaten(m, c, LOBE_STRATEGY_BOUNDED_CAP, measure);
			}
		}
		for (size_t t = 0; t < STRATEGIES_TECHNIQUES; t++)
			most = wins[t] > wins[most] ? t : most;
		report_text(page, "| %s | %.2g | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %s, %.0f %% | %.3g |\n",
			    light.name, light.solid_angle, 100.0 * good[0][0] / n, 100.0 * good[0][1] / n,
			    100.0 * good[1][0] / n, 100.0 * good[1][1] / n, strategies_name((int)most),
			    100.0 * (double)wins[most] / n, quantile(lost, losses, 0.5));
		free(lost);
	}
}

static double batch_time(const report_table *t, const char *device, const char *material, const char *technique,
			 const char *column)
{
	for (size_t i = 0; i < report_table_rows(t); i++)
		if (strcmp(report_cell(t, i, "device"), device) == 0 &&
		    strcmp(report_cell(t, i, "material"), material) == 0 &&
		    strcmp(report_cell(t, i, "technique"), technique) == 0)
			return report_number(t, i, column);
	return NAN;
}

/* Median over the lights. */
static double scalar_time(const report_table *t, const char *material, const char *technique, const char *column)
{
	double values[LIGHTS_MAX];
	size_t n = 0;
	for (size_t i = 0; i < report_table_rows(t) && n < LIGHTS_MAX; i++)
		if (strcmp(report_cell(t, i, "material"), material) == 0 &&
		    strcmp(report_cell(t, i, "technique"), technique) == 0)
			values[n++] = report_number(t, i, column);
	return quantile(values, n, 0.5);
}

/* Of MIS in batches: a sample, and an evaluation with its pdf. */
static double composed(const report_table *batch, const char *device, const char *material, int technique)
{
	const char *visible = strategies_name(LOBE_STRATEGY_VISIBLE);
	if (technique < STRATEGIES_LOBE)
		return batch_time(batch, device, material, strategies_name(technique), "sample_ns");
	const double eval = batch_time(batch, device, material, visible, "eval_pdf_ns");
	if (technique == STRATEGIES_LIGHT)
		return eval;
	return eval + batch_time(batch, device, material,
				 technique == STRATEGIES_BALANCE_BOUNDED ? strategies_name(LOBE_STRATEGY_BOUNDED_CAP)
									 : visible,
				 "sample_ns");
}

static void write_times(report_page *page, const report_table *time, const report_table *batch)
{
	static const char *const devices[] = {"native:1", "native", "opencl"};
	report_text(
		page,
		"\nTime of a sample in ns. Scalar: an estimate by the C functions, the light's lookup or draw "
		"included, median over the lights. Batches: the lobe's part alone (from the light: eval and pdf), all "
		"processors for `native` and `opencl`. The production lobe is `ggx_conductor` or "
		"`beckmann_conductor`; everything else is the comparison lobe, which chooses at run time.\n\n"
		"| technique | GGX scalar | of default (95 %%) | native:1 | native | opencl | Beckmann scalar | "
		"native:1 | native | opencl |\n|---|---|---|---|---|---|---|---|---|---|\n");
	for (int t = -1; t < STRATEGIES_TECHNIQUES; t++) {
		const char *name = t < 0 ? "production lobe" : strategies_name(t);
		report_text(page, "| %s", name);
		for (int m = 0; m < 2; m++) {
			const char *material = strategies_material_name(m ? STRATEGIES_BECKMANN : STRATEGIES_GGX);
			report_text(page, " | %.0f", scalar_time(time, material, name, "ns"));
			if (m == 0)
				report_text(page, " | %.2f (%.2f - %.2f)",
					    scalar_time(time, material, name, "of_default"),
					    scalar_time(time, material, name, "of_default_low"),
					    scalar_time(time, material, name, "of_default_high"));
			for (size_t d = 0; d < 3; d++) {
				const double ns = t < 0 ? batch_time(batch, devices[d], material, name, "sample_ns")
							: composed(batch, devices[d], material, t);
				report_text(page, isnan(ns) ? " | -" : " | %.1f", ns);
			}
		}
		report_text(page, " |\n");
	}
}

/* --- curves ------------------------------------------------------------------------------------------------------- */

/* Errors of independent points against variance/n, where they can be told: enough samples that matter. */
typedef struct {
	double checked, agree, worst;
	double gain[256];
	size_t gains;
	double reference,
		quadrature; /* worst error of references over the least error reported; disagreement of the two */
} curves;

static curves check_curves(const report_table *t)
{
	curves r;
	memset(&r, 0, sizeof r);
	for (size_t i = 0; i < report_table_rows(t); i++) {
		const double rmse = report_number(t, i, "relative_rmse"),
			     predicted = report_number(t, i, "predicted_random");
		const double n = report_number(t, i, "samples"), repetitions = report_number(t, i, "repetitions");
		const double truth = report_number(t, i, "reference"), quadrature = report_number(t, i, "quadrature");
		const double error = report_number(t, i, "reference_error") / truth;
		const int random = strcmp(report_cell(t, i, "points"), "random") == 0;
		r.reference = fmax(r.reference, error / rmse);
		if (quadrature > 0.0)
			r.quadrature = fmax(r.quadrature, fabs(truth / quadrature - 1.0));
		/* A technique that finds the light once in k samples has variance k: at least 400 finds. */
		if (predicted * predicted * n * 400.0 > n * repetitions)
			continue;
		if (random) {
			const double off = fabs(rmse / predicted - 1.0) /
					   fmax(report_number(t, i, "relative_rmse_error") / rmse, 0.01);
			r.checked++;
			r.agree += off < 3.0;
			r.worst = fmax(r.worst, fabs(rmse / predicted - 1.0));
		} else if (n == 4096.0 && r.gains < 256) {
			r.gain[r.gains++] = predicted / rmse;
		}
	}
	return r;
}

/* Lines "time error" in blocks, one for each case, technique and kind of points; the first four cases. */
static void write_curves(report_page *page, const map *m, const report_table *t, const report_table *time)
{
	FILE *f = report_open("strategies_curves.dat"), *titles = report_open("strategies_titles.gp");
	const size_t block = 7, per_case = block * 2 * STRATEGIES_TECHNIQUES;
	const size_t cases = report_table_rows(t) / per_case < 4 ? report_table_rows(t) / per_case : 4;
	fprintf(titles, "array TITLES[4]\n");
	for (size_t k = 0; k < cases; k++) {
		const size_t first = k * per_case;
		const char *material = report_cell(t, first, "material"), *light = report_cell(t, first, "light");
		const int ndf = strategies_ndf(material_of(material));
		const size_t l = light_of(m, light);
		double ns = 100.0;
		for (size_t i = 0; i < report_table_rows(time); i++)
			if (strcmp(report_cell(time, i, "light"), light) == 0 &&
			    strcmp(report_cell(time, i, "technique"), strategies_name(LOBE_STRATEGY_VISIBLE)) == 0 &&
			    strategies_ndf(material_of(report_cell(time, i, "material"))) == ndf)
				ns = report_number(time, i, "ns");
		fprintf(titles, "TITLES[%zu] = \"%s alpha %s, cos %s: %s\"\n", k + 1, material,
			report_cell(t, first, "alpha"), report_cell(t, first, "cosine"), light);
		for (size_t i = first; i < first + per_case; i++) {
			const int technique = technique_of(report_cell(t, i, "technique"));
			const int random = strcmp(report_cell(t, i, "points"), "random") == 0;
			/* By the exact variance: repetitions of a technique that hardly ever finds the light tell nothing. */
			fprintf(f, "%.6g %.6g\n",
				1e-3 * ns * m->time[ndf][l][technique] * report_number(t, i, "samples"),
				report_number(t, i, random ? "predicted_random" : "relative_rmse"));
			if ((i - first) % block == block - 1)
				fprintf(f, "\n\n");
		}
	}
	fclose(f);
	fclose(titles);
	report_gnuplot(page, "strategies_curves.gp", NULL);
	report_figure(page, "strategies_curves.png",
		      "Relative error against time, one thread, scalar functions. Lines: Owen-scrambled Sobol points, "
		      "measured "
		      "over repetitions at 1, 4, 16 ... 4096 samples; dotted: independent points, by the exact "
		      "variance; grey: "
		      "slope -1/2. Strategies of one density differ by their time alone.");
}

/* --- the section -------------------------------------------------------------------------------------------------- */

static void write_shares(report_page *page, const map *m)
{
	const share v[MEASURES] = {share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES),
				   share_of(m, LOBE_STRATEGY_VISIBLE, TIME)};
	const share b[MEASURES] = {share_of(m, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES),
				   share_of(m, LOBE_STRATEGY_BOUNDED_CAP, TIME)};
	double gain[2] = {0, 0}, worst = 0.0;
	double *ratio = calloc(m->count + 1, sizeof *ratio);
	size_t n = 0, better = 0;
	if (!ratio)
		exit(1);
	for (size_t i = 0; i < m->count; i++) {
		const cell *c = &m->cell[i];
		if (dark(c) || !lobes_turn(m, c, SAMPLES))
			continue;
		ratio[n] = loss(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES) / loss(m, c, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES);
		worst = fmax(worst, 1.0 / ratio[n]);
		better += ratio[n] > TIE;
		n++;
	}
	gain[0] = quantile(ratio, n, 0.5);
	gain[1] = quantile(ratio, n, 0.95);
	report_text(page,
		    "\n**The default among the strategies that sample the lobe.** Of %.0f cells in which light reaches "
		    "the viewer, "
		    "visible normals are unbeaten in %.0f %% for the same number of samples and in %.0f %% in the same "
		    "time "
		    "(2 %%, or the measured noise, counts as a tie); the bounded cap in %.0f %% and %.0f %%. Where a "
		    "light is "
		    "small and off the highlight every lobe-sampling strategy finds it by accident, and a wide one "
		    "least seldom: "
		    "there none of them should be used alone. In the %.0f cells where the lobe's turn it is - no "
		    "technique that "
		    "asks the light is clearly better - visible normals are unbeaten in %.0f %% (same samples) and the "
		    "bounded cap "
		    "in %.0f %%.\n\n",
		    v[0].cells, v[0].all, v[1].all, b[0].all, b[1].all, v[0].turns, v[0].turn, b[0].turn);
	report_finding(page,
		       "Among strategies that sample the lobe alone, visible normals (the default) are unbeaten in "
		       "%.0f %% of the "
		       "(roughness, angle, light) map for the same samples and %.0f %% in the same time, %s; the "
		       "bounded cap in "
		       "%.0f %% and %.0f %%. Where sampling the lobe is right at all: %.0f %% and %.0f %%",
		       v[0].all, v[1].all, v[0].all >= 90.0 && v[1].all >= 90.0 ? "which meets 90 %" : "short of 90 %",
		       b[0].all, b[1].all, v[0].turn, b[0].turn);
	if (n)
		report_finding(
			page,
			"For reflection prefer `LOBE_STRATEGY_BOUNDED_CAP` to the default wherever the lobe alone is "
			"sampled: variance is lower by more than 2 %% in %.0f %% of those cells, %.2f times at the "
			"median and "
			"%.1f times at the 95th percentile; at worst it is %.2f times higher",
			100.0 * (double)better / (double)n, gain[0], gain[1], worst);
	free(ratio);
}

static void write_recommendation(report_page *page, const map *m)
{
	regrets r;
	double *room = calloc(3 * (m->count + 1), sizeof *room);
	double right[MEASURES][2], tenth[2] = {0, 0}, all[MEASURES], median = 0.0, upper = 0.0;
	if (!room)
		exit(1);
	r.of[0] = room;
	r.of[1] = room + m->count + 1;
	r.of_default = room + 2 * (m->count + 1);
	for (int measure = MEASURES - 1; measure >= 0; measure--) {
		recommend(m, measure, &r);
		for (int probe = 0; probe < 2; probe++)
			right[measure][probe] = within(r.of[probe], r.n[probe], 1.05);
		all[measure] =
			((double)r.n[0] * right[measure][0] + (r.n[1] ? (double)r.n[1] * right[measure][1] : 0.0)) /
			(double)(r.n[0] + r.n[1]);
	}
	for (int probe = 0; probe < 2; probe++)
		tenth[probe] = within(r.of[probe], r.n[probe], 2.0);
	median = quantile(r.of_default, r.defaults, 0.5);
	upper = quantile(r.of_default, r.defaults, 0.9);
	report_text(page,
		    "**`lobe_recommend_strategy`** (lobe/recommend.h), told the light's shape, is within 5 %% of the "
		    "best technique "
		    "of all in %.1f %% of the cells of analytic lights",
		    right[SAMPLES][0]);
	if (r.n[1])
		report_text(page, " and in %.1f %% of those of probes, of which it knows a fitted disk and a sky",
			    right[SAMPLES][1]);
	report_text(
		page,
		" (same samples; %.1f %% of all cells; told measured times instead, in the same time, %.1f %%), and "
		"within a factor of 2 in %.1f %%",
		all[SAMPLES], all[TIME], tenth[0]);
	if (r.n[1])
		report_text(page, " and %.1f %%", tenth[1]);
	report_text(
		page,
		". Against always sampling visible normals alone it needs %.3g times fewer samples at the median, %.3g "
		"times at the 90th percentile.\n\n",
		median, upper);
	report_finding(
		page,
		"`lobe_recommend_strategy` names a technique within 5 %% of the best of all 14 in %.1f %% of the cells "
		"(analytic lights %.1f %%%s); it saves a factor of %.3g in samples over the default alone at the "
		"median",
		all[SAMPLES], right[SAMPLES][0],
		r.n[1] ? "; probes less, being described by a fitted disk and sky" : "; no probes here", median);
	free(room);
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	static map m;
	const report_table *time = tables[1], *batch = tables[2], *lines = tables[3];
	m.quick = quick;
	read_times(&m, time);
	read_map(&m, tables[0]);
	report_text(
		page,
		"Gold with GGX, with GGX four times as wide along x (viewer 30 degrees off the brushing), and with "
		"Beckmann; what is estimated is the luminance that reaches the viewer. Variances are integrals, not "
		"samples of the technique in question, so that the map has no noise but that of the times. *In the "
		"highlight*: the light's middle is the mirror image of the viewer; *aside*: 50 degrees from the normal "
		"and "
		"75 in azimuth from the viewer. sr: the solid angle of a uniform light as concentrated. %s\n\n",
		strategies_probes_said());
	write_lights(page, &m);
	write_shares(page, &m);
	write_recommendation(page, &m);
	write_maps(page, &m);
	write_curves(page, &m, lines, time);
	curves c = check_curves(lines);
	const double gain = quantile(c.gain, c.gains, 0.5);
	report_text(
		page,
		"That independent points err by sqrt(variance/n) was verified by repetition where at least 400 samples "
		"matter: %.0f of %.0f errors agree within 3 standard deviations. References are known to %.2g of the "
		"least "
		"error reported beside them at worst, and quadrature of the textbook's formula in double precision "
		"agrees "
		"with them to %.1g. Scrambled points err %.2g times less than independent ones at 4096 samples (median "
		"over "
		"cases and techniques).\n\n",
		c.agree, c.checked, c.reference, c.quadrature, gain);
	report_finding(
		page,
		"Owen-scrambled Sobol points err %.2g times less than independent ones at 4096 samples (median), which "
		"is worth more than the choice among ways to the same visible normals",
		gain);
	write_times(page, time, batch);
	const double slow = batch_time(batch, "native:1", "GGX", strategies_name(LOBE_STRATEGY_VISIBLE), "sample_ns");
	const double fast = batch_time(batch, "native:1", "GGX", "production lobe", "sample_ns");
	if (fast > 0.0)
		report_finding(page,
			       "Choosing at run time costs: a batch samples `ggx_conductor` in %.1f ns and the same "
			       "strategy of the "
			       "comparison lobe in %.0f ns (one thread), so a strategy that is to be used belongs into "
			       "a lobe of its "
			       "own",
			       fast, slow);
	strategies_write_pictures(page, tables[4], tables[5]);
	free(m.cell);
}

const report_section strategies_section = {
	"strategies",
	"Sampling strategies: error against time",
	{&strategies_map_study, &strategies_time_study, &strategies_batch_study, &strategies_curves_study,
	 &strategies_reference_study, &strategies_pictures_study},
	write,
};
