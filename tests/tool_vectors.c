/* tool_vectors.c - writes the known-answer vectors, one file per lobe: `make vectors`. Their format:
 *
 *	case NAME
 *	make ARGUMENTS                          of the lobe's make function, in order; what is left out is 0
 *	eval   WO WI   F PDF                    3 + 3 numbers in, 3 + 1 out
 *	sample WO U    WI WEIGHT PDF EVENT      3 + 3 in, 3 + 3 + 1 and a whole number out
 *
 * Numbers are hexadecimal floats, exact to the bit. */
#include <stdio.h>
#include <string.h>

#include "cases.h"
#include "inputs.h"

enum { PER_CASE = 6, ARGUMENTS = 8 };

/* How many of a case's parameters are written: ARGUMENTS, or as many as it has. */
static int arguments(const test_case *c)
{
	int n = CASE_PARAMETERS;
	while (n > ARGUMENTS && c->parameter[n - 1] == 0.0)
		n--;
	return n;
}

static void put(FILE *file, const float *x, int count)
{
	for (int i = 0; i < count; i++)
		fprintf(file, " %a", (double)x[i]);
}

static void write_case(FILE *file, const test_case *c, inputs in, size_t first)
{
	fprintf(file, "case %s\nmake", c->name);
	for (int i = 0; i < arguments(c); i++)
		fprintf(file, " %a", c->parameter[i]);
	fputc('\n', file);
	for (size_t i = first; i < first + PER_CASE; i++) {
		const float z = in.array[2][i];
		const lobe_vec3 wo = lobe_vec3_make(in.array[0][i], in.array[1][i], i % 3 ? lobe_abs(z) : z);
		const lobe_vec3 wi = lobe_vec3_make(in.array[3][i], in.array[4][i], in.array[5][i]);
		const lobe_vec3 u = lobe_vec3_make(in.array[6][i], in.array[7][i], in.array[8][i]);
		const lobe_rgb f = lobe_bsdf_eval(c->bsdf, wo, wi);
		const lobe_sample s = lobe_bsdf_sample(c->bsdf, wo, u);
		const float eval[10] = {wo.x, wo.y, wo.z, wi.x, wi.y,
					wi.z, f.r,  f.g,  f.b,  lobe_bsdf_pdf(c->bsdf, wo, wi)};
		const float sample[13] = {wo.x,   wo.y,   wo.z,       u.x,        u.y,        u.z,  s.wi.x,
					  s.wi.y, s.wi.z, s.weight.r, s.weight.g, s.weight.b, s.pdf};
		fputs("eval", file);
		put(file, eval, 10);
		fputs("\nsample", file);
		put(file, sample, 13);
		fprintf(file, " %u\n", s.event);
	}
}

static int write_lobe(const char *folder, const char *name, lobe_uint kind, inputs in)
{
	char path[512];
	snprintf(path, sizeof path, "%s/%s.txt", folder, name);
	FILE *file = fopen(path, "w");
	if (!file) {
		perror(path);
		return 1;
	}
	fprintf(file, "# Known answers of lobe_%s, written by make vectors; tests/tool_vectors.c tells the format.\n",
		name);
	for (size_t i = 0; i < case_count(); i++)
		if (case_at(i)->kind == kind)
			write_case(file, case_at(i), in, i * PER_CASE);
	printf("%s\n", path);
	return fclose(file) != 0;
}

int main(int argc, char **argv)
{
	if (argc != 2) {
		fprintf(stderr, "usage: tool_vectors FOLDER\n");
		return 2;
	}
	inputs in = inputs_alloc(case_count() * PER_CASE);
	int failed = 0;
	inputs_random(in, 5000000);
#define LOBE_X(NAME, name, kind) failed |= write_lobe(argv[1], #name, kind, in);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	inputs_free(in);
	return failed;
}
