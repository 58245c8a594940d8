/* test_mixed.c - batches of several lobes: of every awkward size against their elements shaded alone, and a large one
 * on OpenCL too. (How elements are sorted and moved: test_native_split.c.) */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>

#include "native.h"
#include "support.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { MATERIALS = 40, MOST = 4097 };

/* An element's inputs, second being wi or u, and what comes of them. */
typedef struct {
	float wo[3], second[3], f[3], pdf, wi[3], weight[3], sample_pdf;
	uint32_t material, event, guard;
} element;

static element e[MOST], expected[MOST];
static lobe_bsdf materials[MATERIALS];

static void make_materials(void)
{
	memset(materials, 0, sizeof materials);
	for (size_t m = 0; m < MATERIALS; m++) {
		const float x = 0.1f + 0.02f * (float)m;
		const lobe_rgb eta = lobe_metal_eta(LOBE_METAL_GOLD), k = lobe_metal_k(LOBE_METAL_GOLD);
		const lobe_bsdf one[6] = {
			lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(x, 0.5f, 1.0f - x))),
			lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(x, 0.2f, eta, k)),
			lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(x, 0.3f, 1.5f)),
			lobe_bsdf_from_beckmann_conductor(lobe_beckmann_conductor_make(x, 0.2f, eta, k)),
			lobe_bsdf_from_ggx_schlick(lobe_ggx_schlick_make(x, 0.2f, lobe_rgb_make(0.9f, x, 0.3f),
									 lobe_rgb_make(1.0f, 1.0f, 1.0f))),
		}; /* one[5] has no lobe */
		materials[m] = one[m % 6];
	}
}

static void make_elements(uint32_t count)
{
	memset(e, 0xcc, sizeof e);
	for (uint32_t i = 0; i < MOST; i++) {
		test_direction(10, i, e[i].wo);
		test_u3(12, i, e[i].second);
		e[i].material = test_bits(13, i) % count;
	}
}

/* Element i by itself, a batch of its material alone. */
static void expect_all(void)
{
	for (uint32_t i = 0; i < MOST; i++) {
		const lobe_bsdf b = materials[e[i].material];
		const lobe_vec3 wo = lobe_vec3_make(e[i].wo[0], e[i].wo[1], e[i].wo[2]);
		const lobe_vec3 v = lobe_vec3_make(e[i].second[0], e[i].second[1], e[i].second[2]);
		const lobe_rgb f = lobe_bsdf_eval(b, wo, v);
		const lobe_sample s = lobe_bsdf_sample(b, wo, v);
		expected[i] = e[i];
		expected[i].f[0] = f.r, expected[i].f[1] = f.g, expected[i].f[2] = f.b;
		expected[i].pdf = lobe_bsdf_pdf(b, wo, v);
		expected[i].wi[0] = s.wi.x, expected[i].wi[1] = s.wi.y, expected[i].wi[2] = s.wi.z;
		expected[i].weight[0] = s.weight.r, expected[i].weight[1] = s.weight.g;
		expected[i].weight[2] = s.weight.b;
		expected[i].sample_pdf = s.pdf;
		expected[i].event = s.event;
	}
}

/* Elements where they are. */
static lobe_batch structs(size_t n)
{
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = n;
	b.material = &e->material;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = &e->wo[k];
		b.wi[k] = b.u[k] = &e->second[k];
		b.f[k] = &e->f[k];
		b.sample_wi[k] = &e->wi[k];
		b.weight[k] = &e->weight[k];
	}
	b.pdf = &e->pdf;
	b.sample_pdf = &e->sample_pdf;
	b.event = &e->event;
	b.stride.material = b.stride.wo = b.stride.wi = b.stride.u = b.stride.f = b.stride.pdf = sizeof *e;
	b.stride.sample_wi = b.stride.weight = b.stride.sample_pdf = b.stride.event = sizeof *e;
	return b;
}

static float packed_in[6][MOST], packed_out[11][MOST + 1];
static uint32_t packed_material[MOST], packed_event[MOST + 1];

/* In arrays that begin, some of them, beside a cache line. */
static lobe_batch arrays(size_t n)
{
	lobe_batch b;
	memset(&b, 0, sizeof b);
	memset(packed_out, 0xcc, sizeof packed_out);
	memset(packed_event, 0xcc, sizeof packed_event);
	for (size_t i = 0; i < MOST; i++) {
		packed_material[i] = e[i].material;
		for (int k = 0; k < 3; k++) {
			packed_in[k][i] = e[i].wo[k];
			packed_in[3 + k][i] = e[i].second[k];
		}
	}
	b.count = n;
	b.material = packed_material;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = packed_in[k];
		b.wi[k] = b.u[k] = packed_in[3 + k];
		b.f[k] = packed_out[k];
		b.sample_wi[k] = packed_out[4 + k];
		b.weight[k] = packed_out[7 + k];
	}
	b.pdf = packed_out[3];
	b.sample_pdf = packed_out[10];
	b.event = packed_event;
	return b;
}

/* The first n of the arrays are what is expected; the rest has not been touched. */
static void take_arrays(size_t n)
{
	for (size_t i = 0; i <= MOST; i++) {
		if (i < n) {
			for (int k = 0; k < 3; k++) {
				e[i].f[k] = packed_out[k][i];
				e[i].wi[k] = packed_out[4 + k][i];
				e[i].weight[k] = packed_out[7 + k][i];
			}
			e[i].pdf = packed_out[3][i];
			e[i].sample_pdf = packed_out[10][i];
			e[i].event = packed_event[i];
			continue;
		}
		for (int k = 0; k < 11; k++)
			TEST_ASSERT_EQUAL_HEX32(0xcccccccc, test_float_bits(packed_out[k][i]));
		TEST_ASSERT_EQUAL_HEX32(0xcccccccc, packed_event[i]);
	}
}

static void shade(lobe_scene *s, const lobe_batch *b)
{
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(s, b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(s, b), lobe_error_message());
}

/* Scenes split by material with few and with many keys, and by lobe; packed and in structs. */
static void test_every_size(void)
{
	static const size_t sizes[] = {0, 1, 15, 16, 17, 63, 64, 65, 2047, 2048, 2049, 2112, 4096, MOST};
	static const uint32_t counts[] = {2, 6, 20, MATERIALS};
	static const char *const isas[] = {"baseline", "avx2", "avx512"};
	make_materials();
	for (size_t test = 0; test < 3 * sizeof counts / sizeof *counts; test++) {
		lobe_device *device;
		lobe_scene *scene;
		setenv("LOBE_ISA", isas[test % 3], 1);
		const lobe_status status = lobe_device_open(&device, "native:1");
		unsetenv("LOBE_ISA");
		if (status != LOBE_OK)
			continue; /* no such instructions here */
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, counts[test / 3]));
		make_elements(counts[test / 3]);
		expect_all();
		for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
			const size_t n = sizes[s];
			make_elements(counts[test / 3]);
			lobe_batch b = structs(n);
			shade(scene, &b);
			TEST_ASSERT_EQUAL(0, memcmp(e, expected, n * sizeof *e));
			for (size_t i = n; i < MOST; i++)
				TEST_ASSERT_EQUAL_HEX32(0xcccccccc, e[i].event);
			make_elements(counts[test / 3]);
			b = arrays(n);
			shade(scene, &b);
			take_arrays(n);
			TEST_ASSERT_EQUAL(0, memcmp(e, expected, n * sizeof *e));
		}
		lobe_scene_destroy(scene);
		lobe_device_close(device);
	}
}

/* Of test_large: seven arrays of results and the events are those that were put aside. */
static void expect_saved(const float *aligned, size_t step, size_t n)
{
	for (size_t k = 0; k < 7; k++)
		TEST_ASSERT_EQUAL(
			0, memcmp(aligned + (6 + k) * step + (k == 4), aligned + (15 + k) * step + (k == 4), n * 4));
	TEST_ASSERT_EQUAL(0, memcmp(aligned + 14 * step, aligned + 22 * step, n * 4));
}

/* A batch whose results go past the caches, on two threads, against itself in parts that do not; arrays that are
 * aligned to cache lines and arrays that are not. */
static void test_large(void)
{
	const size_t n = LOBE_NATIVE_STREAM / 4 / LOBE_OUT_COUNT + 12345, words = n + 32;
	float *const memory = malloc((6 + 7 + 2 + 8) * words * 4 + 64);
	TEST_ASSERT_NOT_NULL(memory);
	float *const aligned = (float *)(void *)(((uintptr_t)memory + 63) / 64 * 64);
	const size_t step = words / 16 * 16;
	lobe_device *device;
	lobe_scene *scene;
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = n;
	uint32_t *const chosen = (uint32_t *)(void *)(aligned + 13 * step);
	for (size_t k = 0; k < 3; k++) {
		b.wo[k] = aligned + k * step;
		b.u[k] = aligned + (3 + k) * step;
		b.sample_wi[k] = aligned + (6 + k) * step;
		b.weight[k] = aligned + (9 + k) * step + (k == 1);
	}
	b.sample_pdf = aligned + 12 * step;
	b.material = chosen;
	b.event = chosen + step;
	for (uint32_t i = 0; i < n; i++) {
		float w[3], u[3];
		test_direction(20, i, w);
		test_u3(21, i, u);
		for (size_t k = 0; k < 3; k++) {
			aligned[k * step + i] = w[k];
			aligned[(3 + k) * step + i] = u[k];
		}
		chosen[i] = test_bits(22, i) % 6;
	}
	make_materials();
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&device, "native:2"), lobe_error_message());
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, 6));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b));
	memcpy(aligned + 15 * step, aligned + 6 * step, 7 * step * 4);
	memcpy(aligned + 22 * step, b.event, n * 4);
	memset(aligned + 6 * step, 0xcc, 7 * step * 4);
	for (size_t first = 0; first < n; first += 100000) {
		lobe_batch part = b;
		part.count = n - first < 100000 ? n - first : 100000;
		part.material += first;
		part.sample_pdf += first;
		part.event += first;
		for (int k = 0; k < 3; k++) {
			part.wo[k] += first;
			part.u[k] += first;
			part.sample_wi[k] += first;
			part.weight[k] += first;
		}
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &part));
	}
	expect_saved(aligned, step, n);
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	/* A processor's OpenCL takes such a batch in tiles. */
	const int there = lobe_device_open(&device, "opencl:0") == LOBE_OK;
	if (there) {
		memset(aligned + 6 * step, 0xcc, 7 * step * 4);
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, device, materials, 6));
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
		expect_saved(aligned, step, n);
		lobe_scene_destroy(scene);
		lobe_device_close(device);
	}
	free(memory);
	if (!there)
		TEST_IGNORE_MESSAGE("no OpenCL device: native alone");
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_every_size);
	RUN_TEST(test_large);
	return UNITY_END();
}
