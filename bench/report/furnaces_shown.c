/* furnaces_shown.c - the energy at the values and angles of the tables, and averaged over the hemisphere: what a ball
 * in constant light sends back. */
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "furnaces.h"
#include "pi.h"

enum { ANGLES = 5 };
static const double angles[ANGLES] = {0.0, 45.0, 60.0, 75.0, 85.0}; /* degrees */

static size_t units(int quick)
{
	(void)quick;
	furnaces_prepare();
	return furnaces_surface_count * FURNACES_SHOWN;
}

typedef struct {
	const furnaces_surface *surface;
	double value, error; /* error: sum of the nodes' */
	int nodes;
	furnaces_effort effort;
	report_rows *rows;
} ball;

static void row(report_rows *rows, const furnaces_surface *s, double value, const char *what, double at,
		const furnaces_energy *e)
{
	report_row(rows, "%s,%s,%s,%d,%d,%s,%.6g,%s,%.9g,%.7f,%.7f,%.7f,%.2g", s->family, s->lobe, s->name,
		   s->no_surface, s->absorbs, s->axis, value, what, at, e->rgb[0], e->rgb[1], e->rgb[2], e->error);
}

/* By v, cos = v^2, which spreads what changes near the horizon: a ball's mean is int E 2 c dc = int E 4 v^3 dv. */
static double at_root(double v, void *context)
{
	ball *b = context;
	const furnaces_energy e = furnaces_energy_at(b->surface, b->value, v * v, b->effort);
	row(b->rows, b->surface, b->value, "profile", v, &e);
	b->error += e.error * 4.0 * v * v * v;
	b->nodes++;
	return (e.rgb[0] + e.rgb[1] + e.rgb[2]) / 3.0 * 4.0 * v * v * v;
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const furnaces_surface *s = &furnaces_surfaces[unit / FURNACES_SHOWN];
	const double value = s->shown[unit % FURNACES_SHOWN];
	ball b = {s, value, 0.0, 0, quick ? FURNACES_ROUGH : FURNACES_FINE, rows};
	gsl_function f = {at_root, &b};
	furnaces_energy mean = {{0.0, 0.0, 0.0}, 0.0};
	/* Energy has a kink where total reflection begins: seen from inside a ball is of two parts. */
	const double eta = s->make(s, value).eta;
	const double edge = s->inside ? sqrt(sqrt(1.0 - 1.0 / (eta * eta))) : 0.0;
	/* Masking may have kinks as well. */
	const int pieces = quick ? 1 : 4;
	for (int k = 0; k < ANGLES; k++) {
		const furnaces_energy e = furnaces_energy_at(s, value, cos(angles[k] * PI / 180.0),
							     quick ? FURNACES_ROUGH : FURNACES_FINEST);
		row(rows, s, value, "angle", angles[k], &e);
	}
	for (int k = edge > 0.0 ? 0 : pieces; k < 2 * pieces; k++) {
		const double from = k < pieces ? 0.0 : edge, to = k < pieces ? edge : 1.0;
		const double step = (to - from) / pieces, first = from + step * (k % pieces);
		double part, error, scale, size;
		/* Half of the points are Gauss's, whose result is as far from all of theirs (Kronrod) as it is off. */
		if (s->inside && quick)
			gsl_integration_qk15(&f, first, first + step, &part, &error, &scale, &size);
		else
			gsl_integration_qk21(&f, first, first + step, &part, &error, &scale, &size);
		mean.rgb[0] += part;
		mean.error += error;
	}
	mean.rgb[1] = mean.rgb[2] = mean.rgb[0];
	/* And the mean of the nodes' own. */
	mean.error += b.error / b.nodes;
	row(rows, s, value, "mean", 0.0, &mean);
	return 0;
}

const report_study furnaces_shown = {.name = "furnaces_shown",
				     .columns = "family,lobe,name,no_surface,absorbs,axis,value,what,at,r,g,b,error",
				     .units = units,
				     .run = run};

/* --- tables ------------------------------------------------------------------------------------------------------- */

static furnaces_lost lost_text(double lost, double error)
{
	furnaces_lost r;
	const double percent = 100.0 * lost, unit = 1000.0 * error;
	const int digits = unit <= 0.01 ? 2 : unit <= 0.1 ? 1 : 0;
	if (unit > 1.0)
		snprintf(r.text, sizeof r.text, "%.1f +- %.1f", percent, 100.0 * error);
	else if (fabs(percent) < 0.5 * pow(10.0, -digits))
		snprintf(r.text, sizeof r.text, "0");
	else
		snprintf(r.text, sizeof r.text, "%.*f", digits, percent);
	return r;
}

/* The row of that; ends the program where there is none. */
static size_t row_of(const report_table *t, const char *name, double value, const char *what)
{
	for (size_t i = 0; i < report_table_rows(t); i++)
		if (strcmp(report_cell(t, i, "name"), name) == 0 && strcmp(report_cell(t, i, "what"), what) == 0 &&
		    fabs(report_number(t, i, "value") - value) < 1e-6 * fmax(value, 1.0))
			return i;
	fprintf(stderr, "report: no rows of %s\n", name);
	exit(1);
}

furnaces_lost furnaces_ball_loses(const report_table *t, const char *name, double value)
{
	const size_t i = row_of(t, name, value, "mean");
	return lost_text(1.0 - furnaces_mean(t, i), report_number(t, i, "error"));
}

void furnaces_write_balls(report_page *page, const report_table *t)
{
	report_text(page,
		    "Light that a whole ball loses, in %%: what was scattered more than once on the surface, which "
		    "single scattering leaves out. Negative: light that is made. The last digit printed is ten "
		    "times the quadrature's own error or more; 0: no more than that.\n\n| surface |");
	for (int k = 0; k < FURNACES_SHOWN; k++)
		report_text(page, " alpha %g |", furnaces_surfaces[0].shown[k]);
	report_text(page, "\n|---|--:|--:|--:|--:|--:|\n");
	for (size_t s = 0; s < furnaces_surface_count; s++) {
		const furnaces_surface *surface = &furnaces_surfaces[s];
		if (!furnaces_by_alpha(surface))
			continue;
		report_text(page, "| %s |", surface->name);
		for (int k = 0; k < FURNACES_SHOWN; k++)
			report_text(page, " %s |", furnaces_ball_loses(t, surface->name, surface->shown[k]).text);
		report_text(page, "\n");
	}
	report_text(page, "\n");
}

void furnaces_write_angles(report_page *page, const report_table *t)
{
	const char *name = "", *family = "";
	double value = -1.0, error = 0.0;
	report_text(page,
		    "<details><summary>Light that is not sent back, in %%, by the view's angle from the normal, of "
		    "every surface</summary>\n\n| surface | value | 0 deg | 45 | 60 | 75 | 85 | ball |\n"
		    "|---|---|--:|--:|--:|--:|--:|--:|");
	for (size_t i = 0; i < report_table_rows(t); i++) {
		const double here = report_number(t, i, "value");
		if (strcmp(report_cell(t, i, "what"), "profile") == 0)
			continue;
		if (strcmp(family, report_cell(t, i, "family")) != 0) {
			family = report_cell(t, i, "family");
			report_text(page, "\n| *%s* | | | | | | | |", family);
		}
		if (strcmp(name, report_cell(t, i, "name")) != 0 || here != value) {
			name = report_cell(t, i, "name");
			value = here;
			report_text(page, "\n| %s%s | %s %g |", name,
				    report_number(t, i, "absorbs") != 0.0 ? " (absorbs)" : "",
				    report_cell(t, i, "axis"), value);
		}
		error = fmax(error, report_number(t, i, "error"));
		report_text(page, " %s |", lost_text(1.0 - furnaces_mean(t, i), report_number(t, i, "error")).text);
	}
	report_text(page, "\n\n</details>\n\nThe error of any of these numbers is at most %.1g %%.\n\n", 100.0 * error);
}
