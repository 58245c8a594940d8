#include "batch_fixture.h"

#include <string.h>

#include "inputs.h"
#include "support.h"
#include "unity.h"

batch_fixture fixture;

void fixture_open(void)
{
	const lobe_bsdf materials[3] = {
		lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.2f, 0.5f, 0.8f))),
		lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(0.3f, 0.1f, lobe_metal_eta(LOBE_METAL_GOLD),
								     lobe_metal_k(LOBE_METAL_GOLD))),
		lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.3f, 0.1f, 1.5f))};
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&fixture.device, "native:1"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&fixture.scene, fixture.device, materials, 3));
	for (uint32_t i = 0; i < FIXTURE_N; i++) {
		float w[3];
		test_direction(1, i, w);
		for (int k = 0; k < 3; k++)
			fixture.in[k][i] = w[k];
		test_direction(2, i, w);
		for (int k = 0; k < 3; k++) {
			fixture.in[3 + k][i] = w[k];
			fixture.in[6 + k][i] = test_uniform((uint32_t)(3 + k), i);
		}
		fixture.material[i] = test_bits(6, i) % 3;
	}
	memset(fixture.out, 0xee, sizeof fixture.out);
}

void fixture_close(void)
{
	lobe_scene_destroy(fixture.scene);
	lobe_device_close(fixture.device);
	fixture.scene = NULL;
	fixture.device = NULL;
}

lobe_batch good_batch(void)
{
	inputs in;
	float *out[INPUTS_OUTPUTS];
	in.count = FIXTURE_N;
	for (int k = 0; k < 9; k++)
		in.array[k] = fixture.in[k];
	for (int k = 0; k < INPUTS_OUTPUTS - 1; k++)
		out[k] = fixture.out[k];
	out[INPUTS_OUTPUTS - 1] = (float *)(void *)fixture.event;
	return inputs_batch_to(in, fixture.material, out);
}

void assert_refused(lobe_status expected, lobe_status got, const char *word)
{
	TEST_ASSERT_EQUAL_STRING(lobe_status_string(expected), lobe_status_string(got));
	TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), word), lobe_error_message());
}

void fixture_materials(lobe_bsdf materials[3], uint32_t *material, uint32_t n)
{
	materials[0] = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.5f, 0.5f, 0.5f)));
	materials[1] = lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(0.2f, 0.3f, lobe_metal_eta(LOBE_METAL_IRON), lobe_metal_k(LOBE_METAL_IRON)));
	materials[2].kind = LOBE_KIND_NONE;
	for (uint32_t i = 0; i < n; i++)
		material[i] = i % 3;
}
