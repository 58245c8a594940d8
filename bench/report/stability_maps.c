/* stability_maps.c - the studies behind the plots: errors and floors over width and angle, and the library's formulas
 * beside those of the textbooks over what makes these fail. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "stability_dice.h"
#include "stability_studies.h"

/* --- over (alpha, angle) ---------------------------------------------------------------------------------------------- */

/* Gold and glass: the parameters after the widths. below: seen from inside. */
typedef struct {
	const char *name;
	lobe_uint kind;
	double rest[6];
	int below;
} map;

static const map maps[] = {
	{"ggx_conductor", LOBE_KIND_GGX_CONDUCTOR, {0.143, 0.375, 1.442, 3.983, 2.386, 1.603}, 0},
	{"beckmann_conductor", LOBE_KIND_BECKMANN_CONDUCTOR, {0.143, 0.375, 1.442, 3.983, 2.386, 1.603}, 0},
	{"ggx_dielectric", LOBE_KIND_GGX_DIELECTRIC, {1.5}, 0},
	{"ggx_dielectric_inside", LOBE_KIND_GGX_DIELECTRIC, {1.5}, 1},
};

enum { MAPS = sizeof maps / sizeof *maps, COLUMNS = 33, ROWS = 29, PER_DECADE = 8, STREAM = 7600 };

static size_t map_units(int quick)
{
	(void)quick;
	return (size_t)MAPS * COLUMNS;
}

static int by_size(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return x < y ? -1 : x > y;
}

/* One cell: the worst and the middle of cases whose wi the lobe was sampled for. */
static void run_cell(const map *m, size_t column, size_t row, size_t cases, report_rows *rows)
{
	const double alpha = pow(10.0, -4.0 + (double)column / PER_DECADE), z = pow(10.0, -0.25 * (double)row);
	dice d = {STREAM, ((uint64_t)(size_t)(m - maps) << 48) + ((uint64_t)column << 40) + ((uint64_t)row << 32)};
	double *ulp = malloc(3 * cases * sizeof *ulp), *ratio = ulp + cases, *floor = ratio + cases;
	for (stability_verb v = STABILITY_EVAL; ulp && v <= STABILITY_PDF; v++) {
		size_t n = 0;
		for (size_t i = 0; i < cases; i++) {
			stability_case c;
			memset(&c, 0, sizeof c);
			c.kind = m->kind;
			c.channel = (int)(i % 3);
			c.parameter[0] = c.parameter[1] = (double)(float)alpha;
			for (int k = 0; k < 6; k++)
				c.parameter[2 + k] = (double)(float)m->rest[k];
			/* Over the cell's extent, not its middle alone. */
			const double cosine = fmin(1.0, z * pow(10.0, 0.25 * (dice_uniform(&d) - 0.5)));
			const double r = sqrt((1.0 - cosine) * (1.0 + cosine)), phi = dice_angle(&d);
			c.wo[0] = (float)(r * cos(phi));
			c.wo[1] = (float)(r * sin(phi));
			c.wo[2] = (float)(m->below ? -cosine : cosine);
			for (int k = 0; k < 3; k++)
				c.u[k] = (float)(dice_bits(&d) >> 8) * 0x1p-24f;
			const lobe_sample s =
				lobe_bsdf_sample(stability_bsdf(&c), lobe_vec3_make(c.wo[0], c.wo[1], c.wo[2]),
						 lobe_vec3_make(c.u[0], c.u[1], c.u[2]));
			if (s.event == 0u)
				continue;
			c.wi[0] = s.wi.x;
			c.wi[1] = s.wi.y;
			c.wi[2] = s.wi.z;
			const stability_result result = stability_measure(&c, v);
			if (!(result.exact > 0.0))
				continue;
			ulp[n] = result.error / result.ulp;
			ratio[n] = stability_ratio(&result);
			floor[n++] = result.floor / result.exact;
		}
		if (!n)
			continue;
		qsort(ulp, n, sizeof *ulp, by_size);
		qsort(ratio, n, sizeof *ratio, by_size);
		qsort(floor, n, sizeof *floor, by_size);
		report_row(rows, "%s,%s,%.6g,%.6g,%zu,%.4g,%.4g,%.4g,%.4g,%.4g", m->name, stability_verb_names[v],
			   alpha, z, n, ulp[n - 1], ulp[n / 2], ratio[n - 1], floor[n / 2], floor[n - 1]);
	}
	free(ulp);
}

static int map_run(int quick, size_t unit, report_rows *rows)
{
	for (size_t row = 0; row < ROWS; row++)
		run_cell(&maps[unit / COLUMNS], unit % COLUMNS, row, quick ? 48 : 400, rows);
	return 0;
}

const report_study stability_maps = {"stability_maps",
				     "map,verb,alpha,cos,cases,ulp,ulp_median,over_floor,floor_median,floor_worst",
				     0,
				     map_units,
				     map_run,
				     NULL};

/* --- textbook forms --------------------------------------------------------------------------------------------------- */

/* Bins of what each is plotted over, four a decade from 10^-8 to 10^4. */
enum { BINS = 48, CASES_QUICK = 60000, CASES = 1000000 };

typedef struct {
	unsigned long cases, failed;
	double ours, textbook, ours_ratio, textbook_ratio, floor;
} form_bin;

static size_t form_units(int quick)
{
	(void)quick;
	return STABILITY_FORMS;
}

static int form_run(int quick, size_t unit, report_rows *rows)
{
	form_bin bins[BINS];
	memset(bins, 0, sizeof bins);
	const uint64_t cases = quick ? CASES_QUICK : CASES;
	for (uint64_t n = 0; n < cases; n++) {
		const stability_form_result r = stability_form_at((int)unit, n);
		if (!(r.exact > 1e-30) || !(r.floor < 0.1 * r.exact))
			continue;
		const double at = floor(4.0 * (log10(r.x) + 8.0));
		form_bin *b = &bins[at < 0.0 ? 0 : at >= BINS ? BINS - 1 : (int)at];
		b->cases++;
		b->floor += r.floor / r.exact;
		b->ours = fmax(b->ours, fabs(r.ours - r.exact) / r.exact);
		b->ours_ratio = fmax(b->ours_ratio, fabs(r.ours - r.exact) / r.floor);
		if (!(r.textbook - r.textbook == 0.0)) {
			b->failed++;
			continue;
		}
		b->textbook = fmax(b->textbook, fabs(r.textbook - r.exact) / r.exact);
		b->textbook_ratio = fmax(b->textbook_ratio, fabs(r.textbook - r.exact) / r.floor);
	}
	for (int i = 0; i < BINS; i++)
		if (bins[i].cases >= 30)
			report_row(rows, "%zu,%.6g,%lu,%.4g,%.4g,%.4g,%.4g,%.4g,%lu", unit,
				   pow(10.0, (i + 0.5) / 4.0 - 8.0), bins[i].cases,
				   bins[i].floor / (double)bins[i].cases, bins[i].ours, bins[i].textbook,
				   bins[i].ours_ratio, bins[i].textbook_ratio, bins[i].failed);
	return 0;
}

const report_study stability_forming = {
	"stability_forms",
	"form,x,cases,floor,ours,textbook,ours_over_floor,textbook_over_floor,textbook_failed",
	0,
	form_units,
	form_run,
	NULL};
