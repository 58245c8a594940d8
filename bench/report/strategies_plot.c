/* strategies_plot.c - maps of winners, and error against time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "strategies_rank.h"

/* --- figures ------------------------------------------------------------------------------------------------------ */

/* A block for each light: rows of cosines, columns of roughness; the winner's number. */
static void write_winners(const rank_map *m, const char *file, int techniques, int measure)
{
	FILE *f = report_open(file);
	const size_t cosines = strategies_cosines(m->quick);
	for (size_t i = 0; i < m->count && m->cell[i].material == STRATEGIES_GGX; i++) {
		const rank_cell *c = &m->cell[i];
		const size_t last = strategies_alphas(m->quick) * cosines - 1;
		const int w = rank_dark(c) ? -1 : rank_winner(m, c, techniques, measure);
		fprintf(f, "%zu %zu %d\n", c->alpha, c->cosine, w);
		if (c->alpha * cosines + c->cosine == last)
			fprintf(f, "\n\n");
	}
	fclose(f);
}

static void write_names(const rank_map *m)
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

void strategies_write_maps(report_page *page, const rank_map *m)
{
	static const char *const what[2][RAY] = {{"strategies_best_samples", "strategies_best_time"},
						 {"strategies_lobe_samples", "strategies_lobe_time"}};
	static const char *const said[2][RAY] = {
		{"What wins, a direction costing the same whatever it was drawn from (both: two).",
		 "What wins in equal time of shading alone, by the scalar functions."},
		{"The best of the strategies that do not know the light, for the same number of samples.",
		 "The best of the strategies that do not know the light, in equal time of shading alone."}};
	char file[64], definitions[512];
	write_names(m);
	for (int lobe = 0; lobe < 2; lobe++)
		for (int measure = 0; measure < RAY; measure++) {
			snprintf(file, sizeof file, "%s.dat", what[lobe][measure]);
			write_winners(m, file, lobe ? STRATEGIES_LOBE : STRATEGIES_TECHNIQUES, measure);
			snprintf(definitions, sizeof definitions, "OUT='%s.png'; DATA='%s'; TITLE='%s'",
				 what[lobe][measure], file, said[lobe][measure]);
			report_gnuplot(page, "strategies_map.gp", definitions);
			snprintf(file, sizeof file, "%s.png", what[lobe][measure]);
			report_figure(page, file,
				      "%s Isotropic GGX, over roughness and view cosine, a panel for each light; "
				      "within 2 %% of "
				      "the best the default, the bounded cap, has it, then visible normals.",
				      said[lobe][measure]);
		}
}

/* --- curves ------------------------------------------------------------------------------------------------------- */

/* An error is reported where the reference is known ten times better. */
static int reported(const report_table *t, size_t i)
{
	const double error = report_number(t, i, "reference_error") / report_number(t, i, "reference");
	return report_number(t, i, "relative_rmse") >= 10.0 * error;
}

enum { ERRORS_MAX = 4096 };

/* Errors of independent points off sqrt(variance/n), where that can be told; how much less scrambled points err. */
typedef struct {
	double off[ERRORS_MAX], gain[ERRORS_MAX];
	size_t offs, gains, unreported, rows;
	double quadrature; /* disagreement of the two references */
} curves;

static void check_curves(const report_table *t, curves *r)
{
	memset(r, 0, sizeof *r);
	r->rows = report_table_rows(t);
	for (size_t i = 0; i < r->rows; i++) {
		const double rmse = report_number(t, i, "relative_rmse");
		const double predicted = report_number(t, i, "predicted_random");
		const double n = report_number(t, i, "samples"), repetitions = report_number(t, i, "repetitions");
		const double truth = report_number(t, i, "reference"), quadrature = report_number(t, i, "quadrature");
		if (quadrature > 0.0)
			r->quadrature = fmax(r->quadrature, fabs(truth / quadrature - 1.0));
		if (!reported(t, i)) {
			r->unreported++;
			continue;
		}
		/* A technique that finds the light once in k samples has variance k: 400 finds are asked for. */
		if (predicted * predicted * 400.0 > repetitions || r->offs == ERRORS_MAX)
			continue;
		if (strcmp(report_cell(t, i, "points"), "random") == 0)
			r->off[r->offs++] = fabs(rmse / predicted - 1.0);
		else if (n == 4096.0)
			r->gain[r->gains++] = predicted / rmse;
	}
}

/* Lines "time error" in blocks, one for each case, technique and kind of points; the first four cases. */
static void write_lines(report_page *page, const rank_map *m, const report_table *t)
{
	FILE *f = report_open("strategies_curves.dat"), *titles = report_open("strategies_titles.gp");
	const size_t block = 7, per_case = block * 2 * STRATEGIES_TECHNIQUES;
	const size_t cases = report_table_rows(t) / per_case < 4 ? report_table_rows(t) / per_case : 4;
	fprintf(titles, "array TITLES[4]\n");
	for (size_t k = 0; k < cases; k++) {
		const size_t first = k * per_case;
		const char *material = report_cell(t, first, "material"), *light = report_cell(t, first, "light");
		const int ndf = strategies_ndf(rank_material(material));
		const size_t l = rank_light(m, light);
		fprintf(titles, "TITLES[%zu] = \"%s alpha %s, cos %s: %s\"\n", k + 1, material,
			report_cell(t, first, "alpha"), report_cell(t, first, "cosine"), light);
		for (size_t i = first; i < first + per_case; i++) {
			const int technique = rank_technique(report_cell(t, i, "technique"));
			const int random = strcmp(report_cell(t, i, "points"), "random") == 0;
			/* By the exact variance: repetitions of a technique that hardly ever finds the light tell
			 * nothing. */
			fprintf(f, "%.6g %.6g\n", 1e-3 * m->time[ndf][l][technique] * report_number(t, i, "samples"),
				!random && !reported(t, i)
					? (double)NAN
					: report_number(t, i, random ? "predicted_random" : "relative_rmse"));
			if ((i - first) % block == block - 1)
				fprintf(f, "\n\n");
		}
	}
	fclose(f);
	fclose(titles);
	report_gnuplot(page, "strategies_curves.gp", NULL);
	report_readme(
		page,
		"Relative error against time of every way to sample a rough metal, the lights, and both together:\n\n"
		"![](doc/strategies_curves.png)\n\n");
	report_figure(page, "strategies_curves.png",
		      "Relative error against time, one thread, scalar functions. Lines: Owen-scrambled Sobol points, "
		      "measured "
		      "over repetitions at 1, 4, 16 ... 4096 samples; dotted: independent points, by the exact "
		      "variance; grey: "
		      "slope -1/2. A line far below its dotted one: no repetition has found the sun. Strategies of one "
		      "density differ by their time alone.");
}

void strategies_write_curves(report_page *page, const rank_map *m, const report_table *t)
{
	static curves c;
	write_lines(page, m, t);
	check_curves(t, &c);
	const double gain = rank_quantile(c.gain, c.gains, 0.5);
	report_text(
		page,
		"That independent points err by sqrt(variance/n) was verified by repetition wherever 400 samples that "
		"matter are to be expected: of %zu errors half are within %.1f %% of it and nine tenths within %.1f "
		"%%. "
		"Of %zu errors %zu are left out because the reference is not known ten times better; quadrature of the "
		"textbook's formula in double precision agrees with the references to %.1g. Scrambled points err %.2g "
		"times "
		"less than independent ones at 4096 samples (median over cases and techniques).\n\n",
		c.offs, 100.0 * rank_quantile(c.off, c.offs, 0.5), 100.0 * rank_quantile(c.off, c.offs, 0.9), c.rows,
		c.unreported, c.quadrature, gain);
	report_finding(
		page,
		"Owen-scrambled Sobol points err %.2g times less than independent ones at 4096 samples (median over "
		"cases and techniques; 10 %% of them gain no more than %.2g times, and 10 %% %.2g times and more)",
		gain, rank_quantile(c.gain, c.gains, 0.1), rank_quantile(c.gain, c.gains, 0.9));
}
