/* distributions.c - the distributions of microfacet normals that are made on the host: parameters checked, constants
 * and tables prepared in double precision. */
#include <math.h>
#include <stdint.h>

#include "slope_measure.h"

static lobe_status check(const char *call, const lobe_distribution *out, const float *table, size_t words)
{
	if (!out || !table)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: %s is NULL", call, out ? "table" : "out");
	if ((uintptr_t)table % sizeof *table != 0)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: table is misaligned", call);
	if (words < LOBE_PROFILE_WORDS)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: words is %zu, and a table needs %d", call, words,
				 LOBE_PROFILE_WORDS);
	return LOBE_OK;
}

/* A NaN is outside. */
static lobe_status check_range(const char *call, const char *name, float value, float lo, float hi)
{
	if (value >= lo && value <= hi)
		return LOBE_OK;
	return lobe_fail(LOBE_ERROR_PARAMETER, "%s: %s is %g, outside [%g, %g]", call, name, (double)value, (double)lo,
			 (double)hi);
}

static lobe_status finish(lobe_distribution *out, float *table, lobe_distribution d, lobe_profile_function f,
			  void *context)
{
	const lobe_status status = lobe_profile_make(table, f, context);
	if (status != LOBE_OK)
		return status;
	d.table = lobe_table_at((lobe_uint64)(uintptr_t)table);
	*out = d;
	return LOBE_OK;
}

/* Densities of slopes up to a factor. */
typedef struct {
	double exponent, scale;
} power;

/* (1 + scale r^2)^-exponent */
static double power_density(void *context, double r)
{
	const power *p = context;
	return exp(-p->exponent * log1p(p->scale * r * r));
}

lobe_status lobe_distribution_phong(lobe_distribution *out, float *table, size_t words, float n)
{
	lobe_status status = check("lobe_distribution_phong", out, table, words);
	if (status == LOBE_OK)
		status = check_range("lobe_distribution_phong", "n", n, 0.0f, LOBE_PHONG_N_MAX);
	if (status != LOBE_OK)
		return status;
	power p = {0.5 * (double)n + 2.0, 1.0};
	lobe_distribution d = lobe_distribution_make(LOBE_NDF_PHONG);
	d.exponent = n;
	d.norm = (float)(1.0 + 0.5 * (double)n);
	return finish(out, table, d, power_density, &p);
}

lobe_status lobe_distribution_student_t(lobe_distribution *out, float *table, size_t words, float gamma)
{
	lobe_status status = check("lobe_distribution_student_t", out, table, words);
	if (status == LOBE_OK)
		status = check_range("lobe_distribution_student_t", "gamma", gamma, LOBE_STUDENT_T_GAMMA_MIN,
				     LOBE_STUDENT_T_GAMMA_MAX);
	if (status != LOBE_OK)
		return status;
	power p = {(double)gamma, 1.0 / ((double)gamma - 1.0)};
	lobe_distribution d = lobe_distribution_make(LOBE_NDF_STUDENT_T);
	d.exponent = gamma;
	d.norm = (float)p.scale;
	return finish(out, table, d, power_density, &p);
}

/* ((A + t)/(A (1 + t)))^-gamma/(1 + t)^2, t = r^2: D/D(0) cos^4. */
static double gtr_density(void *context, double r)
{
	const power *p = context;
	const double t = r * r, a = p->scale;
	return exp(-p->exponent * log1p(t / (1.0 + t) * (1.0 - a) / a) - 2.0 * log1p(t));
}

/* x/(1 - exp(-x)), 1 at 0. */
static double bernoulli(double x) { return x == 0.0 ? 1.0 : -x / expm1(-x); }

lobe_status lobe_distribution_gtr(lobe_distribution *out, float *table, size_t words, float gamma, float alpha)
{
	lobe_status status = check("lobe_distribution_gtr", out, table, words);
	if (status == LOBE_OK)
		status = check_range("lobe_distribution_gtr", "gamma", gamma, LOBE_GTR_GAMMA_MIN, LOBE_GTR_GAMMA_MAX);
	if (status == LOBE_OK)
		status = check_range("lobe_distribution_gtr", "alpha", alpha, LOBE_ALPHA_MIN, 1.0f);
	if (status != LOBE_OK)
		return status;
	const double a = (double)alpha * (double)alpha, b = (double)gamma - 1.0, log_a = -2.0 * log((double)alpha);
	power p = {(double)gamma, a};
	lobe_distribution d = lobe_distribution_make(LOBE_NDF_GTR);
	d.exponent = gamma;
	d.width = alpha;
	/* pi D(0) = (1 - A)/(A a) times b a/(1 - exp(-b a)) (gtr.h). */
	const double spread = log_a > 0.0 ? -expm1(-log_a) / log_a : 1.0;
	d.norm = (float)(spread / a * bernoulli(b * log_a));
	return finish(out, table, d, gtr_density, &p);
}

lobe_status lobe_distribution_tabulated(lobe_distribution *out, float *table, size_t words, lobe_profile_function f,
					void *context)
{
	lobe_status status = check("lobe_distribution_tabulated", out, table, words);
	if (status == LOBE_OK && !f)
		status = lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_distribution_tabulated: f is NULL");
	if (status != LOBE_OK)
		return status;
	return finish(out, table, lobe_distribution_make(LOBE_NDF_TABULATED), f, context);
}
