/* furnaces.c - the section: what single scattering loses, what makes light, and whether masking belongs to its surface. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "furnaces.h"

/* What a ball of that surface and value sends back. */
static double ball(const report_table *t, const char *name, double value)
{
	for (size_t i = 0; i < report_table_rows(t); i++)
		if (strcmp(report_cell(t, i, "name"), name) == 0 && strcmp(report_cell(t, i, "what"), "mean") == 0 &&
		    fabs(report_number(t, i, "value") - value) < 1e-6)
			return report_number(t, i, "g");
	fprintf(stderr, "report: no rows of %s\n", name);
	exit(1);
}

static void write_losses(report_page *page, const report_table *shown)
{
	report_finding(page,
		       "Single scattering loses %.1f %% of the light on a white ball of GGX metal at alpha 1, %.1f %% at "
		       ".6, %.1f %% at .3, %.1f %% at .1; Beckmann's %.1f, %.1f, %.1f and %.1f %%; GGX glass 1.5 %.1f, "
		       "%.1f, %.1f and %.1f %%",
		       100.0 * (1.0 - ball(shown, "ggx_conductor", 1.0)), 100.0 * (1.0 - ball(shown, "ggx_conductor", 0.6)),
		       100.0 * (1.0 - ball(shown, "ggx_conductor", 0.3)), 100.0 * (1.0 - ball(shown, "ggx_conductor", 0.1)),
		       100.0 * (1.0 - ball(shown, "beckmann_conductor", 1.0)),
		       100.0 * (1.0 - ball(shown, "beckmann_conductor", 0.6)),
		       100.0 * (1.0 - ball(shown, "beckmann_conductor", 0.3)),
		       100.0 * (1.0 - ball(shown, "beckmann_conductor", 0.1)),
		       100.0 * (1.0 - ball(shown, "ggx_dielectric 1.5", 1.0)),
		       100.0 * (1.0 - ball(shown, "ggx_dielectric 1.5", 0.6)),
		       100.0 * (1.0 - ball(shown, "ggx_dielectric 1.5", 0.3)),
		       100.0 * (1.0 - ball(shown, "ggx_dielectric 1.5", 0.1)));
}

/* Surfaces that make light: none should; and those that are no surfaces and do. */
static void write_gains(report_page *page, const report_table *white)
{
	const char *name = "";
	char makers[512] = "";
	size_t row = 0, cells = 0, surfaces = 0, used = 0;
	double most, error = 0.0;
	for (size_t i = 0; i < report_table_rows(white); i++) {
		cells += report_number(white, i, "no_surface") == 0.0;
		error = fmax(error, report_number(white, i, "error"));
		if (strcmp(report_cell(white, i, "name"), name) == 0)
			continue;
		name = report_cell(white, i, "name");
		surfaces += report_number(white, i, "no_surface") == 0.0;
		if (report_number(white, i, "no_surface") != 0.0 && furnaces_gains(white, name, &row, &most))
			used += (size_t)snprintf(makers + used, used < sizeof makers ? sizeof makers - used : 0,
						 "%s%s (up to %.3g)", used ? ", " : "", name, most);
	}
	if (furnaces_gains(white, NULL, &row, &most))
		report_finding(page,
			       "**%s makes light**: %.5f of it is sent back at %s %s, cosine %s, quadrature good to %s",
			       report_cell(white, row, "name"),
			       (report_number(white, row, "r") + report_number(white, row, "g") +
				report_number(white, row, "b")) /
				       3.0,
			       report_cell(white, row, "axis"), report_cell(white, row, "value"),
			       report_cell(white, row, "cos"), report_cell(white, row, "error"));
	else
		report_finding(page,
			       "No surface makes light: of %zu white furnaces of %zu surfaces none is above 1 by more than "
			       "the quadrature's error (%.0e at worst); the most is %.6f. Of masking that is no "
			       "surface's these do: %s",
			       cells, surfaces, error, most, used ? makers : "none");
}

static void write_maskings(report_page *page, const report_table *shown)
{
	report_finding(page,
		       "On a GGX ball of alpha .6 masking decides how much is lost: height-correlated %.1f %%, separable "
		       "%.1f %%, V-cavities %.1f %%, Schlick-Smith with alpha/2 %.1f %%, Disney's %.1f %%, implicit %.1f %%",
		       100.0 * (1.0 - ball(shown, "Smith height-correlated", 0.6)),
		       100.0 * (1.0 - ball(shown, "Smith separable", 0.6)), 100.0 * (1.0 - ball(shown, "V-cavities", 0.6)),
		       100.0 * (1.0 - ball(shown, "Schlick-Smith alpha/2", 0.6)),
		       100.0 * (1.0 - ball(shown, "Disney", 0.6)), 100.0 * (1.0 - ball(shown, "implicit", 0.6)));
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	(void)quick;
	report_text(page,
		    "What a surface sends back of constant light 1, by quadrature over its facets (tests/test_report_furnaces.c "
		    "holds it against closed forms); each number's error is what doubling the points changes. Every lobe is "
		    "made white: reflectance 1, or as little absorption as its parameters allow.\n\n");
	write_losses(page, tables[1]);
	write_gains(page, tables[0]);
	write_maskings(page, tables[1]);
	furnaces_draw_balls(page, tables[1]);
	furnaces_write_losses(page, tables[1]);
	furnaces_draw_maps(page, tables[0]);
	furnaces_write_weak(page, tables[2]);
}

const report_section furnaces_section = {
	"furnaces", "Furnaces: the energy that is kept", {&furnaces_white, &furnaces_shown, &furnaces_weak}, write};
