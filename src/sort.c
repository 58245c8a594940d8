/* sort.c - elements of a mixed batch grouped by lobe, by counting. */
#include "internal.h"

void lobe_sort_by_lobe(const lobe_scene *scene, const uint32_t *material, size_t n, uint32_t *order, size_t *begin)
{
	size_t next[LOBE_COUNT + 1] = {0};
	for (size_t i = 0; i < n; i++)
		next[scene->index[material[i]]]++;
	size_t at = 0;
	for (int lobe = 0; lobe <= LOBE_COUNT; lobe++) {
		begin[lobe] = at;
		at += next[lobe];
		next[lobe] = begin[lobe];
	}
	begin[LOBE_COUNT + 1] = at;
	for (size_t i = 0; i < n; i++)
		order[next[scene->index[material[i]]]++] = (uint32_t)i;
}
