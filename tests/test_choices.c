/* test_choices.c - a scene's OpenCL program is compiled for what its materials choose, and for nothing else: the
 * options say so, and not one bit differs from the loops that can do everything. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "support.h"
#include "unity.h"

enum { N = 4096, MATERIALS_MAX = 64 };

void setUp(void) {}
void tearDown(void) {}

/* Every CASE of a lobe that chooses at run time. */
static size_t choosing_cases(const test_case **list)
{
	size_t n = 0;
	for (size_t i = 0; i < case_count() && n < MATERIALS_MAX; i++) {
		const lobe_uint kind = case_at(i)->kind;
		if (kind == LOBE_KIND_MICROFACET_CONDUCTOR || kind == LOBE_KIND_MICROFACET_DIELECTRIC ||
		    kind == LOBE_KIND_MICROFACET_DIFFUSE)
			list[n++] = case_at(i);
	}
	TEST_ASSERT_GREATER_THAN_INT(3, (int)n);
	return n;
}

static lobe_microsurface surface_of(const lobe_bsdf *b)
{
	switch (b->kind) {
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return b->as.microfacet_conductor.surface;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return b->as.microfacet_dielectric.surface;
	default:
		return b->as.microfacet_diffuse.surface;
	}
}

/* --- options -------------------------------------------------------------------------------------------------------- */

/* 1 where they name the choice and this number. */
static int says(const char *options, const char *choice, unsigned value)
{
	char option[64];
	snprintf(option, sizeof option, " -DLOBE_ONLY_%s=%uu", choice, value);
	const char *at = strstr(options, option);
	return at && (at[strlen(option)] == ' ' || at[strlen(option)] == '\0');
}

static void test_options_name_what_one_material_chooses(void)
{
	const test_case *cases[MATERIALS_MAX];
	const size_t n = choosing_cases(cases);
	lobe_device *device;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native:1"));
	for (size_t i = 0; i < n; i++) {
		const lobe_microsurface s = surface_of(&cases[i]->bsdf);
		lobe_scene *scene;
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, &cases[i]->bsdf, 1));
		const char *options = lobe_opencl_options(scene);
		TEST_ASSERT_TRUE_MESSAGE(says(options, "NDF", s.distribution.ndf), options);
		TEST_ASSERT_TRUE_MESSAGE(says(options, "MASKING", s.masking), options);
		TEST_ASSERT_TRUE_MESSAGE(says(options, "JOINT", s.joint), options);
		TEST_ASSERT_TRUE_MESSAGE(says(options, "ACROSS", s.across), options);
		TEST_ASSERT_NOT_NULL_MESSAGE(strstr(options, "LOBE_ONLY_FRESNEL="), options);
		TEST_ASSERT_NOT_NULL_MESSAGE(strstr(options, "LOBE_ONLY_STRATEGY="), options);
		lobe_scene_destroy(scene);
	}
	lobe_device_close(device);
}

static lobe_bsdf conductor(lobe_uint ndf, lobe_uint masking, lobe_uint strategy)
{
	lobe_microsurface s =
		lobe_microsurface_make(lobe_distribution_make(ndf), lobe_linear_rotated(0.3f, 0.1f, 0.5f));
	s = lobe_microsurface_masking(s, masking);
	return lobe_bsdf_from_microfacet_conductor(lobe_microfacet_conductor_make(
		s, lobe_fresnel_model_schlick(lobe_rgb_make(0.9f, 0.5f, 0.1f), lobe_rgb_make(1.0f, 1.0f, 1.0f)),
		strategy));
}

static void test_options_leave_open_what_materials_choose_differently(void)
{
	const lobe_bsdf two[3] = {conductor(LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_STRATEGY_VISIBLE),
				  conductor(LOBE_NDF_GGX, LOBE_MASKING_VCAVITY, LOBE_STRATEGY_NDF),
				  lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1.0f, 1.0f, 1.0f)))};
	lobe_device *device;
	lobe_scene *scene;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native:1"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, two, 3));
	const char *options = lobe_opencl_options(scene);
	TEST_ASSERT_TRUE_MESSAGE(says(options, "NDF", LOBE_NDF_GGX), options);
	TEST_ASSERT_TRUE_MESSAGE(says(options, "FRESNEL", LOBE_FRESNEL_SCHLICK), options);
	TEST_ASSERT_NULL_MESSAGE(strstr(options, "LOBE_ONLY_MASKING"), options);
	TEST_ASSERT_NULL_MESSAGE(strstr(options, "LOBE_ONLY_STRATEGY"), options);
	lobe_scene_destroy(scene);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, two + 2, 1));
	TEST_ASSERT_NULL(strstr(lobe_opencl_options(scene), "LOBE_ONLY"));
	lobe_scene_destroy(scene);
	lobe_device_close(device);
}

/* Rough glass: whether it is near eta = 1, and whether beyond 2. */
static void test_options_name_what_glass_is(void)
{
	const float eta[] = {1.5f, 1.0f, 2.5f, 1.5f};
	lobe_device *device;
	lobe_scene *scene;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native:1"));
	for (size_t first = 0; first < 4; first++)
		for (size_t count = 1; first + count <= 4; count++) {
			lobe_bsdf glass[4];
			unsigned delta = 0, dense = 0;
			for (size_t i = 0; i < count; i++) {
				const float e = eta[first + i];
				glass[i] = i & 1u ? lobe_bsdf_from_beckmann_dielectric(
							    lobe_beckmann_dielectric_make(0.3f, 0.2f, e))
						  : lobe_bsdf_from_ggx_dielectric(
							    lobe_ggx_dielectric_make(0.3f, 0.2f, e));
				delta |= 1u << (e == 1.0f);
				dense |= 1u << (e == 2.5f);
			}
			TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, glass, count));
			const char *options = lobe_opencl_options(scene);
			for (unsigned value = 0; value < 2; value++) {
				TEST_ASSERT_EQUAL_MESSAGE(delta == 1u << value, says(options, "DELTA", value), options);
				TEST_ASSERT_EQUAL_MESSAGE(dense == 1u << value, says(options, "DENSE", value), options);
			}
			lobe_scene_destroy(scene);
		}
	lobe_device_close(device);
}

/* --- bits ----------------------------------------------------------------------------------------------------------- */

/* Words of all outputs. */
static void shade(lobe_device *device, const lobe_bsdf *materials, size_t count, inputs in, const uint32_t *material,
		  float *out)
{
	lobe_scene *scene;
	const lobe_batch batch = inputs_batch(in, material, out);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, count), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &batch), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &batch), lobe_error_message());
	lobe_scene_destroy(scene);
}

static size_t differing(const float *a, const float *b)
{
	size_t n = 0;
	for (size_t i = 0; i < INPUTS_OUTPUTS * N; i++)
		n += test_float_bits(a[i]) != test_float_bits(b[i]);
	return n;
}

static lobe_device *native, *opencl;
static float expected[INPUTS_OUTPUTS * N], got[INPUTS_OUTPUTS * N];

static int no_opencl(void)
{
	size_t devices = 0;
	return lobe_device_count("opencl", &devices) != LOBE_OK || devices == 0;
}

static void test_bits_of_a_program_for_one_material(void)
{
	const test_case *cases[MATERIALS_MAX];
	const size_t n = choosing_cases(cases);
	if (no_opencl())
		TEST_IGNORE_MESSAGE("no OpenCL device");
	inputs in = inputs_alloc(N);
	inputs_random(in, 0);
	for (size_t i = 0; i < n; i++) {
		shade(native, &cases[i]->bsdf, 1, in, NULL, expected);
		shade(opencl, &cases[i]->bsdf, 1, in, NULL, got);
		TEST_ASSERT_EQUAL_INT_MESSAGE(0, (int)differing(expected, got), cases[i]->name);
	}
	inputs_free(in);
}

/* Every CASE of rough glass, plain, delta and dense, in a program of its own. */
static void test_bits_of_a_program_for_one_glass(void)
{
	size_t shaded = 0;
	if (no_opencl())
		TEST_IGNORE_MESSAGE("no OpenCL device");
	inputs in = inputs_alloc(N);
	inputs_random(in, 0);
	for (size_t i = 0; i < case_count(); i++) {
		const lobe_uint kind = case_at(i)->kind;
		if (kind != LOBE_KIND_GGX_DIELECTRIC && kind != LOBE_KIND_BECKMANN_DIELECTRIC &&
		    kind != LOBE_KIND_IRIDESCENT_DIELECTRIC)
			continue;
		shade(native, &case_at(i)->bsdf, 1, in, NULL, expected);
		shade(opencl, &case_at(i)->bsdf, 1, in, NULL, got);
		TEST_ASSERT_EQUAL_INT_MESSAGE(0, (int)differing(expected, got), case_at(i)->name);
		shaded++;
	}
	TEST_ASSERT_GREATER_THAN_INT(5, (int)shaded);
	inputs_free(in);
}

static void test_bits_of_a_program_with_some_choices_left(void)
{
	const lobe_bsdf two[2] = {conductor(LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_STRATEGY_VISIBLE),
				  conductor(LOBE_NDF_BECKMANN, LOBE_MASKING_SMITH, LOBE_STRATEGY_BOUNDED_CAP)};
	uint32_t material[N];
	if (no_opencl())
		TEST_IGNORE_MESSAGE("no OpenCL device");
	inputs in = inputs_alloc(N);
	inputs_random(in, 0);
	for (size_t i = 0; i < N; i++)
		material[i] = test_bits(7, i) & 1u;
	shade(native, two, 2, in, material, expected);
	shade(opencl, two, 2, in, material, got);
	TEST_ASSERT_EQUAL_INT(0, (int)differing(expected, got));
	inputs_free(in);
}

/* A program for another choice is another: the comparison would see a wrong option. */
static void test_another_choice_is_noticed(void)
{
	const lobe_bsdf a = conductor(LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_STRATEGY_VISIBLE);
	const lobe_bsdf b = conductor(LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_STRATEGY_BOUNDED_CAP);
	if (no_opencl())
		TEST_IGNORE_MESSAGE("no OpenCL device");
	inputs in = inputs_alloc(N);
	inputs_random(in, 0);
	shade(native, &a, 1, in, NULL, expected);
	shade(opencl, &b, 1, in, NULL, got);
	TEST_ASSERT_GREATER_THAN_INT(N, (int)differing(expected, got));
	inputs_free(in);
}

int main(void)
{
	if (lobe_device_open(&native, "native") != LOBE_OK ||
	    (!no_opencl() && lobe_device_open(&opencl, "opencl") != LOBE_OK)) {
		puts(lobe_error_message());
		return 1;
	}
	UNITY_BEGIN();
	RUN_TEST(test_options_name_what_one_material_chooses);
	RUN_TEST(test_options_leave_open_what_materials_choose_differently);
	RUN_TEST(test_options_name_what_glass_is);
	RUN_TEST(test_bits_of_a_program_for_one_material);
	RUN_TEST(test_bits_of_a_program_for_one_glass);
	RUN_TEST(test_bits_of_a_program_with_some_choices_left);
	RUN_TEST(test_another_choice_is_noticed);
	lobe_device_close(opencl);
	lobe_device_close(native);
	return UNITY_END();
}
