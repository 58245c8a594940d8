/* strategies_recommended.c - what lobe_recommend_strategy names in every cell of the map, and what that costs over the
 * best. */
#include <stdio.h>
#include <stdlib.h>

#include "strategies_rank.h"

/* Of analytic lights (0), probes (1), or all (2). */
static double within(const rank_regrets *r, int how, int lights, double limit)
{
	const double n[2] = {(double)r->cells[0], (double)r->cells[1]};
	double share = 0.0;
	if (lights < 2)
		return rank_within(r->loss[how][lights], r->cells[lights], limit);
	for (int k = 0; k < 2; k++)
		if (r->cells[k])
			share += n[k] * rank_within(r->loss[how][k], r->cells[k], limit) / (n[0] + n[1]);
	return share;
}

static void write_row(report_page *page, const char *name, const rank_regrets *r, int how)
{
	static const double limits[] = {1.05, 1.2, 2.0};
	report_text(page, "| %s |", name);
	for (int lights = 0; lights < 2; lights++)
		for (int k = 0; k < 3; k++)
			if (r->cells[lights])
				report_text(page, " %.1f %% |", within(r, how, lights, limits[k]));
			else
				report_text(page, " - |");
	report_text(page, "\n");
}

void strategies_write_recommended(report_page *page, const rank_map *m)
{
	enum { ARRAYS = KNOWING * 2 + 1 };
	rank_regrets r[MEASURES];
	double *const room = calloc(MEASURES * ARRAYS * (m->count + 1), sizeof *room);
	double *at = room;
	if (!room)
		exit(1);
	for (int measure = 0; measure < MEASURES; measure++) {
		for (int k = 0; k < KNOWING * 2; k++, at += m->count + 1)
			r[measure].loss[k / 2][k % 2] = at;
		r[measure].of_default = at;
		at += m->count + 1;
	}
	rank_recommend(m, r);
	const rank_regrets *const s = &r[SAMPLES];
	const size_t cells = s->cells[0] + s->cells[1];
	const double unbeaten = 100.0 * (double)s->unbeaten / (double)cells;
	report_text(page,
		    "**`lobe_recommend_strategy`** (lobe/recommend.h): in what share of the cells it names a technique "
		    "whose "
		    "loss is within 5 %%, 20 %% and a factor of 2 of the least of all %d. *Told a shape*: of a probe a "
		    "fitted "
		    "disk, a glow and a sky, which leaves out most of what a room has for lamps. *Asking the light*: "
		    "`lobe_recommend_add` with what the light itself says at %d directions of the lobe's and as many "
		    "of its own "
		    "drawing.\n\n"
		    "| | analytic lights: within 5 %% | 20 %% | a factor of 2 | probes: within 5 %% | 20 %% | a factor "
		    "of 2 "
		    "|\n|---|---|---|---|---|---|---|\n",
		    STRATEGIES_TECHNIQUES, LOBE_RECOMMEND_POINTS);
	write_row(page, "told a shape, same samples", s, TOLD);
	write_row(page, "asking the light, same samples", s, ASKING);
	write_row(page, "told a shape, same time", &r[TIME], TOLD);
	write_row(page, "asking the light, same time", &r[TIME], ASKING);
	report_text(page,
		    "\nWhat it names when it asks is at least as efficient as each of the ten strategies that know "
		    "nothing of "
		    "the light, with the same ties, in %.1f %% of all cells; against the default alone it "
		    "needs %.3g times fewer samples at the median, %.3g times at the 90th percentile.\n\n",
		    unbeaten, rank_quantile(s->of_default, cells, 0.5), rank_quantile(s->of_default, cells, 0.9));
	char probes[96] = "";
	if (s->cells[1])
		snprintf(probes, sizeof probes, "; told a shape of probes %.1f %%, of analytic lights %.1f %%",
			 within(s, TOLD, 1, 1.05), within(s, TOLD, 0, 1.05));
	report_finding(
		page,
		"`lobe_recommend_strategy`, asking the light, names a technique within 5 %% of the best of all %d in "
		"%.1f "
		"%% of the cells%s. It is at least as efficient as every strategy that knows nothing of the light in "
		"%.1f %%, and saves a factor of %.3g in samples over the default alone at the median",
		STRATEGIES_TECHNIQUES, within(s, ASKING, 2, 1.05), probes, unbeaten,
		rank_quantile(s->of_default, cells, 0.5));
	free(room);
}
