/* optics.c - the names in core/optics.def. */
#include <string.h>

#include "lobe/optics_names.h"

static const char *const metal_names[LOBE_METAL_COUNT] = {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb) #name,
#define LOBE_GLASS(NAME, name, n)
#include "lobe/core/optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
};

static const char *const glass_names[LOBE_GLASS_COUNT] = {
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb)
#define LOBE_GLASS(NAME, name, n) #name,
#include "lobe/core/optics.def"
#undef LOBE_METAL
#undef LOBE_GLASS
};

static uint32_t find(const char *const *names, uint32_t count, const char *name)
{
	uint32_t i = 0;
	while (i < count && (!name || strcmp(names[i], name) != 0))
		i++;
	return i;
}

const char *lobe_metal_name(uint32_t metal) { return metal < LOBE_METAL_COUNT ? metal_names[metal] : NULL; }

uint32_t lobe_metal_find(const char *name) { return find(metal_names, LOBE_METAL_COUNT, name); }

const char *lobe_glass_name(uint32_t glass) { return glass < LOBE_GLASS_COUNT ? glass_names[glass] : NULL; }

uint32_t lobe_glass_find(const char *name) { return find(glass_names, LOBE_GLASS_COUNT, name); }
