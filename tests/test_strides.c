/* test_strides.c - batches in arrays of structs: the bits of packed ones, nothing else touched, overlap decided
 * exactly. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "batch_fixture.h"
#include "cl_faults.h"
#include "lobe/lobe.h"
#include "support.h"
#include "unity.h"

void setUp(void) { fixture_open(); }
void tearDown(void) { fixture_close(); }

static lobe_status eval(const lobe_batch *b) { return lobe_scene_eval(fixture.scene, b); }
static lobe_status sample(const lobe_batch *b) { return lobe_scene_sample(fixture.scene, b); }

/* All arrays of good_batch as members of one struct, among others that are nobody's business. */
typedef struct {
	float wo[3];
	uint32_t guard0;
	float wi[3], u[3];
	uint32_t material;
	float f[3], pdf;
	uint32_t guard1;
	float sample_wi[3], weight[3], sample_pdf;
	uint32_t event, guard2;
} hit;

static hit hits[FIXTURE_N];

static lobe_batch struct_batch(void)
{
	lobe_batch b;
	for (size_t i = 0; i < FIXTURE_N; i++) {
		hit *const h = &hits[i];
		memset(h, 0xcc, sizeof *h);
		h->material = fixture.material[i];
		for (int k = 0; k < 3; k++) {
			h->wo[k] = fixture.in[k][i];
			h->wi[k] = fixture.in[3 + k][i];
			h->u[k] = fixture.in[6 + k][i];
		}
	}
	memset(&b, 0, sizeof b);
	b.count = FIXTURE_N;
	b.material = &hits->material;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = &hits->wo[k];
		b.wi[k] = &hits->wi[k];
		b.u[k] = &hits->u[k];
		b.f[k] = &hits->f[k];
		b.sample_wi[k] = &hits->sample_wi[k];
		b.weight[k] = &hits->weight[k];
	}
	b.pdf = &hits->pdf;
	b.sample_pdf = &hits->sample_pdf;
	b.event = &hits->event;
	b.stride.material = b.stride.wo = b.stride.wi = b.stride.u = b.stride.f = b.stride.pdf = sizeof(hit);
	b.stride.sample_wi = b.stride.weight = b.stride.sample_pdf = b.stride.event = sizeof(hit);
	return b;
}

/* What struct_batch must hold after both calls, by a packed batch; nothing else in the structs has changed. */
static void check_structs(lobe_scene *s, int mixed)
{
	lobe_batch b = good_batch();
	b.material = mixed ? fixture.material : NULL;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(s, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(s, &b), lobe_error_message());
	for (size_t i = 0; i < FIXTURE_N; i++) {
		const hit *const h = &hits[i];
		for (int k = 0; k < 3; k++) {
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[k][i]), test_float_bits(h->f[k]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[4 + k][i]),
						test_float_bits(h->sample_wi[k]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[7 + k][i]), test_float_bits(h->weight[k]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.in[k][i]), test_float_bits(h->wo[k]));
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.in[6 + k][i]), test_float_bits(h->u[k]));
		}
		TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[3][i]), test_float_bits(h->pdf));
		TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[10][i]), test_float_bits(h->sample_pdf));
		TEST_ASSERT_EQUAL_HEX32(fixture.event[i], h->event);
		TEST_ASSERT_EQUAL_HEX32(0xcccccccc, h->guard0);
		TEST_ASSERT_EQUAL_HEX32(0xcccccccc, h->guard1);
		TEST_ASSERT_EQUAL_HEX32(0xcccccccc, h->guard2);
	}
}

static void shade_structs(lobe_scene *s, int mixed)
{
	lobe_batch b = struct_batch();
	b.material = mixed ? b.material : NULL;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(s, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(s, &b), lobe_error_message());
	check_structs(s, mixed);
}

/* Outputs that are not wanted are not written; packed arrays beside strided ones. */
static void shade_some_of_structs(lobe_scene *s)
{
	static float weight[3][FIXTURE_N];
	lobe_batch b = struct_batch();
	for (int k = 0; k < 3; k++) {
		b.f[k] = NULL;
		b.sample_wi[k] = NULL;
		b.weight[k] = weight[k];
		b.u[k] = fixture.in[6 + k];
	}
	b.stride.weight = b.stride.u = 0;
	b.event = NULL;
	b.stride.event = 1; /* of no array */
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(s, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(s, &b), lobe_error_message());
	b = good_batch();
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(s, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(s, &b));
	for (size_t i = 0; i < FIXTURE_N; i++) {
		TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[3][i]), test_float_bits(hits[i].pdf));
		TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[10][i]), test_float_bits(hits[i].sample_pdf));
		TEST_ASSERT_EQUAL_HEX32(0xcccccccc, hits[i].event);
		for (int k = 0; k < 3; k++) {
			TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[7 + k][i]), test_float_bits(weight[k][i]));
			TEST_ASSERT_EQUAL_HEX32(0xcccccccc, test_float_bits(hits[i].f[k]));
			TEST_ASSERT_EQUAL_HEX32(0xcccccccc, test_float_bits(hits[i].sample_wi[k]));
		}
	}
}

static void shade_structs_on(lobe_device *d)
{
	lobe_bsdf m[3];
	lobe_scene *s;
	memset(m, 0, sizeof m);
	m[0] = lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(0.3f, 0.1f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
	m[1] = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.2f, 0.5f, 0.8f)));
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&s, d, m, 3), lobe_error_message());
	shade_structs(s, 1);
	shade_structs(s, 0);
	shade_some_of_structs(s);
	lobe_scene_destroy(s);
}

static void test_arrays_of_structs(void)
{
	static const char *const isas[] = {"baseline", "avx2", "avx512"};
	for (size_t i = 0; i < sizeof isas / sizeof *isas; i++) {
		lobe_device *d;
		setenv("LOBE_ISA", isas[i], 1);
		if (lobe_device_open(&d, "native:2") == LOBE_OK) {
			shade_structs_on(d);
			lobe_device_close(d);
		}
		unsetenv("LOBE_ISA");
	}
}

static void test_arrays_of_structs_opencl(void)
{
	lobe_device *d;
	NEEDS_OPENCL();
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&d, "opencl"), lobe_error_message());
	shade_structs_on(d);
	lobe_device_close(d);
}

/* 200000 elements in one struct of two words, so that more than one part is packed. */
static void shade_parts(lobe_device *d)
{
	enum { MANY = 200000 };
	float *const twice = malloc(MANY * 2 * sizeof *twice), *const pdf = malloc(MANY * 2 * sizeof *pdf);
	lobe_scene *s;
	lobe_bsdf m = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1)));
	lobe_batch b;
	TEST_ASSERT_TRUE(twice && pdf);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&s, d, &m, 1), lobe_error_message());
	for (size_t i = 0; i < 2 * MANY; i++)
		twice[i] = i % 2 ? -1.0f : (float)(i + 1) / (2 * MANY);
	memset(pdf, 0xee, MANY * 2 * sizeof *pdf);
	memset(&b, 0, sizeof b);
	b.count = MANY;
	b.pdf = pdf;
	b.stride.pdf = b.stride.wo = b.stride.wi = 8;
	for (int k = 0; k < 3; k++)
		b.wo[k] = b.wi[k] = twice;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(s, &b), lobe_error_message());
	for (size_t i = 0; i < MANY; i++) {
		const lobe_vec3 w = lobe_vec3_make(twice[2 * i], twice[2 * i], twice[2 * i]);
		const float expected = lobe_lambert_pdf(m.as.lambert, w, w);
		TEST_ASSERT_EQUAL_HEX32(test_float_bits(expected), test_float_bits(pdf[2 * i]));
		TEST_ASSERT_EQUAL_HEX32(0xeeeeeeee, test_float_bits(pdf[2 * i + 1]));
	}
	lobe_scene_destroy(s);
	free(twice);
	free(pdf);
}

static void test_long_arrays_of_structs(void)
{
	lobe_device *d;
	shade_parts(fixture.device);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "native:3"));
	shade_parts(d);
	lobe_device_close(d);
}

static void test_long_arrays_of_structs_opencl(void)
{
	lobe_device *d;
	NEEDS_OPENCL();
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&d, "opencl"), lobe_error_message());
	shade_parts(d);
	lobe_device_close(d);
}

/* Structs of vectors alone that end where the memory ends: not a byte behind them is touched. */
static void test_structs_at_the_end_of_memory(void)
{
	typedef struct {
		float wo[3], wi[3], f[3];
	} hit_of_vectors;
	enum { MOST = 21 };
	const size_t page = (size_t)sysconf(_SC_PAGESIZE);
	char *const memory = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	TEST_ASSERT_TRUE(memory != MAP_FAILED);
	TEST_ASSERT_EQUAL(0, mprotect(memory + page, page, PROT_NONE));
	for (size_t n = 1; n <= MOST; n++) {
		hit_of_vectors *const h = (hit_of_vectors *)(void *)(memory + page) - n;
		lobe_batch packed = good_batch(), b;
		memset(&b, 0, sizeof b);
		b.count = packed.count = n;
		b.stride.wo = b.stride.wi = b.stride.f = sizeof *h;
		for (int k = 0; k < 3; k++) {
			for (size_t i = 0; i < n; i++) {
				h[i].wo[k] = fixture.in[k][i];
				h[i].wi[k] = fixture.in[3 + k][i];
			}
			b.wo[k] = &h->wo[k];
			b.wi[k] = &h->wi[k];
			b.f[k] = &h->f[k];
		}
		packed.material = NULL;
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, eval(&packed), lobe_error_message());
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, eval(&b), lobe_error_message());
		for (size_t i = 0; i < n; i++)
			for (int k = 0; k < 3; k++) {
				TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.out[k][i]),
							test_float_bits(h[i].f[k]));
				TEST_ASSERT_EQUAL_HEX32(test_float_bits(fixture.in[3 + k][i]),
							test_float_bits(h[i].wi[k]));
			}
	}
	TEST_ASSERT_EQUAL(0, munmap(memory, 2 * page));
}

static void test_bad_strides(void)
{
	lobe_batch b = struct_batch();
	b.stride.wo = 6;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "batch->stride.wo is 6");
	b = struct_batch();
	b.stride.material = 2;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "batch->stride.material is 2");
	b = struct_batch();
	b.stride.sample_pdf = 1;
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "batch->stride.sample_pdf is 1");
	b = struct_batch();
	b.stride.wi = SIZE_MAX / 4 * 4 - 4;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "batch->count is 1000, too many for memory from batch->wi[0]");
	b = struct_batch();
	hits[7].material = 3;
	assert_refused(LOBE_ERROR_ARGUMENT, eval(&b), "material[7] = 3");
	TEST_ASSERT_EQUAL_HEX32(0xcccccccc, test_float_bits(hits[0].f[0]));
}

/* Whether two outputs may lie so: start and stride of each in words. */
static int may_lie(size_t start, size_t stride, size_t other_start, size_t other_stride, size_t count)
{
	static float words[4096];
	lobe_batch b = good_batch();
	b.count = count;
	b.sample_pdf = words + start;
	b.stride.sample_pdf = 4 * stride;
	b.event = (uint32_t *)(void *)(words + other_start);
	b.stride.event = 4 * other_stride;
	return sample(&b) == LOBE_OK;
}

/* Against marking every word. */
static void test_overlap_of_strided(void)
{
	size_t refused = 0, allowed = 0;
	for (uint32_t i = 0; i < 20000; i++) {
		unsigned char taken[4096] = {0};
		const size_t count = 1 + test_bits(40, i) % 12, f_stride = 1 + test_bits(41, i) % 9,
			     pdf_stride = 1 + test_bits(42, i) % 9, f = test_bits(43, i) % 80,
			     pdf = test_bits(44, i) % 80;
		int meet = 0;
		for (size_t k = 0; k < count; k++)
			taken[f + k * f_stride] = 1;
		for (size_t k = 0; k < count; k++)
			meet |= taken[pdf + k * pdf_stride];
		TEST_ASSERT_EQUAL(!meet, may_lie(f, f_stride, pdf, pdf_stride, count));
		refused += meet != 0;
		allowed += !meet;
	}
	TEST_ASSERT_GREATER_THAN(1000, refused);
	TEST_ASSERT_GREATER_THAN(1000, allowed);
	/* An output on an input of the same structs, and on the materials. */
	lobe_batch b = struct_batch();
	b.pdf = &hits->u[1];
	TEST_ASSERT_EQUAL(LOBE_OK, eval(&b)); /* u is no input of eval */
	b.sample_pdf = &hits->u[1];
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "output batch->sample_pdf overlaps batch->u[1]");
	b = struct_batch();
	b.event = &hits->material + 0;
	assert_refused(LOBE_ERROR_ARGUMENT, sample(&b), "output batch->event overlaps batch->material");
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_arrays_of_structs);
	RUN_TEST(test_arrays_of_structs_opencl);
	RUN_TEST(test_long_arrays_of_structs);
	RUN_TEST(test_long_arrays_of_structs_opencl);
	RUN_TEST(test_structs_at_the_end_of_memory);
	RUN_TEST(test_bad_strides);
	RUN_TEST(test_overlap_of_strided);
	return UNITY_END();
}
