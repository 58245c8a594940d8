/* test_recommend.c - lobe/recommend.h: what is recommended is about as efficient as the best of all techniques by
 * variances measured from their own samples; and its expected deviation is theirs. How it does over the whole map of
 * roughness, angle and light: `make report`, section strategies. (The light's shape: test_light_shape.c.) */
#include "directions.h"
#include "measured.h"
#include "support.h"

#include "lobe/lobe.h"
#include "lobe/recommend.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- variances of the techniques' own samples --------------------------------------------------------------------- */

typedef struct {
	const char *what;
	lobe_uint ndf;
	double ax, ay, z;
	lobe_light_shape light;
	int from, strategy; /* expected; negative: any that is good */
} question;

/* A light aside, and one in the mirror image of the viewer at z (phi 0). */
static lobe_vec3 aside(void) { return direction_at(0.64, 1.3); }
static lobe_vec3 mirrored(double z) { return direction_at(z, PI); }

enum { QUESTIONS = 9 };

static question question_at(int i)
{
	lobe_light_shape sun = lobe_light_shape_disk(aside(), 1e-3f, 0.8f);
	sun.slope = -2.0f / 3.0f;
	const question all[QUESTIONS] = {
		{"rough under a dome", LOBE_NDF_GGX, 0.5, 0.5, 0.7, lobe_light_shape_sky(0.0f), LOBE_SAMPLE_LOBE,
		 LOBE_STRATEGY_BOUNDED_CAP},
		{"less rough under a dome", LOBE_NDF_GGX, 0.2, 0.2, 0.7, lobe_light_shape_sky(0.0f), LOBE_SAMPLE_LOBE,
		 -1},
		{"brushed under a dome", LOBE_NDF_GGX, 0.4, 0.1, 0.3, lobe_light_shape_sky(0.0f), LOBE_SAMPLE_LOBE, -1},
		{"disk aside", LOBE_NDF_GGX, 0.3, 0.3, 0.7, lobe_light_shape_disk(aside(), 0.024f, 1.0f),
		 LOBE_SAMPLE_LIGHT, -1},
		{"disk in the highlight, smooth", LOBE_NDF_GGX, 0.02, 0.02, 0.7,
		 lobe_light_shape_disk(mirrored(0.7), 0.1f, 1.0f), LOBE_SAMPLE_LOBE, -1},
		{"disk in the highlight, rough", LOBE_NDF_GGX, 0.5, 0.5, 0.7,
		 lobe_light_shape_disk(mirrored(0.7), 0.024f, 1.0f), LOBE_SAMPLE_LIGHT, -1},
		{"sky with sun", LOBE_NDF_GGX, 0.2, 0.2, 0.5, sun, -1, -1},
		{"glow", LOBE_NDF_GGX, 0.2, 0.2, 0.5, lobe_light_shape_glow(aside(), 1.5f, 1.0f), -1, -1},
		{"Beckmann under an overcast sky", LOBE_NDF_BECKMANN, 0.4, 0.4, 0.5, lobe_light_shape_sky(2.0f),
		 LOBE_SAMPLE_LOBE, -1},
	};
	return all[i];
}

static lobe_microsurface surface_of(const question *q)
{
	return lobe_microsurface_make(lobe_distribution_make(q->ndf), lobe_linear_stretch((float)q->ax, (float)q->ay));
}

static lobe_microfacet_conductor white(lobe_microsurface s, lobe_uint strategy)
{
	return lobe_microfacet_conductor_make(s, lobe_fresnel_model_constant(lobe_rgb_make(1.0f, 1.0f, 1.0f)),
					      strategy);
}

static double heuristic(lobe_uint from, double a, double b)
{
	const double r = b / a;
	return 1.0 / (1.0 + (from == LOBE_SAMPLE_BOTH_POWER ? r * r : r));
}

/* One sample of a technique, from the library's own samples. */
static double estimate(const question *q, const lobe_microfacet_conductor *p, lobe_vec3 wo, lobe_uint from, lobe_vec3 u,
		       lobe_vec3 v)
{
	double sum = 0.0;
	if (from != LOBE_SAMPLE_LIGHT) {
		const lobe_sample s = lobe_microfacet_conductor_sample(*p, wo, u);
		if (s.event) {
			const double light = (double)lobe_light_shape_density(q->light, s.wi);
			const double w = from == LOBE_SAMPLE_LOBE ? 1.0 : heuristic(from, (double)s.pdf, light);
			sum += w * (double)s.weight.g * light;
		}
	}
	if (from != LOBE_SAMPLE_LOBE) {
		const lobe_vec3 wi = lobe_light_shape_draw(q->light, v);
		const double light = (double)lobe_light_shape_density(q->light, wi);
		if (light > 0.0 && wi.z > 0.0f) {
			const double lobe = (double)lobe_microfacet_conductor_pdf(*p, wo, wi);
			const double w = from == LOBE_SAMPLE_LIGHT ? 1.0 : heuristic(from, light, lobe);
			sum += w * (double)lobe_microfacet_conductor_eval(*p, wo, wi).g;
		}
	}
	return sum;
}

typedef struct {
	double variance, error, mean;
} spread;

static uint32_t samples(void) { return test_long() ? 1000000u : 50000u; }

static spread spread_of(const question *q, lobe_uint strategy, lobe_uint from, uint32_t stream)
{
	const lobe_microfacet_conductor p = white(surface_of(q), strategy);
	const lobe_vec3 wo = direction_at(q->z, 0.0);
	const uint32_t n = samples();
	double s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		float u[3], v[3];
		test_u3(2u * stream, i, u);
		test_u3(2u * stream + 1u, i, v);
		const double x =
			estimate(q, &p, wo, from, lobe_vec3_make(u[0], u[1], u[2]), lobe_vec3_make(v[0], v[1], v[2]));
		s1 += x;
		s2 += x * x;
		s3 += x * x * x;
		s4 += x * x * x * x;
	}
	spread r;
	r.mean = s1 / n;
	r.variance = s2 / n - r.mean * r.mean;
	const double fourth = s4 / n - 4.0 * r.mean * s3 / n + 6.0 * r.mean * r.mean * s2 / n - 3.0 * pow(r.mean, 4.0);
	r.error = sqrt(fmax(fourth - r.variance * r.variance, 0.0) / n);
	return r;
}

static double directions_of(lobe_uint from) { return from >= LOBE_SAMPLE_BOTH_BALANCE ? 2.0 : 1.0; }

/* The least loss of all techniques and its error, against that of the one given. */
static double regret(const question *q, lobe_uint strategy, lobe_uint from, uint32_t stream, double *error)
{
	double least = HUGE_VAL, least_error = 0.0;
	const spread own = spread_of(q, strategy, from, stream);
	const spread truth = spread_of(q, LOBE_STRATEGY_VISIBLE, LOBE_SAMPLE_BOTH_BALANCE, stream);
	const double n = samples();
	for (lobe_uint f = LOBE_SAMPLE_LOBE; f <= LOBE_SAMPLE_BOTH_POWER; f++)
		for (lobe_uint k = 0; k <= LOBE_STRATEGY_LAST; k++) {
			if ((f != LOBE_SAMPLE_LOBE && k != LOBE_STRATEGY_VISIBLE && k != LOBE_STRATEGY_BOUNDED_CAP) ||
			    (f == LOBE_SAMPLE_LIGHT && k != LOBE_STRATEGY_VISIBLE) ||
			    (k >= LOBE_STRATEGY_VISIBLE_SLOPES && k <= LOBE_STRATEGY_VISIBLE_CAP))
				continue;
			const spread s = spread_of(q, k, f, stream);
			const double loss = s.variance * directions_of(f);
			/* What has not found the sun seems to have hardly any variance; its mean tells. */
			const int found = fabs(s.mean - truth.mean) < 5.0 * sqrt((s.variance + truth.variance) / n);
			if (found && loss < least) {
				least = loss;
				least_error = s.error / s.variance;
			}
		}
	*error = hypot(least_error, own.error / own.variance);
	return own.variance * directions_of(from) / least;
}

static void test_recommended_is_about_the_best(void)
{
	double worst = 0.0, off = 0.0;
	for (int i = 0; i < QUESTIONS; i++) {
		const question q = question_at(i);
		const lobe_recommendation r = lobe_recommend_strategy(surface_of(&q), direction_at(q.z, 0.0), q.light,
								      lobe_recommend_cost_samples());
		double error;
		const double lost = regret(&q, r.strategy, r.from, 60u + (uint32_t)i, &error);
		const spread s = spread_of(&q, r.strategy, r.from, 60u + (uint32_t)i);
		const double deviation = sqrt(s.variance) / s.mean;
		printf("  %-32s from %u, strategy %u: %.3f +- %.3f times the least loss, deviation %.4f, expected "
		       "%.4f\n",
		       q.what, r.from, r.strategy, lost, error, deviation, (double)r.deviation);
		worst = larger(worst, lost - 3.0 * error);
		off = larger(off, fabs((double)r.deviation / deviation - 1.0) - 1.5 * s.error / s.variance);
		if (q.from >= 0)
			TEST_ASSERT_EQUAL_INT_MESSAGE(q.from, (int)r.from, q.what);
		if (q.strategy >= 0)
			TEST_ASSERT_EQUAL_INT_MESSAGE(q.strategy, (int)r.strategy, q.what);
	}
	measured("loss of what is recommended over the least", worst, 1.05);
	measured("expected standard deviation off the measured one", off, 0.1);
	/* The same looks find what is not the best. */
	double error;
	question q = question_at(0);
	TEST_ASSERT_TRUE(regret(&q, LOBE_STRATEGY_VISIBLE, LOBE_SAMPLE_LOBE, 90u, &error) > 1.05 + 3.0 * error);
	q = question_at(5);
	TEST_ASSERT_TRUE(regret(&q, LOBE_STRATEGY_BOUNDED_CAP, LOBE_SAMPLE_BOTH_BALANCE, 91u, &error) >
			 1.05 + 3.0 * error);
}

/* --- the light asked itself --------------------------------------------------------------------------------------- */

/* Two lamps and a faint sky: no disk with a glow around it. In proportion to their power. */
enum { LAMPS = 2 };
static lobe_light_shape lamp(int i)
{
	return lobe_light_shape_disk(i ? direction_at(0.3, 2.6) : direction_at(0.8, 4.0), i ? 0.02f : 0.2f, 0.9f);
}

static lobe_light_seen two_lamps(lobe_vec3 w)
{
	lobe_light_seen s;
	s.pdf = 0.0f;
	for (int i = 0; i < LAMPS; i++)
		s.pdf += lobe_light_shape_density(lamp(i), w) / LAMPS;
	s.radiance = 3.0f * s.pdf; /* in a unit of its own */
	return s;
}

static lobe_vec3 two_lamps_draw(lobe_vec3 u)
{
	const int second = u.z >= 0.5f;
	return lobe_light_shape_draw(lamp(second), lobe_vec3_make(u.x, u.y, 2.0f * u.z - (second ? 1.0f : 0.0f)));
}

static lobe_recommendation asking(lobe_microsurface surface, lobe_vec3 wo)
{
	lobe_recommend_sums s = lobe_recommend_start(LOBE_RECOMMEND_POINTS);
	for (int pass = 0; pass < 2; pass++)
		for (lobe_uint i = 1; i <= LOBE_RECOMMEND_POINTS; i++) {
			const lobe_vec3 b = lobe_recommend_direction(surface, wo, i),
					l = two_lamps_draw(lobe_recommend_u(i));
			s = lobe_recommend_add(s, pass, i, surface, wo, b, two_lamps(b), l, two_lamps(l));
		}
	return lobe_recommend_answer(s, surface, lobe_recommend_cost_samples());
}

/* Variance of a sample, from the library's own, by technique as recommended. */
static spread lamps_spread(lobe_microsurface surface, lobe_vec3 wo, lobe_uint strategy, lobe_uint from, uint32_t stream)
{
	const lobe_microfacet_conductor p = white(surface, strategy);
	const uint32_t n = samples();
	double s1 = 0.0, s2 = 0.0, s4 = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		float u[3], v[3];
		double x = 0.0;
		test_u3(2u * stream, i, u);
		test_u3(2u * stream + 1u, i, v);
		const lobe_sample b = lobe_microfacet_conductor_sample(p, wo, lobe_vec3_make(u[0], u[1], u[2]));
		const lobe_vec3 l = two_lamps_draw(lobe_vec3_make(v[0], v[1], v[2]));
		const lobe_light_seen at_b = two_lamps(b.wi), at_l = two_lamps(l);
		if (from != LOBE_SAMPLE_LIGHT && b.event)
			x += (from == LOBE_SAMPLE_LOBE ? 1.0 : heuristic(from, (double)b.pdf, (double)at_b.pdf)) *
			     (double)(b.weight.g * at_b.radiance);
		if (from != LOBE_SAMPLE_LOBE && l.z > 0.0f)
			x += (from == LOBE_SAMPLE_LIGHT ? 1.0
							: heuristic(from, (double)at_l.pdf,
								    (double)lobe_microfacet_conductor_pdf(p, wo, l))) *
			     (double)(lobe_microfacet_conductor_eval(p, wo, l).g * at_l.radiance / at_l.pdf);
		s1 += x;
		s2 += x * x;
		s4 += x * x * x * x;
	}
	spread r;
	r.mean = s1 / n;
	r.variance = s2 / n - r.mean * r.mean;
	r.error = sqrt(s4 / n) / sqrt((double)n);
	return r;
}

static void test_a_light_that_is_asked_itself(void)
{
	static const double alphas[] = {0.05, 0.2, 0.6};
	double worst = 0.0, off = 0.0;
	for (int i = 0; i < 3; i++) {
		const lobe_microsurface s = lobe_microsurface_make(
			lobe_distribution_make(LOBE_NDF_GGX), lobe_linear_stretch((float)alphas[i], (float)alphas[i]));
		const lobe_vec3 wo = direction_at(0.7, 0.4);
		const lobe_recommendation r = asking(s, wo);
		const spread own = lamps_spread(s, wo, r.strategy, r.from, 110u);
		double least = HUGE_VAL;
		for (lobe_uint from = LOBE_SAMPLE_LOBE; from <= LOBE_SAMPLE_BOTH_POWER; from++)
			for (int bounded = 0; bounded < 2; bounded++)
				least = fmin(least,
					     directions_of(from) * lamps_spread(s, wo,
										bounded ? LOBE_STRATEGY_BOUNDED_CAP
											: LOBE_STRATEGY_VISIBLE,
										from, 110u)
									   .variance);
		const double lost = directions_of(r.from) * own.variance / least;
		const double deviation = sqrt(own.variance) / own.mean;
		printf("  two lamps, alpha %-5g from %u, strategy %u: %.3f times the least loss, deviation %.4f, "
		       "expected "
		       "%.4f\n",
		       alphas[i], r.from, r.strategy, lost, deviation, (double)r.deviation);
		worst = larger(worst, lost - 3.0 * own.error / own.variance);
		off = larger(off, fabs((double)r.deviation / deviation - 1.0) - 1.5 * own.error / own.variance);
	}
	measured("asking: loss over the least", worst, 1.05);
	measured("asking: expected standard deviation off the measured one", off, 0.1);
}

/* Costs count: what is twice as expensive has to be twice as good. */
static void test_cost_decides(void)
{
	const question q = question_at(0);
	lobe_recommend_cost cost = lobe_recommend_cost_samples();
	cost.lobe[LOBE_STRATEGY_BOUNDED_CAP] = 100.0f;
	const lobe_recommendation r = lobe_recommend_strategy(surface_of(&q), direction_at(q.z, 0.0), q.light, cost);
	TEST_ASSERT_TRUE(r.strategy != LOBE_STRATEGY_BOUNDED_CAP);
}

/* Corners: an answer, and a finite deviation. */
static void test_extremes_have_an_answer(void)
{
	static const double alphas[] = {1e-4, 1e-2, 1.0}, cosines[] = {1.0, 0.1, 1e-6, 0.0};
	static const float angles[] = {1e-8f, 6.7e-5f, 6.2f};
	unsigned bad = 0;
	for (int a = 0; a < 3; a++)
		for (int z = 0; z < 4; z++)
			for (int k = 0; k < 3; k++)
				for (int where = 0; where < 2; where++) {
					const lobe_microsurface s = lobe_microsurface_make(
						lobe_distribution_make(LOBE_NDF_GGX),
						lobe_linear_stretch((float)alphas[a], (float)alphas[2 - a]));
					const lobe_light_shape light = lobe_light_shape_disk(
						where ? aside() : mirrored(cosines[z]), angles[k], where ? 0.5f : 1.0f);
					const lobe_recommendation r = lobe_recommend_strategy(
						s, direction_at(cosines[z], 0.0), light, lobe_recommend_cost_samples());
					bad += !(r.deviation >= 0.0f && r.deviation <= 3e38f) ||
					       r.strategy > LOBE_STRATEGY_LAST || r.from > LOBE_SAMPLE_BOTH_POWER;
				}
	TEST_ASSERT_EQUAL_UINT(0, bad);
	/* Behind the surface nothing is seen, and no number is made up. */
	const lobe_microsurface s =
		lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), lobe_linear_stretch(0.3f, 0.3f));
	const lobe_recommendation r = lobe_recommend_strategy(s, direction_at(-0.5, 0.0), lobe_light_shape_sky(0.0f),
							      lobe_recommend_cost_samples());
	TEST_ASSERT_EQUAL_UINT(LOBE_SAMPLE_LIGHT, r.from);
	TEST_ASSERT_EQUAL_FLOAT(0.0f, r.deviation);
}

/* And where there is none to be had it says so. */
static void test_no_answer(void)
{
	const lobe_recommend_cost cost = lobe_recommend_cost_samples();
	const lobe_light_shape sky = lobe_light_shape_sky(0.0f);
	const lobe_vec3 wo = direction_at(0.5, 0.0);
	const lobe_microsurface s =
		lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), lobe_linear_stretch(0.3f, 0.3f));
	lobe_microsurface no_surface = s;
	lobe_light_shape none = lobe_light_shape_disk(wo, 0.0f, 1.0f);
	no_surface.map.xx = NAN;
	TEST_ASSERT_TRUE(lobe_recommend_strategy(s, wo, sky, cost).deviation > 0.0f);
	TEST_ASSERT_TRUE(lobe_recommend_strategy(no_surface, wo, sky, cost).deviation == -1.0f);
	TEST_ASSERT_TRUE(lobe_recommend_strategy(s, wo, none, cost).deviation == -1.0f);
	none = sky;
	none.slope = NAN;
	TEST_ASSERT_TRUE(lobe_recommend_strategy(s, wo, none, cost).deviation == -1.0f);
	TEST_ASSERT_TRUE(lobe_recommend_strategy(s, lobe_vec3_make(NAN, 0.0f, 0.8f), sky, cost).deviation == -1.0f);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_recommended_is_about_the_best);
	RUN_TEST(test_a_light_that_is_asked_itself);
	RUN_TEST(test_cost_decides);
	RUN_TEST(test_extremes_have_an_answer);
	RUN_TEST(test_no_answer);
	return UNITY_END() != 0;
}
