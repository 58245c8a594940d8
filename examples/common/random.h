/* random.h - the numbers of a path: a function of pixel, sample, round and use, and of nothing else, so that it does
 * not matter where or in which order they are asked for. */
#ifndef COMMON_RANDOM_H
#define COMMON_RANDOM_H

#include <stdint.h>

/* What a number is for: each use in each round has a sequence of its own. */
enum { RANDOM_CAMERA, RANDOM_LOBE, RANDOM_LIGHT, RANDOM_ROULETTE };

struct random_key {
	uint32_t seed, pixel, sample, round;
};

/* u[0..2], each in [0,1). Over the samples of a pixel (u[0], u[1]) are well spread over the square, and u[2] over the
 * line. */
void random_spread(struct random_key key, uint32_t use, float u[3]);

/* In [0,1), independent of all others. */
float random_plain(struct random_key key, uint32_t use);

#endif
