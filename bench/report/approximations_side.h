/* approximations_side.h - loops that are timed twice: as the compiler vectorises them, and one element by one. */
#ifndef LOBE_BENCH_APPROXIMATIONS_SIDE_H
#define LOBE_BENCH_APPROXIMATIONS_SIDE_H

/* What keeps a loop from being vectorised: something happens in each round that nobody may reorder. */
#ifdef __GNUC__
#define ONE_BY_ONE __asm__ volatile("")
#else
#define ONE_BY_ONE
#endif
#define SIDE_BY_SIDE

#endif
