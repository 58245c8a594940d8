/* approximations_albedo.c - the integral of albedos, and what is kept of errors. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "approximations.h"
#include "csv.h"

const double albedo_alphas[ALBEDO_ALPHAS] = {0.1, 0.3, 0.6, 1.0};
const double albedo_cosines[ALBEDO_COSINES] = {1.0, 0.7, 0.4, 0.2, 0.1, 0.05};

/* Middles of the cells of a grid over u. The integrand falls to 0 at the horizon, with a kink: the error goes with the
 * square of the cells' size, and the caller compares two. */
albedo_nodes *albedo_nodes_make(unsigned ndf, const lobe_distribution *d, double alpha, double cosine, int side)
{
	albedo_nodes *a = report_alloc(NULL, sizeof *a);
	const size_t n = (size_t)side * (size_t)side;
	const float width = (float)alpha;
	const lobe_distribution own = lobe_distribution_make(ndf);
	const lobe_smith s = lobe_smith_make(d ? *d : own, lobe_linear_make(width, 0.0f, 0.0f, width, 0.0f, 0.0f));
	const lobe_smith exact = lobe_smith_make(own, s.map);
	float *all = report_alloc(NULL, 7 * n * sizeof *all);
	float **const to[7] = {&a->cosine, &a->iz, &a->ix, &a->iy, &a->hx, &a->hy, &a->hz};
	for (size_t k = 0; k < 7; k++)
		*to[k] = all + k * n;
	a->weight = report_alloc(NULL, 2 * n * sizeof *a->weight);
	a->smith = a->weight + n;
	a->oz = (float)cosine;
	a->ox = (float)sqrt((1.0 - (double)a->oz) * (1.0 + (double)a->oz));
	a->n = 0;
	const lobe_vec3 o = lobe_vec3_make(a->ox, 0.0f, a->oz);
	const double sigma = (double)lobe_smith_sigma(exact, o);
	for (size_t k = 0; k < n; k++) {
		const lobe_vec2 u = lobe_vec2_make(((float)(k % (size_t)side) + 0.5f) / (float)side,
						   ((float)(k / (size_t)side) + 0.5f) / (float)side);
		const lobe_vec3 m = lobe_smith_visible(s, o, u);
		const float c = lobe_dot(o, m);
		const lobe_vec3 i = lobe_reflect(o, m, c);
		if (!(i.z > 0.0f && c > 0.0f))
			continue;
		a->cosine[a->n] = fminf(c, 1.0f);
		a->iz[a->n] = i.z, a->ix[a->n] = i.x, a->iy[a->n] = i.y;
		a->hx[a->n] = m.x, a->hy[a->n] = m.y, a->hz[a->n] = m.z;
		a->weight[a->n] = sigma / (double)n;
		a->smith[a->n] = (double)lobe_smith_g2(exact, o, i) / (double)o.z;
		a->n++;
	}
	return a;
}

void albedo_nodes_free(albedo_nodes *nodes)
{
	free(nodes->cosine);
	free(nodes->weight);
	free(nodes);
}

void approximations_error_add(approximations_error *e, double got, double exact, const char *format, ...)
{
	const double off = fabs(got - exact);
	e->n += 1.0;
	e->sum2 += off * off;
	if (!(off <= e->max)) {
		va_list arguments;
		va_start(arguments, format);
		vsnprintf(e->at, sizeof e->at, format, arguments);
		va_end(arguments);
		e->max = off;
	}
}

static double root_mean_square(const approximations_error *e) { return e->n > 0.0 ? sqrt(e->sum2 / e->n) : 0.0; }

void approximations_error_albedo(approximations_error *e, double off, double reference, double alpha, double cosine)
{
	e->albedo_reference = fmax(e->albedo_reference, reference);
	if (fabs(off) <= e->albedo)
		return;
	e->albedo = fabs(off);
	e->albedo_at[0] = alpha;
	e->albedo_at[1] = cosine;
}

/* An albedo that was not asked for is left empty. */
void approximations_error_row(report_rows *rows, const char *group, const char *name, const char *of,
			      const char *quantity, const approximations_error *e)
{
	char albedo[96] = ",,,";
	if (e->albedo_at[1] > 0.0)
		snprintf(albedo, sizeof albedo, "%.4g,%g,%g,%.1e", e->albedo, e->albedo_at[0], e->albedo_at[1],
			 e->albedo_reference);
	report_row(rows, "%s,%s,%s,%s,%.0f,%.4g,%s,%.4g,%.1e,%s", group, name, of, quantity, e->n, e->max, e->at,
		   root_mean_square(e), e->reference, albedo);
}
