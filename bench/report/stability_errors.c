/* stability_errors.c - errors over the floor: their rows added up, and why the largest are what they are. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "stability_studies.h"

double stability_percentile(const unsigned long *bins, double at)
{
	unsigned long all = 0, below = 0;
	for (int i = 0; i < STABILITY_BINS; i++)
		all += bins[i];
	for (int i = STABILITY_BINS - 1; i > 0; i--) {
		below += bins[i];
		if ((double)below > (1.0 - at) * (double)all)
			return exp2((i + 1 - 64) / 8.0);
	}
	return 0.0;
}

/* --- rows added up ------------------------------------------------------------------------------------------------------ */

static void add_bins(unsigned long *bins, const char *text)
{
	int i, used;
	unsigned long n;
	for (; sscanf(text, "%d:%lu%n", &i, &n, &used) == 2; text += used)
		if (i >= 0 && i < STABILITY_BINS)
			bins[i] += n;
}

static unsigned long count(const report_table *t, size_t row, const char *column)
{
	return (unsigned long)report_number(t, row, column);
}

int stability_is(const report_table *t, size_t row, const char *column, const char *value)
{
	return strcmp(report_cell(t, row, column), value) == 0;
}

/* The rows of a lobe, verb and reference; NULL: any. */
static stability_tally sum(const report_table *t, const char *lobe, const char *verb, const char *reference)
{
	stability_tally s;
	memset(&s, 0, sizeof s);
	for (size_t row = 0; row < report_table_rows(t); row++) {
		if ((lobe && !stability_is(t, row, "lobe", lobe)) || (verb && !stability_is(t, row, "verb", verb)) ||
		    (reference && !stability_is(t, row, "reference", reference)))
			continue;
		s.cases += count(t, row, "cases");
		s.compared += count(t, row, "compared");
		s.non_finite += count(t, row, "non_finite");
		s.negative += count(t, row, "negative");
		s.above += count(t, row, "above");
		for (int k = 0; k < STABILITY_CLASSES; k++)
			s.classes[k] += count(t, row, stability_class_names[k]);
		s.worst_ulp = fmax(s.worst_ulp, report_number(t, row, "worst_ulp"));
		s.worst = fmax(s.worst, report_number(t, row, "worst"));
		s.worst_of_one = fmax(s.worst_of_one, report_number(t, row, "worst_of_one"));
		s.own_error = fmax(s.own_error, report_number(t, row, "own_error"));
		add_bins(s.bins, report_cell(t, row, "bins"));
		add_bins(s.bins_of_one, report_cell(t, row, "bins_of_one"));
	}
	return s;
}

/* --- parts of the section ------------------------------------------------------------------------------------------------- */

static void write_row(report_page *page, const char *name, const char *verb, const char *reference,
		      const stability_tally *s)
{
	const double n = s->compared ? (double)s->compared : 1.0;
	const unsigned long other = s->classes[STABILITY_UNDETERMINED] + s->classes[STABILITY_TINY] +
				    s->classes[STABILITY_BENT] + s->classes[STABILITY_LENGTH];
	report_text(page, "| %s | %s | %s | %lu | %.2g | %.3g | %.3g %% | %lu | %lu | %lu | %.3g | %.3g | %.1e |\n",
		    name, verb, reference, s->compared, stability_percentile(s->bins, 0.5),
		    stability_percentile(s->bins, 0.9999), 100.0 * (double)s->above / n, other,
		    stability_of_one_count(s), s->classes[STABILITY_PLAIN],
		    stability_percentile(s->bins_of_one, 0.9999), s->worst_of_one, s->own_error);
}

/* What a class means, where "of one" is said of the kind of rounding. */
static const char *const meanings[STABILITY_CLASSES] = {
	"nothing explains it",
	"the floor is above a tenth of the answer (of a weight: of the density in its direction), which is therefore "
	"anyone's",
	"below 1e-30 of the density's peak, where factors underflow; the error is as small",
	"the value is the exact answer to inputs off by at most 2 ulp each; it bends too much over a rounding for the "
	"floor",
	"directions are up to 4 ulp off unit: the value is between the exact answers to them as they are and to unit ones",
	"a metal's reflectance, of one (`core/fresnel.h`)",
	"Schlick's curve where it falls to f90 < f0, of one (`core/fresnel_schlick.h`)",
	"waves in a film that cancel, of one in units of 2^-22 for each time that they go to and fro (`core/airy.h`)",
	"reflectance or transmittance of glass, of one (`core/fresnel.h`)",
	"the cosine to the facet, of one: near total reflection, and where light leaves eta = 1000 by a cone of 1 - "
	"cos = 5e-7",
	"two points of the unit sphere, opposite near its rim, that add up to a visible normal",
	"cosines, or the smooth surface's value, in a sum over facets (`lobes/microfacet_diffuse.h`)",
	"a beta function by its logarithm (`core/beta.h`)",
	"density and hidden area of a distribution: what headers state of tabulated ones, 5e-6 together, and the "
	"exponents of Beckmann's tails"};

/* The lobes that have a class, most cases first, as far as text is long. */
static void name_lobes(const report_table *t, int class, char *text, size_t size)
{
	unsigned long n[STABILITY_LOBES];
	size_t used = 0;
	text[0] = '\0';
	for (size_t l = 0; l < STABILITY_LOBES; l++)
		n[l] = sum(t, stability_lobe_names[l], NULL, NULL).classes[class];
	for (;;) {
		size_t most = 0;
		for (size_t l = 1; l < STABILITY_LOBES; l++)
			most = n[l] > n[most] ? l : most;
		if (!n[most] || used >= size)
			return;
		used += (size_t)snprintf(text + used, size - used, "%s%s %lu", used ? ", " : "",
					 stability_lobe_names[most], n[most]);
		n[most] = 0;
	}
}

static void write_causes(report_page *page, const report_table *t, const stability_tally *textbook,
			 const stability_tally *other)
{
	char lobes[512], causes[1024];
	size_t used = 0;
	causes[0] = '\0';
	report_text(page,
		    "Every case above %d floors, by its reason. *Of one*: where the answer has a factor that headers "
		    "promise to "
		    "some roundings of 1, not of itself, the reference is asked again with that factor off by one "
		    "rounding of 1, "
		    "and the error is within %d times what that does. \n\n"
		    "| reason | what | textbook | double build | lobes |\n|---|---|--:|--:|---|\n",
		    STABILITY_LIMIT, STABILITY_LIMIT);
	for (int k = 1; k <= STABILITY_CLASSES; k++) {
		const int class = k % STABILITY_CLASSES; /* the unexplained last */
		const unsigned long n = textbook->classes[class] + other->classes[class];
		name_lobes(t, class, lobes, sizeof lobes);
		report_text(page, "| %s | %s | %lu | %lu | %s |\n", class ? stability_class_names[class] : "**none**",
			    meanings[class], textbook->classes[class], other->classes[class], lobes);
		if (n && used < sizeof causes)
			used += (size_t)snprintf(causes + used, sizeof causes - used, "%s%s %lu", used ? ", " : "",
						 class ? stability_class_names[class] : "unexplained", n);
	}
	report_text(page, "\n");
	report_finding(
		page,
		"%.2g %% of these results are above %d floors, by the reason that the sweep computes for each: %s.",
		100.0 * (double)(textbook->above + other->above) / (double)(textbook->compared + other->compared),
		STABILITY_LIMIT, causes);
}

void stability_write_errors(report_page *page, const report_table *t)
{
	static const char *const references[2] = {"textbook", "double build"};
	report_text(
		page,
		"### Errors over the floor\n\n"
		"The **floor** of a case is what half a unit in the last place of each input (components of wo and wi, "
		"widths, indices) does to the exact answer, root of the sum of squares, and at least half an ulp of "
		"the "
		"answer. **Error/floor** is therefore what the library's arithmetic adds to what the question leaves "
		"open: a "
		"correctly rounded result is at most 1.\n\n"
		"*textbook*: the exact answer is the papers' formulas (slopes, tangents, normalised half vectors, "
		"complex "
		"roots), written anew in long double; its own error, measured against 113 bits on one case of 64 and "
		"on "
		"every one above 8 floors, is the last column, in floors. *double build*: the library compiled in "
		"double, "
		"where there is no textbook (films in RGB, sums over facets, tables, maskings other than Smith's). "
		"*direction*: a component of what a sample returns, against the sampler's map of u; a u counts as the "
		"cell of "
		"2^-24 that it is.\n\n"
		"Cases above %d floors are counted as undetermined, tiny, bent or of length (*other*), as *of one*, or as *none* "
		"of these; the table below this one says which. Undetermined and tiny cases count as 0 in the "
		"percentiles, cases of length in *worst of one*.\n\n"
		"| lobe | result | reference | compared | median | 99.99 %% | above %d | other | of one | none | 99.99 "
		"%% of one "
		"| worst of one | own error |\n|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
		STABILITY_LIMIT, STABILITY_LIMIT);
	for (size_t l = 0; l < STABILITY_LOBES; l++)
		for (int v = 0; v < STABILITY_VERBS; v++)
			for (int k = 0; k < 2; k++) {
				const stability_tally s =
					sum(t, stability_lobe_names[l], stability_verb_names[v], references[k]);
				if (s.compared)
					write_row(page, stability_lobe_names[l], stability_verb_names[v], references[k],
						  &s);
			}
	const stability_tally all = sum(t, NULL, NULL, NULL), textbook = sum(t, NULL, NULL, "textbook"),
			      other = sum(t, NULL, NULL, "double build");
	write_row(page, "**all**", "", "textbook", &textbook);
	write_row(page, "**all**", "", "double build", &other);
	write_row(page, "**all**", "", "", &all);
	report_text(page, "\n");
	report_finding(
		page,
		"Error over the conditioning floor: median at most %.2g and %.3g at the 99.99th percentile of %.3g "
		"results against the textbook in long double, %.2g and %.3g of %.3g against the double build (films, "
		"comparison "
		"lobes), reflectances counted in roundings of 1 (in roundings of themselves %.3g and %.3g). Above %d "
		"floors "
		"and explained by nothing: %lu and %lu.",
		stability_percentile(textbook.bins, 0.5), stability_percentile(textbook.bins_of_one, 0.9999),
		(double)textbook.compared, stability_percentile(other.bins, 0.5),
		stability_percentile(other.bins_of_one, 0.9999), (double)other.compared,
		stability_percentile(textbook.bins, 0.9999), stability_percentile(other.bins, 0.9999), STABILITY_LIMIT,
		textbook.classes[STABILITY_PLAIN], other.classes[STABILITY_PLAIN]);
	write_causes(page, t, &textbook, &other);
}
