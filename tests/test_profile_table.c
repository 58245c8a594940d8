/* test_profile_table.c - lobe_distribution_phong, _gtr, _student_t and _tabulated: what they refuse, and that a refusal
 * leaves everything as it was. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/lobe.h"
#include "unity.h"

static float table[LOBE_PROFILE_WORDS + 1];
static lobe_distribution d;

void setUp(void)
{
	memset(table, 0x55, sizeof table);
	memset(&d, 0x55, sizeof d);
}
void tearDown(void) {}

static void refused(lobe_status expected, lobe_status status, const char *word)
{
	float untouched[LOBE_PROFILE_WORDS + 1];
	lobe_distribution same;
	memset(untouched, 0x55, sizeof untouched);
	memset(&same, 0x55, sizeof same);
	TEST_ASSERT_EQUAL_STRING(lobe_status_string(expected), lobe_status_string(status));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), word), lobe_error_message());
	TEST_ASSERT_EQUAL_MEMORY(untouched, table, sizeof table);
	TEST_ASSERT_EQUAL_MEMORY(&same, &d, sizeof d);
}

#define ROOM LOBE_PROFILE_WORDS

static double gaussian(void *context, double r)
{
	(void)context;
	return exp(-r * r);
}

static void test_arguments(void)
{
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_phong(NULL, table, ROOM, 1.0f), "out");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_phong(&d, NULL, ROOM, 1.0f), "table");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_phong(&d, (float *)(void *)((char *)table + 1), ROOM, 1.0f),
		"misaligned");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_phong(&d, table, ROOM - 1, 1.0f), "words");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_gtr(NULL, table, ROOM, 1.0f, 0.5f), "out");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_gtr(&d, table, 0, 1.0f, 0.5f), "words");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_student_t(&d, NULL, ROOM, 2.0f), "table");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_tabulated(&d, NULL, ROOM, gaussian, NULL), "table");
	refused(LOBE_ERROR_ARGUMENT, lobe_distribution_tabulated(&d, table, ROOM, NULL, NULL), "lobe_distribution_tabulated: f is NULL");
}

static void test_domains(void)
{
	static const float phong[] = {-0.001f, 2.1e8f, NAN, INFINITY, -INFINITY};
	static const float gamma[] = {0.0f, -1.0f, 101.0f, NAN, INFINITY};
	static const float alpha[] = {0.0f, 9e-5f, 1.0001f, NAN, -0.5f};
	static const float student[] = {1.5f, 1.0f, 0.0f, 2e8f, NAN, INFINITY};
	for (size_t i = 0; i < sizeof phong / sizeof *phong; i++)
		refused(LOBE_ERROR_PARAMETER, lobe_distribution_phong(&d, table, ROOM, phong[i]), "n is");
	for (size_t i = 0; i < sizeof gamma / sizeof *gamma; i++)
		refused(LOBE_ERROR_PARAMETER, lobe_distribution_gtr(&d, table, ROOM, gamma[i], 0.5f), "gamma is");
	for (size_t i = 0; i < sizeof alpha / sizeof *alpha; i++)
		refused(LOBE_ERROR_PARAMETER, lobe_distribution_gtr(&d, table, ROOM, 1.0f, alpha[i]), "alpha is");
	for (size_t i = 0; i < sizeof student / sizeof *student; i++)
		refused(LOBE_ERROR_PARAMETER, lobe_distribution_student_t(&d, table, ROOM, student[i]), "gamma is");
}

/* At every corner of the domains there is a table, of finite numbers, and its words are counted in the first. */
static void test_corners(void)
{
	static const float gammas[] = {0.01f, 0.99f, 1.0f, 1.5f, 3.999f, 100.0f},
			   alphas[] = {1e-4f, 0.02f, 1.0f - 0x1p-24f, 1.0f};
	static const float students[] = {1.501f, 1.7f, 1e4f, 1e8f}, phongs[] = {0.0f, 1e-6f, 1.0f, 1e4f, 2e8f};
	size_t made = 0;
	for (size_t i = 0; i < 24 + 4 + 5; i++) {
		const lobe_status s = i < 24   ? lobe_distribution_gtr(&d, table, ROOM, gammas[i % 6], alphas[i / 6])
				      : i < 28 ? lobe_distribution_student_t(&d, table, ROOM, students[i - 24])
					       : lobe_distribution_phong(&d, table, ROOM, phongs[i - 28]);
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, s, lobe_error_message());
		TEST_ASSERT_TRUE(table[0] == (float)LOBE_PROFILE_WORDS);
		TEST_ASSERT_TRUE(lobe_table_address(d.table) == (uintptr_t)table);
		TEST_ASSERT_EQUAL_HEX8(0x55, ((unsigned char *)table)[4 * LOBE_PROFILE_WORDS]);
		for (size_t k = 0; k < LOBE_PROFILE_WORDS; k++)
			TEST_ASSERT_TRUE(table[k] - table[k] == 0.0f && table[k] >= 0.0f);
		TEST_ASSERT_TRUE(d.norm > 0.0f && d.norm <= LOBE_REAL_MAX);
		const lobe_facet_density f = lobe_distribution_density(d, lobe_vec3_make(0.0f, 0.0f, 1.0f));
		TEST_ASSERT_TRUE(f.inv * f.inv * f.factor > 0.0f && f.inv * f.inv * f.factor <= LOBE_REAL_MAX);
		made++;
	}
	TEST_ASSERT_EQUAL(33, made);
}

/* Densities that are none. */
enum { NEGATIVE, NOT_A_NUMBER, INFINITE, ZERO, FLAT, SLOW, SLOPES_INFINITE, STEEP_AT_0, HUGE_F, FAR_AWAY };

static double bad(void *context, double r)
{
	switch (*(const int *)context) {
	case NEGATIVE:
		return r > 0.3 && r < 0.5 ? -1e-3 : exp(-r);
	case NOT_A_NUMBER:
		return r > 2.0 && r < 3.0 ? (double)NAN : exp(-r);
	case INFINITE:
		return r < 0.01 ? HUGE_VAL : exp(-r);
	case ZERO:
		return 0.0;
	case FLAT:
		return 1.0;
	case SLOW:
		return 1.0 / (1.0 + pow(r, 1.9));
	case SLOPES_INFINITE:
		return 1.0 / (1.0 + r * r * r);
	case STEEP_AT_0:
		return exp(-r) / (r * r);
	case HUGE_F:
		return 1.7e308 * exp(-r * r / 1e6);
	default:
		return exp(-r * r * 1e-30);
	}
}

static void test_densities(void)
{
	static const struct {
		int which;
		const char *word;
	} all[] = {{NEGATIVE, "f("},
		   {NOT_A_NUMBER, "f("},
		   {INFINITE, "f("},
		   {ZERO, "0 everywhere"},
		   {FLAT, "integrated"},
		   {SLOW, "integrated"},
		   {SLOPES_INFINITE, "mean slope"},
		   {STEEP_AT_0, "integrated"},
		   {HUGE_F, "too large"},
		   {FAR_AWAY, "rescale"}};
	for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
		int which = all[i].which;
		refused(LOBE_ERROR_PARAMETER, lobe_distribution_tabulated(&d, table, ROOM, bad, &which), all[i].word);
	}
}

/* f's factor does not matter, and the same f gives the same table. */
static double scaled(void *context, double r) { return *(const double *)context * exp(-r * r); }

static void test_factor(void)
{
	static float other[LOBE_PROFILE_WORDS];
	lobe_distribution e;
	double factor = 1.0;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_tabulated(&d, table, ROOM, scaled, &factor));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_tabulated(&e, other, ROOM, gaussian, NULL));
	TEST_ASSERT_EQUAL_MEMORY(other, table, sizeof other);
	factor = 0x1p300;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_tabulated(&d, table, ROOM, scaled, &factor));
	for (float z = 1e-3f; z < 3.0f; z *= 1.1f)
		TEST_ASSERT_FLOAT_WITHIN(1e-6f, lobe_distribution_hidden(e, lobe_vec3_make(1.0f, 0.0f, z)),
					 lobe_distribution_hidden(d, lobe_vec3_make(1.0f, 0.0f, z)));
}

static void refused_table(lobe_device *device, lobe_microfacet_diffuse p, uintptr_t address, const char *words)
{
	p.surface.distribution.table = lobe_table_at((uint64_t)address);
	const lobe_bsdf b = lobe_bsdf_from_microfacet_diffuse(p);
	lobe_scene *scene = NULL;
	TEST_ASSERT_EQUAL(LOBE_ERROR_PARAMETER, lobe_scene_create(&scene, device, &b, 1));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), words), lobe_error_message());
	TEST_ASSERT_NULL(scene);
}

/* A scene takes a material with its table, and neither one without nor one with something else in its place. */
static void test_scene_wants_the_table(void)
{
	static float spoilt[LOBE_PROFILE_WORDS];
	lobe_device *device;
	lobe_scene *scene = NULL;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native:1"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_distribution_gtr(&d, table, ROOM, 1.5f, 0.3f));
	lobe_microfacet_diffuse p = lobe_microfacet_diffuse_make(
		lobe_microsurface_make(d, lobe_linear_stretch(1.0f, 1.0f)), lobe_rgb_make(0.5f, 0.5f, 0.5f));
	lobe_bsdf b = lobe_bsdf_from_microfacet_diffuse(p);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, &b, 1), lobe_error_message());
	lobe_scene_destroy(scene);
	refused_table(device, p, 0, "needs a table and has none");
	refused_table(device, p, (uintptr_t)table + 1, "needs a table and has something else");
	memcpy(spoilt, table, sizeof spoilt);
	spoilt[0] = 3.0f;
	refused_table(device, p, (uintptr_t)spoilt, "begins with 3, not with its length");
	memcpy(spoilt, table, sizeof spoilt);
	spoilt[100] = NAN;
	refused_table(device, p, (uintptr_t)spoilt, "word 100 of the table");
	lobe_device_close(device);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_arguments);
	RUN_TEST(test_domains);
	RUN_TEST(test_corners);
	RUN_TEST(test_densities);
	RUN_TEST(test_factor);
	RUN_TEST(test_scene_wants_the_table);
	return UNITY_END();
}
