/* test_native_split.c - every form of sorting and moving the elements of a batch (native_split.h) against the plain
 * one. */
#include <string.h>

#include "lobe/lobe.h"
#include "native.h"
#include "support.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

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
	size_t natives = 0;
	/* This call draws the device's objects into the program, which weak names do not. */
	if (lobe_device_count("native", &natives) != LOBE_OK || natives == 0)
		TEST_IGNORE_MESSAGE("a library without the native device");
	TEST_ASSERT_NOT_NULL(&lobe_native_split_baseline);
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

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_every_form_moves_alike);
	return UNITY_END();
}
