/* test_airy.c - core/airy.h: the reflectance of a film at one wavelength against complex arithmetic and its closed
 * limits. */
#include "lobe/core/airy.h"

#include "film_cases.h"
#include "measured.h"
#include "support.h"
#include "textbook.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double opd_of(stack s)
{
	const double f = (double)s.film, c = (double)s.c;
	return 2.0 * (double)s.d * sqrt(f * f - 1.0 + c * c);
}

/* Fresnel's amplitudes carry up to 40 roundings (test_fresnel.c), and R moves by at most twice what either moves. The
 * phase 2 pi OPD/wavelength carries 5 (g 3, products 2), of itself; R moves by no more than 1 for each radian, unless
 * it is a sharp resonance: slope is its derivative by the logarithm of the wavelength. */
static void test_airy_against_complex(void)
{
	double worst[2] = {0}, sum = 0.0, ratio[2] = {0}, per_wave = 0.0;
	unsigned outside = 0;
	for (uint32_t i = 0; i < 100000u; i++)
		for (int metal = 0; metal < 2; metal++) {
			const stack s = make_stack(i, metal);
			const float wavelength = 380.0f + 400.0f * test_uniform(5, i);
			const double exact = textbook_airy((double)s.c, 1.0, (double)s.film, (double)s.d,
							   (double)s.n[0], (double)s.k[0], (double)wavelength);
			const double waves = opd_of(s) / (double)wavelength;
			const double moved =
				textbook_airy((double)s.c, 1.0, (double)s.film, (double)s.d, (double)s.n[0],
					      (double)s.k[0], (double)wavelength * (1.0 + 1e-6));
			const double slope = fmax(TWO_PI * waves, fabs(moved - exact) * 1e6);
			const double allowed = (80.0 + 5.0 * slope) * U;
			float got;
			if (metal) {
				got = lobe_airy_conductor(s.c, film_of(s), s.n[0], s.k[0], wavelength);
			} else {
				const lobe_airy a = lobe_airy_dielectric(s.c, film_of(s), s.n[0], wavelength);
				got = a.reflectance;
				sum = larger(sum, fabs((double)a.reflectance + (double)a.transmittance - 1.0));
				outside += !(a.transmittance >= 0.0f && a.transmittance <= 1.0f);
			}
			outside += !(got >= 0.0f && got <= 1.0f);
			const double off = fabs((double)got - exact);
			ratio[metal] = larger(ratio[metal], off / allowed);
			if (waves < 1.0)
				worst[metal] = larger(worst[metal], off);
			else
				per_wave = larger(per_wave, off / waves);
		}
	printf("  Airy, OPD below a wavelength: off by %.1e (dielectric), %.1e (metal); above, by %.1e for each\n",
	       worst[0], worst[1], per_wave);
	measured("Airy, dielectric: error over what rounding allows", ratio[0], 1.0);
	measured("Airy, metal: error over what rounding allows", ratio[1], 1.0);
	measured("Airy: R + T - 1", sum, 80.0 * U);
	measured("Airy: outside of [0, 1]", outside, 0.0);
}

static double airy_of(stack s, int m, float wavelength)
{
	return s.k[m] > 0.0f ? (double)lobe_airy_conductor(s.c, film_of(s), s.n[m], s.k[m], wavelength)
			     : (double)lobe_airy_dielectric(s.c, film_of(s), s.n[m], wavelength).reflectance;
}

/* No film in three ways: no thickness, no index of its own, and a whole number of waves there and back. */
static void test_airy_limits(void)
{
	double thin = 0.0, same = 0.0, half = 0.0, relative = 0.0;
	for (uint32_t i = 0; i < 60000u; i++) {
		stack s = make_stack(i, (int)(i & 1u));
		const double base = base_of(s, 1);
		const int waves = (int)(i / 2 % 3) + 1;
		s.d = 0.0f;
		thin = larger(thin, fabs(airy_of(s, 1, 550.0f) - base));
		s.d = 1.0f;
		const double path = opd_of(s);
		s.d = (float)(waves * 550.0 / path);
		/* d is rounded, and so is g. */
		half = larger(half, fabs(airy_of(s, 1, 550.0f) - base) / (1.0 + TWO_PI * waves));
		s.film = 1.0f;
		s.d = 333.0f;
		const double got = airy_of(s, 1, 550.0f);
		same = larger(same, fabs(got - base));
		if (!(i & 1u) && s.n[1] > 1.01f)
			relative = larger(relative, fabs(got - base) / base);
	}
	measured("Airy, thickness 0: |R - Fresnel|", thin, 160.0 * U);
	measured("Airy, whole waves: |R - Fresnel|, each radian", half, 160.0 * U);
	measured("Airy, film index 1: |R - Fresnel|", same, 160.0 * U);
	/* The base's own zero at Brewster's angle apart, its relative error is kept. */
	measured("Airy, film index 1, dielectric: relative", relative, 160.0 * U);
	/* A quarter wave at normal incidence: ((n - f^2)/(n + f^2))^2, 0 for f = sqrt(n). */
	for (int i = 0; i < 20; i++) {
		const float f = 1.1f + 0.1f * (float)i, n = 1.52f;
		const double f2 = (double)f * (double)f, r = ((double)n - f2) / ((double)n + f2);
		const lobe_airy a = lobe_airy_dielectric(1.0f, lobe_film_make(550.0f / (4.0f * f), f), n, 550.0f);
		TEST_ASSERT_TRUE(fabs((double)a.reflectance - r * r) < 40.0 * U);
	}
	TEST_ASSERT_TRUE(lobe_airy_dielectric(1.0f, lobe_film_make(550.0f / 6.0f, 1.5f), 2.25f, 550.0f).reflectance <
			 1e-12f);
}

/* Light from inside meets the layers in the other order, and is reflected as much at the angle it is refracted to;
 * beyond the critical angle wholly, through whatever film. */
static void test_from_inside_it_is_the_same(void)
{
	double worst = 0.0, total = 0.0;
	for (uint32_t i = 0; i < 20000u; i++) {
		const stack s = make_stack(i, 0);
		const double c = (double)s.c, n = (double)s.n[0], f = (double)s.film, d = (double)s.d;
		const double inside = sqrt(1.0 - (1.0 - c * c) / (n * n));
		worst = larger(worst, fabs(textbook_airy(c, 1.0, f, d, n, 0.0, 500.0) -
					   textbook_airy(inside, n, f, d, 1.0, 0.0, 500.0)));
		const double beyond = sqrt((1.0 - 1.0 / (n * n))) * 0.999 * (double)test_uniform(6, i);
		if (n > 1.01)
			total = larger(total, fabs(textbook_airy(beyond, n, f, d, 1.0, 0.0, 500.0) - 1.0));
	}
	measured("complex arithmetic: R from inside - R from outside", worst, 1e-9);
	measured("complex arithmetic: 1 - R beyond the critical angle", total, 1e-9);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_airy_against_complex);
	RUN_TEST(test_airy_limits);
	RUN_TEST(test_from_inside_it_is_the_same);
	return UNITY_END();
}
