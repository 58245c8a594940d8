/* test_opencl.c - OpenCL devices: two of them at once, batches whose arrays stay on the device, the caller's own
 * context, and what is refused. PoCL is asked for two devices; any others that are here are used too. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch_fixture.h"
#include "cases.h"
#include "inputs.h"
#include "lobe/lobe.h"
#include "opencl_api.h"
#include "support.h"
#include "unity.h"

enum { N = 5003, OUTPUTS = 12 };

static const lobe_cl_functions *cl;
static size_t device_count;
static inputs in;
static uint32_t material[N];
static lobe_bsdf materials[64];
static size_t material_count;
static float expected[OUTPUTS][N], got[OUTPUTS][N];

static int needs_device;
void setUp(void)
{
	if (needs_device && device_count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
}
void tearDown(void) {}

/* Inputs, materials of every lobe, and what the native device makes of them. */
static void prepare(void)
{
	lobe_device *native;
	lobe_scene *scene;
	lobe_batch b;
	in = inputs_alloc(N);
	inputs_random(in, 9000000);
	for (size_t i = 0; i < case_count() && material_count < 64; i++)
		materials[material_count++] = case_at(i)->bsdf;
	for (uint32_t i = 0; i < N; i++)
		material[i] = test_bits(90, i) % (uint32_t)material_count;
	memset(&b, 0, sizeof b);
	b.count = N;
	b.material = material;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = in.array[k];
		b.wi[k] = in.array[3 + k];
		b.u[k] = in.array[6 + k];
		b.f[k] = expected[k];
		b.sample_wi[k] = expected[4 + k];
		b.weight[k] = expected[7 + k];
	}
	b.pdf = expected[3];
	b.sample_pdf = expected[10];
	b.event = (uint32_t *)(void *)expected[11];
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&native, "native:1"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, native, materials, material_count));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b));
	lobe_scene_destroy(scene);
	lobe_device_close(native);
}

static void test_two_devices(void)
{
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_count("opencl", &device_count), lobe_error_message());
	cl = lobe_cl_load();
	if (device_count == 0)
		TEST_IGNORE_MESSAGE("no OpenCL device");
	for (size_t i = 0; i < device_count; i++) {
		char name[32], start[32];
		lobe_device *d;
		snprintf(name, sizeof name, "opencl:%zu", i);
		snprintf(start, sizeof start, "opencl:%zu, ", i);
		TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&d, name), lobe_error_message());
		printf("%s\n", lobe_device_name(d));
		TEST_ASSERT_EQUAL_STRING_LEN(start, lobe_device_name(d), strlen(start));
		lobe_device_close(d);
	}
	TEST_ASSERT_GREATER_OR_EQUAL_MESSAGE(2, device_count, "PoCL did not heed POCL_DEVICES");
}

static void test_unknown_device(void)
{
	lobe_device *d = NULL;
	char name[32];
	snprintf(name, sizeof name, "opencl:%zu", device_count);
	assert_refused(LOBE_ERROR_DEVICE, lobe_device_open(&d, name), name);
	TEST_ASSERT_NULL(d);
}

/* --- arrays that stay on the device ---------------------------------------------------------------------------------
 */

typedef struct {
	cl_context context;
	cl_command_queue queue;
	cl_mem material, in[9], out[OUTPUTS];
} buffers;

static cl_mem new_buffer(cl_context context, const void *from)
{
	cl_int error;
	cl_mem b = cl->clCreateBuffer(context, CL_MEM_READ_WRITE | (from ? CL_MEM_COPY_HOST_PTR : 0), N * 4,
				      (void *)(uintptr_t)from, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	return b;
}

static buffers make_buffers(cl_context context, cl_command_queue queue)
{
	buffers b;
	b.context = context;
	b.queue = queue;
	b.material = new_buffer(context, material);
	for (int k = 0; k < 9; k++)
		b.in[k] = new_buffer(context, in.array[k]);
	for (int k = 0; k < OUTPUTS; k++)
		b.out[k] = new_buffer(context, NULL);
	return b;
}

static void free_buffers(buffers b)
{
	cl->clReleaseMemObject(b.material);
	for (int k = 0; k < 9; k++)
		cl->clReleaseMemObject(b.in[k]);
	for (int k = 0; k < OUTPUTS; k++)
		cl->clReleaseMemObject(b.out[k]);
}

static lobe_cl_batch cl_batch(const buffers *b)
{
	lobe_cl_batch batch;
	memset(&batch, 0, sizeof batch);
	batch.count = N;
	batch.material = b->material;
	for (int k = 0; k < 3; k++) {
		batch.wo[k] = b->in[k];
		batch.wi[k] = b->in[3 + k];
		batch.u[k] = b->in[6 + k];
		batch.f[k] = b->out[k];
		batch.sample_wi[k] = b->out[4 + k];
		batch.weight[k] = b->out[7 + k];
	}
	batch.pdf = b->out[3];
	batch.sample_pdf = b->out[10];
	batch.event = b->out[11];
	return batch;
}

static void assert_outputs(const buffers *b)
{
	for (int k = 0; k < OUTPUTS; k++)
		TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clEnqueueReadBuffer(b->queue, b->out[k], CL_TRUE, 0, N * 4, got[k], 0,
								      NULL, NULL));
	TEST_ASSERT_EQUAL_MEMORY(expected, got, sizeof expected);
}

/* Shades on device with buffers of its context, and compares. */
static void run_on_buffers(lobe_device *device)
{
	cl_context context;
	cl_command_queue queue;
	lobe_scene *scene;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(device, &context, NULL, &queue));
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, material_count),
				  lobe_error_message());
	buffers b = make_buffers(context, queue);
	const lobe_cl_batch batch = cl_batch(&b);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval_cl(scene, &batch), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample_cl(scene, &batch), lobe_error_message());
	assert_outputs(&b);
	free_buffers(b);
	lobe_scene_destroy(scene);
}

static void test_device_buffers(void)
{
	for (size_t i = 0; i < device_count; i++) {
		char name[32];
		lobe_device *d;
		snprintf(name, sizeof name, "opencl:%zu", i);
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, name));
		run_on_buffers(d);
		lobe_device_close(d);
	}
}

/* The caller's own context, device and queue, which outlive the lobe_device. */
static void test_own_context(void)
{
	lobe_device *first, *own = NULL;
	cl_device_id id;
	cl_int error;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&first, "opencl"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(first, NULL, &id, NULL));
	cl_context context = cl->clCreateContext(NULL, 1, &id, NULL, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl_command_queue queue = cl->clCreateCommandQueue(context, id, 0, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl_command_queue disordered =
		cl->clCreateCommandQueue(context, id, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);

	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open_cl(NULL, context, id, queue), "out");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open_cl(&own, NULL, id, queue), "context");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open_cl(&own, context, NULL, queue), "device");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open_cl(&own, context, id, NULL), "queue");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_device_open_cl(&own, context, id, disordered), "order");
	TEST_ASSERT_NULL(own);
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open_cl(&own, context, id, queue), lobe_error_message());
	cl->clReleaseCommandQueue(disordered);
	run_on_buffers(own);
	lobe_device_close(own);
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clFinish(queue)); /* still ours */
	cl->clReleaseCommandQueue(queue);
	cl->clReleaseContext(context);
	lobe_device_close(first);
}

static void test_buffer_refusals(void)
{
	lobe_device *d;
	lobe_scene *scene;
	cl_context context;
	cl_command_queue queue;
	cl_int error;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "opencl"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(d, &context, NULL, &queue));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, d, materials, material_count));
	buffers b = make_buffers(context, queue);
	lobe_cl_batch batch = cl_batch(&b);
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, NULL), "batch");
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(NULL, &batch), "scene");
	batch.wo[1] = NULL;
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "wo[1]");
	batch = cl_batch(&b);
	batch.pdf = batch.f[0];
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "same buffer");
	batch = cl_batch(&b);
	batch.count = N + 1;
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "too few");

	/* Buffers of which kernels may not do what they would. */
	cl_mem written = cl->clCreateBuffer(context, CL_MEM_WRITE_ONLY, N * 4, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl_mem read = cl->clCreateBuffer(context, CL_MEM_READ_ONLY, N * 4, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	batch = cl_batch(&b);
	batch.wi[2] = written;
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "wi[2] was made with CL_MEM_WRITE_ONLY");
	batch = cl_batch(&b);
	batch.f[1] = read;
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "f[1] was made with CL_MEM_READ_ONLY");
	cl->clReleaseMemObject(written);
	cl->clReleaseMemObject(read);

	/* Indices are on the device: one out of range is found when they are read back to sort. */
	const uint32_t bad = 1000000;
	batch = cl_batch(&b);
	TEST_ASSERT_EQUAL(CL_SUCCESS,
			  cl->clEnqueueWriteBuffer(queue, b.material, CL_TRUE, 4 * 77, 4, &bad, 0, NULL, NULL));
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "material[77]");
	lobe_scene_destroy(scene);

	/* With one kind of lobe nothing is read back, and the element shades to nothing. */
	const lobe_bsdf two[2] = {materials[0], materials[0]};
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, d, two, 2));
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval_cl(scene, &batch), lobe_error_message());
	TEST_ASSERT_EQUAL(CL_SUCCESS,
			  cl->clEnqueueReadBuffer(queue, b.out[3], CL_TRUE, 0, N * 4, got[3], 0, NULL, NULL));
	TEST_ASSERT_EQUAL_HEX32(0, test_float_bits(got[3][77]));
	lobe_scene_destroy(scene);

	/* Another context's buffer. */
	cl_device_id id;
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(d, NULL, &id, NULL));
	cl_context stranger = cl->clCreateContext(NULL, 1, &id, NULL, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl_mem strange = new_buffer(stranger, in.array[0]);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_create(&scene, d, materials, 1));
	batch = cl_batch(&b);
	batch.wo[0] = strange;
	assert_refused(LOBE_ERROR_ARGUMENT, lobe_scene_eval_cl(scene, &batch), "another context");
	cl->clReleaseMemObject(strange);
	cl->clReleaseContext(stranger);
	free_buffers(b);
	lobe_scene_destroy(scene);
	lobe_device_close(d);
}

/* README's kernel builds as README says. */
static void test_readme_kernel(void)
{
	static char kernel[4096];
	char line[512];
	lobe_device *d;
	cl_context context;
	cl_device_id id;
	cl_int error;
	int inside = 0;
	FILE *readme = fopen("README.md", "r");
	TEST_ASSERT_NOT_NULL(readme);
	while (fgets(line, sizeof line, readme)) {
		if (strncmp(line, "```", 3) == 0)
			inside = strncmp(line, "```opencl", 9) == 0;
		else if (inside)
			strncat(kernel, line, sizeof kernel - strlen(kernel) - 1);
	}
	fclose(readme);
	TEST_ASSERT_NOT_NULL(strstr(kernel, "__kernel"));
	const char *sources[2] = {lobe_opencl_source(), kernel};
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_open(&d, "opencl"));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_device_cl(d, &context, &id, NULL));
	cl_program program = cl->clCreateProgramWithSource(context, 2, sources, NULL, &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, cl->clBuildProgram(program, 1, &id, lobe_opencl_options(NULL), NULL, NULL));
	cl_kernel made = cl->clCreateKernel(program, "frost", &error);
	TEST_ASSERT_EQUAL(CL_SUCCESS, error);
	cl->clReleaseKernel(made);
	cl->clReleaseProgram(program);
	lobe_device_close(d);
}

int main(void)
{
	setenv("POCL_DEVICES", "pthread basic", 1);
	UNITY_BEGIN();
	RUN_TEST(prepare);
	RUN_TEST(test_two_devices);
	needs_device = 1;
	RUN_TEST(test_unknown_device);
	RUN_TEST(test_device_buffers);
	RUN_TEST(test_own_context);
	RUN_TEST(test_buffer_refusals);
	RUN_TEST(test_readme_kernel);
	inputs_free(in);
	return UNITY_END();
}
