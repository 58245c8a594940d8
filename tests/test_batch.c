/* test_batch.c - batches: what they do, and what they refuse and how they say so. */
#define _POSIX_C_SOURCE 200809L
#include <fenv.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "batch_fixture.h"
#include "lobe/lobe.h"
#include "support.h"
#include "unity.h"

void setUp(void) { fixture_open(); }
void tearDown(void) { fixture_close(); }

static lobe_status eval(const lobe_batch *b) { return lobe_scene_eval(fixture.scene, b); }
static lobe_status sample(const lobe_batch *b) { return lobe_scene_sample(fixture.scene, b); }

static void test_null_arguments(void)
{
	lobe_batch b = good_batch();
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval(NULL, &b), "scene");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval(fixture.scene, NULL), "batch");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_sample(NULL, &b), "scene");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_sample(fixture.scene, NULL), "batch");
	b.wo[1] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "wo[1]");
	b = good_batch();
	b.wi[2] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "wi[2]");
	b = good_batch();
	b.u[0] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "u[0]");
	b = good_batch();
	b.f[1] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "f[1]");
	b = good_batch();
	b.f[0] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "f[0]");
	b = good_batch();
	b.weight[2] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "weight[2]");
	b = good_batch();
	b.f[0] = b.f[1] = b.f[2] = b.pdf = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "every output");
	/* Refused calls wrote nothing. */
	for (int i = 0; i < FIXTURE_N; i++)
		TEST_ASSERT_EQUAL_HEX32(0xeeeeeeeeu, test_float_bits(fixture.out[0][i]));
}

static void test_zero_count(void)
{
	lobe_batch b = good_batch();
	b.count = 0;
	TEST_ASSERT_EQUAL(LOBE_OK, eval(&b));
	TEST_ASSERT_EQUAL(LOBE_OK, sample(&b));
	TEST_ASSERT_EQUAL_HEX32(0xeeeeeeeeu, test_float_bits(fixture.out[0][0]));
}

static void test_absurd_count(void)
{
	lobe_batch b = good_batch();
	b.count = SIZE_MAX;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "count");
}

static void test_material_out_of_range(void)
{
	lobe_batch b = good_batch();
	fixture.material[FIXTURE_N - 1] = 3;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "material[999] = 3");
	TEST_ASSERT_EQUAL_HEX32(0xeeeeeeeeu, test_float_bits(fixture.out[0][0]));
}

static void test_misaligned(void)
{
	lobe_batch b = good_batch();
	b.count = 10;
	b.wo[2] = (const float *)(const void *)((const char *)fixture.in[2] + 1);
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "wo[2]");
	b = good_batch();
	b.count = 10;
	b.event = (uint32_t *)(void *)((char *)fixture.event + 2);
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "event");
}

static void test_overlap(void)
{
	lobe_batch b = good_batch();
	b.count = 100;
	b.f[2] = fixture.out[1] + 99;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "overlaps");
	b.f[2] = fixture.out[1] + 100; /* behind one another is fine */
	TEST_ASSERT_EQUAL(LOBE_OK, eval(&b));
	b = good_batch();
	b.sample_wi[0] = fixture.in[0]; /* in place is not */
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "overlaps");
	b = good_batch();
	for (int k = 0; k < 3; k++)
		b.wi[k] = b.wo[k]; /* inputs may be the same */
	TEST_ASSERT_EQUAL(LOBE_OK, eval(&b));
}

/* A batch gives what the shading functions give, whichever outputs are asked for. */
static void test_results_and_subsets(void)
{
	lobe_bsdf m[3] = {lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.2f, 0.5f, 0.8f))),
			  lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(
				  0.3f, 0.1f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD))),
			  lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.3f, 0.1f, 1.5f))};
	for (int mask = 1; mask < 16; mask++) {
		lobe_batch b = good_batch();
		memset(fixture.out, 0xee, sizeof fixture.out);
		memset(fixture.event, 0xee, sizeof fixture.event);
		for (int k = 0; k < 3; k++) {
			b.f[k] = mask & 1 ? fixture.out[k] : NULL;
			b.sample_wi[k] = mask & 1 ? fixture.out[4 + k] : NULL;
			b.weight[k] = mask & 2 ? fixture.out[7 + k] : NULL;
		}
		b.pdf = mask & 2 ? fixture.out[3] : NULL;
		b.sample_pdf = mask & 4 ? fixture.out[10] : NULL;
		b.event = mask & 8 ? fixture.event : NULL;
		if (mask & 3)
			TEST_ASSERT_EQUAL(LOBE_OK, eval(&b));
		TEST_ASSERT_EQUAL(LOBE_OK, sample(&b));
		for (int i = 0; i < FIXTURE_N; i++) {
			const lobe_vec3 wo = lobe_vec3_make(fixture.in[0][i], fixture.in[1][i], fixture.in[2][i]);
			const lobe_vec3 wi = lobe_vec3_make(fixture.in[3][i], fixture.in[4][i], fixture.in[5][i]);
			const lobe_vec3 u = lobe_vec3_make(fixture.in[6][i], fixture.in[7][i], fixture.in[8][i]);
			const lobe_rgb f = lobe_bsdf_eval(m[fixture.material[i]], wo, wi);
			const lobe_sample s = lobe_bsdf_sample(m[fixture.material[i]], wo, u);
			const float expected[11] = {
				f.r,        f.g,        f.b,    lobe_bsdf_pdf(m[fixture.material[i]], wo, wi),
				s.wi.x,     s.wi.y,     s.wi.z, s.weight.r,
				s.weight.g, s.weight.b, s.pdf};
			const int wanted[11] = {mask & 1, mask & 1, mask & 1, mask & 2, mask & 1, mask & 1,
						mask & 1, mask & 2, mask & 2, mask & 2, mask & 4};
			for (int k = 0; k < 11; k++)
				TEST_ASSERT_EQUAL_HEX32(wanted[k] ? test_float_bits(expected[k]) : 0xeeeeeeeeu,
							test_float_bits(fixture.out[k][i]));
			TEST_ASSERT_EQUAL_HEX32(mask & 8 ? s.event : 0xeeeeeeeeu, fixture.event[i]);
		}
	}
}

/* Scenes of few and of many materials, in random order and in runs, give what the shading functions give: they are
 * sorted by material, by lobe, or not at all. */
static void test_many_materials(void)
{
	static const size_t counts[] = {2, 9, 10, 31, 32, 33, 100};
	static const char *const isas[] = {"baseline", "avx2", "avx512"};
	lobe_bsdf m[100];
	memset(m, 0, sizeof m);
	for (size_t i = 0; i < 100; i++) {
		const float x = 0.1f + 0.008f * (float)i;
		if (i % 4 == 0)
			m[i] = lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(x, 0.5f, 1.0f + x));
		else if (i % 4 == 1)
			m[i] = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(x, 0.5f, 1 - x)));
		else if (i % 4 == 2)
			m[i] = lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(
				x, 0.2f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
		/* else LOBE_KIND_NONE */
	}
	for (size_t test = 0; test < 3 * sizeof counts / sizeof *counts; test++) {
		const uint32_t count = (uint32_t)counts[test / 3];
		lobe_device *d;
		lobe_scene *s;
		setenv("LOBE_ISA", isas[test % 3], 1);
		const lobe_status status = lobe_device_open(&d, "native:1");
		unsetenv("LOBE_ISA");
		if (status != LOBE_OK)
			continue; /* no such instructions here */
		for (uint32_t i = 0; i < FIXTURE_N; i++)
			fixture.material[i] = test_bits(50, i & 512 ? i : i / 64) % count;
		lobe_batch b = good_batch();
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&s, d, m, count), lobe_error_message());
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(s, &b));
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(s, &b));
		for (int i = 0; i < FIXTURE_N; i++) {
			const lobe_vec3 wo = lobe_vec3_make(fixture.in[0][i], fixture.in[1][i], fixture.in[2][i]);
			const lobe_vec3 wi = lobe_vec3_make(fixture.in[3][i], fixture.in[4][i], fixture.in[5][i]);
			const lobe_sample r =
				lobe_bsdf_sample(m[fixture.material[i]], wo,
						 lobe_vec3_make(fixture.in[6][i], fixture.in[7][i], fixture.in[8][i]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(lobe_bsdf_eval(m[fixture.material[i]], wo, wi).g),
						test_float_bits(fixture.out[1][i]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(lobe_bsdf_pdf(m[fixture.material[i]], wo, wi)),
						test_float_bits(fixture.out[3][i]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(r.wi.x), test_float_bits(fixture.out[4][i]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(r.weight.b), test_float_bits(fixture.out[9][i]));
			TEST_ASSERT_EQUAL_HEX32(r.event, fixture.event[i]);
		}
		lobe_scene_destroy(s);
		lobe_device_close(d);
	}
}

/* LOBE_KIND_NONE among the materials shades to nothing, and nothing else is disturbed. */
static void test_no_lobe(void)
{
	lobe_bsdf m[2];
	lobe_scene *s;
	memset(m, 0, sizeof m);
	m[1] = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1)));
	for (int i = 0; i < FIXTURE_N; i++)
		fixture.material[i] = (uint32_t)i & 1;
	lobe_batch b = good_batch();
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&s, fixture.device, m, 2));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(s, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(s, &b));
	for (int i = 0; i < FIXTURE_N; i += 2) {
		TEST_ASSERT_EQUAL_HEX32(0, test_float_bits(fixture.out[0][i]));
		TEST_ASSERT_EQUAL_HEX32(0, test_float_bits(fixture.out[10][i]));
		TEST_ASSERT_EQUAL_HEX32(0, fixture.event[i]);
		TEST_ASSERT_NOT_EQUAL(0, fixture.event[i + 1]);
	}
	b.material = NULL;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(s, &b));
	for (int i = 0; i < FIXTURE_N; i++)
		TEST_ASSERT_EQUAL_HEX32(0, fixture.event[i]);
	lobe_scene_destroy(s);
}

/* Random numbers at and beyond their ends, and directions that are no directions, stay in their own element. */
static void test_elements_are_independent(void)
{
	static float first[13][FIXTURE_N];
	lobe_batch b = good_batch();
	TEST_ASSERT_EQUAL(LOBE_OK, sample(&b));
	memcpy(first, fixture.out, sizeof first);
	fixture.in[0][500] = fixture.in[1][500] = fixture.in[2][500] = NAN;
	fixture.in[6][501] = fixture.in[7][501] = fixture.in[8][501] = 0x1.fffffep-1f;
	TEST_ASSERT_EQUAL(LOBE_OK, sample(&b));
	for (int k = 4; k < 11; k++)
		for (int i = 0; i < FIXTURE_N; i++)
			if (i < 500 || i > 501)
				TEST_ASSERT_EQUAL_HEX32(test_float_bits(first[k][i]),
							test_float_bits(fixture.out[k][i]));
	for (int k = 4; k < 11; k++)
		TEST_ASSERT_EQUAL_HEX32(0, test_float_bits(fixture.out[k][500]));
}

/* One device used from four threads at once: calls take turns, and each thread has its own error message. */
enum { THREADS = 4 };
static float thread_pdf[THREADS][FIXTURE_N];

static void *use_device(void *argument)
{
	const size_t me = (size_t)((float(*)[FIXTURE_N])argument - thread_pdf);
	lobe_batch b = good_batch();
	b.f[0] = b.f[1] = b.f[2] = NULL;
	b.pdf = thread_pdf[me];
	for (int round = 0; round < 50; round++) {
		if (lobe_scene_eval(fixture.scene, &b) != LOBE_OK || lobe_error_message()[0])
			return argument;
		lobe_device *none;
		if (round == 49 && lobe_device_open(&none, "nothing") == LOBE_OK)
			return argument;
	}
	return NULL;
}

static void test_threads(void)
{
	pthread_t threads[THREADS];
	void *failed;
	lobe_batch b = good_batch();
	TEST_ASSERT_EQUAL(LOBE_OK, eval(&b));
	for (int i = 0; i < THREADS; i++)
		TEST_ASSERT_EQUAL(0, pthread_create(&threads[i], NULL, use_device, thread_pdf[i]));
	for (int i = 0; i < THREADS; i++) {
		TEST_ASSERT_EQUAL(0, pthread_join(threads[i], &failed));
		TEST_ASSERT_NULL(failed);
		TEST_ASSERT_EQUAL_MEMORY(fixture.out[3], thread_pdf[i], sizeof fixture.out[3]);
	}
}

/* Material indices of a scene of one material, all 0: of a batch so large that no thread's own memory would hold it
 * at once. */
static void test_many_elements_of_one_material(void)
{
	enum { N = 300000 };
	const lobe_bsdf one = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.5f, 0.5f, 0.5f)));
	float *const zero = calloc(N, sizeof *zero), *const up = malloc(N * sizeof *up), *const pdf = malloc(N * sizeof *pdf);
	uint32_t *const material = calloc(N, sizeof *material);
	TEST_ASSERT_TRUE(zero && up && pdf && material);
	for (size_t i = 0; i < N; i++)
		up[i] = 1.0f;
	for (int threads = 1; threads <= 2; threads++) {
		lobe_device *d;
		lobe_scene *s;
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, threads == 1 ? "native:1" : "native:2"));
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&s, d, &one, 1), lobe_error_message());
		const lobe_batch b = {.count = N,
				      .material = material,
				      .wo = {zero, zero, up},
				      .wi = {zero, zero, up},
				      .pdf = pdf};
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(s, &b), lobe_error_message());
		for (size_t i = 0; i < N; i++)
			TEST_ASSERT_EQUAL_FLOAT(lobe_bsdf_pdf(one, lobe_vec3_make(0, 0, 1), lobe_vec3_make(0, 0, 1)), pdf[i]);
		lobe_scene_destroy(s);
		lobe_device_close(d);
	}
	free(zero);
	free(up);
	free(pdf);
	free(material);
}

/* A caller that rounds upwards gets what every other gets, on each of the threads. */
static void test_rounding_of_the_caller(void)
{
	enum { N = 200000 };
	const lobe_bsdf one = lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(0.3f, 0.1f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
	static float x[N], z[N], pdf[2][N];
	lobe_device *d;
	lobe_scene *s;
	for (size_t i = 0; i < N; i++) {
		z[i] = ((float)i + 0.5f) / N;
		x[i] = sqrtf(1.0f - z[i] * z[i]);
	}
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "native:2"));
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&s, d, &one, 1), lobe_error_message());
	for (int up = 0; up < 2; up++) {
		static float zero[N];
		const lobe_batch b = {.count = N, .wo = {x, zero, z}, .wi = {zero, x, z}, .pdf = pdf[up]};
		if (up)
			TEST_ASSERT_EQUAL(0, fesetround(FE_UPWARD));
		const lobe_status status = lobe_scene_eval(s, &b);
		const int kept = fegetround() == (up ? FE_UPWARD : FE_TONEAREST);
		fesetround(FE_TONEAREST);
		TEST_ASSERT_EQUAL(LOBE_OK, status);
		TEST_ASSERT_TRUE(kept);
	}
	TEST_ASSERT_EQUAL_MEMORY(pdf[0], pdf[1], sizeof pdf[0]);
	lobe_scene_destroy(s);
	lobe_device_close(d);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_many_elements_of_one_material);
	RUN_TEST(test_rounding_of_the_caller);
	RUN_TEST(test_null_arguments);
	RUN_TEST(test_zero_count);
	RUN_TEST(test_absurd_count);
	RUN_TEST(test_material_out_of_range);
	RUN_TEST(test_misaligned);
	RUN_TEST(test_overlap);
	RUN_TEST(test_results_and_subsets);
	RUN_TEST(test_many_materials);
	RUN_TEST(test_no_lobe);
	RUN_TEST(test_elements_are_independent);
	RUN_TEST(test_threads);
	return UNITY_END();
}
