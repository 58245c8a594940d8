/* strategies_picture.c - the same three balls by each technique in the same time.
 *
 * Gold balls of three roughnesses under a sky or a probe, one bounce, nothing hides anything. What a technique may
 * spend is what the default takes for DEFAULT_SAMPLES a pixel; both are timed on these very pixels, in turn, and the
 * technique gets samples in proportion, a share of the pixels one more. Given the numbers of samples, which are in the
 * rows, pictures follow from nothing else. Pixels are luminances, a row of the picture in a cell, separated by
 * spaces. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../timing.h"
#include "random.h"
#include "strategies.h"

enum { BALLS = 3, DEFAULT_SAMPLES = 16, STRIP = 8, HALVES = 4, ROUND = 20, SEEDS = 24 };

static const float alphas[BALLS] = {0.02f, 0.15f, 0.6f};

static int height_of(int quick) { return quick ? 48 : 96; }

/* The sky with sun, and the last probe if there is one. */
static size_t pictures(int quick) { return strategies_lights(quick) > strategies_analytic_lights() ? 2 : 1; }

static size_t light_of(int quick, size_t picture) { return picture ? strategies_lights(quick) - 1 : 6; }

/* A ball fills its square but for a margin. The camera looks along y, far away; the case is set up for its pixel. */
static int hit(strategies_case *ball, int height, int x, int y)
{
	const float radius = 0.5f * (float)height;
	const float px = ((float)(x % height) + 0.5f - radius) / (0.96f * radius);
	const float pz = (radius - (float)y - 0.5f) / (0.96f * radius);
	const float depth2 = 1.0f - (px * px + pz * pz);
	if (!(depth2 > 0.0f))
		return 0;
	const lobe_vec3 n = lobe_vec3_make(px, -lobe_sqrt(depth2), pz);
	ball->light.frame = lobe_frame_from_normal(n);
	ball->light.turned = 1;
	ball->wo = lobe_frame_to_local(ball->light.frame, lobe_vec3_make(0.0f, -1.0f, 0.0f));
	return 1;
}

static void set_up(strategies_case ball[BALLS], size_t light)
{
	for (int i = 0; i < BALLS; i++) {
		ball[i] = strategies_case_make(STRATEGIES_GGX, (double)alphas[i], 0.5, light);
		ball[i].light = strategies_light_at(light, lobe_vec3_make(0.0f, -1.0f, 0.0f));
	}
}

static double shade(const strategies_case *c, int technique, uint32_t pixel, uint32_t n, uint32_t seed)
{
	const strategies_compiled *const only = strategies_compiled_for(c);
	double sum = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		const struct random_key key = {seed, pixel, i, (uint32_t)technique};
		float u[3], v[3];
		random_spread(key, RANDOM_LOBE, u);
		random_spread(key, RANDOM_LIGHT, v);
		sum += (double)only->estimate[technique](c, u, v);
	}
	return n ? sum / n : 0.0;
}

/* --- the reference ------------------------------------------------------------------------------------------------ */

static size_t strips(int quick) { return (size_t)(height_of(quick) / STRIP); }
static size_t reference_units(int quick) { return pictures(quick) * strips(quick); }

static int print_row(report_rows *rows, const char *light, const char *technique, double spp, double ns, int seed,
		     int y, const double *value, int width)
{
	char *text = malloc((size_t)width * 16 + 1);
	size_t at = 0;
	if (!text)
		return 1;
	for (int x = 0; x < width; x++)
		at += (size_t)snprintf(text + at, 16, x ? " %.5g" : "%.5g", value[x]);
	report_row(rows, "%s,%s,%.4f,%.2f,%d,%d,%s", light, technique, spp, ns, seed, y, text);
	free(text);
	return 0;
}

/* By the power heuristic, in parts of which each is a picture of its own: their spread is the error. */
static int reference_run(int quick, size_t unit, report_rows *rows)
{
	const size_t picture = unit / strips(quick);
	const int height = height_of(quick), width = BALLS * height, first = (int)(unit % strips(quick)) * STRIP;
	const uint32_t n = quick ? 256 : 1024;
	strategies_case ball[BALLS];
	double *value = calloc(2 * (size_t)width, sizeof *value);
	int failed = value == NULL;
	set_up(ball, light_of(quick, picture));
	for (int y = first; y < first + STRIP && !failed; y++) {
		memset(value, 0, 2 * (size_t)width * sizeof *value);
		for (int x = 0; x < width; x++) {
			strategies_case *c = &ball[x / height];
			double squares = 0.0;
			if (!hit(c, height, x, y))
				continue;
			for (uint32_t k = 0; k < HALVES; k++) {
				const double part = shade(c, STRATEGIES_POWER, (uint32_t)(y * width + x), n, 100 + k);
				value[x] += part / HALVES;
				squares += part * part / HALVES;
			}
			value[width + x] = sqrt(fmax(squares - value[x] * value[x], 0.0) / (HALVES - 1));
		}
		failed =
			print_row(rows, ball[0].light.name, "reference", (double)n * HALVES, 0.0, 0, y, value, width) ||
			print_row(rows, ball[0].light.name, "error of the reference", (double)n * HALVES, 0.0, 0, y,
				  value + width, width);
	}
	free(value);
	return failed;
}

#define COLUMNS "light,technique,samples,ns,seed,row,pixels"

const report_study strategies_reference_study = {
	"strategies_reference", COLUMNS, 0, reference_units, reference_run, strategies_settings,
};

/* --- what is to be expected --------------------------------------------------------------------------------------- */

/* Where a technique finds the sun once in a while, the error of a picture is that of its few brightest pixels, and
 * another picture's is another. So the variance of a sample in a pixel is taken as an integral, of every
 * STRATEGIES_GRID-th pixel: the mean square error of all pictures with independent samples, of which the one shown is a
 * draw. */
static size_t expected_units(int quick) { return pictures(quick) * (size_t)(height_of(quick) / STRATEGIES_GRID); }

static int expected_run(int quick, size_t unit, report_rows *rows)
{
	const int height = height_of(quick), lines = height / STRATEGIES_GRID;
	const int y = STRATEGIES_GRID * (int)(unit % (size_t)lines) + STRATEGIES_GRID / 2;
	double sum[STRATEGIES_TECHNIQUES] = {0}, doubt[STRATEGIES_TECHNIQUES] = {0}, n = 0.0;
	strategies_case ball[BALLS];
	set_up(ball, light_of(quick, unit / (size_t)lines));
	for (int x = STRATEGIES_GRID / 2; x < BALLS * height; x += STRATEGIES_GRID) {
		strategies_case *c = &ball[x / height];
		if (!hit(c, height, x, y))
			continue;
		const strategies_moments m = strategies_moments_of(c, 512, 4, (uint32_t)(31 + y * BALLS * height + x));
		for (int t = 0; t < STRATEGIES_TECHNIQUES; t++) {
			sum[t] += m.variance[t];
			doubt[t] += m.error[t] * m.error[t];
		}
		n++;
	}
	for (int t = 0; t < STRATEGIES_TECHNIQUES && n > 0.0; t++)
		report_row(rows, "%s,%s,%d,%g,%.7g,%.3g", ball[0].light.name, strategies_name(t), y, n, sum[t],
			   sqrt(doubt[t]));
	return 0;
}

const report_study strategies_expected_study = {
	"strategies_expected", "light,technique,row,pixels,variance,variance_error", 0, expected_units, expected_run,
	strategies_settings,
};

/* --- each technique ----------------------------------------------------------------------------------------------- */

static size_t picture_units(int quick) { return pictures(quick) * STRATEGIES_TECHNIQUES; }

static volatile float keep;

enum { OF_DEFAULT, OF_TECHNIQUE, TIMED };

static double time_pixel(const strategies_case *c, int technique, const float (*u)[6], int count)
{
	const strategies_compiled *const only = strategies_compiled_for(c);
	float sum = 0.0f;
	const double start = bench_now();
	for (int i = 0; i < count; i++)
		sum += only->estimate[technique](c, u[i], u[i] + 3);
	keep = sum;
	return 1e9 * (bench_now() - start) / count;
}

/* Of a sample without its random numbers, by the default and by the technique in turn, mean over pixels: of each the
 * least of some microseconds, for other programs on the machine only add to it. */
static void time_pixels(strategies_case ball[BALLS], int technique, int height, double ns[TIMED])
{
	enum { COUNT = 64, ROUNDS = 9 };
	float u[COUNT][6];
	double n = 0.0;
	for (uint32_t i = 0; i < COUNT; i++) {
		const struct random_key key = {9, 0, i, 0};
		random_spread(key, RANDOM_LOBE, u[i]);
		random_spread(key, RANDOM_LIGHT, u[i] + 3);
	}
	ns[OF_DEFAULT] = ns[OF_TECHNIQUE] = 0.0;
	for (int y = 1; y < height; y += 3)
		for (int x = 0; x < BALLS * height; x++) {
			strategies_case *c = &ball[x / height];
			double least[TIMED] = {HUGE_VAL, HUGE_VAL};
			if (!hit(c, height, x, y))
				continue;
			for (int k = 0; k < ROUNDS; k++)
				for (int which = 0; which < TIMED; which++)
					least[which] =
						fmin(least[which],
						     time_pixel(c,
								which == OF_DEFAULT ? strategies_default(STRATEGIES_GGX)
										    : technique,
								(const float(*)[6])u, COUNT));
			for (int which = 0; which < TIMED; which++)
				ns[which] += least[which];
			n++;
		}
	ns[OF_DEFAULT] /= n;
	ns[OF_TECHNIQUE] /= n;
}

static int picture_run(int quick, size_t unit, report_rows *rows)
{
	const size_t picture = unit / STRATEGIES_TECHNIQUES;
	const int technique = (int)(unit % STRATEGIES_TECHNIQUES);
	const int height = height_of(quick), width = BALLS * height;
	strategies_case ball[BALLS];
	double ns[TIMED];
	double *value = calloc((size_t)width, sizeof *value);
	int failed = value == NULL;
	set_up(ball, light_of(quick, picture));
	time_pixels(ball, technique, height, ns);
	const double samples = technique == strategies_default(STRATEGIES_GGX)
				       ? DEFAULT_SAMPLES
				       : DEFAULT_SAMPLES * ns[OF_DEFAULT] / ns[OF_TECHNIQUE];
	/* The picture, and of others by other seeds every STRATEGIES_GRID-th pixel. */
	for (int seed = 0; seed <= SEEDS; seed++) {
		const int step = seed ? STRATEGIES_GRID : 1, first = step / 2;
		for (int y = first; y < height && !failed; y += step) {
			int count = 0;
			for (int x = first; x < width; x += step) {
				strategies_case *c = &ball[x / height];
				const uint32_t pixel = (uint32_t)(y * width + x);
				const struct random_key key = {13 + (uint32_t)seed, pixel, 0, (uint32_t)technique};
				const uint32_t n = (uint32_t)(samples + (double)random_plain(key, ROUND));
				value[count++] = hit(c, height, x, y)
							 ? shade(c, technique, pixel, n, 200 + (uint32_t)seed)
							 : 0.0;
			}
			failed = print_row(rows, ball[0].light.name, strategies_name(technique), samples,
					   ns[OF_TECHNIQUE], seed, y, value, count);
		}
	}
	free(value);
	return failed;
}

const report_study strategies_pictures_study = {
	"strategies_pictures", COLUMNS, 1, picture_units, picture_run, strategies_settings,
};
