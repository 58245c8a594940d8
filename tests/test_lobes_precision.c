/* test_lobes_precision.c - single precision against the same lobes in double (tests/double.c), and rough glass against
 * Walter's formula as the paper prints it.
 *
 * Both builds get the same floats, so what differs is rounding inside the lobe. A formula of n roundings none of which
 * is amplified is off by at most n u, u = 2^-24; where a difference of nearly equal numbers enters, its condition
 * multiplies u. ROUNDINGS counts the longest chain of a lobe (about 10 for Q and its square, 6 for masking, 10 for
 * Fresnel, 6 for the rest), lobe_condition.c the few places that amplify. Both come from the formulas, not from the
 * result. */
#include "cases.h"
#include "cases_make.h"
#include "double.h"
#include "lobe_condition.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

#define U         0x1p-24
#define ROUNDINGS 32.0

typedef struct {
	unsigned long pairs;
	double well, at_well, extreme, worst_condition, ratio;
	const char *name_well, *name_ratio;
	unsigned long bad;
} tally;

/* Well conditioned: at most 10 u of amplification. */
static void compare(tally *t, const test_case *c, lobe_vec3 wo, lobe_vec3 wi, double got, double exact)
{
	/* Below, a float is subnormal and has fewer bits; above, it overflows. */
	if (!(exact > 1e-32 && exact < 1e37))
		return;
	const conditions k = condition_of(c, wo, wi, 0.0);
	if (k.undecided)
		return;
	const double amplified = k.fresnel + k.index + k.tail;
	const double off = fabs(got - exact) / exact;
	const double ratio = off / (U * (1.0 + amplified));
	t->pairs++;
	if (amplified <= 10.0 && off > t->well) {
		t->well = off;
		t->name_well = c->name;
		t->at_well = (double)wo.z;
	}
	if (amplified > 10.0)
		t->extreme = fmax(t->extreme, off);
	if (ratio > t->ratio) {
		t->ratio = ratio;
		t->name_ratio = c->name;
		t->worst_condition = amplified;
	}
	if (ratio > ROUNDINGS && t->bad++ < 4)
		printf("  %s: wo (%.9g %.9g %.9g) wi (%.9g %.9g %.9g): %.9g, double %.9g, off %.1e, condition %.1e\n",
		       c->name, (double)wo.x, (double)wo.y, (double)wo.z, (double)wi.x, (double)wi.y, (double)wi.z, got,
		       exact, off, amplified);
}

static void print_tally(const char *what, const tally *t)
{
	printf("  %-22s %7lu: relative error <= %.2e = %4.1f u (%s, cos %.0e); ill conditioned %.1e; any: %4.1f u "
	       "times the "
	       "condition (%s, %.0e)\n",
	       what, t->pairs, t->well, t->well / U, t->name_well ? t->name_well : "-", t->at_well, t->extreme,
	       t->ratio, t->name_ratio ? t->name_ratio : "-", t->worst_condition);
}

static void test_float_against_double(void)
{
	const uint32_t n = test_long() ? 20000u : 1000u;
	unsigned long bad = 0;
	for (int side = 0; side < 2; side++) {
		tally eval[3] = {{0}}, pdf[3] = {{0}};
		for (size_t i = 0; i < case_count(); i++) {
			const test_case *c = case_at(i);
			const int group = c->kind == LOBE_KIND_LAMBERT ? 0 : c->flags & CASE_TRANSMITS ? 2 : 1;
			for (size_t k = 0; k < case_wo_count(c); k++)
				for (uint32_t j = 0; j < n; j++) {
					float u[3];
					double o[3], d[3], f[3];
					const lobe_vec3 wo = case_wo(k);
					/* A random direction, or a sample and so a direction where the lobe is. */
					lobe_vec3 wi;
					if (j & 1u) {
						test_direction(70000u + (uint32_t)i, k * n + j, u);
						wi = lobe_vec3_make(u[0], u[1], u[2]);
					} else {
						test_u3(71000u + (uint32_t)i, k * n + j, u);
						wi = lobe_bsdf_sample(c->bsdf, wo, lobe_vec3_make(u[0], u[1], u[2])).wi;
					}
					if ((wo.z * wi.z > 0.0f) != (side == 0))
						continue;
					widen(wo, o);
					widen(wi, d);
					double_eval(c->kind, c->parameter, o, d, f);
					compare(&pdf[group], c, wo, wi, (double)lobe_bsdf_pdf(c->bsdf, wo, wi),
						double_pdf(c->kind, c->parameter, o, d));
					const lobe_rgb e = lobe_bsdf_eval(c->bsdf, wo, wi);
					compare(&eval[group], c, wo, wi, (double)e.r, f[0]);
					compare(&eval[group], c, wo, wi, (double)e.b, f[2]);
				}
		}
		static const char *const groups[] = {"diffuse", "metal", "glass"};
		for (int g = 0; g < 3; g++) {
			char name[64];
			if (side == 1 && g < 2)
				continue;
			sprintf(name, "%s %s eval", groups[g], side ? "transmitted" : "reflected");
			print_tally(name, &eval[g]);
			sprintf(name, "%s %s pdf", groups[g], side ? "transmitted" : "reflected");
			print_tally(name, &pdf[g]);
			TEST_ASSERT_GREATER_THAN(5000, eval[g].pairs);
			bad += eval[g].bad + pdf[g].bad;
		}
	}
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* The double build is the same code, so it shares the library's algebra; the textbook shares neither. alpha .05 .. 1,
 * eta 1.05 .. 3 and its inverse, both sides, |cos| > .02. Directions are floats, unit to u, which the textbook takes as
 * they are: condition_of counts that. */
static void rough_glass_against_walter(textbook_ndf ndf)
{
	unsigned long n[2] = {0}, bad = 0, unscaled = 0;
	double worst[2] = {0}, worst_ratio = 0.0, worst_double = 0.0;
	for (uint32_t j = 0; j < 400000u; j++) {
		float u[3], a[3], b[3];
		test_u3(80000u, j, u);
		test_direction(80001u, j, a);
		test_direction(80002u, j, b);
		if (fabsf(a[2]) < 0.02f || fabsf(b[2]) < 0.02f)
			continue;
		const lobe_real ax = 0.05f + 0.95f * u[0] * u[0], ay = 0.05f + 0.95f * u[1] * u[1];
		const lobe_real up = 1.05f + 1.95f * u[2], eta = j & 1u ? up : 1.0f / up;
		const lobe_vec3 wo = lobe_vec3_make(a[0], a[1], a[2]), wi = lobe_vec3_make(b[0], b[1], b[2]);
		test_case c = {"random glass",
			       LOBE_KIND_GGX_DIELECTRIC,
			       {0},
			       {0},
			       CASE_TWO_SIDED | CASE_TRANSMITS,
			       0,
			       0,
			       0,
			       0,
			       ndf};
		if (ndf == TEXTBOOK_BECKMANN)
			c.kind = LOBE_KIND_BECKMANN_DIELECTRIC;
		c.alpha_x = c.parameter[0] = (double)ax;
		c.alpha_y = c.parameter[1] = (double)ay;
		c.eta = c.parameter[2] = (double)eta;
		double o[3], i[3], f[3];
		widen(wo, o);
		widen(wi, i);
		textbook_normalize(o);
		textbook_normalize(i);
		const double exact = textbook_rough_glass(ndf, c.alpha_x, c.alpha_y, c.eta, o, i);
		c.bsdf = make_bsdf(c.kind, c.parameter);
		const double got = (double)lobe_bsdf_eval(c.bsdf, wo, wi).g;
		const conditions k = condition_of(&c, wo, wi, 1.0);
		if (k.undecided)
			continue;
		const int across = wo.z * wi.z < 0.0f;
		if (exact < 1e-20) {
			bad += got > 1e-12 * (1.0 + k.input);
			continue;
		}
		const double amplified = k.fresnel + k.index + k.input + k.tail;
		const double off = fabs(got - exact) / exact;
		/* In double, with directions unit to 2^-53, nothing but algebra is left. */
		double_eval(c.kind, c.parameter, o, i, f);
		const double off_double = fabs(f[1] - exact) / exact;
		n[across]++;
		if (amplified <= 100.0) {
			worst[across] = fmax(worst[across], off);
			worst_double = fmax(worst_double, off_double);
		}
		const double ratio = off / (U * (1.0 + amplified));
		worst_ratio = fmax(worst_ratio, ratio);
		/* A forgotten square of eta, which is what importance is, has to show. */
		const double e = a[2] > 0.0f ? c.eta : 1.0 / c.eta;
		unscaled += across && fabs(got * e * e - exact) / exact > ROUNDINGS * U * (1.0 + amplified);
		if ((ratio > ROUNDINGS || off_double > 1e-9 * (1.0 + amplified)) && bad++ < 4)
			printf("  alpha %.9g %.9g eta %.9g wo (%.9g %.9g %.9g) wi (%.9g %.9g %.9g): %.9g, Walter %.9g, "
			       "condition %.1e\n",
			       (double)ax, (double)ay, (double)eta, (double)wo.x, (double)wo.y, (double)wo.z,
			       (double)wi.x, (double)wi.y, (double)wi.z, got, exact, amplified);
	}
	printf("  Walter 2007, %s: %lu reflections off by at most %.1e, %lu refractions by %.1e where well conditioned "
	       "(double build "
	       "%.1e); %.1f u times the condition anywhere\n",
	       ndf == TEXTBOOK_BECKMANN ? "Beckmann" : "GGX", n[0], worst[0], n[1], worst[1], worst_double,
	       worst_ratio);
	/* Beckmann has next to no tails, and pairs of random directions mostly lie there. */
	TEST_ASSERT_GREATER_THAN(50000, n[0]);
	TEST_ASSERT_GREATER_THAN(ndf == TEXTBOOK_BECKMANN ? 20000 : 30000, n[1]);
	TEST_ASSERT_EQUAL_UINT(0, bad);
	TEST_ASSERT_GREATER_THAN(n[1] / 100 * 99, unscaled);
}

static void test_rough_glass_against_walter(void)
{
	rough_glass_against_walter(TEXTBOOK_GGX);
	rough_glass_against_walter(TEXTBOOK_BECKMANN);
}

/* The same for metals, of every index in optics.def. */
static void rough_metal_against_the_textbook(textbook_ndf ndf)
{
	unsigned long n = 0, bad = 0;
	double worst = 0.0, worst_ratio = 0.0;
	for (uint32_t j = 0; j < 200000u; j++) {
		float u[3], a[3], b[3];
		test_u3(81000u, j, u);
		test_direction(81001u, j, a);
		test_direction(81002u, j, b);
		if (fabsf(a[2]) < 0.02f || fabsf(b[2]) < 0.02f)
			continue;
		const lobe_real ax = 0.05f + 0.95f * u[0] * u[0], ay = 0.05f + 0.95f * u[1] * u[1];
		const lobe_rgb eta = lobe_metal_eta(j % LOBE_METAL_COUNT), kappa = lobe_metal_k(j % LOBE_METAL_COUNT);
		const lobe_vec3 wo = lobe_vec3_make(a[0], a[1], fabsf(a[2])),
				wi = lobe_vec3_make(b[0], b[1], fabsf(b[2]));
		test_case c = {"random metal", LOBE_KIND_GGX_CONDUCTOR, {0}, {0}, 0, 0, 0, 0, 0, ndf};
		if (ndf == TEXTBOOK_BECKMANN)
			c.kind = LOBE_KIND_BECKMANN_CONDUCTOR;
		c.alpha_x = c.parameter[0] = (double)ax;
		c.alpha_y = c.parameter[1] = (double)ay;
		c.parameter[2] = (double)eta.r;
		c.parameter[3] = (double)eta.g;
		c.parameter[4] = (double)eta.b;
		c.parameter[5] = (double)kappa.r;
		c.parameter[6] = (double)kappa.g;
		c.parameter[7] = (double)kappa.b;
		double o[3], i[3];
		widen(wo, o);
		widen(wi, i);
		textbook_normalize(o);
		textbook_normalize(i);
		c.bsdf = make_bsdf(c.kind, c.parameter);
		const lobe_rgb f = lobe_bsdf_eval(c.bsdf, wo, wi);
		const double got[3] = {(double)f.r, (double)f.g, (double)f.b};
		const conditions k = condition_of(&c, wo, wi, 1.0);
		for (int m = 0; m < 3; m++) {
			const double exact = textbook_rough_metal(ndf, c.alpha_x, c.alpha_y, c.parameter[2 + m],
								  c.parameter[5 + m], o, i);
			if (exact < 1e-30) { /* the tails of Beckmann */
				bad += got[m] > 1e-20;
				continue;
			}
			const double off = fabs(got[m] - exact) / exact;
			const double ratio = off / (U * (1.0 + k.fresnel + k.input + k.tail));
			n++;
			worst = fmax(worst, off);
			worst_ratio = fmax(worst_ratio, ratio);
			bad += ratio <= ROUNDINGS ? 0u : 1u;
		}
	}
	printf("  rough metal, textbook, %s: %lu values off by at most %.1e, %.1f u times the condition\n",
	       ndf == TEXTBOOK_BECKMANN ? "Beckmann" : "GGX", n, worst, worst_ratio);
	TEST_ASSERT_GREATER_THAN(ndf == TEXTBOOK_BECKMANN ? 200000 : 300000, n);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

static void test_rough_metal_against_the_textbook(void)
{
	rough_metal_against_the_textbook(TEXTBOOK_GGX);
	rough_metal_against_the_textbook(TEXTBOOK_BECKMANN);
}

/* What the comparison rests on: a relative error of 1e-5 in one value is seen. */
static void test_a_planted_error_is_caught(void)
{
	tally t = {0};
	const test_case *c = case_at(0);
	const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
	compare(&t, c, up, up, 1.0 + 20.0 * U, 1.0);
	TEST_ASSERT_EQUAL_UINT(0, t.bad);
	t.bad = 100; /* says nothing */
	compare(&t, c, up, up, 1.0 + 1e-5, 1.0);
	TEST_ASSERT_EQUAL_UINT(101, t.bad);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_float_against_double);
	RUN_TEST(test_rough_glass_against_walter);
	RUN_TEST(test_rough_metal_against_the_textbook);
	RUN_TEST(test_a_planted_error_is_caught);
	return UNITY_END() != 0;
}
