/* job.c - the arrays of a job by number. */
#include "job.h"

static const char *const in_names[2][LOBE_IN_COUNT] = {{"wo[0]", "wo[1]", "wo[2]", "wi[0]", "wi[1]", "wi[2]"},
						       {"wo[0]", "wo[1]", "wo[2]", "u[0]", "u[1]", "u[2]"}};
static const char *const out_names[2][LOBE_OUT_COUNT] = {
	{"f[0]", "f[1]", "f[2]", "pdf", "", "", "", ""},
	{"sample_wi[0]", "sample_wi[1]", "sample_wi[2]", "weight[0]", "weight[1]", "weight[2]", "sample_pdf", "event"}};

const void *lobe_array(const lobe_job *job, int k)
{
	if (k < LOBE_OUT_COUNT)
		return job->out[k];
	return k < LOBE_OUT_COUNT + LOBE_IN_COUNT ? job->in[k - LOBE_OUT_COUNT] : job->material;
}

size_t lobe_array_stride(const lobe_job *job, int k)
{
	if (k < LOBE_OUT_COUNT)
		return job->out_stride[k];
	return k < LOBE_OUT_COUNT + LOBE_IN_COUNT ? job->in_stride[k - LOBE_OUT_COUNT] : job->material_stride;
}

const char *lobe_array_name(int sample, int k)
{
	if (k < LOBE_OUT_COUNT)
		return out_names[sample][k];
	return k < LOBE_OUT_COUNT + LOBE_IN_COUNT ? in_names[sample][k - LOBE_OUT_COUNT] : "material";
}

int lobe_is_packed(const lobe_job *job)
{
	int yes = 1;
	for (int k = 0; k < LOBE_ARRAY_COUNT; k++)
		yes &= !lobe_array(job, k) || lobe_array_stride(job, k) == 4;
	return yes;
}
