#include "film_cases.h"

#include "support.h"

#include <math.h>

stack make_stack(uint32_t i, int metal)
{
	const float u[4] = {test_uniform(1, i), test_uniform(2, i), test_uniform(3, i), test_uniform(4, i)};
	const float most[4] = {0.0f, 50.0f, 300.0f, 1500.0f};
	stack s;
	s.c = fmaxf(u[0] * sqrtf(u[0]), 1e-3f);
	s.d = most[i % 4] * u[1];
	s.film = 1.0f + 1.5f * u[2];
	const lobe_rgb n = lobe_metal_eta(i / 4 % LOBE_METAL_COUNT), k = lobe_metal_k(i / 4 % LOBE_METAL_COUNT);
	for (int m = 0; m < 3; m++) {
		s.n[m] = metal ? (float)channel(n, m) : 1.0f + 2.0f * u[3];
		s.k[m] = metal ? (float)channel(k, m) : 0.0f;
	}
	return s;
}

double base_of(stack s, int m)
{
	return s.k[m] > 0.0f ? (double)lobe_fresnel_conductor(s.c, s.n[m], s.k[m])
			     : (double)lobe_fresnel_dielectric(s.c, s.n[m]).reflectance;
}
