/* test_strategies_weights.c - what samples of every strategy weigh: the mean is the albedo whichever strategy made
 * them, of metal and of glass, and variances are those that are known. */
#include "directions.h"
#include "measured.h"
#include "strategy_views.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- reflection: one mean, many variances ------------------------------------------------------------------------- */

typedef struct {
	double mean, variance, rejected, error; /* error: of the mean, one standard deviation */
} weights;

static weights sample_weights(lobe_microfacet_conductor p, lobe_vec3 wo, uint32_t stream, uint32_t n)
{
	double sum = 0.0, sum2 = 0.0, none = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_sample s = lobe_microfacet_conductor_sample(p, wo, lobe_vec3_make(u[0], u[1], u[2]));
		const double w = (double)s.weight.g;
		sum += w;
		sum2 += w * w;
		none += s.event == 0u;
	}
	weights r;
	r.mean = sum / n;
	r.variance = sum2 / n - r.mean * r.mean;
	r.rejected = none / n;
	r.error = sqrt(r.variance / n);
	return r;
}

static double eval_at(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	const double area = surface_facet(&v->p.surface, x, y, m);
	const double c = textbook_dot(v->o, m);
	return c > 0.0 ? 4.0 * c * area * (double)lobe_microfacet_conductor_eval(v->p, v->wo, reflected(v, m)).g : 0.0;
}

static double albedo(const view *v, double *error)
{
	quadrature q = {eval_at, view_edge, NULL, (void *)v, 1e-6, 1e-3, 5, 0.0};
	const double sum = integrate_square(&q, SIDE);
	*error = q.error;
	return sum;
}

/* Every strategy, with several maskings: also of surfaces that are not their own, and from behind the mean plane. */
static void test_every_strategy_has_the_same_mean(void)
{
	static const lobe_uint maskings[] = {LOBE_MASKING_SMITH, LOBE_MASKING_VCAVITY, LOBE_MASKING_SCHLICK_GGX,
					     LOBE_MASKING_SMITH};
	static const double views[][2] = {{0.8, 0.3}, {0.3, 2.0}, {0.2, 5.8}};
	const uint32_t samples = test_long() ? 400000u : 50000u;
	double worst = 0.0;
	unsigned n = 0, bad = 0;
	for (int k = 0; k < SURFACES; k++)
		for (int w = 0; w < 3; w++) {
			lobe_microsurface s = surface(k);
			s.masking = maskings[(k + w) % 4];
			double error;
			view v = make_view(s, LOBE_STRATEGY_VISIBLE, views[w][0], views[w][1]);
			const double exact = albedo(&v, &error);
			for (lobe_uint strategy = 0; strategy < STRATEGIES; strategy++) {
				/* Hardly a uniform direction hits a narrow lobe; of V-cavities nothing is seen from
				 * behind. */
				const int blind =
					strategy == LOBE_STRATEGY_VCAVITY && !(lobe_see(s, v.wo, 1.0f).z > 0.0f);
				if (blind || (k == 0 && lobe_strategy_of_directions(strategy)))
					continue;
				const weights r = sample_weights(mirror(s, strategy), v.wo, 500u + n, samples);
				/* The estimate of the error has an error itself where few samples carry most. */
				const double off = (fabs(r.mean - exact) - error) / (r.error + 1e-5);
				n++;
				worst = larger(worst, off);
				if (off > 5.0 && bad++ < 10)
					printf("  surface %d, masking %u, %s, cos %.1f: %.5f +- %.5f, quadrature %.5f "
					       "+- "
					       "%.0e\n",
					       k, s.masking, strategy_names[strategy], views[w][0], r.mean, r.error,
					       exact, error);
			}
		}
	printf("  %u estimates of %u samples\n", n, samples);
	measured("mean weight against quadrature, standard deviations", worst, 5.0);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* The variance of weights by quadrature, as the plain NDF's are carried by too few samples to count them. */
static double square_at(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	const double area = surface_facet(&v->p.surface, x, y, m);
	const double c = textbook_dot(v->o, m);
	if (!(c > 0.0))
		return 0.0;
	const lobe_vec3 wi = reflected(v, m);
	const double f = (double)lobe_microfacet_conductor_eval(v->p, v->wo, wi).g;
	const double pdf = (double)lobe_microfacet_conductor_pdf(v->p, v->wo, wi);
	return pdf > 0.0 ? 4.0 * c * area * f * f / pdf : 0.0;
}

static double exact_variance(const view *v)
{
	double error;
	quadrature q = {square_at, view_edge, NULL, (void *)v, 1e-6, 1e-3, 5, 0.0};
	const double mean = albedo(v, &error);
	return integrate_square(&q, SIDE) - mean * mean;
}

/* F = 1: rejected share and variance of the weight, by quadrature and (plain NDF) plain sums made apart from this
 * library. */
static void test_known_variances(void)
{
	static const struct {
		lobe_uint strategy;
		double alpha, mu, rejected, variance;
	} known[] = {
		{LOBE_STRATEGY_VISIBLE_CAP, 0.25, 0.5, 0.070, 0.0737},
		{LOBE_STRATEGY_BOUNDED_CAP, 0.25, 0.5, 0.039, 0.0478},
		{LOBE_STRATEGY_VISIBLE_CAP, 0.5, 0.5, 0.161, 0.131},
		{LOBE_STRATEGY_BOUNDED_CAP, 0.5, 0.5, 0.053, 0.0612},
		{LOBE_STRATEGY_VISIBLE_CAP, 0.5, 1.0, 0.198, 0.151},
		{LOBE_STRATEGY_BOUNDED_CAP, 0.5, 1.0, 0.0, 0.0259},
		{LOBE_STRATEGY_VISIBLE_SLOPES, 1.0, 0.1, 0.090, 0.0945},
		{LOBE_STRATEGY_BOUNDED_CAP, 1.0, 0.1, 0.0, 0.0334},
		{LOBE_STRATEGY_VISIBLE_ELLIPSOID, 1.0, 1.0, 0.5, 0.133},
		{LOBE_STRATEGY_BOUNDED_CAP, 1.0, 1.0, 0.0, 0.0195},
		{LOBE_STRATEGY_NDF, 0.25, 0.1, -1, 2.572},
		{LOBE_STRATEGY_VISIBLE, 0.25, 0.1, -1, 0.045},
		{LOBE_STRATEGY_NDF, 0.1, 0.1, -1, 1.595},
		{LOBE_STRATEGY_VISIBLE, 0.1, 0.1, -1, 0.049},
		{LOBE_STRATEGY_NDF, 0.5, 0.5, -1, 0.4814},
		{LOBE_STRATEGY_HEMISPHERE, 1.0, 0.9, -1, 0.156},
	};
	double worst = 0.0, worst_rejected = 0.0;
	for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
		const lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
								   stretch(known[i].alpha, known[i].alpha));
		const weights r = sample_weights(mirror(s, known[i].strategy), direction_at(known[i].mu, 0.4),
						 700u + (uint32_t)i, test_long() ? 4000000u : 200000u);
		const view v = make_view(s, known[i].strategy, known[i].mu, 0.4);
		const double variance = exact_variance(&v);
		printf("  %-10s alpha %.2f mu %.1f: variance %.4f (of samples %.4f), known %.4g; rejected %.4f\n",
		       strategy_names[known[i].strategy], known[i].alpha, known[i].mu, variance, r.variance,
		       known[i].variance, r.rejected);
		worst = larger(worst, fabs(variance / known[i].variance - 1.0));
		if (known[i].rejected >= 0.0)
			worst_rejected = larger(worst_rejected, fabs(r.rejected - known[i].rejected));
	}
	measured("variances against known ones of 2 to 3 digits, relative", worst, 0.012);
	measured("rejected against known ones of three decimals", worst_rejected, 2e-3);
}

/* --- refraction --------------------------------------------------------------------------------------------------- */

/* The mean weight of glass, reflected and refracted together, is one for all strategies, from both sides. */
static void test_dielectric_means_agree(void)
{
	static const double views[][2] = {{0.7, 0.3}, {-0.6, 2.0}};
	const uint32_t samples = test_long() ? 400000u : 60000u;
	double worst = 0.0;
	for (int k = 1; k < SURFACES; k += 2)
		for (int w = 0; w < 2; w++) {
			const lobe_microsurface s =
				lobe_microsurface_joint(surface(k), LOBE_JOINT_HEIGHT, LOBE_ACROSS_BETA);
			double mean[STRATEGIES], error[STRATEGIES];
			for (lobe_uint strategy = 0; strategy < STRATEGIES; strategy++) {
				const lobe_microfacet_dielectric p = lobe_microfacet_dielectric_make(
					s, lobe_fresnel_model_dielectric(), 1.5f, strategy);
				double sum = 0.0, sum2 = 0.0;
				for (uint32_t i = 0; i < samples; i++) {
					float u[3];
					test_u3(900u + strategy + 16u * (uint32_t)k, i, u);
					const double x = (double)lobe_microfacet_dielectric_sample(
								 p, direction_at(views[w][0], views[w][1]),
								 lobe_vec3_make(u[0], u[1], u[2]))
								 .weight.g;
					sum += x;
					sum2 += x * x;
				}
				mean[strategy] = sum / samples;
				error[strategy] = sqrt((sum2 / samples - mean[strategy] * mean[strategy]) / samples);
				const double both = hypot(error[strategy], error[0]) + 1e-5;
				const double off = fabs(mean[strategy] - mean[0]) / both;
				worst = larger(worst, off);
				if (off > 5.0)
					printf("  surface %d, %s, cos %.1f: %.5f +- %.5f, visible %.5f\n", k,
					       strategy_names[strategy], views[w][0], mean[strategy], error[strategy],
					       mean[0]);
			}
		}
	measured("glass: means of ten strategies, standard deviations apart", worst, 5.0);
}

/* Straight through an interface of index 1: whatever the strategy, weights of 1 on average. */
static void test_delta_refraction(void)
{
	double worst = 0.0;
	for (lobe_uint strategy = 0; strategy < STRATEGIES; strategy++) {
		const lobe_microfacet_dielectric p =
			lobe_microfacet_dielectric_make(surface(4), lobe_fresnel_model_dielectric(), 1.0f, strategy);
		double sum = 0.0, sum2 = 0.0;
		const uint32_t n = 50000u;
		for (uint32_t i = 0; i < n; i++) {
			float u[3];
			test_u3(950u + strategy, i, u);
			const lobe_vec3 wo = direction_at(0.4, 1.0);
			const lobe_sample s =
				lobe_microfacet_dielectric_sample(p, wo, lobe_vec3_make(u[0], u[1], u[2]));
			TEST_ASSERT_TRUE(s.event == 0u || (s.event & LOBE_EVENT_DELTA));
			TEST_ASSERT_TRUE(s.event == 0u || (s.wi.x == -wo.x && s.wi.y == -wo.y && s.wi.z == -wo.z));
			sum += (double)s.weight.g;
			sum2 += (double)s.weight.g * (double)s.weight.g;
		}
		const double error = sqrt(fmax(sum2 / n - sum / n * sum / n, 0.0) / n) + 1e-4;
		worst = larger(worst, fabs(sum / n - 1.0) / error);
	}
	measured("index 1: mean weight of ten strategies off 1, standard dev.", worst, 5.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_every_strategy_has_the_same_mean);
	RUN_TEST(test_known_variances);
	RUN_TEST(test_dielectric_means_agree);
	RUN_TEST(test_delta_refraction);
	return UNITY_END() != 0;
}
