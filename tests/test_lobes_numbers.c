/* test_lobes_numbers.c - directions and random numbers that are none: every lobe gives numbers all the same, and no sample
 * where a direction that it looks at is not one. */
#include <math.h>
#include <stdio.h>

#include "cases.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static int are_numbers(const float *x, int n)
{
	int yes = 1;
	for (int i = 0; i < n; i++)
		yes &= isfinite(x[i]);
	return yes;
}

/* One of six numbers, wo's and then wi's or u's, is bad. */
static void check(const test_case *c, int at, float bad)
{
	float w[6] = {0.48f, 0.36f, 0.8f, -0.64f, 0.48f, 0.6f};
	char what[160];
	w[at] = bad;
	snprintf(what, sizeof what, "%s, %s[%d] = %g", c->name, at < 3 ? "wo" : "wi or u", at % 3, (double)bad);
	const lobe_vec3 wo = lobe_vec3_make(w[0], w[1], w[2]), second = lobe_vec3_make(w[3], w[4], w[5]);
	const lobe_rgb f = lobe_bsdf_eval(c->bsdf, wo, second);
	const float pdf = lobe_bsdf_pdf(c->bsdf, wo, second);
	const lobe_sample s = lobe_bsdf_sample(c->bsdf, wo, second);
	TEST_ASSERT_TRUE_MESSAGE(are_numbers(&f.r, 3) && f.r >= 0.0f && f.g >= 0.0f && f.b >= 0.0f, what);
	TEST_ASSERT_TRUE_MESSAGE(are_numbers(&pdf, 1) && pdf >= 0.0f, what);
	TEST_ASSERT_TRUE_MESSAGE(are_numbers(&s.wi.x, 3) && are_numbers(&s.weight.r, 3) && are_numbers(&s.pdf, 1), what);
	/* Lambert's lobes look at nothing but the side. */
	if (at < 3 && c->kind != LOBE_KIND_LAMBERT && c->kind != LOBE_KIND_MICROFACET_DIFFUSE) {
		TEST_ASSERT_EQUAL_MESSAGE(0, s.event, what);
		TEST_ASSERT_TRUE_MESSAGE(s.pdf == 0.0f && s.weight.r == 0.0f && s.wi.z == 0.0f, what);
	}
}

static void test_no_number_in_no_number_out(void)
{
	static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
	for (size_t i = 0; i < case_count(); i++)
		for (int at = 0; at < 6; at++)
			for (size_t b = 0; b < sizeof bad / sizeof *bad; b++)
				check(case_at(i), at, bad[b]);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_no_number_in_no_number_out);
	return UNITY_END();
}
