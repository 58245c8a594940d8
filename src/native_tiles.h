/* native_tiles.h - sorting, parting and joining by tiles of 64 elements, whose keys are one AVX-512 vector of bytes
 * (VBMI2: Ice Lake, Zen 4 and later). Included by native_split.c.
 *
 * The elements of one key in a tile are runs of up to 16. Parting picks a run out of the tile's four vectors by two
 * permutations and a blend and stores it whole behind the key's last: what is behind its end is overwritten by the
 * next. Joining loads the tile's runs, a vector each, and picks the tile's elements out of all of them. So a processor
 * moves sixteen words where, word by word, it is bound by one store a cycle. Tiles of 16 would not pay: their runs of
 * three or four take as many stores, which straddle cache lines. */
#ifndef LOBE_NATIVE_TILES_H
#define LOBE_NATIVE_TILES_H

#include <immintrin.h>

enum { TILE = LOBE_NATIVE_SPLIT_TILE, RUN = LOBE_NATIVE_SPLIT_VECTOR, RUNS = LOBE_NATIVE_SPLIT_RUNS };

/* For functions of a constant number of runs, which the switches below call: loops over runs, in registers. */
#define UNROLLED static inline __attribute__((always_inline))

/* --- runs -------------------------------------------------------------------------------------------------------- */

static __mmask16 first_16(size_t n) { return (__mmask16)(n < 16 ? (1u << n) - 1 : 0xffff); }
static __mmask64 first_64(size_t n) { return n < 64 ? ((__mmask64)1 << n) - 1 : ~(__mmask64)0; }

static void find_keys(lobe_native_tiles *t, const uint32_t *key, size_t materials, const uint32_t *material, size_t n)
{
	if (materials > 32) {
		for (size_t i = 0; i < n; i++)
			t->key[i] = (uint8_t)key[material[i]];
		return;
	}
	/* All keys are in two registers. */
	const __m512i low = _mm512_maskz_loadu_epi32(first_16(materials), key);
	const __m512i high = materials > 16 ? _mm512_maskz_loadu_epi32(first_16(materials - 16), key + 16) : low;
	for (size_t i = 0; i < n; i += 16) {
		const __m512i m = _mm512_maskz_loadu_epi32(first_16(n - i), material + i);
		_mm_store_si128((__m128i *)(void *)(t->key + i),
				_mm512_cvtepi32_epi8(_mm512_permutex2var_epi32(low, m, high)));
	}
}

/* The elements of tile i that have the key k. */
static __mmask64 of_key(const lobe_native_tiles *t, size_t i, uint32_t k, size_t n)
{
	return _mm512_mask_cmpeq_epi8_mask(first_64(n - i * TILE), _mm512_load_si512(t->key + i * TILE),
					   _mm512_set1_epi8((char)k));
}

static void sort_tiles(lobe_native_tiles *t, uint32_t *begin, uint32_t *count, const uint32_t *key, uint32_t keys,
		       size_t materials, const uint32_t *material, size_t n)
{
	static const uint8_t numbers[TILE] __attribute__((aligned(64))) = {
		0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
		22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43,
		44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63};
	const __m512i number = _mm512_load_si512(numbers);
	uint32_t next[LOBE_NATIVE_SPLIT_TILE_KEYS];
	find_keys(t, key, materials, material, n);
	for (uint32_t k = 0; k < keys; k++) {
		uint64_t found = 0;
		for (size_t i = 0; i * TILE < n; i++)
			found += (uint64_t)_mm_popcnt_u64(of_key(t, i, k, n));
		count[k] = (uint32_t)found;
	}
	const uint32_t behind = find_begins(begin, count, keys);
	memcpy(next, begin, keys * sizeof *next);
	for (size_t i = 0; i * TILE < n; i++) {
		__m512i place = _mm512_setzero_si512();
		uint32_t runs = 0;
		for (uint32_t k = 0; k < keys; k++) {
			/* Its up to four runs are written, however many it has: the next key's overwrite the rest. */
			const __mmask64 m = of_key(t, i, k, n);
			const uint32_t found = (uint32_t)_mm_popcnt_u64(m);
			const uint64_t at = next[k] * UINT64_C(0x0001000100010001) + UINT64_C(0x0030002000100000);
			const __m512i from_run = _mm512_set1_epi8((char)(runs * RUN));
			place = _mm512_mask_expand_epi8(place, m, _mm512_add_epi8(number, from_run));
			_mm512_storeu_si512(t->from[i][runs], _mm512_maskz_compress_epi8(m, number));
			memcpy(&t->at[i][runs], &at, sizeof at);
			next[k] += found;
			runs += (found + RUN - 1) / RUN;
		}
		/* An even number, or the switches would be foreseen less often. */
		t->at[i][runs] = (uint16_t)behind;
		runs += runs % 2;
		t->runs[i] = (uint8_t)runs;
		_mm512_store_si512(t->place + i * TILE, place);
	}
}

/* --- movement ---------------------------------------------------------------------------------------------------- */

UNROLLED void part_runs(int runs, void *const *to, const void *const *from, int arrays, const lobe_native_tiles *t,
			size_t i)
{
	__m512i lane[RUNS];
	__mmask16 high[RUNS];
	for (int r = 0; r < runs; r++) {
		lane[r] = _mm512_cvtepu8_epi32(_mm_load_si128((const __m128i *)(const void *)t->from[i][r]));
		high[r] = _mm512_test_epi32_mask(lane[r], _mm512_set1_epi32(32));
	}
	for (int a = 0; a < arrays; a++) {
		const word *const f = (const word *)from[a] + i * TILE;
		const __m512i f0 = _mm512_loadu_si512(f), f1 = _mm512_loadu_si512(f + 16);
		const __m512i f2 = _mm512_loadu_si512(f + 32), f3 = _mm512_loadu_si512(f + 48);
		for (int r = 0; r < runs; r++) {
			const __m512i w = _mm512_permutex2var_epi32(f0, lane[r], f1);
			_mm512_storeu_si512(
				(word *)to[a] + t->at[i][r],
				_mm512_mask_blend_epi32(high[r], w, _mm512_permutex2var_epi32(f2, lane[r], f3)));
		}
	}
}

/* Of the vectors picked[p], p < pairs, the one that the bits of mask, from its lowest on, number. */
UNROLLED __m512i choose(int pairs, __m512i *picked, const __mmask16 *bit)
{
	for (int b = 0; pairs > 1; b++) {
		for (int p = 0; 2 * p < pairs; p++)
			picked[p] = 2 * p + 1 < pairs
					    ? _mm512_mask_blend_epi32(bit[b], picked[2 * p], picked[2 * p + 1])
					    : picked[2 * p];
		pairs = (pairs + 1) / 2;
	}
	return picked[0];
}

UNROLLED void join_runs(int runs, void *const *to, const void *const *from, int arrays, const lobe_native_tiles *t,
			size_t i, int stream)
{
	enum { VECTORS = TILE / 16 };
	__m512i lane[VECTORS];
	__mmask16 bit[VECTORS][3];
	for (int v = 0; v < VECTORS; v++) {
		const uint8_t *const place = t->place + i * TILE + v * 16;
		lane[v] = _mm512_cvtepu8_epi32(_mm_load_si128((const __m128i *)(const void *)place));
		for (int b = 0; b < 3; b++)
			bit[v][b] = _mm512_test_epi32_mask(lane[v], _mm512_set1_epi32(2 * RUN << b));
	}
	for (int a = 0; a < arrays; a++) {
		word *const x = (word *)to[a] + i * TILE;
		const int around = stream && (uintptr_t)x % 64 == 0;
		__m512i f[RUNS];
		for (int r = 0; r < runs; r++)
			f[r] = _mm512_loadu_si512((const word *)from[a] + t->at[i][r]);
		for (int v = 0; v < VECTORS; v++) {
			__m512i picked[RUNS / 2];
			for (int p = 0; 2 * p < runs; p++)
				picked[p] = _mm512_permutex2var_epi32(f[2 * p], lane[v], f[2 * p + 1]);
			const __m512i w = choose(runs / 2, picked, bit[v]);
			if (around)
				_mm512_stream_si512((__m512i *)(void *)(x + v * 16), w);
			else
				_mm512_storeu_si512(x + v * 16, w);
		}
	}
}

/* Where element e is among the sorted. */
static size_t tile_place(const lobe_native_tiles *t, size_t e)
{
	return t->at[e / TILE][t->place[e] / RUN] + t->place[e] % RUN;
}

/* The cases of a switch over a whole tile's runs; words: the elements behind the last whole tile. */
#define FOR_RUNS(RUNS_CASE)                                                                                            \
	RUNS_CASE(2) RUNS_CASE(4) RUNS_CASE(6) RUNS_CASE(8) RUNS_CASE(10) RUNS_CASE(12) RUNS_CASE(14) RUNS_CASE(16)

UNROLLED void part_tiles(void *const *to, const void *const *from, int arrays, const lobe_native_tiles *t, size_t n)
{
	for (size_t i = 0; i < n / TILE; i++)
		switch (t->runs[i]) {
#define RUNS_CASE(runs)                                                                                                \
	case runs:                                                                                                     \
		part_runs(runs, to, from, arrays, t, i);                                                               \
		break;
			FOR_RUNS(RUNS_CASE)
#undef RUNS_CASE
		}
	for (size_t e = n / TILE * TILE; e < n; e++)
		for (int a = 0; a < arrays; a++)
			((word *)to[a])[tile_place(t, e)] = ((const word *)from[a])[e];
}

static void part_tiles_3(void *const *to, const void *const *from, const lobe_native_tiles *t, size_t n)
{
	part_tiles(to, from, 3, t, n);
}

static void part_tiles_1(void *const *to, const void *const *from, const lobe_native_tiles *t, size_t n)
{
	part_tiles(to, from, 1, t, n);
}

static void join_tiles(void *const *to, const void *const *from, int arrays, const lobe_native_tiles *t, size_t first,
		       size_t end, int stream)
{
	for (size_t i = first / TILE; i < end / TILE; i++)
		switch (t->runs[i]) {
#define RUNS_CASE(runs)                                                                                                \
	case runs:                                                                                                     \
		join_runs(runs, to, from, arrays, t, i, stream);                                                       \
		break;
			FOR_RUNS(RUNS_CASE)
#undef RUNS_CASE
		}
	for (size_t e = end / TILE * TILE; e < end; e++)
		for (int a = 0; a < arrays; a++)
			((word *)to[a])[e] = ((const word *)from[a])[tile_place(t, e)];
}

#endif
