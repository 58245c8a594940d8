/* tables.c - the tables that a scene's materials carry (core/table.h), gathered into one flat buffer. */
#include <stdlib.h>
#include <string.h>

#include "internal.h"

/* Words of the longest table. */
#define TABLE_MAX ((size_t)1 << 24)

/* Whether a distribution of normals samples by a table (microfacet/profile.h). */
static int needs_table(lobe_uint ndf)
{
	switch (ndf) {
#define LOBE_NDF_FIXED(NAME, name, number)
#define LOBE_NDF_SHAPED(NAME, name, number) case number:
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
		return 1;
	default:
		return 0;
	}
}

typedef struct {
	int tabled;
	int (*needs)(const void *params);
	lobe_table (*get)(const void *params);
	void (*set)(void *params, lobe_table t);
} access;

/* clang-format off */
#define LOBE_X(NAME, name, kind)
#define LOBE_X_TABLED(NAME, name, kind)                                                                                \
	static int needs_##name(const void *params)                                                                    \
	{                                                                                                              \
		return needs_table(((const lobe_##name *)params)->surface.distribution.ndf);                           \
	}                                                                                                              \
	static lobe_table get_##name(const void *params)                                                               \
	{                                                                                                              \
		return lobe_##name##_table(*(const lobe_##name *)params);                                              \
	}                                                                                                              \
	static void set_##name(void *params, lobe_table t)                                                             \
	{                                                                                                              \
		*(lobe_##name *)params = lobe_##name##_with_table(*(const lobe_##name *)params, t);                    \
	}
#include "lobe/lobes/lobes.def"
#undef LOBE_X

static const access lobes[LOBE_COUNT] = {
#define LOBE_X(NAME, name, kind) {0, NULL, NULL, NULL},
#define LOBE_X_TABLED(NAME, name, kind) {1, needs_##name, get_##name, set_##name},
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};
/* clang-format on */

int lobe_is_tabled(int index) { return lobes[index].tabled; }

static const float *words_at(lobe_table t) { return (const float *)(uintptr_t)lobe_table_address(t); }

lobe_status lobe_check_table(const lobe_bsdf *materials, size_t i)
{
	const int index = lobe_index_of_kind(materials[i].kind);
	if (index == LOBE_INDEX_NONE || !lobes[index].tabled)
		return LOBE_OK;
	const lobe_table t = lobes[index].get(&materials[i].as);
	if (lobe_table_address(t) == 0) {
		if (!lobes[index].needs(&materials[i].as))
			return LOBE_OK;
		return lobe_fail(LOBE_ERROR_PARAMETER,
				 "materials[%zu]: the distribution of lobe_%s needs a table and has none; those of "
				 "profile_table.h come with theirs",
				 i, lobe_param_name[index]);
	}
	const double length = (double)*words_at(t);
	if (length >= 1.0 && length <= (double)TABLE_MAX && length == (double)(size_t)length)
		return LOBE_OK;
	return lobe_fail(LOBE_ERROR_PARAMETER,
			 "materials[%zu]: the table of lobe_%s begins with %g, which is not the length of a table", i,
			 lobe_param_name[index], length);
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

int lobe_tables_gather(lobe_scene *scene)
{
	size_t params = 0, count = 0, words = 1;
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++)
		params += lobes[lobe].tabled ? scene->table[lobe].count : 0;
	if (params == 0)
		return 1;
	copy *const copies = malloc(params * sizeof *copies);
	if (!copies)
		return 0;
	for (int lobe = 0; lobe < LOBE_COUNT; lobe++) {
		for (size_t i = 0; lobes[lobe].tabled && i < scene->table[lobe].count; i++) {
			void *const p = (unsigned char *)scene->table[lobe].params + i * lobe_param_size[lobe];
			const lobe_table t = lobes[lobe].get(p);
			if (lobe_table_address(t) != 0)
				lobes[lobe].set(p, lobe_table_at(sizeof(float) * find_or_add(copies, &count, &words, t)->at));
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
		for (size_t i = 0; lobes[lobe].tabled && i < scene->table[lobe].count; i++) {
			void *const p = (unsigned char *)scene->table[lobe].params + i * lobe_param_size[lobe];
			lobes[lobe].set(p, lobe_table_at(base + lobe_table_address(lobes[lobe].get(p))));
		}
	}
}
