/* native_split.c - sorting the elements of a block by key (native_split.h), for one instruction set: compiled once for
 * each, with
 *	LOBE_ROW_ISA  the instruction set, a suffix, e.g. avx2
 * and that instruction set's compiler options. With VBMI2 few keys are sorted by tiles (native_tiles.h); this is the
 * form for all others, and for many keys.
 *
 * Both ways the caller's arrays are walked through in order, which the processor foresees, and what is at random stays
 * in the cache. Three arrays share a pass, and a load of the place. That is bound by a store a cycle. */
#include "native_split.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

typedef lobe_word word;

static void look_up(uint32_t *restrict to, const uint32_t *restrict table, const uint32_t *restrict index, size_t n)
{
	for (size_t i = 0; i < n; i++)
		to[i] = table[index[i]];
}

/* --- places ------------------------------------------------------------------------------------------------------ */

/* Where each key's elements begin, with room for a vector more behind each; where all end. */
static uint32_t find_begins(uint32_t *restrict begin, const uint32_t *restrict count, uint32_t keys)
{
	uint32_t at = 0;
	for (uint32_t k = 0; k < keys; k++) {
		begin[k] = at;
		at += (count[k] + 2 * LOBE_NATIVE_SPLIT_VECTOR - 1) / LOBE_NATIVE_SPLIT_VECTOR *
		      LOBE_NATIVE_SPLIT_VECTOR;
	}
	return at;
}

static void sort_counting(uint32_t *restrict place, uint32_t *restrict begin, uint32_t *restrict count,
			  const uint32_t *restrict key, uint32_t keys, const uint32_t *restrict material, size_t n)
{
	uint32_t next[LOBE_NATIVE_SPLIT_KEYS];
	memset(count, 0, keys * sizeof *count);
	for (size_t i = 0; i < n; i++)
		count[key[material[i]]]++;
	find_begins(begin, count, keys);
	memcpy(next, begin, keys * sizeof *next);
	for (size_t i = 0; i < n; i++)
		place[i] = next[key[material[i]]]++;
}

#if defined(__AVX512VBMI2__)
#include "native_tiles.h"
#elif defined(__AVX512F__)

#include <immintrin.h>

/* With few keys: a vector of elements at a time, key by key, instead of a chain of counters in memory. */
enum { FEW_KEYS = 10 };

static void sort_vectors(uint32_t *restrict place, uint32_t *restrict begin, uint32_t *restrict count,
			 const uint32_t *restrict key, uint32_t keys, const uint32_t *restrict material, size_t n)
{
	const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
	__m512i vector[LOBE_NATIVE_SPLIT_MAX / 16];
	uint32_t next[LOBE_NATIVE_SPLIT_KEYS];
	look_up(place, key, material, n);
	memset(count, 0, keys * sizeof *count);
	for (size_t i = 0; i < n; i += 16) {
		const __mmask16 there = (__mmask16)(n - i < 16 ? (1u << (n - i)) - 1 : 0xffff);
		const __m512i v = _mm512_mask_loadu_epi32(_mm512_set1_epi32(-1), there, place + i);
		vector[i / 16] = v;
		for (uint32_t k = 0; k < keys; k++)
			count[k] += (uint32_t)__builtin_popcount(_mm512_cmpeq_epi32_mask(v, _mm512_set1_epi32((int)k)));
	}
	find_begins(begin, count, keys);
	memcpy(next, begin, keys * sizeof *next);
	for (size_t i = 0; i < n; i += 16) {
		const __m512i v = vector[i / 16];
		__m512i places = v;
		for (uint32_t k = 0; k < keys; k++) {
			const __mmask16 m = _mm512_cmpeq_epi32_mask(v, _mm512_set1_epi32((int)k));
			const __m512i from = _mm512_add_epi32(lane, _mm512_set1_epi32((int)next[k]));
			places = _mm512_mask_expand_epi32(places, m, from);
			next[k] += (uint32_t)__builtin_popcount(m);
		}
		_mm512_mask_storeu_epi32(place + i, (__mmask16)(n - i < 16 ? (1u << (n - i)) - 1 : 0xffff), places);
	}
}

#endif

static void sort(lobe_native_places *places, uint32_t *begin, uint32_t *count, const uint32_t *key, uint32_t keys,
		 size_t materials, const uint32_t *material, size_t n)
{
	places->by_tiles = 0;
#if defined(__AVX512VBMI2__)
	places->by_tiles = keys <= LOBE_NATIVE_SPLIT_TILE_KEYS;
	if (places->by_tiles) {
		sort_tiles(&places->tiles, begin, count, key, keys, materials, material, n);
		return;
	}
#elif defined(__AVX512F__)
	if (keys <= FEW_KEYS) {
		sort_vectors(places->place, begin, count, key, keys, material, n);
		return;
	}
#endif
	(void)materials;
	sort_counting(places->place, begin, count, key, keys, material, n);
}

/* --- movement ---------------------------------------------------------------------------------------------------- */

static void part_3(word *restrict x, word *restrict y, word *restrict z, const word *restrict fx,
		   const word *restrict fy, const word *restrict fz, const uint32_t *restrict place, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		const size_t to = place[i];
		x[to] = fx[i];
		y[to] = fy[i];
		z[to] = fz[i];
	}
}

static void part_1(word *restrict x, const word *restrict fx, const uint32_t *restrict place, size_t n)
{
	for (size_t i = 0; i < n; i++)
		x[place[i]] = fx[i];
}

static void join_3(word *restrict x, word *restrict y, word *restrict z, const word *restrict fx,
		   const word *restrict fy, const word *restrict fz, const uint32_t *restrict place, size_t first,
		   size_t end)
{
	for (size_t i = first; i < end; i++) {
		const size_t from = place[i];
		x[i] = fx[from];
		y[i] = fy[from];
		z[i] = fz[from];
	}
}

static void join_1(word *restrict x, const word *restrict fx, const uint32_t *restrict place, size_t first, size_t end)
{
	for (size_t i = first; i < end; i++)
		x[i] = fx[place[i]];
}

static void part(void *const *to, const void *const *from, int arrays, const lobe_native_places *places, size_t n)
{
	const uint32_t *const place = places->place;
	int a = 0;
#ifdef __AVX512VBMI2__
	for (; places->by_tiles && a + 3 <= arrays; a += 3)
		part_tiles_3(to + a, from + a, &places->tiles, n);
	for (; places->by_tiles && a < arrays; a++)
		part_tiles_1(to + a, from + a, &places->tiles, n);
#endif
	for (; a + 3 <= arrays; a += 3)
		part_3(to[a], to[a + 1], to[a + 2], from[a], from[a + 1], from[a + 2], place, n);
	for (; a < arrays; a++)
		part_1(to[a], from[a], place, n);
}

static void join(void *const *to, const void *const *from, int arrays, const lobe_native_places *places, size_t first,
		 size_t end, int stream)
{
	const uint32_t *const place = places->place;
	int a = 0;
#ifdef __AVX512VBMI2__
	if (places->by_tiles) {
		join_tiles(to, from, arrays, &places->tiles, first, end, stream);
		return;
	}
#endif
	(void)stream;
	for (; a + 3 <= arrays; a += 3)
		join_3(to[a], to[a + 1], to[a + 2], from[a], from[a + 1], from[a + 2], place, first, end);
	for (; a < arrays; a++)
		join_1(to[a], from[a], place, first, end);
}

static void settle(void)
{
#ifdef __AVX512VBMI2__
	_mm_sfence();
#endif
}

const lobe_native_split PASTE(lobe_native_split_, LOBE_ROW_ISA) = {look_up, sort, part, join, settle};
