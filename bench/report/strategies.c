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
		"| technique | GGX scalar | of visible normals (range) | native:1 | native | opencl | Beckmann scalar "
		"| "
		"native:1 | native | opencl |\n|---|---|---|---|---|---|---|---|---|---|\n");
	for (int t = -1; t < STRATEGIES_TECHNIQUES; t++) {
		const char *name = t < 0 ? "production lobe" : strategies_name(t);
		report_text(page, "| %s", name);
		for (int m = 0; m < 2; m++) {
			const char *material = strategies_material_name(m ? STRATEGIES_BECKMANN : STRATEGIES_GGX);
			report_text(page, " | %.0f", scalar_time(time, material, name, "ns"));
			if (m == 0)
				report_text(page, " | %.2f (%.2f - %.2f)",
					    scalar_time(time, material, name, "of_visible"),
					    scalar_time(time, material, name, "of_visible_low"),
					    scalar_time(time, material, name, "of_visible_high"));
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
	strategies_write_recommended(page, &m);
	strategies_write_holdout(page, tables[7]);
	strategies_write_maps(page, &m);
	strategies_write_curves(page, &m, lines);
	write_times(page, time, batch);
	const double slow =
		batch_time(batch, "native:1", "GGX", strategies_name(LOBE_STRATEGY_BOUNDED_CAP), "sample_ns");
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
	"Which strategy, when?",
	{&strategies_map_study, &strategies_time_study, &strategies_batch_study, &strategies_curves_study,
	 &strategies_reference_study, &strategies_expected_study, &strategies_pictures_study,
	 &strategies_holdout_study},
	write,
};
