/* hand_rows.c - ggx_conductor in loops as a user writes them over its header, without lobe's batches: compiled with the
 * options of the library's loops, once for each instruction set, LOBE_ROW_ISA. */
#define LOBE_FN static inline __attribute__((always_inline))
#include "lobe/lobes/ggx_conductor.h"

#include "hand.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

static __attribute__((noinline)) void eval_pdf(const lobe_ggx_conductor given, size_t n, const float *restrict ox,
					       const float *restrict oy, const float *restrict oz,
					       const float *restrict ix, const float *restrict iy,
					       const float *restrict iz, float *restrict r, float *restrict g,
					       float *restrict b, float *restrict pdf)
{
	for (size_t i = 0; i < n; i++) {
		const lobe_vec3 wo = lobe_vec3_make(ox[i], oy[i], oz[i]), wi = lobe_vec3_make(ix[i], iy[i], iz[i]);
		const lobe_rgb f = lobe_ggx_conductor_eval(given, wo, wi);
		r[i] = f.r;
		g[i] = f.g;
		b[i] = f.b;
		pdf[i] = lobe_ggx_conductor_pdf(given, wo, wi);
	}
}

static __attribute__((noinline)) void sample(const lobe_ggx_conductor given, size_t n, const float *restrict ox,
					     const float *restrict oy, const float *restrict oz,
					     const float *restrict ux, const float *restrict uy,
					     const float *restrict uz, float *restrict x, float *restrict y,
					     float *restrict z, float *restrict r, float *restrict g, float *restrict b,
					     float *restrict pdf, uint32_t *restrict event)
{
	for (size_t i = 0; i < n; i++) {
		const lobe_sample s = lobe_ggx_conductor_sample(given, lobe_vec3_make(ox[i], oy[i], oz[i]),
								lobe_vec3_make(ux[i], uy[i], uz[i]));
		x[i] = s.wi.x;
		y[i] = s.wi.y;
		z[i] = s.wi.z;
		r[i] = s.weight.r;
		g[i] = s.weight.g;
		b[i] = s.weight.b;
		pdf[i] = s.pdf;
		event[i] = s.event;
	}
}

void PASTE(bench_hand_eval_, LOBE_ROW_ISA)(const lobe_ggx_conductor *p, const lobe_batch *b)
{
	eval_pdf(*p, b->count, b->wo[0], b->wo[1], b->wo[2], b->wi[0], b->wi[1], b->wi[2], b->f[0], b->f[1], b->f[2],
		 b->pdf);
}

void PASTE(bench_hand_sample_, LOBE_ROW_ISA)(const lobe_ggx_conductor *p, const lobe_batch *b)
{
	sample(*p, b->count, b->wo[0], b->wo[1], b->wo[2], b->u[0], b->u[1], b->u[2], b->sample_wi[0], b->sample_wi[1],
	       b->sample_wi[2], b->weight[0], b->weight[1], b->weight[2], b->sample_pdf, b->event);
}
