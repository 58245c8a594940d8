/* furnaces_sheets.c - the furnaces as pictures: maps over value and angle, and balls in an environment
 * of radiance 1. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "csv.h"
#include "furnaces.h"

/* In the order of the pages. */
static const struct {
	const char *family, *title;
} families[] = {
	{"metal", "metals that absorb nothing"},
	{"glass", "rough glass"},
	{"film", "thin films on a surface of alpha .03"},
	{"ideal", "without roughness"},
	{"diffuse", "rough diffuse surfaces"},
	{"masking", "reflectance 1 by masking (GGX but for the last)"},
	{"compared", "GGX by masking that is no surface's, reflectance 1"},
	{"distribution", "distributions with Smith's masking, reflectance 1"},
};
enum { FAMILIES = sizeof families / sizeof *families };

double furnaces_tone(double energy)
{
	const double off = fabs(energy - 1.0);
	const double size = off > 1e-3 ? fmin((log10(off) + 3.0) / 3.0, 1.0) : 0.0;
	return energy < 1.0 ? -size : size;
}

/* --- maps --------------------------------------------------------------------------------------------------------- */

/* A block for each surface of the family; returns how many. */
static int write_maps(const report_table *t, const char *family, FILE *data, FILE *titles)
{
	const char *name = "";
	int n = 0;
	for (size_t i = 0; i < report_table_rows(t); i++) {
		if (strcmp(report_cell(t, i, "family"), family) != 0)
			continue;
		const double value = report_number(t, i, "value");
		const int by_alpha = strcmp(report_cell(t, i, "axis"), "alpha") == 0;
		if (strcmp(report_cell(t, i, "name"), name) != 0) {
			name = report_cell(t, i, "name");
			fprintf(data, n ? "\n\n" : "");
			fprintf(titles, "TITLES[%d] = \"%s\"\nAXES[%d] = \"%s\"\n", n + 1, name, n + 1,
				by_alpha ? "roughness sqrt(alpha)" : report_cell(t, i, "axis"));
			n++;
		}
		fprintf(data, "%.9g %.9g %.4f\n", by_alpha ? sqrt(value) : value, report_number(t, i, "cos"),
			furnaces_tone(furnaces_mean(t, i)));
	}
	return n;
}

void furnaces_draw_maps(report_page *page, const report_table *white)
{
	report_text(page, "### The white furnace over value and angle\n\n");
	for (int k = 0; k < FAMILIES; k++) {
		char definitions[256], file[64];
		FILE *data = report_open("furnaces_maps.dat"), *titles = report_open("furnaces_maps_titles.gp");
		fprintf(titles, "array TITLES[32]\narray AXES[32]\n");
		const int n = write_maps(white, families[k].family, data, titles);
		fprintf(titles, "COUNT = %d\n", n);
		fclose(data);
		fclose(titles);
		snprintf(file, sizeof file, "furnaces_map_%s.png", families[k].family);
		snprintf(definitions, sizeof definitions, "OUT='%s'; FAMILY=\\\"%s\\\"", file, families[k].title);
		report_gnuplot(page, "furnaces_maps.gp", definitions);
		report_figure(
			page, file,
			"Energy kept of constant light, %s: white within 1/1000 of 1, blue where light is lost, red "
			"where it is made, by logarithm.",
			families[k].title);
	}
}

/* --- balls -------------------------------------------------------------------------------------------------------- */

enum { BALL = 112, GAP = 48, CELL_W = BALL + 28, CELL_H = BALL + GAP, LEFT = 20, NODES_MAX = 256, SUB = 3 };

/* Energies of a ball by v, cos = v^2. */
typedef struct {
	double v[NODES_MAX], rgb[NODES_MAX][3];
	int n;
} profile;

static void profile_add(profile *p, double v, const double rgb[3])
{
	int i = p->n;
	if (i == NODES_MAX) {
		fputs("report: more points on a ball than furnaces_sheets.c has room for\n", stderr);
		exit(1);
	}
	for (; i > 0 && p->v[i - 1] > v; i--) {
		p->v[i] = p->v[i - 1];
		memcpy(p->rgb[i], p->rgb[i - 1], sizeof p->rgb[i]);
	}
	p->v[i] = v;
	memcpy(p->rgb[i], rgb, sizeof p->rgb[i]);
	p->n++;
}

/* Cubic between nodes, with the slopes of parabolas through three. */
static double profile_at(const profile *p, double v, int k)
{
	int i = 0;
	if (v <= p->v[0])
		return p->rgb[0][k];
	if (v >= p->v[p->n - 1])
		return p->rgb[p->n - 1][k];
	while (p->v[i + 1] < v)
		i++;
	const double h = p->v[i + 1] - p->v[i], t = (v - p->v[i]) / h;
	const double here = (p->rgb[i + 1][k] - p->rgb[i][k]) / h;
	double slope[2] = {here, here};
	if (i > 0) {
		const double g = p->v[i] - p->v[i - 1], before = (p->rgb[i][k] - p->rgb[i - 1][k]) / g;
		slope[0] = (before * h + here * g) / (g + h);
	}
	if (i + 2 < p->n) {
		const double g = p->v[i + 2] - p->v[i + 1], after = (p->rgb[i + 2][k] - p->rgb[i + 1][k]) / g;
		slope[1] = (after * h + here * g) / (g + h);
	}
	const double a = h * slope[0] - (p->rgb[i + 1][k] - p->rgb[i][k]);
	const double b = -h * slope[1] + (p->rgb[i + 1][k] - p->rgb[i][k]);
	return (1.0 - t) * p->rgb[i][k] + t * p->rgb[i + 1][k] + t * (1.0 - t) * (a * (1.0 - t) + b * t);
}

/* Half of white is the environment, so that there is room for light that is made. sRGB. */
static unsigned char tone(double radiance)
{
	const double x = fmin(fmax(0.5 * radiance, 0.0), 1.0);
	const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
	return (unsigned char)(255.0 * s + 0.5);
}

static void draw_ball(unsigned char *rgb, int width, int left, int top, const profile *p)
{
	for (int y = 0; y < BALL; y++)
		for (int x = 0; x < BALL; x++) {
			double sum[3] = {0.0, 0.0, 0.0};
			for (int sub = 0; sub < SUB * SUB; sub++) {
				const double u = 2.0 * (x + (sub % SUB + 0.5) / SUB) / BALL - 1.0;
				const double w = 2.0 * (y + (sub / SUB + 0.5) / SUB) / BALL - 1.0;
				const double cosine2 = 1.0 - u * u - w * w;
				for (int k = 0; k < 3; k++)
					sum[k] += cosine2 > 0.0 ? profile_at(p, pow(cosine2, 0.25), k) : 1.0;
			}
			for (int k = 0; k < 3; k++)
				rgb[3 * ((top + y) * width + left + x) + k] = tone(sum[k] / (SUB * SUB));
		}
}

/* Surfaces of the family in the order of the rows. */
static int names_of(const report_table *t, const char *family, const char *names[32])
{
	int n = 0;
	for (size_t i = 0; i < report_table_rows(t) && n < 32; i++)
		if (strcmp(report_cell(t, i, "family"), family) == 0 &&
		    (n == 0 || strcmp(report_cell(t, i, "name"), names[n - 1]) != 0))
			names[n++] = report_cell(t, i, "name");
	return n;
}

static void draw_sheet(const report_table *t, const char *const *names, int count, FILE *labels)
{
	const int width = LEFT + FURNACES_SHOWN * CELL_W, height = count * CELL_H;
	unsigned char *rgb = report_alloc(NULL, (size_t)width * (size_t)height * 3);
	memset(rgb, tone(1.0), (size_t)width * (size_t)height * 3);
	for (int s = 0; s < count; s++) {
		profile p = {.n = 0};
		int column = 0;
		for (size_t i = 0; i < report_table_rows(t); i++) {
			if (strcmp(report_cell(t, i, "name"), names[s]) != 0)
				continue;
			const char *what = report_cell(t, i, "what");
			const double c[3] = {report_number(t, i, "r"), report_number(t, i, "g"),
					     report_number(t, i, "b")};
			if (strcmp(what, "profile") == 0)
				profile_add(&p, report_number(t, i, "at"), c);
			if (strcmp(what, "mean") != 0)
				continue;
			/* The mean is a ball's last row. */
			const int left = LEFT + column * CELL_W, top = s * CELL_H + 23;
			draw_ball(rgb, width, left, top, &p);
			/* As many digits as are ten times the error or more. */
			const double error = report_number(t, i, "error");
			fprintf(labels, "set label %d \"%s %g: %.*f\" at %d, %d center front font \"sans,9\"\n",
				1000 + s * FURNACES_SHOWN + column, report_cell(t, i, "axis"),
				report_number(t, i, "value"),
				error <= 1e-4   ? 3
				: error <= 1e-3 ? 2
						: 1,
				c[0], left + BALL / 2, top + BALL + 11);
			p.n = 0;
			column++;
		}
		fprintf(labels, "set label %d \"%s\" at %d, %d left front font \"sans,10\"\n", s + 1, names[s], LEFT,
			s * CELL_H + 11);
	}
	fprintf(labels, "WIDTH = %d\nHEIGHT = %d\n", width, height);
	FILE *pixels = report_open("furnaces_balls.rgb");
	fwrite(rgb, 3, (size_t)width * (size_t)height, pixels);
	fclose(pixels);
	free(rgb);
}

void furnaces_draw_balls(report_page *page, const report_table *shown)
{
	report_text(
		page,
		"### Balls in the furnace\n\nEach ball is lit by radiance 1 from everywhere: one that loses nothing "
		"vanishes into the background, one that loses light is darker, one that makes it brighter. Below "
		"stands what it sends back of the light that falls on it. Glass is a half space of it: inside, the "
		"light is as strong as in balance with that outside.\n\n");
	for (int k = 0; k < FAMILIES; k++) {
		const char *names[32];
		char definitions[256], file[64];
		const int count = names_of(shown, families[k].family, names);
		FILE *labels = report_open("furnaces_balls_labels.gp");
		draw_sheet(shown, names, count, labels);
		fclose(labels);
		snprintf(file, sizeof file, "furnaces_balls_%s.png", families[k].family);
		snprintf(definitions, sizeof definitions, "OUT='%s'", file);
		report_gnuplot(page, "furnaces_balls.gp", definitions);
		report_figure(page, file, "Balls in constant light, %s; the share of it that they send back.",
			      families[k].title);
	}
}
