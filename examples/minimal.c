/* minimal.c - one lobe from its header alone: nothing to link but libm, no library to build.
 *
 *	cc -std=c99 -O2 -ffp-contract=off -Iinclude examples/minimal.c -lm
 *
 * In loops over many points add what lets them vectorise, which is many times as fast: -O3 -fno-math-errno
 * -fno-trapping-math, and -mavx2 -mfma or -march=native. */
#include <stdio.h>

#include "lobe/core/optics.h"
#include "lobe/core/warp.h"
#include "lobe/lobes/ggx_conductor.h"

int main(void)
{
	/* Parameters in, prepared constants out; alpha is roughness squared. */
	const float roughness = 0.4f, alpha = roughness * roughness;
	const lobe_ggx_conductor gold =
		lobe_ggx_conductor_make(alpha, alpha, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD));
	/* Directions live in the shading frame: z is the normal, all point away from the surface. */
	const lobe_vec3 u = lobe_vec3_make(0.3f, 0.6f, 0.5f);

	printf("gold, roughness %.2f; eval is f |cos| towards the mirror direction [1/sr], in red, green and blue\n",
	       (double)roughness);
	printf("%8s %30s %8s   %26s %26s %8s\n", "angle", "eval", "pdf", "a sampled direction", "its weight",
	       "its pdf");
	for (int degrees = 0; degrees < 90; degrees += 15) {
		const lobe_sincos angle = lobe_sincos_2pi((float)degrees / 360.0f);
		const lobe_vec3 wo = lobe_vec3_make(angle.s, 0.0f, angle.c);
		const lobe_vec3 mirror = lobe_vec3_make(-wo.x, -wo.y, wo.z);
		const lobe_rgb f = lobe_ggx_conductor_eval(gold, wo, mirror);
		const lobe_real pdf = lobe_ggx_conductor_pdf(gold, wo, mirror);
		const lobe_sample s = lobe_ggx_conductor_sample(gold, wo, u);
		printf("%4d deg %10.4f%10.4f%10.4f %8.4f   ", degrees, (double)f.r, (double)f.g, (double)f.b,
		       (double)pdf);
		if (s.event) /* 0: no sample, and then all fields are 0 */
			printf("%8.4f %8.4f %8.4f %8.4f %8.4f %8.4f %8.4f\n", (double)s.wi.x, (double)s.wi.y,
			       (double)s.wi.z, (double)s.weight.r, (double)s.weight.g, (double)s.weight.b,
			       (double)s.pdf);
		else
			printf("none: it would have gone into the metal\n");
	}
	return 0;
}
