/* test_thin_film.c - films on a base: core/airy.h against complex arithmetic and its closed limits, core/thin_film.h
 * against the integral of Airy's reflectance over the same sensitivities (GSL). */
#include "lobe/core/airy.h"
#include "lobe/core/optics.h"
#include "lobe/core/thin_film.h"
#include "lobe/shading.h"

#include "measured.h"
#include "support.h"
#include "textbook.h"
#include "unity.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double channel(lobe_rgb c, int k) { return (double)(k == 0 ? c.r : k == 1 ? c.g : c.b); }

/* A film, an angle and a base: number i of many. Metals of optics.def, or k = 0. */
typedef struct {
	float c, d, film, n[3], k[3];
} stack;

static stack make_stack(uint32_t i, int metal)
{
	const float u[4] = {test_uniform(1, i), test_uniform(2, i), test_uniform(3, i), test_uniform(4, i)};
	const float most[4] = {0.0f, 50.0f, 300.0f, 1500.0f};
	stack s;
	s.c = fmaxf(u[0] * sqrtf(u[0]), 1e-3f);
	s.d = most[i % 4] * u[1];
	s.film = 1.0f + 1.5f * u[2];
	const lobe_rgb n = lobe_metal_eta(i / 4 % LOBE_METAL_COUNT), k = lobe_metal_k(i / 4 % LOBE_METAL_COUNT);
	for (int m = 0; m < 3; m++) {
		s.n[m] = metal ? (float)channel(n, m) : 1.0f + 2.0f * u[3];
		s.k[m] = metal ? (float)channel(k, m) : 0.0f;
	}
	return s;
}

static lobe_film film_of(stack s) { return lobe_film_make(s.d, s.film); }
static lobe_rgb n_of(stack s) { return lobe_rgb_make(s.n[0], s.n[1], s.n[2]); }
static lobe_rgb k_of(stack s) { return lobe_rgb_make(s.k[0], s.k[1], s.k[2]); }

static double opd_of(stack s)
{
	const double f = (double)s.film, c = (double)s.c;
	return 2.0 * (double)s.d * sqrt(f * f - 1.0 + c * c);
}

/* --- Airy --------------------------------------------------------------------------------------------------------- */

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

static double base_of(stack s, int m)
{
	return s.k[m] > 0.0f ? (double)lobe_fresnel_conductor(s.c, s.n[m], s.k[m])
			     : (double)lobe_fresnel_dielectric(s.c, s.n[m]).reflectance;
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

/* --- RGB ---------------------------------------------------------------------------------------------------------- */

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

/* --- the lobes ---------------------------------------------------------------------------------------------------- */

/* At thickness 0 the lobes are those without a film. */
static void test_lobes_without_film(void)
{
	const lobe_rgb n = lobe_metal_eta(LOBE_METAL_COPPER), k = lobe_metal_k(LOBE_METAL_COPPER);
	const lobe_iridescent_conductor a = lobe_iridescent_conductor_make(0.3f, 0.2f, 0.0f, 1.5f, n, k);
	const lobe_ggx_conductor b = lobe_ggx_conductor_make(0.3f, 0.2f, n, k);
	double metal = 0.0, glass = 0.0;
	for (uint32_t i = 0; i < 40000u; i++) {
		float o[3], w[3];
		test_direction(30, i, o);
		test_direction(31, i, w);
		if (fabsf(o[2]) < 0.05f || fabsf(w[2]) < 0.05f)
			continue;
		const float eta = i & 1u ? 1.5f : 0.7f;
		const lobe_vec3 wo = lobe_vec3_make(o[0], o[1], o[2]), wi = lobe_vec3_make(w[0], w[1], w[2]);
		const double fa = (double)lobe_iridescent_conductor_eval(a, wo, wi).r;
		const double fb = (double)lobe_ggx_conductor_eval(b, wo, wi).r;
		if (fb > 0.0)
			metal = larger(metal, fabs(fa - fb) / fb);
		const double ga = (double)lobe_iridescent_dielectric_eval(
					  lobe_iridescent_dielectric_make(0.4f, 0.3f, 0.0f, 1.4f, eta), wo, wi)
					  .g;
		const double gb = (double)lobe_ggx_dielectric_eval(lobe_ggx_dielectric_make(0.4f, 0.3f, eta), wo, wi).g;
		if (gb > 0.0)
			glass = larger(glass, fabs(ga - gb) / gb);
	}
	measured("iridescent_conductor at 0 nm - ggx_conductor, relative", metal, 40.0 * U);
	measured("iridescent_dielectric at 0 nm - ggx_dielectric, relative", glass, 40.0 * U);
}

/* eta = 1: what a film passes goes straight on, with the film's probability and colour. */
static void test_soap_film(void)
{
	const lobe_iridescent_dielectric p = lobe_iridescent_dielectric_make(0.1f, 0.1f, 350.0f, 1.33f, 1.0f);
	const float s = sqrtf(1.0f - 0.6f * 0.6f);
	const lobe_vec3 wo = lobe_vec3_make(s, 0.0f, 0.6f);
	const lobe_film_fresnel f = lobe_thin_film_dielectric_rgb(0.6f, p.film, 1.0f);
	double through = 0.0, weight[3] = {0};
	const uint32_t n = 20000u;
	for (uint32_t i = 0; i < n; i++) {
		float u[3];
		test_u3(40, i, u);
		const lobe_sample r = lobe_iridescent_dielectric_sample(p, wo, lobe_vec3_make(u[0], u[1], u[2]));
		if (!(r.event & LOBE_EVENT_TRANSMIT))
			continue;
		TEST_ASSERT_EQUAL_UINT(LOBE_EVENT_TRANSMIT | LOBE_EVENT_DELTA, r.event);
		TEST_ASSERT_TRUE(r.wi.x == -wo.x && r.wi.y == -wo.y && r.wi.z == -wo.z);
		through += 1.0 / n;
		for (int k = 0; k < 3; k++)
			weight[k] += channel(r.weight, k) / n;
	}
	/* Facets of alpha .1 see the film at angles around wo's. */
	TEST_ASSERT_DOUBLE_WITHIN(0.02, (double)f.mean_transmittance, through);
	for (int k = 0; k < 3; k++)
		TEST_ASSERT_DOUBLE_WITHIN(0.02, channel(f.transmittance, k), weight[k]);
}

/* Beyond the critical angle all is reflected, white, whatever the film; before it the colours of both events complement
 * each other. */
static void test_from_within_glass(void)
{
	const lobe_iridescent_dielectric p = lobe_iridescent_dielectric_make(1e-3f, 1e-3f, 300.0f, 1.38f, 1.5f);
	for (uint32_t i = 0; i < 2000u; i++) {
		const float z = i & 1u ? 0.7f * test_uniform(41, i) + 0.02f : 0.8f + 0.2f * test_uniform(41, i);
		const lobe_vec3 wo = lobe_vec3_make(0.0f, sqrtf(1.0f - z * z), -z);
		const lobe_sample r = lobe_iridescent_dielectric_sample(p, wo, lobe_vec3_make(0.5f, 0.5f, 0.0f));
		const lobe_sample t =
			lobe_iridescent_dielectric_sample(p, wo, lobe_vec3_make(0.5f, 0.5f, 0x1.fffffep-1f));
		TEST_ASSERT_TRUE((r.event & LOBE_EVENT_REFLECT) != 0u);
		if (i & 1u) {
			TEST_ASSERT_TRUE((t.event & LOBE_EVENT_REFLECT) != 0u);
			TEST_ASSERT_TRUE(t.weight.r == t.weight.g && t.weight.g == t.weight.b && t.weight.r > 0.9f);
		} else {
			TEST_ASSERT_TRUE((t.event & LOBE_EVENT_TRANSMIT) != 0u);
			TEST_ASSERT_TRUE((r.weight.r > r.weight.b) == (t.weight.r < t.weight.b));
		}
	}
}

int main(void)
{
	gsl_set_error_handler_off();
	UNITY_BEGIN();
	RUN_TEST(test_airy_against_complex);
	RUN_TEST(test_airy_limits);
	RUN_TEST(test_from_inside_it_is_the_same);
	RUN_TEST(test_rgb_against_the_spectrum);
	RUN_TEST(test_rgb_limits);
	RUN_TEST(test_rgb_of_dense_films);
	RUN_TEST(test_what_everybody_has_seen);
	RUN_TEST(test_lobes_without_film);
	RUN_TEST(test_soap_film);
	RUN_TEST(test_from_within_glass);
	return UNITY_END();
}
