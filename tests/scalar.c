#include "scalar.h"

void scalar_shade_plain(const lobe_bsdf *materials, const uint32_t *material, inputs in, float *const *out)
{
	scalar_shade(materials, material, in, out);
}
