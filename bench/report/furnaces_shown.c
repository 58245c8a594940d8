/* furnaces_shown.c - the energy at the values and angles of the tables, and averaged over the hemisphere: what a ball in
 * constant light sends back. */
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "furnaces.h"

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
	double value, error;
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
	b->error = fmax(b->error, e.error);
	return (e.rgb[0] + e.rgb[1] + e.rgb[2]) / 3.0 * 4.0 * v * v * v;
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const furnaces_surface *s = &furnaces_surfaces[unit / FURNACES_SHOWN];
	const double value = s->shown[unit % FURNACES_SHOWN];
	ball b = {s, value, 0.0, quick ? FURNACES_ROUGH : FURNACES_FINE, rows};
	gsl_function f = {at_root, &b};
	furnaces_energy mean = {{0.0, 0.0, 0.0}, 0.0};
	double error, scale, size;
	for (int k = 0; k < ANGLES; k++) {
		const furnaces_energy e = furnaces_energy_at(s, value, cos(angles[k] * 3.14159265358979323846 / 180.0),
							     quick ? FURNACES_ROUGH : FURNACES_FINEST);
		row(rows, s, value, "angle", angles[k], &e);
	}
	/* 10 Gauss points and 11 more (Kronrod), whose difference is what the former are off by. */
	gsl_integration_qk21(&f, 0.0, 1.0, &mean.rgb[0], &error, &scale, &size);
	mean.rgb[1] = mean.rgb[2] = mean.rgb[0];
	mean.error = error + b.error;
	row(rows, s, value, "mean", 0.0, &mean);
	return 0;
}

const report_study furnaces_shown = {.name = "furnaces_shown",
				     .columns = "family,lobe,name,no_surface,absorbs,axis,value,what,at,r,g,b,error",
				     .units = units,
				     .run = run};

/* --- tables ------------------------------------------------------------------------------------------------------------- */

static double mean_of(const report_table *t, size_t i)
{
	return (report_number(t, i, "r") + report_number(t, i, "g") + report_number(t, i, "b")) / 3.0;
}

/* What is lost, with as many digits as its error leaves: the last one printed is ten times that error or more. */
static void lost_cell(report_page *page, double lost, double error)
{
	const double percent = 100.0 * lost, unit = 1000.0 * fmax(error, 1e-7);
	const int digits = (int)fmin(fmax(ceil(-log10(unit) - 1e-9), 0.0), 4.0);
	if (fabs(percent) < 0.5 * pow(10.0, -digits))
		report_text(page, " 0 |");
	else
		report_text(page, " %.*f |", digits, percent);
}

void furnaces_write_losses(report_page *page, const report_table *t)
{
	const char *name = "", *axis = "";
	double value = -1.0, error = 0.0;
	for (int absorbs = 0; absorbs < 2; absorbs++) {
		report_text(page,
			    absorbs ? "\nThose that absorb, in %% of the light that they do not send back:\n\n"
				    : "Light that is lost, in %%: scattered more than once on the surface, which single "
				      "scattering leaves out; by the view's angle from the normal, and from a whole ball. "
				      "Negative: light that is made. The last digit printed is ten times the "
				      "quadrature's own error or more; 0: no more than that.\n\n");
		report_text(page, "| surface | value | 0 deg | 45 | 60 | 75 | 85 | ball |\n|---|---|--:|--:|--:|--:|--:|"
				  "--:|");
		for (size_t i = 0; i < report_table_rows(t); i++) {
			const char *what = report_cell(t, i, "what");
			const double lost = 1.0 - mean_of(t, i), here = report_number(t, i, "value");
			if ((report_number(t, i, "absorbs") != 0.0) != absorbs || strcmp(what, "profile") == 0)
				continue;
			error = fmax(error, report_number(t, i, "error"));
			if (strcmp(name, report_cell(t, i, "name")) != 0 || here != value) {
				name = report_cell(t, i, "name");
				axis = report_cell(t, i, "axis");
				value = here;
				report_text(page, "\n| %s | %s %g |", name, axis, value);
			}
			lost_cell(page, lost, report_number(t, i, "error"));
		}
		report_text(page, "\n");
	}
	report_text(page, "\nThe error of any of these numbers is at most %.1g %%.\n\n", 100.0 * error);
}
