/* The integral over diffuse facets (Heitz 2014, eq. 31) against adaptive quadrature in double of the textbook's D,
 * Lambda and dot products: that of eval's fixed facets, and that of the unbiased one. */
#include "directions.h"
#include "lobe/shading.h"
#include "measured.h"
#include "quadrature.h"
#include "support.h"
#include "textbook.h"
#include "unity.h"

#include <math.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_EQUAL_STRING("", measured_outside()); }

typedef struct {
	double ax, ay, o[3], i[3];
	direction_map map;
} integral;

/* D (o.m)(i.m) G2/(pi z_o) at the facet (x, y), height-correlated. */
static double integrand(void *context, double x, double y)
{
	const integral *q = context;
	double m[3];
	const double area = map_facet(&q->map, x, y, m);
	const double g2 =
		1.0 / (1.0 + textbook_ggx_lambda(q->ax, q->ay, q->o) + textbook_ggx_lambda(q->ax, q->ay, q->i));
	const double seen = fmax(textbook_dot(q->o, m), 0.0) * fmax(textbook_dot(q->i, m), 0.0);
	return textbook_ggx_d(q->ax, q->ay, m) * seen * g2 / (PI * q->o[2]) * area;
}

/* Where a direction sees the facets edge on. */
static double edge_on(void *context, double x, double y)
{
	const integral *q = context;
	double m[3];
	(void)map_facet(&q->map, x, y, m);
	return textbook_dot(q->o, m) * textbook_dot(q->i, m);
}

static double reference(double ax, double ay, const double o[3], const double i[3], double *error)
{
	integral c = {ax, ay, {o[0], o[1], o[2]}, {i[0], i[1], i[2]}, map_make(MAP_REFLECT, o, ax, ay, 0.0)};
	quadrature q = {integrand, NULL, edge_on, &c, 1e-7, 1e-5, 7, 0.0};
	const double value = quadrature_box(&q, 0.0, 1.0, 0.0, 1.0);
	*error = q.error;
	return value;
}

static lobe_microfacet_diffuse clay(double ax, double ay)
{
	const lobe_microsurface s = lobe_microsurface_make(
		lobe_distribution_make(LOBE_NDF_GGX), lobe_linear_make((float)ax, 0.0f, 0.0f, (float)ay, 0.0f, 0.0f));
	return lobe_microfacet_diffuse_make(s, lobe_rgb_make(1.0f, 0.5f, 0.25f));
}

static const double widths[][2] = {{0.1, 0.1}, {0.4, 0.4}, {1.0, 1.0}, {0.1, 0.7}};
static const double angles[] = {0.0, 0.6, 1.2, 1.5};
enum { WIDTHS = 4, ANGLES = 4, AZIMUTHS = 3 };

static void direction(double theta, double phi, double w[3])
{
	w[0] = (double)(float)(sin(theta) * cos(phi));
	w[1] = (double)(float)(sin(theta) * sin(phi));
	w[2] = (double)(float)cos(theta);
}

/* How far off a function of (wo, wi) is over all pairs, in units of what a smooth diffuse surface would be. */
typedef double (*estimate)(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi);

static double largest_error(estimate f, double *quadrature_error)
{
	double worst = 0.0;
	*quadrature_error = 0.0;
	for (int w = 0; w < WIDTHS; w++) {
		for (int a = 0; a < ANGLES * ANGLES * AZIMUTHS; a++) {
			double o[3], i[3], error;
			direction(angles[a % ANGLES], 0.3, o);
			direction(angles[a / ANGLES % ANGLES], 0.3 + PI * 0.5 * (a / (ANGLES * ANGLES)), i);
			const double exact = reference(widths[w][0], widths[w][1], o, i, &error);
			const double got = f(clay(widths[w][0], widths[w][1]), rounded(o), rounded(i));
			worst = larger(worst, fabs(got - exact) * PI / i[2]);
			*quadrature_error = larger(*quadrature_error, error * PI / i[2]);
		}
	}
	return worst;
}

static double by_eval(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi)
{
	return (double)lobe_microfacet_diffuse_eval(p, wo, wi).r;
}

/* The mean of the unbiased one over a lattice of 28657 points. */
static double by_one(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi)
{
	enum { POINTS = 28657, STEP = 17711 };
	double sum = 0.0;
	for (unsigned k = 0; k < POINTS; k++) {
		const lobe_vec2 u = lobe_vec2_make(((float)k + 0.5f) / POINTS,
						   ((float)((unsigned long)k * STEP % POINTS) + 0.5f) / POINTS);
		sum += (double)lobe_microfacet_diffuse_eval_one(p, wo, wi, u).r;
	}
	return sum / POINTS;
}

/* Forgets that a facet which grazes the light receives less of it. */
static double planted(lobe_microfacet_diffuse p, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_seen o = lobe_see(p.surface, wo, 1.0f), i = lobe_see(p.surface, wi, 1.0f);
	const lobe_seen_facet up = {wo.z, wi.z, 1.0f, 1.0f};
	return (double)(LOBE_INV_PI * wi.z * (o.sigma * lobe_masking_g2_over_cos(p.surface, o, i, up, 0)));
}

static void test_one_facet_is_unbiased(void)
{
	double quadrature_error;
	const double worst = largest_error(by_one, &quadrature_error);
	measured("error estimate of the quadrature, of Lambert's", quadrature_error, 1e-4);
	measured("mean of eval_one over 28657 facets, of Lambert's", worst, 2e-3);
}

static void test_eval_of_fixed_facets(void)
{
	double quadrature_error;
	measured("eval, of Lambert's", largest_error(by_eval, &quadrature_error), 0.025);
}

static void test_a_planted_error_is_seen(void)
{
	double quadrature_error;
	TEST_ASSERT_TRUE(largest_error(planted, &quadrature_error) > 0.1);
}

/* As the facets flatten out the surface turns into Lambert's. */
static void test_flat_is_lambert(void)
{
	double worst = 0.0;
	for (int a = 0; a < ANGLES * ANGLES; a++) {
		double o[3], i[3];
		direction(angles[a % ANGLES], 0.3, o);
		direction(angles[a / ANGLES], 2.0, i);
		const lobe_rgb f = lobe_microfacet_diffuse_eval(clay(1e-4, 1e-4), rounded(o), rounded(i));
		worst = larger(worst, fabs((double)f.g * PI / (0.5 * i[2]) - 1.0));
	}
	measured("alpha 1e-4 against Lambert, relative", worst, 2e-3);
}

/* Rough diffuse facets reflect light back: brighter towards the light than away from it (Oren and Nayar 1994). */
static void test_reflects_back(void)
{
	double o[3], back[3], forth[3];
	direction(1.2, 0.0, o);
	direction(1.2, 0.0, back);
	direction(1.2, PI, forth);
	TEST_ASSERT_TRUE(by_eval(clay(0.7, 0.7), rounded(o), rounded(back)) >
			 2.0 * by_eval(clay(0.7, 0.7), rounded(o), rounded(forth)));
}

/* Where both directions graze a smooth surface, against the mean of eval_one: more than elsewhere, as the header says, of
 * a value that is many times the smooth surface's. */
static void test_eval_at_grazing(void)
{
	static const double wide[][2] = {{0.0948206112, 0.0826851651}, {0.05, 0.05}, {0.1, 0.2}, {0.02, 0.02}};
	static const double cosines[] = {0.0144561501, 0.0266015548, 0.06};
	double worst = 0.0, relative = 0.0;
	for (int w = 0; w < 4; w++)
		for (int a = 0; a < 9; a++)
			for (int turn = 0; turn < 3; turn++) {
				double o[3], i[3];
				direction(acos(cosines[a % 3]), 2.96, o);
				direction(acos(cosines[a / 3]), 2.96 + 0.274 + 1.3 * turn, i);
				const lobe_microfacet_diffuse p = clay(wide[w][0], wide[w][1]);
				const double exact = by_one(p, rounded(o), rounded(i));
				const double off = fabs(by_eval(p, rounded(o), rounded(i)) - exact);
				worst = larger(worst, off * PI / i[2]);
				relative = larger(relative, off / exact);
			}
	measured("eval at grazing, of Lambert's", worst, 0.3);
	measured("eval at grazing, relative", relative, 0.12);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_one_facet_is_unbiased);
	RUN_TEST(test_eval_of_fixed_facets);
	RUN_TEST(test_a_planted_error_is_seen);
	RUN_TEST(test_flat_is_lambert);
	RUN_TEST(test_eval_at_grazing);
	RUN_TEST(test_reflects_back);
	return UNITY_END();
}
