/* test_scene.c - scenes: what they refuse, by the name of the field, what they clamp, and that they keep a copy.
 * (Fields changed after make: test_materials.c.) */
#include <string.h>

#include "batch_fixture.h"
#include "lobe/lobe.h"
#include "unity.h"

void setUp(void) { fixture_open(); }
void tearDown(void) { fixture_close(); }

static void test_scene_refusals(void)
{
	lobe_scene *s = fixture.scene;
	lobe_bsdf m[2] = {lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0, 0, 0))),
			  lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0, 0, 0)))};
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_create(NULL, fixture.device, m, 1), "out");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_create(&s, NULL, m, 1), "device");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_create(&s, fixture.device, NULL, 1), "materials");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_create(&s, fixture.device, m, 0), "count");
	m[1].kind = 200;
	assert_refused(LOBE_ERROR_PARAMETER, lobe_scene_create(&s, fixture.device, m, 2), "materials[1].kind");
	TEST_ASSERT_EQUAL_PTR(fixture.scene, s);
}

/* Each refusal names the material and the field. */
static void refuse(lobe_bsdf m, const char *field)
{
	const lobe_bsdf materials[2] = {lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1))), m};
	lobe_scene *s = fixture.scene;
	assert_refused(LOBE_ERROR_PARAMETER, lobe_scene_create(&s, fixture.device, materials, 2), field);
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "materials[1]"));
	TEST_ASSERT_EQUAL_PTR(fixture.scene, s);
}

static void test_bad_parameters(void)
{
	const lobe_rgb one = lobe_rgb_make(1, 1, 1);
	const float bad[] = {NAN, INFINITY, -INFINITY, -1.0f, 1e9f};
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		refuse(lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0, bad[i], 0))), "reflectance.g");
		refuse(lobe_bsdf_from_ggx_conductor(
			       lobe_ggx_conductor_make(0.1f, 0.1f, lobe_rgb_make(1, 1, bad[i]), one)),
		       "eta.b");
		refuse(lobe_bsdf_from_ggx_conductor(
			       lobe_ggx_conductor_make(0.1f, 0.1f, one, lobe_rgb_make(bad[i], 1, 1))),
		       "k.r");
		refuse(lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.1f, 0.1f, bad[i])), "eta");
	}
	refuse(lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(NAN, 0.1f, one, one)), "alpha_x");
	refuse(lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.1f, NAN, 1.5f)), "alpha_y");
	refuse(lobe_bsdf_from_ggx_dielectric(
		       lobe_ggx_dielectric_transport(lobe_ggx_dielectric_make(0.1f, 0.1f, 1.5f), 7)),
	       "transport");
	refuse(lobe_bsdf_from_ggx_schlick(lobe_ggx_schlick_make(0.1f, 0.1f, lobe_rgb_make(0, 1.5f, 0), one)), "f0.g");
	refuse(lobe_bsdf_from_mirror(lobe_mirror_make(lobe_rgb_make(0, 0, -1))), "reflectance.b");
	refuse(lobe_bsdf_from_smooth_dielectric(lobe_smooth_dielectric_make(NAN)), "eta");
	refuse(lobe_bsdf_from_thin_dielectric(lobe_thin_dielectric_make(0)), "eta");
	refuse(lobe_bsdf_from_iridescent_conductor(lobe_iridescent_conductor_make(0.1f, 0.1f, -1, 1.5f, one, one)),
	       "film.thickness");
	refuse(lobe_bsdf_from_iridescent_conductor(lobe_iridescent_conductor_make(0.1f, 0.1f, 1, 0.9f, one, one)),
	       "film.index");
	/* Rarer than both sides, though not than the outside. */
	refuse(lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.1f, 0.1f, 1, 0.6f, 0.7f)),
	       "film.index");
	/* A struct that did not come from make. */
	lobe_bsdf zero;
	memset(&zero, 0, sizeof zero);
	zero.kind = LOBE_KIND_GGX_CONDUCTOR;
	refuse(zero, "alpha_x");
}

/* make clamps alpha, and says so: these are accepted. */
static void test_clamped_alpha(void)
{
	const float alpha[] = {0.0f, -3.0f, 1e-9f, 2.0f, INFINITY};
	for (size_t i = 0; i < sizeof alpha / sizeof *alpha; i++) {
		const lobe_bsdf m = lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(alpha[i], 0.5f, 1.5f));
		lobe_scene *s;
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&s, fixture.device, &m, 1));
		lobe_scene_destroy(s);
		TEST_ASSERT_TRUE(m.as.ggx_dielectric.stretch.alpha_x >= LOBE_ALPHA_MIN &&
				 m.as.ggx_dielectric.stretch.alpha_x <= 1);
	}
	lobe_scene_destroy(NULL);
}

/* The scene keeps its own copy. */
static void test_materials_are_copied(void)
{
	lobe_bsdf m = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1)));
	lobe_scene *s;
	lobe_batch b = good_batch();
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&s, fixture.device, &m, 1));
	memset(&m, 0xff, sizeof m);
	b.material = NULL;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(s, &b));
	const lobe_vec3 wo = lobe_vec3_make(fixture.in[0][0], fixture.in[1][0], fixture.in[2][0]),
			wi = lobe_vec3_make(fixture.in[3][0], fixture.in[4][0], fixture.in[5][0]);
	TEST_ASSERT_EQUAL_FLOAT(lobe_lambert_eval(lobe_lambert_make(lobe_rgb_make(1, 1, 1)), wo, wi).r,
				fixture.out[0][0]);
	lobe_scene_destroy(s);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_scene_refusals);
	RUN_TEST(test_bad_parameters);
	RUN_TEST(test_clamped_alpha);
	RUN_TEST(test_materials_are_copied);
	return UNITY_END();
}
