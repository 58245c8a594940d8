/* strategies.c - the report's section on sampling strategies: tables and findings from the rows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "strategies_rank.h"

/* --- times ---------------------------------------------------------------------------------------------------------- */

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
	return rank_quantile(values, n, 0.5);
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
		"`beckmann_conductor`; everything else is the comparison lobe: the scalar functions and `opencl` "
		"compiled for "
		"that strategy and distribution alone, as a production lobe of it would be, `native` choosing at run "
		"time.\n\n"
		"| technique | GGX scalar | of default (range) | native:1 | native | opencl | Beckmann scalar | "
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

/* --- the section -------------------------------------------------------------------------------------------------- */

static void write_recommendation(report_page *page, const rank_map *m)
{
	rank_regrets r;
	double *room = calloc(3 * (m->count + 1), sizeof *room);
	double right[MEASURES][2], tenth[2] = {0, 0}, all[MEASURES], median = 0.0, upper = 0.0;
	if (!room)
		exit(1);
	r.of[0] = room;
	r.of[1] = room + m->count + 1;
	r.of_default = room + 2 * (m->count + 1);
	for (int measure = MEASURES - 1; measure >= 0; measure--) {
		rank_recommend(m, measure, &r);
		for (int probe = 0; probe < 2; probe++)
			right[measure][probe] = rank_within(r.of[probe], r.n[probe], 1.05);
		all[measure] =
			((double)r.n[0] * right[measure][0] + (r.n[1] ? (double)r.n[1] * right[measure][1] : 0.0)) /
			(double)(r.n[0] + r.n[1]);
	}
	for (int probe = 0; probe < 2; probe++)
		tenth[probe] = rank_within(r.of[probe], r.n[probe], 2.0);
	const double unbeaten = 100.0 * (double)r.unbeaten / (double)(r.n[0] + r.n[1]);
	median = rank_quantile(r.of_default, r.defaults, 0.5);
	upper = rank_quantile(r.of_default, r.defaults, 0.9);
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
	report_text(page,
		    ". It is at least as efficient as each of the ten strategies that know nothing of the light, with "
		    "the same "
		    "ties, in %.1f %% of all cells. Against always sampling visible normals alone it needs %.3g times "
		    "fewer "
		    "samples at the median, %.3g times at the 90th percentile.\n\n",
		    unbeaten, median, upper);
	char probes[64] = "; no probes here";
	if (r.n[1])
		snprintf(probes, sizeof probes, ", probes %.1f %%", right[SAMPLES][1]);
	report_finding(
		page,
		"`lobe_recommend_strategy` names a technique within 5 %% of the best of all 14 in %.1f %% of the cells "
		"(analytic lights %.1f %%%s), and is at least as efficient as every strategy that knows nothing of the "
		"light in %.1f %%; it saves a factor of %.3g in samples over the default alone at the "
		"median",
		all[SAMPLES], right[SAMPLES][0], probes, unbeaten, median);
	free(room);
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	static rank_map m;
	const report_table *time = tables[1], *batch = tables[2], *lines = tables[3];
	rank_read(&m, quick, tables[0], time);
	report_text(
		page,
		"Gold with GGX, with GGX four times as wide along x (viewer 30 degrees off the brushing), and with "
		"Beckmann; what is estimated is the luminance that reaches the viewer. Variances are integrals, not "
		"samples of the technique in question, so that the map has no noise but that of the times. *In the "
		"highlight*: the light's middle is the mirror image of the viewer; *aside*: 50 degrees from the normal "
		"and "
		"75 in azimuth from the viewer. sr: the solid angle of a uniform light as concentrated. %s\n\n",
		strategies_probes_said());
	strategies_write_default(page, &m);
	write_recommendation(page, &m);
	strategies_write_holdout(page, tables[7]);
	strategies_write_maps(page, &m);
	strategies_write_curves(page, &m, lines, time);
	write_times(page, time, batch);
	const double slow = batch_time(batch, "native:1", "GGX", strategies_name(LOBE_STRATEGY_VISIBLE), "sample_ns");
	const double fast = batch_time(batch, "native:1", "GGX", "production lobe", "sample_ns");
	if (fast > 0.0)
		report_finding(page,
			       "Choosing at run time costs: a batch samples `ggx_conductor` in %.1f ns and the same "
			       "strategy of the "
			       "comparison lobe in %.0f ns (one thread)",
			       fast, slow);
	strategies_write_pictures(page, tables[4], tables[5], tables[6]);
	free(m.cell);
}

const report_section strategies_section = {
	"strategies",
	"Sampling strategies: error against time",
	{&strategies_map_study, &strategies_time_study, &strategies_batch_study, &strategies_curves_study,
	 &strategies_reference_study, &strategies_expected_study, &strategies_pictures_study,
	 &strategies_holdout_study},
	write,
};
