/* test_smith.c - visible normals of skewed and tilted surfaces: samples against the density bin by bin, also from
 * directions that the mean plane faces away from.
 *
 * Bins are of facets of the standard surface (1/sqrt(1 + r^2) or its like, azimuth), whose probabilities come from
 * leadr.c alone: under the tail x^2 of radius r the standard surface has the area dx^2 dphi/(2 pi), of which max(0,
 * v.n) is seen from v. */
#include "lobe/microfacet/smith.h"

#include "chi_square.h"
#include "leadr.h"
#include "measured.h"
#include "quadrature.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 20, SAMPLES = 1000000 };
#define LEVEL 0.01

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* Distributions by number, where the build has them. */
static int ndf_of(leadr_kind kind)
{
	static const char *const names[] = {"ggx", "beckmann"};
#define LOBE_NDF_FIXED(NAME, name, number)                                                                             \
	if (!strcmp(names[kind], #name))                                                                               \
		return number;
#define LOBE_NDF_SHAPED(NAME, name, number)
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
	return -1;
}

/* A surface and a view by its cosine and azimuth. */
static const struct {
	double ax, ay, rho, tx, ty, cosine, phi;
} scenes[] = {
	{0.4, 0.4, 0.0, 0.0, 0.0, 0.6, 0.4},     {0.5, 0.2, 0.7, 0.0, 0.0, 0.3, 2.0},
	{0.3, 0.3, 0.0, 0.5, -0.3, 0.8, 0.7},    {0.6, 0.1, -0.9, 1.2, 0.4, 0.9, 3.5},
	{0.05, 0.3, 0.95, -2.0, 1.0, 0.4, 4.0},  {1.0, 0.7, 0.3, 0.2, 0.9, 0.05, 1.0},
	{0.4, 0.3, 0.5, 1.0, 0.0, 0.6, 0.0},     {0.3, 0.5, -0.6, 0.6, 0.8, 0.5, 0.9},
	{0.8, 0.8, 0.9999, 0.7, 0.7, 0.62, 0.2}, {0.3, 0.4, 0.5, 0.0, 0.4, -0.4, 5.0},
};
#define SCENES (sizeof scenes / sizeof scenes[0])

typedef struct {
	leadr s;
	lobe_smith surface;
	lobe_vec3 w;
	double k[3], v[3], sigma;
	double expected[SIDE * SIDE], quadrature_error;
	uint32_t observed[SIDE * SIDE];
} histogram;

static double facing(const double v[3], double x, double y)
{
	/* x v.n: n = (r cos, r sin, 1), and r x is smooth where r is not. */
	const double rx = sqrt((1.0 - x) * (1.0 + x));
	return x * v[2] + rx * (v[0] * cos(TWO_PI * y) + v[1] * sin(TWO_PI * y));
}

/* Beckmann's radius under the tail x^2 is sqrt(-ln x^2), and not smooth at 0 nor at 1: bins by GGX's radius instead,
 * with the ratio of the two densities. */
static double density(void *context, double x, double y)
{
	const histogram *h = context;
	const double r2 = (1.0 - x) * (1.0 + x) / (x * x);
	const double ratio = h->s.kind == LEADR_GGX ? 1.0 : exp(-r2) * (1.0 + r2) * (1.0 + r2);
	return 2.0 * fmax(facing(h->v, x, y), 0.0) * ratio / h->sigma;
}

static double edge(void *context, double x, double y) { return facing(((const histogram *)context)->v, x, y); }

static void expect(histogram *h)
{
	quadrature q = {density, edge, NULL, h, 1e-8, 1e-4, 6, 0.0};
	leadr_direction(&h->s, h->k, h->v);
	h->sigma = leadr_sigma(&h->s, h->k);
	for (int i = 0; i < SIDE; i++)
		for (int k = 0; k < SIDE; k++)
			h->expected[i * SIDE + k] = quadrature_box(&q, (double)i / SIDE, (i + 1.0) / SIDE,
								   (double)k / SIDE, (k + 1.0) / SIDE);
	h->quadrature_error = q.error;
}

/* The bin of a normal, by whitened slopes. */
static int bin_of(const leadr *s, const double m[3])
{
	const double x = -m[0] / m[2] - s->tx, y = -m[1] / m[2] - s->ty;
	const double p = x / s->ax, q = (y / s->ay - s->rho * x / s->ax) / sqrt(1.0 - s->rho * s->rho);
	double turns = atan2(-q, -p) / TWO_PI;
	turns -= floor(turns);
	const int i = (int)(SIDE / sqrt(1.0 + p * p + q * q)), k = (int)(SIDE * turns);
	return (i < SIDE ? i : SIDE - 1) * SIDE + (k < SIDE ? k : SIDE - 1);
}

/* What pdf() says, against the density of leadr.c, of every 64th sample: the worst relative error. */
static double observe(histogram *h, const leadr *whiten, uint32_t stream)
{
	double worst = 0.0;
	memset(h->observed, 0, sizeof h->observed);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		const lobe_vec2 u = lobe_vec2_make(test_uniform(stream, 2 * (uint64_t)i),
						   test_uniform(stream, 2 * (uint64_t)i + 1));
		const lobe_vec3 m = lobe_smith_visible(h->surface, h->w, u);
		const double d[3] = {(double)m.x, (double)m.y, (double)m.z};
		h->observed[bin_of(whiten, d)]++;
		if (i % 64 == 0) {
			const double c = d[0] * h->k[0] + d[1] * h->k[1] + d[2] * h->k[2];
			const double exact = leadr_d(&h->s, d) * c / h->sigma;
			/* A cosine near 0 is a difference of terms to 1. */
			if (c > 1e-3)
				worst = larger(worst,
					       fabs((double)lobe_smith_visible_pdf(h->surface, h->w, m) / exact - 1.0) *
						       c / leadr_steepness(&h->s, d));
			else
				TEST_ASSERT_TRUE(c > -1e-6 * h->k[2] - 3e-7);
		}
	}
	return worst;
}

static histogram scene_of(size_t i, leadr_kind kind)
{
	histogram h;
	memset(&h, 0, sizeof h);
	const leadr s = {kind, scenes[i].ax, scenes[i].ay, scenes[i].rho, scenes[i].tx, scenes[i].ty};
	const double c = scenes[i].cosine, sine = sqrt(1.0 - c * c);
	h.s = s;
	h.surface = lobe_smith_make(lobe_distribution_make((lobe_uint)ndf_of(kind)),
				    lobe_linear_tilted(lobe_linear_correlated((float)s.ax, (float)s.ay, (float)s.rho),
						       (float)s.tx, (float)s.ty));
	h.w = lobe_vec3_make((float)(sine * cos(scenes[i].phi)), (float)(sine * sin(scenes[i].phi)), (float)c);
	h.k[0] = (double)h.w.x;
	h.k[1] = (double)h.w.y;
	h.k[2] = (double)h.w.z;
	return h;
}

static double p_value(const histogram *h) { return chi_square_of(h->expected, h->observed, SIDE * SIDE).p; }

static double sidak(void) { return -expm1(log1p(-LEVEL) / (2.0 * SCENES)); }

static void test_samples_follow_the_density(void)
{
	unsigned away = 0, bad = 0;
	double worst = 0.0;
	for (int kind = LEADR_GGX; kind <= LEADR_BECKMANN; kind++)
		for (size_t i = 0; i < SCENES && ndf_of((leadr_kind)kind) >= 0; i++) {
			histogram h = scene_of(i, (leadr_kind)kind);
			double sum = 0.0;
			expect(&h);
			const double error =
				observe(&h, &h.s, 20u + (uint32_t)(kind * 100) + (uint32_t)i) / leadr_condition(&h.s);
			const chi_square fit = chi_square_of(h.expected, h.observed, SIDE * SIDE);
			for (int b = 0; b < SIDE * SIDE; b++)
				sum += h.expected[b];
			printf("  %s %zu: mean plane %s  v.z %6.3f  sigma %.4f  integral %.6f  chi2 %6.1f  dof %3d  p "
			       "%.3f\n",
			       kind ? "beckmann" : "ggx", i, h.v[2] < 0.0 ? "away  " : "facing", h.v[2], h.sigma, sum,
			       fit.chi2, fit.dof, fit.p);
			away += h.v[2] < 0.0 && h.k[2] > 0.0;
			bad += fit.p < sidak() || fabs(sum - 1.0) > 1e-5 + h.quadrature_error;
			worst = larger(worst, error);
		}
	measured("pdf against LEADR, relative error times w.m over condition(A)", worst, 2e-6);
	TEST_ASSERT_EQUAL_UINT(0, bad);
	TEST_ASSERT_TRUE(away >= 3u);
}

/* The same samples against densities that are a little or altogether wrong. */
static void test_a_wrong_density_is_caught(void)
{
	const size_t i = 7; /* the mean plane faces away */
	histogram h = scene_of(i, LEADR_GGX);
	const leadr right = h.s;
	expect(&h);
	observe(&h, &right, 999);
	const double p = p_value(&h);
	h.s.rho += 0.02;
	expect(&h); /* bins stay those of the right surface; the view is what goes wrong */
	const double p_rho = p_value(&h);
	h.s = right;
	h.s.tx *= 0.98;
	expect(&h);
	const double p_tilt = p_value(&h);
	h.s = right;
	expect(&h);
	/* As G1/|cos| would have it: sigma + |v.z| in place of sigma, for facets that face away. */
	double sum = 0.0;
	for (int b = 0; b < SIDE * SIDE; b++)
		sum += h.expected[b] *= h.sigma / (h.sigma - h.v[2]);
	const double p_g1 = p_value(&h);
	printf("  p: right %.3f, rho off by .02 %.1e, tilt by 2 %% %.1e, normalised by G1/|cos| %.1e (integral %.3f)\n",
	       p, p_rho, p_tilt, p_g1, sum);
	TEST_ASSERT_TRUE(p > sidak());
	TEST_ASSERT_TRUE(p_rho < 1e-9 && p_tilt < 1e-9 && p_g1 < 1e-9);
	TEST_ASSERT_TRUE(sum < 0.9);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_samples_follow_the_density);
	RUN_TEST(test_a_wrong_density_is_caught);
	return UNITY_END() != 0;
}
