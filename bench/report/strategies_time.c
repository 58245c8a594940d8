/* strategies_time.c - what a sample costs: one after another on one thread, and in batches on each device.
 *
 * All techniques are timed in rounds, one after another, and the least of the rounds is a technique's time, for other
 * programs on the machine only add to it. The range given with it takes the lower quartile in the place of the least.
 * The time of an estimate has everything but the random numbers, which are read from a small table: sample, light,
 * product. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../timing.h"
#include "random.h"
#include "strategies.h"

enum { POINTS = 1024, ROUNDS_MAX = 31, TIMED = STRATEGIES_TECHNIQUES + 1, PRODUCTION = STRATEGIES_TECHNIQUES };

static volatile float keep;

typedef struct {
	double of[TIMED][ROUNDS_MAX];
} rounds;

static const char *timed_name(int t) { return t == PRODUCTION ? "production lobe" : strategies_name(t); }

static double time_once(const strategies_case *c, int technique, const float (*u)[6], int repeat)
{
	const lobe_rough_conductor p = strategies_production(c->material, (float)c->alpha);
	const strategies_compiled *const only = strategies_compiled_for(c);
	float sum = 0.0f;
	const double start = bench_now();
	for (int k = 0; k < repeat; k++)
		for (int i = 0; i < POINTS; i++)
			sum += technique == PRODUCTION ? strategies_estimate_production(c, &p, u[i])
						       : only->estimate[technique](c, u[i], u[i] + 3);
	keep = sum;
	return 1e9 * (bench_now() - start) / ((double)repeat * POINTS);
}

static void fill(float (*u)[6])
{
	for (uint32_t i = 0; i < POINTS; i++) {
		const struct random_key key = {5, 0, i, 0};
		random_spread(key, RANDOM_LOBE, u[i]);
		random_spread(key, RANDOM_LIGHT, u[i] + 3);
	}
}

/* GGX under every light, then Beckmann under some; brushed metal costs what GGX does. */
static size_t ggx_units(int quick) { return strategies_lights_of(quick, STRATEGIES_GGX); }
static size_t units(int quick) { return ggx_units(quick) + strategies_lights_of(quick, STRATEGIES_BECKMANN); }

static int run(int quick, size_t unit, report_rows *rows)
{
	static const double alphas[] = {0.03, 0.5}, cosines[] = {0.7, 0.3};
	static float u[POINTS][6];
	static rounds r;
	const int material = unit < ggx_units(quick) ? STRATEGIES_GGX : STRATEGIES_BECKMANN;
	const size_t light =
		material == STRATEGIES_GGX ? unit : strategies_light_of(quick, material, unit - ggx_units(quick));
	const int count = quick ? 11 : 25;
	const strategies_case c[2] = {strategies_case_make(material, alphas[0], cosines[0], light),
				      strategies_case_make(material, alphas[1], cosines[1], light)};
	fill(u);
	for (int k = -1; k < count; k++)
		for (int t = 0; t < TIMED; t++) {
			const double ns = 0.5 * (time_once(&c[0], t, (const float(*)[6])u, quick ? 2 : 4) +
						 time_once(&c[1], t, (const float(*)[6])u, quick ? 2 : 4));
			if (k >= 0) /* the first round warms up */
				r.of[t][k] = ns;
		}
	const bench_stats base = bench_stats_of(r.of[LOBE_STRATEGY_VISIBLE], (size_t)count);
	for (int t = 0; t < TIMED; t++) {
		const bench_stats q = bench_stats_of(r.of[t], (size_t)count);
		const double low = t == LOBE_STRATEGY_VISIBLE ? 1.0 : q.min / base.quarter1;
		const double high = t == LOBE_STRATEGY_VISIBLE ? 1.0 : q.quarter1 / base.min;
		report_row(rows, "%s,%s,%s,%.2f,%.2f,%.2f,%.4f,%.4f,%.4f", strategies_material_name(material),
			   c[0].light.name, timed_name(t), q.min, q.min, q.quarter1, q.min / base.min, low, high);
	}
	return 0;
}

const report_study strategies_time_study = {
	"strategies_time",
	"material,light,technique,ns,ns_low,ns_high,of_visible,of_visible_low,of_visible_high",
	1,
	units,
	run,
	strategies_settings,
};

/* --- batches ------------------------------------------------------------------------------------------------------ */

enum { BATCH = 1 << 15, ARRAYS = 9, OUTPUTS = 11, BATCH_ROUNDS = 9 };

/* A thread of the native device, all of them, and the first OpenCL device, which has all of its processors. */
static const char *const devices[] = {"native:1", "native", "opencl"};

static size_t batch_units(int quick)
{
	(void)quick;
	return sizeof devices / sizeof *devices;
}

typedef struct {
	const char *name;
	int material, strategy; /* strategy < 0: production */
	lobe_scene *scene;
	double sample[BATCH_ROUNDS], eval[BATCH_ROUNDS];
} batch_case;

static lobe_status open_case(batch_case *b, lobe_device *device)
{
	const float alpha = 0.2f;
	lobe_bsdf bsdf;
	if (b->strategy >= 0)
		bsdf = lobe_bsdf_from_microfacet_conductor(strategies_lobe(b->material, alpha, (lobe_uint)b->strategy));
	else if (b->material == STRATEGIES_BECKMANN)
		bsdf = lobe_bsdf_from_beckmann_conductor(strategies_production(b->material, alpha));
	else
		bsdf = lobe_bsdf_from_ggx_conductor(strategies_production(b->material, alpha));
	return lobe_scene_create(&b->scene, device, &bsdf, 1);
}

static lobe_status time_batch(lobe_scene *scene, const lobe_batch *batch, int sample, double *ns)
{
	const double start = bench_now();
	const lobe_status s = sample ? lobe_scene_sample(scene, batch) : lobe_scene_eval(scene, batch);
	*ns = 1e9 * (bench_now() - start) / (double)batch->count;
	return s;
}

static lobe_status time_cases(batch_case *cases, int n, int count, const float *in, float *out)
{
	const float *const a = in;
	lobe_batch sample = {.count = BATCH}, eval = {.count = BATCH};
	for (int k = 0; k < 3; k++) {
		sample.wo[k] = eval.wo[k] = a + (size_t)k * BATCH;
		eval.wi[k] = a + (size_t)(3 + k) * BATCH;
		sample.u[k] = a + (size_t)(6 + k) * BATCH;
		sample.sample_wi[k] = out + (size_t)k * BATCH;
		sample.weight[k] = out + (size_t)(3 + k) * BATCH;
		eval.f[k] = out + (size_t)(6 + k) * BATCH;
	}
	sample.sample_pdf = out + (size_t)9 * BATCH;
	eval.pdf = out + (size_t)10 * BATCH;
	for (int k = -1; k < count; k++)
		for (int i = 0; i < n; i++) {
			double ns[2];
			lobe_status s = time_batch(cases[i].scene, &sample, 1, &ns[0]);
			if (s == LOBE_OK)
				s = time_batch(cases[i].scene, &eval, 0, &ns[1]);
			if (s != LOBE_OK)
				return s;
			if (k < 0)
				continue;
			cases[i].sample[k] = ns[0];
			cases[i].eval[k] = ns[1];
		}
	return LOBE_OK;
}

/* Viewers at all heights; light where the lobe is and where it is not. */
static void fill_batch(float *in)
{
	for (uint32_t i = 0; i < BATCH; i++) {
		const struct random_key key = {6, 0, i, 0};
		float u[3], v[3];
		random_spread(key, RANDOM_LOBE, u);
		random_spread(key, RANDOM_LIGHT, v);
		const lobe_vec3 wo = lobe_uniform_hemisphere(lobe_vec2_make(v[0], v[1]));
		const lobe_vec3 wi = lobe_cosine_hemisphere(lobe_vec2_make(u[1], v[2]));
		const float all[ARRAYS] = {wo.x, wo.y, wo.z, wi.x, wi.y, wi.z, u[0], u[1], u[2]};
		for (int k = 0; k < ARRAYS; k++)
			in[(size_t)k * BATCH + i] = all[k];
	}
}

static int batch_run(int quick, size_t unit, report_rows *rows)
{
	static const int materials[] = {STRATEGIES_GGX, STRATEGIES_BECKMANN};
	batch_case cases[2 * (LOBE_STRATEGY_LAST + 2)];
	const int count = quick ? 5 : BATCH_ROUNDS;
	int n = 0;
	lobe_device *device;
	if (lobe_device_open(&device, devices[unit]) != LOBE_OK) {
		report_row(rows, "%s,none,none,none,0,0,0,0,0,0", devices[unit]);
		return 0;
	}
	float *in = malloc((ARRAYS + OUTPUTS) * (size_t)BATCH * sizeof *in);
	lobe_status status = in ? LOBE_OK : LOBE_ERROR_MEMORY;
	for (int m = 0; m < 2; m++)
		for (int k = -1; k <= LOBE_STRATEGY_LAST && status == LOBE_OK; k++) {
			batch_case *b = &cases[n];
			b->material = materials[m];
			b->strategy = k;
			b->name = k < 0 ? "production lobe" : strategies_name(k);
			status = open_case(b, device);
			n += status == LOBE_OK;
		}
	if (status == LOBE_OK) {
		fill_batch(in);
		status = time_cases(cases, n, count, in, in + (size_t)ARRAYS * BATCH);
	}
	if (status != LOBE_OK)
		fprintf(stderr, "report: %s: %s\n", devices[unit], lobe_error_message());
	for (int i = 0; i < n && status == LOBE_OK; i++) {
		const bench_stats s = bench_stats_of(cases[i].sample, (size_t)count);
		const bench_stats e = bench_stats_of(cases[i].eval, (size_t)count);
		report_row(rows, "%s,%s,%s,%d,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f", devices[unit],
			   strategies_material_name(cases[i].material), cases[i].name, BATCH, s.min, s.min, s.quarter1,
			   e.min, e.min, e.quarter1);
	}
	for (int i = 0; i < n; i++)
		lobe_scene_destroy(cases[i].scene);
	lobe_device_close(device);
	free(in);
	return status != LOBE_OK;
}

const report_study strategies_batch_study = {
	"strategies_batch",
	"device,material,technique,elements,sample_ns,sample_low,sample_high,eval_pdf_ns,eval_pdf_low,eval_pdf_high",
	1,
	batch_units,
	batch_run,
	NULL,
};
