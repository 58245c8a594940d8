/* strategies_holdout.c - lobe_recommend_strategy asked about cases that it was not tuned on: widths, stretch, angles
 * and lights drawn at random, and the probes from random sides.
 *
 * Case i is a function of i alone. Its lights by turns: a disk anywhere, a disk near the highlight, a disk with a sky,
 * a glow, a sky, and a probe where there is one. Disks are of .15 to 45 degrees; near: off by about the lobe's
 * width. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "pi.h"
#include "random.h"
#include "strategies_rank.h"

enum { DISK, NEAR, DISK_AND_SKY, GLOW, SKY, PROBE, KINDS };
static const char *const kinds[KINDS] = {"disk", "disk near the highlight", "disk and sky", "glow", "sky", "probe"};

enum { OF_ALPHA, OF_STRETCH, OF_COSINE, OF_AZIMUTH, OF_NDF, OF_SIZE, OF_Z, OF_TURN, OF_SHARE, OF_SLOPE, OF_PROBE };

static double draw(size_t i, uint32_t use)
{
	const struct random_key key = {23, (uint32_t)i, 0, 0};
	return (double)random_plain(key, 16 + use); /* beyond the uses of random.h */
}

static double logarithmic(size_t i, uint32_t use, double from, double to)
{
	return from * pow(to / from, draw(i, use));
}

static lobe_vec3 direction(double z, double phi)
{
	const double r = sqrt((1.0 - z) * (1.0 + z));
	return lobe_vec3_make((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z);
}

/* The mirror image of the viewer, moved by about the lobe's width; above the horizon. */
static lobe_vec3 near_highlight(lobe_vec3 wo, double alpha, double u, double v)
{
	const double off = 2.0 * alpha * sqrt(u);
	const lobe_vec3 d = lobe_normalize(lobe_vec3_make(-wo.x + (float)(off * cos(2.0 * PI * v)),
							  -wo.y + (float)(off * sin(2.0 * PI * v)), wo.z));
	return lobe_vec3_make(d.x, d.y, lobe_max(d.z, 0.01f));
}

static strategies_part part(int kind, double share, double a, double b, lobe_vec3 axis)
{
	const strategies_part p = {kind,     STRATEGIES_FIXED, (float)share,
				   (float)a, (float)b,         lobe_frame_from_normal(lobe_normalize(axis))};
	return p;
}

static void light_up(strategies_case *c, size_t i, int kind)
{
	const lobe_vec3 any = direction(draw(i, OF_Z), 2.0 * PI * draw(i, OF_TURN));
	const double half = sin(0.5 * logarithmic(i, OF_SIZE, 0.15, 45.0) / 180.0 * PI), height = 2.0 * half * half;
	const double slope = -2.0 / 3.0 + draw(i, OF_SLOPE) * 8.0 / 3.0, share = 0.2 + 0.78 * draw(i, OF_SHARE);
	strategies_light *const l = &c->light;
	if (kind == PROBE) {
		*l = strategies_light_at(strategies_analytic_lights() +
						 (size_t)(draw(i, OF_PROBE) * (double)(strategies_lights(0) -
										       strategies_analytic_lights())),
					 c->wo);
		return;
	}
	memset(l, 0, sizeof *l);
	l->parts = 1;
	switch (kind) {
	case NEAR:
		l->part[0] = part(STRATEGIES_CONE, 1.0, height, 0.0,
				  near_highlight(c->wo, c->alpha, draw(i, OF_Z), draw(i, OF_TURN)));
		break;
	case GLOW:
		l->part[0] = part(STRATEGIES_GLOW, 1.0, logarithmic(i, OF_SIZE, 1.0, 300.0), 0.0, any);
		/* As lobe/recommend.h counts its solid angle. */
		l->solid_angle = 4.0 * PI * (2.0 * (double)l->part[0].a + 1.0) / pow((double)l->part[0].a + 1.0, 2.0);
		break;
	case SKY:
		l->part[0] = part(STRATEGIES_SKY, 1.0, 1.0, slope, any);
		break;
	default:
		l->part[0] = part(STRATEGIES_CONE, kind == DISK ? 1.0 : share, height, 0.0, any);
		l->part[1] = part(STRATEGIES_SKY, 1.0 - share, 1.0, slope, any);
		l->parts = 1 + (kind == DISK_AND_SKY);
		break;
	}
}

static strategies_case make(size_t i, int kind, double *across)
{
	strategies_case c;
	memset(&c, 0, sizeof c);
	const double z = 0.02 + 0.98 * draw(i, OF_COSINE);
	c.material = draw(i, OF_NDF) < 0.7 ? STRATEGIES_GGX : STRATEGIES_BECKMANN;
	c.alpha = logarithmic(i, OF_ALPHA, 1e-3, 1.0);
	c.cosine = z;
	*across = draw(i, OF_STRETCH) < 0.5 ? c.alpha : fmax(c.alpha * pow(8.0, 1.0 - 2.0 * draw(i, OF_STRETCH)), 1e-4);
	c.wo = direction(z, 2.0 * PI * draw(i, OF_AZIMUTH));
	const lobe_microsurface s = lobe_microsurface_make(
		lobe_distribution_make(c.material == STRATEGIES_BECKMANN ? LOBE_NDF_BECKMANN : LOBE_NDF_GGX),
		lobe_linear_stretch((float)c.alpha, (float)*across));
	const lobe_fresnel_model gold =
		lobe_fresnel_model_conductor(lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD));
	for (lobe_uint k = 0; k <= LOBE_STRATEGY_LAST; k++)
		c.lobe[k] = lobe_microfacet_conductor_make(s, gold, k);
	light_up(&c, i, kind);
	return c;
}

static size_t units(int quick)
{
	strategies_lights(quick);
	return quick ? 12 : 100;
}

static double loss_of(const strategies_moments *m, int technique)
{
	return fmax(m->variance[technique], 1e-300) * (technique >= STRATEGIES_BALANCE ? 2.0 : 1.0);
}

static int run(int quick, size_t unit, report_rows *rows)
{
	for (int kind = 0; kind < KINDS; kind++) {
		double across, best = HUGE_VAL;
		if (kind == PROBE && strategies_lights(quick) == strategies_analytic_lights())
			continue;
		const strategies_case c = make(unit * KINDS + (size_t)kind, kind, &across);
		const strategies_moments m = strategies_moments_of(&c, quick ? 1024 : 4096, 8, 2u);
		const lobe_microsurface surface = c.lobe[LOBE_STRATEGY_VISIBLE].surface;
		const lobe_recommend_cost cost = lobe_recommend_cost_samples();
		const lobe_recommendation told =
			lobe_recommend_strategy(surface, c.wo, strategies_shape(&c.light), cost);
		const lobe_recommendation asking = lobe_recommend_answer(strategies_asked(&c), surface, cost);
		const lobe_recommendation *const r = kind == PROBE ? &asking : &told;
		const int t = rank_recommended(*r), by_shape = rank_recommended(told), asked = rank_recommended(asking);
		int winner = 0;
		for (int k = 0; k < STRATEGIES_TECHNIQUES; k++) {
			const double loss = loss_of(&m, k);
			if (loss < best) {
				best = loss;
				winner = k;
			}
		}
		report_row(rows, "%s,%s,%.4g,%.4g,%.4g,%.7g,%s,%s,%.5g,%s,%.5g,%.5g,%.5g,%.5g", kinds[kind],
			   strategies_ndf(c.material) ? "Beckmann" : "GGX", c.alpha, across, c.cosine, m.mean,
			   strategies_name(winner), strategies_name(by_shape), loss_of(&m, by_shape) / best,
			   strategies_name(asked), loss_of(&m, asked) / best,
			   loss_of(&m, strategies_default(c.material)) / loss_of(&m, t),
			   sqrt(fmax(m.variance[t], 0.0)) / m.mean, (double)r->deviation);
	}
	return 0;
}

const report_study strategies_holdout_study = {
	"strategies_holdout",
	"light,ndf,alpha_x,alpha_y,cosine,mean,best,told,told_over_best,asking,asking_over_best,default_over_it,"
	"deviation,"
	"expected_deviation",
	0,
	units,
	run,
	strategies_settings,
};

/* --- what the rows say ---------------------------------------------------------------------------------------------- */

/* Rows of a kind, or with KINDS all: losses over the best's, told and asking; the default's over it; deviations off. */
enum { MOST = 1024 };
typedef struct {
	double told[MOST], asking[MOST], gain[MOST], off[MOST];
	size_t n, offs;
} answers;

static void gather(const report_table *t, int kind, answers *a)
{
	a->n = a->offs = 0;
	for (size_t i = 0; i < report_table_rows(t) && a->n < MOST; i++) {
		if ((kind < KINDS && strcmp(report_cell(t, i, "light"), kinds[kind]) != 0) ||
		    !(report_number(t, i, "mean") > 1e-25))
			continue;
		const double deviation = report_number(t, i, "deviation");
		a->told[a->n] = report_number(t, i, "told_over_best");
		a->asking[a->n] = report_number(t, i, "asking_over_best");
		if (deviation > 1e-2)
			a->off[a->offs++] = fabs(report_number(t, i, "expected_deviation") / deviation - 1.0);
		a->gain[a->n++] = report_number(t, i, "default_over_it");
	}
}

void strategies_write_holdout(report_page *page, const report_table *t)
{
	static answers a;
	report_text(page, "**Asked about what it was not tuned on** (widths from .001 to 1, stretched up to 8:1, views "
			  "and lights at "
			  "random):\n\n"
			  "| light | cases | told a shape: within 5 %% | 20 %% | a factor of 2 | worst | asking the "
			  "light: within 5 %% "
			  "| 20 %% | a factor of 2 | worst | samples saved over the default, median "
			  "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
	for (int kind = 0; kind <= KINDS; kind++) {
		gather(t, kind, &a);
		if (!a.n)
			continue;
		report_text(page, "| %s | %zu |", kind < KINDS ? kinds[kind] : "all", a.n);
		for (int how = 0; how < KNOWING; how++) {
			double *const loss = how == TOLD ? a.told : a.asking;
			report_text(page, " %.1f %% | %.1f %% | %.1f %% | %.3g |", rank_within(loss, a.n, 1.05),
				    rank_within(loss, a.n, 1.2), rank_within(loss, a.n, 2.0),
				    rank_quantile(loss, a.n, 1.0));
		}
		report_text(page, " %.3g |\n", rank_quantile(a.gain, a.n, 0.5));
	}
	report_text(page,
		    "\nThe standard deviation that it expects (told a shape, of probes asking) is off by %.1f %% at "
		    "the median "
		    "and %.0f %% at the 90th percentile, where it is over a hundredth of the mean.\n\n",
		    100.0 * rank_quantile(a.off, a.offs, 0.5), 100.0 * rank_quantile(a.off, a.offs, 0.9));
	const double p = rank_within(a.asking, a.n, 1.05);
	report_finding(
		page,
		"On %zu cases drawn at random, which it was not tuned on (surfaces, views and analytic lights; the "
		"map's probes from random sides), `lobe_recommend_strategy` asking the light "
		"is "
		"within 5 %% of the best technique in %.1f %% (+- %.1f, 95 %%) and within a factor of 2 in %.1f %%, at "
		"worst off by a "
		"factor of %.3g; told a shape %.1f %% and %.1f %%",
		a.n, p, 1.96 * sqrt(p * (100.0 - p) / (double)a.n), rank_within(a.asking, a.n, 2.0),
		rank_quantile(a.asking, a.n, 1.0), rank_within(a.told, a.n, 1.05), rank_within(a.told, a.n, 2.0));
}
