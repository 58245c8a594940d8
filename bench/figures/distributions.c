/* distributions.c - D, G1 and the tails of GTR. */
#include <math.h>
#include <stdio.h>

#include "figures.h"

#define RADIANS(degrees) ((degrees) * 0.017453292519943295)

static const double widths[] = {0.1, 0.5};

/* One column for each surface and width. */
static void header(FILE *f, const char *x)
{
	fputs(x, f);
	for (int w = 0; w < 2; w++)
		for (int k = 0; k < FIGURE_SURFACES; k++)
			fprintf(f, ",%s %g", figure_surface_name(k), widths[w]);
	fputc('\n', f);
}

static void curves(const char *name, double (*value)(lobe_microsurface, lobe_vec3))
{
	FILE *f = figure_open(name);
	header(f, "theta [degrees]");
	for (int i = 0; i < 360; i++) {
		const double theta = i * 0.25;
		fprintf(f, "%g", theta);
		for (int w = 0; w < 2; w++)
			for (int k = 0; k < FIGURE_SURFACES; k++)
				fprintf(f, ",%.7g", value(figure_surface(k, widths[w]), figure_direction(RADIANS(theta))));
		fputc('\n', f);
	}
	fclose(f);
}

/* Burley 2012, figure 4: the tails, on a logarithmic axis of angle. */
static void gtr_tails(void)
{
	static const double gammas[] = {1.0, 1.5, 2.0, 3.0, 10.0};
	lobe_microsurface surface[sizeof gammas / sizeof *gammas];
	FILE *f = figure_open("gtr_tails");
	fputs("theta [degrees]", f);
	for (size_t k = 0; k < sizeof gammas / sizeof *gammas; k++)
		fprintf(f, ",gamma %g", gammas[k]);
	for (size_t k = 0; k < sizeof gammas / sizeof *gammas; k++)
		surface[k] = figure_gtr(gammas[k], 0.05);
	fputc('\n', f);
	for (int i = 0; i <= 300; i++) {
		const double theta = 0.1 * pow(890.0, i / 300.0);
		fprintf(f, "%.6g", theta);
		for (size_t k = 0; k < sizeof gammas / sizeof *gammas; k++)
			fprintf(f, ",%.7g", figure_d(surface[k], figure_direction(RADIANS(theta))));
		fputc('\n', f);
	}
	fclose(f);
}

void figures_of_distributions(void)
{
	curves("d", figure_d);
	curves("g1", figure_g1);
	gtr_tails();
}
