/* test_ggx_visible.c - visible-normal sampling of microfacet/ggx.h: chi-square of a million samples, the last cells of
 * the unit square, and every extreme. */
#include "chi_square.h"
#include "directions.h"
#include "ggx_integral.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

#define U 0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static const float widths[] = {1e-4f, 3e-4f, 1e-3f, 1e-2f, 0.1f, 0.3f, 1.0f};
#define WIDTHS (sizeof widths / sizeof widths[0])

/* The last cells of u.y on the side where the cap's point and v add up: slopes of the visible normals against the cap
 * in long double. Planted: the point's distance from the axis as the root of h (2 t - h). */
static void test_visible_far_end(void)
{
	double off = 0.0, bounded = 0.0, planted = 0.0;
	for (size_t k = 0; k < WIDTHS; k++)
		for (int angle = 1; angle < 90; angle++)
			for (uint32_t i = 1; i <= 64u; i++) {
				const double theta = (double)angle * PI / 180.0;
				const lobe_vec3 v =
					lobe_vec3_make(widths[k] * (float)sin(theta), 0.0f, (float)cos(theta));
				const lobe_vec2 u = lobe_vec2_make(0.0f, 1.0f - (float)i * (float)U);
				const long double x = (long double)v.x, z = (long double)v.z, t = sqrtl(x * x + z * z);
				const long double rest = (1.0L - (long double)u.y) * (t + z), h = t + z - rest;
				const long double exact = (x + sqrtl(h * (t - z + rest))) / rest;
				const lobe_vec3 m = lobe_ggx_visible_above(v, lobe_ggx_t(v), u);
				const float rounded = u.y * (v.z + lobe_ggx_t(v)),
					    two_t = lobe_ggx_t(v) + lobe_ggx_t(v);
				const float s = sqrtf(fmaxf(rounded * (two_t - rounded), 0.0f));
				off = worse(off, fabs((double)m.x / (double)m.z / (double)exact - 1.0));
				const lobe_facet_bound b =
					lobe_ggx_bound(widths[k] * widths[k],
						       lobe_vec3_make((float)sin(theta), 0.0f, (float)cos(theta)));
				const long double part = (long double)b.part, whole = (long double)b.whole;
				const long double cap = (long double)u.y * (whole * t + part * z);
				const long double up =
					(long double)(1.0f - u.y) * (whole * t + part * z) + (whole - part) * z;
				const long double side = whole * x + sqrtl(cap * (2.0L * whole * t - cap));
				const lobe_vec3 n = lobe_ggx_visible_bounded(v, lobe_ggx_t(v), b, u);
				bounded = worse(bounded, fabs((double)n.x / (double)n.z / (double)(side / up) - 1.0));
				planted = worse(planted, fabs((double)(v.x + s) / (double)m.z / (double)exact - 1.0));
			}
	/* z is off by 3 U and s by 4 U, x by one more. */
	measured("visible normal, last cells: slope, relative", off, 8.0 * U);
	measured("the same of the bounded cap", bounded, 12.0 * U);
	TEST_ASSERT_TRUE(planted > 0.05);
}

#define SAMPLES  1000000u
#define Z_BINS   16
#define PHI_BINS 24

typedef lobe_vec3 (*sampler)(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u);

/* Planted: the cap reaches down to +w'.z in place of -w'.z. */
static lobe_vec3 sample_wrong_height(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u)
{
	const float height = 1.0f - w.z / t;
	const lobe_vec3 c = lobe_spherical_cap(u, height);
	return lobe_vec3_make(d.alpha_x * (c.x + d.alpha_x * w.x / t), d.alpha_y * (c.y + d.alpha_y * w.y / t),
			      c.z + w.z / t);
}

/* Planted, and harder to see: w is stretched by a width that is 3 % off. */
static lobe_vec3 sample_wrong_width(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u)
{
	lobe_stretch wide = d;
	(void)t;
	wide.alpha_x *= 1.03f;
	return stretched_ggx_visible(wide, w, stretched_ggx_t(wide, w), u);
}

/* Chi-square of the normals in the space of h, where cells of equal size suit every width, with D and w.m of the header
 * and the normalisation sigma = (z + t)/2. */
static double visible_p_value(sampler sample, lobe_stretch d, lobe_vec3 w, uint32_t stream)
{
	static uint32_t count[Z_BINS * PHI_BINS];
	static double probability[Z_BINS * PHI_BINS];
	const ggx_integral f = {d, w, ggx_weight_visible};
	const float t = stretched_ggx_t(d, w);
	const double sigma = 0.5 * ((double)w.z + (double)t);
	for (int i = 0; i < Z_BINS * PHI_BINS; i++) {
		const double z = (double)(i / PHI_BINS) / Z_BINS, phi = TWO_PI * (i % PHI_BINS) / PHI_BINS;
		count[i] = 0;
		probability[i] = ggx_integrate(&f, z, z + 1.0 / Z_BINS, phi, phi + TWO_PI / PHI_BINS, 16) / sigma;
	}
	for (uint64_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec3 m = sample(d, w, t, lobe_vec2_make(u[0], u[1]));
		const double x = (double)m.x / (double)d.alpha_x, y = (double)m.y / (double)d.alpha_y, z = (double)m.z;
		double turns = atan2(y, x) / TWO_PI;
		turns -= floor(turns);
		int row = (int)(z / sqrt(x * x + y * y + z * z) * Z_BINS), phi = (int)(turns * PHI_BINS);
		row = row < 0 ? 0 : row >= Z_BINS ? Z_BINS - 1 : row;
		phi = phi >= PHI_BINS ? PHI_BINS - 1 : phi;
		count[row * PHI_BINS + phi]++;
	}
	return chi_square_of(probability, count, Z_BINS * PHI_BINS).p;
}

static void test_visible_chi_square(void)
{
	static const struct {
		float ax, ay;
		double cosine, phi;
	} cases[] = {
		{1.0f, 1.0f, 1.0, 0.0},    {1.0f, 1.0f, 0.5, 1.0},    {1.0f, 1.0f, 1e-3, 2.0},
		{0.3f, 0.3f, 0.7, 4.0},    {0.3f, 0.3f, 1e-3, 5.0},   {0.1f, 0.1f, 0.2, 0.3},
		{0.01f, 0.01f, 0.9, 3.0},  {0.01f, 0.01f, 1e-3, 3.5}, {1e-4f, 1e-4f, 0.3, 2.2},
		{1e-4f, 1e-4f, 1e-6, 0.1}, {0.5f, 0.05f, 0.6, 0.9},   {0.05f, 0.5f, 1e-3, 1.2},
		{1e-4f, 1.0f, 0.4, 1.5},   {1.0f, 1e-4f, 1e-3, 0.2},  {0.8f, 0.3f, 1e-6, 2.8},
	};
	const size_t n = sizeof cases / sizeof cases[0];
	/* Sidak: all cases together reject a right sampler in 1 of 100 sets of random numbers (ours are fixed). */
	const double level = 1.0 - pow(0.99, 1.0 / (double)n);
	for (size_t i = 0; i < n; i++) {
		const lobe_stretch d = lobe_stretch_make(cases[i].ax, cases[i].ay);
		const lobe_vec3 w = direction_at(cases[i].cosine, cases[i].phi);
		const double p = visible_p_value(stretched_ggx_visible, d, w, 10 + (uint32_t)i);
		printf("  alpha %-6g %-6g cos %-6g p = %8.3g   level %.3g\n", (double)cases[i].ax, (double)cases[i].ay,
		       cases[i].cosine, p, level);
		if (p <= level)
			measured("the chi-square p of that case, negated", -p, -level);
	}
	const lobe_stretch d = lobe_stretch_make(0.5f, 0.05f);
	const lobe_vec3 w = direction_at(0.6, 0.9);
	const double height = visible_p_value(sample_wrong_height, d, w, 10),
		     width = visible_p_value(sample_wrong_width, d, w, 10);
	printf("  planted: height 1 - w'.z p = %.3g, width 3 %% off p = %.3g\n", height, width);
	TEST_ASSERT_TRUE_MESSAGE(height <= level, "the planted height was not caught");
	TEST_ASSERT_TRUE_MESSAGE(width <= level, "the planted width was not caught");
}

/* The bound as printed (Eto and Tokuyoshi 2023), k in long double. */
static long double printed_k(double narrow, double sine, double cosine)
{
	const long double a2 = (long double)narrow * (long double)narrow, s = 1.0L + (long double)sine;
	return (1.0L - a2) * s * s / (s * s + a2 * (long double)cosine * (long double)cosine);
}

/* Of random visible normals those that a bound of k leaves out: how far above the horizon the highest reflects, as the
 * sine of its elevation, and how many. */
static double left_out(lobe_stretch d, lobe_vec3 w, double k, uint32_t stream, uint32_t *out)
{
	const float t = stretched_ggx_t(d, w);
	double highest = -1.0;
	for (uint64_t i = 0; i < 20000u; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec3 h = lobe_ggx_visible_above(lobe_stretch_direction(d, w), t, lobe_vec2_make(u[0], u[1]));
		if ((double)h.z >= (1.0 - k) * (double)w.z)
			continue;
		const double x = (double)d.alpha_x * (double)h.x, y = (double)d.alpha_y * (double)h.y, z = (double)h.z;
		const double along = (double)w.x * x + (double)w.y * y + (double)w.z * z;
		highest = larger(highest, 2.0 * along * z / (x * x + y * y + z * z) - (double)w.z);
		(*out)++;
	}
	return highest;
}

/* What the bound leaves out reflects below the horizon, whatever the widths. Planted: k of the stretched direction. */
static void test_bound(void)
{
	static const float broad[] = {1e-4f, 0.03f, 0.1f, 0.3f, 0.6f, 1.0f};
	static const double cosines[] = {1e-6, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0};
	double below = -1.0, above = -1.0, highest = -1.0, planted = -1.0;
	uint32_t out = 0, planted_out = 0, n = 0;
	for (size_t i = 0; i < 36; i++)
		for (size_t j = 0; j < 9 * 3; j++, n++) {
			const lobe_stretch d = lobe_stretch_make(broad[i / 6], broad[i % 6]);
			const lobe_vec3 w = direction_at(cosines[j / 3], 0.7 * (double)(j % 3));
			const double sine = sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y);
			const double narrow = fmin((double)d.alpha_x, (double)d.alpha_y);
			const lobe_facet_bound b = lobe_ggx_bound(lobe_stretch_narrow2(d), w);
			const double k = (double)b.part / (double)b.whole, t = (double)stretched_ggx_t(d, w);
			const double wrong =
				(double)printed_k(narrow, sqrt(1.0 - pow((double)w.z / t, 2.0)), (double)w.z / t);
			const double more = fmin(1.0625 * sine + 1e-18, 1.0);
			below = larger(below, (double)printed_k(narrow, sine, (double)w.z) - k);
			above = larger(above, k - (double)printed_k(narrow, more, sqrt(1.0 - more * more)));
			highest = larger(highest, left_out(d, w, k, 200u + n, &out));
			planted = larger(planted, left_out(d, w, wrong, 200u + n, &planted_out));
		}
	printf("  left out: %u normals; by k of the stretched direction %u, which reflect up to %.3f\n", out,
	       planted_out, planted);
	measured("the bound's k below the printed one", below, 4.0 * U);
	measured("above that of a sine greater by a 16th of it", above, 4.0 * U);
	measured("what the bound leaves out reflects above the horizon by", highest, 2.0 * U);
	TEST_ASSERT_TRUE(out > 100000u && planted > 0.05);
}

static lobe_vec3 sample_bounded(lobe_stretch d, lobe_vec3 w, float t, lobe_vec2 u)
{
	const lobe_facet_bound b = lobe_ggx_bound(lobe_stretch_narrow2(d), w);
	return lobe_stretch_normal(d, lobe_ggx_visible_bounded(lobe_stretch_direction(d, w), t, b, u));
}

/* Every u and w, the extreme ones above all: m.z > 0, and the length can be divided by. */
static void visible_extremes(sampler sample)
{
	static const float corner[] = {0.0f, 0x1p-149f, 0x1p-24f,       0.25f,         0x1.fffffep-2f,
				       0.5f, 0.75f,     0x1.fffffcp-1f, 0x1.fffffep-1f};
	static const double cosines[] = {1e-6, 1e-5, 1e-3, 0.1, 0.5, 1.0 - 0x1p-24, 1.0};
	static const double azimuths[] = {0.0, 0.785398, 1.5707963, 3.14159265, 4.712389, 5.5};
	const size_t corners = sizeof corner / sizeof corner[0];
	double lowest = 1.0, shortest = 10.0, hidden = 0.0;
	uint32_t bad = 0;
	for (size_t i = 0; i < WIDTHS * WIDTHS; i++) {
		const lobe_stretch d = lobe_stretch_make(widths[i / WIDTHS], widths[i % WIDTHS]);
		for (size_t j = 0; j < 7 * 6; j++) {
			lobe_vec3 w = direction_at(cosines[j / 6], azimuths[j % 6]);
			for (int k = 0; k < 2; k++) {
				const float t = stretched_ggx_t(d, w);
				for (uint64_t l = 0; l < corners * corners + 200; l++) {
					/* Near the rim of the cap as well, where the normal is shortest. */
					lobe_vec2 u = {corner[l % corners], corner[l / corners % corners]};
					if (l >= corners * corners)
						u = lobe_vec2_make(test_uniform(30, l),
								   l & 1 ? 0x1.fffffep-1f : test_uniform(31, l));
					const lobe_vec3 m = sample(d, w, t, u);
					const lobe_vec3 n = lobe_normalize(m);
					const double len = sqrt((double)m.x * (double)m.x + (double)m.y * (double)m.y +
								(double)m.z * (double)m.z);
					const double c = (double)w.x * (double)m.x + (double)w.y * (double)m.y +
							 (double)w.z * (double)m.z;
					if (!(m.z > 0.0f && len < 10.0 && fabs((double)lobe_dot(n, n) - 1.0) < 1e-6)) {
						if (bad++ < 4)
							printf("  alpha %g %g w %a %a %a u %a %a: m %g %g %g\n",
							       (double)d.alpha_x, (double)d.alpha_y, (double)w.x,
							       (double)w.y, (double)w.z, (double)u.x, (double)u.y,
							       (double)m.x, (double)m.y, (double)m.z);
						continue;
					}
					lowest = fmin(lowest, (double)m.z / (double)t);
					shortest = fmin(shortest, len);
					hidden = larger(hidden, -c / len);
				}
				/* An upward direction that normalising has left an ulp too long. */
				w = lobe_vec3_scale(w, 1.0f + 0x1p-23f);
			}
		}
	}
	measured("visible normals not finite, not up, or not to be normalised", bad, 0.0);
	/* (1 - u.y)(1 + w'.z) with u.y at most 1 - 2^-24. */
	measured("2^-24 - lowest m.z", U - lowest, 0.0);
	printf("  %-60s %11.4g\n", "shortest m", shortest);
	/* lobe_normalize is good from 1e-18 on. */
	measured("1e-18 / shortest m", 1e-18 / shortest, 1.0);
	printf("  %-60s %11.4g\n", "largest -w.m/|m| (0: all are visible)", hidden);
}

static void test_visible_extremes(void) { visible_extremes(stretched_ggx_visible); }
static void test_bounded_extremes(void) { visible_extremes(sample_bounded); }

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_visible_chi_square);
	RUN_TEST(test_visible_extremes);
	RUN_TEST(test_bounded_extremes);
	RUN_TEST(test_bound);
	RUN_TEST(test_visible_far_end);
	return UNITY_END();
}
