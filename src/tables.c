/* tables.c - the tables that a scene's materials carry (core/table.h), gathered into one flat buffer. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

/* Words of the table that a distribution of normals samples by (microfacet/profile.h); 0: it needs none. */
static size_t words_needed(lobe_uint ndf)
{
	switch (ndf) {
#define LOBE_NDF_FIXED(NAME, name, number)
#define LOBE_NDF_SHAPED(NAME, name, number) case number:
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
		return LOBE_PROFILE_WORDS;
	default:
		return 0;
	}
}

/* The distribution that lobe_<name>'s parameters hold, or NULL. */
static lobe_distribution *distribution_of(int index, void *params)
{
	switch (index) {
#define LOBE_X(NAME, name, kind)
#define LOBE_X_TABLED(NAME, name, kind)                                                                                \
	case LOBE_INDEX_##NAME:                                                                                        \
		return &((lobe_##name *)params)->surface.distribution;
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	default:
		return NULL;
	}
}

int lobe_is_tabled(int index)
{
	switch (index) {
#define LOBE_X(NAME, name, kind)
#define LOBE_X_TABLED(NAME, name, kind) case LOBE_INDEX_##NAME:
#include "lobe/lobes/lobes.def"
#undef LOBE_X
		return 1;
	default:
		return 0;
	}
}

static const float *words_at(lobe_table t) { return (const float *)(uintptr_t)lobe_table_address(t); }

lobe_status lobe_check_table(const lobe_bsdf *materials, size_t i)
{
	lobe_bsdf material = materials[i];
	const int index = lobe_index_of_kind(material.kind);
	const lobe_distribution *const d = distribution_of(index, &material.as);
	const size_t words = d ? words_needed(d->ndf) : 0;
	if (words == 0)
		return LOBE_OK; /* a handle that nobody asks for is not looked at */
	const uint64_t address = lobe_table_address(d->table);
	if (address == 0 || address % sizeof(float) != 0 || address > UINTPTR_MAX)
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "materials[%zu]: the distribution of lobe_%s needs a table and has %s; those of "
				 "profile_table.h come with theirs",
				 i, lobe_param_name[index], address == 0 ? "none" : "something else");
	const float *const table = words_at(d->table);
	if (table[0] != (float)words)
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "materials[%zu]: the table of lobe_%s begins with %g, not with its length %zu", i,
				 lobe_param_name[index], (double)table[0], words);
	for (size_t k = 1; k < words; k++)
		if (!isfinite(table[k]))
			return lobe_fail(LOBE_ERROR_PARAMETER, "materials[%zu]: word %zu of the table of lobe_%s is %g",
					 i, k, lobe_param_name[index], (double)table[k]);
	return LOBE_OK;
}

/* A table of the materials and its copy's place in the buffer. */
typedef struct {
	uint64_t from;
	size_t at, length;
} copy;

/* The copy of the table at that address, or a new one at the end. Few materials have a table of their own, so a search
 * along the list will do. */
static const copy *find_or_add(copy *copies, size_t *count, size_t *words, lobe_table t)
{
	const uint64_t from = lobe_table_address(t);
	for (size_t k = 0; k < *count; k++)
		if (copies[k].from == from)
			return &copies[k];
	copy *const c = &copies[(*count)++];
	c->from = from;
	c->at = *words;
	c->length = (size_t)*words_at(t);
	*words += c->length;
	return c;
}

/* Of material i of a lobe's own. */
static lobe_distribution *distribution_at(const lobe_scene *scene, int lobe, size_t i)
{
	return distribution_of(lobe, (unsigned char *)scene->table[lobe].params + i * lobe_param_size[lobe]);
}

int lobe_tables_gather(lobe_scene *scene)
{
	size_t params = 0, count = 0, words = 1;
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++)
		params += lobe_is_tabled(lobe) ? scene->table[lobe].count : 0;
	if (params == 0)
		return 1;
	copy *const copies = malloc(params * sizeof *copies);
	if (!copies)
		return 0;
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++) {
		for (size_t i = 0; lobe_is_tabled(lobe) && i < scene->table[lobe].count; i++) {
			lobe_distribution *const d = distribution_at(scene, lobe, i);
			uint64_t at = 0;
			if (words_needed(d->ndf))
				at = sizeof(float) * find_or_add(copies, &count, &words, d->table)->at;
			d->table = lobe_table_at(at);
		}
	}
	scene->tables = calloc(words, sizeof *scene->tables);
	for (size_t k = 0; scene->tables && k < count; k++)
		memcpy(scene->tables + copies[k].at, (const float *)(uintptr_t)copies[k].from,
		       copies[k].length * sizeof *scene->tables);
	scene->table_words = words;
	free(copies);
	return scene->tables != NULL;
}

void lobe_tables_rebase(lobe_scene *scene, uint64_t base)
{
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++) {
		for (size_t i = 0; lobe_is_tabled(lobe) && i < scene->table[lobe].count; i++) {
			lobe_distribution *const d = distribution_at(scene, lobe, i);
			d->table = lobe_table_at(base + lobe_table_address(d->table));
		}
	}
}
