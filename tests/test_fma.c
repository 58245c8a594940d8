/* test_fma.c - lobe_fma of backend/c99.h: the emulation of fmaf, by itself and in chains. */

/* The emulation of fmaf is what is tested, also where the compiler was told that the processor has the instruction. */
#undef __FP_FAST_FMAF
#undef __FMA__
#undef __ARM_FEATURE_FMA

#include "lobe/core/vec.h"

#include "support.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

#define FMA_CASES 3000000u

typedef struct {
	float a, b, c;
} fma_case;

static int same(float x, float y) { return (isnan(x) && isnan(y)) || test_float_bits(x) == test_float_bits(y); }

/* What one would write first: right but where the rounding to double makes a tie of what is none. */
static float fma_naive(float a, float b, float c) { return (float)((double)a * (double)b + (double)c); }

static uint32_t naive_failures;

static void check_fma(fma_case k)
{
	const float expected = fmaf(k.a, k.b, k.c);
	const float got = lobe_fma(k.a, k.b, k.c);
	if (!same(expected, got)) {
		char message[160];
		snprintf(message, sizeof message, "fma(%a, %a, %a) = %a, expected %a", (double)k.a, (double)k.b,
			 (double)k.c, (double)got, (double)expected);
		TEST_FAIL_MESSAGE(message);
	}
	naive_failures += !same(expected, fma_naive(k.a, k.b, k.c));
}

/* Each case with every sign, since rounding to odd moves bits by the signs of sum and error. */
static void check_fma_signs(fma_case k)
{
	for (int signs = 0; signs < 8; signs++) {
		const fma_case s = {signs & 1 ? -k.a : k.a, signs & 2 ? -k.b : k.b, signs & 4 ? -k.c : k.c};
		check_fma(s);
	}
}

static void test_fma_random_bits(void)
{
	for (uint32_t i = 0; i < FMA_CASES; i++) {
		const fma_case k = {test_float_of_bits(test_bits(1, 3 * (uint64_t)i)),
				    test_float_of_bits(test_bits(1, 3 * (uint64_t)i + 1)),
				    test_float_of_bits(test_bits(1, 3 * (uint64_t)i + 2))};
		check_fma(k);
	}
	/* Random exponents seldom meet: here those of product and addend are within 60 of each other, so that the sum
	 * cancels, carries and rounds in every way, down to subnormal results and up to overflow. */
	for (uint32_t i = 0; i < FMA_CASES; i++) {
		const uint32_t e = test_bits(2, i);
		const int ea = (int)(e & 0xffu) - 128, eb = (int)(e >> 8 & 0xffu) - 128;
		const int ec = ea + eb + (int)(e >> 16 & 0xffu) % 121 - 60;
		const float ma = test_float_of_bits(0x3f800000u | test_bits(3, 3 * (uint64_t)i) >> 9);
		const float mb = test_float_of_bits(0x3f800000u | test_bits(3, 3 * (uint64_t)i + 1) >> 9);
		const float mc = test_float_of_bits(0x3f800000u | test_bits(3, 3 * (uint64_t)i + 2) >> 9);
		const fma_case k = {ldexpf(ma, ea), ldexpf(mb, eb), ldexpf(e >> 31 ? mc : -mc, ec)};
		check_fma(k);
	}
}

/* Sums a hair away from the middle between two floats, where a second rounding goes wrong. */
static void test_fma_near_ties(void)
{
	naive_failures = 0;
	for (uint32_t i = 0; i < FMA_CASES / 8; i++) {
		const uint32_t r = test_bits(4, i);
		/* A product within 2^-24 of half an ulp of c: b is the float nearest to half/a, or a neighbour. */
		const float c = test_float_of_bits(0x3f800000u | test_bits(5, i) >> 9);
		const float a = test_float_of_bits(0x3f800000u | r >> 9);
		const float b = test_float_of_bits(test_float_bits(0x1p-24f / a) + r % 3u - 1u);
		const fma_case half_ulp = {a, b, c};
		check_fma_signs(half_ulp);
		/* The same at the bottom: c subnormal, half an ulp of it is 2^-150 = (a 2^-75)(b 2^-51). */
		const fma_case subnormal = {a * 0x1p-75f, b * 0x1p-51f, test_float_of_bits(r & 0x7fffffu)};
		check_fma_signs(subnormal);
		/* A product that is a tie by itself (25 bits, the last one set) and an addend too small for a double to
		 * see, or for the sum to be exact in one. */
		const float whole_a = (float)(4097u + 2u * (r & 0x7ffu)),
			    whole_b = (float)(4097u + 2u * (r >> 16 & 0x7ffu));
		const fma_case tie = {whole_a, whole_b, ldexpf(c, -30 - (int)(r >> 28) * 7)};
		check_fma_signs(tie);
	}
	printf("  %-56s %11u of %u\n", "near ties: (float)((double)a*b + c) is wrong in", naive_failures,
	       FMA_CASES / 8 * 24);
	/* It must be wrong in some, or these cases prove nothing about the emulation. */
	TEST_ASSERT_GREATER_THAN_MESSAGE(100, naive_failures, "the near ties do not catch the naive form");
}

static void test_fma_special(void)
{
	const float values[] = {0.0f,
				0x1p-149f,
				0x1.8p-149f,
				0x1.fffffcp-127f,
				0x1p-126f,
				0x1.000002p-126f,
				0x1p-75f,
				0x1p-24f,
				0x1.fffffep-1f,
				1.0f,
				0x1.000002p+0f,
				0x1.fffffep+0f,
				2.0f,
				0x1.fffffep+63f,
				0x1p+64f,
				0x1.000002p+64f,
				0x1p+102f,
				0x1p+103f,
				0x1.000002p+103f,
				0x1.fffffcp+127f,
				FLT_MAX,
				INFINITY,
				NAN};
	const size_t n = sizeof values / sizeof values[0];
	for (size_t i = 0; i < n; i++) {
		for (size_t j = 0; j < n; j++) {
			for (size_t l = 0; l < n; l++) {
				const fma_case k = {values[i], values[j], values[l]};
				check_fma_signs(k);
			}
		}
	}
	/* The sum FLT_MAX + half an ulp overflows, a hair less does not. */
	TEST_ASSERT_TRUE(isinf(lobe_fma(0x1p+51f, 0x1p+52f, FLT_MAX)));
	TEST_ASSERT_TRUE(lobe_fma(0x1.fffffep+50f, 0x1p+52f, FLT_MAX) == FLT_MAX);
}

/* --- chains of fma in scalar code --------------------------------------------------------------------------------- */

/* A point moved along a ray, and the direction from c to it: what a renderer does with the vectors. Not inlined, so
 * that the compiler meets the components side by side, as in the function where the fault was found. */
__attribute__((noinline)) static lobe_vec3 chained(float d, lobe_vec3 along, lobe_vec3 o, lobe_vec3 c)
{
	const lobe_vec3 p = lobe_vec3_fma(d, along, o);
	return lobe_vec3_add(c, lobe_normalize(lobe_vec3_fma(-1.0f, c, p)));
}

/* A float that has been in memory, so that it is one. */
static float rounded(float x)
{
	volatile float memory = x;
	return memory;
}

static lobe_vec3 rounded_vec3(lobe_vec3 v) { return lobe_vec3_make(rounded(v.x), rounded(v.y), rounded(v.z)); }

static lobe_vec3 chained_by_steps(float d, lobe_vec3 along, lobe_vec3 o, lobe_vec3 c)
{
	const lobe_vec3 p = rounded_vec3(lobe_vec3_fma(d, along, o));
	const lobe_vec3 v = rounded_vec3(lobe_vec3_fma(-1.0f, c, p));
	const float length = rounded(sqrtf(rounded(lobe_dot(v, v))));
	return lobe_vec3_add(c, rounded_vec3(lobe_vec3_scale(v, rounded(1.0f / length))));
}

/* gcc 12 at -O2 dropped roundings between the emulated fma of neighbouring components; see backend/c99.h. */
static void test_fma_chains_keep_their_roundings(void)
{
	for (uint64_t i = 0; i < 200000; i++) {
		float x[10];
		for (uint32_t k = 0; k < 10; k++)
			x[k] = 8.0f * test_uniform(40 + k, i) - 4.0f;
		const lobe_vec3 along = lobe_vec3_make(x[1], x[2], x[3]), o = lobe_vec3_make(x[4], x[5], x[6]);
		const lobe_vec3 c = lobe_vec3_make(x[7], x[8], x[9]);
		const lobe_vec3 a = chained(x[0], along, o, c), b = chained_by_steps(x[0], along, o, c);
		TEST_ASSERT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_fma_chains_keep_their_roundings);
	RUN_TEST(test_fma_random_bits);
	RUN_TEST(test_fma_near_ties);
	RUN_TEST(test_fma_special);
	return UNITY_END();
}
