/* stability_dice.h - the numbers that the section's cases are drawn with, one after another from a counter of their
 * own. */
#ifndef LOBE_BENCH_STABILITY_DICE_H
#define LOBE_BENCH_STABILITY_DICE_H

#include <math.h>

#include "pi.h"
#include "support.h"

typedef struct {
	uint32_t stream;
	uint64_t at;
} dice;

static inline uint32_t dice_bits(dice *d) { return test_bits(d->stream, d->at++); }

/* [0, 1) */
static inline double dice_uniform(dice *d) { return (double)dice_bits(d) * 0x1p-32; }

/* 10^lo .. 10^hi, its logarithm uniform */
static inline double dice_decades(dice *d, double lo, double hi) { return pow(10.0, lo + (hi - lo) * dice_uniform(d)); }

/* [0, 2 pi) */
static inline double dice_angle(dice *d) { return 2.0 * PI * dice_uniform(d); }

#endif
