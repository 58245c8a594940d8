/* scene.c - scenes: materials checked and sorted by lobe, then handed to a backend. */
#include <stdlib.h>

#include "internal.h"

static void free_scene(lobe_scene *scene)
{
	for (int i = 0; i < LOBE_COUNT; i++)
		free(scene->table[i].params);
	free(scene->tables);
	free(scene->index);
	free(scene->slot);
	free(scene->options);
	free(scene);
}

/* Fills index, slot, table and options from materials that have been checked. 0 when out of memory. */
static int fill_scene(lobe_scene *scene, const lobe_bsdf *materials)
{
	scene->index = malloc(scene->count * sizeof *scene->index);
	scene->slot = malloc(scene->count * sizeof *scene->slot);
	if (!scene->index || !scene->slot)
		return 0;
	uint32_t none = 0;
	for (size_t i = 0; i < scene->count; i++) {
		const int index = lobe_index_of_kind(materials[i].kind);
		scene->index[i] = (uint32_t)index;
		scene->slot[i] = index == LOBE_INDEX_NONE ? none++ : (uint32_t)scene->table[index].count++;
	}
	for (int i = 0; i < LOBE_COUNT; i++)
		if (scene->table[i].count &&
		    !(scene->table[i].params = malloc(scene->table[i].count * lobe_param_size[i])))
			return 0;
	for (size_t i = 0; i < scene->count; i++) {
		const uint32_t index = scene->index[i];
		if (index == LOBE_INDEX_NONE)
			continue;
		const size_t size = lobe_param_size[index];
		memcpy((unsigned char *)scene->table[index].params + scene->slot[i] * size, &materials[i].as, size);
	}
	return lobe_tables_gather(scene) && (scene->options = lobe_make_options(scene, materials)) != NULL;
}

lobe_status lobe_scene_create(lobe_scene **out, lobe_device *device, const lobe_bsdf *materials, size_t count)
{
	if (!out || !device || !materials)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_scene_create: %s is NULL",
				 !out ? "out" : (!device ? "device" : "materials"));
	if (count == 0 || count > UINT32_MAX)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "lobe_scene_create: count is %zu, not 1 to 2^32 - 1", count);
	for (size_t i = 0; i < count; i++) {
		lobe_status status = lobe_check_material(materials, i);
		if (status == LOBE_OK)
			status = lobe_check_table(materials, i);
		if (status != LOBE_OK)
			return status;
	}
	lobe_scene *scene = calloc(1, sizeof *scene);
	if (!scene)
		return lobe_out_of_memory("a scene");
	scene->device = device;
	scene->count = count;
	lobe_status status = LOBE_OK;
	if (!fill_scene(scene, materials))
		status = lobe_fail(LOBE_ERROR_MEMORY, "lobe_scene_create: out of memory for %zu materials", count);
	else
		status = device->ops->scene_create(scene);
	if (status != LOBE_OK) {
		free_scene(scene);
		return status;
	}
	__atomic_fetch_add(&device->scenes, 1, __ATOMIC_RELAXED);
	*out = scene;
	return LOBE_OK;
}

lobe_status lobe_scene_share(lobe_scene *out, const lobe_scene *from, lobe_device *device)
{
	*out = *from;
	out->device = device;
	out->state = NULL;
	return device->ops->scene_create(out);
}

void lobe_scene_destroy(lobe_scene *scene)
{
	if (!scene)
		return;
	lobe_device *const device = scene->device;
	device->ops->scene_destroy(scene);
	free_scene(scene);
	lobe_device_close(device);
}
