/* test_report_strategies.c - the report's section on strategies: estimates compiled for one strategy are those chosen
 * at run time, variances as integrals are those of the samples, and who is unbeaten where, on a map made by hand. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured.h"
#include "strategies_rank.h"
#include "support.h"
#include "unity.h"

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- estimates ------------------------------------------------------------------------------------------------------- */

static void test_compiled_for_one_strategy_is_the_same(void)
{
	unsigned differing = 0, found = 0;
	for (int material = 0; material < STRATEGIES_MATERIALS; material++)
		for (size_t light = 0; light < strategies_analytic_lights(); light++) {
			const strategies_case c = strategies_case_make(material, 0.3, 0.4, light);
			const strategies_compiled *only = strategies_compiled_for(&c);
			for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
				for (uint64_t i = 0; i < 200; i++) {
					float u[3], v[3];
					test_u3(1, i, u);
					test_u3(2, i, v);
					const float a = strategies_estimate(&c, t, u, v),
						    b = only->estimate[t](&c, u, v);
					differing += test_float_bits(a) != test_float_bits(b);
					found += a > 0.0f;
					if (t >= STRATEGIES_LOBE)
						continue;
					const lobe_vec3 point = lobe_vec3_make(u[0], u[1], u[2]);
					const lobe_sample s = lobe_microfacet_conductor_sample(c.lobe[t], c.wo, point);
					const lobe_sample o = only->sample[t](&c, point);
					differing += test_float_bits(s.pdf) != test_float_bits(o.pdf);
					differing += test_float_bits(only->pdf[t](&c, s.wi)) != test_float_bits(s.pdf);
				}
		}
	printf("  %u estimates find light\n", found);
	measured("compiled estimates, samples and densities that differ", differing, 0.0);
	TEST_ASSERT_TRUE(found > 50000);
}

/* Under a dome, where every technique finds the light, by independent samples; off: of a deviation. */
static double off(const strategies_case *c, const strategies_moments *m, int technique, double factor)
{
	const uint64_t n = 100000;
	double s1 = 0.0, s2 = 0.0, s4 = 0.0;
	for (uint64_t i = 0; i < n; i++) {
		float u[3], v[3];
		test_u3(3, i, u);
		test_u3(4, i, v);
		const double x = (double)strategies_estimate(c, technique, u, v) - m->mean;
		s1 += x;
		s2 += x * x;
		s4 += x * x * x * x;
	}
	const double variance = s2 / (double)n, error = sqrt((s4 / (double)n - variance * variance) / (double)n);
	TEST_ASSERT_TRUE(fabs(s1 / (double)n) < 5.0 * sqrt(variance / (double)n) + 5.0 * m->mean_error);
	return fabs(factor * m->variance[technique] - variance) / hypot(error, m->error[technique]);
}

static void test_variances_are_those_of_samples(void)
{
	const size_t dome = strategies_analytic_lights() - 1;
	double worst = 0.0;
	for (int material = 0; material < STRATEGIES_MATERIALS; material++) {
		const strategies_case c = strategies_case_make(material, 0.5, 0.7, dome);
		const strategies_moments m = strategies_moments_of(&c, 1024, 8, 1);
		for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
			worst = larger(worst, off(&c, &m, t, 1.0));
		/* Caught: a variance that is a tenth wrong. */
		TEST_ASSERT_TRUE(off(&c, &m, LOBE_STRATEGY_VISIBLE, 1.1) > 5.0);
	}
	measured("variances off those of samples, standard deviations", worst, 5.0);
}

/* --- a map by hand ----------------------------------------------------------------------------------------------------- */

enum { CELLS = 5 };

/* All strategies have variance 1 in 1 s, but: cell 0 the cap 1.01 times less; 1 V-cavity 2 times less; 2 cosine 10
 * times less; 3 no light arrives; 4 visible normals twice as good. The cap takes 1.5 times as long. */
static void by_hand(rank_map *m, rank_cell cell[CELLS])
{
	memset(m, 0, sizeof *m);
	m->quick = 1;
	m->count = CELLS;
	m->cell = cell;
	memset(cell, 0, CELLS * sizeof *cell);
	for (int t = 0; t < STRATEGIES_TECHNIQUES; t++) {
		m->time[0][0][t] = t == LOBE_STRATEGY_BOUNDED_CAP ? 1.5 : 1.0;
		for (int i = 0; i < CELLS; i++)
			cell[i].variance[t] = t < STRATEGIES_LOBE ? 1.0 : 100.0;
	}
	for (int i = 0; i < CELLS; i++)
		cell[i].mean = 1.0;
	cell[0].variance[LOBE_STRATEGY_BOUNDED_CAP] = 1.0 / 1.01;
	cell[1].variance[LOBE_STRATEGY_VCAVITY] = 0.5;
	cell[2].variance[LOBE_STRATEGY_COSINE] = 0.1;
	cell[3].mean = 0.0;
	cell[4].variance[LOBE_STRATEGY_VISIBLE] = 0.5;
}

static void test_who_is_unbeaten(void)
{
	static rank_map m;
	rank_cell cell[CELLS];
	by_hand(&m, cell);
	/* 1 % ties; V-cavity does not; cosine counts only where it is among those asked; the dark cell is none. */
	const int expected[AMONG][CELLS] = {{1, 0, 1, 1, 1}, {1, 0, 0, 1, 1}};
	for (int among = 0; among < AMONG; among++)
		for (int i = 0; i < CELLS; i++)
			TEST_ASSERT_EQUAL_INT(expected[among][i],
					      rank_unbeaten(&m, &cell[i], LOBE_STRATEGY_VISIBLE, SAMPLES, among));
	TEST_ASSERT_TRUE(rank_dark(&cell[3]));
	TEST_ASSERT_EQUAL_DOUBLE(75.0, rank_share_of(&m, LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING, -1).all);
	TEST_ASSERT_EQUAL_DOUBLE(50.0, rank_share_of(&m, LOBE_STRATEGY_VISIBLE, SAMPLES, BLIND, -1).all);
	/* The cap's time counts where time does: then it is beaten everywhere. */
	TEST_ASSERT_EQUAL_DOUBLE(0.0, rank_share_of(&m, LOBE_STRATEGY_BOUNDED_CAP, TIME, FOLLOWING, -1).all);
	TEST_ASSERT_EQUAL_DOUBLE(50.0, rank_share_of(&m, LOBE_STRATEGY_BOUNDED_CAP, SAMPLES, FOLLOWING, -1).all);
	/* And hardly at all where each direction is a ray of 300 besides. GGX's default is the cap. */
	TEST_ASSERT_EQUAL_DOUBLE(50.0, rank_share_of(&m, LOBE_STRATEGY_BOUNDED_CAP, RAY, FOLLOWING, -1).all);
	TEST_ASSERT_EQUAL_DOUBLE(50.0, rank_share_of(&m, RANK_DEFAULT, SAMPLES, FOLLOWING, -1).all);
	cell[0].material = cell[1].material = cell[2].material = cell[4].material = STRATEGIES_BECKMANN;
	TEST_ASSERT_EQUAL_DOUBLE(75.0, rank_share_of(&m, RANK_DEFAULT, SAMPLES, FOLLOWING, -1).all);
	by_hand(&m, cell);
	double share;
	TEST_ASSERT_EQUAL_INT(LOBE_STRATEGY_VISIBLE, rank_most(&m, SAMPLES, FOLLOWING, &share));
	TEST_ASSERT_EQUAL_DOUBLE(75.0, share);
	/* Who may choose by roughness takes V-cavity where it is better, if that is all there is of that roughness. */
	TEST_ASSERT_EQUAL_DOUBLE(75.0, rank_most_by_view(&m, SAMPLES, FOLLOWING));
	cell[1].alpha = 1;
	TEST_ASSERT_EQUAL_DOUBLE(100.0, rank_most_by_view(&m, SAMPLES, FOLLOWING));
	const rank_defeat d = rank_defeat_of(&m, LOBE_STRATEGY_VISIBLE, SAMPLES, BLIND, -1, -1);
	TEST_ASSERT_EQUAL_UINT(2, d.cells);
	TEST_ASSERT_EQUAL_DOUBLE(10.0, d.worst);
	TEST_ASSERT_EQUAL_UINT(
		1, rank_defeat_of(&m, LOBE_STRATEGY_VISIBLE, SAMPLES, BLIND, -1, LOBE_STRATEGY_COSINE).cells);
}

static void test_what_is_not_known_ties(void)
{
	static rank_map m;
	rank_cell cell[CELLS];
	by_hand(&m, cell);
	cell[1].variance[LOBE_STRATEGY_VCAVITY] = 1.0 / 1.04;
	TEST_ASSERT_FALSE(rank_unbeaten(&m, &cell[1], LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING));
	/* 4 % less, known to 2.5 % each. */
	cell[1].error[LOBE_STRATEGY_VISIBLE] = cell[1].error[LOBE_STRATEGY_VCAVITY] = 0.025;
	TEST_ASSERT_TRUE(rank_unbeaten(&m, &cell[1], LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING));
	/* Half is half however little is known. */
	cell[1].variance[LOBE_STRATEGY_VCAVITY] = 0.5;
	cell[1].error[LOBE_STRATEGY_VISIBLE] = 1.0;
	TEST_ASSERT_FALSE(rank_unbeaten(&m, &cell[1], LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING));
	/* Times that spread by 10 % do not tell 4 % apart. */
	cell[1].variance[LOBE_STRATEGY_VCAVITY] = 1.0 / 1.04;
	cell[1].error[LOBE_STRATEGY_VISIBLE] = cell[1].error[LOBE_STRATEGY_VCAVITY] = 0.0;
	m.noise[0][0][LOBE_STRATEGY_VCAVITY] = 0.1;
	TEST_ASSERT_TRUE(rank_unbeaten(&m, &cell[1], LOBE_STRATEGY_VISIBLE, TIME, FOLLOWING));
	TEST_ASSERT_FALSE(rank_unbeaten(&m, &cell[1], LOBE_STRATEGY_VISIBLE, SAMPLES, FOLLOWING));
}

int main(void)
{
	/* The same lights everywhere. */
	if (setenv("LOBE_REPORT_PROBES", "", 1) != 0)
		return 1;
	strategies_lights(1);
	UNITY_BEGIN();
	RUN_TEST(test_compiled_for_one_strategy_is_the_same);
	RUN_TEST(test_variances_are_those_of_samples);
	RUN_TEST(test_who_is_unbeaten);
	RUN_TEST(test_what_is_not_known_ties);
	return UNITY_END();
}
