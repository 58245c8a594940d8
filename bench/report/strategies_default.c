/* strategies_default.c - the default among the strategies that know nothing of the light: where it is the most
 * efficient one, where not, by how much and to whom. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "strategies_rank.h"

enum { WANTED = 90 }; /* percent of the map */

/* The default's place under each light. */
static void write_lights(report_page *page, const rank_map *m)
{
	report_text(
		page,
		"| light | sr | default unbeaten among strategies that follow the lobe, same samples | same time "
		"| where beaten, mostly by | median factor | worst | unbeaten among uniform and cosine too | bounded "
		"cap unbeaten, same samples | wins most cells, of all techniques | default's loss to it, median "
		"|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
	for (size_t l = 0; l < strategies_lights(m->quick); l++) {
		const strategies_light light = strategies_light_at(l, lobe_vec3_make(0.0f, 0.0f, 1.0f));
		double n = 0.0, good[MEASURES] = {0, 0}, blind = 0.0, bounded = 0.0;
		size_t wins[STRATEGIES_TECHNIQUES] = {0}, rivals[STRATEGIES_LOBE] = {0}, most = 0, rival = 0,
		       losses = 0;
		double *lost = calloc(m->count + 1, sizeof *lost);
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
			for (int measure = 0; measure < MEASURES; measure++)
				good[measure] += rank_unbeaten(m, c, LOBE_STRATEGY_VISIBLE, measure, FOLLOWING);
			blind += rank_unbeaten(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES, BLIND);
			bounded += rank_unbeaten(m, c, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES, FOLLOWING);
			if (!rank_unbeaten(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING))
				rivals[rank_best(m, c, SAMPLES, FOLLOWING)]++;
		}
		for (size_t t = 0; t < STRATEGIES_TECHNIQUES; t++)
			most = wins[t] > wins[most] ? t : most;
		for (size_t t = 0; t < STRATEGIES_LOBE; t++)
			rival = rivals[t] > rivals[rival] ? t : rival;
		const rank_defeat d = rank_defeat_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING, (int)l, -1);
		report_text(page, "| %s | %.2g | %.0f %% | %.0f %% |", light.name, light.solid_angle,
			    100.0 * good[0] / n, 100.0 * good[1] / n);
		if (d.cells)
			report_text(page, " %s, %zu of %zu cells | %.3g | %.3g |", strategies_name((int)rival),
				    rivals[rival], d.cells, d.median, d.worst);
		else
			report_text(page, " - | - | - |");
		report_text(page, " %.0f %% | %.0f %% | %s, %.0f %% | %.3g |\n", 100.0 * blind / n, 100.0 * bounded / n,
			    strategies_name((int)most), 100.0 * (double)wins[most] / n,
			    rank_quantile(lost, losses, 0.5));
		free(lost);
	}
}

/* --- every fixed strategy ------------------------------------------------------------------------------------------- */

/* GGX by the bounded cap, everything else by its own visible normals: in percent. */
static double mixed_share(const rank_map *m, int measure, int among)
{
	const rank_share ggx = rank_share_of(m, LOBE_STRATEGY_BOUNDED_CAP, measure, among, 0);
	const rank_share other = rank_share_of(m, LOBE_STRATEGY_VISIBLE, measure, among, 1);
	return (ggx.all * ggx.cells + other.all * other.cells) / fmax(ggx.cells + other.cells, 1.0);
}

/* The share of cells in which k's loss is at most limit times that of the best of those that follow the lobe. */
static double near_best(const rank_map *m, int k, int measure, double limit)
{
	double n = 0.0, cells = 0.0;
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c))
			continue;
		const int best = rank_best(m, c, measure, FOLLOWING);
		n += rank_loss(m, c, k, measure) / rank_loss(m, c, best, measure) <= limit;
		cells++;
	}
	return 100.0 * n / fmax(cells, 1.0);
}

static void write_readme(report_page *page, const rank_map *m)
{
	report_readme(page,
		      "In what share of the (roughness, angle, light) map a strategy is at least as efficient as every "
		      "other that "
		      "follows the lobe, and as uniform and cosine sampling too; where none should be used alone, "
		      "`lobe_recommend_strategy` says so. The time is that of a sample alone, without a ray: it differs by "
		      "a few percent, which decides many cells and from run to run decides them otherwise, so the share "
		      "within 10 %% of the best stands beside it.\n\n"
		      "| strategy | same samples | same time | within 10 %% | among uniform and cosine too, same samples "
		      "|\n|---|--:|--:|--:|--:|\n");
	for (int k = 0; k < STRATEGIES_LOBE; k++) {
		const double blind = rank_share_of(m, k, SAMPLES, BLIND, -1).all;
		if (rank_is_among(k, FOLLOWING))
			report_readme(page, "| %s | %.0f %% | %.0f %% | %.0f %% | %.0f %% |\n", strategies_name(k),
				      rank_share_of(m, k, SAMPLES, FOLLOWING, -1).all,
				      rank_share_of(m, k, TIME, FOLLOWING, -1).all, near_best(m, k, TIME, 1.1), blind);
		else
			report_readme(page, "| %s | | | | %.0f %% |\n", strategies_name(k), blind);
	}
	report_readme(
		page,
		"| *the best for each material, roughness and view, by hindsight* | %.0f %% | %.0f %% | | %.0f %% |\n\n",
		rank_most_by_view(m, SAMPLES, FOLLOWING), rank_most_by_view(m, TIME, FOLLOWING),
		rank_most_by_view(m, SAMPLES, BLIND));
}

static void write_shares(report_page *page, const rank_map *m)
{
	int most[AMONG][MEASURES];
	double share[AMONG][MEASURES];
	for (int among = 0; among < AMONG; among++)
		for (int measure = 0; measure < MEASURES; measure++)
			most[among][measure] = rank_most(m, measure, among, &share[among][measure]);
	const rank_share all = rank_share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING, -1);
	report_text(
		page,
		"\n**Which one strategy for everything?** Of %.0f cells in which light reaches the viewer: the share "
		"in "
		"which a strategy is at least as efficient as every other. What is within 2 %% ties, and what is "
		"within "
		"two standard deviations of the integrals (5 %% at most) or the spread of the times; the ways to the "
		"same density (slopes 2014, ellipsoid 2018 and cap 2023 of GGX) have the same variance. *The lobe's "
		"turn*: the %.0f cells where no technique that asks the light is clearly better. Bold: the most that "
		"any "
		"fixed strategy reaches.\n\n"
		"| strategy | among those that follow the lobe: same samples | same time | GGX, same samples | "
		"Beckmann, "
		"same samples | the lobe's turn, same samples | among uniform and cosine too: same samples | same time "
		"|\n|---|---|---|---|---|---|---|---|\n",
		all.cells, all.turns);
	for (int k = 0; k < STRATEGIES_LOBE; k++) {
		report_text(page, "| %s |", strategies_name(k));
		for (int among = 0; among < AMONG; among++)
			for (int measure = 0; measure < MEASURES; measure++) {
				const char *bold = most[among][measure] == k ? "**" : "";
				const rank_share s = rank_share_of(m, k, measure, among, -1);
				if (rank_is_among(k, among))
					report_text(page, " %s%.1f %%%s |", bold, s.all, bold);
				else
					report_text(page, " - |");
				if (among != FOLLOWING || measure != TIME)
					continue;
				if (rank_is_among(k, among))
					report_text(page, " %.1f %% | %.1f %% | %.1f %% |",
						    rank_share_of(m, k, SAMPLES, among, 0).all,
						    rank_share_of(m, k, SAMPLES, among, 1).all,
						    rank_share_of(m, k, SAMPLES, among, -1).turn);
				else
					report_text(page, " - | - | - |");
			}
		report_text(page, "\n");
	}
	report_text(
		page,
		"| bounded cap of GGX, visible normals of Beckmann | %.1f %% | %.1f %% | | | | %.1f %% | %.1f %% |\n",
		mixed_share(m, SAMPLES, FOLLOWING), mixed_share(m, TIME, FOLLOWING), mixed_share(m, SAMPLES, BLIND),
		mixed_share(m, TIME, BLIND));
	report_text(
		page,
		"| the best for each material, roughness and view, by hindsight | %.1f %% | %.1f %% | | | | %.1f %% | "
		"%.1f %% |\n",
		rank_most_by_view(m, SAMPLES, FOLLOWING), rank_most_by_view(m, TIME, FOLLOWING),
		rank_most_by_view(m, SAMPLES, BLIND), rank_most_by_view(m, TIME, BLIND));
}

/* Rows by rival. */
static void write_defeats(report_page *page, const rank_map *m, int k, int among)
{
	report_text(page, "| rival | cells | median factor | worst | alpha, 10 - 90 %% | view cosine, 10 - 90 %% "
			  "|\n|---|---|---|---|---|---|\n");
	for (int rival = 0; rival < STRATEGIES_LOBE; rival++) {
		const rank_defeat d = rank_defeat_of(m, k, SAMPLES, among, -1, rival);
		if (d.cells)
			report_text(page, "| %s | %zu | %.3g | %.3g | %.2g - %.2g | %.2g - %.2g |\n",
				    strategies_name(rival), d.cells, d.median, d.worst, d.alpha[0], d.alpha[1],
				    d.cosine[0], d.cosine[1]);
	}
	report_text(page, "\n");
}

/* Beaten cells in which one sample errs by less than a thousandth of the mean. */
static double harmless(const rank_map *m, int k)
{
	double n = 0.0, beaten = 0.0;
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c) || rank_unbeaten(m, c, k, SAMPLES, FOLLOWING))
			continue;
		beaten++;
		n += sqrt(c->variance[k]) < 1e-3 * c->mean;
	}
	return beaten > 0.0 ? 100.0 * n / beaten : 0.0;
}

/* How far k is behind the best of those that follow the lobe: shares of cells within a tenth, a quarter, a factor of
 * 2. */
static void write_behind(report_page *page, const rank_map *m, int k)
{
	report_text(
		page,
		"%s: the best of them needs at least 1/1.1 of its samples in %.1f %% of the map, 1/1.25 in %.1f %%, "
		"half in %.1f %%.\n\n",
		strategies_name(k), near_best(m, k, SAMPLES, 1.1), near_best(m, k, SAMPLES, 1.25),
		near_best(m, k, SAMPLES, 2.0));
}

/* --- the bounded cap in the default's place ------------------------------------------------------------------------- */

typedef struct {
	double better, worse, median, upper, most, least; /* shares in percent; of default's loss over the cap's */
	double time; /* of the cap's samples over the default's, mean over lights */
} exchange;

static exchange exchange_of(const rank_map *m)
{
	exchange e = {0, 0, 0, 0, 0, 0, 0};
	double *ratio = calloc(m->count + 1, sizeof *ratio);
	const size_t lights = strategies_lights(m->quick);
	size_t n = 0;
	if (!ratio)
		exit(1);
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c) || c->material == STRATEGIES_BECKMANN)
			continue;
		ratio[n] = rank_loss(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES) /
			   rank_loss(m, c, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES);
		e.better += ratio[n] > RANK_TIE;
		e.worse += ratio[n] < 1.0 / RANK_TIE;
		n++;
	}
	for (size_t l = 0; l < lights; l++)
		e.time += m->time[0][l][LOBE_STRATEGY_BOUNDED_CAP] / (double)lights;
	e.better *= 100.0 / (double)n;
	e.worse *= 100.0 / (double)n;
	e.median = rank_quantile(ratio, n, 0.5);
	e.upper = rank_quantile(ratio, n, 0.95);
	e.most = rank_quantile(ratio, n, 1.0);
	e.least = rank_quantile(ratio, n, 0.0);
	free(ratio);
	return e;
}

/* --- the section's part ---------------------------------------------------------------------------------------------- */

/* The most that a choice by distribution reaches: of each the strategy that is unbeaten in most of its cells. */
static double most_by_distribution(const rank_map *m, int measure, int among)
{
	double sum = 0.0, cells = 0.0;
	for (int ndf = 0; ndf < 2; ndf++) {
		rank_share best = {0, 0, 0, 0};
		for (int k = 0; k < STRATEGIES_LOBE; k++) {
			const rank_share s = rank_share_of(m, k, measure, among, ndf);
			best = rank_is_among(k, among) && s.all >= best.all ? s : best;
		}
		sum += best.all * best.cells;
		cells += best.cells;
	}
	return sum / fmax(cells, 1.0);
}

static void write_findings(report_page *page, const rank_map *m)
{
	double share[AMONG];
	int most[AMONG];
	for (int among = 0; among < AMONG; among++)
		most[among] = rank_most(m, SAMPLES, among, &share[among]);
	const rank_share v = rank_share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING, -1);
	const double time = rank_share_of(m, LOBE_STRATEGY_VISIBLE, TIME, FOLLOWING, -1).all;
	const double blind = rank_share_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, BLIND, -1).all;
	const double bound[MEASURES] = {most_by_distribution(m, SAMPLES, FOLLOWING),
					most_by_distribution(m, TIME, FOLLOWING)};
	const double by_view = rank_most_by_view(m, SAMPLES, FOLLOWING);
	const rank_defeat d = rank_defeat_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING, -1, -1);
	report_finding(page,
		       "Among strategies that follow the lobe, visible normals (the default) are at least as efficient "
		       "as every "
		       "other in %.0f %% of the (roughness, angle, light) map for the same samples and %.0f %% in the "
		       "same time, a sample's own, without a ray (within 10 %% of the best in %.0f %%), "
		       "%s %d %%; where not, by a factor of %.2f at the median. With the bounded cap for GGX: %.0f %% "
		       "and %.0f "
		       "%%, its bound as published",
		       v.all, time, near_best(m, LOBE_STRATEGY_VISIBLE, TIME, 1.1), v.all >= WANTED ? "at least" : "short of", WANTED, d.median,
		       mixed_share(m, SAMPLES, FOLLOWING), mixed_share(m, TIME, FOLLOWING));
	report_finding(
		page,
		"The most that any one strategy that follows the lobe reaches is %.0f %% (%s), a choice by "
		"distribution "
		"%.0f %% (same time %.0f %%), and the best that knows material, roughness and view %.1f %%: %d %% is "
		"%s "
		"reach of a choice that does not know the light. With uniform and cosine sampling, which find a small "
		"light beside the highlight more often, %.0f %% (%s; visible normals %.0f %%): there ask the light, "
		"or "
		"`lobe_recommend_strategy`",
		share[FOLLOWING], strategies_name(most[FOLLOWING]), bound[SAMPLES], bound[TIME], by_view, WANTED,
		by_view >= WANTED ? "in" : "out of", share[BLIND], strategies_name(most[BLIND]), blind);
	const exchange e = exchange_of(m);
	report_finding(page,
		       "Of GGX, `LOBE_STRATEGY_BOUNDED_CAP` in the default's place: variance lower by more than 2 %% "
		       "in %.0f %% "
		       "of the cells (%.2f times at the 95th percentile, at most %.3g), higher in %.1f %% (at most "
		       "%.2f times); "
		       "an estimate takes %.2f times as long",
		       e.better, e.upper, e.most, e.worse, 1.0 / e.least, e.time);
}

void strategies_write_default(report_page *page, const rank_map *m)
{
	write_lights(page, m);
	write_shares(page, m);
	write_readme(page, m);
	const rank_defeat all = rank_defeat_of(m, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING, -1, -1);
	report_text(page,
		    "\n**Where the default is beaten** by a strategy that follows the lobe, for the same samples (in "
		    "%.0f %% of "
		    "these %zu cells a single sample errs by less than a thousandth of the mean): a light in the "
		    "highlight of a grazing view is found more often by strategies that draw more normals near "
		    "the mean one; under a dome those lose least that draw few normals which reflect below the "
		    "horizon.\n\n",
		    harmless(m, LOBE_STRATEGY_VISIBLE), all.cells);
	write_defeats(page, m, LOBE_STRATEGY_VISIBLE, FOLLOWING);
	write_behind(page, m, LOBE_STRATEGY_VISIBLE);
	report_text(page, "Among uniform and cosine too:\n\n");
	write_defeats(page, m, LOBE_STRATEGY_VISIBLE, BLIND);
	report_text(page,
		    "The bounded cap in its place, among those that follow the lobe (of Beckmann too, whose normals it "
		    "borrows from GGX, and is the worse for it):\n\n");
	write_defeats(page, m, LOBE_STRATEGY_BOUNDED_CAP, FOLLOWING);
	write_behind(page, m, LOBE_STRATEGY_BOUNDED_CAP);
	write_findings(page, m);
}
