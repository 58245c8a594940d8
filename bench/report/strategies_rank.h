/* strategies_rank.h - the map read back, and which technique is how good where.
 *
 * Efficiency is 1/(variance cost), where the cost of a sample is either a direction (SAMPLES), or the time that the
 * comparison lobe takes for it with the light's lookup, one sample after another on one thread (TIME), or that and a ray
 * for each direction (RAY). */
#ifndef LOBE_REPORT_STRATEGIES_RANK_H
#define LOBE_REPORT_STRATEGIES_RANK_H

#include "strategies.h"

enum { LIGHTS_MAX = 32, SAMPLES = 0, TIME = 1, RAY = 2, MEASURES = 3 };

/* What production lobes do, by material: the bounded cap for GGX, visible normals for Beckmann. Where a strategy is asked
 * for below, this may stand for one. */
enum { RANK_DEFAULT = -1 };

/* A ray, in ns. */
#define RANK_RAY 300.0

/* What ties: within 2 %, or within what is known of the two - two standard deviations of the integrals, 5 % at most,
 * and the spread of the times. Strategies of one density have one variance (strategies_moments.c) and tie in it. */
#define RANK_TIE 1.02

/* Among whom: strategies that draw facets of the lobe, or all that know nothing of the light, uniform and cosine
 * too. */
enum { FOLLOWING, BLIND, AMONG };

typedef struct {
	int material;
	size_t light, alpha, cosine; /* of the grids */
	double mean, variance[STRATEGIES_TECHNIQUES], error[STRATEGIES_TECHNIQUES];
} rank_cell;

typedef struct {
	int quick;
	size_t count;
	rank_cell *cell;
	/* In ns, by distribution and light; half the range given with it, relative. */
	double time[2][LIGHTS_MAX][STRATEGIES_TECHNIQUES], noise[2][LIGHTS_MAX][STRATEGIES_TECHNIQUES];
} rank_map;

/* From the studies' rows. */
void rank_read(rank_map *m, int quick, const report_table *rows, const report_table *times);

typedef struct {
	double all, turn, cells, turns; /* shares in percent, and of how many */
} rank_share;

/* Where a strategy is beaten, by its best rival there: factors of loss, and where that is, sorted; by rival. */
typedef struct {
	size_t cells;
	double median, worst, alpha[2], cosine[2]; /* 10 and 90 % quantiles */
} rank_defeat;

/* lobe_recommend_strategy told the light's shape, or asking the light itself. */
enum { TOLD, ASKING, KNOWING };

/* Loss over the best's of what is recommended in every cell that is not dark, by how and by analytic lights and
 * probes. */
typedef struct {
	double *loss[KNOWING][2]; /* [cells] */
	size_t cells[2];
	/* Asking: the default's loss over the recommended one's, and cells in which that is unbeaten among BLIND. */
	double *of_default;
	size_t unbeaten;
} rank_regrets;

int rank_strategy(const rank_cell *c, int k);

/* Of their names. */
int rank_technique(const char *name);
size_t rank_light(const rank_map *m, const char *name);
int rank_material(const char *name);

/* What is minimal for the best. */
double rank_loss(const rank_map *m, const rank_cell *c, int k, int measure);

/* Light that does not reach the viewer: all techniques find 0. */
int rank_dark(const rank_cell *c);

/* The first of the default, VISIBLE and the rest that is as good as the best. techniques: how many are looked at. */
int rank_winner(const rank_map *m, const rank_cell *c, int techniques, int measure);

int rank_is_among(int strategy, int among);

/* Technique k, any, is at least as efficient as each of them, or what it lacks is within the tie. */
int rank_unbeaten(const rank_map *m, const rank_cell *c, int k, int measure, int among);

/* The most efficient of them. */
int rank_best(const rank_map *m, const rank_cell *c, int measure, int among);

/* Of k by rival; light: of the grid, or -1 for all; rival: or -1 for any. */
rank_defeat rank_defeat_of(const rank_map *m, int k, int measure, int among, int light, int rival);

/* Of cells where k is unbeaten. ndf: as strategies_ndf, or -1 for all. */
rank_share rank_share_of(const rank_map *m, int k, int measure, int among, int ndf);

/* The strategy of those that is unbeaten in most cells: no fixed one of them does better than its share. */
int rank_most(const rank_map *m, int measure, int among, double *share);

/* The share that the best choice by material, roughness and view cosine reaches: what no choice that is blind to the
 * light can surpass. In percent. */
double rank_most_by_view(const rank_map *m, int measure, int among);

double rank_quantile(double *values, size_t n, double q);

/* STRATEGIES_* of what is recommended. */
int rank_recommended(lobe_recommendation r);

/* r: with room for as many cells as the map has, in each of its arrays. */
void rank_recommend(const rank_map *m, rank_regrets r[MEASURES]);

double rank_within(const double *values, size_t n, double limit);

/* strategies_default.c: the default among the strategies that know nothing of the light. */
void strategies_write_default(report_page *page, const rank_map *m);

/* strategies_recommended.c: how lobe_recommend_strategy does on the map. */
void strategies_write_recommended(report_page *page, const rank_map *m);

/* strategies_holdout.c: how lobe_recommend_strategy does on cases that it was not tuned on. */
void strategies_write_holdout(report_page *page, const report_table *t);

/* strategies_plot.c: figures of the map and of the error curves, and what the latter say. */
void strategies_write_maps(report_page *page, const rank_map *m);
void strategies_write_curves(report_page *page, const rank_map *m, const report_table *t);

#endif
