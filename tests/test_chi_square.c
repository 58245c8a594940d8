/* test_chi_square.c - the rule of chi_square.c: a right model is rejected as often as the level says, and a model that
 * is a little wrong always, in a cell that expects much and in cells that expect little. */
#include "chi_square.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 60, SAMPLES = 20000, TRIALS = 2000 };

void setUp(void) {}
void tearDown(void) {}

/* Cell i has a share of ratio^i: most cells expect much, some about 5, the last ones a hundredth of a sample. */
static void shares(double ratio, double *probability)
{
	double sum = 0.0;
	for (int i = 0; i < CELLS; i++)
		sum += probability[i] = pow(ratio, i);
	for (int i = 0; i < CELLS; i++)
		probability[i] /= sum;
}

static void draw(const double *probability, uint32_t stream, uint32_t *count)
{
	memset(count, 0, CELLS * sizeof *count);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		double u = ((double)test_bits(stream, i) + 0.5) * 0x1p-32;
		int k = 0;
		while (k < CELLS - 1 && u >= probability[k])
			u -= probability[k++];
		count[k]++;
	}
}

/* Both rules for the pool: with the first ratio it expects 1 or so, with the second some 20. */
static void test_a_right_model_passes(void)
{
	static const double ratios[] = {0.60, 0.8};
	static const double levels[] = {0.5, 0.1, 0.01};
	for (size_t r = 0; r < 2; r++) {
		double probability[CELLS];
		uint32_t count[CELLS], rejected[3] = {0};
		int dof = 0;
		shares(ratios[r], probability);
		for (uint32_t t = 0; t < TRIALS; t++) {
			draw(probability, 100u + t, count);
			const chi_square fit = chi_square_of(probability, count, CELLS);
			dof = fit.dof;
			for (int l = 0; l < 3; l++)
				rejected[l] += fit.p < levels[l];
		}
		for (int l = 0; l < 3; l++) {
			const double wanted = levels[l] * TRIALS, sigma = sqrt(wanted * (1.0 - levels[l]));
			printf("  ratio %.2f, %d degrees of freedom: level %.2f rejects %u of %d\n", ratios[r], dof,
			       levels[l], rejected[l], TRIALS);
			/* Not oftener than the level says; and not so seldom as to be blind. */
			TEST_ASSERT_TRUE(rejected[l] < wanted + 4.0 * sigma);
			TEST_ASSERT_TRUE(rejected[l] > 0.5 * wanted);
		}
	}
}

static void test_a_slightly_wrong_model_is_caught(void)
{
	double right[CELLS], wrong[CELLS];
	uint32_t count[CELLS];
	shares(0.8, right);
	draw(right, 1, count);
	TEST_ASSERT_TRUE(chi_square_of(right, count, CELLS).p > 0.01);
	/* 3 % of all samples in the cell beside theirs. */
	memcpy(wrong, right, sizeof wrong);
	wrong[0] += 0.03;
	wrong[1] -= 0.03;
	TEST_ASSERT_TRUE(chi_square_of(wrong, count, CELLS).p < 1e-6);
	/* Every share is a little too steep. */
	shares(0.78, wrong);
	TEST_ASSERT_TRUE(chi_square_of(wrong, count, CELLS).p < 1e-6);
}

/* Where hardly anything is expected: a few samples are chance, a dozen are not. */
static void test_what_is_never_expected(void)
{
	double probability[CELLS] = {0.5, 0.3, 0.2};
	uint32_t count[CELLS] = {10000, 6000, 4000};
	TEST_ASSERT_TRUE(chi_square_of(probability, count, CELLS).p > 0.99);
	count[7] = 2;
	TEST_ASSERT_TRUE(chi_square_of(probability, count, CELLS).p > 0.1);
	for (int i = 5; i < 17; i++)
		count[i] = 1;
	TEST_ASSERT_TRUE(chi_square_of(probability, count, CELLS).p < 1e-6);
	/* A single cell has nothing to disagree with. */
	TEST_ASSERT_TRUE(chi_square_of(probability, count, 1).p == 1.0);
}

static void test_the_rest_is_as_exact_as_the_others(void)
{
	const double probability[3] = {0.5, 0.49, 0.01};
	const uint32_t count[3] = {10000, 9750, 250};
	TEST_ASSERT_TRUE(chi_square_of(probability, count, 3).p < 0.01);
	TEST_ASSERT_TRUE(chi_square_with_rest(probability, count, 3, 2, 50.0).p > 0.1);
	TEST_ASSERT_TRUE(chi_square_with_rest(probability, count, 3, 2, 5.0).p < 0.01);
	TEST_ASSERT_TRUE(chi_square_with_rest(probability, count, 3, 0, 50.0).p < 0.01);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_a_right_model_passes);
	RUN_TEST(test_a_slightly_wrong_model_is_caught);
	RUN_TEST(test_what_is_never_expected);
	RUN_TEST(test_the_rest_is_as_exact_as_the_others);
	return UNITY_END();
}
