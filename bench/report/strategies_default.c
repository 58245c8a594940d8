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
		"| with a ray | where beaten, mostly by | median factor | worst | unbeaten among uniform and cosine "
		"too "
		"| visible normals unbeaten, same samples | wins most cells, of all techniques | default's loss to it, "
		"median |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
	for (size_t l = 0; l < strategies_lights(m->quick); l++) {
		const strategies_light light = strategies_light_at(l, lobe_vec3_make(0.0f, 0.0f, 1.0f));
		double n = 0.0, good[MEASURES] = {0, 0, 0}, blind = 0.0, visible = 0.0;
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
			lost[losses++] = rank_loss(m, c, RANK_DEFAULT, SAMPLES) / rank_loss(m, c, w, SAMPLES);
			for (int measure = 0; measure < MEASURES; measure++)
				good[measure] += rank_unbeaten(m, c, RANK_DEFAULT, measure, FOLLOWING);
			blind += rank_unbeaten(m, c, RANK_DEFAULT, SAMPLES, BLIND);
			visible += rank_unbeaten(m, c, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING);
			if (!rank_unbeaten(m, c, RANK_DEFAULT, SAMPLES, FOLLOWING))
				rivals[rank_best(m, c, SAMPLES, FOLLOWING)]++;
		}
		for (size_t t = 0; t < STRATEGIES_TECHNIQUES; t++)
			most = wins[t] > wins[most] ? t : most;
		for (size_t t = 0; t < STRATEGIES_LOBE; t++)
			rival = rivals[t] > rivals[rival] ? t : rival;
		const rank_defeat d = rank_defeat_of(m, RANK_DEFAULT, SAMPLES, FOLLOWING, (int)l, -1);
		report_text(page, "| %s | %.2g | %.0f %% | %.0f %% | %.0f %% |", light.name, light.solid_angle,
			    100.0 * good[SAMPLES] / n, 100.0 * good[TIME] / n, 100.0 * good[RAY] / n);
		if (d.cells)
			report_text(page, " %s, %zu of %zu cells | %.3g | %.3g |", strategies_name((int)rival),
				    rivals[rival], d.cells, d.median, d.worst);
		else
			report_text(page, " - | - | - |");
		report_text(page, " %.0f %% | %.0f %% | %s, %.0f %% | %.3g |\n", 100.0 * blind / n, 100.0 * visible / n,
			    strategies_name((int)most), 100.0 * (double)wins[most] / n,
			    rank_quantile(lost, losses, 0.5));
		free(lost);
	}
}

/* --- every fixed strategy ------------------------------------------------------------------------------------------- */

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

/* A line of README's table. */
static void readme_row(report_page *page, const rank_map *m, int k, const char *name)
{
	const double blind = rank_share_of(m, k, SAMPLES, BLIND, -1).all;
	if (k == RANK_DEFAULT || rank_is_among(k, FOLLOWING))
		report_readme(page, "| %s | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %.0f %% |\n", name,
			      rank_share_of(m, k, SAMPLES, FOLLOWING, -1).all,
			      rank_share_of(m, k, RAY, FOLLOWING, -1).all, rank_share_of(m, k, TIME, FOLLOWING, -1).all,
			      near_best(m, k, TIME, 1.1), blind);
	else
		report_readme(page, "| %s | | | | | %.0f %% |\n", name, blind);
}

static void write_readme(report_page *page, const rank_map *m)
{
	report_readme(page,
		      "In what share of the (roughness, angle, light) map a strategy is at least as efficient as every "
		      "other that follows the lobe, and as uniform and cosine sampling too; where none should be used "
		      "alone, `lobe_recommend_strategy` says so. Efficiency is 1/(variance x cost), the cost a sample, "
		      "its time with a ray of %.0f ns, or its own time alone. That differs by a few percent, which "
		      "decides many cells and from run to run decides them otherwise, so the share within 10 %% of the "
		      "best stands beside it.\n\n"
		      "| strategy | same samples | same time with a ray | same time | within 10 %% | among uniform and "
		      "cosine too, same samples |\n|---|--:|--:|--:|--:|--:|\n",
		      RANK_RAY);
	readme_row(page, m, RANK_DEFAULT, "**the default**: bounded cap of GGX, visible normals of Beckmann");
	for (int k = 0; k < STRATEGIES_LOBE; k++)
		readme_row(page, m, k, strategies_name(k));
	report_readme(
		page,
		"| *the best for each material, roughness and view, by hindsight* | %.0f %% | %.0f %% | %.0f %% | | "
		"%.0f %% |\n\n",
		rank_most_by_view(m, SAMPLES, FOLLOWING), rank_most_by_view(m, RAY, FOLLOWING),
		rank_most_by_view(m, TIME, FOLLOWING), rank_most_by_view(m, SAMPLES, BLIND));
}

/* A row of shares; most: the fixed strategy that reaches most, in bold. */
static void share_row(report_page *page, const rank_map *m, int k, const char *name, int most[AMONG][MEASURES])
{
	report_text(page, "| %s |", name);
	for (int among = 0; among < AMONG; among++) {
		const int there = k == RANK_DEFAULT || rank_is_among(k, among);
		for (int measure = 0; measure < MEASURES; measure++) {
			const char *const bold = most[among][measure] == k ? "**" : "";
			if (there)
				report_text(page, " %s%.1f %%%s |", bold, rank_share_of(m, k, measure, among, -1).all,
					    bold);
			else
				report_text(page, " - |");
		}
		if (among != FOLLOWING)
			continue;
		if (there)
			report_text(page, " %.1f %% | %.1f %% | %.1f %% |", rank_share_of(m, k, SAMPLES, among, 0).all,
				    rank_share_of(m, k, SAMPLES, among, 1).all,
				    rank_share_of(m, k, SAMPLES, among, -1).turn);
		else
			report_text(page, " - | - | - |");
	}
	report_text(page, "\n");
}

static void write_shares(report_page *page, const rank_map *m)
{
	int most[AMONG][MEASURES];
	double share;
	for (int among = 0; among < AMONG; among++)
		for (int measure = 0; measure < MEASURES; measure++)
			most[among][measure] = rank_most(m, measure, among, &share);
	const rank_share all = rank_share_of(m, RANK_DEFAULT, SAMPLES, FOLLOWING, -1);
	report_text(
		page,
		"\n**Which one strategy for everything?** Of %.0f cells in which light reaches the viewer: the share "
		"in which a strategy is at least as efficient as every other. What is within 2 %% ties, and what is "
		"within two standard deviations of the integrals (5 %% at most) or the spread of the times; the ways "
		"to the same density (slopes 2014, ellipsoid 2018 and cap 2023 of GGX) have the same variance. *With "
		"a ray*: of %.0f ns for each direction, added to a sample's own time. *The lobe's turn*: the %.0f "
		"cells where no technique that asks the light is clearly better. Bold: the most that any fixed "
		"strategy reaches.\n\n"
		"| strategy | among those that follow the lobe: same samples | same time | with a ray | GGX, same "
		"samples | Beckmann, same samples | the lobe's turn, same samples | among uniform and cosine too: same "
		"samples | same time | with a ray |\n|---|---|---|---|---|---|---|---|---|---|\n",
		all.cells, RANK_RAY, all.turns);
	share_row(page, m, RANK_DEFAULT, "the default: bounded cap of GGX, visible normals of Beckmann", most);
	for (int k = 0; k < STRATEGIES_LOBE; k++)
		share_row(page, m, k, strategies_name(k), most);
	report_text(page, "| the best for each material, roughness and view, by hindsight |");
	for (int among = 0; among < AMONG; among++) {
		for (int measure = 0; measure < MEASURES; measure++)
			report_text(page, " %.1f %% |", rank_most_by_view(m, measure, among));
		report_text(page, among == FOLLOWING ? " | | |" : "\n");
	}
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
		n += sqrt(c->variance[rank_strategy(c, k)]) < 1e-3 * c->mean;
	}
	return beaten > 0.0 ? 100.0 * n / beaten : 0.0;
}

/* How far k is behind the best of those that follow the lobe: shares of cells within a tenth, a quarter, a factor of
 * 2. */
static void write_behind(report_page *page, const rank_map *m, int k, const char *name)
{
	report_text(
		page,
		"%s: the best of them needs at least 1/1.1 of its samples in %.1f %% of the map, 1/1.25 in %.1f %%, "
		"half in %.1f %%.\n\n",
		name, near_best(m, k, SAMPLES, 1.1), near_best(m, k, SAMPLES, 1.25), near_best(m, k, SAMPLES, 2.0));
}

/* --- the bounded cap of GGX against all visible normals ---------------------------------------------------------------- */

typedef struct {
	double better, worse, median, upper, most,
		least; /* shares in percent; of visible normals' loss over the cap's */
	double time;   /* of the cap's samples over theirs, mean over lights */
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
		e.time += m->time[0][l][LOBE_STRATEGY_BOUNDED_CAP] / m->time[0][l][LOBE_STRATEGY_VISIBLE] /
			  (double)lights;
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
	double share[AMONG], own[MEASURES];
	int most[AMONG];
	for (int among = 0; among < AMONG; among++)
		most[among] = rank_most(m, SAMPLES, among, &share[among]);
	for (int measure = 0; measure < MEASURES; measure++)
		own[measure] = rank_share_of(m, RANK_DEFAULT, measure, FOLLOWING, -1).all;
	const double blind = rank_share_of(m, RANK_DEFAULT, SAMPLES, BLIND, -1).all;
	const double by_view = rank_most_by_view(m, SAMPLES, FOLLOWING);
	const rank_defeat d = rank_defeat_of(m, RANK_DEFAULT, SAMPLES, FOLLOWING, -1, -1);
	report_finding(
		page,
		"Among strategies that follow the lobe the default (the bounded cap of GGX, visible normals of "
		"Beckmann) is at least as efficient as every other in %.0f %% of the (roughness, angle, light) map "
		"for the same samples, %.0f %% in the same time with a ray of %.0f ns, and %.0f %% in a sample's "
		"own time (within 10 %% of the best in %.0f %%), %s %d %%; where not, by a factor of %.2f at the "
		"median",
		own[SAMPLES], own[RAY], RANK_RAY, own[TIME], near_best(m, RANK_DEFAULT, TIME, 1.1),
		own[SAMPLES] >= WANTED ? "at least" : "short of", WANTED, d.median);
	report_finding(
		page,
		"The most that any one strategy that follows the lobe reaches is %.0f %% (%s), a choice by "
		"distribution %.0f %% (with a ray %.0f %%), and the best that knows material, roughness and view, by "
		"hindsight, %.1f %%: %d %% is %s reach of a choice that does not know the light. With uniform and "
		"cosine sampling, which find a small light beside the highlight more often, %.0f %% (%s; the "
		"default %.0f %%): there ask the light, or `lobe_recommend_strategy`",
		share[FOLLOWING], strategies_name(most[FOLLOWING]), most_by_distribution(m, SAMPLES, FOLLOWING),
		most_by_distribution(m, RAY, FOLLOWING), by_view, WANTED, by_view >= WANTED ? "in" : "out of",
		share[BLIND], strategies_name(most[BLIND]), blind);
	const exchange e = exchange_of(m);
	report_finding(
		page,
		"Of GGX the bounded cap has a variance lower by more than 2 %% than all visible normals in %.0f %% "
		"of the cells (%.2f times at the 95th percentile, at most %.3g), higher in %.1f %% (at most %.2f "
		"times); an estimate takes %.2f times as long",
		e.better, e.upper, e.most, e.worse, 1.0 / e.least, e.time);
}

void strategies_write_default(report_page *page, const rank_map *m)
{
	write_lights(page, m);
	write_shares(page, m);
	write_readme(page, m);
	const rank_defeat all = rank_defeat_of(m, RANK_DEFAULT, SAMPLES, FOLLOWING, -1, -1);
	report_text(
		page,
		"\n**Where the default is beaten** by a strategy that follows the lobe, for the same samples (in "
		"%.0f %% of these %zu cells a single sample errs by less than a thousandth of the mean): a light in "
		"the highlight of a grazing view is found more often by strategies that draw more normals near the "
		"mean one.\n\n",
		harmless(m, RANK_DEFAULT), all.cells);
	write_defeats(page, m, RANK_DEFAULT, FOLLOWING);
	write_behind(page, m, RANK_DEFAULT, "The default");
	report_text(page, "Among uniform and cosine too:\n\n");
	write_defeats(page, m, RANK_DEFAULT, BLIND);
	report_text(page, "All visible normals in its place, among those that follow the lobe:\n\n");
	write_defeats(page, m, LOBE_STRATEGY_VISIBLE, FOLLOWING);
	write_behind(page, m, LOBE_STRATEGY_VISIBLE, "Visible normals");
	write_findings(page, m);
}
