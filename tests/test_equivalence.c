/* test_equivalence.c - every lobe, every verb: each OpenCL device, any number of threads and any instruction set give
 * the bits of the scalar functions. Not one bit may differ. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "scalar.h"
#include "support.h"
#include "unity.h"

/* BLOCK: elements at a time, few enough that their arrays keep to memory that is already there. */
enum { OUTPUTS = 12, BLOCK = 1 << 18, MAX_CASES = 256 };

/* Results of a batch: f, pdf, sample_wi, weight, sample_pdf, event. */
typedef struct {
	float *array[OUTPUTS];
} results;

static const char *const output_name[OUTPUTS] = {"f.r",  "f.g",      "f.b",      "pdf",      "wi.x", "wi.y",
						 "wi.z", "weight.r", "weight.g", "weight.b", "spdf", "event"};

static results results_alloc(size_t count)
{
	results r;
	for (int k = 0; k < OUTPUTS; k++) {
		r.array[k] = malloc(count * 4);
		TEST_ASSERT_NOT_NULL(r.array[k]);
		memset(r.array[k], 0xee, count * 4);
	}
	return r;
}

static void results_free(results r)
{
	for (int k = 0; k < OUTPUTS; k++)
		free(r.array[k]);
}

void setUp(void) {}
void tearDown(void) {}

/* --- the scenes: the cases of one lobe, or of all ----------------------------------------------------------------- */

static lobe_bsdf materials[MAX_CASES];
static const char *material_name[MAX_CASES];
static size_t material_count;

static void use_cases_of(lobe_uint kind)
{
	material_count = 0;
	for (size_t i = 0; i < case_count() && material_count < MAX_CASES; i++)
		if (kind == LOBE_KIND_NONE || case_at(i)->kind == kind) {
			material_name[material_count] = case_at(i)->name;
			materials[material_count++] = case_at(i)->bsdf;
		}
	TEST_ASSERT_GREATER_THAN(0, material_count);
	if (kind == LOBE_KIND_NONE && material_count < MAX_CASES) {
		material_name[material_count] = "no lobe";
		memset(&materials[material_count], 0, sizeof *materials);
		materials[material_count++].kind = LOBE_KIND_NONE;
	}
}

/* Material of each element: blocks of a hundred or so, and singles. */
static uint32_t *assign_materials(size_t count, uint32_t stream)
{
	uint32_t *m = malloc(count * sizeof *m);
	TEST_ASSERT_NOT_NULL(m);
	for (size_t i = 0; i < count; i++) {
		const size_t at = i & 4096 ? i : i / 128;
		m[i] = test_bits(stream, at) % (uint32_t)material_count;
	}
	return m;
}

/* --- two ways to shade: scalar functions, and a device -------------------------------------------------------------- */

static void shade_scalar(inputs in, results out, const uint32_t *material)
{
	scalar_shade(materials, material, in, out.array);
}

/* Both outputs of eval at once, then each alone must be the same; likewise wi and event of a sample alone. */
static void shade_device(lobe_scene *scene, inputs in, results out, const uint32_t *material, int subsets)
{
	lobe_batch b = inputs_batch_to(in, material, out.array);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	if (!subsets) {
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
		return;
	}
	for (int k = 0; k < 3; k++) {
		b.f[k] = NULL;
		b.weight[k] = NULL;
	}
	b.sample_pdf = NULL;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	b = inputs_batch_to(in, material, out.array);
	b.pdf = NULL;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
}

/* Differing 32-bit words; prints the first few. */
static size_t differences(inputs in, results a, results b, const uint32_t *material, const char *what)
{
	size_t count = 0;
	for (int k = 0; k < OUTPUTS; k++) {
		if (memcmp(a.array[k], b.array[k], in.count * sizeof(float)) == 0)
			continue;
		for (size_t i = 0; i < in.count; i++) {
			const uint32_t x = test_float_bits(a.array[k][i]), y = test_float_bits(b.array[k][i]);
			if (x == y)
				continue;
			if (count++ < 3)
				printf("%s: %s %s: %08x, scalar %08x; wo %a %a %a wi %a %a %a u %a %a %a\n", what,
				       material_name[material ? material[i] : 0], output_name[k], y, x,
				       (double)in.array[0][i], (double)in.array[1][i], (double)in.array[2][i],
				       (double)in.array[3][i], (double)in.array[4][i], (double)in.array[5][i],
				       (double)in.array[6][i], (double)in.array[7][i], (double)in.array[8][i]);
		}
	}
	return count;
}

/* --- devices -------------------------------------------------------------------------------------------------------- */

enum { MAX_DEVICES = 16 };
static struct {
	lobe_device *device;
	char what[300];
} devices[MAX_DEVICES];
static int device_count;

static void open_device(const char *name, const char *isa)
{
	lobe_device *d;
	if (isa)
		setenv("LOBE_ISA", isa, 1);
	const lobe_status status = lobe_device_open(&d, name);
	unsetenv("LOBE_ISA");
	if (status == LOBE_ERROR_DEVICE && (isa || strncmp(name, "opencl", 6) == 0)) {
		printf("skipped: %s\n",
		       lobe_error_message()); /* no such instructions here, or a device below the standard */
		return;
	}
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, status, lobe_error_message());
	devices[device_count].device = d;
	snprintf(devices[device_count].what, sizeof devices->what, "%s", lobe_device_name(d));
	device_count++;
}

static void open_devices(void)
{
	size_t opencl = 0;
	open_device("native:1", "baseline");
	open_device("native:1", "avx2");
	open_device("native:1", "avx512");
	open_device("native:2", NULL);
	open_device("native:5", NULL);
	const int native = device_count;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_count("opencl", &opencl), lobe_error_message());
	for (size_t i = 0; i < opencl && device_count < MAX_DEVICES; i++) {
		char name[32];
		snprintf(name, sizeof name, "opencl:%zu", i);
		open_device(name, NULL);
	}
	if (device_count == native)
		TEST_IGNORE_MESSAGE("no usable OpenCL device: native against native alone");
}

static void close_devices(void)
{
	while (device_count > 0)
		lobe_device_close(devices[--device_count].device);
}

/* The current materials on every device against the scalar functions. */
static size_t compare_all(inputs in, const uint32_t *material, int subsets)
{
	results scalar = results_alloc(in.count);
	size_t total = 0;
	shade_scalar(in, scalar, material);
	for (int d = 0; d < device_count; d++) {
		results got = results_alloc(in.count);
		lobe_scene *scene;
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK,
					  lobe_scene_create(&scene, devices[d].device, materials, material_count),
					  lobe_error_message());
		shade_device(scene, in, got, material, subsets);
		total += differences(in, scalar, got, material, devices[d].what);
		lobe_scene_destroy(scene);
		results_free(got);
	}
	results_free(scalar);
	return total;
}

static size_t random_inputs(lobe_uint kind, size_t count, uint32_t stream)
{
	size_t total = 0;
	use_cases_of(kind);
	for (size_t first = 0; first < count; first += BLOCK) {
		inputs in = inputs_alloc(count - first < BLOCK ? count - first : BLOCK);
		uint32_t *material = assign_materials(in.count, stream);
		inputs_random(in, first);
		total += compare_all(in, material, first / BLOCK % 2 == 1);
		free(material);
		inputs_free(in);
	}
	return total;
}

/* Each case alone, as a scene of one material (the loops with constants taken out), on all extreme inputs. */
static size_t extreme_inputs(lobe_uint kind)
{
	inputs in = inputs_extreme();
	size_t total = 0, cases = 0;
	for (size_t i = 0; i < case_count(); i++)
		if (case_at(i)->kind == kind) {
			materials[0] = case_at(i)->bsdf;
			material_name[0] = case_at(i)->name;
			material_count = 1;
			total += compare_all(in, NULL, (int)(i & 1));
			cases++;
		}
	printf("  %zu cases of %zu extreme inputs\n", cases, in.count);
	inputs_free(in);
	return total;
}

/* A million of each lobe: a difference in 3 of a million elements is missed once in twenty times. Every second block
 * asks for subsets of the outputs. The inputs, which cost as much as shading, are the same for all lobes. */
static void test_random_inputs(void)
{
	const size_t count = (size_t)(test_long() ? 4 : 1) << 20, count_apart = test_long() ? count : (size_t)1 << 15;
	size_t total[LOBE_KIND_LIMIT] = {0}, all = 0;
	inputs in = inputs_alloc(BLOCK);
	for (size_t first = 0; first < count; first += BLOCK) {
		inputs_random(in, first);
#define RANDOM(kind, limit)                                                                                            \
	if (first < (limit)) {                                                                                         \
		inputs some = in;                                                                                      \
		some.count = (limit)-first < BLOCK ? (limit)-first : BLOCK;                                            \
		use_cases_of(kind);                                                                                    \
		uint32_t *material = assign_materials(some.count, 30 + (kind));                                        \
		total[kind] += compare_all(some, material, first / BLOCK % 2 == 1);                                    \
		free(material);                                                                                        \
	}
#define LOBE_X(NAME, name, kind) RANDOM(kind, count)
/* Those that choose at run time are up to a thousand times slower. */
#define LOBE_X_TABLED(NAME, name, kind) RANDOM(kind, count_apart)
#include "lobe/lobes/lobes.def"
#undef LOBE_X
		printf("  %zu of %zu random inputs of each lobe (run-time choices: %zu), %d devices\n", first + BLOCK,
		       count, count_apart, device_count);
	}
	inputs_free(in);
#define LOBE_X(NAME, name, kind)                                                                                       \
	if (total[kind])                                                                                               \
		printf("  %s: %zu words differ\n", #name, total[kind]);                                                \
	all += total[kind];
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	TEST_ASSERT_EQUAL_UINT(0, all);
}

/* The scalar functions of this program, compiled for this processor, against those of any. */
static void test_plain_scalar_functions(void)
{
	inputs in = inputs_alloc(BLOCK), extreme = inputs_extreme();
	results a = results_alloc(BLOCK), b = results_alloc(BLOCK);
	use_cases_of(LOBE_KIND_NONE);
	uint32_t *material = assign_materials(BLOCK, 80);
	inputs_random(in, 5000000);
	shade_scalar(in, a, material);
	scalar_shade_plain(materials, material, in, b.array);
	size_t total = differences(in, a, b, material, "plain");
	TEST_ASSERT_LESS_THAN(BLOCK, extreme.count);
	for (size_t i = 0; i < 8; i++) {
		/* Each element with another material in each turn. */
		for (size_t k = 0; k < extreme.count; k++)
			material[k] = (uint32_t)((k * 7919 + i * material_count / 8) % material_count);
		shade_scalar(extreme, a, material);
		scalar_shade_plain(materials, material, extreme, b.array);
		total += differences(extreme, a, b, material, "plain");
	}
	free(material);
	results_free(a);
	results_free(b);
	inputs_free(in);
	inputs_free(extreme);
	TEST_ASSERT_EQUAL_UINT(0, total);
}

static void test_extreme_inputs(void)
{
#define LOBE_X(NAME, name, kind) TEST_ASSERT_EQUAL_MESSAGE(0, extreme_inputs(kind), #name);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
}

static void test_mixed_lobes(void) { TEST_ASSERT_EQUAL(0, random_inputs(LOBE_KIND_NONE, 300007, 77)); }

/* Odd sizes: shorter than a vector, around blocks and chunks, primes. */
static void test_sizes(void)
{
	static const size_t sizes[] = {1, 2, 3, 7, 8, 9, 31, 255, 256, 257, 1009, 8191, 8192, 8193, 16411};
	size_t total = 0;
	for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
		total += random_inputs(LOBE_KIND_NONE, sizes[i], 78);
		total += random_inputs(LOBE_KIND_GGX_DIELECTRIC, sizes[i], 79);
	}
	TEST_ASSERT_EQUAL(0, total);
}

/* One bit turned in one output is seen. */
static void test_notices_one_bit(void)
{
	inputs in = inputs_alloc(1000);
	results a = results_alloc(in.count), b = results_alloc(in.count);
	use_cases_of(LOBE_KIND_LAMBERT);
	inputs_random(in, 0);
	shade_scalar(in, a, NULL);
	shade_scalar(in, b, NULL);
	TEST_ASSERT_EQUAL(0, differences(in, a, b, NULL, "planted"));
	uint32_t bits = test_float_bits(b.array[3][500]) ^ 1;
	memcpy(&b.array[3][500], &bits, 4);
	TEST_ASSERT_EQUAL(1, differences(in, a, b, NULL, "planted"));
	results_free(a);
	results_free(b);
	inputs_free(in);
}

int main(void)
{
	setvbuf(stdout, NULL, _IOLBF, 0);
	UNITY_BEGIN();
	RUN_TEST(open_devices);
	RUN_TEST(test_notices_one_bit);
	RUN_TEST(test_plain_scalar_functions);
	RUN_TEST(test_sizes);
	RUN_TEST(test_mixed_lobes);
	RUN_TEST(test_extreme_inputs);
	RUN_TEST(test_random_inputs);
	RUN_TEST(close_devices);
	return UNITY_END();
}
