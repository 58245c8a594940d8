/* batch.c - the front of batches: checks every argument, then hands over to the scene's device. */
#include "event.h"
#include "strides.h"

/* Inputs there, vectors whole, at least one output. */
static lobe_status check_presence(const lobe_job *job, int sample, const char *call)
{
	for (int i = 0; i < LOBE_IN_COUNT; i++)
		if (!job->in[i])
			return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->%s is NULL", call, lobe_array_name(sample, LOBE_OUT_COUNT + i));
	int wanted = 0;
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		wanted += job->out[i] != NULL;
	if (!wanted)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: every output of the batch is NULL", call);
	for (int first = 0; first <= (sample ? 3 : 0); first += 3)
		for (int i = first; i < first + 3; i++)
			if (!job->out[i] != !job->out[first])
				return lobe_fail(LOBE_ERROR_ARGUMENT, "%s: batch->%s is NULL but batch->%s is not",
						 call, lobe_array_name(sample, job->out[i] ? first : i),
						 lobe_array_name(sample, job->out[i] ? i : first));
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
	for (int i = 0; i < LOBE_OUT_COUNT; i++)
		for (int k = i + 1; job->out[i] && k < LOBE_ARRAY_COUNT; k++)
			if (job->out[i] == lobe_array(job, k))
				return lobe_fail(LOBE_ERROR_ARGUMENT,
						 "%s: output batch->%s is the same buffer as batch->%s", call,
						 lobe_array_name(sample, i), lobe_array_name(sample, k));
	job->verb = sample ? sample_verb(job) : eval_verb(job);
	return scene->device->ops->run_device(scene, job);
}

/* The job of a batch of host arrays, not yet checked. */
static lobe_status open_eval(lobe_job *job, const lobe_scene *scene, const lobe_batch *batch, const char *call)
{
	const lobe_status status = check_call(scene, batch, call);
	*job = (lobe_job){0};
	if (status != LOBE_OK)
		return status;
	FILL_EVAL(*job, batch);
	fill_eval_strides(job, &batch->stride);
	return LOBE_OK;
}

static lobe_status open_sample(lobe_job *job, const lobe_scene *scene, const lobe_batch *batch, const char *call)
{
	const lobe_status status = check_call(scene, batch, call);
	*job = (lobe_job){0};
	if (status != LOBE_OK)
		return status;
	FILL_SAMPLE(*job, batch);
	fill_sample_strides(job, &batch->stride);
	return LOBE_OK;
}

lobe_status lobe_scene_eval(lobe_scene *scene, const lobe_batch *batch)
{
	lobe_job job;
	const lobe_status status = open_eval(&job, scene, batch, "lobe_scene_eval");
	return status == LOBE_OK ? run_host(scene, &job, 0, "lobe_scene_eval") : status;
}

lobe_status lobe_scene_sample(lobe_scene *scene, const lobe_batch *batch)
{
	lobe_job job;
	const lobe_status status = open_sample(&job, scene, batch, "lobe_scene_sample");
	return status == LOBE_OK ? run_host(scene, &job, 1, "lobe_scene_sample") : status;
}

lobe_status lobe_scene_eval_async(lobe_scene *scene, const lobe_batch *batch, lobe_event **out)
{
	lobe_job job;
	const lobe_status status = open_eval(&job, scene, batch, "lobe_scene_eval_async");
	return status == LOBE_OK ? begin_host(scene, &job, 0, out, "lobe_scene_eval_async") : status;
}

lobe_status lobe_scene_sample_async(lobe_scene *scene, const lobe_batch *batch, lobe_event **out)
{
	lobe_job job;
	const lobe_status status = open_sample(&job, scene, batch, "lobe_scene_sample_async");
	return status == LOBE_OK ? begin_host(scene, &job, 1, out, "lobe_scene_sample_async") : status;
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
