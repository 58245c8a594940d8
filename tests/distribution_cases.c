#include "distribution_cases.h"

#include "support.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* D = (n + 2)/(2 pi) cos^n; P22 = D cos^4. */
static double phong(const distribution_case *c, double r)
{
	return (c->a + 2.0) / TWO_PI * exp(-0.5 * (c->a + 4.0) * log1p(r * r));
}

/* Burley 2012: D = (g - 1)(A - 1)/(pi (1 - A^(1 - g)))/(1 + (A - 1) cos^2)^g, its limits at g = 1 and A = 1 apart.
 * 1 + (A - 1) cos^2 = (A + r^2) cos^2. */
static double gtr(const distribution_case *c, double r)
{
	const double g = c->a, a = c->b * c->b, t = r * r;
	const double norm = a == 1.0   ? 1.0
			    : g == 1.0 ? (a - 1.0) / log(a)
				       : (g - 1.0) * (a - 1.0) / (1.0 - pow(a, 1.0 - g));
	return norm / PI * pow((1.0 + t) / (a + t), g) / ((1.0 + t) * (1.0 + t));
}

/* Ribardiere et al. 2017. */
static double student_t(const distribution_case *c, double r) { return exp(-c->a * log1p(r * r / (c->a - 1.0))) / PI; }

/* User-given ones, normalised by hand. A broad and a narrow Gaussian: half each. */
static double two_gaussians(const distribution_case *c, double r)
{
	return 0.5 / PI * (exp(-r * r / (c->a * c->a)) / (c->a * c->a) + exp(-r * r / (c->b * c->b)) / (c->b * c->b));
}

/* exp(-r/a)/(2 pi a^2) */
static double exponential(const distribution_case *c, double r) { return exp(-r / c->a) / (TWO_PI * c->a * c->a); }

/* A ring: r^2 exp(-r^2/a^2)... to a high power: (r/a)^(2b) exp(-b r^2/a^2), int = pi a^2 b! b^-(b + 1) */
static double ring(const distribution_case *c, double r)
{
	const double x = r * r / (c->a * c->a);
	return r > 0.0 ? exp(c->b * (log(x) - x) + (c->b + 1.0) * log(c->b) - lgamma(c->b + 1.0)) / (PI * c->a * c->a)
		       : 0.0;
}

/* Two steps: 1 up to a, 1/5 up to b. */
static double steps(const distribution_case *c, double r)
{
	const double norm = PI * (0.8 * c->a * c->a + 0.2 * c->b * c->b);
	return r < c->a ? 1.0 / norm : r < c->b ? 0.2 / norm : 0.0;
}

/* A disk, nothing, and a step: 1 up to a, 1/2 from b to b + a. */
static double gap(const distribution_case *c, double r)
{
	const double norm = PI * (c->a * c->a + 0.5 * c->a * (2.0 * c->b + c->a));
	return r < c->a ? 1.0 / norm : r > c->b && r < c->b + c->a ? 0.5 / norm : 0.0;
}

static distribution_case cases[] = {
	{"Phong 0", phong, 0, 0, {0}, 1, {0}},
	{"Phong 5", phong, 5, 0, {0}, 1, {0}},
	{"Phong 40", phong, 40, 0, {0}, 1, {0}},
	{"Phong 1000", phong, 1000, 0, {0}, 1, {0}},
	{"Phong 2e8", phong, 2e8, 0, {0}, 1, {0}},
	{"GTR 1, .1", gtr, 1, 0.1, {0}, 1, {0}},
	{"GTR 1, 1e-4", gtr, 1, 1e-4, {0}, 1, {0}},
	{"GTR 1, 1", gtr, 1, 1, {0}, 1, {0}},
	{"GTR 1.5, .3", gtr, 1.5, 0.3, {0}, 1, {0}},
	{"GTR 1.5, 1", gtr, 1.5, 1, {0}, 1, {0}},
	{"GTR .5, .05", gtr, 0.5, 0.05, {0}, 1, {0}},
	{"GTR 2, .25", gtr, 2, 0.25, {0}, 1, {0}},
	{"GTR 2, 1e-4", gtr, 2, 1e-4, {0}, 1, {0}},
	{"GTR 3, .1", gtr, 3, 0.1, {0}, 1, {0}},
	{"GTR 4, .5", gtr, 4, 0.5, {0}, 1, {0}},
	{"GTR 4, 1e-4", gtr, 4, 1e-4, {0}, 1, {0}},
	{"GTR 10, .2", gtr, 10, 0.2, {0}, 1, {0}},
	{"Student-T 1.6", student_t, 1.6, 0, {0}, 1, {0}},
	{"Student-T 1.7", student_t, 1.7, 0, {0}, 1, {0}},
	{"Student-T 2", student_t, 2, 0, {0}, 1, {0}},
	{"Student-T 3", student_t, 3, 0, {0}, 1, {0}},
	{"Student-T 10", student_t, 10, 0, {0}, 1, {0}},
	{"Student-T 1000", student_t, 1000, 0, {0}, 1, {0}},
	{"two Gaussians", two_gaussians, 0.7, 0.05, {0}, 1, {0}},
	{"exponential", exponential, 0.3, 0, {0}, 1, {0}},
	{"ring .5", ring, 0.5, 50, {0}, 1, {0}},
	{"narrow ring .5", ring, 0.5, 5000, {0}, 1, {0}},
	{"steps", steps, 0.7, 1.5, {0.7, 1.5, 0}, 0, {0}},
	{"gap", gap, 0.25, 0.625, {0.25, 0.625, 0.875, 0}, 0, {0}},
};
enum { CASES = sizeof cases / sizeof *cases };

static float tables[CASES][LOBE_PROFILE_WORDS];

/* Up to a factor, as a user would give it. */
static double user_density(void *context, double r)
{
	const distribution_case *c = context;
	return 17.0 * c->p22(c, r);
}

static lobe_status make(distribution_case *c, float *table)
{
	const float a = (float)c->a, b = (float)c->b;
	/* The reference has the parameters that the library gets. */
	if (c->p22 == phong || c->p22 == student_t || c->p22 == gtr) {
		c->a = (double)a;
		c->b = (double)b;
	}
	if (c->p22 == phong)
		return lobe_distribution_phong(&c->d, table, LOBE_PROFILE_WORDS, a);
	if (c->p22 == gtr)
		return lobe_distribution_gtr(&c->d, table, LOBE_PROFILE_WORDS, a, b);
	if (c->p22 == student_t)
		return lobe_distribution_student_t(&c->d, table, LOBE_PROFILE_WORDS, a);
	return lobe_distribution_tabulated(&c->d, table, LOBE_PROFILE_WORDS, user_density, c);
}

const distribution_case *distribution_cases(size_t *count)
{
	static int made;
	for (size_t i = 0; i < CASES && !made; i++) {
		if (make(&cases[i], tables[i]) != LOBE_OK) {
			printf("%s: %s\n", cases[i].name, lobe_error_message());
			return NULL;
		}
	}
	made = 1;
	*count = CASES;
	return cases;
}

const distribution_case *distribution_case_named(const char *name)
{
	size_t n;
	const distribution_case *c = distribution_cases(&n);
	for (size_t i = 0; c && i < n; i++)
		if (strcmp(c[i].name, name) == 0)
			return &c[i];
	return NULL;
}

typedef struct {
	const distribution_case *c;
	double r0;
	double (*weight)(void *context, double r);
	void *context;
} ring_integrand;

static double ring_integrand_at(double y, void *context)
{
	const ring_integrand *f = context;
	const double e = exp(y), r = f->r0 + e;
	const double p22 = f->c->p22(f->c, r);
	return p22 > 0.0 ? e * TWO_PI * r * p22 * f->weight(f->context, r) : 0.0;
}

double ring_integral(const distribution_case *c, double r0, double r1, double (*weight)(void *context, double r),
		     void *context)
{
	static gsl_integration_glfixed_table *rule;
	ring_integrand f = {c, r0, weight, context};
	gsl_function g;
	g.function = ring_integrand_at;
	g.params = &f;
	if (!rule)
		rule = gsl_integration_glfixed_table_alloc(16);
	const double end = r1 < HUGE_VAL ? log(r1 - r0) : 1e3;
	double sum = 0.0, y0 = -60.0;
	/* Pieces of 1/2; of 1/20 where a ring may be. */
	while (y0 < end && y0 < 150.0) {
		double y1 = y0 + (c->p22 == ring ? 0.05 : 0.5);
		for (int i = 0; c->breaks[i] > 0.0; i++) {
			const double y = c->breaks[i] > r0 ? log(c->breaks[i] - r0) : -1e3;
			y1 = y > y0 + 1e-9 && y < y1 ? y : y1;
		}
		y1 = y1 < end ? y1 : end;
		sum += gsl_integration_glfixed(&g, y0, y1, rule);
		y0 = y1;
	}
	return sum;
}

static double one(void *context, double r)
{
	(void)context;
	(void)r;
	return 1.0;
}

double reference_tail(const distribution_case *c, double r) { return ring_integral(c, r, HUGE_VAL, one, NULL); }

/* 2 s r (sin p - p cos p) with cos p = -z/(s r), or 2 pi z where the whole ring is seen. (1 + cos p)/2 tells p with
 * small error where it is small, below the horizon. */
double reference_kernel(double s, double z, double r)
{
	if (z >= s * r)
		return TWO_PI * z;
	if (z <= -s * r)
		return 0.0;
	const double p = 2.0 * asin(sqrt(0.5 * (s * r + z) / (s * r))), p2 = p * p;
	const double series = p * p2 * (1.0 / 3.0 - p2 * (1.0 / 30.0 - p2 * (1.0 / 840.0 - p2 / 45360.0)));
	return 2.0 * s * r * (p < 0.1 ? series : sin(p) - p * cos(p));
}

typedef struct {
	double s, z;
} view;

static double hidden_weight(void *context, double r)
{
	const view *v = context;
	return reference_kernel(v->s, -v->z, r) / TWO_PI;
}

double reference_hidden(const distribution_case *c, double s, double z)
{
	view v = {s, fabs(z)};
	return ring_integral(c, v.z / s, HUGE_VAL, hidden_weight, &v);
}
