/* test_beckmann.c - microfacet/beckmann.h: the distribution, its projected area and masking, against the definitions in
 * double. Widths are the business of stretch.h (test_ggx.c) and of the lobes' tests. (Visible normals:
 * test_beckmann_visible.c.) */
#include "directions.h"
#include "double_reference.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include "lobe/microfacet/beckmann.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- the definitions ---------------------------------------------------------------------------------------------- */

static double radius(lobe_vec3 v) { return hypot((double)v.x, (double)v.y); }

static double exact_hidden(lobe_vec3 v)
{
	const double r = radius(v), c = fabs((double)v.z) / r;
	return r > 0.0 && c < 27.0 ? 0.5 * r * exp(-c * c) * reference_ierfcx(c) : 0.0;
}

/* Number i of cotangents from 1e-7 to 1e7, of either sign. */
static double cotangent(uint32_t stream, uint64_t i)
{
	const double c = pow(10.0, 14.0 * (double)test_uniform(stream, i) - 7.0);
	return i % 7 == 0 ? 0.0 : i & 1 ? c : -c;
}

/* --- D, hidden, t ------------------------------------------------------------------------------------------------- */

static void test_density(void)
{
	double worst = 0.0;
	for (uint64_t i = 0; i < 300000; i++) {
		const double slope = 9.0 * (double)test_uniform(1, 3 * i),
			     phi = TWO_PI * (double)test_uniform(1, 3 * i + 1);
		const double z = pow(10.0, 4.0 * (double)test_uniform(1, 3 * i + 2) - 2.0);
		const lobe_vec3 h =
			lobe_vec3_make((float)(z * slope * cos(phi)), (float)(z * slope * sin(phi)), (float)z);
		const lobe_facet_density d = lobe_beckmann_density(h);
		const double z2 = (double)h.z * (double)h.z, t2 = radius(h) * radius(h) / z2;
		const double e = exp(-t2) / (z2 * z2);
		const double got = (double)d.inv * (double)d.inv * (double)d.factor;
		if (exp(-t2) > 0x1p-126) /* below, a float has fewer bits */
			worst = worse(worst, fabs(got / e - 1.0) / (U * (4.0 + 4.0 * t2)));
		/* What production lobes use is the same to the last bit, or nothing. */
		const lobe_facet_density over = lobe_beckmann_density_over(lobe_vec3_squares(h), 1.0f);
		TEST_ASSERT_TRUE(over.inv == d.inv);
		if (fabs(t2 / 87.0 - 1.0) > 4.0 * U) {
			const float kept = t2 < 87.0 ? d.factor : 0.0f;
			TEST_ASSERT_TRUE(over.factor == kept);
		}
	}
	/* inv carries 2 U and stands squared; exp 1.8 U; its argument 3.5 U of itself. */
	measured("density: relative error over (4 + 4 t^2) u", worst, 1.5);
	/* Steep normals: nothing, never NaN, as long as 1/z^2 is finite. */
	const lobe_facet_density steep = lobe_beckmann_density(lobe_vec3_make(1.0f, 0.0f, 1e-15f));
	TEST_ASSERT_TRUE(steep.factor == 0.0f && steep.inv <= LOBE_REAL_MAX);
}

static void test_hidden_and_t(void)
{
	double worst_hidden = 0.0, worst_t = 0.0, worst_g2 = 0.0;
	for (uint64_t i = 0; i < 300000; i++) {
		const double length = pow(10.0, 8.0 * (double)test_uniform(3, i) - 4.0);
		/* Every other one where hidden is neither 0 nor all. */
		const double c = i & 1 ? 10.0 * (double)test_uniform(4, i) : cotangent(2, i);
		const lobe_vec3 v = at_cotangent(c, 6.0 * (double)test_uniform(5, i), length);
		const double e = exact_hidden(v), cot = fabs((double)v.z) / radius(v);
		const double got = (double)lobe_beckmann_hidden(v), t = (double)lobe_beckmann_t(v);
		/* c carries 3 U, so exp(-c^2) 6 c^2 U. */
		if (exp(-cot * cot) > 0x1p-126 && e > 1e-30)
			worst_hidden = worse(worst_hidden, fabs(got / e - 1.0) / (U * (10.0 + 7.0 * cot * cot)));
		worst_t = worse(worst_t, fabs(t / (fabs((double)v.z) + 2.0 * e) - 1.0));
		const lobe_vec3 w = at_cotangent(fabs(cotangent(6, i)), 0.3, 1.0);
		const double z = fabs((double)v.z), tw = (double)lobe_beckmann_t(w);
		if (z > 0.0 && w.z > 0.0f) {
			const double g2 = z * (double)lobe_smith_g2_over_cos((float)z, (float)t, w.z, (float)tw);
			const double least = fmin(2.0 * z / (z + t), 2.0 * (double)w.z / ((double)w.z + tw));
			worst_g2 = worse(worst_g2, g2 / least - 1.0);
		}
	}
	measured("hidden: relative error over (10 + 7 c^2) u", worst_hidden, 1.0);
	/* c carries 3 U, of which t sees as much as d ierfc/dc = -erfc(c) passes on; 3 U for r, the sum and the
	 * product; the polynomial is off by .8 U where its value is about all of t, and rounds 2 U. */
	measured("t: relative error in u", worst_t / U, 7.0);
	measured("G2/min(G1(o), G1(i)) - 1, in u", worst_g2 / U, 14.0);
	/* The ends: straight up, along the horizon, nowhere. */
	const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 2.0f), along = lobe_vec3_make(0.0f, 3.0f, 0.0f);
	TEST_ASSERT_TRUE(lobe_beckmann_hidden(up) == 0.0f && lobe_beckmann_t(up) == 2.0f);
	TEST_ASSERT_FLOAT_WITHIN(1e-6f, 3.0f / sqrtf((float)PI), lobe_beckmann_t(along));
	TEST_ASSERT_TRUE(lobe_beckmann_hidden(lobe_vec3_make(0.0f, 0.0f, 0.0f)) == 0.0f);
	TEST_ASSERT_TRUE(lobe_beckmann_hidden_rational(lobe_vec3_make(0.0f, 0.0f, 0.0f)) == 0.0f);
}

/* Walter states that G1 is off by less than .35 %. Without the cut at 1.6 it is not. */
static void test_rational_lambda(void)
{
	double worst = 0.0, at = 0.0, uncut = 0.0;
	for (int i = 1; i <= 200000; i++) {
		const double c = i * 1e-4;
		const lobe_vec3 v = at_cotangent(c, 1.0, 1.0);
		const double z = (double)v.z, exact = z / (z + exact_hidden(v));
		const double off = fabs(z / (z + (double)lobe_beckmann_hidden_rational(v)) - exact);
		const double lambda = (1.0 - 1.259 * c + 0.396 * c * c) / (3.535 * c + 2.181 * c * c);
		at = off > worst ? c : at;
		worst = worse(worst, off);
		uncut = larger(uncut, fabs(1.0 / (1.0 + lambda) - exact));
	}
	measured("G1 by Walter's rational Lambda against the exact one", worst, 0.00312);
	printf("  at c = %.3f; without the cut at 1.6: %.4f\n", at, uncut);
	TEST_ASSERT_TRUE(uncut > 0.05);
}

/* --- integrals of D ----------------------------------------------------------------------------------------------- */

/* Over slopes (x, y), where D m.z dm = P22 dx dy and P22 is the density at (-x, -y, 1) over pi. The plane of slopes is
 * cut along the line where v.m changes its sign, so that the integrand is smooth. */
typedef struct {
	lobe_vec3 v;
	double x;
} plane;

static double p22(double x, double y)
{
	const lobe_facet_density d = lobe_beckmann_density(lobe_vec3_make((float)-x, (float)-y, 1.0f));
	return (double)d.inv * (double)d.inv * (double)d.factor / PI;
}

/* x: along v's azimuth, positive where facets lean towards v. */
static double along_y(double y, void *context)
{
	const plane *p = context;
	const double phi = atan2((double)p->v.y, (double)p->v.x);
	const double mx = cos(phi) * p->x - sin(phi) * y, my = sin(phi) * p->x + cos(phi) * y;
	const double facing = (double)p->v.x * mx + (double)p->v.y * my + (double)p->v.z;
	return p22(-mx, -my) * (facing > 0.0 ? facing : 0.0);
}

static double along_x(double x, void *context)
{
	plane *p = context;
	static gsl_integration_glfixed_table *rule = NULL;
	gsl_function f = {along_y, p};
	if (!rule)
		rule = gsl_integration_glfixed_table_alloc(40);
	p->x = x;
	return gsl_integration_glfixed(&f, -5.5, 5.5, rule);
}

static double projected_area(lobe_vec3 v)
{
	const double r = radius(v), start = r > 0.0 ? fmax(-(double)v.z / r, -5.5) : -5.5;
	gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(60);
	plane p = {v, 0.0};
	gsl_function f = {along_x, &p};
	const double area = start < 5.5 ? gsl_integration_glfixed(&f, start, fmax(5.5, start + 1.0), rule) : 0.0;
	gsl_integration_glfixed_table_free(rule);
	return area;
}

static void test_normalisation_and_projected_area(void)
{
	static const double cots[] = {0.0, 1e-3, 0.1, 0.5, 1.0, 2.0, 4.0, 30.0, -1e-3, -0.1, -0.5, -1.0, -2.0, -2.5};
	/* Seen from above the projected area is that of the mean plane. */
	measured("|integral of D cos - 1| in u", fabs(projected_area(lobe_vec3_make(0.0f, 0.0f, 1.0f)) - 1.0) / U, 4.0);
	double above = 0.0, below = 0.0, furnace = 0.0;
	for (size_t i = 0; i < sizeof cots / sizeof *cots; i++) {
		const lobe_vec3 v = at_cotangent(cots[i], 0.6, 1.0);
		const double area = projected_area(v), hidden = (double)lobe_beckmann_hidden(v);
		const double sigma = fmax((double)v.z, 0.0) + hidden;
		if (v.z >= 0.0f) {
			above = worse(above, fabs(sigma / area - 1.0));
			/* The weak white furnace is the integral of G1 max(0, v.m) D/v.z. */
			const double t = (double)lobe_beckmann_t(v);
			furnace = worse(furnace, fabs(2.0 * area / ((double)v.z + t) - 1.0));
		} else {
			below = worse(below, fabs(sigma / area - 1.0));
		}
	}
	measured("sigma against the integral of max(0, v.m) D: relative, in u", above / U, 10.0);
	measured("the same below the horizon, where c^2 <= 6.3", below / U, 10.0 + 7.0 * 6.3);
	measured("|weak white furnace - 1| in u", furnace / U, 10.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_density);
	RUN_TEST(test_hidden_and_t);
	RUN_TEST(test_rational_lambda);
	RUN_TEST(test_normalisation_and_projected_area);
	return UNITY_END() != 0;
}
