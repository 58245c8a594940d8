/* linked.c - the loops of one lobe for all instruction sets: compiled once for each lobe, LOBE_ROW. An object of its
 * own, so that a linker takes a lobe's loops when lobe_linked lists them and not otherwise. */
#include "rows.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
#define ROWS(isa)    PASTE(lobe_rows_##isa##_, LOBE_ROW)

/* LOBE_INDEX_* by the lobe's name. */
enum {
#define LOBE_X(NAME, name, kind) lobe_index_##name = LOBE_INDEX_##NAME,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};

extern const lobe_rows ROWS(baseline);
#ifdef LOBE_X86
extern const lobe_rows ROWS(avx2), ROWS(avx512);
#endif

const struct lobe_linked PASTE(lobe_linked_, LOBE_ROW) = {PASTE(lobe_index_, LOBE_ROW),
							  {
#ifdef LOBE_X86
								  &ROWS(avx512), &ROWS(avx2),
#endif
								  &ROWS(baseline)}};
