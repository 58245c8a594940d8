/* test_lobes_extremes.c - the ends of every domain: results stay finite and not negative, and nothing is where nothing
 * should be. (Parameters that are no numbers: test_lobes_parameters.c.) */
#include "cases.h"
#include "directions.h"
#include "sound.h"
#include "support.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

static unsigned long evaluations, samples, kept, bad, not_unit;

static void report(const char *what, const char *name, lobe_vec3 wo, lobe_vec3 w)
{
	if (bad++ < 10)
		printf("  %s: %s, wo (%.9g %.9g %.9g), (%.9g %.9g %.9g)\n", what, name, (double)wo.x, (double)wo.y,
		       (double)wo.z, (double)w.x, (double)w.y, (double)w.z);
}

static void check_pair(const test_case *c, lobe_vec3 wo, lobe_vec3 wi)
{
	evaluations++;
	if (!sound_rgb(lobe_bsdf_eval(c->bsdf, wo, wi)))
		report("eval", c->name, wo, wi);
	if (!sound(lobe_bsdf_pdf(c->bsdf, wo, wi)))
		report("pdf", c->name, wo, wi);
}

static void check_sample(const test_case *c, lobe_vec3 wo, lobe_vec3 u)
{
	const lobe_sample s = lobe_bsdf_sample(c->bsdf, wo, u);
	samples++;
	if (!sound_rgb(s.weight) || !sound(s.pdf))
		report("sample", c->name, wo, u);
	if (s.event == 0u) {
		if (s.pdf != 0.0f || s.weight.r != 0.0f || s.weight.g != 0.0f || s.weight.b != 0.0f || s.wi.x != 0.0f ||
		    s.wi.y != 0.0f || s.wi.z != 0.0f)
			report("rest of no sample", c->name, wo, u);
		return;
	}
	kept++;
	const double x = (double)s.wi.x, y = (double)s.wi.y, z = (double)s.wi.z;
	const double length = sqrt(x * x + y * y + z * z);
	if (!(fabs(length - 1.0) < 1e-5) && not_unit++ < 5)
		printf("  %s: |wi| = %.6f from wo (%.9g %.9g %.9g), u (%.9g %.9g %.9g)\n", c->name, length,
		       (double)wo.x, (double)wo.y, (double)wo.z, (double)u.x, (double)u.y, (double)u.z);
	if (!(s.pdf > 0.0f))
		report("a sample of pdf 0", c->name, wo, u);
	if (!(s.event & LOBE_EVENT_DELTA) &&
	    test_float_bits(lobe_bsdf_pdf(c->bsdf, wo, s.wi)) != test_float_bits(s.pdf))
		report("pdf of the sample", c->name, wo, u);
	check_pair(c, wo, s.wi);
}

/* Direction k of a list that has every awkward one: poles, horizon, grazing from both sides, along and across the
 * anisotropy, and off unit length by a few ulp. */
#define AWKWARD 96u
static lobe_vec3 awkward(size_t k)
{
	static const double z[] = {1.0, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-20, 1e-38, 0.0};
	static const double phi[] = {0.0, 1.5707963267948966, 0.7, 3.9};
	const double c = z[k % 12], p = phi[k / 12 % 4], s = sqrt((1.0 - c) * (1.0 + c));
	const float longer = k % 3 == 0 ? 1.0f : k % 3 == 1 ? 0x1.00000ap0f : 0x1.fffff4p-1f;
	const float sign = k / 48 ? -1.0f : 1.0f;
	return lobe_vec3_make(longer * (float)(s * cos(p)), longer * (float)(s * sin(p)), sign * longer * (float)c);
}

static const float corners[] = {0.0f, 0x1p-24f, 0.25f, 0.5f, 0x1.fffffcp-1f, 0x1.fffffep-1f};
#define CORNERS (sizeof corners / sizeof *corners)

static void test_corners_of_the_unit_cube(void)
{
	evaluations = samples = kept = bad = 0;
	for (size_t i = 0; i < case_count(); i++)
		for (size_t k = 0; k < AWKWARD; k++)
			for (size_t a = 0; a < CORNERS * CORNERS * CORNERS; a++)
				check_sample(case_at(i), awkward(k),
					     lobe_vec3_make(corners[a % CORNERS], corners[a / CORNERS % CORNERS],
							    corners[a / CORNERS / CORNERS]));
	printf("  %lu samples at corners of the cube, %lu kept: %lu unsound\n", samples, kept, bad);
	TEST_ASSERT_GREATER_THAN(500000, kept);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

static void test_random_samples_from_awkward_directions(void)
{
	evaluations = samples = kept = bad = 0;
	for (size_t i = 0; i < case_count(); i++)
		for (size_t k = 0; k < AWKWARD; k++)
			for (uint32_t j = 0; j < 150u; j++) {
				float u[3];
				test_u3(50000u + (uint32_t)i, k * 1000u + j, u);
				check_sample(case_at(i), awkward(k), vec3(u));
			}
	printf("  %lu random samples from awkward directions, %lu kept: %lu unsound\n", samples, kept, bad);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* Not a matter of rounding alone: |wi| may be off by what wo is, a few ulp, not by 1e-5. Counts all tests before it. */
static void test_sampled_directions_stay_unit(void)
{
	printf("  %lu sampled directions are not unit\n", not_unit);
	TEST_ASSERT_EQUAL_UINT(0, not_unit);
}

/* Partners that make the half vector vanish, point straight up, or lie in the surface. */
static void test_awkward_pairs(void)
{
	evaluations = samples = kept = bad = 0;
	for (size_t i = 0; i < case_count(); i++)
		for (size_t k = 0; k < AWKWARD; k++) {
			const lobe_vec3 wo = awkward(k);
			for (size_t m = 0; m < AWKWARD; m++)
				check_pair(case_at(i), wo, awkward(m));
			check_pair(case_at(i), wo, wo);
			check_pair(case_at(i), wo, lobe_vec3_make(-wo.x, -wo.y, -wo.z));
			check_pair(case_at(i), wo, lobe_vec3_make(-wo.x, -wo.y, wo.z));
			check_pair(case_at(i), wo, lobe_vec3_make(wo.x, wo.y, -wo.z));
			check_pair(case_at(i), wo, lobe_vec3_make(0.0f, 0.0f, 0.0f));
			for (uint32_t j = 0; j < 50u; j++) {
				float w[3];
				test_direction(51000u + (uint32_t)i, k * 100u + j, w);
				check_pair(case_at(i), wo, vec3(w));
			}
		}
	printf("  %lu awkward pairs: %lu unsound\n", evaluations, bad);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* Lobes at the ends of their parameters that are not in the list of cases: all pairs of widths and indices. */
static void test_ends_of_the_parameters(void)
{
	static const float alphas[] = {0.0f, 1e-4f, 1e-2f, 1.0f, 100.0f};
	static const float etas[] = {1e-3f,         1.0f / 3.0f,   0x1.ffffdep-1f, 0x1.fffffep-1f, 1.0f,
				     0x1.000002p0f, 0x1.000010p0f, 1.0001f,        1.5f,           1000.0f};
	static const float indices[] = {1e-3f, 1.0f, 3.0f, 1000.0f};
	test_case c = {"end of a parameter", 0, {0}, {0}, 0, 0, 0, 0, 0, TEXTBOOK_GGX};
	evaluations = samples = kept = bad = 0;
	for (size_t a = 0; a < 25; a++) {
		const float ax = alphas[a % 5], ay = alphas[a / 5];
		for (size_t e = 0; e < 10 + 16; e++) {
			const float n = indices[(e - 10) % 4], k = e < 14 ? 0.0f : indices[(e - 10) / 4];
			c.bsdf = e < 10 ? lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(ax, ay, etas[e]))
					: lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(
						  ax, ay, lobe_rgb_make(n, 1.0f, n), lobe_rgb_make(k, k, 0.0f)));
			for (size_t m = 0; m < AWKWARD; m++) {
				for (uint32_t j = 0; j < 8u; j++)
					check_sample(&c, awkward(m),
						     lobe_vec3_make(corners[j & 1u ? 5 : 1], corners[j & 2u ? 5 : 0],
								    corners[j & 4u ? 5 : 0]));
				check_pair(&c, awkward(m), awkward((7 * m + a) % AWKWARD));
			}
		}
	}
	printf("  %lu samples, %lu kept, %lu pairs at ends of the parameters: %lu unsound\n", samples, kept,
	       evaluations, bad);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* The same for the lobes whose Fresnel terms have parameters of their own. */
static lobe_bsdf fresnel_end(unsigned i)
{
	static const float etas[] = {1e-3f, 0x1.fffffep-1f, 1.0f, 0x1.000002p0f, 1.5f, 1000.0f};
	static const float indices[] = {1.0f, 0x1.000002p0f, 1.5f, 1000.0f};
	static const float thicknesses[] = {0.0f, 1e-30f, 1.0f, 500.0f, 1e6f};
	static const float alphas[] = {1e-4f, 1.0f};
	const float alpha = alphas[i & 1u], eta = etas[i / 2 % 6], film = indices[i / 12 % 4],
		    d = thicknesses[i / 48 % 5];
	const lobe_rgb n = lobe_rgb_make(eta, indices[i / 12 % 4], 1.0f);
	const lobe_rgb k = lobe_rgb_make(0.0f, indices[(i + 3) % 4], i & 4u ? 1000.0f : 0.0f);
	const float f = i / 48 & 1 ? 1.0f : 0.0f;
	switch (i / 240) {
	case 0:
		return lobe_bsdf_from_iridescent_conductor(lobe_iridescent_conductor_make(alpha, 1.0f, d, film, n, k));
	case 1:
		return lobe_bsdf_from_iridescent_dielectric(
			lobe_iridescent_dielectric_make(alpha, alpha, d, film * (eta < 1.0f ? eta : 1.0f), eta));
	case 2:
		return lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(alpha, 1.0f, d, film, eta));
	case 3:
		return lobe_bsdf_from_ggx_schlick(lobe_ggx_schlick_make(alpha, i & 2u ? 1e-4f : 1.0f,
									lobe_rgb_make(f, 0.5f, 0.0f),
									lobe_rgb_make(1.0f - f, 0.0f, 0.0f)));
	case 4:
		return i & 1u ? lobe_bsdf_from_smooth_dielectric(lobe_smooth_dielectric_make(eta))
			      : lobe_bsdf_from_thin_dielectric(lobe_thin_dielectric_make(eta));
	default:
		return lobe_bsdf_from_smooth_conductor(lobe_smooth_conductor_make(n, k));
	}
}

static void test_ends_of_the_fresnel_parameters(void)
{
	test_case c = {"end of a Fresnel parameter", 0, {0}, {0}, 0, 0, 0, 0, 0, TEXTBOOK_GGX};
	evaluations = samples = kept = bad = 0;
	for (unsigned i = 0; i < 6u * 240u; i++) {
		c.bsdf = fresnel_end(i);
		for (size_t m = i % 3u; m < AWKWARD; m += 3u) {
			for (uint32_t j = 0; j < 4u; j++)
				check_sample(&c, awkward(m),
					     lobe_vec3_make(corners[j & 1u ? 5 : 1], corners[j & 2u ? 5 : 0],
							    corners[(j + m) % CORNERS]));
			check_pair(&c, awkward(m), awkward((7 * m + i) % AWKWARD));
		}
	}
	printf("  %lu samples, %lu kept, %lu pairs at ends of the Fresnel parameters: %lu unsound\n", samples, kept,
	       evaluations, bad);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* Nothing on the far side of an opaque lobe, nothing from below a metal, nothing in the plane of the surface. */
static void test_nothing_where_nothing_should_be(void)
{
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		for (uint32_t j = 0; j < 2000u; j++) {
			float a[3], b[3];
			test_direction(52000u + (uint32_t)i, j, a);
			test_direction(53000u + (uint32_t)i, j, b);
			if (j % 8u == 0u)
				a[2] = 0.0f;
			if (j % 8u == 1u)
				b[2] = 0.0f;
			const int across = a[2] * b[2] < 0.0f, flat = a[2] == 0.0f || b[2] == 0.0f;
			const int below = a[2] < 0.0f && !(c->flags & CASE_TWO_SIDED);
			if (!flat && !below && !(across && !(c->flags & CASE_TRANSMITS)))
				continue;
			const lobe_rgb f = lobe_bsdf_eval(c->bsdf, vec3(a), vec3(b));
			TEST_ASSERT_TRUE_MESSAGE(f.r == 0.0f && f.g == 0.0f && f.b == 0.0f, c->name);
			TEST_ASSERT_TRUE_MESSAGE(lobe_bsdf_pdf(c->bsdf, vec3(a), vec3(b)) == 0.0f, c->name);
			if (below)
				TEST_ASSERT_EQUAL_UINT(0, lobe_bsdf_sample(c->bsdf, vec3(a), vec3(b)).event);
		}
	}
}

/* A kind that does not exist. */
static void test_no_lobe_shades_to_nothing(void)
{
	lobe_bsdf b;
	memset(&b, 0, sizeof b);
	for (lobe_uint kind = 0; kind < 2u * LOBE_KIND_LIMIT; kind += LOBE_KIND_LIMIT - 1u) {
		b.kind = kind;
		const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
		TEST_ASSERT_TRUE(lobe_bsdf_pdf(b, up, up) == 0.0f);
		TEST_ASSERT_TRUE(lobe_bsdf_eval(b, up, up).g == 0.0f);
		TEST_ASSERT_EQUAL_UINT(0, lobe_bsdf_sample(b, up, up).event);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_corners_of_the_unit_cube);
	RUN_TEST(test_random_samples_from_awkward_directions);
	RUN_TEST(test_awkward_pairs);
	RUN_TEST(test_ends_of_the_parameters);
	RUN_TEST(test_ends_of_the_fresnel_parameters);
	RUN_TEST(test_sampled_directions_stay_unit);
	RUN_TEST(test_nothing_where_nothing_should_be);
	RUN_TEST(test_no_lobe_shades_to_nothing);
	return UNITY_END() != 0;
}
