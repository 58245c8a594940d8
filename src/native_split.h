/* native_split.h - the elements of a block brought together by key, and put back: data movement alone, so every
 * instruction set gives the same bits. native_split.c is compiled once for each, like the row loops. */
#ifndef LOBE_NATIVE_SPLIT_H
#define LOBE_NATIVE_SPLIT_H

#include "internal.h"

enum {
	LOBE_NATIVE_SPLIT_MAX = 2048,  /* elements of a block */
	LOBE_NATIVE_SPLIT_VECTOR = 16, /* each key's elements begin at a multiple of this */
	/* Scenes of no more materials are split by material, so that their parameters are constants of the loops; others
	 * by lobe. */
	LOBE_NATIVE_SPLIT_MATERIALS = 32,
	LOBE_NATIVE_SPLIT_KEYS =
		(LOBE_COUNT > LOBE_NATIVE_SPLIT_MATERIALS ? (int)LOBE_COUNT : (int)LOBE_NATIVE_SPLIT_MATERIALS) + 1,
	LOBE_NATIVE_SPLIT_ROOM = LOBE_NATIVE_SPLIT_MAX + LOBE_NATIVE_SPLIT_KEYS * LOBE_NATIVE_SPLIT_VECTOR
};

typedef struct {
	/* to[i] = table[index[i]] */
	void (*look_up)(uint32_t *to, const uint32_t *table, const uint32_t *index, size_t n);
	/* The place of each element when they are sorted by key[material[i]], below keys. Those of key k are at
	 * [begin[k], begin[k] + count[k]). */
	void (*sort)(uint32_t *place, uint32_t *begin, uint32_t *count, const uint32_t *key, uint32_t keys,
		     const uint32_t *material, size_t n);
	/* For each of so many arrays of 4-byte words: to[a][place[i]] = from[a][i]. */
	void (*part)(void *const *to, const void *const *from, int arrays, const uint32_t *place, size_t n);
	/* to[a][i] = from[a][place[i]] */
	void (*join)(void *const *to, const void *const *from, int arrays, const uint32_t *place, size_t n);
} lobe_native_split;

#endif
