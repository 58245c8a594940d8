/* approximations_precision.c - lobes in single precision against themselves in double: what one pays for half the
 * bytes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "approximations.h"
#include "cases.h"
#include "csv.h"
#include "double.h"
#include "support.h"

/* Cases that a picture is made of: the stability section has the others. */
static int is_ordinary(const test_case *c)
{
	const int facets = c->alpha_x > 0.0;
	return !(c->flags & (CASE_DELTA_ONLY | CASE_HEAVY)) && (!facets || fmin(c->alpha_x, c->alpha_y) >= 0.05) &&
	       (c->eta == 0.0 || (c->eta > 0.3 && c->eta < 3.0 && fabs(c->eta - 1.0) > 0.05));
}

static int by_size(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static void row(report_rows *rows, const test_case *c, const char *verb, double *off, size_t n, double albedo)
{
	double sum2 = 0.0;
	if (n == 0)
		return;
	qsort(off, n, sizeof *off, by_size);
	for (size_t i = 0; i < n; i++)
		sum2 += off[i] * off[i];
	report_row(rows, "%s,%s,%zu,%.4g,%.4g,%.4g,%.4g,%.4g", c->name, verb, n, off[n / 2], sqrt(sum2 / (double)n),
		   off[(n - 1) * 999 / 1000], off[n - 1], albedo);
}

/* View cosines .05 to 1; light from where samples go. The albedo is the mean weight of the same samples. A sample that
 * goes another way in double, as it chose the other side of the surface, is not compared but for the albedo. */
static int run(int quick, size_t unit, report_rows *rows)
{
	const test_case *c = case_at(unit);
	const size_t n = quick ? 4000u : 100000u;
	size_t compared = 0, found = 0;
	double albedo[2] = {0.0, 0.0};
	if (!is_ordinary(c))
		return 0;
	double *off = report_alloc(NULL, 3 * n * sizeof *off), *off_pdf = off + n, *off_weight = off_pdf + n;
	for (size_t i = 0; i < n; i++) {
		float u[3], v[3];
		test_u3(61, i, u);
		test_u3(62, i, v);
		const double z = 0.05 + 0.95 * (double)v[0], s = sqrt(1.0 - z * z), phi = 6.283185307 * (double)v[1];
		const lobe_vec3 wo = lobe_vec3_make((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
		const double o[3] = {(double)wo.x, (double)wo.y, (double)wo.z};
		const double random[3] = {(double)u[0], (double)u[1], (double)u[2]};
		const lobe_sample got = lobe_bsdf_sample(c->bsdf, wo, lobe_vec3_make(u[0], u[1], u[2]));
		const double_sample exact = double_sample_at(c->kind, c->parameter, o, random);
		albedo[0] += ((double)got.weight.r + (double)got.weight.g + (double)got.weight.b) / (3.0 * (double)n);
		albedo[1] += (exact.weight[0] + exact.weight[1] + exact.weight[2]) / (3.0 * (double)n);
		if (!got.event || (got.event & LOBE_EVENT_DELTA) || got.event != exact.event)
			continue;
		const double w[3] = {(double)got.wi.x, (double)got.wi.y, (double)got.wi.z};
		double f[3];
		double_eval(c->kind, c->parameter, o, w, f);
		const double pdf = double_pdf(c->kind, c->parameter, o, w);
		const lobe_rgb single = lobe_bsdf_eval(c->bsdf, wo, got.wi);
		if (f[1] > 1e-6 && pdf > 1e-6) {
			off[compared] = fabs((double)single.g - f[1]) / f[1];
			off_pdf[compared++] = fabs((double)got.pdf - pdf) / pdf;
		}
		if (exact.weight[1] > 1e-6)
			off_weight[found++] = fabs((double)got.weight.g - exact.weight[1]) / exact.weight[1];
	}
	const double lost = fabs(albedo[0] - albedo[1]);
	row(rows, c, "eval", off, compared, lost);
	row(rows, c, "pdf", off_pdf, compared, lost);
	row(rows, c, "weight", off_weight, found, lost);
	free(off);
	return 0;
}

static size_t units(int quick)
{
	(void)quick;
	return case_count();
}

const report_study approximations_precision_study = {
	.name = "approximations_precision",
	.columns = "case,what,samples,median,rms,p999,max,albedo",
	.units = units,
	.run = run,
};
