/* strategies_sheet.c - the sheets of pictures in equal time, and of their errors, from the rows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "strategies_rank.h"

/* A picture: [height][width] luminances. */
typedef struct {
	int width, height;
	double *value;
	double samples, ns;
} sheet_picture;

static int words_of(const char *text)
{
	int n = 1;
	for (; *text; text++)
		n += *text == ' ';
	return n;
}

/* The rows of one light, technique and seed, which follow each other from the top down. */
static sheet_picture gather(const report_table *t, const char *light, const char *technique, int seed)
{
	sheet_picture p = {0, 0, NULL, 0.0, 0.0};
	for (size_t i = 0; i < report_table_rows(t); i++) {
		if (strcmp(report_cell(t, i, "light"), light) != 0 ||
		    strcmp(report_cell(t, i, "technique"), technique) != 0 ||
		    report_number(t, i, "seed") != (double)seed)
			continue;
		const char *text = report_cell(t, i, "pixels");
		char *end;
		p.width = words_of(text);
		p.value = realloc(p.value, (size_t)(p.height + 1) * (size_t)p.width * sizeof *p.value);
		if (!p.value)
			exit(1);
		for (int x = 0; x < p.width; x++, text = end)
			p.value[p.height * p.width + x] = strtod(text, &end);
		p.height++;
		p.samples = report_number(t, i, "samples");
		p.ns = report_number(t, i, "ns");
	}
	return p;
}

/* Root of the mean square difference over the balls' pixels, relative to their mean. */
static double error_of(const sheet_picture *p, const sheet_picture *truth)
{
	double sum = 0.0, mean = 0.0, n = 0.0;
	for (int i = 0; i < truth->width * truth->height; i++) {
		const double d = p->value[i] - truth->value[i];
		n += truth->value[i] > 0.0;
		mean += truth->value[i];
		sum += truth->value[i] > 0.0 ? d * d : 0.0;
	}
	return n > 0.0 ? sqrt(sum / n) / (mean / n) : 0.0;
}

/* The share of the balls' pixels that are off by more than a tenth. */
static double bad_pixels(const sheet_picture *p, const sheet_picture *truth)
{
	double bad = 0.0, n = 0.0;
	for (int i = 0; i < truth->width * truth->height; i++) {
		n += truth->value[i] > 0.0;
		bad += truth->value[i] > 0.0 && fabs(p->value[i] / truth->value[i] - 1.0) > 0.1;
	}
	return 100.0 * bad / fmax(n, 1.0);
}

/* The median of the pixels' relative error, which hardly depends on which of them found the sun. */
static double median_error(const sheet_picture *p, const sheet_picture *truth)
{
	const size_t pixels = (size_t)(truth->width * truth->height);
	double *off = calloc(pixels + 1, sizeof *off);
	size_t n = 0;
	if (!off)
		exit(1);
	for (size_t i = 0; i < pixels; i++)
		if (truth->value[i] > 0.0)
			off[n++] = fabs(p->value[i] / truth->value[i] - 1.0);
	const double median = rank_quantile(off, n, 0.5);
	free(off);
	return median;
}

/* RMS errors of the pictures by other seeds, of which there is a grid of pixels: quartiles and the median between
 * them. */
typedef struct {
	double quartile[3];
} sheet_seeds;

static sheet_seeds seeds_of(const report_table *t, const char *light, const char *technique, const sheet_picture *truth)
{
	enum { SEEDS_MAX = 64, STEP = STRATEGIES_GRID };
	double error[SEEDS_MAX];
	size_t n = 0;
	int count = 0;
	sheet_picture grid = {0, 0, NULL, 0.0, 0.0};
	grid.value = calloc((size_t)(truth->width * truth->height), sizeof *grid.value);
	if (!grid.value)
		exit(1);
	for (int y = STEP / 2; y < truth->height; y += STEP, grid.height++)
		for (int x = STEP / 2; x < truth->width; x += STEP)
			grid.value[count++] = truth->value[y * truth->width + x];
	grid.width = count / grid.height;
	for (int seed = 1; n < SEEDS_MAX; seed++) {
		sheet_picture p = gather(t, light, technique, seed);
		if (!p.value)
			break;
		error[n++] = error_of(&p, &grid);
		free(p.value);
	}
	free(grid.value);
	const sheet_seeds s = {
		{rank_quantile(error, n, 0.25), rank_quantile(error, n, 0.5), rank_quantile(error, n, 0.75)}};
	return s;
}

/* The root of the mean variance of a pixel of so many independent samples, a fraction of the pixels having one more,
 * and its standard deviation. */
typedef struct {
	double error, doubt;
} sheet_expected;

static sheet_expected expected_of(const report_table *t, const char *light, const char *technique, double samples)
{
	const double whole = floor(samples), more = samples - whole;
	const double share = (1.0 - more) / fmax(whole, 1.0) + more / (whole + 1.0);
	double sum = 0.0, doubt = 0.0, n = 0.0;
	for (size_t i = 0; i < report_table_rows(t); i++)
		if (strcmp(report_cell(t, i, "light"), light) == 0 &&
		    strcmp(report_cell(t, i, "technique"), technique) == 0) {
			sum += report_number(t, i, "variance");
			doubt = hypot(doubt, report_number(t, i, "variance_error"));
			n += report_number(t, i, "pixels");
		}
	const sheet_expected e = {sqrt(share * sum / n), 0.5 * sqrt(share * sum / n) * doubt / sum};
	return e;
}

/* A block of "x y tone error": tone for the eye, error relative to the true pixel, NaN beside the balls. */
static void write_block(FILE *f, const sheet_picture *p, const sheet_picture *truth, double exposure)
{
	for (int y = 0; y < p->height; y++) {
		for (int x = 0; x < p->width; x++) {
			const double v = p->value[y * p->width + x], t = truth->value[y * p->width + x];
			const double tone =
				255.0 * pow(fmin(v * exposure / (1.0 + v * exposure) * 1.25, 1.0), 1.0 / 2.2);
			if (t > 0.0)
				fprintf(f, "%d %d %.0f %.4g\n", x, y, tone, fmax(fabs(v / t - 1.0), 1e-4));
			else
				fprintf(f, "%d %d %.0f NaN\n", x, y, tone);
		}
		fprintf(f, "\n");
	}
	fprintf(f, "\n");
}

static void write_sheet(report_page *page, const report_table *reference, const report_table *expected,
			const report_table *pictures, const char *light, int number)
{
	char file[64], definitions[512];
	sheet_picture truth = gather(reference, light, "reference", 0),
		      doubt = gather(reference, light, "error of the reference", 0);
	double mean = 0.0, n = 0.0, off = 0.0, median[STRATEGIES_TECHNIQUES];
	sheet_seeds seeds[STRATEGIES_TECHNIQUES];
	double independent[STRATEGIES_TECHNIQUES];
	int best = 0, calm = 0, sure = 0;
	for (int i = 0; i < truth.width * truth.height; i++) {
		n += truth.value[i] > 0.0;
		mean += truth.value[i];
		off += doubt.value[i] * doubt.value[i];
	}
	mean /= fmax(n, 1.0);
	off = sqrt(off / fmax(n, 1.0)) / mean;
	FILE *data = report_open("strategies_pictures.dat"), *titles = report_open("strategies_sheet_titles.gp");
	fprintf(titles, "WIDTH = %d\nHEIGHT = %d\narray TITLES[%d]\n", truth.width, truth.height,
		STRATEGIES_TECHNIQUES + 1);
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++) {
		sheet_picture p = gather(pictures, light, strategies_name(t), 0);
		const sheet_expected e = expected_of(expected, light, strategies_name(t), p.samples);
		median[t] = median_error(&p, &truth);
		seeds[t] = seeds_of(pictures, light, strategies_name(t), &truth);
		independent[t] = e.error / mean;
		sure = independent[t] < independent[sure] ? t : sure;
		best = seeds[t].quartile[1] < seeds[best].quartile[1] ? t : best;
		calm = median[t] < median[calm] ? t : calm;
		write_block(data, &p, &truth, 0.6 / mean);
		fprintf(titles,
			"TITLES[%d] = \"%s: %.1f samples, RMS %.3g (%.3g - %.3g)\\nindependent %.3g, median pixel "
			"%.2g, %.0f "
			"%% off by 10 %%\"\n",
			t + 1, strategies_name(t), p.samples, seeds[t].quartile[1], seeds[t].quartile[0],
			seeds[t].quartile[2], independent[t], median[t], bad_pixels(&p, &truth));
		free(p.value);
	}
	write_block(data, &truth, &truth, 0.6 / mean);
	fprintf(titles, "TITLES[%d] = \"reference, RMS error %.2g\"\n", STRATEGIES_TECHNIQUES + 1, off);
	fclose(data);
	fclose(titles);
	snprintf(definitions, sizeof definitions,
		 "PICTURES='strategies_pictures%d.png'; ERRORS='strategies_errors%d.png'; LIGHT='%s'", number, number,
		 light);
	report_gnuplot(page, "strategies_sheet.gp", definitions);
	snprintf(file, sizeof file, "strategies_pictures%d.png", number);
	report_figure(
		page, file,
		"Gold balls of alpha 0.02, 0.15 and 0.6 under *%s*, one bounce, by each technique in the time that the "
		"default takes for 16 samples a pixel. RMS: error relative to the mean, median and quartiles over "
		"seeds, in a "
		"grid of the pixels; the reference's own is %.2g. Independent: the same of independent instead of "
		"scrambled "
		"samples, from those pixels' variances as integrals, so that no rare find of a sun decides. Median "
		"pixel: of "
		"the relative errors in this picture.",
		light, off);
	snprintf(file, sizeof file, "strategies_errors%d.png", number);
	report_figure(page, file, "The same: relative error of each pixel.");
	if (number == 1)
		report_readme(page,
			      "Balls of gold under *%s*, each technique for the same "
			      "time:\n\n![](doc/strategies_pictures1.png)\n\n",
			      light);
	int next = best == 0;
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
		next = t != best && seeds[t].quartile[1] < seeds[next].quartile[1] ? t : next;
	report_finding(page,
		       "Three gold balls under %s in equal time, RMS error over the mean. Expected of independent "
		       "samples, rare "
		       "finds of small lights included: %s errs least, by %.2g, the default by %.2g. The typical "
		       "picture, which "
		       "such finds are missing from (scrambled samples, median of seeds): %s %.2g (quartiles %.2g - "
		       "%.2g), then "
		       "%s %.2g (%.2g - %.2g)%s; the default %.2g",
		       light, strategies_name(sure), independent[sure], independent[strategies_default(STRATEGIES_GGX)],
		       strategies_name(best), seeds[best].quartile[1], seeds[best].quartile[0], seeds[best].quartile[2],
		       strategies_name(next), seeds[next].quartile[1], seeds[next].quartile[0], seeds[next].quartile[2],
		       seeds[next].quartile[0] < seeds[best].quartile[2] ? ", which the seeds do not tell apart" : "",
		       seeds[strategies_default(STRATEGIES_GGX)].quartile[1]);
	report_text(page, "Of the median pixel in the picture shown %s errs least, by %.2g; the default by %.2g.\n\n",
		    strategies_name(calm), median[calm], median[strategies_default(STRATEGIES_GGX)]);
	free(truth.value);
	free(doubt.value);
}

void strategies_write_pictures(report_page *page, const report_table *reference, const report_table *expected,
			       const report_table *pictures)
{
	const char *light = "";
	int number = 0;
	for (size_t i = 0; i < report_table_rows(reference); i++)
		if (strcmp(report_cell(reference, i, "light"), light) != 0) {
			light = report_cell(reference, i, "light");
			write_sheet(page, reference, expected, pictures, light, ++number);
		}
}
