/* test_async.c - batches that run behind the caller: the same bits, in order, several at once, and failures that come
 * out when they are waited for. With the argument "native", without OpenCL. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch_fixture.h"
#include "cl_faults.h"
#include "inputs.h"
#include "internal.h"
#include "lobe/lobe.h"
#include "unity.h"

enum { N = 30000, OUTPUTS = 12, BATCHES = 8 };

typedef float result[OUTPUTS][N];

static inputs in;
static uint32_t material[N];
static lobe_bsdf materials[3];
static result expected, got[BATCHES];
static lobe_device *device;
static lobe_scene *scene;

void setUp(void) {}
void tearDown(void) {}

static lobe_batch batch_to(result out) { return inputs_batch(in, material, out[0]); }

static void open_on(const char *name)
{
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_device_open(&device, name), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_create(&scene, device, materials, 3), lobe_error_message());
}

static void close_all(void)
{
	lobe_scene_destroy(scene);
	lobe_device_close(device);
}

static void begin(const lobe_batch *b, lobe_event **e)
{
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_eval_async(scene, b, &e[0]), lobe_error_message());
	TEST_ASSERT_EQUAL_MESSAGE(LOBE_OK, lobe_scene_sample_async(scene, b, &e[1]), lobe_error_message());
}

static void prepare(void)
{
	in = inputs_alloc(N);
	inputs_random(in, 6000000);
	fixture_materials(materials, material, N);
	const lobe_batch b = batch_to(expected);
	open_on("native:1");
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b));
	close_all();
}

/* Many batches given before any is waited for; waited for from the last to the first, and twice. */
static void several_on(const char *name)
{
	lobe_event *e[BATCHES][2];
	open_on(name);
	memset(got, 0xee, sizeof got);
	for (int i = 0; i < BATCHES; i++) {
		lobe_batch b = batch_to(got[i]);
		begin(&b, e[i]);
		memset(&b, 0, sizeof b); /* the struct is copied */
	}
	/* A plain call takes its turn among them. */
	static result plain;
	const lobe_batch b = batch_to(plain);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b));
	TEST_ASSERT_EQUAL_MEMORY(expected, plain, sizeof expected);
	for (int i = BATCHES; i-- > 0;)
		for (int k = 2; k-- > 0;) {
			TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[i][k]));
			TEST_ASSERT_EQUAL(1, lobe_event_done(e[i][k]));
			TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[i][k]));
		}
	for (int i = 0; i < BATCHES; i++)
		TEST_ASSERT_EQUAL_MEMORY(expected, got[i], sizeof expected);
	/* Events outlive their device. */
	close_all();
	for (int i = 0; i < BATCHES; i++) {
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[i][0]));
		lobe_event_release(e[i][0]);
		lobe_event_release(e[i][1]);
	}
	lobe_event_release(NULL);
}

static void test_several_native(void)
{
	several_on("native:1");
	several_on("native:2");
}

/* Released without a wait: release waits. */
static void test_release_waits(void)
{
	lobe_event *e[2];
	open_on("native:2");
	memset(got, 0xee, sizeof got);
	const lobe_batch b = batch_to(got[0]);
	begin(&b, e);
	lobe_event_release(e[1]);
	lobe_event_release(e[0]);
	TEST_ASSERT_EQUAL_MEMORY(expected, got[0], sizeof expected);
	close_all();
}

/* What is wrong with the arguments is told at once, and there is no event. */
static void test_refusals(void)
{
	lobe_event *const untouched = (lobe_event *)(void *)got;
	lobe_event *e = untouched;
	open_on("native:1");
	lobe_batch b = batch_to(got[0]);
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_eval_async(scene, NULL, &e));
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_eval_async(NULL, &b, &e));
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_eval_async(scene, &b, NULL));
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "lobe_scene_eval_async: out"));
	b.wo[1] = NULL;
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_eval_async(scene, &b, &e));
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_sample_async(scene, &b, &e));
	TEST_ASSERT_NOT_NULL(strstr(lobe_error_message(), "lobe_scene_sample_async: batch->wo[1]"));
	b = batch_to(got[0]);
	b.sample_wi[0] = got[0][0];
	b.f[0] = got[0][4];
	b.pdf = got[0][5];
	b.f[1] = got[0][5];
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_scene_eval_async(scene, &b, &e));
	TEST_ASSERT_EQUAL(LOBE_ERROR_ARGUMENT, lobe_event_wait(NULL));
	TEST_ASSERT_EQUAL_PTR(untouched, e);
	TEST_ASSERT_EQUAL(1, lobe_event_done(NULL));
	/* Nothing to do is done at once, whatever the arrays. */
	memset(&b, 0, sizeof b);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample_async(scene, &b, &e));
	TEST_ASSERT_EQUAL(1, lobe_event_done(e));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e));
	lobe_event_release(e);
	close_all();
}

/* Batches from several threads at once, each waited for by another than the one that gave it. */
enum { THREADS = 4 };
static lobe_event *from[THREADS][2];

static void *give(void *argument)
{
	const size_t me = (size_t)((lobe_event * (*)[2]) argument - from);
	const lobe_batch b = batch_to(got[me]);
	if (lobe_scene_eval_async(scene, &b, &from[me][0]) || lobe_scene_sample_async(scene, &b, &from[me][1]))
		return argument;
	return NULL;
}

static void *take(void *argument)
{
	const size_t other = ((size_t)((lobe_event * (*)[2]) argument - from) + 1) % THREADS;
	if (lobe_event_wait(from[other][0]) || lobe_event_wait(from[other][1]))
		return argument;
	lobe_event_release(from[other][0]);
	lobe_event_release(from[other][1]);
	return memcmp(expected, got[other], sizeof expected) ? argument : NULL;
}

static void test_threads(void)
{
	pthread_t thread[THREADS];
	void *failed;
	open_on("native:2");
	memset(got, 0xee, sizeof got);
	for (int step = 0; step < 2; step++) {
		for (int i = 0; i < THREADS; i++)
			TEST_ASSERT_EQUAL(0, pthread_create(&thread[i], NULL, step ? take : give, from[i]));
		for (int i = 0; i < THREADS; i++) {
			TEST_ASSERT_EQUAL(0, pthread_join(thread[i], &failed));
			TEST_ASSERT_NULL(failed);
		}
	}
	close_all();
}

/* --- OpenCL ------------------------------------------------------------------------------------------------------- */

static int native_alone;

static void needs_opencl(void)
{
	if (native_alone)
		TEST_IGNORE_MESSAGE("the native device alone was asked for");
	NEEDS_OPENCL();
}

static void test_several_opencl(void)
{
	needs_opencl();
	for (int discrete = 0; discrete < 2; discrete++) {
		cl_faults.discrete = discrete;
		several_on("opencl");
		TEST_ASSERT_EQUAL(0, cl_faults.live);
	}
	cl_faults.discrete = 0;
}

static pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;
static cl_int (*finish_behind)(cl_command_queue);

static cl_int finish_at_the_gate(cl_command_queue q)
{
	pthread_mutex_lock(&gate);
	pthread_mutex_unlock(&gate);
	return finish_behind(q);
}

/* The call returns while the device cannot finish. */
static void test_returns_at_once(void)
{
	needs_opencl();
	lobe_event *e[2];
	open_on("opencl");
	finish_behind = cl_faults.table->clFinish;
	cl_faults.table->clFinish = finish_at_the_gate;
	memset(got, 0xee, sizeof got);
	const lobe_batch b = batch_to(got[0]);
	pthread_mutex_lock(&gate);
	begin(&b, e);
	TEST_ASSERT_EQUAL(0, lobe_event_done(e[0]));
	TEST_ASSERT_EQUAL(0, lobe_event_done(e[1]));
	pthread_mutex_unlock(&gate);
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[1]));
	TEST_ASSERT_EQUAL_MESSAGE(1, lobe_event_done(e[0]), "batches run in order");
	lobe_event_release(e[0]);
	lobe_event_release(e[1]);
	TEST_ASSERT_EQUAL_MEMORY(expected, got[0], sizeof expected);
	close_all();
	cl_faults.table->clFinish = finish_behind;
}

/* One of three batches fails: its event says so, with the reason, and to this thread only when asked. */
static void test_failure_at_wait(void)
{
	needs_opencl();
	lobe_event *e[3];
	open_on("opencl");
	memset(got, 0xee, sizeof got);
	const lobe_batch b[3] = {batch_to(got[0]), batch_to(got[1]), batch_to(got[2])};
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_eval(scene, &b[0])); /* kernels are there */
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample(scene, &b[0]));
	lobe_set_error_message("nothing yet");
	cl_faults.failing = "clFinish";
	cl_faults.failure = CL_INVALID_COMMAND_QUEUE;
	cl_faults.countdown = 1;
	for (int i = 0; i < 3; i++)
		TEST_ASSERT_EQUAL(LOBE_OK, lobe_scene_sample_async(scene, &b[i], &e[i]));
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[2]));
	TEST_ASSERT_EQUAL_STRING("nothing yet", lobe_error_message());
	for (int again = 0; again < 2; again++) {
		TEST_ASSERT_EQUAL_STRING("LOBE_ERROR_OPENCL", lobe_status_string(lobe_event_wait(e[1])));
		TEST_ASSERT_NOT_NULL_MESSAGE(strstr(lobe_error_message(), "clFinish failed: CL_INVALID_COMMAND_QUEUE"),
					     lobe_error_message());
		lobe_set_error_message("nothing yet");
	}
	TEST_ASSERT_EQUAL(LOBE_OK, lobe_event_wait(e[0]));
	cl_faults.failing = "";
	for (int i = 0; i < 3; i++)
		lobe_event_release(e[i]);
	for (int k = 4; k < OUTPUTS; k++) {
		TEST_ASSERT_EQUAL_MEMORY(expected[k], got[0][k], sizeof expected[k]);
		TEST_ASSERT_EQUAL_MEMORY(expected[k], got[2][k], sizeof expected[k]);
	}
	close_all();
	TEST_ASSERT_EQUAL(0, cl_faults.live);
}

int main(int argc, char **argv)
{
	native_alone = argc > 1 && strcmp(argv[1], "native") == 0;
	setenv("LOBE_CACHE_DIR", "", 1);
	UNITY_BEGIN();
	RUN_TEST(prepare);
	RUN_TEST(test_several_native);
	RUN_TEST(test_release_waits);
	RUN_TEST(test_refusals);
	RUN_TEST(test_threads);
	RUN_TEST(test_several_opencl);
	RUN_TEST(test_returns_at_once);
	RUN_TEST(test_failure_at_wait);
	inputs_free(in);
	return UNITY_END();
}
