/* test_vectors.c - the known-answer vectors in tests/vectors/ come out bit by bit: of the scalar functions, of the
 * native device in each instruction set, and of each OpenCL device. tool_vectors.c tells the format. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "lobe/lobe.h"
#include "support.h"
#include "unity.h"

enum { MAX_LINES = 4096, EVAL_OUT = 4, SAMPLE_OUT = 8 };

/* All lines of one verb: inputs and expected outputs as structure of arrays, and each line's case. */
typedef struct {
	size_t count;
	int outputs;
	uint32_t material[MAX_LINES];
	float in[6][MAX_LINES], out[SAMPLE_OUT][MAX_LINES];
} lines;

static lines eval_lines, sample_lines;
static lobe_bsdf materials[256];
static size_t material_count;

void setUp(void) {}
void tearDown(void) {}

static float next_float(char **at)
{
	char *end;
	const float x = strtof(*at, &end);
	TEST_ASSERT_TRUE_MESSAGE(end != *at, "a number is missing");
	*at = end;
	return x;
}

static void add_line(lines *to, char *at)
{
	const size_t i = to->count++;
	TEST_ASSERT_LESS_THAN(MAX_LINES, i);
	to->material[i] = (uint32_t)material_count - 1;
	for (int k = 0; k < 6; k++)
		to->in[k][i] = next_float(&at);
	for (int k = 0; k < to->outputs; k++)
		to->out[k][i] = next_float(&at);
	if (to->outputs == SAMPLE_OUT) { /* the event, a whole number */
		const uint32_t event = (uint32_t)to->out[SAMPLE_OUT - 1][i];
		memcpy(&to->out[SAMPLE_OUT - 1][i], &event, 4);
	}
}

/* The case that the file means must still be the case of that name. */
static void add_case(const char *name, lobe_uint kind, char *make)
{
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		if (c->kind != kind || strcmp(c->name, name) != 0)
			continue;
		for (int k = 0; k < CASE_PARAMETERS; k++)
			TEST_ASSERT_TRUE_MESSAGE((*make ? (double)next_float(&make) : 0.0) == c->parameter[k], name);
		materials[material_count++] = c->bsdf;
		return;
	}
	TEST_FAIL_MESSAGE(name);
}

static void read_file(const char *lobe, lobe_uint kind)
{
	char path[512], line[1024], name[sizeof line] = "";
	snprintf(path, sizeof path, "tests/vectors/%s.txt", lobe);
	FILE *file = fopen(path, "r");
	TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
	eval_lines.count = sample_lines.count = material_count = 0;
	eval_lines.outputs = EVAL_OUT;
	sample_lines.outputs = 7;
	while (fgets(line, sizeof line, file)) {
		line[strcspn(line, "\n")] = 0;
		if (strncmp(line, "case ", 5) == 0)
			snprintf(name, sizeof name, "%s", line + 5);
		else if (strncmp(line, "make ", 5) == 0)
			add_case(name, kind, line + 5);
		else if (strncmp(line, "eval ", 5) == 0)
			add_line(&eval_lines, line + 5);
		else if (strncmp(line, "sample ", 7) == 0) {
			sample_lines.outputs = SAMPLE_OUT;
			add_line(&sample_lines, line + 7);
		}
	}
	fclose(file);
	TEST_ASSERT_GREATER_THAN(10, eval_lines.count);
	TEST_ASSERT_GREATER_THAN(10, sample_lines.count);
}

static size_t count_wrong(const lines *l, float got[][MAX_LINES], const char *what)
{
	size_t wrong = 0;
	for (int k = 0; k < l->outputs; k++)
		for (size_t i = 0; i < l->count; i++)
			if (test_float_bits(got[k][i]) != test_float_bits(l->out[k][i]) && wrong++ == 0)
				printf("%s: line %zu, output %d: %a, expected %a\n", what, i, k, (double)got[k][i],
				       (double)l->out[k][i]);
	return wrong;
}

static float got[SAMPLE_OUT][MAX_LINES];

static size_t wrong_scalar(void)
{
	size_t wrong = 0;
	for (size_t i = 0; i < eval_lines.count; i++) {
		const lobe_bsdf b = materials[eval_lines.material[i]];
		const lobe_vec3 wo = lobe_vec3_make(eval_lines.in[0][i], eval_lines.in[1][i], eval_lines.in[2][i]);
		const lobe_vec3 wi = lobe_vec3_make(eval_lines.in[3][i], eval_lines.in[4][i], eval_lines.in[5][i]);
		const lobe_rgb f = lobe_bsdf_eval(b, wo, wi);
		got[0][i] = f.r;
		got[1][i] = f.g;
		got[2][i] = f.b;
		got[3][i] = lobe_bsdf_pdf(b, wo, wi);
	}
	wrong += count_wrong(&eval_lines, got, "scalar eval");
	for (size_t i = 0; i < sample_lines.count; i++) {
		const lobe_bsdf b = materials[sample_lines.material[i]];
		const lobe_vec3 wo =
			lobe_vec3_make(sample_lines.in[0][i], sample_lines.in[1][i], sample_lines.in[2][i]);
		const lobe_vec3 u = lobe_vec3_make(sample_lines.in[3][i], sample_lines.in[4][i], sample_lines.in[5][i]);
		const lobe_sample s = lobe_bsdf_sample(b, wo, u);
		const float values[7] = {s.wi.x, s.wi.y, s.wi.z, s.weight.r, s.weight.g, s.weight.b, s.pdf};
		for (int k = 0; k < 7; k++)
			got[k][i] = values[k];
		memcpy(&got[7][i], &s.event, 4);
	}
	return wrong + count_wrong(&sample_lines, got, "scalar sample");
}

static size_t wrong_on(lobe_device *device)
{
	lobe_scene *scene;
	lobe_batch e, s;
	size_t wrong;
	memset(&e, 0, sizeof e);
	memset(&s, 0, sizeof s);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count),
				  lobe_error_message());
	e.count = eval_lines.count;
	e.material = eval_lines.material;
	s.count = sample_lines.count;
	s.material = sample_lines.material;
	for (int k = 0; k < 3; k++) {
		e.wo[k] = eval_lines.in[k];
		e.wi[k] = eval_lines.in[3 + k];
		e.f[k] = got[k];
		s.wo[k] = sample_lines.in[k];
		s.u[k] = sample_lines.in[3 + k];
		s.sample_wi[k] = got[k];
		s.weight[k] = got[3 + k];
	}
	e.pdf = got[3];
	s.sample_pdf = got[6];
	s.event = (uint32_t *)(void *)got[7];
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval(scene, &e), lobe_error_message());
	wrong = count_wrong(&eval_lines, got, lobe_device_name(device));
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample(scene, &s), lobe_error_message());
	wrong += count_wrong(&sample_lines, got, lobe_device_name(device));
	lobe_scene_destroy(scene);
	return wrong;
}

/* All lobes on one device. Returns 0 when there is no such device here. */
static int check_device(const char *name, const char *isa)
{
	lobe_device *device;
	if (isa)
		setenv("LOBE_ISA", isa, 1);
	const lobe_status status = lobe_device_open(&device, name);
	unsetenv("LOBE_ISA");
	if (status != LOBE_OK)
		return 0;
	printf("%s\n", lobe_device_name(device));
#define LOBE_X(NAME, lobe, kind)                                                                                       \
	read_file(#lobe, kind);                                                                                        \
	TEST_ASSERT_EQUAL_MESSAGE(0, wrong_on(device), #lobe);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	lobe_device_close(device);
	return 1;
}

static void test_scalar(void)
{
#define LOBE_X(NAME, lobe, kind)                                                                                       \
	read_file(#lobe, kind);                                                                                        \
	TEST_ASSERT_EQUAL_MESSAGE(0, wrong_scalar(), #lobe);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
}

static void test_native_baseline(void) { TEST_ASSERT_TRUE(check_device("native:1", "baseline")); }

static void test_native_avx2(void)
{
	if (!check_device("native:1", "avx2"))
		TEST_IGNORE_MESSAGE("this processor has no AVX2");
}

static void test_native_avx512(void)
{
	if (!check_device("native:1", "avx512"))
		TEST_IGNORE_MESSAGE("this processor has no AVX-512");
}

static void test_opencl(void)
{
	size_t count = 0;
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_count("opencl", &count), lobe_error_message());
	for (size_t i = 0; i < count; i++) {
		char name[32];
		snprintf(name, sizeof name, "opencl:%zu", i);
		TEST_ASSERT_TRUE_MESSAGE(check_device(name, NULL), lobe_error_message());
	}
	if (count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
}

/* One answer off by one unit in the last place is noticed. */
static void test_notices_a_wrong_answer(void)
{
	read_file("lambert", LOBE_KIND_LAMBERT);
	size_t lit = 0;
	while (eval_lines.out[0][lit] == 0.0f)
		lit++;
	const uint32_t bits = test_float_bits(eval_lines.out[0][lit]) + 1;
	memcpy(&eval_lines.out[0][lit], &bits, 4);
	TEST_ASSERT_EQUAL(1, wrong_scalar());
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_scalar);
	RUN_TEST(test_native_baseline);
	RUN_TEST(test_native_avx2);
	RUN_TEST(test_native_avx512);
	RUN_TEST(test_opencl);
	RUN_TEST(test_notices_a_wrong_answer);
	return UNITY_END();
}
