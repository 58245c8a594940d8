/* rows.h - what native.c knows of the loops that rows.c is compiled to. */
#ifndef LOBE_ROWS_H
#define LOBE_ROWS_H

#include "internal.h"

/* Shades n elements. table: the lobe's parameters; "one" uses table[0] for all, "many" table[slot[i]]. in, out: by
 * LOBE_IN_* and LOBE_OUT_*; every output that the verb writes is there. Arrays of float, but the
 * event of uint32_t. */
typedef void (*lobe_row)(const void *table, const uint32_t *slot, size_t n, const float *const *in, void *const *out);

typedef struct {
	struct {
		lobe_row one, many;
	} verb[LOBE_VERB_COUNT];
} lobe_rows;

/* Instruction sets, from the widest to the one that runs anywhere. */
enum {
#ifdef LOBE_X86
	LOBE_ISA_AVX512,
	LOBE_ISA_AVX2,
#endif
	LOBE_ISA_BASELINE,
	LOBE_ISA_COUNT
};

/* The loops of a lobe (linked.c), and those of the program, up to a NULL (native_list.c, or lobe/link.h in a
 * program). */
struct lobe_linked {
	int lobe; /* LOBE_INDEX_* */
	const lobe_rows *rows[LOBE_ISA_COUNT];
};
extern const struct lobe_linked *const lobe_linked[];

#endif
