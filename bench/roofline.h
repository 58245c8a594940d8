/* roofline.h - how near a loop comes to what the processor allows: the operations in the loop's machine code, and the
 * bytes that it moves, against measured ceilings of both. */
#ifndef LOBE_BENCH_ROOFLINE_H
#define LOBE_BENCH_ROOFLINE_H

#include <stddef.h>

/* Prints the table of one thread, lobe (-1: all) by verb, and writes it to path. objects: the folder of the library's
 * objects, which objdump reads; without either the operations are left out with a word. 0 after a failure. */
int bench_roofline(int lobe, size_t n, size_t runs, const char *objects, const char *path);

#endif
