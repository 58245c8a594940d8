/* approximations_time.c - time of a call of every way: in a loop that vectorises, one by one, and as
 * an OpenCL kernel. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../timing.h"
#include "approximations.h"
#include "approximations_lobes.h"
#include "csv.h"
#include "lobe/lobe.h"
#include "support.h"

/* Elements of a loop: all arrays together stay in the first two caches. */
enum { LENGTH = 2048, DEVICE_LENGTH = 1 << 18, REPEATS_MAX = 31 };

static double profile(void *context, double t)
{
	(void)context;
	return 1.0 / ((1.0 + t * t) * (1.0 + t * t));
}

static approximations_set set_make(float *table)
{
	approximations_set p;
	memset(&p, 0, sizeof p);
	p.surface = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
					   lobe_linear_make(0.4f, 0.0f, 0.0f, 0.4f, 0.0f, 0.0f));
	if (lobe_distribution_tabulated(&p.surface.distribution, table, LOBE_PROFILE_WORDS, profile, NULL) != LOBE_OK)
		fprintf(stderr, "report: %s\n", lobe_error_message());
	p.n = lobe_metal_eta(LOBE_METAL_TITANIUM);
	p.k = lobe_metal_k(LOBE_METAL_TITANIUM);
	p.film = lobe_film_make(400.0f, 1.5f);
	p.f0 = 0.5f;
	p.depth = 0.1f;
	p.exponent = 5.5f;
	p.general = 0.05f;
	p.edge = 0.4f;
	return p;
}

/* Arguments in the middle of each group's domain. */
static void inputs(approximations_group group, size_t n, float *const in[APPROXIMATIONS_IN])
{
	for (size_t i = 0; i < n; i++) {
		float o[3], w[3], u[3];
		test_u3(81, i, u);
		test_direction(82, i, o);
		test_direction(83, i, w);
		in[3][i] = u[1];
		in[4][i] = u[2];
		switch (group) {
		case GROUP_LAMBDA:
			in[0][i] = 0.3f + u[0];
			in[1][i] = 0.05f + 0.95f * u[1];
			break;
		case GROUP_MASKING:
		case GROUP_ACROSS:
			in[0][i] = fabsf(o[2]) + 1e-3f;
			in[1][i] = hypotf(o[0], o[1]);
			in[2][i] = fabsf(w[2]) + 1e-3f;
			in[3][i] = w[0];
			in[4][i] = w[1];
			break;
		case GROUP_DENSITY:
		case GROUP_HIDDEN:
		case GROUP_VISIBLE:
			in[0][i] = o[0];
			in[1][i] = o[1];
			in[2][i] = fabsf(o[2]) + 1e-3f;
			break;
		default: /* cosines, and the arguments of functions */
			in[0][i] = fminf(u[0] + 1e-4f, 0.999f);
			in[1][i] = u[1];
			in[2][i] = u[2];
		}
	}
}

static void row(report_rows *rows, const char *group, const char *name, const char *loop, double *seconds, int n,
		double calls)
{
	const bench_stats s = bench_stats_of(seconds, (size_t)n);
	report_row(rows, "%s,%s,%s,%.4g,%.4g,%.4g,%.4g", group, name, loop, 1e9 * s.median / calls, 1e9 * s.low / calls,
		   1e9 * s.high / calls, 1e9 * s.min / calls);
}

/* calls: rounds over the arrays that last long enough for the clock. */
static void time_loop(report_rows *rows, const approximations_way *way, int vector, const approximations_set *p,
		      float *const in[APPROXIMATIONS_IN], float *const out[APPROXIMATIONS_OUT], int quick)
{
	const approximations_loop loop = vector ? way->vector : way->scalar;
	const float *const from[APPROXIMATIONS_IN] = {in[0], in[1], in[2], in[3], in[4]};
	double seconds[REPEATS_MAX];
	const int repeats = quick ? 9 : REPEATS_MAX;
	double last = 0.0;
	int calls = 1;
	for (;; calls *= 2) {
		const double start = bench_now();
		for (int i = 0; i < calls; i++)
			loop(p, LENGTH, from, out);
		last = bench_now() - start;
		if (last > (quick ? 5e-4 : 2e-3))
			break;
	}
	for (int r = 0; r < repeats; r++) {
		const double start = bench_now();
		for (int i = 0; i < calls; i++)
			loop(p, LENGTH, from, out);
		seconds[r] = bench_now() - start;
	}
	row(rows, approximations_groups[way->group], way->name, vector ? "vector" : "scalar", seconds, repeats,
	    (double)calls * LENGTH);
}

static void native(int quick, report_rows *rows)
{
	float *memory = report_alloc(NULL, (LOBE_PROFILE_WORDS + 8 * LENGTH) * sizeof *memory);
	float *in[APPROXIMATIONS_IN], *out[APPROXIMATIONS_OUT];
	const approximations_set p = set_make(memory);
	for (size_t k = 0; k < APPROXIMATIONS_IN; k++)
		in[k] = memory + LOBE_PROFILE_WORDS + k * LENGTH;
	for (size_t k = 0; k < APPROXIMATIONS_OUT; k++)
		out[k] = memory + LOBE_PROFILE_WORDS + (APPROXIMATIONS_IN + k) * LENGTH;
	for (size_t w = 0; w < approximations_way_count(); w++) {
		inputs(approximations_ways[w].group, LENGTH, in);
		time_loop(rows, &approximations_ways[w], 1, &p, in, out, quick);
		time_loop(rows, &approximations_ways[w], 0, &p, in, out, quick);
	}
	free(memory);
}

static int on_device(int quick, report_rows *rows)
{
	approximations_device *device = approximations_device_open();
	const int repeats = quick ? 7 : REPEATS_MAX;
	int failed = 0;
	if (!device)
		return 0;
	float *memory = report_alloc(NULL, (LOBE_PROFILE_WORDS + 5 * (size_t)DEVICE_LENGTH) * sizeof *memory);
	approximations_set p = set_make(memory);
	p.surface.distribution = lobe_distribution_make(LOBE_NDF_GGX);
	float *in[APPROXIMATIONS_IN], *out[APPROXIMATIONS_OUT] = {NULL, NULL, NULL};
	const float *from[APPROXIMATIONS_IN];
	for (size_t k = 0; k < APPROXIMATIONS_IN; k++)
		from[k] = in[k] = memory + LOBE_PROFILE_WORDS + k * DEVICE_LENGTH;
	for (size_t w = 0; w < approximations_way_count() + approximations_builtin_count() && !failed; w++) {
		const int own = w < approximations_way_count();
		const approximations_builtin *builtin =
			&approximations_builtins[own ? 0 : w - approximations_way_count()];
		const approximations_way *way = &approximations_ways[own ? w : 0];
		double seconds[REPEATS_MAX + 2];
		if (own && !way->text)
			continue;
		inputs(own ? way->group : GROUP_REAL, DEVICE_LENGTH, in);
		failed = approximations_device_run(device, own ? way->id : builtin->id, &p, DEVICE_LENGTH, from, out,
						   repeats + 2, seconds);
		/* The first builds the kernel, the second warms it up. */
		if (!failed)
			row(rows, own ? approximations_groups[way->group] : "real", own ? way->name : builtin->name,
			    "opencl", seconds + 2, repeats, DEVICE_LENGTH);
	}
	free(memory);
	approximations_device_close(device);
	return failed;
}

/* Lobes by precision: a call of each verb. */
static void lobes(int quick, report_rows *rows)
{
	const int repeats = quick ? 5 : REPEATS_MAX;
	for (size_t l = 0; l < approximations_lobe_count; l++)
		for (int precision = 0; precision < 2; precision++)
			for (int verb = 0; verb < 3; verb++)
				for (int vector = 0; vector < 2; vector++) {
					char name[96];
					double seconds[REPEATS_MAX];
					const approximations_timer timer =
						precision ? approximations_double_time : approximations_single_time;
					double calls = 0.0;
					for (int r = 0; r < repeats; r++)
						seconds[r] = timer(l, verb, vector, quick ? 1 : 4, &calls);
					snprintf(name, sizeof name, "%s/%s/%s", approximations_lobe_names[l],
						 approximations_verbs[verb], precision ? "double" : "single");
					row(rows, "precision", name, vector ? "vector" : "scalar", seconds, repeats,
					    calls);
				}
}

static size_t units(int quick)
{
	(void)quick;
	approximations_film_nodes();
	return 3;
}

static int run(int quick, size_t unit, report_rows *rows)
{
	if (unit == 0)
		native(quick, rows);
	else if (unit == 1)
		return on_device(quick, rows);
	else
		lobes(quick, rows);
	return 0;
}

const report_study approximations_time_study = {
	.name = "approximations_time",
	.columns = "group,name,loop,ns,ns_low,ns_high,ns_min",
	.timed = 1,
	.units = units,
	.run = run,
};
