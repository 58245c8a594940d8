/* native_split.h - the elements of a block brought together by key, and put back: data movement alone, so every
 * instruction set gives the same bits. native_split.c is compiled once for each, like the row loops. */
#ifndef LOBE_NATIVE_SPLIT_H
#define LOBE_NATIVE_SPLIT_H

#include "internal.h"

enum {
	/* Elements of a block: the fewer, the more of them stay in the first-level cache, and the more, the less it counts
	 * what a loop does before its first element. So many for each material, from the least to the most, which is
	 * also what those have that are split by lobe. */
	LOBE_NATIVE_SPLIT_EACH = 96,
	LOBE_NATIVE_SPLIT_MIN = 512,
	LOBE_NATIVE_SPLIT_MAX = 2048,
	LOBE_NATIVE_SPLIT_VECTOR = 16, /* each key's elements begin at a multiple of this */
	/* Scenes of no more materials are split by material, so that their parameters are constants of the loops;
	 * others by lobe. */
	LOBE_NATIVE_SPLIT_MATERIALS = 32,
	LOBE_NATIVE_SPLIT_KEYS =
		(LOBE_COUNT > LOBE_NATIVE_SPLIT_MATERIALS ? (int)LOBE_COUNT : (int)LOBE_NATIVE_SPLIT_MATERIALS) + 1,
	/* Vectors are moved whole: behind each key's elements, and behind all, is room for one more. */
	LOBE_NATIVE_SPLIT_ROOM = LOBE_NATIVE_SPLIT_MAX + (2 * LOBE_NATIVE_SPLIT_KEYS + 1) * LOBE_NATIVE_SPLIT_VECTOR,
	/* Elements of a tile (native_tiles.h); its most runs, whose places fit into a byte; and the keys up to which it
	 * has no more, since each run but the last of a key is full. */
	LOBE_NATIVE_SPLIT_TILE = 64,
	LOBE_NATIVE_SPLIT_RUNS = 16,
	LOBE_NATIVE_SPLIT_TILE_KEYS = LOBE_NATIVE_SPLIT_RUNS - LOBE_NATIVE_SPLIT_TILE / LOBE_NATIVE_SPLIT_VECTOR + 1,
	LOBE_NATIVE_SPLIT_TILES = LOBE_NATIVE_SPLIT_MAX / LOBE_NATIVE_SPLIT_TILE
};

/* A whole cache line, which vectors are loaded from and stored to. */
#define LOBE_NATIVE_ALIGNED __attribute__((aligned(64)))

/* Runs of a tile: up to 16 elements of one key, in order. */
typedef struct {
	uint8_t key[LOBE_NATIVE_SPLIT_MAX] LOBE_NATIVE_ALIGNED;   /* of each element */
	uint8_t place[LOBE_NATIVE_SPLIT_MAX] LOBE_NATIVE_ALIGNED; /* 16 times its run, plus its place there */
	/* The elements of each run, as places in the tile; room to store four runs at the last. */
	uint8_t from[LOBE_NATIVE_SPLIT_TILES][LOBE_NATIVE_SPLIT_RUNS + 4][LOBE_NATIVE_SPLIT_VECTOR] LOBE_NATIVE_ALIGNED;
	uint16_t at[LOBE_NATIVE_SPLIT_TILES][LOBE_NATIVE_SPLIT_RUNS + 4]; /* where it begins among the sorted */
	uint8_t runs[LOBE_NATIVE_SPLIT_TILES];
} lobe_native_tiles;

/* Where the elements of a block are when they are sorted: by tiles, or each one's place. */
typedef struct {
	int by_tiles;
	lobe_native_tiles tiles;
	uint32_t place[LOBE_NATIVE_SPLIT_MAX];
} lobe_native_places;

/* Every array of sorted elements has LOBE_NATIVE_SPLIT_ROOM words, which may all be read and written. */
typedef struct {
	/* to[i] = table[index[i]] */
	void (*look_up)(uint32_t *to, const uint32_t *table, const uint32_t *index, size_t n);
	/* The place of each element when they are sorted by key[material[i]], below keys; material[i] is below
	 * materials. Those of key k are at [begin[k], begin[k] + count[k]). */
	void (*sort)(lobe_native_places *places, uint32_t *begin, uint32_t *count, const uint32_t *key, uint32_t keys,
		     size_t materials, const uint32_t *material, size_t n);
	/* For each of so many arrays of 4-byte words: to[a][place of i] = from[a][i]. */
	void (*part)(void *const *to, const void *const *from, int arrays, const lobe_native_places *places, size_t n);
	/* to[a][i] = from[a][place of i], for i in [first, end); first is a multiple of LOBE_NATIVE_SPLIT_TILE. stream:
	 * past the caches, where to[a] is aligned to their lines; settle() before another thread is told. */
	void (*join)(void *const *to, const void *const *from, int arrays, const lobe_native_places *places,
		     size_t first, size_t end, int stream);
	void (*settle)(void);
} lobe_native_split;

#endif
