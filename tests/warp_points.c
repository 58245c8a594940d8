#include "warp_points.h"

#include "support.h"

const float cap_heights[HEIGHTS] = {0x1p-32f, 1e-4f, 0.3f, 1.0f, 1.7f, 2.0f};

static const float corner[] = {0.0f,           0x1p-149f, 0x1p-126f,      0x1p-25f, 0x1p-24f,       0.25f,
			       0x1.fffffep-2f, 0.5f,      0x1.000002p-1f, 0.75f,    0x1.fffffcp-1f, 0x1.fffffep-1f};
#define CORNERS (sizeof corner / sizeof corner[0])

lobe_vec2 point(uint64_t i)
{
	const uint64_t pairs = CORNERS * CORNERS;
	if (i < pairs)
		return lobe_vec2_make(corner[i % CORNERS], corner[i / CORNERS]);
	const lobe_vec2 u = lobe_vec2_make(test_uniform(1, 2 * i), test_uniform(1, 2 * i + 1));
	if (i % 4 == 0)
		return lobe_vec2_make(corner[i / 4 % CORNERS], u.y);
	if (i % 4 == 1)
		return lobe_vec2_make(u.x, corner[i / 4 % CORNERS]);
	return u;
}
