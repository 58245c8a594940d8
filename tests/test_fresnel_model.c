/* test_fresnel_model.c - the models of core/fresnel_model.h are the functions that they name, and give the same bits. */
#include "lobe/shading.h"
#include "support.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { COSINES = 200 };

static float cosine_at(int i) { return (float)i / (float)(COSINES - 1); }

static void same(lobe_rgb expected, lobe_rgb got)
{
	TEST_ASSERT_EQUAL_HEX32(test_float_bits(expected.r), test_float_bits(got.r));
	TEST_ASSERT_EQUAL_HEX32(test_float_bits(expected.g), test_float_bits(got.g));
	TEST_ASSERT_EQUAL_HEX32(test_float_bits(expected.b), test_float_bits(got.b));
}

static const lobe_rgb low = {0.9f, 0.6f, 0.04f}, high = {1.0f, 0.8f, 0.5f};
static const lobe_rgb n = {0.2f, 0.9f, 1.5f}, k = {3.9f, 2.4f, 0.0f};

static void test_opaque_models(void)
{
	const lobe_rgb depth = lobe_rgb_make(lobe_fresnel_f82_depth(low.r, high.r), lobe_fresnel_f82_depth(low.g, high.g),
					     lobe_fresnel_f82_depth(low.b, high.b));
	const lobe_fresnel_index_rgb artist = lobe_fresnel_artist_rgb(low, high);
	for (int i = 0; i < COSINES; i++) {
		const float c = cosine_at(i);
		same(lobe_fresnel_conductor_rgb(c, n, k), lobe_fresnel_model_opaque(lobe_fresnel_model_conductor(n, k), c));
		same(low, lobe_fresnel_model_opaque(lobe_fresnel_model_constant(low), c));
		same(lobe_fresnel_schlick_f90_rgb(c, low, high),
		     lobe_fresnel_model_opaque(lobe_fresnel_model_schlick(low, high), c));
		same(lobe_fresnel_schlick_power_rgb(c, low, high, 3.5f),
		     lobe_fresnel_model_opaque(lobe_fresnel_model_power(low, high, 3.5f), c));
		same(lobe_fresnel_f82_rgb(c, low, depth), lobe_fresnel_model_opaque(lobe_fresnel_model_f82(low, high), c));
		same(lobe_fresnel_conductor_rgb(c, artist.eta, artist.k),
		     lobe_fresnel_model_opaque(lobe_fresnel_model_artist(low, high), c));
		same(lobe_thin_film_conductor_rgb(c, lobe_film_make(350.0f, 1.4f), n, k),
		     lobe_fresnel_model_opaque(lobe_fresnel_model_film_on_conductor(350.0f, 1.4f, n, k), c));
	}
}

static lobe_fresnel_split split(lobe_fresnel_model f, float c, float e)
{
	return lobe_fresnel_model_interface(f, lobe_fresnel_interface_unit(c, (1.0f - c) * (1.0f + c), e));
}

/* From the thinner side; from the denser one at the refracted angle. */
static void test_interfaces(void)
{
	const float eta = 1.5f;
	for (int i = 0; i < COSINES; i++) {
		const float c = cosine_at(i);
		const lobe_fresnel exact = lobe_fresnel_dielectric(c, eta), inside = lobe_fresnel_dielectric(c, 1.0f / eta);
		const lobe_rgb through = {inside.transmittance, inside.transmittance, inside.transmittance};
		same(through, split(lobe_fresnel_model_dielectric(), c, 1.0f / eta).transmittance);
		TEST_ASSERT_TRUE(split(lobe_fresnel_model_dielectric(), c, eta).reflect == exact.reflectance);
		same(lobe_thin_film_dielectric_rgb(c, lobe_film_make(350.0f, 1.4f), eta).reflectance,
		     split(lobe_fresnel_model_film_on_dielectric(350.0f, 1.4f, eta), c, eta).reflectance);
		/* Seen from outside a thinner base the film is that of its other side. */
		const lobe_fresnel_split thin = split(lobe_fresnel_model_film_on_dielectric(350.0f, 1.4f, 0.75f), c, 0.75f);
		const float under = lobe_fresnel_dielectric(c, 0.75f).cos_t;
		if (thin.exact.transmittance > 0.0f)
			same(lobe_thin_film_dielectric_rgb(under, lobe_film_make(350.0f * 0.75f, 1.4f / 0.75f), 1.0f / 0.75f)
				     .reflectance,
			     thin.reflectance);
		else
			same(lobe_rgb_make(1.0f, 1.0f, 1.0f), thin.reflectance);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_opaque_models);
	RUN_TEST(test_interfaces);
	return UNITY_END();
}
