/* furnaces_white.c - the white furnace over value and angle, and what of it makes light. */
#include <math.h>
#include <string.h>

#include "furnaces.h"

static size_t values(int quick) { return quick ? 11 : 33; }
static size_t cosines(int quick) { return quick ? 9 : 32; }

static size_t units(int quick)
{
	furnaces_prepare();
	return furnaces_surface_count * values(quick);
}

void furnaces_white_rows(const furnaces_surface *s, size_t i, int quick, report_rows *rows)
{
	const double value = furnaces_value(s, i, values(quick));
	for (size_t k = 0; k < cosines(quick); k++) {
		const double cosine = ((double)k + 0.5) / (double)cosines(quick);
		const furnaces_energy e = furnaces_energy_at(s, value, cosine, FURNACES_ROUGH);
		report_row(rows, "%s,%s,%s,%d,%g,%s,%.6g,%.6g,%.7f,%.7f,%.7f,%.2g", s->family, s->lobe, s->name,
			   s->no_surface, s->stated, s->axis, value, cosine, e.rgb[0], e.rgb[1], e.rgb[2], e.error);
	}
}

static int run(int quick, size_t unit, report_rows *rows)
{
	furnaces_white_rows(&furnaces_surfaces[unit / values(quick)], unit % values(quick), quick, rows);
	return 0;
}

const report_study furnaces_white = {.name = "furnaces_white",
				     .columns = "family,lobe,name,no_surface,stated,axis,value,cos,r,g,b,error",
				     .units = units,
				     .run = run};

double furnaces_mean(const report_table *t, size_t row)
{
	return (report_number(t, row, "r") + report_number(t, row, "g") + report_number(t, row, "b")) / 3.0;
}

int furnaces_gains(const report_table *t, const char *name, size_t *most)
{
	double worst = 0.0, brightest = -HUGE_VAL;
	int found = 0;
	for (size_t i = 0; i < report_table_rows(t); i++) {
		if (name ? strcmp(report_cell(t, i, "name"), name) != 0 : report_number(t, i, "no_surface") != 0.0)
			continue;
		const double energy = furnaces_mean(t, i);
		/* What is no number is no furnace that holds. */
		const double above = isnan(energy) ? HUGE_VAL
						   : energy - 1.0 - report_number(t, i, "error") - FURNACES_ROUNDING -
							     report_number(t, i, "stated");
		if (above > worst || (!found && energy > brightest))
			*most = i;
		found |= above > worst;
		worst = fmax(worst, above);
		brightest = fmax(brightest, energy);
	}
	return found;
}
