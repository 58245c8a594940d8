/* strategies.c - the ways to sample a microfacet lobe against each other: time, variance of the weight, samples thrown
 * away, and what they come to: how much variance a second of one thread removes.
 *
 * A white GGX mirror (F = 1), height-correlated, by each strategy of microfacet/strategy.h, for some widths and views.
 * The weight's mean is the same for all of them. Time is that of lobe_microfacet_conductor_sample called one point
 * after another, weight and pdf included, with the dispatch that all of them pay; efficiency is 1/(variance time). What
 * the best of them costs in a lobe of its own: bench/throughput.c.
 *
 *	strategies [--quick] [--csv FILE] */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "lobe/lobe.h"
#include "lobe/recommend.h"
#include "machine.h"
#include "report/strategies_names.h"
#include "timing.h"

enum { STRATEGIES = LOBE_STRATEGY_LAST + 1, RUNS = 7 };

static const char *const names[STRATEGIES] = {STRATEGIES_NAMES};

typedef struct {
	double ns, spread, mean, variance, rejected, efficiency;
} result;

static volatile float keep;

static double time_once(lobe_microfacet_conductor p, lobe_vec3 wo, uint32_t n)
{
	float sum = 0.0f;
	const double start = bench_now();
	for (uint32_t i = 0; i < n; i++) {
		const lobe_sample s = lobe_microfacet_conductor_sample(p, wo, lobe_recommend_u(i));
		sum += s.pdf + s.weight.g;
	}
	keep = sum;
	return bench_now() - start;
}

/* Variances are those of independent samples, though the points are a lattice's: they are averages over the cube. */
static result measure(lobe_microfacet_conductor p, lobe_vec3 wo, uint32_t n)
{
	double seconds[RUNS], sum = 0.0, sum2 = 0.0, none = 0.0;
	result r;
	for (int k = 0; k < RUNS; k++)
		seconds[k] = time_once(p, wo, n);
	for (uint32_t i = 0; i < 4u * n; i++) {
		const lobe_sample s = lobe_microfacet_conductor_sample(p, wo, lobe_recommend_u(i));
		const double w = (double)s.weight.g;
		sum += w;
		sum2 += w * w;
		none += s.event == 0u;
	}
	const bench_stats stats = bench_stats_of(seconds, RUNS);
	r.ns = 1e9 * stats.median / n;
	r.spread = bench_spread(&stats);
	r.mean = sum / (4.0 * n);
	r.variance = sum2 / (4.0 * n) - r.mean * r.mean;
	r.rejected = none / (4.0 * n);
	r.efficiency = 1e3 / (r.variance * r.ns);
	return r;
}

int main(int argc, char **argv)
{
	static const float alphas[] = {0.05f, 0.25f, 0.5f, 1.0f};
	static const float cosines[] = {0.95f, 0.5f, 0.1f};
	const char *csv_path = "out/bench/strategies.csv";
	uint32_t n = 1u << 17;
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--quick") == 0)
			n = 1u << 12;
		else if (strcmp(argv[i], "--csv") == 0 && i + 1 < argc)
			csv_path = argv[++i];
		else {
			fprintf(stderr, "usage: strategies [--quick] [--csv FILE]\n");
			return 2;
		}
	}
	FILE *const csv = bench_create_file(csv_path);
	if (!csv)
		return 1;
	fputs("alpha,cos_o,strategy,ns_per_sample,spread_percent,mean,variance,rejected,efficiency_per_us,"
	      "efficiency_of_cap\n",
	      csv);
	printf("\nSampling strategies: a white GGX mirror, one thread, one sample after another. variance: of the "
	       "weight.\n"
	       "rejected: samples below the surface. efficiency: 1/(variance time); of cap: over that of the cap of "
	       "2023.\n\n");
	printf("%5s %5s  %-17s %8s %7s %8s %10s %9s %11s %8s\n", "alpha", "cos", "strategy", "time", "spread", "mean",
	       "variance", "rejected", "efficiency", "of cap");
	printf("%5s %5s  %-17s %8s %7s %8s %10s %9s %11s %8s\n", "", "", "", "ns", "%", "", "", "%", "1/us", "x");
	for (size_t a = 0; a < sizeof alphas / sizeof *alphas; a++)
		for (size_t c = 0; c < sizeof cosines / sizeof *cosines; c++) {
			const lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
									   lobe_linear_stretch(alphas[a], alphas[a]));
			const lobe_fresnel_model white = lobe_fresnel_model_constant(lobe_rgb_make(1.0f, 1.0f, 1.0f));
			const lobe_vec3 wo = lobe_vec3_make(sqrtf(1.0f - cosines[c] * cosines[c]), 0.0f, cosines[c]);
			result r[STRATEGIES];
			for (lobe_uint k = 0; k < STRATEGIES; k++)
				r[k] = measure(lobe_microfacet_conductor_make(s, white, k), wo, n);
			for (lobe_uint k = 0; k < STRATEGIES; k++) {
				const double of_cap = r[k].efficiency / r[LOBE_STRATEGY_VISIBLE_CAP].efficiency;
				printf("%5.2f %5.2f  %-17s %8.1f %7.1f %8.4f %10.5f %9.2f %11.3f %8.3f\n",
				       (double)alphas[a], (double)cosines[c], names[k], r[k].ns, r[k].spread, r[k].mean,
				       r[k].variance, 100.0 * r[k].rejected, r[k].efficiency, of_cap);
				fprintf(csv, "%g,%g,%s,%.2f,%.2f,%.6f,%.6g,%.6f,%.6g,%.6g\n", (double)alphas[a],
					(double)cosines[c], names[k], r[k].ns, r[k].spread, r[k].mean, r[k].variance,
					r[k].rejected, r[k].efficiency, of_cap);
			}
		}
	if (fclose(csv) != 0) {
		fprintf(stderr, "strategies: %s: %s\n", csv_path, strerror(errno));
		return 1;
	}
	printf("\n%s\n", csv_path);
	return 0;
}
