/* test_materials.c - what a scene takes for a material: whole ones, as make returns them, and none with a field changed
 * afterwards. And that a scene holds its device. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "lobe/lobe.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

/* Of a native device, which is closed at once: the scene keeps it. */
static lobe_status create(lobe_scene **scene, const lobe_bsdf *materials, size_t count)
{
	lobe_device *device;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, "native:1"));
	const lobe_status status = lobe_scene_create(scene, device, materials, count);
	lobe_device_close(device);
	return status;
}

static void test_takes_every_case(void)
{
	lobe_bsdf *const all = malloc(case_count() * sizeof *all);
	lobe_scene *scene;
	TEST_ASSERT_NOT_NULL(all);
	for (size_t i = 0; i < case_count(); i++)
		all[i] = case_at(i)->bsdf;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, create(&scene, all, case_count()), lobe_error_message());
	lobe_scene_destroy(scene);
	free(all);
}

/* What a scene of b says must begin with the field and name the value that it should have. */
static void refused(lobe_bsdf b, const char *field)
{
	lobe_scene *scene = (lobe_scene *)&b;
	char words[128];
	snprintf(words, sizeof words, "materials[0]: %s", field);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_ERROR_PARAMETER, create(&scene, &b, 1), field);
	TEST_ASSERT_EQUAL_STRING_LEN(words, lobe_error_message(), strlen(words));
	TEST_ASSERT_EQUAL_PTR(&b, scene);
}

static void test_changed_fields_are_refused(void)
{
	const lobe_rgb n = lobe_rgb_make(0.2f, 0.9f, 1.1f), k = lobe_rgb_make(3.0f, 2.0f, 2.0f);
	lobe_ggx_conductor metal = lobe_ggx_conductor_make(0.2f, 0.3f, n, k);
	metal.stretch.alpha_x = 0.9f;
	refused(lobe_bsdf_from_ggx_conductor(metal), "field stretch.inv_alpha_x of lobe_ggx_conductor is 5, but");
	metal = lobe_ggx_conductor_make(0.2f, 0.3f, n, k);
	metal.stretch.norm *= 1.01f;
	refused(lobe_bsdf_from_ggx_conductor(metal), "field stretch.norm");

	lobe_beckmann_dielectric glass = lobe_beckmann_dielectric_make(0.2f, 0.3f, 1.5f);
	glass.eta = 1.6f;
	refused(lobe_bsdf_from_beckmann_dielectric(glass), "field inv_eta");
	glass = lobe_beckmann_dielectric_make(0.2f, 0.3f, 1.5f);
	glass.delta = 1;
	refused(lobe_bsdf_from_beckmann_dielectric(glass), "field delta");

	lobe_smooth_dielectric window = lobe_smooth_dielectric_make(1.5f);
	window.inv_eta = 0.5f;
	refused(lobe_bsdf_from_smooth_dielectric(window), "field inv_eta");

	lobe_iridescent_dielectric soap = lobe_iridescent_dielectric_make(0.2f, 0.2f, 300.0f, 1.3f, 1.5f);
	soap.glass.dense = 1;
	refused(lobe_bsdf_from_iridescent_dielectric(soap), "field glass.dense");

	const lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
							    lobe_linear_correlated(0.2f, 0.4f, 0.7f));
	const lobe_fresnel_model f = lobe_fresnel_model_dielectric();
	lobe_microfacet_dielectric any = lobe_microfacet_dielectric_make(s, f, 1.5f, LOBE_STRATEGY_VISIBLE);
	any.surface.alpha *= 1.01f;
	refused(lobe_bsdf_from_microfacet_dielectric(any), "field surface.alpha");
	any = lobe_microfacet_dielectric_make(s, f, 1.5f, LOBE_STRATEGY_VISIBLE);
	any.surface.map.ixx *= 1.01f;
	refused(lobe_bsdf_from_microfacet_dielectric(any), "surface.map of lobe_microfacet_dielectric");
}

/* A number of a Fresnel model that another model may have, and films beyond what their make functions take, which keep
 * them by the thinner medium. */
static void test_optics_out_of_domain_are_refused(void)
{
	const lobe_microsurface s =
		lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), lobe_linear_stretch(0.2f, 0.4f));
	const lobe_rgb half = lobe_rgb_make(0.5f, 0.5f, 0.5f), two = lobe_rgb_make(0.5f, 2.0f, 0.5f);
	const struct {
		lobe_fresnel_model model;
		const char *words;
	} metal[] = {
		{lobe_fresnel_model_schlick(two, half), "field fresnel.a.g of lobe_microfacet_conductor is 2"},
		{lobe_fresnel_model_schlick(half, two), "field fresnel.b.g of lobe_microfacet_conductor is 2"},
		{lobe_fresnel_model_constant(two), "field fresnel.a.g of lobe_microfacet_conductor is 2"},
		{lobe_fresnel_model_power(half, half, 0.0f), "field fresnel.c of lobe_microfacet_conductor is 0"},
		{lobe_fresnel_model_f82(half, lobe_rgb_make(0.5f, 5.0f, 0.5f)),
		 "field fresnel.b.g of lobe_microfacet_conductor is -"},
		{lobe_fresnel_model_film_on_conductor(100.0f, 0.5f, two, two),
		 "field fresnel.d of lobe_microfacet_conductor is 0.5"},
	};
	for (size_t i = 0; i < sizeof metal / sizeof *metal; i++)
		refused(lobe_bsdf_from_microfacet_conductor(
				lobe_microfacet_conductor_make(s, metal[i].model, LOBE_STRATEGY_VISIBLE)),
			metal[i].words);
	const lobe_fresnel_model thick = lobe_fresnel_model_film_on_dielectric(1.5e6f, 1.3f, 0.5f);
	refused(lobe_bsdf_from_microfacet_dielectric(
			lobe_microfacet_dielectric_make(s, thick, 0.5f, LOBE_STRATEGY_VISIBLE)),
		"field fresnel.c of lobe_microfacet_dielectric is 750000");
	refused(lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.2f, 0.2f, 1.5e6f, 1.3f, 0.5f)),
		"field film.thickness of lobe_iridescent_dielectric is 750000");
	refused(lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.2f, 0.2f, 300.0f, 1500.0f, 0.5f)),
		"field film.index of lobe_iridescent_dielectric is 3000");
}

/* Maps of every make function, at the ends of their domains, belong to their inverses. */
static void test_takes_every_map(void)
{
	const float width[] = {1e-4f, 0.3f, 100.0f}, rho[] = {-0.9999f, 0.0f, 0.9999f};
	lobe_bsdf all[200];
	size_t count = 0;
	lobe_scene *scene;
	for (int i = 0; i < 27; i++) {
		const float x = width[i % 3], y = width[i / 3 % 3], r = rho[i / 9];
		const lobe_linear map[] = {lobe_linear_stretch(x, y), lobe_linear_rotated(x, y, 3.0f * r),
					   lobe_linear_correlated(x, y, r),
					   lobe_linear_tilted(lobe_linear_correlated(x, y, r), 100.0f * r, -3.0f),
					   lobe_linear_from_moments(0.5f, r, 0.5f * x * x, 0.5f * y * y, 0.25f * r * x * y)};
		for (size_t m = 0; m < sizeof map / sizeof *map; m++)
			all[count++] = lobe_bsdf_from_microfacet_diffuse(lobe_microfacet_diffuse_make(
				lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_BECKMANN), map[m]),
				lobe_rgb_make(0.5f, 0.5f, 0.5f)));
	}
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, create(&scene, all, count), lobe_error_message());
	lobe_scene_destroy(scene);
}

/* A handle that the distribution does not ask for is not looked at. */
static void test_takes_a_stray_handle(void)
{
	lobe_distribution d = lobe_distribution_make(LOBE_NDF_GGX);
	lobe_scene *scene;
	d.table = lobe_table_at(1);
	const lobe_bsdf b = lobe_bsdf_from_microfacet_diffuse(lobe_microfacet_diffuse_make(
		lobe_microsurface_make(d, lobe_linear_stretch(0.3f, 0.3f)), lobe_rgb_make(0.5f, 0.5f, 0.5f)));
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, create(&scene, &b, 1), lobe_error_message());
	lobe_scene_destroy(scene);
}

static void outlives(const char *name)
{
	const lobe_bsdf b = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.5f, 0.5f, 0.5f)));
	const float zero = 0.0f, one = 1.0f;
	float pdf = -1.0f;
	const lobe_batch batch = {
		.count = 1, .wo = {&zero, &zero, &one}, .wi = {&zero, &zero, &one}, .pdf = &pdf};
	lobe_device *device;
	lobe_scene *scene[2];
	lobe_event *event;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&device, name));
	for (int i = 0; i < 2; i++)
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene[i], device, &b, 1), lobe_error_message());
	lobe_device_close(device);
	lobe_scene_destroy(scene[0]);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval_async(scene[1], &batch, &event));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(event));
	lobe_event_release(event);
	TEST_ASSERT_TRUE(pdf == LOBE_INV_PI);
	lobe_scene_destroy(scene[1]);
}

static void test_scene_holds_its_device(void)
{
	outlives("native:2");
	outlives("opencl,native:1");
}

static void test_scene_holds_its_opencl_device(void)
{
	size_t count = 0;
	if (lobe_device_count("opencl", &count) != LOBE_OK || count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	outlives("opencl");
	outlives("opencl:all");
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_takes_every_case);
	RUN_TEST(test_changed_fields_are_refused);
	RUN_TEST(test_optics_out_of_domain_are_refused);
	RUN_TEST(test_takes_every_map);
	RUN_TEST(test_takes_a_stray_handle);
	RUN_TEST(test_scene_holds_its_device);
	RUN_TEST(test_scene_holds_its_opencl_device);
	return UNITY_END();
}
