/* furnaces.c - the section: what single scattering loses, what makes light, and whether masking
 * belongs to its surface. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "furnaces.h"

static void write_losses(report_page *page, const report_table *shown)
{
	static const char *const names[3] = {"ggx_conductor", "beckmann_conductor", "ggx_dielectric 1.5"};
	furnaces_lost lost[3][4];
	for (int s = 0; s < 3; s++)
		for (int k = 0; k < 4; k++)
			lost[s][k] = furnaces_ball_loses(shown, names[s], furnaces_surfaces[0].shown[4 - k]);
	report_finding(
		page,
		"Single scattering loses %s %% of the light on a white ball of GGX metal at alpha %g, %s at %g, %s at "
		"%g, %s at %g; Beckmann's %s, %s, %s and %s %%; GGX glass 1.5 %s, %s, %s and %s %%",
		lost[0][0].text, furnaces_surfaces[0].shown[4], lost[0][1].text, furnaces_surfaces[0].shown[3],
		lost[0][2].text, furnaces_surfaces[0].shown[2], lost[0][3].text, furnaces_surfaces[0].shown[1],
		lost[1][0].text, lost[1][1].text, lost[1][2].text, lost[1][3].text, lost[2][0].text, lost[2][1].text,
		lost[2][2].text, lost[2][3].text);
}

/* Surfaces that make light: none should; and those that are no surfaces and do. */
static void write_gains(report_page *page, const report_table *white)
{
	const char *name = "";
	char makers[512] = "";
	size_t most = 0, cells = 0, surfaces = 0, used = 0;
	double error = 0.0;
	for (size_t i = 0; i < report_table_rows(white); i++) {
		const int no_surface = report_number(white, i, "no_surface") != 0.0;
		cells += !no_surface;
		if (!no_surface && report_number(white, i, "stated") == 0.0)
			error = fmax(error, report_number(white, i, "error"));
		if (strcmp(report_cell(white, i, "name"), name) == 0)
			continue;
		name = report_cell(white, i, "name");
		surfaces += !no_surface;
		if (no_surface && furnaces_gains(white, name, &most) && used < sizeof makers)
			used += (size_t)snprintf(makers + used, sizeof makers - used, "%s%s (up to %.3g)",
						 used ? ", " : "", name, furnaces_mean(white, most));
	}
	const int gains = furnaces_gains(white, NULL, &most);
	char at[256];
	snprintf(at, sizeof at, "%.6f, %s at %s %s and cosine %s, its quadrature good to %s",
		 furnaces_mean(white, most), report_cell(white, most, "name"), report_cell(white, most, "axis"),
		 report_cell(white, most, "value"), report_cell(white, most, "cos"), report_cell(white, most, "error"));
	if (gains)
		report_finding(page, "**A surface makes light**: it sends back %s", at);
	else
		report_finding(
			page,
			"No surface makes light beyond what its header says: of %zu white furnaces of %zu surfaces "
			"none is above 1 by more than the quadrature's error (%.0e at worst) and, of "
			"`microfacet_diffuse`, what fixed facets are off by; the brightest is %s. Of masking that is "
			"no surface's these do: %s",
			cells, surfaces, error, at, used ? makers : "none");
}

static void write_maskings(report_page *page, const report_table *shown)
{
	static const char *const names[6] = {"Smith height-correlated", "Smith separable", "V-cavities",
					     "Schlick-Smith alpha/2",   "Disney",          "implicit"};
	const double alpha = furnaces_surfaces[0].shown[3];
	furnaces_lost lost[6];
	for (int k = 0; k < 6; k++)
		lost[k] = furnaces_ball_loses(shown, names[k], alpha);
	report_finding(
		page,
		"On a GGX ball of alpha %g masking decides how much is lost: height-correlated %s %%, separable %s %%, "
		"V-cavities %s %%, Schlick-Smith with alpha/2 %s %%, Disney's %s %%, implicit %s %%",
		alpha, lost[0].text, lost[1].text, lost[2].text, lost[3].text, lost[4].text, lost[5].text);
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	(void)quick;
	report_text(page, "What a surface sends back of constant light 1, by quadrature over its facets "
			  "(tests/test_report_furnaces.c "
			  "holds it against closed forms); each number's error is twice what more points change. "
			  "Every lobe is "
			  "made white: reflectance 1, or as little absorption as its parameters allow.\n\n");
	write_losses(page, tables[1]);
	write_gains(page, tables[0]);
	write_maskings(page, tables[1]);
	furnaces_draw_balls(page, tables[1]);
	furnaces_write_balls(page, tables[1]);
	furnaces_write_angles(page, tables[1]);
	furnaces_draw_maps(page, tables[0]);
	furnaces_write_weak(page, tables[2]);
}

const report_section furnaces_section = {
	"furnaces", "Furnaces: the energy that is kept", "What does single scattering lose?", {&furnaces_white, &furnaces_shown, &furnaces_weak}, write};
