/* test_lobes_chi2.c - samples against the density: it integrates to 1 less what sample rejects, and the samples follow
 * it bin by bin (lobe_histogram.h). */
#include "cases.h"
#include "chi_square.h"
#include "directions.h"
#include "lobe_histogram.h"
#include "quadrature.h"
#include "support.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

#define LEVEL 0.01

/* cos and azimuth of wo; those below the surface are for lobes with two sides. */
static const double views[][2] = {{1.0, 0.0}, {0.7, 0.6}, {0.25, 2.2}, {0.04, 4.0}, {-0.8, 5.5}, {-0.15, 1.2}};
#define VIEWS (sizeof views / sizeof *views)

static lobe_vec3 view(size_t i) { return direction_at(views[i][0], views[i][1]); }

/* The double build is looked at where float directions are too coarse to resolve the lobe. */
static int planned(const test_case *c, lobe_vec3 wo, int in_double)
{
	if ((wo.z < 0.0f && !(c->flags & CASE_TWO_SIDED)) || (c->flags & CASE_DELTA_ONLY))
		return 0;
	const double noise = case_rounding(c, wo);
	return in_double ? noise >= CASE_SMOOTH && noise * 0x1p-29 < CASE_SMOOTH : noise < CASE_SMOOTH;
}

typedef struct {
	const char *name;
	int in_double;
	double cos_o, integral, rejected, sigma, quadrature_error, p;
	int dof;
} result;

static result *results;
static size_t result_count;

static void measure_all(void)
{
	histogram *h = malloc(sizeof *h);
	results = malloc(2 * case_count() * VIEWS * sizeof *results);
	if (!h || !results)
		exit(2);
	for (int in_double = 0; in_double < 2; in_double++)
		for (size_t i = 0; i < case_count(); i++)
			for (size_t k = 0; k < VIEWS; k++) {
				const test_case *c = case_at(i);
				const lobe_vec3 wo = view(k);
				/* A third of the views of each case, so that every view has a third of the cases: all
				 * that is tested is tested with the same power. */
				if (!planned(c, wo, in_double) || (!test_long() && (i + k) % 3 != 0))
					continue;
				const scene s = scene_make(c, wo, in_double, RIGHT);
				result *r = &results[result_count];
				expect(&s, h);
				observe(&s, 1000u + (uint32_t)result_count++, h);
				r->name = c->name;
				r->in_double = in_double;
				r->cos_o = views[k][0];
				const chi_square fit = fit_of(h);
				r->p = fit.p;
				r->dof = fit.dof;
				r->integral = 1.0 - h->expected[REJECT];
				r->rejected = h->observed[REJECT] / (double)SAMPLES;
				r->sigma = sqrt(r->rejected * (1.0 - r->rejected) / SAMPLES);
				r->quadrature_error = h->quadrature_error;
				if (test_long())
					printf("  %-26s %s cos %5.2f  integral %.5f  rejected %.5f  chi2 %8.1f  dof "
					       "%3d  p %.2e  qerr %.1e\n",
					       r->name, in_double ? "double" : "float ", r->cos_o, r->integral,
					       r->rejected, fit.chi2, r->dof, r->p, r->quadrature_error);
			}
	free(h);
}

/* 5 standard deviations of the rejected share of 1M samples, and what the quadrature admits to. */
static void test_pdf_integrates_to_one_less_what_is_rejected(void)
{
	double worst = 0.0, worst_sigmas = 0.0;
	size_t bad = 0;
	for (size_t i = 0; i < result_count; i++) {
		const result *r = &results[i];
		const double off = fabs(r->integral + r->rejected - 1.0);
		const double allowed = 5.0 * r->sigma + 5.0 / SAMPLES + r->quadrature_error;
		worst = fmax(worst, off);
		worst_sigmas = fmax(worst_sigmas, off / fmax(r->sigma, 1.0 / SAMPLES));
		if (off > allowed) {
			bad++;
			printf("  %-26s %s cos %5.2f: integral %.6f + rejected %.6f is off by %.1e, allowed %.1e\n",
			       r->name, r->in_double ? "double" : "float", r->cos_o, r->integral, r->rejected, off,
			       allowed);
		}
	}
	printf("  %zu integrals: |integral + rejected - 1| <= %.1e, at most %.1f standard deviations\n", result_count,
	       worst, worst_sigmas);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

static double sidak(void) { return -expm1(log1p(-LEVEL) / (double)result_count); }

static void test_samples_follow_the_pdf(void)
{
	double least = 1.0;
	size_t bad = 0, in_float = 0;
	for (size_t i = 0; i < result_count; i++) {
		const result *r = &results[i];
		least = fmin(least, r->p);
		in_float += !r->in_double;
		if (r->p < sidak()) {
			bad++;
			printf("  %-26s %s cos %5.2f: p %.2e, %d degrees of freedom\n", r->name,
			       r->in_double ? "double" : "float", r->cos_o, r->p, r->dof);
		}
	}
	printf("  %zu chi-square tests of 1M samples, %zu of them in single precision: least p %.2e, level %.2e\n",
	       result_count, in_float, least, sidak());
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

static const test_case *case_named(const char *name)
{
	for (size_t i = 0; i < case_count(); i++)
		if (strcmp(case_at(i)->name, name) == 0)
			return case_at(i);
	TEST_FAIL_MESSAGE(name);
	return NULL;
}

/* The same machinery on a density that is 2 % wrong in a region, one whose alpha is 3 % wrong, and the true one. */
static void test_a_wrong_pdf_is_caught(void)
{
	static const char *const names[] = {"lambert grey",        "gold .25",  "copper .05:.4",
					    "glass .3 importance", "bubble .2", "beckmann gold .25"};
	histogram *h = malloc(sizeof *h);
	TEST_ASSERT_NOT_NULL(h);
	for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
		const test_case *c = case_named(names[i]);
		double p[3] = {1.0, 1.0, 1.0};
		for (int wrong = RIGHT; wrong <= WRONG_ALPHA; wrong++) {
			scene s = scene_make(c, view(1), 0, wrong);
			if (wrong == WRONG_ALPHA) {
				const lobe_real ax = (lobe_real)(1.03 * c->alpha_x),
						ay = (lobe_real)(1.03 * c->alpha_y);
				if (c->kind == LOBE_KIND_GGX_CONDUCTOR)
					s.wrong_bsdf.as.ggx_conductor.stretch = lobe_stretch_make(ax, ay);
				else if (c->kind == LOBE_KIND_GGX_DIELECTRIC)
					s.wrong_bsdf.as.ggx_dielectric.stretch = lobe_stretch_make(ax, ay);
				else if (c->kind == LOBE_KIND_BECKMANN_CONDUCTOR)
					s.wrong_bsdf.as.beckmann_conductor.stretch = lobe_stretch_make(ax, ay);
				else
					continue;
			}
			expect(&s, h);
			observe(&s, 77u, h);
			p[wrong] = fit_of(h).p;
		}
		printf("  %-20s p: true pdf %.2e, 2 %% in a region %.2e, alpha off by 3 %% %.2e\n", c->name, p[RIGHT],
		       p[WRONG_SCALE], p[WRONG_ALPHA]);
		TEST_ASSERT_TRUE(p[RIGHT] > sidak());
		TEST_ASSERT_TRUE(p[WRONG_SCALE] < 1e-9);
		TEST_ASSERT_TRUE(c->alpha_x <= 0.0 || p[WRONG_ALPHA] < 1e-9);
	}
	free(h);
}

/* A second rule that knows nothing of facets: equal areas of the whole sphere. It would see a density where the maps of
 * the others never go. */
static double sphere_pdf(void *context, double x, double y)
{
	const scene *s = context;
	const direction_map m = {MAP_SPHERE, {0.0, 0.0, 1.0}, 1.0, 0.0, 0.0, 1.0};
	double wi[3];
	return map_direction(&m, x, y, wi) * pdf_at(s, wi, x);
}

/* The density jumps at the horizon, and where the facet that refracts is vertical: o.z + e i.z = 0. The grid has lines
 * there, since Gauss points need not notice a jump. */
static double over_sphere(scene *s, double *error)
{
	const direction_map *m = &s->transmit;
	double at[4] = {0.0, 0.5, 0.5, 1.0}, sum = 0.0;
	quadrature q = {sphere_pdf, NULL, NULL, s, 1e-8, 1e-4, 9, 0.0};
	if ((s->c->flags & CASE_TRANSMITS) && m->o[2] < m->e)
		at[m->side > 0.0 ? 1 : 2] = 0.5 - 0.5 * m->side * m->o[2] / m->e;
	for (int i = 0; i < 3; i++)
		for (int a = 0; a < 12 && at[i] < at[i + 1]; a++)
			for (int b = 0; b < 16; b++) {
				const double step = (at[i + 1] - at[i]) / 12.0;
				sum += quadrature_box(&q, at[i] + a * step, at[i] + (a + 1) * step, b / 16.0,
						      (b + 1) / 16.0);
			}
	*error = q.error;
	return sum;
}

static void test_pdf_over_the_whole_sphere_agrees(void)
{
	double worst = 0.0;
	unsigned n = 0;
	for (size_t i = 0; i < result_count; i++) {
		const result *r = &results[i];
		const test_case *c = case_named(r->name);
		const double smooth = c->alpha_x > 0.0 ? fmin(c->alpha_x, c->alpha_y) : 1.0;
		const int bends = !(c->flags & CASE_TRANSMITS) || fabs(c->eta - 1.0) > 0.1;
		if (r->in_double || smooth < 0.2 || !bends || fabs(r->cos_o) < 0.1)
			continue;
		for (size_t k = 0; k < VIEWS; k++)
			if (views[k][0] == r->cos_o) {
				scene s = scene_make(c, view(k), 0, RIGHT);
				double error = 0.0;
				const double sum = over_sphere(&s, &error);
				const double off = fabs(sum - r->integral);
				worst = fmax(worst, off);
				n++;
				if (off > 1e-4 + error + r->quadrature_error)
					printf("  %s cos %.2f: %.6f over the sphere, %.6f over facets\n", r->name,
					       r->cos_o, sum, r->integral);
				TEST_ASSERT_TRUE(off <= 1e-4 + error + r->quadrature_error);
			}
	}
	printf("  %u integrals by the other rule: largest difference %.1e\n", n, worst);
	TEST_ASSERT_TRUE(n > 20u);
}

int main(void)
{
	UNITY_BEGIN();
	batch_open();
	measure_all();
	RUN_TEST(test_pdf_integrates_to_one_less_what_is_rejected);
	RUN_TEST(test_samples_follow_the_pdf);
	RUN_TEST(test_a_wrong_pdf_is_caught);
	RUN_TEST(test_pdf_over_the_whole_sphere_agrees);
	free(results);
	batch_close();
	return UNITY_END() != 0;
}
