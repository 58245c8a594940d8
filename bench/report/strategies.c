/* strategies.c - the report's section on sampling strategies: tables and findings from the rows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "strategies_rank.h"

/* --- tables ------------------------------------------------------------------------------------------------------- */

/* The default's place under each light. */
static void write_lights(report_page *page, const rank_map *m)
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
			const rank_cell *c = &m->cell[i];
			if (c->light != l || rank_dark(c))
				continue;
			n++;
			const int w = rank_winner(m, c, STRATEGIES_TECHNIQUES, SAMPLES);
			wins[w]++;
			lost[losses++] = rank_loss(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES) / rank_loss(m, c, w, SAMPLES);
			for (int measure = 0; measure < MEASURES; measure++) {
				good[0][measure] += rank_unbeaten(m, c, LOBE_STRATEGY_VISIBLE, measure);
				good[1][measure] += rank_unbeaten(m, c, LOBE_STRATEGY_BOUNDED_CAP, measure);
			}
		}
		for (size_t t = 0; t < STRATEGIES_TECHNIQUES; t++)
			most = wins[t] > wins[most] ? t : most;
		report_text(page, "| %s | %.2g | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %s, %.0f %% | %.3g |\n",
			    light.name, light.solid_angle, 100.0 * good[0][0] / n, 100.0 * good[0][1] / n,
			    100.0 * good[1][0] / n, 100.0 * good[1][1] / n, strategies_name((int)most),
			    100.0 * (double)wins[most] / n, rank_quantile(lost, losses, 0.5));
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
		"`beckmann_conductor`; everything else is the comparison lobe, which chooses at run time.\n\n"
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

/* How far the default is behind, where the lobe is what to sample. */
static void write_shortfall(report_page *page, const rank_map *m)
{
	double *behind = calloc(m->count + 1, sizeof *behind);
	if (!behind)
		exit(1);
	for (int measure = 0; measure < MEASURES; measure++) {
		size_t n = 0;
		for (size_t i = 0; i < m->count; i++) {
			const rank_cell *c = &m->cell[i];
			double best = HUGE_VAL;
			if (rank_dark(c) || !rank_lobes_turn(m, c, measure))
				continue;
			for (int k = 0; k < STRATEGIES_LOBE; k++)
				best = fmin(best, rank_loss(m, c, k, measure));
			behind[n++] = rank_loss(m, c, LOBE_STRATEGY_VISIBLE, measure) / best;
		}
		report_text(
			page,
			"%s its efficiency is at least 1/1.1 of the best lobe-sampling strategy's in %.0f %% of them, "
			"1/1.25 in %.0f %% and 1/2 in %.0f %%%s",
			measure == SAMPLES ? "There, for the same number of samples," : "in the same time,",
			rank_within(behind, n, 1.1), rank_within(behind, n, 1.25), rank_within(behind, n, 2.0),
			measure == SAMPLES ? "; " : ".\n\n");
	}
	free(behind);
}

static void write_shares(report_page *page, const rank_map *m)
{
	const rank_share v[MEASURES] = {rank_share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, -1),
					rank_share_of(m, LOBE_STRATEGY_VISIBLE, TIME, -1)};
	const rank_share b[MEASURES] = {rank_share_of(m, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES, -1),
					rank_share_of(m, LOBE_STRATEGY_BOUNDED_CAP, TIME, -1)};
	double gain[2] = {0, 0}, worst = 0.0;
	double *ratio = calloc(m->count + 1, sizeof *ratio);
	size_t n = 0, better = 0;
	if (!ratio)
		exit(1);
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c) || !rank_lobes_turn(m, c, SAMPLES) || c->material == STRATEGIES_BECKMANN)
			continue;
		ratio[n] = rank_loss(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES) /
			   rank_loss(m, c, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES);
		worst = fmax(worst, 1.0 / ratio[n]);
		better += ratio[n] > RANK_TIE;
		n++;
	}
	gain[0] = rank_quantile(ratio, n, 0.5);
	gain[1] = rank_quantile(ratio, n, 0.95);
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
	write_shortfall(page, m);
	const rank_share ggx[2] = {rank_share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, 0),
				   rank_share_of(m, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES, 0)};
	const rank_share beckmann[2] = {rank_share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, 1),
					rank_share_of(m, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES, 1)};
	report_text(page,
		    "By distribution, in those cells and for the same samples: of GGX visible normals are unbeaten in "
		    "%.0f %% and "
		    "the bounded cap in %.0f %%; of Beckmann, whose own visible normals the cap does not know, in %.0f "
		    "%% and "
		    "%.0f %%.\n\n",
		    ggx[0].turn, ggx[1].turn, beckmann[0].turn, beckmann[1].turn);
	report_finding(page,
		       "Among strategies that sample the lobe alone, visible normals (the default) are unbeaten in "
		       "%.0f %% of the "
		       "(roughness, angle, light) map for the same samples and %.0f %% in the same time, %s; the "
		       "bounded cap in "
		       "%.0f %% and %.0f %%. Where sampling the lobe is right at all: %.0f %% and %.0f %%",
		       v[0].all, v[1].all, v[0].all >= 90.0 && v[1].all >= 90.0 ? "which meets 90 %" : "short of 90 %",
		       b[0].all, b[1].all, v[0].turn, b[0].turn);
	if (n)
		report_finding(page,
			       "Of GGX, `LOBE_STRATEGY_BOUNDED_CAP` against the default where the lobe alone is the "
			       "thing to sample:"
			       " variance is lower by more than 2 %% in %.0f %% of those cells, %.2f times at the "
			       "median and "
			       "%.1f times at the 95th percentile; at worst it is %.2f times higher",
			       100.0 * (double)better / (double)n, gain[0], gain[1], worst);
	free(ratio);
}

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
	report_text(
		page,
		". Against always sampling visible normals alone it needs %.3g times fewer samples at the median, %.3g "
		"times at the 90th percentile.\n\n",
		median, upper);
	char probes[64] = "; no probes here";
	if (r.n[1])
		snprintf(probes, sizeof probes, ", probes %.1f %%", right[SAMPLES][1]);
	report_finding(
		page,
		"`lobe_recommend_strategy` names a technique within 5 %% of the best of all 14 in %.1f %% of the cells "
		"(analytic lights %.1f %%%s); it saves a factor of %.3g in samples over the default alone at the "
		"median",
		all[SAMPLES], right[SAMPLES][0], probes, median);
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
	write_lights(page, &m);
	write_shares(page, &m);
	write_recommendation(page, &m);
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
