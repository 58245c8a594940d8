/* test_opencl_vectors.c - PoCL's kernels are vectorised, in the widest registers that there are: read off the machine
 * code that it leaves in its cache. A branch or a call that somebody puts into a lobe would make it shade one element
 * at a time, and its own choice for AVX-512 would be vectors of half the width (cl/kernels.cl). */
#define _XOPEN_SOURCE 700
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cases.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "unity.h"

static char folder[] = "/tmp/lobe-vectors-XXXXXX";
static lobe_device *device; /* PoCL's; NULL: the tests are left out, for this reason: */
static const char *reason;
static const char *wide, *half;    /* registers: the widest, and what the compiler would rather have; or NULL */
static const char *kernel_at_hand; /* the beginning of names; nftw hands its function no argument of ours */
static int kernels, not_vectorised;

/* A kernel is vectorised when it is mostly done in wide registers. The loop over what is left of a share is there too,
 * and is scalar. */
static int look_at(const char *path, const struct stat *s, int type, struct FTW *where)
{
	const char *const name = strstr(path, kernel_at_hand);
	const size_t length = strlen(path);
	char command[1024], line[512];
	int in_wide = 0, in_half = 0;
	FILE *code;
	(void)s;
	(void)where;
	if (type != FTW_F || !name || strcmp(path + length - 3, ".so") != 0)
		return 0;
	snprintf(command, sizeof command, "objdump -d --no-show-raw-insn '%s'", path);
	code = popen(command, "r");
	TEST_ASSERT_NOT_NULL(code);
	while (fgets(line, sizeof line, code)) {
		in_wide += strstr(line, wide) != NULL;
		in_half += half && strstr(line, half);
	}
	TEST_ASSERT_EQUAL(0, pclose(code));
	kernels++;
	if (in_wide < 20 || in_half > in_wide) {
		not_vectorised++;
		printf("  %.*s: %d instructions with %s\n", (int)strcspn(name, "/"), name, in_wide, wide);
	}
	return 0;
}

/* Counts the kernels of a lobe. */
static void look(const char *lobe)
{
	char beginning[128];
	snprintf(beginning, sizeof beginning, "lobe_kernel_%s_", lobe);
	kernel_at_hand = beginning;
	kernels = not_vectorised = 0;
	nftw(folder, look_at, 16, FTW_PHYS);
}

static int remove_entry(const char *path, const struct stat *s, int type, struct FTW *where)
{
	(void)s;
	(void)type;
	(void)where;
	return remove(path);
}

/* Launches a scene's kernels for one element: samples, by one material and by index; f and pdf together. */
static void launch(const lobe_bsdf *materials, size_t count, int with_eval)
{
	static const uint32_t material[1] = {0};
	static float out[INPUTS_OUTPUTS];
	const inputs in = inputs_alloc(1);
	lobe_batch b = inputs_batch(in, NULL, out);
	lobe_scene *scene;
	inputs_random(in, 0);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, count), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	if (with_eval)
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &b), lobe_error_message());
	b.material = material;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &b), lobe_error_message());
	lobe_scene_destroy(scene);
	inputs_free(in);
}

static void check(lobe_uint kind, const char *name)
{
	const test_case *c = NULL;
	int with_eval;
	for (size_t i = 0; i < case_count() && !c; i++)
		c = case_at(i)->kind == kind ? case_at(i) : NULL;
	TEST_ASSERT_NOT_NULL_MESSAGE(c, name);
	with_eval = !(c->flags & CASE_DELTA_ONLY);
	launch(&c->bsdf, 1, with_eval);
	look(name);
	TEST_ASSERT_EQUAL_MESSAGE(2 + with_eval, kernels, name);
	TEST_ASSERT_EQUAL_MESSAGE(0, not_vectorised, name);
}

static void test_kernels_are_vectorised(void)
{
	if (!device)
		TEST_IGNORE_MESSAGE(reason);
#define LOBE_X(NAME, name, kind)                                                                                       \
	if (strncmp(#name, "microfacet_", 11) != 0)                                                                    \
		check(LOBE_KIND_##NAME, #name);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
}

/* With all choices open, a lobe that chooses at run time calls what it chooses. */
static void test_notices_a_call(void)
{
	lobe_bsdf materials[64];
	size_t count = 0;
	if (!device)
		TEST_IGNORE_MESSAGE(reason);
	for (size_t i = 0; i < case_count() && count < sizeof materials / sizeof *materials; i++)
		if (case_at(i)->kind == LOBE_KIND_MICROFACET_CONDUCTOR)
			materials[count++] = case_at(i)->bsdf;
	launch(materials, count, 0);
	look("microfacet_conductor");
	TEST_ASSERT_EQUAL(2, kernels);
	TEST_ASSERT_EQUAL(2, not_vectorised);
}

/* The first device of PoCL, with an empty cache of its own: it looks for the folder's name once. */
static void open_device(void)
{
	size_t count = 0;
	char name[32];
#if defined(__x86_64__) && defined(__GNUC__)
	wide = __builtin_cpu_supports("avx512vl") ? "%zmm" : __builtin_cpu_supports("avx2") ? "%ymm" : NULL;
	half = wide && strcmp(wide, "%zmm") == 0 ? "%ymm" : NULL;
#endif
	reason = "no objdump, or a processor whose registers it does not know";
	if (!wide || system("objdump --version >/dev/null 2>&1") != 0)
		return;
	reason = "no PoCL";
	TEST_ASSERT_NOT_NULL(mkdtemp(folder));
	setenv("POCL_CACHE_DIR", folder, 1);
	setenv("LOBE_CACHE_DIR", "", 1);
	lobe_device_count("opencl", &count);
	for (size_t i = 0; i < count && !device; i++) {
		snprintf(name, sizeof name, "opencl:%lu", (unsigned long)i);
		if (lobe_device_open(&device, name) == LOBE_OK &&
		    !strstr(lobe_device_name(device), "Portable Computing Language")) {
			lobe_device_close(device);
			device = NULL;
		}
	}
}

void setUp(void) {}
void tearDown(void) {}

int main(void)
{
	int failed;
	open_device();
	UNITY_BEGIN();
	RUN_TEST(test_kernels_are_vectorised);
	RUN_TEST(test_notices_a_call);
	failed = UNITY_END();
	if (device)
		lobe_device_close(device);
	nftw(folder, remove_entry, 16, FTW_PHYS | FTW_DEPTH);
	return failed;
}
