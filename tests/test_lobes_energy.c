/* test_lobes_energy.c - how much light a lobe returns: albedo, furnaces with exact answers, masking across it. */
#include "directions.h"
#include "energy_table.h"
#include "cases.h"
#include "quadrature.h"
#include "stretched_ggx.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

/* f |cos theta_i| of something, as seen through a map of directions. */
typedef struct {
	const lobe_bsdf *bsdf; /* NULL: the GGX core functions with F = 1 */
	lobe_stretch ggx;
	lobe_vec3 wo;
	direction_map map;
} view;

static double core_f(const view *v, lobe_vec3 wi)
{
	const lobe_vec3 h = lobe_normalize(lobe_vec3_add(v->wo, wi));
	const lobe_real g =
		lobe_smith_g2_over_cos(v->wo.z, stretched_ggx_t(v->ggx, v->wo), wi.z, stretched_ggx_t(v->ggx, wi));
	return wi.z > 0.0f ? 0.25 * (double)stretched_ggx_d(v->ggx, h) * (double)g : 0.0;
}

static double reflected_energy(void *context, double x, double y)
{
	const view *v = context;
	double wi[3];
	const double area = map_direction(&v->map, x, y, wi);
	if (!(area > 0.0))
		return 0.0;
	if (!v->bsdf)
		return area * core_f(v, rounded(wi));
	const lobe_rgb f = lobe_bsdf_eval(*v->bsdf, v->wo, rounded(wi));
	/* Of a coloured film one channel can pass what another reflects: their mean is what both events share. */
	if (v->bsdf->kind == LOBE_KIND_IRIDESCENT_DIELECTRIC)
		return area * ((double)f.r + (double)f.g + (double)f.b) / 3.0;
	return area * fmax((double)f.r, fmax((double)f.g, (double)f.b));
}

static double edge(void *context, double x, double y) { return map_edge(&((const view *)context)->map, x, y); }

static double kink(void *context, double x, double y) { return map_kink(&((const view *)context)->map, x, y); }

static double over_square(quadrature *q, int side)
{
	double sum = 0.0;
	for (int i = 0; i < side; i++)
		for (int k = 0; k < side; k++)
			sum += quadrature_box(q, (double)i / side, (i + 1.0) / side, (double)k / side,
					      (k + 1.0) / side);
	return sum;
}

static double albedo(const lobe_bsdf *bsdf, lobe_stretch ggx, lobe_vec3 wo, map_kind kind, double eta, double tolerance,
		     double *error)
{
	const double w[3] = {(double)wo.x, (double)wo.y, (double)wo.z};
	view v = {bsdf, ggx, wo, map_make(kind, w, (double)ggx.alpha_x, (double)ggx.alpha_y, eta)};
	const int kinked = kind == MAP_REFLECT && v.map.e > 0.0 && v.map.e < 1.0;
	quadrature q = {reflected_energy,
			kind == MAP_SPHERE ? NULL : edge,
			kinked ? kink : NULL,
			&v,
			tolerance,
			1e3 * tolerance,
			tolerance < 1e-6 ? 6 : 4,
			0.0};
	const double sum = over_square(&q, 10);
	if (error)
		*error += q.error;
	return sum;
}

static const double cosines[] = {1.0, 0.7, 0.3, 0.05, -0.8, -0.2};
#define COSINES (sizeof cosines / sizeof *cosines)

/* Energy is counted as importance: radiance that crosses into the denser side is squeezed, not gained. */
static void test_no_lobe_returns_more_than_it_receives(void)
{
	double brightest = 0.0;
	const char *which = "-";
	unsigned n = 0;
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		const int facets = c->alpha_x > 0.0;
		const lobe_stretch ggx = lobe_stretch_make((lobe_real)c->alpha_x, (lobe_real)c->alpha_y);
		for (size_t k = 0; k < COSINES && !(c->flags & CASE_DELTA_ONLY); k++) {
			const lobe_vec3 wo = direction_at(cosines[k], 1.0 + (double)k);
			double error = 0.0;
			if ((wo.z < 0.0f && !(c->flags & CASE_TWO_SIDED)) || (!test_long() && (i + k) % 2 == 1) ||
			    case_rounding(c, wo) > 0.01)
				continue;
			double e = albedo(&c->bsdf, ggx, wo, facets ? MAP_REFLECT : MAP_SPHERE, c->eta, 1e-6, &error);
			if ((c->flags & CASE_TRANSMITS) && !(c->flags & CASE_DELTA)) {
				const double index = wo.z > 0.0f ? c->eta : 1.0 / c->eta;
				const double scale = case_carries_radiance(c) ? index * index : 1.0;
				e += scale * albedo(&c->bsdf, ggx, wo, MAP_TRANSMIT, c->eta, 1e-6, &error);
			}
			n++;
			if (e > brightest) {
				brightest = e;
				which = c->name;
			}
			if (!(e <= 1.0 + 1e-5 + error))
				printf("  %s, cos %.2f: albedo %.6f, quadrature error %.1e\n", c->name, cosines[k], e,
				       error);
			TEST_ASSERT_TRUE(e >= 0.0 && e <= 1.0 + 1e-5 + error);
		}
	}
	printf("  %u albedos, reflected and transmitted together: at most %.6f (%s)\n", n, brightest, which);
}

/* The exact single-scattering albedo of GGX at alpha = 1 with F = 1: the integral of 1/(2 pi (mu_o + mu_i)) mu_i. */
static void test_furnace_at_alpha_1_is_exact(void)
{
	const lobe_stretch one = lobe_stretch_make(1.0f, 1.0f);
	const lobe_real n = 1e-3f, k = 1000.0f;
	const lobe_bsdf mirror = lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(1.0f, 1.0f, lobe_rgb_make(n, n, n), lobe_rgb_make(k, k, k)));
	static const double mus[] = {1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 0.03, 0.01};
	double worst_core = 0.0, worst_lobe = 0.0;
	for (size_t i = 0; i < sizeof mus / sizeof *mus; i++) {
		const double mu = (double)(float)mus[i];
		const double exact = 1.0 - mu * log((1.0 + mu) / mu);
		const lobe_vec3 wo = direction_at(mus[i], 0.3);
		worst_core = fmax(worst_core, fabs(albedo(NULL, one, wo, MAP_REFLECT, 0.0, 1e-7, NULL) - exact));
		worst_lobe = fmax(worst_lobe, fabs(albedo(&mirror, one, wo, MAP_REFLECT, 0.0, 1e-7, NULL) - exact));
	}
	/* How far from 1 the Fresnel reflectance of the mirror's index is. */
	double dimmest = 1.0;
	for (int i = 1; i <= 1000; i++)
		dimmest = fmin(dimmest, (double)lobe_fresnel_conductor((lobe_real)i * 1e-3f, n, k));
	printf("  alpha 1, F = 1: E(mu) off by %.1e (core functions), %.1e (conductor whose F is 1 - %.1e)\n",
	       worst_core, worst_lobe, 1.0 - dimmest);
	TEST_ASSERT_TRUE(worst_core < 1e-5);
	TEST_ASSERT_TRUE(worst_lobe < 1e-5 + (1.0 - dimmest));
}

/* energy_table.h */
static void test_furnace_matches_the_reference_table(void)
{
	double worst = 0.0;
	for (int i = 0; i < ENERGY_ALPHAS; i++)
		for (int k = 0; k < ENERGY_MUS; k++) {
			const lobe_stretch ggx =
				lobe_stretch_make((lobe_real)energy_alphas[i], (lobe_real)energy_alphas[i]);
			const double e =
				albedo(NULL, ggx, direction_at(energy_mus[k], 2.0), MAP_REFLECT, 0.0, 1e-7, NULL);
			if (fabs(e - energy_table[i][k]) > 6e-5)
				printf("  alpha %.2f mu %.2f: %.6f, table %.4f\n", energy_alphas[i], energy_mus[k], e,
				       energy_table[i][k]);
			worst = fmax(worst, fabs(e - energy_table[i][k]));
		}
	printf("  E(mu, alpha) against 30 entries of four digits: off by at most %.1e\n", worst);
	TEST_ASSERT_TRUE(worst < 6e-5);
}

/* ---- weak white furnace: int G1(o) max(0, o.m) D(m)/mu_o dm = 1, which ties masking to D ---- */

enum { SMITH, SCHLICK_SMITH };

typedef struct {
	lobe_stretch ggx;
	direction_map map;
	lobe_vec3 wo;
	int masking;
} weak_furnace;

/* G1/mu_o. */
static double g1_over_cos(const weak_furnace *w)
{
	const double z = (double)w->wo.z;
	const double k = 0.5 * (double)w->ggx.alpha_x;
	if (w->masking == SCHLICK_SMITH)
		return 1.0 / (z * (1.0 - k) + k);
	return 2.0 / (z + (double)stretched_ggx_t(w->ggx, w->wo));
}

static double weak_facets(void *context, double x, double y)
{
	const weak_furnace *w = context;
	double m[3];
	const double area = map_facet(&w->map, x, y, m);
	const double c = textbook_dot(w->map.o, m);
	/* D from a half vector whose components are each rounded once: no cancellation at any alpha. */
	const double inv_q = (double)lobe_ggx_density(lobe_stretch_facet(w->ggx, rounded(m))).inv;
	return c > 0.0 ? g1_over_cos(w) * c * (double)w->ggx.norm * inv_q * inv_q * area : 0.0;
}

static double visible_edge(void *context, double x, double y)
{
	double m[3];
	const weak_furnace *w = context;
	map_facet(&w->map, x, y, m);
	return textbook_dot(w->map.o, m);
}

/* The same over the sphere of reflected directions, those below the horizon included, as Heitz 2014 prints it. */
static double weak_sphere(void *context, double x, double y)
{
	const weak_furnace *w = context;
	const direction_map sphere = {MAP_SPHERE, {0.0, 0.0, 1.0}, 1.0, 0.0, 0.0, 1.0};
	double i[3], h[3];
	const double area = map_direction(&sphere, x, y, i);
	for (int k = 0; k < 3; k++)
		h[k] = w->map.o[k] + i[k];
	textbook_normalize(h);
	return area * 0.25 * g1_over_cos(w) * (double)stretched_ggx_d(w->ggx, rounded(h));
}

static double weak(quadrature_integrand f, double ax, double ay, double mu, int masking)
{
	const lobe_vec3 wo = direction_at(mu, 0.8);
	const double o[3] = {(double)wo.x, (double)wo.y, (double)wo.z};
	weak_furnace w = {lobe_stretch_make((lobe_real)ax, (lobe_real)ay), map_make(MAP_REFLECT, o, ax, ay, 1.0), wo,
			  masking};
	quadrature q = {f, f == weak_facets ? visible_edge : NULL, NULL, &w, 1e-8, 1e-5, 6, 0.0};
	return over_square(&q, 10);
}

static void test_weak_white_furnace(void)
{
	static const double alphas[][2] = {{1e-4, 1e-4}, {0.01, 0.01}, {0.1, 0.1}, {0.5, 0.5},
					   {1, 1},       {0.1, 0.7},   {1, 0.01},  {1e-4, 1}};
	static const double mus[] = {1.0, 0.7, 0.3, 0.05, 1e-3};
	double worst = 0.0, worst_sphere = 0.0;
	for (size_t a = 0; a < sizeof alphas / sizeof *alphas; a++)
		for (size_t i = 0; i < sizeof mus / sizeof *mus; i++) {
			const double off = fabs(weak(weak_facets, alphas[a][0], alphas[a][1], mus[i], SMITH) - 1.0);
			if (off > 1e-5)
				printf("  alpha %g:%g mu %g: off by %.1e\n", alphas[a][0], alphas[a][1], mus[i], off);
			worst = fmax(worst, off);
		}
	for (size_t i = 0; i < 3; i++)
		worst_sphere = fmax(worst_sphere, fabs(weak(weak_sphere, 0.5, 0.5, mus[i], SMITH) - 1.0));
	const double wrong = weak(weak_facets, 0.5, 0.5, 0.3, SCHLICK_SMITH);
	const double wrong_sphere = weak(weak_sphere, 0.5, 0.5, 0.3, SCHLICK_SMITH);
	printf("  Smith GGX: |weak furnace - 1| <= %.1e over facets, %.1e over directions; Schlick-Smith at alpha .5, "
	       "mu .3: "
	       "%.4f, %.4f\n",
	       worst, worst_sphere, wrong, wrong_sphere);
	TEST_ASSERT_TRUE(worst < 1e-5);
	TEST_ASSERT_TRUE(worst_sphere < 1e-5);
	/* The masking that does not belong to D is caught, with its known value. */
	TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.909, wrong);
	TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.909, wrong_sphere);
}

/* Masking across the surface: the exact joint value for Smith's heights is Beta(1 + Lo, 1 + Li). */
static void test_product_of_masking_is_nearer_to_beta(void)
{
	double sum[2] = {0}, worst[2] = {0};
	unsigned n = 0, nearer = 0;
	for (int a = 1; a <= 20; a++)
		for (int i = 1; i <= 40; i++)
			for (int k = 1; k <= 40; k++) {
				const double zo = i / 40.0, zi = k / 40.0;
				const double o[3] = {sqrt((1.0 - zo) * (1.0 + zo)), 0.0, zo};
				const double w[3] = {sqrt((1.0 - zi) * (1.0 + zi)), 0.0, -zi};
				const double lo = textbook_ggx_lambda(a / 20.0, a / 20.0, o);
				const double li = textbook_ggx_lambda(a / 20.0, a / 20.0, w);
				const double beta = gsl_sf_beta(1.0 + lo, 1.0 + li);
				const double product = 1.0 / ((1.0 + lo) * (1.0 + li));
				const double one_side = 1.0 / (1.0 + lo + li);
				const double off[2] = {product - beta, one_side - beta};
				TEST_ASSERT_TRUE(off[0] >= -1e-12);
				nearer += fabs(off[0]) <= fabs(off[1]) + 1e-12;
				n++;
				for (int m = 0; m < 2; m++) {
					sum[m] += fabs(off[m]);
					worst[m] = fmax(worst[m], fabs(off[m]));
				}
			}
	printf("  distance from Beta(1+Lo,1+Li), alpha .05..1, cos .025..1: G1 G1 mean %.4f max %.4f; 1/(1+Lo+Li) mean "
	       "%.4f "
	       "max %.4f; the product is nearer in %u of %u\n",
	       sum[0] / n, worst[0], sum[1] / n, worst[1], nearer, n);
	TEST_ASSERT_EQUAL_UINT(n, nearer);
	TEST_ASSERT_TRUE(worst[0] < worst[1]);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_no_lobe_returns_more_than_it_receives);
	RUN_TEST(test_furnace_at_alpha_1_is_exact);
	RUN_TEST(test_furnace_matches_the_reference_table);
	RUN_TEST(test_weak_white_furnace);
	RUN_TEST(test_product_of_masking_is_nearer_to_beta);
	return UNITY_END() != 0;
}
