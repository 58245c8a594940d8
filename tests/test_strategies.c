/* test_strategies.c - every sampling strategy: its density integrates to 1 less what it rejects, samples follow it, the
 * mean of weights is the albedo whichever strategy made them, and variances are those that are known. */
#include "chi_square.h"
#include "directions.h"
#include "measured.h"
#include "microsurface_cases.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <stdio.h>
#include <stdlib.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static const char *const names[] = {"visible",   "uniform", "cosine",  "ndf",      "slopes",
				    "ellipsoid", "cap",     "bounded", "v-cavity", "hemisphere"};
enum { STRATEGIES = LOBE_STRATEGY_LAST + 1 };

static lobe_microfacet_conductor mirror(lobe_microsurface s, lobe_uint strategy)
{
	const lobe_rgb white = lobe_rgb_make(1.0f, 1.0f, 1.0f);
	return lobe_microfacet_conductor_make(s, lobe_fresnel_model_constant(white), strategy);
}

/* --- samples against the density ---------------------------------------------------------------------------------- */

/* Bins are those of the facet between wo and wi, in coordinates in which its distribution is flat. wrong: the density
 * that samples are compared with is that of another lobe. */
enum { SIDE = 12, BINS = SIDE * SIDE + 1, REJECTED = SIDE * SIDE };

typedef struct {
	lobe_microfacet_conductor p, compared;
	lobe_vec3 wo;
	double o[3];
} view;

static lobe_vec3 reflected(const view *v, const double m[3])
{
	const double c = 2.0 * textbook_dot(v->o, m);
	return lobe_vec3_make((float)(c * m[0] - v->o[0]), (float)(c * m[1] - v->o[1]), (float)(c * m[2] - v->o[2]));
}

static double pdf_at(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	const double area = surface_facet(&v->p.surface, x, y, m);
	const double c = textbook_dot(v->o, m);
	return c > 0.0 ? 4.0 * c * area * (double)lobe_microfacet_conductor_pdf(v->compared, v->wo, reflected(v, m))
		       : 0.0;
}

static double pdf_edge(void *context, double x, double y)
{
	const view *v = context;
	double m[3];
	surface_facet(&v->p.surface, x, y, m);
	const double c = textbook_dot(v->o, m);
	return fmin(c, 2.0 * c * m[2] - v->o[2]);
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
	quadrature q = {pdf_at, pdf_edge, NULL, (void *)v, depth > 4 ? 1e-8 : 1e-6, 1e-3, depth, 0.0};
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

static view make_view(lobe_microsurface s, lobe_uint strategy, double z, double phi)
{
	view v;
	v.p = v.compared = mirror(s, strategy);
	v.wo = direction_at(z, phi);
	v.o[0] = (double)v.wo.x;
	v.o[1] = (double)v.wo.y;
	v.o[2] = (double)v.wo.z;
	textbook_normalize(v.o);
	return v;
}

static lobe_microsurface surface(int k)
{
	static const shape_case beside_ggx[] = {{"Beckmann", LOBE_NDF_BECKMANN, 0, 1},
						{"GTR 1.5 .3", LOBE_NDF_GTR, 1.5, 0.3}};
	const lobe_linear maps[] = {
		stretch(0.05, 0.05),
		stretch(0.5, 0.5),
		stretch(1, 1),
		stretch(0.1, 0.6),
		lobe_linear_make(0.4f, 0.2f, -0.1f, 0.3f, 0.0f, 0.0f),
		lobe_linear_make(0.4f, 0.1f, 0.05f, 0.3f, 0.5f, -0.3f),
		stretch(0.4, 0.3),
		lobe_linear_make(0.8f, 0.3f, 0.1f, 0.7f, 0.1f, 0.2f),
	};
	const lobe_distribution d = k < 6 ? lobe_distribution_make(LOBE_NDF_GGX) : shape_make(&beside_ggx[k - 6]);
	return lobe_microsurface_make(d, maps[k]);
}
enum { SURFACES = 8 };

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
					       k, names[strategy], views[w][0], f.p, f.integral, f.rejected, f.error);
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
	const double k_right = (double)lobe_ggx_bounded_k(v.p.surface.narrow, v.wo);
	const double k_wrong = (double)lobe_ggx_bounded_k(v.p.surface.narrow, stretched);
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
	quadrature q = {wrong_pdf_at, pdf_edge, NULL, &v, 1e-6, 1e-3, 4, 0.0};
	v.compared = v.p;
	const double jacobian = integrate_square(&q, SIDE);
	const fit f = test_fit(&v, 79u, 200000u);
	printf("  a Jacobian without its o.m: integral %.4f for %.4f\n", jacobian, f.integral);
	TEST_ASSERT_TRUE(fabs(jacobian - f.integral) > 0.02);
}

/* --- weights: one mean, many variances ---------------------------------------------------------------------------- */

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
	quadrature q = {eval_at, pdf_edge, NULL, (void *)v, 1e-6, 1e-3, 5, 0.0};
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
					       k, s.masking, names[strategy], views[w][0], r.mean, r.error, exact,
					       error);
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
	quadrature q = {square_at, pdf_edge, NULL, (void *)v, 1e-6, 1e-3, 5, 0.0};
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
		       names[known[i].strategy], known[i].alpha, known[i].mu, variance, r.variance, known[i].variance,
		       r.rejected);
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
					       names[strategy], views[w][0], mean[strategy], error[strategy], mean[0]);
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
	RUN_TEST(test_samples_follow_the_density);
	RUN_TEST(test_planted_errors_are_caught);
	RUN_TEST(test_every_strategy_has_the_same_mean);
	RUN_TEST(test_known_variances);
	RUN_TEST(test_dielectric_means_agree);
	RUN_TEST(test_delta_refraction);
	return UNITY_END() != 0;
}
