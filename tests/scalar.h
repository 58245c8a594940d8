/* scalar.h - the scalar functions over arrays: what every device's bits are compared with. */
#ifndef LOBE_TESTS_SCALAR_H
#define LOBE_TESTS_SCALAR_H

#include <string.h>

#include "inputs.h"
#include "lobe/shading.h"

/* out: INPUTS_OUTPUTS arrays - f, pdf, sample's wi, weight, pdf, event. material may be NULL: the first for all. */
static inline void scalar_shade(const lobe_bsdf *materials, const uint32_t *material, inputs in, float *const *out)
{
	for (size_t i = 0; i < in.count; i++) {
		const lobe_bsdf b = materials[material ? material[i] : 0];
		const lobe_vec3 wo = lobe_vec3_make(in.array[0][i], in.array[1][i], in.array[2][i]);
		const lobe_vec3 wi = lobe_vec3_make(in.array[3][i], in.array[4][i], in.array[5][i]);
		const lobe_vec3 u = lobe_vec3_make(in.array[6][i], in.array[7][i], in.array[8][i]);
		const lobe_rgb f = lobe_bsdf_eval(b, wo, wi);
		const lobe_sample s = lobe_bsdf_sample(b, wo, u);
		const float values[11] = {f.r,        f.g,        f.b,    lobe_bsdf_pdf(b, wo, wi),
					  s.wi.x,     s.wi.y,     s.wi.z, s.weight.r,
					  s.weight.g, s.weight.b, s.pdf};
		for (int k = 0; k < 11; k++)
			out[k][i] = values[k];
		memcpy(&out[11][i], &s.event, 4);
	}
}

/* The same as a user's program has it that is not compiled for one processor: lobe_fma in double. (The test programs
 * are compiled for theirs; see the Makefile's TEST_PLAIN.) */
void scalar_shade_plain(const lobe_bsdf *materials, const uint32_t *material, inputs in, float *const *out);

#endif
