/* test_strategies.c - every sampling strategy: its density integrates to 1 less what it rejects, and samples follow it.
 * (What samples weigh: test_strategies_weights.c.) */
#include "chi_square.h"
#include "measured.h"
#include "strategy_views.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* Bins are those of the facet between wo and wi, in coordinates in which its distribution is flat. */
enum { BINS = SIDE * SIDE + 1, REJECTED = SIDE * SIDE };

static double pdf_at(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	const double area = surface_facet(&v->p.surface, x, y, m);
	const double c = textbook_dot(v->o, m);
	return c > 0.0 ? 4.0 * c * area * (double)lobe_microfacet_conductor_pdf(v->compared, v->wo, reflected(v, m))
		       : 0.0;
}

static int bin_of(const view *v, lobe_vec3 wi)
{
	const double h[3] = {v->o[0] + (double)wi.x, v->o[1] + (double)wi.y, v->o[2] + (double)wi.z};
	const lobe_linear *map = &v->p.surface.map;
	const double like = (double)v->p.surface.like;
	const double sx = h[0] / h[2] + (double)map->mean_x, sy = h[1] / h[2] + (double)map->mean_y;
	const double u = ((double)map->ixx * sx + (double)map->ixy * sy) / like,
		     w = ((double)map->iyx * sx + (double)map->iyy * sy) / like;
	const double x = pow(1.0 / (1.0 + u * u + w * w), 1.0 / 6.0);
	double y = atan2(w, u) / TWO_PI;
	y = y < 0.0 ? y + 1.0 : y;
	const int i = (int)(x * SIDE), k = (int)(y * SIDE);
	return (i < SIDE ? i : SIDE - 1) * SIDE + (k < SIDE ? k : SIDE - 1);
}

typedef struct {
	double p, integral, rejected, error;
} fit;

/* depth: of the quadrature, which is as exact as it is deep. */
static fit test_fit_to(const view *v, uint32_t stream, uint32_t samples, int depth)
{
	double expected[BINS];
	uint32_t observed[BINS] = {0};
	quadrature q = {pdf_at, view_edge, NULL, (void *)v, depth > 4 ? 1e-8 : 1e-6, 1e-3, depth, 0.0};
	fit f = {0, 0, 0, 0};
	for (int i = 0; i < SIDE; i++)
		for (int k = 0; k < SIDE; k++)
			f.integral += expected[i * SIDE + k] = quadrature_box(&q, (double)i / SIDE, (i + 1.0) / SIDE,
									      (double)k / SIDE, (k + 1.0) / SIDE);
	expected[REJECTED] = 1.0 - f.integral;
	for (uint32_t i = 0; i < samples; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_sample s = lobe_microfacet_conductor_sample(v->p, v->wo, lobe_vec3_make(u[0], u[1], u[2]));
		observed[s.event ? bin_of(v, s.wi) : REJECTED]++;
	}
	f.p = chi_square_with_rest(expected, observed, BINS, REJECTED, q.error * samples).p;
	f.rejected = observed[REJECTED] / (double)samples;
	f.error = q.error;
	return f;
}

static fit test_fit(const view *v, uint32_t stream, uint32_t samples) { return test_fit_to(v, stream, samples, 4); }

static void test_samples_follow_the_density(void)
{
	/* The last is behind the mean plane of the tilted surfaces. */
	static const double views[][2] = {{0.95, 0.3}, {0.5, 2.0}, {0.12, 4.0}, {0.2, 5.8}};
	const uint32_t samples = test_long() ? 1000000u : 200000u;
	const int count = SURFACES * 4 * STRATEGIES;
	double least = 1.0, worst = 0.0;
	unsigned tests = 0, bad = 0;
	const double level = -expm1(log1p(-0.01) / count);
	for (int k = 0; k < SURFACES; k++)
		for (int w = 0; w < 4; w++)
			for (lobe_uint strategy = 0; strategy < STRATEGIES; strategy++) {
				if (!test_long() && (w + k + (int)strategy) % 2 == 1)
					continue;
				view v = make_view(surface(k), strategy, views[w][0], views[w][1]);
				if (strategy == LOBE_STRATEGY_VCAVITY && !(lobe_see(v.p.surface, v.wo, 1.0f).z > 0.0f))
					continue;
				const fit f = test_fit(&v, 100u + tests, samples);
				const double sigma = sqrt(f.rejected * (1.0 - f.rejected) / samples);
				const double off =
					(fabs(f.integral + f.rejected - 1.0) - f.error) / (sigma + 2.0 / samples);
				tests++;
				least = fmin(least, f.p);
				worst = larger(worst, off);
				if (f.p < level || off > 5.0) {
					bad++;
					printf("  surface %d, %s, cos %.2f: p %.1e, integral %.5f, rejected %.5f, "
					       "quadrature "
					       "%.0e\n",
					       k, strategy_names[strategy], views[w][0], f.p, f.integral, f.rejected,
					       f.error);
				}
			}
	printf("  %u chi-square tests of %u samples: least p %.1e, level %.1e\n", tests, samples, least, level);
	measured("integral + rejected - 1, standard deviations", worst, 5.0);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* The same machinery notices a Jacobian that is wrong by o.m, and the bounded cap with k of the stretched direction. */
static double wrong_pdf_at(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	surface_facet(&v->p.surface, x, y, m);
	return pdf_at(context, x, y) * textbook_dot(v->o, m);
}

static void test_planted_errors_are_caught(void)
{
	view v = make_view(lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), stretch(0.75, 0.75)),
			   LOBE_STRATEGY_BOUNDED_CAP, 0.5, 0.9);
	const fit right = test_fit_to(&v, 77u, 1000000u, 7);
	/* k of the stretched direction, normalised: another height of the cap, so another density; by changing what the
	 * bound is told of the surface. */
	const lobe_vec3 o = lobe_linear_direction(v.p.surface.map, v.wo);
	const double t = sqrt((double)(o.x * o.x + o.y * o.y + o.z * o.z));
	const lobe_vec3 stretched =
		lobe_vec3_make((float)((double)o.x / t), (float)((double)o.y / t), (float)((double)o.z / t));
	const lobe_facet_bound b_right = lobe_ggx_bound(v.p.surface.narrow * v.p.surface.narrow, v.wo);
	const lobe_facet_bound b_wrong = lobe_ggx_bound(v.p.surface.narrow * v.p.surface.narrow, stretched);
	const double k_right = (double)b_right.part / (double)b_right.whole;
	const double k_wrong = (double)b_wrong.part / (double)b_wrong.whole;
	const double two_sigma = k_right * (double)v.wo.z + t, two_sigma_wrong = k_wrong * (double)v.wo.z + t;
	printf("  bounded cap: integral %.5f + rejected %.5f; with k %.5f of the stretched direction for %.5f the "
	       "integral is "
	       "%.5f\n",
	       right.integral, right.rejected, k_wrong, k_right, right.integral * two_sigma / two_sigma_wrong);
	TEST_ASSERT_TRUE(right.p > 1e-4);
	const double off = fabs(right.integral * two_sigma / two_sigma_wrong + right.rejected - 1.0);
	TEST_ASSERT_TRUE(off > 5.0 * (sqrt(right.rejected / 1e6) + 2e-6 + right.error));
	/* Samples of one strategy against the density of another. */
	v = make_view(surface(1), LOBE_STRATEGY_VISIBLE_CAP, 0.5, 0.9);
	v.compared.strategy = LOBE_STRATEGY_NDF;
	TEST_ASSERT_TRUE(test_fit(&v, 78u, 200000u).p < 1e-9);
	v.compared = v.p;
	v.compared.surface.map = stretch(0.515, 0.5);
	TEST_ASSERT_TRUE(test_fit(&v, 78u, 200000u).p < 1e-9);
	quadrature q = {wrong_pdf_at, view_edge, NULL, &v, 1e-6, 1e-3, 4, 0.0};
	v.compared = v.p;
	const double jacobian = integrate_square(&q, SIDE);
	const fit f = test_fit(&v, 79u, 200000u);
	printf("  a Jacobian without its o.m: integral %.4f for %.4f\n", jacobian, f.integral);
	TEST_ASSERT_TRUE(fabs(jacobian - f.integral) > 0.02);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_samples_follow_the_density);
	RUN_TEST(test_planted_errors_are_caught);
	return UNITY_END() != 0;
}
