/* test_distributions.c - density, tail, masking and normalisation of every distribution that is chosen at run time
 * (microfacet/distribution.h), against quadrature of densities written anew in distribution_cases.c. */
#include "distribution_cases.h"
#include "measured.h"
#include "support.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const distribution_case *cases;
static size_t count;

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static void test_made(void)
{
	cases = distribution_cases(&count);
	TEST_ASSERT_NOT_NULL(cases);
}

static double one(void *context, double r)
{
	(void)context;
	(void)r;
	return 1.0;
}

/* The references themselves are normalised: they are no copies of what they test. */
static void test_references(void)
{
	double worst = 0.0;
	for (size_t i = 0; i < count; i++)
		worst = worse(worst, fabs(ring_integral(&cases[i], 0.0, HUGE_VAL, one, NULL) - 1.0));
	measured("references: |integral of D cos - 1|", worst, 1e-9);
}

/* pi D of the library at the normal (r, 0, 1), whose length it undoes. */
static double library_p22(const distribution_case *c, double r)
{
	const lobe_facet_density d = lobe_distribution_density(c->d, lobe_vec3_make((float)r, 0.0f, 1.0f));
	return (double)d.inv * (double)d.inv * (double)d.factor / PI;
}

static double library_weight(void *context, double r)
{
	const distribution_case *c = context;
	/* Beyond, a float has no r^2. */
	return r > 1e-15 && r < 1e15 ? library_p22(c, r) / c->p22(c, r) : 1.0;
}

static void test_normalisation(void)
{
	double worst = 0.0;
	for (size_t i = 0; i < count; i++) {
		distribution_case c = cases[i];
		const double error = fabs(ring_integral(&c, 0.0, HUGE_VAL, library_weight, &c) - 1.0);
		worst = worse(worst, error);
	}
	measured("|integral of D cos - 1|", worst, 3e-6);
}

/* Steepness from 1e-6 to 1e6 of the median, as a float. */
static double steepness(const distribution_case *c, uint64_t i)
{
	const double median = sqrt((double)lobe_distribution_tail_inverse(c->d, 0.5f));
	return (double)(float)(median * pow(10.0, 12.0 * ((double)i + 0.5) / 4000.0 - 6.0));
}

/* Relative errors, all and where the value is above 1e-4 of its largest. */
typedef struct {
	double all, bulk;
} errors;

static void add_error(errors *e, double got, double exact, double largest)
{
	const double error = fabs(got / exact - 1.0);
	if (exact < 1e-33 * largest || exact < 1e-36)
		return;
	e->all = worse(e->all, error);
	if (exact > 1e-4 * largest)
		e->bulk = worse(e->bulk, error);
}

/* Bounds: closed forms; tables of user-given densities; and of one whose ring is a hundredth of its steepness wide,
 * which is near the resolution of a float. */
typedef struct {
	double closed, tabulated, narrow;
} bounds;

static double bound_of(const distribution_case *c, bounds b)
{
	return c->d.ndf != LOBE_NDF_TABULATED           ? b.closed
	       : strcmp(c->name, "narrow ring .5") != 0 ? b.tabulated
							: b.narrow;
}

/* bulk: where the value is above 1e-4 of its largest; all: down to 1e-33 of it, where an exponential is that of 76 and
 * more, whose 2 ulp are 2e-5 of the value. */
static void report(const char *what, const distribution_case *c, errors e, bounds bulk, bounds all)
{
	char text[80];
	snprintf(text, sizeof text, "%s: %s, bulk", c->name, what);
	measured(text, e.bulk, bound_of(c, bulk));
	snprintf(text, sizeof text, "%s: %s, all", c->name, what);
	measured(text, e.all, bound_of(c, all));
}

static void test_density(void)
{
	for (size_t i = 0; i < count; i++) {
		const distribution_case *c = &cases[i];
		errors e = {0.0, 0.0};
		double largest = 0.0;
		for (uint64_t k = 0; k < 4000; k++)
			largest = larger(largest, c->p22(c, steepness(c, k)));
		for (uint64_t k = 0; k < 4000; k++) {
			const double r = steepness(c, k);
			add_error(&e, library_p22(c, r), c->p22(c, r), largest);
		}
		/* A cusp at the normal is what a table of tan^2 is worst at. What is next to nothing of a user-given
		 * density, inside a ring above all, is smoothed away; so is the end of a density that jumps to 0. */
		const bounds bulk = {2e-6, strcmp(c->name, "exponential") == 0 ? 5e-4 : c->smooth ? 3e-5 : 1e-4, 1e-4};
		const bounds all = {2e-5, HUGE_VAL, HUGE_VAL};
		report("density", c, e, bulk, all);
	}
}

static void test_tail(void)
{
	for (size_t i = 0; i < count; i++) {
		const distribution_case *c = &cases[i];
		errors e = {0.0, 0.0}, back = {0.0, 0.0};
		for (uint64_t k = 0; k < 4000; k += 40) {
			const double r = steepness(c, k);
			const float t2 = (float)(r * r);
			const double q = reference_tail(c, sqrt((double)t2));
			add_error(&e, (double)lobe_distribution_tail(c->d, t2), q, 1.0);
			/* The inverse, by what its tail is. */
			const float t2_back = lobe_distribution_tail_inverse(c->d, (float)q);
			add_error(&back, reference_tail(c, sqrt((double)t2_back)), (double)(float)q, 1.0);
		}
		const bounds bulk = {2e-6, 4e-6, 2e-5}, all = {2e-5, 2e-5, 2e-5};
		report("tail", c, e, bulk, all);
		report("tail of its inverse", c, back, bulk, all);
	}
}

static void test_hidden(void)
{
	for (size_t i = 0; i < count; i++) {
		const distribution_case *c = &cases[i];
		errors e = {0.0, 0.0};
		const double largest = reference_hidden(c, 1.0, 0.0);
		for (uint64_t k = 0; k < 4000; k += 40) {
			const double z = k == 0 ? 0.0 : steepness(c, k), s = 1.0 / hypot(1.0, z);
			const float x = (float)(0.6 * s), y = (float)(-0.8 * s), h = (float)(z * s);
			const double exact = reference_hidden(c, hypot((double)x, (double)y), (double)h);
			const float above = lobe_distribution_hidden(c->d, lobe_vec3_make(x, y, h));
			const float below = lobe_distribution_hidden(c->d, lobe_vec3_make(x, y, -h));
			add_error(&e, (double)above, exact, largest * s);
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(above), test_float_bits(below));
			/* Degree 1. */
			const float wide = lobe_distribution_hidden(c->d, lobe_vec3_make(4.0f * x, 4.0f * y, 4.0f * h));
			if (above > 1e-35f)
				TEST_ASSERT_EQUAL_HEX32(test_float_bits(4.0f * above), test_float_bits(wide));
		}
		const bounds bulk = {3e-6, 5e-6, 1e-4}, all = {2e-5, 3e-5, 1e-4};
		report("hidden", c, e, bulk, all);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_made);
	RUN_TEST(test_references);
	RUN_TEST(test_normalisation);
	RUN_TEST(test_density);
	RUN_TEST(test_tail);
	RUN_TEST(test_hidden);
	return UNITY_END();
}
