/* test_real.c - core/real.h against MPFR: every error stays within the bound that the header states. */
#include "real_reference.h"

#include "unity.h"

#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

#define SAMPLES    100000u
#define NEIGHBOURS 400
#define BATCH      256u

static mpfr_t exact;
static uint64_t random_state;

static uint32_t random_bits(void)
{
	/* Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators". */
	uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
	z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
	z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
	return (uint32_t)(z >> 32);
}

static float float_of(uint32_t bits)
{
	float x;
	memcpy(&x, &bits, sizeof x);
	return x;
}

static uint32_t bits_of(float x)
{
	uint32_t bits;
	memcpy(&bits, &x, sizeof bits);
	return bits;
}

/* Uniform in [lo, hi). */
static float random_between(double lo, double hi) { return (float)(lo + (hi - lo) * random_bits() * 0x1p-32); }

static int same_bits(float a, float b) { return bits_of(a) == bits_of(b); }

typedef struct {
	const real_function *function;
	double worst;
	float at;
	float x[BATCH];
	uint32_t count;
} check;

static void check_batch(check *c)
{
	float got[BATCH];
	c->function->row(c->count, c->x, got);
	for (uint32_t i = 0; i < c->count; i++) {
		c->function->exact(exact, c->x[i]);
		const double ulp = ulp_error(got[i], exact);
		if (ulp > c->worst) {
			c->worst = ulp;
			c->at = c->x[i];
		}
	}
	c->count = 0;
}

static void check_at(check *c, float x)
{
	c->x[c->count++] = x;
	if (c->count == BATCH)
		check_batch(c);
}

/* The floats around x and -x, in steps that grow away from them. */
static void check_around(check *c, float x)
{
	const uint32_t centre = bits_of(x) & 0x7fffffffu;
	uint32_t distance = 0;
	for (int i = 0; i < NEIGHBOURS; i++) {
		check_at(c, float_of(centre + distance));
		check_at(c, float_of(centre - distance));
		check_at(c, float_of((centre + distance) ^ 0x80000000u));
		check_at(c, float_of((centre - distance) ^ 0x80000000u));
		distance += i < NEIGHBOURS / 2 ? 1 : 1 + random_bits() % 64;
	}
}

static void check_function(const real_function *function)
{
	/* Ends of domains, zeros, quadrants, and where the functions change their formula, overflow or underflow. */
	static const float special[] = {
		0.0f,
		0x1p-149f,
		0x1p-126f,
		0x1p-24f,
		0x1p-13f,
		0x1p-12f,
		0.125f,
		0.25f,
		0.375f,
		0.5f,
		0.625f,
		0.75f,
		0.875f,
		1.0f,
		1.5f,
		2.0f,
		2.236068f,
		3.0f,
		4.0f,
		5.0f,
		0.70710678f,
		1.41421356f,
		0.99663f,
		0.78539816f,
		1.57079633f,
		3.14159265f,
		4.7123890f,
		6.2831853f,
		88.722839f,
		87.336545f,
		103.97208f,
		126.0f,
		128.0f,
		149.0f,
		150.0f,
		1048576.0f,
		4194304.0f,
		8388608.0f,
		16777216.0f,
		0x1p64f,
		16367173.0f * 0x1p72f, /* the float that comes nearest to a multiple of pi/2 */
		0x1.fffffep127f,
	};
	check c = {function, 0, 0, {0}, 0};
	for (size_t i = 0; i < sizeof special / sizeof *special; i++)
		check_around(&c, special[i]);
	check_at(&c, float_of(0x7f800000u));
	check_at(&c, float_of(0xff800000u));
	check_at(&c, float_of(0x7fc00000u));
	for (uint32_t i = 0; i < SAMPLES; i++) {
		check_at(&c, float_of(random_bits()));
		check_at(&c, random_between(-1, 1));
	}
	for (uint32_t i = 0; i < SAMPLES / 4; i++)
		check_at(&c, random_between(-160, 160));
	check_batch(&c);
	char message[160];
	snprintf(message, sizeof message, "%s: %.4f ulp at %a, %.2f allowed", function->name, c.worst, (double)c.at,
		 function->bound);
	TEST_ASSERT_TRUE_MESSAGE(c.worst <= function->bound, message);
}

static void test_one_argument_stays_within_bound(void)
{
	for (size_t i = 0; i < REAL_FUNCTION_COUNT; i++)
		check_function(&real_functions[i]);
}

static void exact_atan2(mpfr_t v, float y, float x)
{
	mpfr_t other;
	mpfr_init2(other, REFERENCE_BITS);
	mpfr_set_flt(v, y, MPFR_RNDN);
	mpfr_set_flt(other, x, MPFR_RNDN);
	mpfr_atan2(v, v, other, MPFR_RNDN);
	mpfr_clear(other);
}

static void exact_pow(mpfr_t v, float x, float y)
{
	mpfr_t other;
	mpfr_init2(other, REFERENCE_BITS);
	mpfr_set_flt(v, x, MPFR_RNDN);
	mpfr_set_flt(other, y, MPFR_RNDN);
	mpfr_pow(v, v, other, MPFR_RNDN);
	mpfr_clear(other);
}

typedef struct {
	double ulp;
	float a, b;
} worst_pair;

static void keep_worst(worst_pair *w, double ulp, float a, float b)
{
	if (ulp > w->ulp) {
		w->ulp = ulp;
		w->a = a;
		w->b = b;
	}
}

static void assert_pair(const char *name, worst_pair w, double bound)
{
	char message[160];
	snprintf(message, sizeof message, "%s: %.4f ulp at (%a, %a), %.2f allowed", name, w.ulp, (double)w.a,
		 (double)w.b, bound);
	TEST_ASSERT_TRUE_MESSAGE(w.ulp <= bound, message);
}

static const float extremes[] = {0.0f, 0x1p-149f,      0x1p-126f,      0x1.fffffcp-127f, 0x1p-60f,
				 0.5f, 0x1.fffffep-1f, 1.0f,           0x1.000002p0f,    2.0f,
				 3.0f, 0x1p60f,        0x1.fffffep127f};
#define EXTREMES (sizeof extremes / sizeof *extremes)

static void check_atan2(worst_pair *w, float y, float x)
{
	exact_atan2(exact, y, x);
	keep_worst(w, ulp_error(lobe_atan2(y, x), exact), y, x);
}

static void test_atan2_stays_within_bound(void)
{
	worst_pair w = {0, 0, 0};
	for (size_t i = 0; i < EXTREMES; i++)
		for (size_t k = 0; k < EXTREMES; k++)
			for (int signs = 0; signs < 4; signs++)
				check_atan2(&w, signs & 1 ? -extremes[i] : extremes[i],
					    signs & 2 ? -extremes[k] : extremes[k]);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		check_atan2(&w, random_between(-1, 1), random_between(-1, 1));
		/* Close exponents, or all of them. */
		const uint32_t y = random_bits();
		const uint32_t x = i & 1 ? random_bits() : y ^ (random_bits() & 0x81ffffffu);
		if (isfinite(float_of(x)) && isfinite(float_of(y)))
			check_atan2(&w, float_of(y), float_of(x));
	}
	assert_pair("atan2", w, REAL_ATAN2_BOUND);
}

static void check_pow(worst_pair *w, float x, float y)
{
	exact_pow(exact, x, y);
	keep_worst(w, ulp_error(lobe_pow(x, y), exact), x, y);
}

static void test_pow_stays_within_bound(void)
{
	worst_pair w = {0, 0, 0};
	for (size_t i = 0; i < EXTREMES; i++)
		for (size_t k = 0; k < EXTREMES; k++)
			for (int sign = -1; sign <= 1; sign += 2)
				check_pow(&w, extremes[i], (float)sign * extremes[k]);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		check_pow(&w, random_between(0, 4), random_between(-20, 20));
		/* Any x, and y such that the result lies between 2^-152 and 2^130; near 1 that makes y large. */
		const float near_1 = 1.0f + random_between(-1, 1) * float_of((127u - random_bits() % 24u) << 23);
		const float x = i & 1 ? float_of(random_bits() & 0x7fffffffu) : near_1;
		if (x > 0 && isfinite(x) && x != 1.0f)
			check_pow(&w, x, (float)((-152 + 282 * (double)random_bits() * 0x1p-32) / log2((double)x)));
	}
	assert_pair("pow", w, REAL_POW_BOUND);
}

static void test_special_values(void)
{
	const float inf = float_of(0x7f800000u);
	const float nan = float_of(0x7fc00000u);
	TEST_ASSERT_TRUE(same_bits(lobe_sin(-0.0f), -0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_tan(-0.0f), -0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_asin(-0.0f), -0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_atan(-0.0f), -0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_erf(-0.0f), -0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_erfinv(-0.0f), -0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_acos(1.0f), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_log(1.0f), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_log2(1.0f), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_log(0.0f), -inf));
	TEST_ASSERT_TRUE(same_bits(lobe_log2(-0.0f), -inf));
	TEST_ASSERT_TRUE(same_bits(lobe_log2(0x1p-149f), -149.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_exp(0.0f), 1.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_exp(-inf), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_exp2(-149.0f), 0x1p-149f));
	TEST_ASSERT_TRUE(same_bits(lobe_exp2(128.0f), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_erf(inf), 1.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_erfinv(1.0f), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_erfinv(-1.0f), -inf));
	for (int quarter = -9; quarter <= 9; quarter++) {
		const lobe_sincos r = lobe_sincos_2pi(0.25f * (float)quarter);
		static const float sines[] = {0, 1, 0, -1};
		TEST_ASSERT_TRUE(r.s == sines[quarter & 3] && r.c == sines[(quarter + 1) & 3]);
	}

	/* A NaN, or what is outside the domain, gives the one NaN. */
	const float bad[] = {nan, float_of(0xffc00001u)};
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		const float x = bad[i];
		const float results[] = {
			lobe_sin(x),         lobe_cos(x),         lobe_tan(x),       lobe_asin(x),
			lobe_acos(x),        lobe_atan(x),        lobe_exp(x),       lobe_exp2(x),
			lobe_log(x),         lobe_log2(x),        lobe_erf(x),       lobe_erfinv(x),
			lobe_atan2(x, 1.0f), lobe_atan2(1.0f, x), lobe_pow(x, 2.0f), lobe_pow(2.0f, x)};
		for (size_t k = 0; k < sizeof results / sizeof *results; k++)
			TEST_ASSERT_TRUE(same_bits(results[k], nan));
		TEST_ASSERT_TRUE(isnan(lobe_sincos_2pi(x).s) && isnan(lobe_sincos_2pi(x).c));
	}
	const float outside[] = {lobe_sin(inf),         lobe_cos(-inf),       lobe_tan(inf),   lobe_asin(0x1.000002p0f),
				 lobe_acos(-2.0f),      lobe_log(-0x1p-149f), lobe_log2(-inf), lobe_erfinv(1.5f),
				 lobe_pow(-2.0f, 2.0f), lobe_pow(-inf, 1.0f)};
	for (size_t k = 0; k < sizeof outside / sizeof *outside; k++)
		TEST_ASSERT_TRUE(same_bits(outside[k], nan));
}

static void test_atan2_special_values(void)
{
	const float inf = float_of(0x7f800000u);
	const float values[] = {0.0f, -0.0f, 1.0f, -1.0f, inf, -inf};
	/* C99's own atan2, rounded: the two agree in every bit, pi/4 included. */
	for (size_t i = 0; i < sizeof values / sizeof *values; i++)
		for (size_t k = 0; k < sizeof values / sizeof *values; k++)
			TEST_ASSERT_TRUE(same_bits(lobe_atan2(values[i], values[k]),
						   (float)atan2((double)values[i], (double)values[k])));
}

static void test_pow_special_values(void)
{
	const float inf = float_of(0x7f800000u);
	const float nan = float_of(0x7fc00000u);
	const float any[] = {0.0f, 0x1p-149f, 0.5f, 1.0f, 2.0f, 0x1.fffffep127f, inf, nan, -3.0f, -inf};
	for (size_t i = 0; i < sizeof any / sizeof *any; i++) {
		TEST_ASSERT_TRUE(same_bits(lobe_pow(any[i], 0.0f), 1.0f));
		TEST_ASSERT_TRUE(same_bits(lobe_pow(any[i], -0.0f), 1.0f));
		TEST_ASSERT_TRUE(same_bits(lobe_pow(1.0f, any[i]), 1.0f));
		if (any[i] >= 0) {
			TEST_ASSERT_TRUE(same_bits(lobe_pow(any[i], 1.0f), any[i]));
		}
	}
	TEST_ASSERT_TRUE(same_bits(lobe_pow(0.0f, 2.5f), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(-0.0f, 3.0f), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(0.0f, -2.5f), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(inf, 0.5f), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(inf, -0.5f), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(0.5f, inf), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(0.5f, -inf), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(2.0f, inf), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(2.0f, -inf), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(0.0f, inf), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(0.0f, -inf), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(inf, inf), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(inf, -inf), 0.0f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(2.0f, 0x1.fffffep127f), inf));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(2.0f, -149.0f), 0x1p-149f));
	TEST_ASSERT_TRUE(same_bits(lobe_pow(3.0f, 4.0f), 81.0f));
}

/* What the tests above rest on: a result three floats off is seen, at every size of result, and so are wrong
 * infinities, NaN and zeros. */
static void test_measure_catches_a_planted_error(void)
{
	const float arguments[] = {-100.0f, -87.5f, -1.0f, 0.0f, 1.0f, 88.0f};
	for (size_t i = 0; i < sizeof arguments / sizeof *arguments; i++) {
		exact_exp(exact, arguments[i]);
		const float right = lobe_exp(arguments[i]);
		const float wrong = float_of(bits_of(right) + 3u);
		TEST_ASSERT_TRUE(ulp_error(right, exact) <= 1.5);
		TEST_ASSERT_TRUE(ulp_error(wrong, exact) > 2.0);
		const double in_double = exp((double)arguments[i]);
		TEST_ASSERT_TRUE(fabs(ulp_error(wrong, exact) - ulp_error_double(wrong, in_double)) < 1e-6);
	}
	exact_exp(exact, 88.0f);
	TEST_ASSERT_TRUE(ulp_error(HUGE_VALF, exact) > 1e6);
	TEST_ASSERT_TRUE(ulp_error(float_of(0x7fc00000u), exact) > 1e6);
	exact_exp(exact, 89.0f);
	TEST_ASSERT_TRUE(ulp_error(HUGE_VALF, exact) == 0.0);
	TEST_ASSERT_TRUE(ulp_error(0x1.fffffep127f, exact) > 1e6);
	exact_sin_2pi(exact, 0.5f);
	TEST_ASSERT_TRUE(ulp_error(0x1p-140f, exact) > 100.0);
}

int main(void)
{
	mpfr_init2(exact, REFERENCE_BITS);
	UNITY_BEGIN();
	RUN_TEST(test_one_argument_stays_within_bound);
	RUN_TEST(test_atan2_stays_within_bound);
	RUN_TEST(test_pow_stays_within_bound);
	RUN_TEST(test_special_values);
	RUN_TEST(test_atan2_special_values);
	RUN_TEST(test_pow_special_values);
	RUN_TEST(test_measure_catches_a_planted_error);
	const int failed = UNITY_END();
	mpfr_clear(exact);
	mpfr_free_cache();
	return failed != 0;
}
