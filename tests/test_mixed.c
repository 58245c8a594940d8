/* test_mixed.c - batches of several lobes: every form of sorting and moving elements (native_split.h) against the plain
 * one, batches of every awkward size against their elements shaded alone, and a large one on OpenCL too. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>

#include "native.h"
#include "support.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

/* --- sorting and moving ------------------------------------------------------------------------------------------- */

/* NULL: not in this library. */
#define WEAK __attribute__((weak))
extern const lobe_native_split lobe_native_split_baseline WEAK;
extern const lobe_native_split lobe_native_split_avx2 WEAK;
extern const lobe_native_split lobe_native_split_avx512 WEAK;
extern const lobe_native_split lobe_native_split_vbmi2 WEAK;

enum { N = LOBE_NATIVE_SPLIT_MAX, ROOM = LOBE_NATIVE_SPLIT_ROOM, ARRAYS = LOBE_OUT_COUNT, FORMS = 3 };

/* Those beside the plain one that run here. */
static int list_forms(const lobe_native_split *list[FORMS])
{
	int n = 0;
#if defined(__x86_64__)
	if (__builtin_cpu_supports("avx2") && &lobe_native_split_avx2)
		list[n++] = &lobe_native_split_avx2;
	if (__builtin_cpu_supports("avx512bw") && &lobe_native_split_avx512)
		list[n++] = &lobe_native_split_avx512;
	if (__builtin_cpu_supports("avx512vbmi2") && &lobe_native_split_vbmi2)
		list[n++] = &lobe_native_split_vbmi2;
#else
	(void)list;
#endif
	return n;
}

/* The material of element i: at random, all one, in runs, in turns, mostly one, and one key after another. */
enum { ORDERS = 6 };
static uint32_t material_of(int order, uint32_t i, uint32_t n, uint32_t materials)
{
	switch (order) {
	case 0:
		return test_bits(1, i) % materials;
	case 1:
		return materials - 1;
	case 2:
		return test_bits(1, i / 50) % materials;
	case 3:
		return i % materials;
	case 4:
		return test_bits(1, i) % 20 ? 0 : test_bits(2, i) % materials;
	default:
		return (uint32_t)((uint64_t)i * materials / n);
	}
}

typedef struct {
	lobe_native_places places;
	uint32_t begin[LOBE_NATIVE_SPLIT_KEYS], count[LOBE_NATIVE_SPLIT_KEYS];
	uint32_t sorted[ARRAYS][ROOM] LOBE_NATIVE_ALIGNED;
} sorting;

static sorting plain, other;
static uint32_t material[N], key[100], from[ARRAYS][N + 16], joined[ARRAYS][N + 32] LOBE_NATIVE_ALIGNED;

static void sort_and_part(sorting *s, const lobe_native_split *form, uint32_t keys, uint32_t materials, size_t n,
			  int arrays)
{
	void *to[ARRAYS];
	const void *f[ARRAYS];
	memset(s, 0xee, sizeof *s);
	for (int a = 0; a < ARRAYS; a++) {
		to[a] = s->sorted[a];
		f[a] = from[a] + a; /* whole cache lines and others */
	}
	form->sort(&s->places, s->begin, s->count, key, keys, materials, material, n);
	form->part(to, f, arrays, &s->places, n);
}

/* What was sorted, back in its order, by so many elements at a time; nothing else is written. */
static void check_join(const sorting *s, const lobe_native_split *form, size_t n, int arrays, size_t piece, int stream)
{
	void *to[ARRAYS];
	const void *f[ARRAYS];
	memset(joined, 0xcc, sizeof joined);
	for (int a = 0; a < ARRAYS; a++) {
		to[a] = joined[a] + (a % 3 == 1);
		f[a] = s->sorted[a];
	}
	for (size_t i = 0; i < n; i += piece)
		form->join(to, f, arrays, &s->places, i, n - i < piece ? n : i + piece, stream);
	form->settle();
	for (int a = 0; a < ARRAYS; a++) {
		const uint32_t *const x = joined[a] + (a % 3 == 1);
		if (a < arrays && n)
			TEST_ASSERT_EQUAL_HEX32_ARRAY(from[a] + a, x, n);
		for (size_t i = a < arrays ? n : 0; i < N + 16; i++)
			TEST_ASSERT_EQUAL_HEX32(0xcccccccc, x[i]);
		TEST_ASSERT_TRUE(x == joined[a] || joined[a][0] == 0xcccccccc);
	}
}

/* Keys begin at whole vectors, behind one another, and have their elements in order. */
static void check_plain(uint32_t keys, size_t n, int arrays)
{
	uint32_t behind = 0;
	size_t all = 0;
	for (uint32_t k = 0; k < keys; k++) {
		size_t at = plain.begin[k];
		TEST_ASSERT_EQUAL(0, plain.begin[k] % LOBE_NATIVE_SPLIT_VECTOR);
		TEST_ASSERT_GREATER_OR_EQUAL(behind, plain.begin[k]);
		behind = plain.begin[k] + plain.count[k] + LOBE_NATIVE_SPLIT_VECTOR;
		TEST_ASSERT_LESS_OR_EQUAL(ROOM, behind);
		for (size_t i = 0; i < n; i++)
			if (key[material[i]] == k) {
				for (int a = 0; a < arrays; a++)
					TEST_ASSERT_EQUAL_HEX32(from[a][i + (size_t)a], plain.sorted[a][at]);
				at++;
			}
		TEST_ASSERT_EQUAL(plain.begin[k] + plain.count[k], at);
		all += plain.count[k];
	}
	TEST_ASSERT_EQUAL(n, all);
}

static void compare(const lobe_native_split *form, uint32_t keys, uint32_t materials, size_t n, int arrays)
{
	sort_and_part(&other, form, keys, materials, n, arrays);
	TEST_ASSERT_EQUAL_HEX32_ARRAY(plain.begin, other.begin, keys);
	TEST_ASSERT_EQUAL_HEX32_ARRAY(plain.count, other.count, keys);
	for (uint32_t k = 0; k < keys; k++)
		for (int a = 0; a < arrays && plain.count[k]; a++)
			TEST_ASSERT_EQUAL_HEX32_ARRAY(plain.sorted[a] + plain.begin[k],
						      other.sorted[a] + plain.begin[k], plain.count[k]);
	check_join(&other, form, n, arrays, 2 * LOBE_NATIVE_SPLIT_TILE, 0);
	check_join(&other, form, n, arrays, N, 1);
}

static void test_every_form_moves_alike(void)
{
	static const size_t sizes[] = {0, 1, 15, 16, 17, 63, 64, 65, 127, 128, 129, 1000, N - 1, N};
	/* Of so many keys are so many materials: with one each, and with several. */
	static const uint32_t scenes[][2] = {{1, 1},   {2, 2},    {5, 5},   {5, 16},  {5, 17},  {5, 31},
					     {5, 32},  {5, 33},   {5, 100}, {10, 10}, {11, 11}, {13, 13},
					     {14, 14}, {16, 100}, {32, 32}, {33, 100}};
	const lobe_native_split *forms[FORMS];
	const int count = list_forms(forms);
	if (!&lobe_native_split_baseline)
		TEST_IGNORE_MESSAGE("a library without the native device");
	for (uint32_t a = 0; a < ARRAYS; a++)
		for (uint32_t i = 0; i < N + 16; i++)
			from[a][i] = i << 8 | a;
	for (size_t test = 0; test < sizeof scenes / sizeof *scenes * ORDERS; test++) {
		const uint32_t keys = scenes[test / ORDERS][0], materials = scenes[test / ORDERS][1];
		for (uint32_t m = 0; m < materials; m++)
			key[m] = (m * 7 + m / keys) % keys;
		for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
			const size_t n = sizes[s];
			const int arrays = 1 + (int)((test + s) % ARRAYS);
			for (uint32_t i = 0; i < n; i++)
				material[i] = material_of((int)(test % ORDERS), i, (uint32_t)n, materials);
			sort_and_part(&plain, &lobe_native_split_baseline, keys, materials, n, arrays);
			check_plain(keys, n, arrays);
			check_join(&plain, &lobe_native_split_baseline, n, arrays, LOBE_NATIVE_SPLIT_TILE, 0);
			for (int f = 0; f < count; f++)
				compare(forms[f], keys, materials, n, arrays);
		}
	}
}

/* --- batches ------------------------------------------------------------------------------------------------------ */

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
	RUN_TEST(test_every_form_moves_alike);
	RUN_TEST(test_every_size);
	RUN_TEST(test_large);
	return UNITY_END();
}
