/* test_report_field.c - the report's simulated masking, the judge of all models: against a simulation that shares
 * nothing with it but what a Gaussian field is, and against known moments; and that errors planted in it are found. */
#include "approximations_field.h"

#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* Angles from the normal and azimuth between [degrees], on the surface of width 1; the facet is the half vector's.
 * below: the second direction is under the surface, and the facet the one that refracts by index 1.5. */
typedef struct {
	double theta_o, theta_i, phi;
	int below;
} pair;

/* Slopes (-m.x/m.z, -m.y/m.z). */
static void slope_of(const pair *p, double slope[2])
{
	const double to = p->theta_o * PI / 180.0, ti = p->theta_i * PI / 180.0, phi = p->phi * PI / 180.0;
	const double eta = p->below ? 1.5 : 1.0, side = p->below ? -1.0 : 1.0;
	const double x = sin(to) + eta * sin(ti) * cos(phi), y = eta * sin(ti) * sin(phi);
	const double z = cos(to) + side * eta * cos(ti);
	slope[0] = -x / z;
	slope[1] = -y / z;
}

/* --- the report's ------------------------------------------------------------------------------------------------- */

typedef enum { SOUND, NO_SLOPE, STEEPER, WRONG_SIDE, PLANTS } plant;
static const char *const plant_names[PLANTS] = {"sound", "facets of any slope", "rays 5 degrees too steep",
						"second ray mirrored"};

/* share[0..2]: seen by the first, the second, both. */
static void simulate(const pair *p, uint64_t answers, plant wrong, double share[3])
{
	const double phi = p->phi * PI / 180.0 + (wrong == WRONG_SIDE ? PI : 0.0);
	const double steeper = wrong == STEEPER ? 5.0 : 0.0;
	const double to = (p->theta_o - steeper) * PI / 180.0, ti = (p->theta_i - steeper) * PI / 180.0;
	double slope[2];
	slope_of(p, slope);
	share[0] = share[1] = share[2] = 0.0;
	for (uint64_t n = 0; n < answers; n++) {
		approximations_field f;
		approximations_field_make(&f, 7000u, n, slope[0], slope[1]);
		if (wrong == NO_SLOPE)
			f.lack_x = f.lack_y = 0.0f;
		const int a = approximations_field_is_free(&f, 1.0f, 0.0f, (float)(cos(to) / sin(to)), 1.0f);
		const int b = approximations_field_is_free(&f, (float)cos(phi), (float)sin(phi),
							   (float)(cos(ti) / sin(ti)), p->below ? -1.0f : 1.0f);
		share[0] += a;
		share[1] += b;
		share[2] += a & b;
	}
	for (int k = 0; k < 3; k++)
		share[k] /= (double)answers;
}

/* --- another ------------------------------------------------------------------------------------------------------ */

enum { OTHER_WAVES = 40 };

static double uniform(uint32_t stream, uint64_t i) { return ((double)test_bits(stream, i) + 0.5) * 0x1p-32; }

/* Heights by cosines in double, and a slope that is met, not made: of fields of any slope those are taken whose slope
 * in the middle is within .2 of the wanted one. Returns how many were. */
static uint64_t simulate_otherwise(const pair *p, uint64_t wanted, double share[3])
{
	const double to = p->theta_o * PI / 180.0, ti = p->theta_i * PI / 180.0, phi = p->phi * PI / 180.0;
	const double cot[2] = {cos(to) / sin(to), cos(ti) / sin(ti)};
	const double direction[2][2] = {{1.0, 0.0}, {cos(phi), sin(phi)}};
	double slope[2];
	uint64_t met = 0;
	slope_of(p, slope);
	share[0] = share[1] = share[2] = 0.0;
	for (uint64_t n = 0; met < wanted && n < 100 * wanted; n++) {
		double kx[OTHER_WAVES], ky[OTHER_WAVES], phase[OTHER_WAVES], sx = 0.0, sy = 0.0, height = 0.0;
		const double size = sqrt(1.0 / OTHER_WAVES);
		for (uint64_t i = 0; i < OTHER_WAVES; i++) {
			const uint64_t at = 3 * (n * OTHER_WAVES + i);
			const double r = sqrt(-2.0 * log(uniform(7100u, at))), turn = TWO_PI * uniform(7100u, at + 1);
			kx[i] = r * cos(turn);
			ky[i] = r * sin(turn);
			phase[i] = TWO_PI * uniform(7100u, at + 2);
			sx -= size * kx[i] * sin(phase[i]);
			sy -= size * ky[i] * sin(phase[i]);
			height += size * cos(phase[i]);
		}
		if (fabs(sx - slope[0]) > 0.2 || fabs(sy - slope[1]) > 0.2)
			continue;
		int seen[2] = {1, 1};
		for (int ray = 0; ray < 2; ray++) {
			const double side = ray && p->below ? -1.0 : 1.0, start = side * height;
			for (double t = 0.03; seen[ray] && start + cot[ray] * t < 3.6; t += 0.03) {
				const double x = t * direction[ray][0], y = t * direction[ray][1];
				double at = 0.0;
				for (int i = 0; i < OTHER_WAVES; i++)
					at += size * cos(kx[i] * x + ky[i] * y + phase[i]);
				seen[ray] = side * at <= start + cot[ray] * t;
			}
		}
		met++;
		share[0] += seen[0];
		share[1] += seen[1];
		share[2] += seen[0] & seen[1];
	}
	for (int k = 0; k < 3; k++)
		share[k] /= (double)met;
	return met;
}

/* Differences in standard errors of both together. */
static double deviations(double a, double b, double n_a, double n_b)
{
	const double p = (a * n_a + b * n_b) / (n_a + n_b);
	return fabs(a - b) / sqrt(fmax(p * (1.0 - p), 1e-6) * (1.0 / n_a + 1.0 / n_b));
}

/* Nine shares within 4 standard errors; every planted error moves one of them by more than 6. */
static void test_two_simulations_agree_and_planted_errors_do_not(void)
{
	static const pair pairs[] = {{60, 60, 180, 0}, {75, 60, 140, 0}, {75, 50, 180, 1}};
	const uint64_t answers = test_long() ? 200000u : 20000u, wanted = test_long() ? 40000u : 4000u;
	double worst[PLANTS] = {0.0};
	for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
		double other[3];
		const uint64_t met = simulate_otherwise(&pairs[i], wanted, other);
		TEST_ASSERT_EQUAL_UINT64(wanted, met);
		for (int w = 0; w < PLANTS; w++) {
			double share[3];
			simulate(&pairs[i], answers, (plant)w, share);
			for (int k = 0; k < 3; k++)
				worst[w] =
					larger(worst[w], deviations(share[k], other[k], (double)answers, (double)met));
			if (w == SOUND)
				printf("  %g and %g degrees, %g apart%s: seen by %.4f, %.4f, both %.4f; otherwise "
				       "%.4f, "
				       "%.4f, %.4f\n",
				       pairs[i].theta_o, pairs[i].theta_i, pairs[i].phi,
				       pairs[i].below ? ", below" : "", share[0], share[1], share[2], other[0],
				       other[1], other[2]);
		}
	}
	measured("two simulations apart, in standard errors", worst[SOUND], 4.0);
	for (int w = SOUND + 1; w < PLANTS; w++) {
		printf("  %-26s off by %.1f standard errors\n", plant_names[w], worst[w]);
		TEST_ASSERT_TRUE_MESSAGE(worst[w] > 6.0, plant_names[w]);
	}
}

/* Height differences from the middle, given the slope s along the ray: with r = exp(-t^2/2), mean s t r and variance
 * (1 - r) - t^2 r^2/2, as heights and slopes have variance 1/2. That of the waves alone, whose slope is whatever it is,
 * lacks the last term. */
static void test_heights_have_the_moments_of_the_conditioned_field(void)
{
	enum { FIELDS = 40000 };
	static const double ts[] = {0.5, 1.0, 2.0};
	double off = 0.0, planted = 0.0;
	for (size_t i = 0; i < sizeof ts / sizeof *ts; i++) {
		const double t = ts[i], rho = exp(-0.5 * t * t), s = 0.7;
		double mean[2] = {0.0, 0.0}, square[2] = {0.0, 0.0};
		for (uint64_t n = 0; n < FIELDS; n++) {
			approximations_field f;
			approximations_field_make(&f, 7200u, n, s, -0.3);
			double height = -(double)f.height;
			for (int k = 0; k < APPROXIMATIONS_WAVES; k++) {
				const double turn = (double)f.kx[k] * t;
				height += (double)f.re[k] * cos(turn) - (double)f.im[k] * sin(turn);
			}
			const double given = height + (double)f.lack_x * t * rho;
			mean[0] += given / FIELDS;
			square[0] += given * given / FIELDS;
			mean[1] += height / FIELDS;
			square[1] += height * height / FIELDS;
		}
		for (int k = 0; k < 2; k++) {
			const double exact = s * t * rho, variance = 1.0 - rho - 0.5 * t * t * rho * rho;
			const double got = square[k] - mean[k] * mean[k];
			const double far = larger(fabs(mean[k] - exact) / sqrt(variance / FIELDS),
						  fabs(got - variance) / (variance * sqrt(2.0 / FIELDS)));
			if (k)
				planted = larger(planted, far);
			else
				off = larger(off, far);
		}
	}
	/* Sums of 64 waves are a little off Gaussian, which the variance of the variance feels. */
	measured("moments of the conditioned field, in standard errors", off, 5.0);
	printf("  without the condition: off by %.0f standard errors\n", planted);
	TEST_ASSERT_TRUE(planted > 30.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_heights_have_the_moments_of_the_conditioned_field);
	RUN_TEST(test_two_simulations_agree_and_planted_errors_do_not);
	return UNITY_END();
}
