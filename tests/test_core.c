/* test_core.c - vectors, selects and frames. (lobe_fma: test_fma.c.) */
#include "lobe/core/event.h"
#include "lobe/core/frame.h"
#include "lobe/core/real.h"

#include "directions.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

/* Half an ulp of 1: what one rounding takes at most, relative to the result. */
#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- vectors and selects ------------------------------------------------------------------------------------------ */

#define VECTOR_CASES 1000000u

/* Products of floats are exact in double, and their sums nearly so in long double. */
static long double dot_exact(lobe_vec3 a, lobe_vec3 b)
{
	return (long double)a.x * (long double)b.x + (long double)a.y * (long double)b.y +
	       (long double)a.z * (long double)b.z;
}

static double length(lobe_vec3 v) { return (double)sqrtl(dot_exact(v, v)); }

static double distance(lobe_vec3 a, lobe_vec3 b)
{
	const double x = (double)a.x - (double)b.x, y = (double)a.y - (double)b.y, z = (double)a.z - (double)b.z;
	return sqrt(x * x + y * y + z * z);
}

static float symmetric(uint32_t stream, uint64_t i) { return 2.0f * test_uniform(stream, i) - 1.0f; }

static void test_dot(void)
{
	double worst = 0.0;
	for (uint64_t i = 0; i < VECTOR_CASES; i++) {
		const lobe_vec3 a = {symmetric(10, 3 * i), symmetric(10, 3 * i + 1), symmetric(10, 3 * i + 2)};
		const lobe_vec3 b = {symmetric(11, 3 * i), symmetric(11, 3 * i + 1), symmetric(11, 3 * i + 2)};
		const double size = fabs((double)a.x * (double)b.x) + fabs((double)a.y * (double)b.y) +
				    fabs((double)a.z * (double)b.z);
		const double error = fabs((double)((long double)lobe_dot(a, b) - dot_exact(a, b)));
		if (size > 0.0)
			worst = larger(worst, error / size);
	}
	/* Three roundings, each of at most U of a partial sum. */
	measured("dot: error / sum of |products|", worst, 3.0 * U * (1.0 + 3.0 * U));
}

static void test_diff_of_products(void)
{
	double worst = 0.0, worst_naive = 0.0;
	for (uint64_t i = 0; i < VECTOR_CASES; i++) {
		const uint32_t r = test_bits(12, i);
		const float a = symmetric(13, 3 * i), b = symmetric(13, 3 * i + 1), c = symmetric(13, 3 * i + 2);
		if (fabsf(a) < 0.01f || fabsf(b) < 0.01f || fabsf(c) < 0.01f)
			continue; /* keeps every rounding error a normal number, as the bound requires */
		/* Half of the cases cancel down to the last bits of a*b = c*d. */
		const float d =
			r & 1u ? symmetric(14, i) : test_float_of_bits(test_float_bits(a * b / c) + (r >> 1) % 5u - 2u);
		/* Both products are exact in long double, so their difference is rounded once. */
		const long double exact = (long double)a * (long double)b - (long double)c * (long double)d;
		const float naive = a * b - c * d;
		worst = larger(worst, test_ulp(lobe_diff_of_products(a, b, c, d), (double)exact));
		worst_naive = larger(worst_naive, test_ulp(naive, (double)exact));
	}
	measured("diff_of_products: ulp (Jeannerod et al. 2013)", worst, 1.5);
	printf("  %-56s %11.4g\n", "a*b - c*d on the same numbers: ulp", worst_naive);
	TEST_ASSERT_TRUE_MESSAGE(worst_naive > 1000.0, "the numbers do not cancel");
}

static void test_cross(void)
{
	double worst = 0.0;
	for (uint64_t i = 0; i < VECTOR_CASES / 4; i++) {
		const lobe_vec3 a = random_direction(15, i);
		/* Down to an angle of 1e-6 between the two. */
		const float near = ldexpf(1.0f, -(int)(i % 21));
		const lobe_vec3 b = lobe_vec3_fma(near, random_direction(16, i), a);
		const lobe_vec3 n = lobe_cross(a, b);
		const double size = length(n);
		if (size > 0.0)
			worst = larger(worst, larger(fabs((double)dot_exact(a, n)),
						     fabs((double)dot_exact(b, n)) / length(b)) /
						      size);
	}
	/* 1.5 ulp <= 3 U of each component: |n.a| <= 3 U sum |n_i a_i| <= 3 U |n| |a|. */
	measured("cross: |cos| of the angle to its factors", worst, 3.01 * U);
}

static void test_normalize(void)
{
	double worst = 0.0, worst_direction = 0.0;
	for (uint64_t i = 0; i < VECTOR_CASES / 2; i++) {
		const double size = pow(10.0, 36.0 * (double)test_uniform(17, i) - 18.0);
		const lobe_vec3 d = random_direction(18, i);
		const lobe_vec3 v = lobe_vec3_scale(d, (float)size);
		const lobe_vec3 n = lobe_normalize(v);
		const double len = length(v);
		if (len <= 1e-18 || len >= 1e18)
			continue;
		const lobe_vec3 exact = {(float)((double)v.x / len), (float)((double)v.y / len),
					 (float)((double)v.z / len)};
		worst = larger(worst, fabs(length(n) - 1.0));
		worst_direction = larger(worst_direction, distance(n, exact));
	}
	/* The square of the length is off by 3 U, its root by half of that and a rounding; then the division and the
	 * product: 4.5 U. Comparing with rounded components adds one more. */
	measured("normalize: | |v| - 1 |", worst, 4.6 * U);
	measured("normalize: distance to the rounded exact vector", worst_direction, 5.6 * U);
}

static void test_small_vector_functions(void)
{
	const lobe_vec3 a = {1.0f, -2.0f, 3.0f}, b = {0.5f, 0.25f, -8.0f};
	const lobe_vec3 sum = lobe_vec3_add(a, b), scaled = lobe_vec3_scale(a, -2.0f),
			fused = lobe_vec3_fma(2.0f, a, b);
	TEST_ASSERT_TRUE(sum.x == 1.5f && sum.y == -1.75f && sum.z == -5.0f);
	TEST_ASSERT_TRUE(scaled.x == -2.0f && scaled.y == 4.0f && scaled.z == -6.0f);
	TEST_ASSERT_TRUE(fused.x == 2.5f && fused.y == -3.75f && fused.z == -2.0f);
	const lobe_rgb c = lobe_rgb_scale(lobe_rgb_make(1.0f, 2.0f, 4.0f), 0.5f);
	TEST_ASSERT_TRUE(c.r == 0.5f && c.g == 1.0f && c.b == 2.0f);
}

static int same(float x, float y) { return (isnan(x) && isnan(y)) || test_float_bits(x) == test_float_bits(y); }

static void test_selects(void)
{
	TEST_ASSERT_TRUE(lobe_min(1.0f, 2.0f) == 1.0f && lobe_min(2.0f, 1.0f) == 1.0f);
	TEST_ASSERT_TRUE(lobe_max(1.0f, 2.0f) == 2.0f && lobe_max(2.0f, 1.0f) == 2.0f);
	TEST_ASSERT_TRUE(lobe_min(-INFINITY, FLT_MAX) == -INFINITY && lobe_max(INFINITY, FLT_MAX) == INFINITY);

	TEST_ASSERT_TRUE(lobe_clamp(-INFINITY, -1.0f, 2.0f) == -1.0f && lobe_clamp(INFINITY, -1.0f, 2.0f) == 2.0f);
	TEST_ASSERT_TRUE(lobe_clamp(0.5f, -1.0f, 2.0f) == 0.5f);
	TEST_ASSERT_TRUE(lobe_clamp(-1.0f, -1.0f, 2.0f) == -1.0f && lobe_clamp(2.0f, -1.0f, 2.0f) == 2.0f);
	TEST_ASSERT_TRUE_MESSAGE(isnan(lobe_clamp(NAN, -1.0f, 2.0f)), "clamp must keep a NaN for the host to refuse");

	const float kept[] = {0.0f, 0x1p-149f, 0x1p-126f, 1.0f, FLT_MAX};
	for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
		TEST_ASSERT_TRUE(same(lobe_finite_or_zero(kept[i]), kept[i]));
	const float zeroed[] = {NAN, -NAN, INFINITY, -INFINITY, -0x1p-149f, -1.0f, -FLT_MAX};
	for (size_t i = 0; i < sizeof zeroed / sizeof zeroed[0]; i++)
		TEST_ASSERT_EQUAL_HEX32(0, test_float_bits(lobe_finite_or_zero(zeroed[i])));
	TEST_ASSERT_TRUE(lobe_finite_or_zero(-0.0f) == 0.0f);
	const lobe_rgb c = lobe_rgb_finite_or_zero(lobe_rgb_make(NAN, 2.0f, -INFINITY));
	TEST_ASSERT_TRUE(c.r == 0.0f && c.g == 2.0f && c.b == 0.0f);
}

static void test_sample_selects(void)
{
	const lobe_vec3 w = {0.6f, 0.0f, 0.8f};
	const lobe_rgb weight = {1.0f, 0.5f, 0.25f};
	const lobe_sample yes = lobe_sample_select(1, w, weight, 3.0f, LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY);
	TEST_ASSERT_TRUE(yes.wi.x == 0.6f && yes.wi.y == 0.0f && yes.wi.z == 0.8f);
	TEST_ASSERT_TRUE(yes.weight.r == 1.0f && yes.weight.g == 0.5f && yes.weight.b == 0.25f && yes.pdf == 3.0f);
	TEST_ASSERT_EQUAL_UINT32(LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY, yes.event);
	/* What is not taken may be anything. */
	const lobe_vec3 bad = {NAN, INFINITY, -NAN};
	const lobe_rgb bad_weight = {NAN, -INFINITY, NAN};
	const lobe_sample no = lobe_sample_select(0, bad, bad_weight, NAN, 0xffffffffu);
	const lobe_sample none = lobe_sample_none();
	TEST_ASSERT_EQUAL_MEMORY(&none, &no, sizeof none);
	const unsigned char zeros[sizeof none] = {0};
	TEST_ASSERT_EQUAL_MEMORY(zeros, &none, sizeof none);
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

#define FRAME_CASES 1000000u

/* How far a frame is from orthonormal and right-handed, and the round trip of a direction through it. */
typedef struct {
	double length, cosine, handed, round_trip;
} frame_error;

static void frame_worst(frame_error *e, lobe_frame f, lobe_vec3 v)
{
	e->length = larger(e->length, fabs((double)(dot_exact(f.t, f.t) - 1.0L)));
	e->length = larger(e->length, fabs((double)(dot_exact(f.b, f.b) - 1.0L)));
	e->cosine = larger(e->cosine, fabs((double)dot_exact(f.t, f.b)));
	e->cosine = larger(e->cosine, fabs((double)dot_exact(f.t, f.n)));
	e->cosine = larger(e->cosine, fabs((double)dot_exact(f.b, f.n)));
	e->handed = larger(e->handed, distance(lobe_cross(f.t, f.b), f.n));
	e->round_trip = larger(e->round_trip, distance(lobe_frame_to_world(f, lobe_frame_to_local(f, v)), v));
}

/* Normals are rounded to floats, so |n|^2 = 1 + d with |d| <= 2 U. In exact arithmetic t.n = -nx d/(1+|nz|), t.t = 1 +
 * d nx^2/(1+|nz|)^2 and t.b = nx ny d/(1+|nz|)^2: at most 2 U. Rounding moves t and b by at most 4 U each, as vectors
 * (a = -1/(s+nz) is off by 2 U, b by 4 U, 1 + s nx^2 a by 3 U + 1 U): 8 U in t.t and t.b, less in t.n. Sum: 10 U.
 * The cross product moves by 4 U + 4 U, by d, and by its own 3 U. The round trip is off by M^T M - I, 3 elements of 10
 * U in each row, and by the two sums of three products, 3 U sqrt(3) each. */
static void frame_measured(const char *which, frame_error e)
{
	char what[80];
	snprintf(what, sizeof what, "%s: |t|^2, |b|^2 - 1", which);
	measured(what, e.length, 10.0 * U);
	snprintf(what, sizeof what, "%s: t.b, t.n, b.n", which);
	measured(what, e.cosine, 10.0 * U);
	snprintf(what, sizeof what, "%s: |t x b - n|", which);
	measured(what, e.handed, 13.0 * U);
	snprintf(what, sizeof what, "%s: |to_world(to_local(v)) - v|", which);
	measured(what, e.round_trip, 40.4 * U);
}

static void test_frame_random(void)
{
	frame_error e = {0.0, 0.0, 0.0, 0.0};
	for (uint64_t i = 0; i < FRAME_CASES; i++)
		frame_worst(&e, lobe_frame_from_normal(random_direction(20, i)), random_direction(21, i));
	frame_measured("frame, random normals", e);
}

/* Where a frame built the obvious way is singular: n.z near -1, and near the jump at 0. */
static void test_frame_singular(void)
{
	frame_error down = {0.0, 0.0, 0.0, 0.0}, level = {0.0, 0.0, 0.0, 0.0};
	for (uint64_t i = 0; i < FRAME_CASES / 2; i++) {
		const double phi = TWO_PI * (double)test_uniform(22, i);
		const double sine = pow(10.0, -9.0 * (double)test_uniform(23, i));
		const double cosine = sqrt((1.0 - sine) * (1.0 + sine));
		const lobe_vec3 n = {(float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)-cosine};
		frame_worst(&down, lobe_frame_from_normal(n), random_direction(24, i));
		const lobe_vec3 m = {(float)(cosine * cos(phi)), (float)(cosine * sin(phi)),
				     (float)(i & 1 ? sine : -sine)};
		frame_worst(&level, lobe_frame_from_normal(m), random_direction(24, i));
	}
	const lobe_vec3 exact[] = {{0.0f, 0.0f, 1.0f},  {0.0f, 0.0f, -1.0f}, {1.0f, 0.0f, 0.0f},
				   {1.0f, 0.0f, -0.0f}, {0.0f, -1.0f, 0.0f}, {0x1p-149f, 0.0f, -1.0f}};
	for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++)
		frame_worst(&down, lobe_frame_from_normal(exact[i]), random_direction(25, i));
	frame_measured("frame, n.z near -1", down);
	frame_measured("frame, n.z near 0", level);
	/* The frame of the shading frame's own normal is the frame itself. */
	const lobe_frame f = lobe_frame_from_normal(lobe_vec3_make(0.0f, 0.0f, 1.0f));
	TEST_ASSERT_TRUE(f.t.x == 1.0f && f.t.y == 0.0f && f.t.z == 0.0f);
	TEST_ASSERT_TRUE(f.b.x == 0.0f && f.b.y == 1.0f && f.b.z == 0.0f);
}

/* The measure must see a frame that is off by little: 1e-5 in one component of the tangent, and a mirrored one. */
static void test_frame_planted(void)
{
	frame_error tilted = {0.0, 0.0, 0.0, 0.0}, mirrored = {0.0, 0.0, 0.0, 0.0};
	lobe_frame f = lobe_frame_from_normal(random_direction(26, 0));
	f.t.x += 1e-5f;
	frame_worst(&tilted, f, random_direction(26, 1));
	TEST_ASSERT_TRUE(tilted.cosine > 10.0 * U || tilted.length > 10.0 * U);
	f = lobe_frame_from_normal(random_direction(26, 0));
	f.b = lobe_vec3_scale(f.b, -1.0f);
	frame_worst(&mirrored, f, random_direction(26, 1));
	TEST_ASSERT_TRUE(mirrored.length <= 10.0 * U && mirrored.handed > 13.0 * U);
}

static void test_frame_tangent(void)
{
	frame_error e = {0.0, 0.0, 0.0, 0.0};
	double off_plane = 0.0, least_along = 1.0;
	for (uint64_t i = 0; i < FRAME_CASES / 2; i++) {
		const lobe_vec3 n = random_direction(27, i);
		/* Any length in the domain, down to an angle of 1e-6 to the normal. */
		const float near = ldexpf(1.0f, -(int)(i % 21));
		const float size = (float)pow(10.0, 18.0 * (double)test_uniform(28, i) - 9.0);
		const lobe_vec3 t = lobe_vec3_scale(
			lobe_vec3_fma(near, random_direction(29, i), i & 1 ? n : lobe_vec3_make(0, 0, 0)), size);
		const double len = length(t);
		if (len < 1e-9 || len > 1e9 || (double)(dot_exact(n, t) * dot_exact(n, t)) > len * len * (1.0 - 1e-12))
			continue;
		const lobe_frame f = lobe_frame_from_normal_tangent(n, t);
		frame_worst(&e, f, random_direction(30, i));
		off_plane = larger(off_plane, fabs((double)dot_exact(f.b, t)) / len);
		const double along = (double)dot_exact(f.t, t) / len;
		least_along = along < least_along ? along : least_along;
	}
	/* b is a cross product (3 U of each component) times a rounded factor (1 U more), so b.n and b.t are at most 4
	 * U; its length is off by those 4 U and by the 4.5 U of normalising. t = b x n inherits 8.5 U, with 1 U of |n|
	 * and 3 U of its own: twice 12.5 U in |t|^2. */
	measured("tangent frame: |t|^2, |b|^2 - 1", e.length, 25.0 * U);
	measured("tangent frame: t.b, t.n, b.n", e.cosine, 4.1 * U);
	measured("tangent frame: |t x b - n|", e.handed, 25.0 * U);
	measured("tangent frame: |to_world(to_local(v)) - v|", e.round_trip, (25.0 + 2.0 * 4.1 + 10.4) * U);
	measured("tangent frame: b.tangent", off_plane, 4.1 * U);
	/* The nearest direction in the plane is on the side of the given tangent. */
	measured("tangent frame: -t.tangent", -least_along, 0.0);
	const lobe_frame f =
		lobe_frame_from_normal_tangent(lobe_vec3_make(0.0f, 0.0f, 1.0f), lobe_vec3_make(0.0f, 2.0f, 5.0f));
	TEST_ASSERT_TRUE(f.t.x == 0.0f && f.t.y == 1.0f && f.t.z == 0.0f);
	TEST_ASSERT_TRUE(f.b.x == -1.0f && f.b.y == 0.0f && f.b.z == 0.0f);
}

/* From 2^-120 to 4, both ends of each power of 4 included; at 0 next to nothing. Planted: a constant
 * that is a little less. */
static void test_sqrt_above(void)
{
	double most = 0.0, least = 2.0, planted = 2.0;
	for (int e = -120; e < 2; e++)
		for (uint64_t i = 0; i < 1000u; i++) {
			const float x = ldexpf(1.0f + (float)i / 1000.0f, e);
			const double ratio = (double)lobe_sqrt_above(x) / sqrt((double)x);
			most = fmax(most, ratio);
			least = fmin(least, ratio);
			planted = fmin(planted,
				       (double)lobe_from_bits((lobe_to_bits(x) >> 1) + 0x1fbff000u) / sqrt((double)x));
		}
	printf("  lobe_sqrt_above: the root times %.6f to %.6f; planted %.9f\n", least, most, planted);
	TEST_ASSERT_TRUE(least >= 1.0 - 2.0 * U && most < 1.0 + 1.0 / 16.0 && planted < 1.0 - 1e-4);
	TEST_ASSERT_TRUE(lobe_sqrt_above(0.0f) < 1e-19f && lobe_sqrt_above(0x1p-149f) < 1e-19f);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_dot);
	RUN_TEST(test_diff_of_products);
	RUN_TEST(test_cross);
	RUN_TEST(test_normalize);
	RUN_TEST(test_small_vector_functions);
	RUN_TEST(test_sqrt_above);
	RUN_TEST(test_selects);
	RUN_TEST(test_sample_selects);
	RUN_TEST(test_frame_random);
	RUN_TEST(test_frame_singular);
	RUN_TEST(test_frame_planted);
	RUN_TEST(test_frame_tangent);
	return UNITY_END();
}
