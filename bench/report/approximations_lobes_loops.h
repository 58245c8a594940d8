/* approximations_lobes_loops.h - the body of approximations_single.c and approximations_double.c: loops over lobes,
 * whose names end in PRECISION. */
#include "../timing.h"
#include "approximations_lobes.h"
#include "approximations_side.h"
#include "cases_make.h"
#include "support.h"

enum { LENGTH = 2048 };

#define ARRAYS                                                                                                         \
	const lobe_real *restrict ox, const lobe_real *restrict oy, const lobe_real *restrict oz,                      \
		const lobe_real *restrict ix, const lobe_real *restrict iy, const lobe_real *restrict iz,              \
		lobe_real *restrict r0, lobe_real *restrict r1, lobe_real *restrict r2, lobe_real *restrict r3
#define WO lobe_vec3_make(ox[i], oy[i], oz[i])
#define WI lobe_vec3_make(ix[i], iy[i], iz[i])

#define VERB_LOOP(loop, type, store, between)                                                                          \
	static __attribute__((noinline)) void loop(type p, ARRAYS)                                                     \
	{                                                                                                              \
		for (size_t i = 0; i < LENGTH; i++) {                                                                  \
			store;                                                                                         \
			between;                                                                                       \
		}                                                                                                      \
		(void)r0, (void)r1, (void)r2, (void)r3;                                                                \
	}
#define EVAL(name)                                                                                                     \
	const lobe_rgb f = lobe_##name##_eval(p, WO, WI);                                                              \
	r0[i] = f.r, r1[i] = f.g, r2[i] = f.b
#define PDF(name) r0[i] = lobe_##name##_pdf(p, WO, WI)
#define SAMPLE(name)                                                                                                   \
	const lobe_sample f = lobe_##name##_sample(p, WO, WI);                                                         \
	r0[i] = f.wi.x + f.weight.r, r1[i] = f.wi.y + f.weight.g, r2[i] = f.wi.z + f.weight.b, r3[i] = f.pdf
#define LOBE_LOOPS(NAME, name, ...)                                                                                    \
	VERB_LOOP(name##_eval_vector, lobe_##name, EVAL(name), SIDE_BY_SIDE)                                           \
	VERB_LOOP(name##_eval_scalar, lobe_##name, EVAL(name), ONE_BY_ONE)                                             \
	VERB_LOOP(name##_pdf_vector, lobe_##name, PDF(name), SIDE_BY_SIDE)                                             \
	VERB_LOOP(name##_pdf_scalar, lobe_##name, PDF(name), ONE_BY_ONE)                                               \
	VERB_LOOP(name##_sample_vector, lobe_##name, SAMPLE(name), SIDE_BY_SIDE)                                       \
	VERB_LOOP(name##_sample_scalar, lobe_##name, SAMPLE(name), ONE_BY_ONE)                                         \
	static void name##_run(int verb, int vector, ARRAYS)                                                           \
	{                                                                                                              \
		static const double parameter[] = {__VA_ARGS__};                                                       \
		const lobe_##name p = make_bsdf(LOBE_KIND_##NAME, parameter).as.name;                                  \
		if (verb == VERB_EVAL)                                                                                 \
			(vector ? name##_eval_vector : name##_eval_scalar)(p, ox, oy, oz, ix, iy, iz, r0, r1, r2, r3); \
		else if (verb == VERB_PDF)                                                                             \
			(vector ? name##_pdf_vector : name##_pdf_scalar)(p, ox, oy, oz, ix, iy, iz, r0, r1, r2, r3);   \
		else                                                                                                   \
			(vector ? name##_sample_vector : name##_sample_scalar)(p, ox, oy, oz, ix, iy, iz, r0, r1, r2,  \
									       r3);                                    \
	}
APPROXIMATIONS_LOBES(LOBE_LOOPS)

#define RUN_ENTRY(NAME, name, ...) name##_run,
static void (*const runs[])(int verb, int vector, ARRAYS) = {APPROXIMATIONS_LOBES(RUN_ENTRY)};

double PRECISION(size_t lobe, int verb, int vector, int rounds, double *calls)
{
	static lobe_real in[6][LENGTH], out[4][LENGTH];
	for (size_t i = 0; i < LENGTH; i++) {
		float o[3], w[3];
		test_direction(91, i, o);
		test_direction(92, i, w);
		if (verb == VERB_SAMPLE)
			test_u3(93, i, w);
		for (int k = 0; k < 3; k++) {
			in[k][i] = (lobe_real)(k == 2 && o[k] < 0.0f ? -o[k] : o[k]);
			in[3 + k][i] = (lobe_real)(k == 2 && w[k] < 0.0f ? -w[k] : w[k]);
		}
	}
	/* The first round warms up. */
	runs[lobe](verb, vector, in[0], in[1], in[2], in[3], in[4], in[5], out[0], out[1], out[2], out[3]);
	const double start = bench_now();
	for (int r = 0; r < rounds; r++)
		runs[lobe](verb, vector, in[0], in[1], in[2], in[3], in[4], in[5], out[0], out[1], out[2], out[3]);
	*calls = (double)rounds * LENGTH;
	return bench_now() - start;
}
