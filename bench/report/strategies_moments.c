/* strategies_moments.c - mean and variance of every technique as integrals, without a sample of theirs.
 *
 * With X = f L |cos| the second moment of a technique of density p is the integral of X^2/p, and those of the
 * heuristics are sums of such integrals, so that one set of points serves all techniques. Half of the points follow the
 * lobe and half the light, combined by the power heuristic: where the lobe is narrow or the light small some of them
 * are there, whichever technique is in question. Points are Owen-scrambled; as many randomisations as are asked for
 * tell the error.
 *
 * Where a weight hardly varies, second moment and square of the mean agree in all digits that the points are good for.
 * Then the integral of p itself, which has the same error and is known to be 1 less the share of samples without
 * direction, takes it away: M - 2 I^2 + I^2 (P + rejected) is the integral of (X/p - I)^2 p, of rejected samples
 * too. */
#include <math.h>
#include <string.h>

#include "random.h"
#include "strategies.h"

enum { RUNS_MAX = 16, DENSITIES = STRATEGIES_LIGHT + 1, MIXED = STRATEGIES_TECHNIQUES - STRATEGIES_BALANCE };

/* Integrals over one randomisation. Of MIS: both parts' second moments, and the mean of each part. */
typedef struct {
	double mean, second[DENSITIES], mass[DENSITIES], rejected[DENSITIES];
	double both[MIXED], from_lobe[MIXED], mass_lobe[MIXED];
} integrals;

/* GGX's four ways to its visible normals have one density; Beckmann's own is another than the three borrowed ones. */
static int same_as(int material, int strategy)
{
	if (strategy == LOBE_STRATEGY_VISIBLE_CAP)
		return material == STRATEGIES_BECKMANN ? strategy : LOBE_STRATEGY_VISIBLE;
	if (strategy == LOBE_STRATEGY_VISIBLE_SLOPES || strategy == LOBE_STRATEGY_VISIBLE_ELLIPSOID)
		return material == STRATEGIES_BECKMANN ? LOBE_STRATEGY_VISIBLE_CAP : LOBE_STRATEGY_VISIBLE;
	return strategy;
}

/* X^2/p, 0 where there is nothing to see. */
static double squared(double x, double p) { return x > 0.0 && p > 0.0 ? x * x / p : 0.0; }

static void add_point(integrals *s, const strategies_case *c, lobe_vec3 wi, double light, lobe_rgb radiance,
		      int of_light, double scale)
{
	const strategies_compiled *const only = strategies_compiled_for(c);
	double pdf[DENSITIES];
	if (!(wi.z > 0.0f)) {
		/* Light from below: a sample of LIGHT and of nothing else. */
		s->mass[STRATEGIES_LIGHT] += scale;
		return;
	}
	const lobe_rgb f = lobe_microfacet_conductor_eval(c->lobe[LOBE_STRATEGY_VISIBLE], c->wo, wi);
	const double x =
		(double)strategies_luminance(lobe_rgb_make(f.r * radiance.r, f.g * radiance.g, f.b * radiance.b));
	for (int k = 0; k < STRATEGIES_LIGHT; k++)
		if (same_as(c->material, k) == k)
			pdf[k] = (double)only->pdf[k](c, wi);
	pdf[STRATEGIES_LIGHT] = light;
	const double visible = pdf[LOBE_STRATEGY_VISIBLE];
	if (!((of_light ? light : visible) > 0.0))
		return;
	/* Over the point's own density; by the ratio, for squares may leave the range of a double. */
	const double own = of_light ? light : visible, ratio = of_light ? visible / light : light / visible;
	const double w = scale / (own * (1.0 + ratio * ratio));
	s->mean += w * x;
	for (int k = 0; k < DENSITIES; k++)
		if (same_as(c->material, k) == k) {
			s->second[k] += w * squared(x, pdf[k]);
			s->mass[k] += w * pdf[k];
		}
	for (int m = 0; m < MIXED; m++) {
		const int technique = STRATEGIES_BALANCE + m;
		const double b = pdf[technique == STRATEGIES_BALANCE_BOUNDED ? LOBE_STRATEGY_BOUNDED_CAP
									     : LOBE_STRATEGY_VISIBLE];
		/* Weight of the lobe's direction; the power heuristic by the ratio. */
		const double r = technique == STRATEGIES_POWER ? (light / b) * (light / b) : light / b;
		const double of_lobe = b > 0.0 ? 1.0 / (1.0 + r) : 0.0;
		const double rest = 1.0 - of_lobe;
		s->both[m] += w * (squared(of_lobe * x, b) + squared(rest * x, light));
		s->from_lobe[m] += w * of_lobe * x;
	}
}

static integrals integrate(const strategies_case *c, uint32_t n, uint32_t run, uint32_t seed)
{
	const strategies_compiled *const only = strategies_compiled_for(c);
	integrals s;
	const double scale = 1.0 / (double)n;
	memset(&s, 0, sizeof s);
	for (uint32_t i = 0; i < n; i++) {
		const struct random_key key = {seed, run, i, 0};
		float u[3], v[3], pdf;
		random_spread(key, RANDOM_LOBE, u);
		random_spread(key, RANDOM_LIGHT, v);
		const lobe_vec3 point = lobe_vec3_make(u[0], u[1], u[2]);
		for (int k = 0; k < STRATEGIES_LIGHT; k++) {
			if (same_as(c->material, k) != k)
				continue;
			const lobe_sample b = only->sample[k](c, point);
			s.rejected[k] += b.event ? 0.0 : scale;
			if (k == LOBE_STRATEGY_VISIBLE && b.event) {
				const lobe_rgb radiance = strategies_radiance(&c->light, b.wi, &pdf);
				add_point(&s, c, b.wi, (double)pdf, radiance, 0, scale);
			}
		}
		const struct light_sample l = strategies_draw(&c->light, v[0], v[1]);
		if (l.pdf > 0.0f)
			add_point(&s, c, l.wi, (double)l.pdf, l.radiance, 1, scale);
	}
	return s;
}

/* Points follow the density's own facets, so that its integral is known as well as the mean. */
static int covered(int material, int k)
{
	return k == LOBE_STRATEGY_VISIBLE || k == LOBE_STRATEGY_NDF || k == LOBE_STRATEGY_VCAVITY ||
	       k == STRATEGIES_LIGHT || (material != STRATEGIES_BECKMANN && k > LOBE_STRATEGY_COSINE);
}

static double variance(double second, double mean, double whole)
{
	const double square = mean * mean;
	return second > 2.0 * square ? second - square : second - 2.0 * square + square * whole;
}

static void variances(const integrals *s, int material, double out[STRATEGIES_TECHNIQUES])
{
	for (int k = 0; k < DENSITIES; k++) {
		const int d = same_as(material, k);
		out[k] = variance(s->second[d], s->mean, covered(material, d) ? s->mass[d] + s->rejected[d] : 1.0);
	}
	for (int m = 0; m < MIXED; m++) {
		const double b = s->from_lobe[m], l = s->mean - b;
		const int d = STRATEGIES_BALANCE + m == STRATEGIES_BALANCE_BOUNDED ? LOBE_STRATEGY_BOUNDED_CAP
										   : LOBE_STRATEGY_VISIBLE;
		const double square = b * b + l * l;
		out[STRATEGIES_BALANCE + m] =
			s->both[m] > 2.0 * square
				? s->both[m] - square
				: s->both[m] - 2.0 * square + l * l * s->mass[STRATEGIES_LIGHT] +
					  b * b * (covered(material, d) ? s->mass[d] + s->rejected[d] : 1.0);
	}
}

strategies_moments strategies_moments_of(const strategies_case *c, uint32_t n, uint32_t runs, uint32_t seed)
{
	integrals all, one;
	double v[RUNS_MAX][STRATEGIES_TECHNIQUES], mean[RUNS_MAX];
	strategies_moments r;
	double *const sums = (double *)&all;
	memset(&all, 0, sizeof all);
	for (uint32_t k = 0; k < runs; k++) {
		one = integrate(c, n, k, seed);
		mean[k] = one.mean;
		variances(&one, c->material, v[k]);
		for (size_t i = 0; i < sizeof all / sizeof *sums; i++)
			sums[i] += ((const double *)&one)[i] / runs;
	}
	r.mean = all.mean;
	variances(&all, c->material, r.variance);
	r.mean_error = 0.0;
	for (uint32_t k = 0; k < runs; k++)
		r.mean_error += (mean[k] - r.mean) * (mean[k] - r.mean) / (runs * (runs - 1.0));
	r.mean_error = sqrt(r.mean_error);
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++) {
		double sum = 0.0;
		for (uint32_t k = 0; k < runs; k++)
			sum += (v[k][t] - r.variance[t]) * (v[k][t] - r.variance[t]) / (runs * (runs - 1.0));
		r.error[t] = sqrt(sum);
	}
	return r;
}
