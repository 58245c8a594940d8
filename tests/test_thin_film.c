/* test_thin_film.c - core/thin_film.h: the colour of films on a base against the integral of Airy's reflectance over
 * the same sensitivities (GSL), its limits, and what everybody has seen of it. (One wavelength: test_airy.c. The lobes:
 * test_iridescent.c.) */
#include "lobe/core/optics.h"
#include "lobe/core/thin_film.h"

#include "film_cases.h"
#include "measured.h"
#include "support.h"
#include "textbook.h"
#include "unity.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* Belcour and Barla's fit of the CIE 1931 observer as they give it: amplitude, centre and variance, per metre; X has a
 * second lobe. A Gaussian's transform falls as exp(-var (2 pi OPD)^2), so its own variance is 2 var. */
static const double fit[4][3] = {{5.4856e-13, 1.6810e+06, 4.3278e+09},
				 {9.7470e-14, 2.2399e+06, 4.5282e+09},
				 {4.4201e-13, 1.7953e+06, 9.3046e+09},
				 {5.2481e-13, 2.2084e+06, 6.6121e+09}};

static void invert(double m[3][3], double inv[3][3])
{
	const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
			   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
			   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++) {
			const int a = (k + 1) % 3, b = (k + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
			inv[i][k] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / det;
		}
}

static void multiply(double a[3][3], double b[3][3], double to[3][3])
{
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			to[i][k] = a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k];
}

/* weight[channel][Gaussian]: from the chromaticities of sRGB's primaries and white (IEC 61966-2-1) and Bradford's cone
 * responses, for a spectrum of equal energy to be white. */
static void channel_weights(double weight[3][4])
{
	static const double xy[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
	double white[3] = {0.95047, 1.0, 1.08883}, primaries[3][3], inv[3][3], cone_inv[3][3], t[3][3], adapt[3][3];
	double cone[3][3] = {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}};
	for (int k = 0; k < 3; k++) {
		primaries[0][k] = xy[k][0] / xy[k][1];
		primaries[1][k] = 1.0;
		primaries[2][k] = (1.0 - xy[k][0] - xy[k][1]) / xy[k][1];
	}
	invert(primaries, inv);
	for (int k = 0; k < 3; k++) {
		const double y = inv[k][0] * white[0] + inv[k][1] * white[1] + inv[k][2] * white[2];
		for (int i = 0; i < 3; i++)
			primaries[i][k] *= y;
	}
	invert(primaries, inv);
	invert(cone, cone_inv);
	for (int i = 0; i < 3; i++) {
		const double from = cone[i][0] + cone[i][1] + cone[i][2];
		const double to = cone[i][0] * white[0] + cone[i][1] * white[1] + cone[i][2] * white[2];
		for (int k = 0; k < 3; k++)
			t[i][k] = cone[i][k] * to / from;
	}
	multiply(cone_inv, t, adapt);
	multiply(inv, adapt, t);
	const double lobes = fit[0][0] * sqrt(fit[0][2]) + fit[1][0] * sqrt(fit[1][2]);
	for (int c = 0; c < 3; c++) {
		weight[c][0] = t[c][0] * fit[0][0] * sqrt(fit[0][2]) / lobes;
		weight[c][1] = t[c][0] * fit[1][0] * sqrt(fit[1][2]) / lobes;
		weight[c][2] = t[c][1];
		weight[c][3] = t[c][2];
	}
}

/* Airy's reflectance times one normalised Gaussian, at wave number nu [1/nm]. */
typedef struct {
	stack s;
	int channel, gaussian;
} spectrum;

static double spectral(double nu, void *context)
{
	const spectrum *p = context;
	const stack s = p->s;
	const double mu = 1e-9 * fit[p->gaussian][1], v = 2e-18 * fit[p->gaussian][2];
	return exp(-(nu - mu) * (nu - mu) / (2.0 * v)) / sqrt(TWO_PI * v) *
	       textbook_airy((double)s.c, 1.0, (double)s.film, (double)s.d, (double)s.n[p->channel],
			     (double)s.k[p->channel], 1.0 / nu);
}

static double integrated(stack s, int c, gsl_integration_workspace *work)
{
	static double weight[3][4];
	double sum = 0.0;
	if (weight[0][0] == 0.0)
		channel_weights(weight);
	for (int g = 0; g < 4; g++) {
		spectrum p = {s, c, g};
		gsl_function f = {spectral, &p};
		const double mu = 1e-9 * fit[g][1], sigma = sqrt(2e-18 * fit[g][2]);
		double value, error;
		gsl_integration_qag(&f, mu - 7.0 * sigma, mu + 7.0 * sigma, 1e-8, 1e-7, 200, GSL_INTEG_GAUSS31, work,
				    &value, &error);
		sum += weight[c][g] * value;
	}
	return fmin(fmax(sum, 0.0), 1.0);
}

static void test_rgb_against_the_spectrum(void)
{
	gsl_integration_workspace *work = gsl_integration_workspace_alloc(200);
	const uint32_t n = test_long() ? 20000u : 1200u;
	for (int metal = 0; metal < 2; metal++) {
		double worst = 0.0, worst_upright = 0.0, mean = 0.0, wrong = 0.0;
		stack at = {0};
		for (uint32_t i = 0; i < n; i++) {
			const stack s = make_stack(i, metal);
			const int c = (int)(i % 3);
			const lobe_rgb rgb = metal ? lobe_thin_film_conductor_rgb(s.c, film_of(s), n_of(s), k_of(s))
						   : lobe_thin_film_dielectric_rgb(s.c, film_of(s), s.n[0]).reflectance;
			const double exact = integrated(s, c, work), off = fabs(channel(rgb, c) - exact);
			mean += off / n;
			if (off > worst) {
				worst = off;
				at = s;
			}
			if (s.c > 0.3f)
				worst_upright = larger(worst_upright, off);
			/* 5 % more film must show. */
			stack thicker = s;
			thicker.d *= 1.05f;
			if (i < 200u)
				wrong = larger(wrong, fabs(channel(rgb, c) - integrated(thicker, c, work)));
		}
		printf("  %s: worst at cos %.3f, %.1f nm of index %.3f\n", metal ? "metals" : "dielectrics",
		       (double)at.c, (double)at.d, (double)at.film);
		measured(metal ? "metals: RGB - spectral integral" : "dielectrics: RGB - spectral integral", worst,
			 metal ? 0.07 : 0.015);
		measured("  the same at cosines above .3", worst_upright, metal ? 0.012 : 6e-4);
		measured("  the same, mean", mean, metal ? 2e-4 : 2e-5);
		printf("  %-60s %11.4g\n", "  a film 5 % thicker is off by", wrong);
		TEST_ASSERT_TRUE(wrong > 2.0 * (metal ? 0.07 : 0.015));
	}
	gsl_integration_workspace_free(work);
}

/* Thickness 0 and index 1 are no film, in every channel, from grazing to normal; a little film is nearly none. */
static void test_rgb_limits(void)
{
	double thin = 0.0, same = 0.0, sum = 0.0, step = 0.0, thick = 0.0;
	unsigned outside = 0;
	for (uint32_t i = 0; i < 60000u; i++) {
		const int metal = (int)(i & 1u);
		stack s = make_stack(i, metal);
		for (int kind = 0; kind < 4; kind++) {
			s.d = kind == 0 ? 0.0f : kind == 1 ? 333.0f : kind == 2 ? 1e-3f : 1e5f;
			stack t = s;
			t.film = kind == 1 ? 1.0f : s.film;
			const lobe_film_fresnel d = lobe_thin_film_dielectric_rgb(t.c, film_of(t), t.n[0]);
			const lobe_rgb rgb =
				metal ? lobe_thin_film_conductor_rgb(t.c, film_of(t), n_of(t), k_of(t)) : d.reflectance;
			for (int m = 0; m < 3; m++) {
				const double got = channel(rgb, m), off = fabs(got - base_of(t, m));
				outside += !(got >= 0.0 && got <= 1.0);
				sum = larger(sum, fabs(channel(d.reflectance, m) + channel(d.transmittance, m) - 1.0));
				thin = larger(thin, kind == 0 ? off : 0.0);
				same = larger(same, kind == 1 ? off : 0.0);
				step = larger(step, kind == 2 ? off : 0.0);
				/* A film of 100 um has no colour. */
				if (kind == 3 && !metal && t.film > 1.1f)
					thick = larger(thick, fabs(got - channel(rgb, 0)));
			}
			sum = larger(sum, fabs((double)d.mean_reflectance + (double)d.mean_transmittance - 1.0));
		}
	}
	measured("RGB, thickness 0: |R - Fresnel|", thin, 160.0 * U);
	measured("RGB, film index 1: |R - Fresnel|", same, 160.0 * U);
	/* A grazing resonance between interfaces that reflect 99 % moves that fast. */
	measured("RGB, .001 nm: |R - Fresnel|", step, 1e-4);
	measured("RGB, 100 um on a dielectric: difference of channels", thick, 0.0);
	measured("RGB: R + T - 1", sum, 100.0 * U);
	measured("RGB: outside of [0, 1]", outside, 0.0);
}

/* A film so dense that both its faces reflect nearly all is a resonator of index/4 bounces, and none at thickness 0:
 * the roundings of a series as long as that stay those of a few terms. */
static void test_rgb_of_dense_films(void)
{
	double dense = 0.0, densest = 0.0;
	for (uint32_t i = 0; i < 60000u; i++) {
		stack s = make_stack(i, (int)(i & 1u));
		s.d = 0.0f;
		s.film = powf(10.0f, 3.0f * test_uniform(8, i));
		const lobe_rgb rgb = i & 1u ? lobe_thin_film_conductor_rgb(s.c, film_of(s), n_of(s), k_of(s))
					    : lobe_thin_film_dielectric_rgb(s.c, film_of(s), s.n[0]).reflectance;
		for (int m = 0; m < 3; m++) {
			const double off = fabs(channel(rgb, m) - base_of(s, m));
			*(s.film < 100.0f ? &dense : &densest) = larger(s.film < 100.0f ? dense : densest, off);
		}
	}
	measured("RGB, thickness 0, index to 100: |R - Fresnel|", dense, 160.0 * U);
	measured("RGB, thickness 0, index 100 to 1000: |R - Fresnel|", densest, 160.0 * U);
}

/* What everybody has seen: a soap film is black where it is thinnest, and a film of 100 nm of n = 1.38 takes the
 * reflection off glass, least of the green. */
static void test_what_everybody_has_seen(void)
{
	const lobe_film_fresnel black = lobe_thin_film_dielectric_rgb(1.0f, lobe_film_make(5.0f, 1.33f), 1.0f);
	const lobe_film_fresnel bright = lobe_thin_film_dielectric_rgb(1.0f, lobe_film_make(110.0f, 1.33f), 1.0f);
	TEST_ASSERT_TRUE(black.mean_reflectance < 0.01f && bright.mean_reflectance > 0.06f);
	const lobe_film_fresnel coated = lobe_thin_film_dielectric_rgb(1.0f, lobe_film_make(100.0f, 1.38f), 1.52f);
	const float bare = lobe_fresnel_dielectric(1.0f, 1.52f).reflectance;
	printf("  MgF2 on glass reflects %.4f %.4f %.4f, bare glass %.4f\n", (double)coated.reflectance.r,
	       (double)coated.reflectance.g, (double)coated.reflectance.b, (double)bare);
	TEST_ASSERT_TRUE(coated.reflectance.g < coated.reflectance.r && coated.reflectance.g < coated.reflectance.b);
	TEST_ASSERT_TRUE(coated.reflectance.r < bare && coated.reflectance.g < 0.5f * bare);
}

int main(void)
{
	gsl_set_error_handler_off();
	UNITY_BEGIN();
	RUN_TEST(test_rgb_against_the_spectrum);
	RUN_TEST(test_rgb_limits);
	RUN_TEST(test_rgb_of_dense_films);
	RUN_TEST(test_what_everybody_has_seen);
	return UNITY_END();
}
