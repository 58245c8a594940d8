/* split.h - the elements of a block that have a certain key, brought together and put back: data movement alone, so every
 * instruction set gives the same bits. split.c is compiled once for each, like the row loops. */
#ifndef LOBE_SPLIT_H
#define LOBE_SPLIT_H

#include <stddef.h>
#include <stdint.h>

/* Elements of a block, at most; words behind the last that compress writes and expand reads, to no effect. */
enum { LOBE_SPLIT_MAX = 2048, LOBE_SPLIT_SLACK = 16, LOBE_SPLIT_ROOM = LOBE_SPLIT_MAX + LOBE_SPLIT_SLACK };

/* Which elements of a block have the key: a list, or a bit for each, or both. */
typedef struct {
	uint32_t list[LOBE_SPLIT_ROOM];
	unsigned char bits[LOBE_SPLIT_MAX / 8];
} lobe_split_plan;

/* Words of 4 bytes, of whatever type. */
typedef struct {
	/* to[i] = table[index[i]] */
	void (*look_up)(uint32_t *to, const uint32_t *table, const uint32_t *index, size_t n);
	/* Finds the elements of key[0..n) that are k; how many. */
	size_t (*plan)(lobe_split_plan *plan, const uint32_t *key, uint32_t k, size_t n);
	/* For each of so many arrays: those elements of from[a][0..n), one after another. */
	void (*compress)(void *const *to, const void *const *from, int arrays, const lobe_split_plan *plan, size_t n,
			 size_t count);
	/* The reverse: others of to[a][0..n) stay as they are. */
	void (*expand)(void *const *to, const void *const *from, int arrays, const lobe_split_plan *plan, size_t n,
		       size_t count);
} lobe_split;

#endif
