/* stability_sweep.c - the studies over random corners: errors, counts, and the ascents to worst cases. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stability_studies.h"

/* --- errors --------------------------------------------------------------------------------------------------------- */

static int bin_of(double ratio)
{
	if (!(ratio > 0.0))
		return 0;
	const double at = floor(8.0 * log2(ratio)) + 64.0;
	return at < 1.0 ? 1 : at > STABILITY_BINS - 1.0 ? STABILITY_BINS - 1 : (int)at;
}

void stability_tally_add(stability_tally *t, const stability_case *c, stability_verb verb, const stability_result *r,
			 uint64_t n)
{
	const double ratio = stability_ratio_determined(r), one = stability_ratio_of_one(r);
	stability_class class = STABILITY_PLAIN;
	t->cases++;
	t->non_finite += !(r->value - r->value == 0.0);
	t->negative += verb != STABILITY_DIRECTION && r->value < 0.0;
	if (r->exact == 0.0 && r->value == 0.0)
		return;
	t->compared++;
	if (!(r->error <= STABILITY_LIMIT * r->floor)) {
		t->above++;
		class = stability_explain(c, verb, r);
		t->classes[class]++;
	}
	t->bins[bin_of(ratio)]++;
	t->bins_of_one[bin_of(one)]++;
	if (ratio > 0.0)
		t->worst_ulp = fmax(t->worst_ulp, r->error / r->ulp);
	t->worst = fmax(t->worst, ratio);
	/* What is of the directions' length has a reason that is not counted in roundings. */
	if (class != STABILITY_LENGTH)
		t->worst_of_one = fmax(t->worst_of_one, one);
	/* How good the answer itself is: some cases, and all that would be blamed on the library. */
	if (n % 64 == 0 || ratio > 8.0)
		t->own_error = fmax(t->own_error, stability_own_error(c, verb, r));
}

unsigned long stability_of_one_count(const stability_tally *t)
{
	unsigned long n = 0;
	for (int k = STABILITY_METAL; k < STABILITY_CLASSES; k++)
		n += t->classes[k];
	return n;
}

static void print_bins(const unsigned long *bins, char *text, size_t size)
{
	size_t used = 0;
	text[0] = '\0';
	for (int i = 0; i < STABILITY_BINS && used < size; i++)
		if (bins[i])
			used += (size_t)snprintf(text + used, size - used, "%s%d:%lu", used ? " " : "", i, bins[i]);
}

enum { CHUNKS_QUICK = 4, CHUNKS = 40, CASES_QUICK = 10000, CASES = 30000 };

static size_t sweep_units(int quick) { return (size_t)STABILITY_LOBES * (quick ? CHUNKS_QUICK : CHUNKS); }

static int sweep_run(int quick, size_t unit, report_rows *rows)
{
	const size_t lobe = unit % STABILITY_LOBES, chunk = unit / STABILITY_LOBES;
	const lobe_uint kind = stability_kinds[lobe];
	const size_t slower = kind == LOBE_KIND_MICROFACET_DIFFUSE ? 40 : 1;
	const size_t cases = (size_t)(quick ? CASES_QUICK : CASES) / slower;
	static const char *const references[2] = {"double build", "textbook"};
	char bins[4096], bins_of_one[4096], classes[256];
	stability_tally *tally = calloc(2 * STABILITY_VERBS, sizeof *tally);
	if (!tally)
		return -1;
	for (size_t i = 0; i < cases; i++) {
		const uint64_t n = chunk * cases + i;
		const stability_case c = stability_draw(kind, n);
		for (stability_verb v = STABILITY_EVAL; v < STABILITY_VERBS; v++) {
			const stability_result r = stability_measure(&c, v);
			if (r.defined)
				stability_tally_add(&tally[2 * v + (stability_verb)stability_is_textbook(&c)], &c, v,
						    &r, n);
		}
	}
	for (int v = 0; v < STABILITY_VERBS; v++)
		for (int k = 0; k < 2; k++) {
			const stability_tally *t = &tally[2 * v + k];
			if (!t->cases)
				continue;
			print_bins(t->bins, bins, sizeof bins);
			print_bins(t->bins_of_one, bins_of_one, sizeof bins_of_one);
			size_t used = 0;
			for (int i = 0; i < STABILITY_CLASSES; i++)
				used += (size_t)snprintf(classes + used, sizeof classes - used, "%s%lu", i ? "," : "",
							 t->classes[i]);
			report_row(rows, "%s,%s,%s,%lu,%lu,%lu,%lu,%lu,%s,%.6g,%.6g,%.6g,%.3g,%s,%s",
				   stability_lobe_names[lobe], stability_verb_names[v], references[k], t->cases,
				   t->compared, t->non_finite, t->negative, t->above, classes, t->worst_ulp, t->worst,
				   t->worst_of_one, t->own_error, bins, bins_of_one);
		}
	free(tally);
	return 0;
}

#define COLUMN(name) name ","
const report_study stability_sweep = {
	"stability_sweep",
	"lobe,verb,reference,cases,compared,non_finite,negative,above," STABILITY_CLASS_LIST(
		COLUMN) "worst_ulp,worst,worst_of_one,own_error,bins,bins_of_one",
	0,
	sweep_units,
	sweep_run,
	NULL};

/* --- counts --------------------------------------------------------------------------------------------------------- */

enum { BATCHES = 4 };

static size_t count_units(int quick) { return (size_t)STABILITY_LOBES * (quick ? 1 : 24); }

static int count_run(int quick, size_t unit, report_rows *rows)
{
	const size_t lobe = unit % STABILITY_LOBES, chunk = unit / STABILITY_LOBES;
	stability_counts c = {0, 0, 0, 0, 0};
	(void)quick;
	for (size_t i = 0; i < BATCHES; i++)
		if (stability_count(stability_kinds[lobe], chunk * BATCHES + i, &c))
			return -1;
	report_row(rows, "%s,%llu,%llu,%llu,%llu,%llu", stability_lobe_names[lobe], (unsigned long long)c.elements,
		   (unsigned long long)c.kept, (unsigned long long)c.non_finite, (unsigned long long)c.negative,
		   (unsigned long long)c.pdf_differs);
	return 0;
}

const report_study stability_counting = {
	"stability_counts", "lobe,elements,samples,non_finite,negative,pdf_differs", 0, count_units, count_run, NULL};

/* --- worst cases ------------------------------------------------------------------------------------------------------ */

enum { STARTS = 48, STARTS_QUICK = 4, STEPS = 1600, STEPS_QUICK = 500, DRAWS_EACH = 300 };

static size_t worst_units(int quick)
{
	(void)quick;
	return (size_t)STABILITY_LOBES * STABILITY_VERBS * 2;
}

/* Of the best of DRAWS_EACH cases, for each start, an ascent. */
static int worst_run(int quick, size_t unit, report_rows *rows)
{
	static const stability_measure_ratio ratios[2] = {stability_ratio_determined, stability_ratio_of_one};
	static const char *const names[2] = {"floor", "floor of one"};
	const size_t lobe = unit % STABILITY_LOBES;
	const stability_verb verb = (stability_verb)(unit / STABILITY_LOBES % STABILITY_VERBS);
	const size_t which = unit / STABILITY_LOBES / STABILITY_VERBS;
	const lobe_uint kind = stability_kinds[lobe];
	const int slow = kind == LOBE_KIND_MICROFACET_DIFFUSE;
	const size_t starts = slow ? 2 : quick ? STARTS_QUICK : STARTS, draws = slow ? 50 : DRAWS_EACH;
	const unsigned steps = slow ? (quick ? 100 : 800) : quick ? STEPS_QUICK : STEPS;
	stability_case worst;
	double drawn = -1.0, found = -1.0;
	memset(&worst, 0, sizeof worst);
	for (size_t s = 0; s < starts; s++) {
		stability_case best;
		double of_best = -1.0;
		memset(&best, 0, sizeof best);
		for (size_t i = 0; i < draws; i++) {
			const stability_case c = stability_draw(kind, (1u << 30) + s * draws + i);
			const stability_result r = stability_measure(&c, verb);
			if (r.defined && ratios[which](&r) > of_best) {
				of_best = ratios[which](&r);
				best = c;
			}
		}
		if (of_best < 0.0)
			continue;
		drawn = fmax(drawn, of_best);
		const stability_case up = stability_ascend(ratios[which], best, verb, steps, unit * 1000 + s);
		const stability_result r = stability_measure(&up, verb);
		if (ratios[which](&r) > found) {
			found = ratios[which](&r);
			worst = up;
		}
	}
	if (found < 0.0)
		return 0; /* nothing is asked of it */
	char text[1024];
	const stability_result r = stability_measure(&worst, verb);
	stability_print(&worst, verb, text, sizeof text);
	report_row(rows, "%s,%s,%s,%s,%.6g,%.6g,%.9g,%.12g,%.4g,%.4g,%.4g,%s,%s", stability_lobe_names[lobe],
		   stability_verb_names[verb], names[which],
		   stability_is_textbook(&worst) ? "textbook" : "double build", drawn, found, r.value, r.exact,
		   r.error / r.ulp, r.floor / r.size, r.floor_directions / r.size,
		   stability_class_names[stability_explain(&worst, verb, &r)], text);
	return 0;
}

const report_study stability_worst = {
	"stability_worst",
	"lobe,verb,yardstick,reference,drawn,found,value,exact,ulp,floor,floor_directions,class,inputs",
	0,
	worst_units,
	worst_run,
	NULL};
