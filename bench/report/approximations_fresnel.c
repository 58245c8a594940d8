/* approximations_fresnel.c - errors of reflectances: dielectrics by index, the metals of optics.def, films on them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "approximations.h"
#include "lobe/optics_names.h"
#include "csv.h"
#include "textbook.h"

static const double etas[] = {1.1, 1.33, 1.5, 2.0, 2.42, 4.0};
enum { ETAS = sizeof etas / sizeof *etas, FILMS = 4 };

static double channel(lobe_rgb c, int k) { return (double)(k == 0 ? c.r : k == 1 ? c.g : c.b); }

/* --- parameters of the approximations ----------------------------------------------------------------------------- */

/* The exponent of Schlick's curve that is nearest to exact in the mean square over the cosine: golden section. */
static double power_error(double exponent, double f0, const double *exact, int n)
{
	double sum = 0.0;
	for (int i = 0; i < n; i++) {
		const double c = (i + 0.5) / n, off = f0 + (1.0 - f0) * pow(1.0 - c, exponent) - exact[i];
		sum += off * off;
	}
	return sum;
}

enum { FIT = 400 };

static double fitted_exponent(double f0, const double exact[FIT])
{
	double lo = 0.5, hi = 20.0;
	for (int i = 0; i < 60; i++) {
		const double a = hi - 0.61803398875 * (hi - lo), b = lo + 0.61803398875 * (hi - lo);
		if (power_error(a, f0, exact, FIT) < power_error(b, f0, exact, FIT))
			hi = b;
		else
			lo = a;
	}
	return 0.5 * (lo + hi);
}

/* The depth of the dip that leaves the least mean square to Schlick's curve: linear. */
static double fitted_depth(double f0, const double exact[FIT])
{
	double above = 0.0, norm = 0.0;
	for (int i = 0; i < FIT; i++) {
		const double c = (i + 0.5) / FIT, w = (double)lobe_fresnel_dip_weight((float)c);
		above += w * (f0 + (1.0 - f0) * pow(1.0 - c, 5.0) - exact[i]);
		norm += w * w;
	}
	return above / norm;
}

static double exact_of(double c, double n, double k)
{
	return k > 0.0 ? textbook_fresnel_conductor(c, n, k) : textbook_fresnel(c, n);
}

static approximations_set set_of(double n, double k)
{
	approximations_set p;
	double exact[FIT];
	memset(&p, 0, sizeof p);
	for (int i = 0; i < FIT; i++)
		exact[i] = exact_of((i + 0.5) / FIT, n, k);
	const double f0 = exact_of(1.0, n, k);
	p.n = lobe_rgb_make((float)n, (float)n, (float)n);
	p.k = lobe_rgb_make((float)k, (float)k, (float)k);
	p.f0 = (float)f0;
	p.depth = lobe_fresnel_f82_depth_from_value(p.f0, (float)exact_of(1.0 / 7.0, n, k));
	p.exponent = (float)fitted_exponent(f0, exact);
	p.general = (float)fitted_depth(f0, exact);
	/* n = M + (1 - g)(N - M), core/fresnel_artist.h */
	const double s = sqrt(f0), most = (1.0 + s) / (1.0 - s), least = (1.0 - f0) / (1.0 + f0);
	p.edge = (float)((most - n) / (most - least));
	return p;
}

/* --- dielectrics and metals --------------------------------------------------------------------------------------- */

static void run_loop(const approximations_way *way, const approximations_set *p, size_t n, const float *x, float *r0,
		     float *r1, float *r2)
{
	const float *const in[APPROXIMATIONS_IN] = {x, x, x, x, x};
	float *const out[APPROXIMATIONS_OUT] = {r0, r1, r2};
	way->scalar(p, n, in, out);
}

/* Of one alpha and angle: how far the albedo of each way is from that of the exact reflectance in double. */
static void add_albedos(const approximations_way *way, const approximations_set *p, double n, double k,
			approximations_error *e)
{
	enum { SIDE = 64 };
	static const int sides[2] = {SIDE / 2, SIDE};
	float *got = report_alloc(NULL, SIDE * SIDE * sizeof *got);
	for (int a = 0; a < ALBEDO_ALPHAS; a++)
		for (int m = 0; m < ALBEDO_COSINES; m++) {
			double off[2] = {0.0, 0.0};
			for (int level = 0; level < 2; level++) {
				albedo_nodes *nodes = albedo_nodes_make(LOBE_NDF_GGX, NULL, albedo_alphas[a],
									albedo_cosines[m], sides[level]);
				run_loop(way, p, nodes->n, nodes->cosine, got, got, got);
				for (size_t i = 0; i < nodes->n; i++)
					off[level] += nodes->weight[i] * nodes->smith[i] *
						      ((double)got[i] - exact_of((double)nodes->cosine[i], n, k));
				albedo_nodes_free(nodes);
			}
			approximations_error_albedo(e, off[1], fabs(off[1] - off[0]) / 3.0, albedo_alphas[a],
						    albedo_cosines[m]);
		}
	free(got);
}

/* By equal steps of the cosine, as of the angle of a diffuse light. */
static void reflectances(approximations_group group, const char *of, double n, double k, int quick, report_rows *rows)
{
	enum { SAMPLES = 4096 };
	float c[SAMPLES], got[SAMPLES];
	const approximations_set p = set_of(n, k);
	for (size_t i = 0; i < SAMPLES; i++)
		c[i] = ((float)i + 0.5f) / SAMPLES;
	(void)quick;
	for (size_t w = 0; w < approximations_way_count(); w++) {
		const approximations_way *way = &approximations_ways[w];
		approximations_error e = {0};
		if (way->group != group)
			continue;
		run_loop(way, &p, SAMPLES, c, got, got, got);
		for (size_t i = 0; i < SAMPLES; i++) {
			const double exact = exact_of((double)c[i], (double)p.n.r, (double)p.k.r);
			approximations_error_add(&e, (double)got[i], exact, "cos %.3g", (double)c[i]);
			if (i % 4 == 0)
				e.reference =
					fmax(e.reference, approximations_doubt_fresnel(exact, (double)c[i],
										       (double)p.n.r, (double)p.k.r));
		}
		add_albedos(way, &p, (double)p.n.r, (double)p.k.r, &e);
		approximations_error_row(rows, approximations_groups[group], way->name, of, "reflectance", &e);
	}
}

/* --- films -------------------------------------------------------------------------------------------------------- */

/* Film unit: what the film lies on, and its index. */
static const struct {
	const char *name;
	lobe_uint metal;
	float index;
} films[FILMS] = {{"gold", LOBE_METAL_GOLD, 1.33f},
		  {"aluminium", LOBE_METAL_ALUMINIUM, 1.5f},
		  {"titanium", LOBE_METAL_TITANIUM, 2.2f},
		  {"chromium", LOBE_METAL_CHROMIUM, 1.8f}};

/* The integral over wave number by the trapezoidal rule, which converges faster than any power on what falls to 0 at
 * both ends as the sensitivities do: intervals are halved until that changes it by less than 1e-9. *doubt: the last
 * change, which is what the one but last is off by. */
static double spectral(double c, const approximations_set *p, int k, double *doubt)
{
	enum { LEAST = 64, MOST = 1 << 16 };
	double sum = 0.0, last = 0.0, change = HUGE_VAL;
	for (int n = LEAST; n <= MOST; n *= 2) {
		const double h = (FILM_NU_MAX - FILM_NU_MIN) / n;
		for (int i = n == LEAST ? 0 : 1; i < n; i += n == LEAST ? 1 : 2) {
			const double nu = FILM_NU_MIN + h * i;
			sum += approximations_film_sensitivity(k, nu) *
			       textbook_airy(c, 1.0, (double)p->film.index, (double)p->film.thickness, channel(p->n, k),
					     channel(p->k, k), 1.0 / nu);
		}
		change = n == LEAST ? HUGE_VAL : fabs(sum * h - last);
		last = sum * h;
		if (change < 1e-9)
			break;
	}
	*doubt = fmax(*doubt, change);
	return fmin(fmax(last, 0.0), 1.0);
}

static void film_errors(size_t unit, int quick, report_rows *rows)
{
	enum { ANGLES = 24, ALL = 64 };
	const double step = quick ? 100.0 : 25.0;
	const int angles = quick ? 12 : ANGLES;
	approximations_error e[ALL] = {{0}};
	approximations_set p;
	memset(&p, 0, sizeof p);
	p.n = lobe_metal_eta(films[unit].metal);
	p.k = lobe_metal_k(films[unit].metal);
	for (double d = 0.0; d <= 1500.0; d += step) {
		double exact[ANGLES][3], reference = 0.0;
		float c[ANGLES], r[3][ANGLES];
		p.film = lobe_film_make((float)d, films[unit].index);
		for (int i = 0; i < angles; i++) {
			c[i] = ((float)i + 0.5f) / (float)angles;
			for (int k = 0; k < 3; k++)
				exact[i][k] = spectral((double)c[i], &p, k, &reference);
		}
		for (size_t w = 0; w < approximations_way_count(); w++) {
			if (approximations_ways[w].group != GROUP_FILM)
				continue;
			run_loop(&approximations_ways[w], &p, (size_t)angles, c, r[0], r[1], r[2]);
			e[w].reference = fmax(e[w].reference, reference);
			for (int i = 0; i < angles; i++)
				for (int k = 0; k < 3; k++)
					approximations_error_add(&e[w], fmin(fmax((double)r[k][i], 0.0), 1.0),
								 exact[i][k], "%.0f nm; cos %.3g", d, (double)c[i]);
		}
	}
	for (size_t w = 0; w < approximations_way_count(); w++)
		if (approximations_ways[w].group == GROUP_FILM)
			approximations_error_row(rows, "film", approximations_ways[w].name, films[unit].name,
						 "reflectance of a channel; 0 to 1500 nm", &e[w]);
}

static size_t units(void) { return ETAS + LOBE_METAL_COUNT + FILMS; }

static int run(int quick, size_t unit, report_rows *rows)
{
	char name[32];
	if (unit < ETAS) {
		snprintf(name, sizeof name, "eta %g", etas[unit]);
		reflectances(GROUP_DIELECTRIC, name, etas[unit], 0.0, quick, rows);
	} else if (unit < ETAS + LOBE_METAL_COUNT) {
		const lobe_uint metal = (lobe_uint)(unit - ETAS);
		for (int k = 0; k < 3; k++) {
			snprintf(name, sizeof name, "%s %c", lobe_metal_name(metal), "rgb"[k]);
			reflectances(GROUP_CONDUCTOR, name, channel(lobe_metal_eta(metal), k),
				     channel(lobe_metal_k(metal), k), quick, rows);
		}
	} else {
		film_errors(unit - ETAS - LOBE_METAL_COUNT, quick, rows);
	}
	return 0;
}

const approximations_part approximations_fresnel = {units, run};
