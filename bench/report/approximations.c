/* approximations.c - the section: what an approximation is off by and what it saves. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "approximations.h"
#include "approximations_lobes.h"
#include "approximations_summary.h"
#include "csv.h"

/* --- the study of errors: three parts, one after another ---------------------------------------------------------- */

static const approximations_part *const parts[] = {&approximations_fresnel, &approximations_shadow,
						   &approximations_real};
enum { PARTS = sizeof parts / sizeof *parts };

static size_t error_units(int quick)
{
	size_t n = 0;
	(void)quick;
	approximations_film_nodes();
	for (int i = 0; i < PARTS; i++)
		n += parts[i]->units();
	return n;
}

static int error_run(int quick, size_t unit, report_rows *rows)
{
	int i = 0;
	for (; unit >= parts[i]->units(); i++)
		unit -= parts[i]->units();
	return parts[i]->run(quick, unit, rows);
}

static const report_study error_study = {
	.name = "approximations_error",
	.columns =
		"group,name,case,quantity,samples,max,at,rms,reference,albedo,albedo_alpha,albedo_cos,albedo_reference",
	.units = error_units,
	.run = error_run,
};

/* --- parts of the section ----------------------------------------------------------------------------------------- */

static void dielectrics(report_page *page, const report_table *errors, const report_table *times)
{
	static const char *const cases[] = {"eta 1.1", "eta 1.33", "eta 1.5", "eta 2", "eta 2.42", "eta 4"};
	approximations_summary all[APPROXIMATIONS_WAYS_MAX];
	report_text(
		page,
		"By index, Schlick's curve from the exact reflectance at normal incidence:\n\n| index | max error | "
		"RMS | albedo | ... with a fitted exponent, max | RMS | albedo |\n|---|---|---|---|---|---|---|\n");
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const approximations_summary s =
			approximations_summarise(errors, times, "dielectric", "Schlick", cases[i]);
		const approximations_summary f =
			approximations_summarise(errors, times, "dielectric", "Schlick; fitted exponent", cases[i]);
		report_text(page, "| %s | %.3f | %.4f | %.4f | %.3f | %.4f | %.4f |\n", cases[i], s.max, s.rms,
			    s.albedo, f.max, f.rms, f.albedo);
	}
	report_text(page, "\n");
	const int n = approximations_gather(errors, times, "dielectric", "eta 1.5", all);
	const approximations_summary *schlick = approximations_find(all, n, "Schlick"),
				     *exact = approximations_find(all, n, "exact");
	report_finding(
		page,
		"Schlick's reflectance at index 1.5 is off by up to %.3f, the albedo by up to %.4f, and saves %.2f of "
		"%.2f ns a call in a vectorised loop (%.1f of %.1f one by one)",
		schlick->max, schlick->albedo, exact->ns[0] - schlick->ns[0], exact->ns[0],
		exact->ns[1] - schlick->ns[1], exact->ns[1]);
}

static void conductors(report_page *page, const approximations_summary *all, int n)
{
	const approximations_summary *schlick = approximations_find(all, n, "Schlick"),
				     *f82 = approximations_find(all, n, "F82-tint"),
				     *exact = approximations_find(all, n, "exact");
	report_finding(
		page,
		"For metals F82-tint is off by at most %.3f (%s), albedo %.4f, where Schlick's curve is off by %.3f "
		"(%s), albedo %.4f; it costs %.2f ns a channel and Schlick's %.2f, the exact reflectance %.2f%s",
		f82->max, f82->max_case, f82->albedo, schlick->max, schlick->max_case, schlick->albedo, f82->ns[0],
		schlick->ns[0], exact->ns[0],
		exact->ns[0] > 0.9 * exact->ns[1] ? " (whose loop alone the compiler did not vectorise; in "
						    "`ggx_conductor` it does)"
						  : "");
}

static void lambdas(report_page *page, const approximations_summary *all, int n)
{
	const approximations_summary *rational = approximations_find(all, n, "Walter's rational"),
				     *own = approximations_find(all, n, "one polynomial"),
				     *erf = approximations_find(all, n, "erf and exp");
	report_finding(
		page,
		"Walter's rational Lambda puts G1 off by %.4f and the albedo of a Beckmann mirror by %.4f, and saves "
		"%.2f "
		"of %.2f ns over erf and exp; the library's polynomial is off by %.1g and takes %.2f ns, so that the "
		"rational form gains %.2f ns a call",
		rational->max, rational->albedo, erf->ns[0] - rational->ns[0], erf->ns[0], own->max, own->ns[0],
		own->ns[0] - rational->ns[0]);
}

static void maskings(report_page *page, const approximations_summary *all, int n)
{
	const approximations_summary *karis = approximations_find(all, n, "Schlick-Smith k = alpha/2"),
				     *separable = approximations_find(all, n, "Smith; separable"),
				     *height = approximations_find(all, n, "Smith; height-correlated");
	report_finding(page,
		       "On a GGX surface separable masking is up to %.3f of albedo off the height-correlated form at "
		       "%.2f against %.2f ns; Schlick-Smith with k = alpha/2 is %.3f off at %.2f ns%s",
		       separable->albedo, separable->ns[0], height->ns[0], karis->albedo, karis->ns[0],
		       fabs(karis->albedo - separable->albedo) < 1e-3 ? " (both at alpha 1, where they are one function)"
								      : "");
}

/* Root mean square of model - simulated over the pairs, and of the standard errors. */
static void fields(report_page *page, const report_table *rows)
{
	static const char *const sides[2] = {"same", "across"};
	static const char *const titles[2] = {"both directions above", "one above, one below (index 1.5)"};
	char best_name[2][64] = {"", ""}, next_name[2][64] = {"", ""};
	double best[2] = {DBL_MAX, DBL_MAX}, next[2] = {DBL_MAX, DBL_MAX}, noise = 0.0, separable = 0.0, height = 0.0;
	report_text(
		page,
		"### Masking against simulated height fields\n\n"
		"Facets with the half vector's slope on explicit Gaussian height fields (Beckmann's distribution; "
		"correlation exp(-r^2/2); a new field for each facet): the share of them that both directions see, "
		"against "
		"what each masking function says. Smith's model takes heights as uncorrelated with their neighbours', "
		"which no field is; so none of them is exact.\n\n");
	for (int side = 0; side < 2; side++) {
		struct {
			const char *name;
			double sum, sum2, max, error2, n;
		} m[8] = {{0}};
		int count = 0;
		for (size_t i = 0; i < report_table_rows(rows); i++) {
			const char *name = report_cell(rows, i, "model");
			int k = 0;
			if (strcmp(report_cell(rows, i, "side"), sides[side]) != 0)
				continue;
			while (k < count && strcmp(m[k].name, name) != 0)
				k++;
			if (k == count && count++ < 8)
				m[k].name = name;
			const double off = report_number(rows, i, "value") - report_number(rows, i, "seen_both");
			const double error = report_number(rows, i, "error");
			m[k].sum += off;
			m[k].sum2 += off * off;
			m[k].error2 += error * error;
			m[k].max = fmax(m[k].max, fabs(off));
			m[k].n += 1.0;
		}
		report_text(page,
			    "| %s | RMS off | mean off | at most | standard error of the simulation | pairs |\n"
			    "|---|---|---|---|---|---|\n",
			    titles[side]);
		for (int k = 0; k < count; k++) {
			const double rms = sqrt(m[k].sum2 / m[k].n);
			report_text(page, "| %s | %.4f | %+.4f | %.4f | %.4f | %.0f |\n", m[k].name, rms,
				    m[k].sum / m[k].n, m[k].max, sqrt(m[k].error2 / m[k].n), m[k].n);
			noise = fmax(noise, sqrt(m[k].error2 / m[k].n));
			if (rms < best[side]) {
				next[side] = best[side];
				memcpy(next_name[side], best_name[side], sizeof next_name[side]);
				best[side] = rms;
				snprintf(best_name[side], sizeof best_name[side], "%s", m[k].name);
			} else if (rms < next[side]) {
				next[side] = rms;
				snprintf(next_name[side], sizeof next_name[side], "%s", m[k].name);
			}
			if (side == 0 && strcmp(m[k].name, "Smith; separable") == 0)
				separable = rms;
			if (side == 0 && strcmp(m[k].name, "Smith; height-correlated") == 0)
				height = rms;
		}
		report_text(page, "\n");
	}
	/* Two that differ by less than the simulation's error are not told apart by it. */
	char or_next[2][96] = {"", ""};
	for (int side = 0; side < 2; side++)
		if (next[side] - best[side] < noise)
			snprintf(or_next[side], sizeof or_next[side], " or \"%s\" (not told apart)", next_name[side]);
	report_finding(page,
		       "Of simulated Gaussian height fields the nearest joint masking is \"%s\"%s (RMS %.3f; "
		       "height-correlated %.3f, separable %.3f) on one side and \"%s\"%s across (RMS %.3f); the "
		       "simulation's standard error is %.4f",
		       best_name[0], or_next[0], best[0], height, separable, best_name[1], or_next[1], best[1], noise);
}

static void reals(report_page *page, const approximations_summary *all, int n)
{
	double worst = 0.0, product = 1.0, product_cl = 1.0;
	int faster = 0, compared = 0, cl = 0;
	const char *worst_name = "";
	for (int i = 0; i < n; i++) {
		const char *slash = strchr(all[i].name, '/');
		char other[64];
		if (strcmp(slash, "/lobe") != 0)
			continue;
		if (all[i].max > worst) {
			worst = all[i].max;
			worst_name = all[i].name;
		}
		for (int k = 0; k < n; k++) {
			snprintf(other, sizeof other, "%.*s/libm", (int)(slash - all[i].name), all[i].name);
			if (strcmp(all[k].name, other) == 0) {
				compared++;
				faster += all[i].ns[0] < all[k].ns[0];
				product *= all[k].ns[0] / all[i].ns[0];
			}
			snprintf(other, sizeof other, "%.*s/OpenCL", (int)(slash - all[i].name), all[i].name);
			if (strcmp(all[k].name, other) == 0 && all[i].ns[2] > 0.0) {
				cl++;
				product_cl *= all[k].ns[2] / all[i].ns[2];
			}
		}
	}
	report_finding(
		page,
		"The library's elementary functions are within %.2f ulp (%.*s; sampled), and faster than libm's in a "
		"vectorisable loop in %d of %d cases, by a factor of %.1f in the geometric mean",
		worst, (int)strcspn(worst_name, "/"), worst_name, faster, compared,
		pow(product, 1.0 / fmax(compared, 1)));
	if (cl)
		report_finding(page,
			       "On OpenCL they take %.2f of the time of its built-in functions (geometric mean of %d)",
			       1.0 / pow(product_cl, 1.0 / cl), cl);
}

static void precision(report_page *page, const report_table *rows, const report_table *times)
{
	double worst = 0.0, albedo = 0.0, product = 1.0, product_scalar = 1.0;
	double rest = 1.0, rest_scalar = 1.0; /* without Beckmann's */
	int n = 0, rests = 0;
	const char *worst_case = "", *worst_what = "";
	report_text(
		page,
		"### Single against double precision\n\nRelative errors of the same source in floats, against doubles "
		"with "
		"libm, for the same float directions: view cosines .05 to 1, light from where samples go, roughness of "
		".05 and more (what is beyond is for the section on stability).\n\n| case | | median | RMS | 99.9 %% | "
		"max | albedo |\n|---|---|---|---|---|---|---|\n");
	for (size_t i = 0; i < report_table_rows(rows); i++) {
		const double p999 = report_number(rows, i, "p999");
		report_text(page, "| %s | %s | %.1e | %.1e | %.1e | %.1e | %.1e |\n", report_cell(rows, i, "case"),
			    report_cell(rows, i, "what"), report_number(rows, i, "median"),
			    report_number(rows, i, "rms"), p999, report_number(rows, i, "max"),
			    report_number(rows, i, "albedo"));
		albedo = fmax(albedo, report_number(rows, i, "albedo"));
		if (p999 > worst) {
			worst = p999;
			worst_case = report_cell(rows, i, "case");
			worst_what = report_cell(rows, i, "what");
		}
	}
	report_text(
		page,
		"\n| ns a call | vectorised, single | double | one by one, single | double |\n|---|---|---|---|---|\n");
	for (size_t l = 0; l < approximations_lobe_count; l++)
		for (int v = 0; v < 3; v++) {
			double ns[2][2];
			report_text(page, "| %s %s |", approximations_lobe_names[l], approximations_verbs[v]);
			for (int loop = 0; loop < 2; loop++)
				for (int d = 0; d < 2; d++) {
					char name[96];
					snprintf(name, sizeof name, "%s/%s/%s", approximations_lobe_names[l],
						 approximations_verbs[v], d ? "double" : "single");
					ns[loop][d] = approximations_time_of(times, "precision", name,
									     approximations_loops_measured[loop]);
					report_text(page, " %.1f |", ns[loop][d]);
				}
			product *= ns[0][1] / ns[0][0];
			product_scalar *= ns[1][1] / ns[1][0];
			n++;
			if (!strstr(approximations_lobe_names[l], "beckmann")) {
				rest *= ns[0][1] / ns[0][0];
				rest_scalar *= ns[1][1] / ns[1][0];
				rests++;
			}
			report_text(page, "\n");
		}
	report_text(page, "\n");
	report_finding(page,
		       "Single precision is within %.1e of double in 99.9 %% of ordinary calls of every lobe (worst: "
		       "%s, %s), the "
		       "albedo within %.1e; double takes %.1f times as long vectorised and %.1f times one by one "
		       "(geometric means; without Beckmann's lobes, whose erf and its inverse double leaves to libm, %.1f and "
		       "%.1f)",
		       worst, worst_case, worst_what, albedo, pow(product, 1.0 / n), pow(product_scalar, 1.0 / n),
		       pow(rest, 1.0 / fmax(rests, 1)), pow(rest_scalar, 1.0 / fmax(rests, 1)));
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	static const struct {
		const char *group, *title, *text, *unit;
		void (*then)(report_page *, const approximations_summary *, int);
	} kinds[] = {
		{"dielectric", "Fresnel, dielectric", "Over equal steps of the cosine from 0 to 1; index 1.1 to 4.",
		 " (reflectance)", NULL},
		{"conductor", "Fresnel, conductor",
		 "A channel of the ten metals of core/optics.h. F82-tint takes the exact value at 81.8 degrees, the "
		 "generalised "
		 "curves what fits the whole curve best; Gulbrandsen's mapping is a change of parameters and exact.",
		 " (reflectance)", conductors},
		{"film", "Thin films",
		 "On metals, against the integral of Airy's reflectance over the same sensitivities, by as many wave "
		 "numbers "
		 "as it takes.",
		 " (a channel)", NULL},
		{"lambda", "Lambda of Beckmann", "Against the textbook's form in double.", " (G1)", lambdas},
		{"masking", "Masking, one side",
		 "G2 on a GGX surface of width .1 to 1, against Smith's height-correlated masking in double (of the "
		 "others none "
		 "belongs to it; how near to surfaces they all are is below).",
		 " (G2)", maskings},
		{"across", "Masking, across the surface", "Against the beta function.", " (G2)", NULL},
		{"density", "D from a table", "Relative, against the analytic distribution.", " (relative)", NULL},
		{"hidden", "Lambda from a table", "Relative, against the analytic distribution.", " (relative)", NULL},
		{"visible", "Visible normals from a table",
		 "Mean cosine between the view and the visible normals, against the analytic distribution's.",
		 " (mean o.m)", NULL},
		{"real", "Elementary functions", "In ulp, by random arguments.", " [ulp]", reals},
	};
	const report_table *errors = tables[0], *times = tables[1];
	(void)quick;
	report_text(
		page,
		"Each way to compute a thing: its largest and RMS error over the domain named, the largest error of "
		"the "
		"albedo that follows (a GGX mirror, or Beckmann for its Lambda; four widths .1 to 1, six view cosines "
		".05 to "
		"1), and the time of a call, as the median over repeats of loops over %d elements: in a loop that the "
		"compiler may vectorise, one by one, and as an OpenCL kernel on all its cores. *Reference good to*: "
		"measured "
		"against long double (elementary functions: MPFR), albedos and spectra by halving steps. An error that "
		"is "
		"not ten times that is given as what it is below.\n\n",
		2048);
	for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
		approximations_summary all[APPROXIMATIONS_WAYS_MAX];
		int n = approximations_gather(errors, times, kinds[k].group, NULL, all);
		report_text(page, "### %s\n\n%s\n\n", kinds[k].title, kinds[k].text);
		/* Beside a table stands what it was made from, which has no error of its own. */
		if (strcmp(kinds[k].group, "density") == 0 || strcmp(kinds[k].group, "hidden") == 0 ||
		    strcmp(kinds[k].group, "visible") == 0)
			for (int i = 0; i < 2; i++) {
				const char *name = i ? "Beckmann" : "GGX";
				report_text(page, "%s itself: %.2f ns vectorised, %.2f one by one.\n\n", name,
					    approximations_time_of(times, kinds[k].group, name, "vector"),
					    approximations_time_of(times, kinds[k].group, name, "scalar"));
			}
		else if (strcmp(kinds[k].group, "real") != 0)
			approximations_mark_front(all, n);
		approximations_table(page, all, n, kinds[k].unit);
		approximations_write_points(kinds[k].group, all, n);
		if (strcmp(kinds[k].group, "dielectric") == 0)
			dielectrics(page, errors, times);
		if (kinds[k].then)
			kinds[k].then(page, all, n);
	}
	report_gnuplot(page, "approximations.gp", NULL);
	report_figure(page, "approximations_pareto.png",
		      "RMS error against time of a call, in a loop that the compiler may vectorise or one by one, "
		      "whichever is "
		      "faster. The line is the front: nothing below and to the left of it.");
	report_figure(page, "approximations_real.png",
		      "Elementary functions: RMS error in ulp against time of a call; round: the library's, square: "
		      "libm's, by "
		      "the same numbers.");
	fields(page, tables[2]);
	report_figure(page, "approximations_field.png",
		      "Masking functions against the simulated share of facets that both directions see; bars are two "
		      "standard "
		      "errors of the simulation.");
	precision(page, tables[3], times);
}

const report_section report_approximations = {
	.name = "approximations",
	.title = "Approximations: error against time",
	.question = "Which approximation is worth it?",
	.studies = {&error_study, &approximations_time_study, &approximations_field_study,
		    &approximations_precision_study, NULL},
	.write = write,
};
