/* furnaces_weak.c - the weak furnace: the facets that a direction sees are as large as the mean plane, where masking is
 * a surface's (Heitz 2014, eq. 12). Kelemen's and Neumann's masking is none of a single direction and has no such
 * furnace. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "furnaces.h"

typedef struct {
	const char *masking;
	unsigned what, shape;
	int must_hold;
} pair;

enum { OWN = FURNACES_SHAPES, OTHERS = 7, PAIRS = 2 * OWN + OTHERS };

static pair pair_at(size_t i)
{
	static const pair others[OTHERS] = {
		{"Smith rational", LOBE_MASKING_SMITH_RATIONAL, 1, 0},
		{"no masking", LOBE_MASKING_NONE, 0, 0},
		{"implicit", LOBE_MASKING_IMPLICIT, 0, 0},
		{"Schlick-Smith alpha/2", LOBE_MASKING_SCHLICK_GGX, 0, 0},
		{"Schlick-Smith alpha sqrt(2/pi)", LOBE_MASKING_SCHLICK_SMITH, 0, 0},
		{"Schlick-Smith (r + 1)^2/8", LOBE_MASKING_SCHLICK_GGX_LIGHTS, 0, 0},
		{"Disney", LOBE_MASKING_DISNEY, 0, 0},
	};
	if (i >= 2 * OWN)
		return others[i - 2 * OWN];
	const pair own = {i < OWN ? "Smith" : "V-cavities", i < OWN ? LOBE_MASKING_SMITH : LOBE_MASKING_VCAVITY,
			  (unsigned)(i % OWN), 1};
	return own;
}

static size_t values(int quick) { return quick ? 11 : 33; }
static size_t cosines(int quick) { return quick ? 9 : 32; }

static size_t units(int quick)
{
	furnaces_prepare();
	return PAIRS * values(quick);
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const pair p = pair_at(unit / values(quick));
	const double r = 0.04 + 0.96 * (double)(unit % values(quick)) / (double)(values(quick) - 1), alpha = r * r;
	for (size_t k = 0; k < cosines(quick); k++) {
		const double cosine = ((double)k + 0.5) / (double)cosines(quick);
		const furnaces_energy e = furnaces_weak_at(p.shape, p.what, alpha, cosine, 0.0);
		const double known =
			p.shape == 0 || p.must_hold ? furnaces_weak_known(p.what, alpha, cosine) : (double)NAN;
		char closed[32] = "";
		if (!isnan(known))
			snprintf(closed, sizeof closed, "%.9g", known);
		report_row(rows, "%s,%s,%d,%.6g,%.6g,%.9g,%.2g,%s", p.masking, furnaces_shape_names[p.shape],
			   p.must_hold, alpha, cosine, e.rgb[0], e.error, closed);
	}
	return 0;
}

const report_study furnaces_weak = {.name = "furnaces_weak",
				    .columns = "masking,distribution,must_hold,alpha,cos,value,error,known",
				    .units = units,
				    .run = run};

/* --- the section -------------------------------------------------------------------------------------------------- */

typedef struct {
	const char *masking, *distribution;
	size_t first, count;
	int must_hold;
	double least, most, least_at[2], most_at[2], off, error, known_off;
} summary;

static summary summary_from(const report_table *t, size_t first)
{
	summary s = {report_cell(t, first, "masking"),
		     report_cell(t, first, "distribution"),
		     first,
		     0,
		     report_number(t, first, "must_hold") != 0.0,
		     HUGE_VAL,
		     -HUGE_VAL,
		     {0, 0},
		     {0, 0},
		     0.0,
		     0.0,
		     (double)NAN};
	for (size_t i = first; i < report_table_rows(t); i++) {
		const double w = report_number(t, i, "value");
		if (strcmp(report_cell(t, i, "masking"), s.masking) != 0 ||
		    strcmp(report_cell(t, i, "distribution"), s.distribution) != 0)
			break;
		s.count++;
		if (w < s.least) {
			s.least = w;
			s.least_at[0] = report_number(t, i, "alpha");
			s.least_at[1] = report_number(t, i, "cos");
		}
		if (w > s.most) {
			s.most = w;
			s.most_at[0] = report_number(t, i, "alpha");
			s.most_at[1] = report_number(t, i, "cos");
		}
		s.off = fmax(s.off, fabs(w - 1.0));
		s.error = fmax(s.error, report_number(t, i, "error"));
		if (report_cell(t, i, "known")[0]) {
			const double known = report_number(t, i, "known");
			s.known_off = fmax(isnan(s.known_off) ? 0.0 : s.known_off, fabs(w / known - 1.0));
		}
	}
	return s;
}

void furnaces_write_weak(report_page *page, const report_table *t)
{
	FILE *own = report_open("furnaces_weak_own.dat"), *others = report_open("furnaces_weak_others.dat");
	FILE *titles = report_open("furnaces_weak_titles.gp");
	double held = 0.0, error = 0.0, failed = HUGE_VAL;
	const char *nearest = "";
	int counts[2] = {0, 0}, held_count = 0;
	report_text(
		page,
		"### The weak furnace\n\nThe area of the facets that a direction sees, over the mean plane's: 1 where "
		"masking is a surface's own. Over alpha .0016 to 1 (the width that is most like GGX's) and the cosine; "
		"below, where it is least and most (alpha; cosine), and for GGX how far the integral is from the "
		"closed "
		"form G1 (mu + t)/(2 mu), relative.\n\n"
		"| masking | distribution | least | at | most | at | off 1 by | closed form off by | quadrature good "
		"to |\n"
		"|---|---|--:|---|--:|---|--:|--:|--:|\n");
	fprintf(titles, "array OWN[%d]\narray OTHERS[%d]\n", 2 * OWN, OTHERS);
	for (size_t i = 0; i < report_table_rows(t);) {
		const summary s = summary_from(t, i);
		char known[32] = "-";
		if (!isnan(s.known_off) && strcmp(s.distribution, "GGX") == 0)
			snprintf(known, sizeof known, "%.1e", s.known_off);
		report_text(page, "| %s | %s | %.4f | %.3g; %.2f | %.4f | %.3g; %.2f | %.1e | %s | %.0e |\n", s.masking,
			    s.distribution, s.least, s.least_at[0], s.least_at[1], s.most, s.most_at[0], s.most_at[1],
			    s.off, known, s.error);
		fprintf(titles, "%s[%d] = \"%s, %s\"\n", s.must_hold ? "OWN" : "OTHERS", ++counts[s.must_hold ? 0 : 1],
			s.distribution, s.masking);
		for (size_t k = i; k < i + s.count; k++)
			fprintf(s.must_hold ? own : others, "%g %g %.9g\n", sqrt(report_number(t, k, "alpha")),
				report_number(t, k, "cos"),
				s.must_hold ? fmax(fabs(report_number(t, k, "value") - 1.0), 1e-8)
					    : furnaces_tone(report_number(t, k, "value")));
		fprintf(s.must_hold ? own : others, "\n\n");
		if (s.must_hold) {
			held = fmax(held, s.off);
			error = fmax(error, s.error);
			held_count++;
		} else if (s.off < failed) {
			failed = s.off;
			nearest = s.masking;
		}
		i += s.count;
	}
	fclose(own);
	fclose(others);
	fclose(titles);
	report_text(page, "\nKelemen's and Neumann's have no masking of one direction, and so no weak furnace.\n");
	report_gnuplot(page, "furnaces_weak.gp", NULL);
	report_figure(
		page, "furnaces_weak_own.png",
		"|weak furnace - 1| of every distribution with Smith's masking and with V-cavities. What is seen is "
		"the roundings of single precision.");
	report_figure(page, "furnaces_weak_others.png",
		      "The weak furnace of masking that is no surface's: below 1 facets vanish, above it they are seen "
		      "twice.");
	report_finding(
		page,
		"Weak furnace: %d pairs of distribution and masking (Smith, V-cavities) keep it to %.1e (quadrature "
		"good to %.0e); each of the %d others breaks it somewhere by %.1e (%s) or more",
		held_count, held, error, counts[1], failed, nearest);
}
