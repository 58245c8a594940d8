/* options.c - how the OpenCL program of a scene is built: which lobes it has, and of what they choose at run time the
 * values that no material chooses left out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

/* Exact arithmetic; see backend/opencl.h. */
#define BASE_OPTIONS "-cl-std=CL1.2 -cl-fp32-correctly-rounded-divide-sqrt"

const char *lobe_opencl_options(const lobe_scene *scene) { return scene ? scene->options : BASE_OPTIONS; }

/* One -D of a choice: its name, a number of two digits at most. */
#define CHOICE_OPTION " -DLOBE_ONLY_%s=%uu"

static const char *const choice_names[LOBE_CHOICES_COUNT] = {
#define LOBE_CHOICE_NAME(NAME) #NAME,
	LOBE_CHOICES(LOBE_CHOICE_NAME)
#undef LOBE_CHOICE_NAME
};

/* Where all materials choose the same value, its number; 0 where none has that choice to make. LOBE_ANY else. */
static uint32_t only_choice(uint32_t used)
{
	uint32_t value = 0;
	if (used & (used - 1))
		return LOBE_ANY;
	while (used >> value > 1)
		value++;
	return value;
}

char *lobe_make_options(const lobe_scene *scene, const lobe_bsdf *materials)
{
	static const char *const names[LOBE_COUNT + 1] = {
#define LOBE_X(NAME, name, kind) #NAME,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
		NULL};
	uint32_t used[LOBE_CHOICES_COUNT] = {0};
	size_t size = sizeof BASE_OPTIONS + sizeof " -DLOBE_HAS_DEFAULT=0";
	int choosing = 0;
	for (size_t i = 0; i < scene->count; i++)
		choosing |= lobe_add_choices(&materials[i], used);
	for (int i = 0; i < LOBE_COUNT; i++)
		size += scene->table[i].count ? sizeof " -DLOBE_HAS_=1" + strlen(names[i]) : 0;
	for (int i = 0; i < LOBE_CHOICES_COUNT; i++)
		size += sizeof CHOICE_OPTION + strlen(choice_names[i]);
	char *options = malloc(size);
	if (!options)
		return NULL;
	size_t at = (size_t)snprintf(options, size, "%s -DLOBE_HAS_DEFAULT=0", BASE_OPTIONS);
	for (int i = 0; i < LOBE_COUNT; i++)
		if (scene->table[i].count)
			at += (size_t)snprintf(options + at, size - at, " -DLOBE_HAS_%s=1", names[i]);
	for (int i = 0; choosing && i < LOBE_CHOICES_COUNT; i++) {
		const uint32_t only = only_choice(used[i]);
		if (only != LOBE_ANY)
			at += (size_t)snprintf(options + at, size - at, CHOICE_OPTION, choice_names[i], only);
	}
	return options;
}
