/* stability.c - the section "stability": stiff and extreme corners of every lobe. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "stability_studies.h"

/* --- parts of the section ------------------------------------------------------------------------------------------------- */

static void write_counts(report_page *page, const report_table *t)
{
	double all[5] = {0};
	static const char *const columns[5] = {"elements", "samples", "non_finite", "negative", "pdf_differs"};
	report_text(
		page,
		"### What must never come out\n\nEach element is an eval, a pdf and a sample of a random corner, and "
		"then the eval and pdf of what was sampled.\n\n| lobe | elements | samples | not finite | "
		"negative | sample().pdf is not pdf() |\n|---|--:|--:|--:|--:|--:|\n");
	for (size_t l = 0; l < STABILITY_LOBES; l++) {
		double n[5] = {0};
		for (size_t row = 0; row < report_table_rows(t); row++)
			for (int k = 0; k < 5 && stability_is(t, row, "lobe", stability_lobe_names[l]); k++)
				n[k] += report_number(t, row, columns[k]);
		for (int k = 0; k < 5; k++)
			all[k] += n[k];
		report_text(page, "| %s | %.0f | %.0f | %.0f | %.0f | %.0f |\n", stability_lobe_names[l], n[0], n[1],
			    n[2], n[3], n[4]);
	}
	report_text(page, "| **all** | %.0f | %.0f | %.0f | %.0f | %.0f |\n\n", all[0], all[1], all[2], all[3], all[4]);
	report_finding(
		page,
		"Of %.3g results at stiff and extreme corners of %d lobes, %.0f are not finite and %.0f negative; "
		"sample().pdf is pdf() bit for bit in %.6g %% of %.3g samples.",
		all[0] * 3.0, STABILITY_LOBES, all[2], all[3], 100.0 * (1.0 - all[4] / all[1]), all[1]);
}

/* The row of the largest error in floors, reflectances counted in roundings of 1: against one reference, of all results
 * or of those that no class explains. */
static size_t worst_of(const report_table *t, const char *reference, int unexplained)
{
	size_t worst = 0;
	double most = -1.0;
	for (size_t row = 0; row < report_table_rows(t); row++)
		if (stability_is(t, row, "yardstick", "floor of one") && stability_is(t, row, "reference", reference) &&
		    (!unexplained || stability_is(t, row, "class", stability_class_names[STABILITY_PLAIN])) &&
		    report_number(t, row, "found") > most) {
			worst = row;
			most = report_number(t, row, "found");
		}
	return worst;
}

/* Relative error. */
static double off_by(const report_table *t, size_t row)
{
	const double exact = report_number(t, row, "exact");
	return fabs(report_number(t, row, "value") - exact) / fabs(exact);
}

static void write_worst(report_page *page, const report_table *t)
{
	report_text(
		page,
		"### Worst cases\n\nFound by ascents (simplex method on the logarithms of the parameters and on "
		"angles, then "
		"single ulps) from the worst of some hundred draws each, on error over floor, undetermined and tiny "
		"cases apart; *of one* as above. Inputs as hexadecimal floats, parameters p*n* as the arguments of "
		"`make` in `tests/cases_make.h`, 0 where they are not named.\n\n| lobe | result | yardstick | drawn | found | value | exact | "
		"error "
		"[ulp] | floor (directions') | reason | inputs |\n|---|---|---|--:|--:|--:|--:|--:|--:|---|---|\n");
	for (size_t row = 0; row < report_table_rows(t); row++) {
		report_text(page, "| %s | %s | %s | %.3g | %.3g | %s | %s | %s | %s (%s) | %s | `%s` |\n",
			    report_cell(t, row, "lobe"), report_cell(t, row, "verb"), report_cell(t, row, "yardstick"),
			    report_number(t, row, "drawn"), report_number(t, row, "found"),
			    report_cell(t, row, "value"), report_cell(t, row, "exact"), report_cell(t, row, "ulp"),
			    report_cell(t, row, "floor"), report_cell(t, row, "floor_directions"),
			    report_number(t, row, "found") > STABILITY_LIMIT ? report_cell(t, row, "class") : "-",
			    report_cell(t, row, "inputs"));
	}
	report_text(page, "\n");
	const size_t worst = worst_of(t, "textbook", 0), plain = worst_of(t, "textbook", 1);
	const size_t other = worst_of(t, "double build", 1);
	report_finding(
		page,
		"The worst that ascents from many starts find against the textbook is %.3g floors (reflectances "
		"counted in roundings of 1): %s of %s, %s for %s, by its reason: %s. Of what no reason covers, %.3g "
		"(%s of %s, off by %.2g of it), and %.3g against the double build (%s of %s, off by %.2g).",
		report_number(t, worst, "found"), report_cell(t, worst, "verb"), report_cell(t, worst, "lobe"),
		report_cell(t, worst, "value"), report_cell(t, worst, "exact"), report_cell(t, worst, "class"),
		report_number(t, plain, "found"), report_cell(t, plain, "verb"), report_cell(t, plain, "lobe"),
		off_by(t, plain), report_number(t, other, "found"), report_cell(t, other, "verb"),
		report_cell(t, other, "lobe"), off_by(t, other));
}

/* The largest view cosine from which on down the median floor is above a hundredth; 0: none. */
static double ends_at(const report_table *t, const char *map, double alpha)
{
	double least = 1e9, end = 0.0;
	for (size_t row = 0; row < report_table_rows(t); row++)
		if (stability_is(t, row, "map", map) && stability_is(t, row, "verb", "pdf"))
			least = fmin(least, fabs(log(report_number(t, row, "alpha") / alpha)));
	for (size_t row = 0; row < report_table_rows(t); row++)
		if (stability_is(t, row, "map", map) && stability_is(t, row, "verb", "pdf") &&
		    fabs(log(report_number(t, row, "alpha") / alpha)) <= least + 1e-9 &&
		    report_number(t, row, "floor_median") > 0.01)
			end = fmax(end, report_number(t, row, "cos"));
	return end;
}

static void write_maps(report_page *page, const report_table *t)
{
	static const char *const names[][2] = {{"ggx_conductor", "gold, GGX"},
					       {"beckmann_conductor", "gold, Beckmann"},
					       {"ggx_dielectric", "glass, GGX, seen from outside"},
					       {"ggx_dielectric_inside", "glass, GGX, seen from inside"}};
	static const double alphas[3] = {1e-4, 1e-3, 1e-2};
	char text[512];
	size_t used = 0;
	report_text(page, "### Over width and angle\n\nwi is what the lobe itself samples: where its value counts. "
			  "Cells hold the "
			  "worst case, the floor its median. Where the floor is above a hundredth, the answer is known "
			  "to two digits "
			  "at best, whoever computes it.\n\n");
	for (size_t m = 0; m < sizeof names / sizeof *names; m++) {
		char file[64], definitions[256];
		snprintf(file, sizeof file, "stability_map_%s.png", names[m][0]);
		snprintf(definitions, sizeof definitions, "MAP='%s'; TITLE='%s'; FILE='%s'", names[m][0], names[m][1],
			 file);
		report_gnuplot(page, "stability_map.gp", definitions);
		report_figure(page, file, "%s: error in ulp, error over floor, and the floor, of eval and pdf.",
			      names[m][1]);
	}
	report_text(page, "Median floor of pdf above 1 %% at and below the view cosine of:\n\n| alpha |");
	for (size_t m = 0; m < sizeof names / sizeof *names; m++)
		report_text(page, " %s |", names[m][1]);
	report_text(page, "\n|--:|--:|--:|--:|--:|\n");
	for (int k = 0; k < 3; k++) {
		report_text(page, "| %g |", alphas[k]);
		for (size_t m = 0; m < sizeof names / sizeof *names; m++) {
			const double end = ends_at(t, names[m][0], alphas[k]);
			if (end > 0.0)
				report_text(page, " %.2g |", end);
			else
				report_text(page, " never |");
		}
		report_text(page, "\n");
		const double end = ends_at(t, names[0][0], alphas[k]);
		if (end > 0.0 && used < sizeof text)
			used += (size_t)snprintf(text + used, sizeof text - used, "%scosine %.2g at alpha %g",
						 used ? ", " : "", end, alphas[k]);
	}
	report_text(page, "\n");
	if (used)
		report_finding(page,
			       "Where single precision ends: half an ulp of the directions moves a GGX metal's density "
			       "by more "
			       "than 1 %% from "
			       "a view %s down; no formula can do better with directions of floats.",
			       text);
}

static void write_forms(report_page *page, const report_table *t)
{
	char text[512];
	size_t used = 0;
	report_text(page,
		    "### As textbooks print it\n\nThe same inputs through the printed form and through the library's, "
		    "both in single "
		    "precision; worst relative error and worst error over floor, cases with a floor above a tenth "
		    "apart.\n\n"
		    "| what | printed | worst error | /floor | not a number | the library | worst error | /floor |\n"
		    "|---|---|--:|--:|--:|---|--:|--:|\n");
	report_readme(
		page,
		"Forms as textbooks print them and the library's, both in single precision, at stiff and extreme "
		"corners: worst "
		"relative error, and worst error over what half an ulp of the inputs does to the exact answer.\n\n"
		"| what | printed: error | over floor | library: error | over floor |\n|---|--:|--:|--:|--:|\n");
	for (int f = 0; f < STABILITY_FORMS; f++) {
		double worst[4] = {0}, failed = 0.0;
		static const char *const columns[4] = {"textbook", "textbook_over_floor", "ours", "ours_over_floor"};
		for (size_t row = 0; row < report_table_rows(t); row++) {
			if ((int)report_number(t, row, "form") != f)
				continue;
			failed += report_number(t, row, "textbook_failed");
			for (int k = 0; k < 4; k++)
				worst[k] = fmax(worst[k], report_number(t, row, columns[k]));
		}
		report_text(page, "| %s | %s | %.2g | %.2g | %.0f | %s | %.2g | %.2g |\n", stability_forms[f].name,
			    stability_forms[f].textbook, worst[0], worst[1], failed, stability_forms[f].ours, worst[2],
			    worst[3]);
		report_readme(page, "| %s | %.2g | %.2g | %.2g | %.2g |\n", stability_forms[f].name, worst[0], worst[1],
			      worst[2], worst[3]);
		if (used < sizeof text)
			used += (size_t)snprintf(text + used, sizeof text - used, "%s%s %.1g, %.1g (%.1g, %.1g)",
						 used ? "; " : "", stability_forms[f].name, worst[0], worst[1],
						 worst[2], worst[3]);
	}
	report_text(page, "\n");
	report_readme(page, "\n![](doc/stability_forms.png)\n\n");
	report_gnuplot(page, "stability_forms.gp", NULL);
	report_figure(page, "stability_forms.png",
		      "Worst relative error of the printed form and of the library's over what "
		      "makes the printed one fail, with the mean floor.");
	report_finding(page,
		       "Printed forms in single precision, worst relative error and worst error over floor (the "
		       "library's): %s.",
		       text);
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	(void)quick;
	report_text(page,
		    "Random corners of every lobe: alpha 1e-4 to 1, anisotropy to 1:1e4, cosines to 1e-7 on both sides "
		    "and to 1, "
		    "eta 1 +- 1e-7, 1/1000 and 1000, k to 100, u at 0, 1 - 2^-24 and subnormal, mean slopes to 100, "
		    "correlations to +-0.9999, directions off unit length by up to four ulp; wi mostly where the lobe "
		    "is.\n\n");
	write_counts(page, tables[1]);
	stability_write_errors(page, tables[0]);
	write_worst(page, tables[2]);
	write_maps(page, tables[3]);
	write_forms(page, tables[4]);
}

const report_section stability_section = {
	"stability",
	"Stability",
	"Where does single precision end?",
	{&stability_sweep, &stability_counting, &stability_worst, &stability_maps, &stability_forming},
	write};
