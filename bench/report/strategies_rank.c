/* strategies_rank.c - see strategies_rank.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "strategies_rank.h"

/* --- rows --------------------------------------------------------------------------------------------------------- */

int rank_technique(const char *name)
{
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
		if (strcmp(name, strategies_name(t)) == 0)
			return t;
	return -1;
}

size_t rank_light(const rank_map *m, const char *name)
{
	const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
	for (size_t i = 0; i < strategies_lights(m->quick); i++) {
		const strategies_light light = strategies_light_at(i, up);
		if (strcmp(light.name, name) == 0)
			return i;
	}
	return 0;
}

int rank_material(const char *name)
{
	for (int m = 0; m < STRATEGIES_MATERIALS; m++)
		if (strcmp(name, strategies_material_name(m)) == 0)
			return m;
	return 0;
}

static void read_times(rank_map *m, const report_table *t)
{
	for (size_t i = 0; i < report_table_rows(t); i++) {
		const int technique = rank_technique(report_cell(t, i, "technique"));
		const int ndf = strategies_ndf(rank_material(report_cell(t, i, "material")));
		const size_t light = rank_light(m, report_cell(t, i, "light"));
		if (technique < 0)
			continue;
		m->time[ndf][light][technique] = report_number(t, i, "ns");
		m->noise[ndf][light][technique] =
			0.5 * (report_number(t, i, "of_visible_high") - report_number(t, i, "of_visible_low")) /
			report_number(t, i, "of_visible");
	}
}

/* Rows are in the order of the units: material, light, alpha, cosine, technique. */
static void read_map(rank_map *m, const report_table *t)
{
	const size_t alphas = strategies_alphas(m->quick), cosines = strategies_cosines(m->quick);
	m->count = report_table_rows(t) / STRATEGIES_TECHNIQUES;
	m->cell = calloc(m->count + 1, sizeof *m->cell);
	if (!m->cell) {
		fputs("report: out of memory\n", stderr);
		exit(1);
	}
	for (size_t i = 0, first = 0; i < m->count; i++) {
		rank_cell *c = &m->cell[i];
		c->material = rank_material(report_cell(t, i * STRATEGIES_TECHNIQUES, "material"));
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

void rank_read(rank_map *m, int quick, const report_table *rows, const report_table *times)
{
	m->quick = quick;
	read_times(m, times);
	read_map(m, rows);
}

/* --- who wins ----------------------------------------------------------------------------------------------------- */

int rank_strategy(const rank_cell *c, int k)
{
	if (k != RANK_DEFAULT)
		return k;
	return strategies_default(c->material);
}

static double cost(const rank_map *m, const rank_cell *c, int technique, int measure)
{
	const double directions = technique >= STRATEGIES_BALANCE ? 2.0 : 1.0;
	const double time = m->time[strategies_ndf(c->material)][c->light][technique];
	return measure == SAMPLES ? directions : measure == TIME ? time : time + RANK_RAY * directions;
}

double rank_loss(const rank_map *m, const rank_cell *c, int k, int measure)
{
	const int technique = rank_strategy(c, k);
	return fmax(c->variance[technique], 1e-300) * cost(m, c, technique, measure);
}

int rank_dark(const rank_cell *c) { return !(c->mean > 1e-25); }

int rank_winner(const rank_map *m, const rank_cell *c, int techniques, int measure)
{
	int best = LOBE_STRATEGY_VISIBLE;
	for (int k = 1; k < techniques; k++)
		if (rank_loss(m, c, k, measure) < rank_loss(m, c, best, measure))
			best = k;
	const double enough = RANK_TIE * rank_loss(m, c, best, measure);
	if (rank_loss(m, c, RANK_DEFAULT, measure) <= enough)
		return rank_strategy(c, RANK_DEFAULT);
	return rank_loss(m, c, LOBE_STRATEGY_VISIBLE, measure) <= enough ? LOBE_STRATEGY_VISIBLE : best;
}

int rank_is_among(int k, int among)
{
	return k < STRATEGIES_LOBE && (among == BLIND || !lobe_strategy_of_directions((lobe_uint)k));
}

/* Of the cost, by the noise of the time in it. */
static double noise_of(const rank_map *m, const rank_cell *c, int k, int measure)
{
	const int ndf = strategies_ndf(c->material);
	return measure == SAMPLES ? 0.0
				  : m->noise[ndf][c->light][k] * m->time[ndf][c->light][k] / cost(m, c, k, measure);
}

static double doubt_of(const rank_cell *c, int k) { return c->error[k] / fmax(c->variance[k], 1e-300); }

static double tie(const rank_map *m, const rank_cell *c, int a, int b, int measure)
{
	const double of_times = noise_of(m, c, a, measure) + noise_of(m, c, b, measure);
	const double of_variances = fmin(2.0 * hypot(doubt_of(c, a), doubt_of(c, b)), 0.05);
	return fmax(RANK_TIE, 1.0 + fmin(of_times + of_variances, 0.25));
}

int rank_unbeaten(const rank_map *m, const rank_cell *c, int strategy, int measure, int among)
{
	const int k = rank_strategy(c, strategy);
	for (int other = 0; other < STRATEGIES_LOBE; other++)
		if (rank_is_among(other, among) &&
		    rank_loss(m, c, k, measure) > tie(m, c, k, other, measure) * rank_loss(m, c, other, measure))
			return 0;
	return 1;
}

int rank_best(const rank_map *m, const rank_cell *c, int measure, int among)
{
	int best = LOBE_STRATEGY_VISIBLE;
	for (int k = 1; k < STRATEGIES_LOBE; k++)
		if (rank_is_among(k, among) && rank_loss(m, c, k, measure) < rank_loss(m, c, best, measure))
			best = k;
	return best;
}

rank_defeat rank_defeat_of(const rank_map *m, int k, int measure, int among, int light, int rival)
{
	rank_defeat d = {0, NAN, NAN, {NAN, NAN}, {NAN, NAN}};
	double *room = calloc(3 * (m->count + 1), sizeof *room);
	if (!room)
		exit(1);
	double *const factor = room, *const alpha = room + m->count + 1, *const cosine = room + 2 * (m->count + 1);
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c) || (light >= 0 && c->light != (size_t)light) || rank_unbeaten(m, c, k, measure, among))
			continue;
		const int best = rank_best(m, c, measure, among);
		if (rival >= 0 && best != rival)
			continue;
		factor[d.cells] = rank_loss(m, c, k, measure) / rank_loss(m, c, best, measure);
		alpha[d.cells] = strategies_alpha(m->quick, c->alpha);
		cosine[d.cells++] = strategies_cosine(m->quick, c->cosine);
	}
	d.median = rank_quantile(factor, d.cells, 0.5);
	d.worst = rank_quantile(factor, d.cells, 1.0);
	for (int q = 0; q < 2; q++) {
		d.alpha[q] = rank_quantile(alpha, d.cells, q ? 0.9 : 0.1);
		d.cosine[q] = rank_quantile(cosine, d.cells, q ? 0.9 : 0.1);
	}
	free(room);
	return d;
}

/* Where the lobe is what to sample: no technique that asks the light is clearly better. */
static int lobes_turn(const rank_map *m, const rank_cell *c, int measure)
{
	return rank_winner(m, c, STRATEGIES_TECHNIQUES, measure) < STRATEGIES_LOBE;
}

rank_share rank_share_of(const rank_map *m, int k, int measure, int among, int ndf)
{
	rank_share s = {0, 0, 0, 0};
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c) || (ndf >= 0 && strategies_ndf(c->material) != ndf))
			continue;
		const int good = rank_unbeaten(m, c, k, measure, among), turn = lobes_turn(m, c, measure);
		s.cells++;
		s.turns += turn;
		s.all += good;
		s.turn += good && turn;
	}
	s.all *= 100.0 / fmax(s.cells, 1.0);
	s.turn *= 100.0 / fmax(s.turns, 1.0);
	return s;
}

int rank_most(const rank_map *m, int measure, int among, double *share)
{
	int most = LOBE_STRATEGY_VISIBLE;
	*share = 0.0;
	for (int k = 0; k < STRATEGIES_LOBE; k++) {
		const double all = rank_is_among(k, among) ? rank_share_of(m, k, measure, among, -1).all : 0.0;
		if (all > *share) {
			*share = all;
			most = k;
		}
	}
	return most;
}

double rank_most_by_view(const rank_map *m, int measure, int among)
{
	enum { GRID = 16 };
	size_t good[STRATEGIES_MATERIALS][GRID][GRID][STRATEGIES_LOBE], sum = 0, cells = 0;
	memset(good, 0, sizeof good);
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		size_t *const here = good[c->material][c->alpha % GRID][c->cosine % GRID];
		for (int k = 0; k < STRATEGIES_LOBE && !rank_dark(c); k++)
			here[k] += rank_is_among(k, among) && rank_unbeaten(m, c, k, measure, among);
		cells += !rank_dark(c);
	}
	for (int material = 0; material < STRATEGIES_MATERIALS; material++)
		for (int view = 0; view < GRID * GRID; view++) {
			const size_t *const here = good[material][view / GRID][view % GRID];
			size_t most = 0;
			for (int k = 0; k < STRATEGIES_LOBE; k++)
				most = here[k] > most ? here[k] : most;
			sum += most;
		}
	return 100.0 * (double)sum / fmax((double)cells, 1.0);
}

static int ascending(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

double rank_quantile(double *values, size_t n, double q)
{
	if (n == 0)
		return NAN;
	qsort(values, n, sizeof *values, ascending);
	return values[(size_t)(q * (double)(n - 1) + 0.5)];
}

/* --- the recommendation ------------------------------------------------------------------------------------------- */

int rank_recommended(lobe_recommendation r)
{
	if (r.from == LOBE_SAMPLE_LIGHT)
		return STRATEGIES_LIGHT;
	if (r.from == LOBE_SAMPLE_BOTH_POWER)
		return STRATEGIES_POWER;
	if (r.from == LOBE_SAMPLE_BOTH_BALANCE)
		return r.strategy == LOBE_STRATEGY_BOUNDED_CAP ? STRATEGIES_BALANCE_BOUNDED : STRATEGIES_BALANCE;
	return (int)r.strategy;
}

static lobe_recommend_cost costs_of(const rank_map *m, const rank_cell *c, int measure)
{
	lobe_recommend_cost p = lobe_recommend_cost_samples();
	const double *time = m->time[strategies_ndf(c->material)][c->light], ray = measure == RAY ? RANK_RAY : 0.0;
	if (measure == SAMPLES)
		return p;
	for (int k = 0; k < STRATEGIES_LOBE; k++)
		p.lobe[k] = (float)(time[k] + ray);
	p.light = (float)(time[STRATEGIES_LIGHT] + ray);
	p.weighting = (float)(time[STRATEGIES_BALANCE] - time[LOBE_STRATEGY_VISIBLE] - time[STRATEGIES_LIGHT]);
	return p;
}

void rank_recommend(const rank_map *m, rank_regrets r[MEASURES])
{
	for (int measure = 0; measure < MEASURES; measure++)
		r[measure].cells[0] = r[measure].cells[1] = r[measure].unbeaten = 0;
	for (size_t i = 0; i < m->count; i++) {
		const rank_cell *c = &m->cell[i];
		if (rank_dark(c))
			continue;
		const strategies_case s = strategies_case_make(c->material, strategies_alpha(m->quick, c->alpha),
							       strategies_cosine(m->quick, c->cosine), c->light);
		const lobe_microsurface surface = s.lobe[LOBE_STRATEGY_VISIBLE].surface;
		const int probe = s.light.probe != NULL;
		const lobe_recommend_sums sums[KNOWING] = {
			lobe_recommend_integrate(surface, s.wo, strategies_shape(&s.light)), strategies_asked(&s)};
		for (int measure = 0; measure < MEASURES; measure++) {
			rank_regrets *of = &r[measure];
			double best = HUGE_VAL;
			int t = 0;
			for (int k = 0; k < STRATEGIES_TECHNIQUES; k++)
				best = fmin(best, rank_loss(m, c, k, measure));
			for (int how = 0; how < KNOWING; how++) {
				t = rank_recommended(
					lobe_recommend_answer(sums[how], surface, costs_of(m, c, measure)));
				of->loss[how][probe][of->cells[probe]] = rank_loss(m, c, t, measure) / best;
			}
			of->of_default[of->cells[0] + of->cells[1]] =
				rank_loss(m, c, RANK_DEFAULT, measure) / rank_loss(m, c, t, measure);
			of->unbeaten += (size_t)rank_unbeaten(m, c, t, measure, BLIND);
			of->cells[probe]++;
		}
	}
}

double rank_within(const double *values, size_t n, double limit)
{
	double k = 0.0;
	for (size_t i = 0; i < n; i++)
		k += values[i] <= limit;
	return n ? 100.0 * k / (double)n : (double)NAN;
}
