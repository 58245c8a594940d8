/* batch.c - the front of devices, scenes and batches: checks every argument, then hands over to a backend. */
#include <stdio.h>
#include <stdlib.h>

#include "event.h"
#include "strides.h"

/* --- devices ----------------------------------------------------------------------------------------------------- */

lobe_status lobe_device_count(const char *backend, size_t *count)
{
	if (!backend || !count)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_count: %s is NULL", backend ? "count" : "backend");
	if (strcmp(backend, "native") == 0)
		return lobe_native_count(count);
	if (strcmp(backend, "opencl") == 0)
		return lobe_opencl_count(count);
	return lobe_fail(LOBE_ERROR_DEVICE, "lobe_device_count: no backend \"%s\"; there are \"native\" and \"opencl\"",
			 backend);
}

/* The number behind "backend:" in name; 0 and *given = 0 for "backend" alone. Returns 0 when name is something else. */
static int parse_name(const char *name, const char *backend, size_t *number, int *given)
{
	const size_t length = strlen(backend);
	*number = 0;
	*given = 0;
	if (strncmp(name, backend, length) != 0)
		return 0;
	const char *s = name + length;
	if (!*s)
		return 1;
	if (*s++ != ':' || !*s)
		return 0;
	for (; *s >= '0' && *s <= '9' && *number < 1000000; s++)
		*number = *number * 10 + (size_t)(*s - '0');
	*given = 1;
	return !*s;
}

static lobe_status open_native(lobe_device **out, const char *name, size_t threads, int given)
{
	if (given && (threads < 1 || threads > 1024))
		return lobe_fail(LOBE_ERROR_DEVICE, "lobe_device_open: \"%s\": threads must be 1 to 1024", name);
	return lobe_native_open(out, threads);
}

static lobe_status bad_name(const char *name)
{
	return lobe_fail(LOBE_ERROR_DEVICE,
			 "lobe_device_open: no device \"%s\"; names are native, native:THREADS, opencl, opencl:INDEX, "
			 "opencl:all, and one of opencl followed by ,native or ,native:THREADS",
			 name);
}

/* "opencl:INDEX,native:THREADS" and the like; rest is what comes after the comma. */
static lobe_status open_fallback(lobe_device **out, const char *name, const char *rest)
{
	const size_t length = (size_t)(rest - 1 - name);
	lobe_device *first = NULL, *native;
	char head[32];
	size_t threads, index;
	int given, all;
	if (length >= sizeof head || !parse_name(rest, "native", &threads, &given))
		return bad_name(name);
	memcpy(head, name, length);
	head[length] = '\0';
	all = strcmp(head, "opencl:all") == 0;
	if (!all && !parse_name(head, "opencl", &index, &(int){0}))
		return bad_name(name);
	lobe_status status = open_native(&native, name, threads, given);
	if (status != LOBE_OK)
		return status;
	lobe_message before;
	lobe_message_get(&before);
	status = all ? lobe_opencl_open_all(&first) : lobe_opencl_open(&first, index);
	status = lobe_fallback_open(out, status == LOBE_OK ? first : NULL, native);
	if (status == LOBE_OK) {
		lobe_message_set(&before);
	} else {
		lobe_device_close(first);
		lobe_device_close(native);
	}
	return status;
}

lobe_status lobe_device_open(lobe_device **out, const char *name)
{
	size_t number;
	int given;
	if (!out || !name)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_device_open: %s is NULL", out ? "name" : "out");
	const char *const comma = strchr(name, ',');
	if (comma)
		return open_fallback(out, name, comma + 1);
	if (parse_name(name, "native", &number, &given))
		return open_native(out, name, number, given);
	if (strcmp(name, "opencl:all") == 0)
		return lobe_opencl_open_all(out);
	if (parse_name(name, "opencl", &number, &given))
		return lobe_opencl_open(out, number);
	return bad_name(name);
}

const char *lobe_device_name(const lobe_device *device) { return device ? device->name : ""; }

void lobe_device_close(lobe_device *device)
{
	if (!device)
		return;
	lobe_worker_end(device->worker);
	device->ops->close(device);
}

/* --- scenes ------------------------------------------------------------------------------------------------------ */

static void free_scene(lobe_scene *scene)
{
	for (int i = 0; i < LOBE_COUNT; i++)
		free(scene->table[i].params);
	free(scene->tables);
	free(scene->index);
	free(scene->slot);
	free(scene->options);
	free(scene);
}

/* Fills index, slot, table and options from materials that have been checked. 0 when out of memory. */
static int fill_scene(lobe_scene *scene, const lobe_bsdf *materials)
{
	scene->index = malloc(scene->count * sizeof *scene->index);
	scene->slot = malloc(scene->count * sizeof *scene->slot);
	if (!scene->index || !scene->slot)
		return 0;
	uint32_t none = 0;
	for (size_t i = 0; i < scene->count; i++) {
		const int index = lobe_index_of_kind(materials[i].kind);
		scene->index[i] = (uint32_t)index;
		scene->slot[i] = index == LOBE_INDEX_NONE ? none++ : (uint32_t)scene->table[index].count++;
	}
	for (int i = 0; i < LOBE_COUNT; i++)
		if (scene->table[i].count &&
		    !(scene->table[i].params = malloc(scene->table[i].count * lobe_param_size[i])))
			return 0;
	for (size_t i = 0; i < scene->count; i++) {
		const uint32_t index = scene->index[i];
		if (index == LOBE_INDEX_NONE)
			continue;
		const size_t size = lobe_param_size[index];
		memcpy((unsigned char *)scene->table[index].params + scene->slot[i] * size, &materials[i].as, size);
	}
	return lobe_tables_gather(scene) && (scene->options = lobe_make_options(scene, materials)) != NULL;
}

lobe_status lobe_scene_create(lobe_scene **out, lobe_device *device, const lobe_bsdf *materials, size_t count)
{
	if (!out || !device || !materials)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_scene_create: %s is NULL",
				 !out ? "out" : (!device ? "device" : "materials"));
	if (count == 0 || count > UINT32_MAX)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_scene_create: count is %zu, not 1 to 2^32 - 1", count);
	for (size_t i = 0; i < count; i++) {
		lobe_status status = lobe_check_material(materials, i);
		if (status == LOBE_OK)
			status = lobe_check_table(materials, i);
		if (status != LOBE_OK)
			return status;
	}
	lobe_scene *scene = calloc(1, sizeof *scene);
	if (!scene)
		return lobe_fail(LOBE_ERROR_MEMORY, "lobe_scene_create: out of memory");
	scene->device = device;
	scene->count = count;
	lobe_status status = LOBE_OK;
	if (!fill_scene(scene, materials))
		status = lobe_fail(LOBE_ERROR_MEMORY, "lobe_scene_create: out of memory for %zu materials", count);
	else
		status = device->ops->scene_create(scene);
	if (status != LOBE_OK) {
		free_scene(scene);
		return status;
	}
	*out = scene;
	return LOBE_OK;
}

lobe_status lobe_scene_share(lobe_scene *out, const lobe_scene *from, lobe_device *device)
{
	*out = *from;
	out->device = device;
	out->state = NULL;
	return device->ops->scene_create(out);
}

void lobe_scene_destroy(lobe_scene *scene)
{
	if (!scene)
		return;
	scene->device->ops->scene_destroy(scene);
	free_scene(scene);
}

/* --- batches ----------------------------------------------------------------------------------------------------- */

const char *const lobe_in_names[2][LOBE_IN_COUNT] = {{"wo[0]", "wo[1]", "wo[2]", "wi[0]", "wi[1]", "wi[2]"},
						     {"wo[0]", "wo[1]", "wo[2]", "u[0]", "u[1]", "u[2]"}};
const char *const lobe_out_names[2][LOBE_OUT_COUNT] = {
	{"f[0]", "f[1]", "f[2]", "pdf", "", "", "", ""},
	{"sample_wi[0]", "sample_wi[1]", "sample_wi[2]", "weight[0]", "weight[1]", "weight[2]", "sample_pdf", "event"}};

/* Inputs there, vectors whole, at least one output. */
static lobe_status check_presence(const lobe_job *job, int sample, const char *call)
{
	for (int i = 0; i < LOBE_IN_COUNT; i++)
		if (!job->in[i])
			return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->%s is NULL", call, lobe_in_names[sample][i]);
	int wanted = 0;
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		wanted += job->out[i] != NULL;
	if (!wanted)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: every output of the batch is NULL", call);
	for (int first = 0; first <= (sample ? 3 : 0); first += 3)
		for (int i = first; i < first + 3; i++)
			if (!job->out[i] != !job->out[first])
				return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->%s is NULL but batch->%s is not",
						 call, lobe_out_names[sample][job->out[i] ? first : i],
						 lobe_out_names[sample][job->out[i] ? i : first]);
	return LOBE_OK;
}

/* How many of material[] are below count, for sure: whole groups, of which a compiler makes vectors. Those have signed
 * comparisons alone, so the sign tells: a number beyond the last, or one of the upper half. */
static size_t count_valid(const uint32_t *material, size_t n, size_t count)
{
	enum { GROUP = 64 };
	const uint32_t last = count > INT32_MAX ? INT32_MAX : (uint32_t)count - 1;
	size_t i = 0;
	for (uint32_t signs = 0; i + GROUP <= n; i += GROUP) {
		for (size_t k = 0; k < GROUP; k++)
			signs |= material[i + k] | (last - material[i + k]);
		if (signs > INT32_MAX)
			break;
	}
	return i;
}

/* Arrays sound, material indices in range. */
static lobe_status check_host(const lobe_scene *scene, const lobe_job *job, int sample, const char *call)
{
	const lobe_status status = lobe_check_arrays(job, sample, call);
	if (status != LOBE_OK || !job->material)
		return status;
	const unsigned char *const at = job->material;
	for (size_t i = job->material_stride == 4 ? count_valid(job->material, job->count, scene->count) : 0;
	     i < job->count; i++) {
		const uint32_t material = *(const uint32_t *)(const void *)(at + i * job->material_stride);
		if (material >= scene->count)
			return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->material[%zu] = %u, but the scene has %zu",
					 call, i, material, scene->count);
	}
	return LOBE_OK;
}

static int eval_verb(const lobe_job *job)
{
	if (!job->out[LOBE_OUT_PDF])
		return LOBE_VERB_EVAL_F;
	return job->out[LOBE_OUT_F] ? LOBE_VERB_EVAL_F_PDF : LOBE_VERB_EVAL_PDF;
}

static int sample_verb(const lobe_job *job)
{
	return job->out[LOBE_OUT_WEIGHT] || job->out[LOBE_OUT_SAMPLE_PDF] ? LOBE_VERB_SAMPLE : LOBE_VERB_SAMPLE_WI;
}

/* lobe_batch and lobe_cl_batch have the same members, pointers or handles. */
#define FILL_IN(job, batch, second)                                                                                    \
	do {                                                                                                           \
		(job).count = (batch)->count;                                                                          \
		(job).material = (batch)->material;                                                                    \
		for (int i = 0; i < 3; i++) {                                                                          \
			(job).in[i] = (batch)->wo[i];                                                                  \
			(job).in[3 + i] = (batch)->second[i];                                                          \
		}                                                                                                      \
	} while (0)
#define FILL_EVAL(job, batch)                                                                                          \
	do {                                                                                                           \
		FILL_IN(job, batch, wi);                                                                               \
		for (int i = 0; i < 3; i++)                                                                            \
			(job).out[LOBE_OUT_F + i] = (batch)->f[i];                                                     \
		(job).out[LOBE_OUT_PDF] = (batch)->pdf;                                                                \
	} while (0)
#define FILL_SAMPLE(job, batch)                                                                                        \
	do {                                                                                                           \
		FILL_IN(job, batch, u);                                                                                \
		for (int i = 0; i < 3; i++) {                                                                          \
			(job).out[LOBE_OUT_WI + i] = (batch)->sample_wi[i];                                            \
			(job).out[LOBE_OUT_WEIGHT + i] = (batch)->weight[i];                                           \
		}                                                                                                      \
		(job).out[LOBE_OUT_SAMPLE_PDF] = (batch)->sample_pdf;                                                  \
		(job).out[LOBE_OUT_EVENT] = (batch)->event;                                                            \
	} while (0)

/* The strides of a host batch. second: those of in[3..5]; out: by output. */
static void fill_strides(lobe_job *job, const lobe_strides *stride, size_t second, const size_t *out)
{
	for (int i = 0; i < LOBE_IN_COUNT; i++) {
		const size_t given = i < 3 ? stride->wo : second;
		job->in_stride[i] = given ? given : 4;
	}
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		job->out_stride[i] = out[i] ? out[i] : 4;
	job->material_stride = stride->material ? stride->material : 4;
}

static void fill_eval_strides(lobe_job *job, const lobe_strides *s)
{
	const size_t out[LOBE_OUT_COUNT] = {s->f, s->f, s->f, s->pdf};
	fill_strides(job, s, s->wi, out);
}

static void fill_sample_strides(lobe_job *job, const lobe_strides *s)
{
	const size_t out[LOBE_OUT_COUNT] = {s->sample_wi, s->sample_wi, s->sample_wi,  s->weight,
					    s->weight,    s->weight,    s->sample_pdf, s->event};
	fill_strides(job, s, s->u, out);
}

static lobe_status check_call(const void *scene, const void *batch, const char *call)
{
	if (!scene || !batch)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: %s is NULL", call, scene ? "batch" : "scene");
	return LOBE_OK;
}

/* Checks a job of host arrays and finds its verb. */
static lobe_status prepare_host(lobe_scene *scene, lobe_job *job, int sample, const char *call)
{
	if (job->count == 0)
		return LOBE_OK;
	lobe_status status = check_presence(job, sample, call);
	if (status == LOBE_OK)
		status = check_host(scene, job, sample, call);
	if (status == LOBE_OK)
		job->verb = sample ? sample_verb(job) : eval_verb(job);
	return status;
}

static lobe_status run_host(lobe_scene *scene, lobe_job *job, int sample, const char *call)
{
	const lobe_status status = prepare_host(scene, job, sample, call);
	return status == LOBE_OK ? lobe_run_job(scene, job) : status;
}

static lobe_status begin_host(lobe_scene *scene, lobe_job *job, int sample, lobe_event **out, const char *call)
{
	if (!out)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: out is NULL", call);
	const lobe_status status = prepare_host(scene, job, sample, call);
	return status == LOBE_OK ? lobe_event_begin(out, scene, job) : status;
}

static lobe_status run_device(lobe_scene *scene, lobe_job *job, int sample, const char *call)
{
	if (!scene->device->ops->run_device)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: device \"%s\" takes no cl_mem", call, scene->device->name);
	if (job->count == 0)
		return LOBE_OK;
	const lobe_status status = check_presence(job, sample, call);
	if (status != LOBE_OK)
		return status;
	for (int i = 0; i < LOBE_OUT_COUNT; i++) {
		for (int k = i + 1; job->out[i] && k < LOBE_OUT_COUNT; k++)
			if (job->out[i] == job->out[k])
				return lobe_fail(LOBE_ERROR_ARGUMENT,
						 "%s: output batch->%s is the same buffer as batch->%s", call,
						 lobe_out_names[sample][i], lobe_out_names[sample][k]);
		for (int k = 0; job->out[i] && k < LOBE_IN_COUNT; k++)
			if (job->out[i] == job->in[k])
				return lobe_fail(LOBE_ERROR_ARGUMENT,
						 "%s: output batch->%s is the same buffer as batch->%s", call,
						 lobe_out_names[sample][i], lobe_in_names[sample][k]);
		if (job->out[i] && job->out[i] == job->material)
			return lobe_fail(LOBE_ERROR_ARGUMENT,
					 "%s: output batch->%s is the same buffer as batch->material", call,
					 lobe_out_names[sample][i]);
	}
	job->verb = sample ? sample_verb(job) : eval_verb(job);
	return scene->device->ops->run_device(scene, job);
}

lobe_status lobe_scene_eval(lobe_scene *scene, const lobe_batch *batch)
{
	const lobe_status status = check_call(scene, batch, "lobe_scene_eval");
	lobe_job job = {0};
	if (status != LOBE_OK)
		return status;
	FILL_EVAL(job, batch);
	fill_eval_strides(&job, &batch->stride);
	return run_host(scene, &job, 0, "lobe_scene_eval");
}

lobe_status lobe_scene_sample(lobe_scene *scene, const lobe_batch *batch)
{
	const lobe_status status = check_call(scene, batch, "lobe_scene_sample");
	lobe_job job = {0};
	if (status != LOBE_OK)
		return status;
	FILL_SAMPLE(job, batch);
	fill_sample_strides(&job, &batch->stride);
	return run_host(scene, &job, 1, "lobe_scene_sample");
}

lobe_status lobe_scene_eval_async(lobe_scene *scene, const lobe_batch *batch, lobe_event **out)
{
	const lobe_status status = check_call(scene, batch, "lobe_scene_eval_async");
	lobe_job job = {0};
	if (status != LOBE_OK)
		return status;
	FILL_EVAL(job, batch);
	fill_eval_strides(&job, &batch->stride);
	return begin_host(scene, &job, 0, out, "lobe_scene_eval_async");
}

lobe_status lobe_scene_sample_async(lobe_scene *scene, const lobe_batch *batch, lobe_event **out)
{
	const lobe_status status = check_call(scene, batch, "lobe_scene_sample_async");
	lobe_job job = {0};
	if (status != LOBE_OK)
		return status;
	FILL_SAMPLE(job, batch);
	fill_sample_strides(&job, &batch->stride);
	return begin_host(scene, &job, 1, out, "lobe_scene_sample_async");
}

lobe_status lobe_scene_eval_cl(lobe_scene *scene, const lobe_cl_batch *batch)
{
	const lobe_status status = check_call(scene, batch, "lobe_scene_eval_cl");
	lobe_job job = {0};
	if (status != LOBE_OK)
		return status;
	FILL_EVAL(job, batch);
	return run_device(scene, &job, 0, "lobe_scene_eval_cl");
}

lobe_status lobe_scene_sample_cl(lobe_scene *scene, const lobe_cl_batch *batch)
{
	const lobe_status status = check_call(scene, batch, "lobe_scene_sample_cl");
	lobe_job job = {0};
	if (status != LOBE_OK)
		return status;
	FILL_SAMPLE(job, batch);
	return run_device(scene, &job, 1, "lobe_scene_sample_cl");
}
