/* random.c - see random.h.
 *
 * Philox of Random123 (Salmon et al. 2011) is the source of all randomness: a block cipher over a counter, so that any
 * number of the sequence can be had at once. On its own it makes independent samples, whose error falls with n^-1/2.
 * The samples of one pixel do better when they keep away from each other: Sobol's first two dimensions, of which any
 * 4^k samples fall one into each cell of a 2^k by 2^k grid. Philox then gives the keys of an Owen scrambling, which
 * makes every pixel's points random without losing that, and of a shuffling of their order, which keeps the uses and
 * rounds of one pixel independent of each other: Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4). */
#include "random.h"

#include <Random123/philox.h>

static philox4x32_ctr_t words(struct random_key key, uint32_t sample, uint32_t use)
{
	const philox4x32_ctr_t counter = {{key.pixel, sample, key.round, use}};
	const philox4x32_key_t k = {{key.seed, 0x6c6f6265u}};
	return philox4x32(counter, k);
}

static uint32_t reverse(uint32_t x)
{
	x = (x >> 16) | (x << 16);
	x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
	x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
	x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
	return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/* A random permutation in which a bit depends on the bits below it alone (Laine and Karras 2011): on the reversed
 * fraction that is Owen's scrambling, where a digit depends on the digits before it. */
static uint32_t scramble(uint32_t x, uint32_t key)
{
	x += key;
	x ^= x * 0x6c50b47cu;
	x ^= x * 0xb82f1e52u;
	x ^= x * 0xc7afe638u;
	return x ^ x * 0x8d22f6e6u;
}

/* Sobol's second dimension of index x, reversed. Its matrix is Pascal's triangle modulo 2: read as a polynomial over
 * two elements, p(t) becomes p(t + 1), one power of two of the exponent at a time. */
static uint32_t sobol1_reversed(uint32_t x)
{
	x ^= (x & 0xaaaaaaaau) >> 1;
	x ^= (x & 0xccccccccu) >> 2;
	x ^= (x & 0xf0f0f0f0u) >> 4;
	x ^= (x & 0xff00ff00u) >> 8;
	return x ^ (x & 0xffff0000u) >> 16;
}

static float unit(uint32_t x) { return (float)(x >> 8) * 0x1p-24f; }

void random_spread(struct random_key key, uint32_t use, float u[3])
{
	/* The keys belong to the pixel, not to the sample. */
	const philox4x32_ctr_t k = words(key, 0xffffffffu, use);
	const uint32_t sample = reverse(key.sample);
	const uint32_t index = reverse(scramble(sample, k.v[0]));
	const uint32_t other = reverse(scramble(sample, k.v[1]));
	/* The first dimension is the index reversed: reversed again for the scrambling, the index itself. */
	u[0] = unit(reverse(scramble(index, k.v[2])));
	u[1] = unit(reverse(scramble(sobol1_reversed(index), k.v[3])));
	u[2] = unit(reverse(scramble(other, k.v[0] ^ k.v[3])));
}

float random_plain(struct random_key key, uint32_t use) { return unit(words(key, key.sample, use).v[0]); }
