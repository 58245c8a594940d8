/* split.c - bringing together the elements of one key (split.h), for one instruction set: compiled once for each, with
 *	LOBE_ROW_ISA  the instruction set, a suffix, e.g. avx2
 * and that instruction set's compiler options. Gathering and scattering word by word would cost more than most shading
 * does; processors that can permute a vector bring the elements together whole vectors at a time. */
#include <string.h>

#include "split.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

typedef uint32_t __attribute__((may_alias)) word;

static void look_up(uint32_t *restrict to, const uint32_t *restrict table, const uint32_t *restrict index, size_t n)
{
	for (size_t i = 0; i < n; i++)
		to[i] = table[index[i]];
}

#if defined(__AVX512F__)

#include <immintrin.h>

static __mmask16 mask_at(const lobe_split_plan *p, size_t i)
{
	unsigned short m;
	memcpy(&m, p->bits + i / 8, 2);
	return m;
}

/* Those of a vector of 16 at i that are before n. */
static __mmask16 before(size_t i, size_t n) { return n - i < 16 ? (__mmask16)((1u << (n - i)) - 1) : (__mmask16)0xffff; }

static size_t plan(lobe_split_plan *p, const uint32_t *key, uint32_t k, size_t n)
{
	const __m512i wanted = _mm512_set1_epi32((int)k);
	size_t count = 0;
	for (size_t i = 0; i < n; i += 16) {
		const __mmask16 there = before(i, n);
		const __mmask16 m = _mm512_mask_cmpeq_epi32_mask(there, _mm512_maskz_loadu_epi32(there, key + i), wanted);
		memcpy(p->bits + i / 8, &m, 2);
		count += (size_t)__builtin_popcount(m);
	}
	return count;
}

/* To a register first: Zen 4 takes a hundred cycles to pack into memory. */
static void compress(void *const *to, const void *const *from, int arrays, const lobe_split_plan *p, size_t n,
		     size_t count)
{
	size_t at = 0;
	(void)count;
	for (size_t i = 0; i < n; i += 16) {
		const __mmask16 m = mask_at(p, i), there = before(i, n);
		for (int a = 0; a < arrays; a++) {
			const __m512i v = _mm512_maskz_loadu_epi32(there, (const word *)from[a] + i);
			_mm512_storeu_si512((word *)to[a] + at, _mm512_maskz_compress_epi32(m, v));
		}
		at += (size_t)__builtin_popcount(m);
	}
}

static void expand(void *const *to, const void *const *from, int arrays, const lobe_split_plan *p, size_t n,
		   size_t count)
{
	size_t at = 0;
	(void)count;
	for (size_t i = 0; i < n; i += 16) {
		const __mmask16 m = mask_at(p, i);
		for (int a = 0; a < arrays; a++) {
			const __m512i v = _mm512_loadu_si512((const word *)from[a] + at);
			_mm512_mask_storeu_epi32((word *)to[a] + i, m, _mm512_maskz_expand_epi32(m, v));
		}
		at += (size_t)__builtin_popcount(m);
	}
}

#else

/* By list. */
static void expand(void *const *to, const void *const *from, int arrays, const lobe_split_plan *p, size_t n,
		   size_t count)
{
	int a = 0;
	(void)n;
	/* By twos: each pass over the list is a load for every element. */
	for (; a + 2 <= arrays; a += 2) {
		word *const t0 = to[a], *const t1 = to[a + 1];
		const word *const f0 = from[a], *const f1 = from[a + 1];
		for (size_t i = 0; i < count; i++) {
			const size_t e = p->list[i];
			t0[e] = f0[i];
			t1[e] = f1[i];
		}
	}
	for (; a < arrays; a++)
		for (size_t i = 0; i < count; i++)
			((word *)to[a])[p->list[i]] = ((const word *)from[a])[i];
}

#if defined(__AVX2__)

#include <immintrin.h>

/* For each set of lanes, which of them goes to lane 0, 1, ...: 4 bits each. */
#define HAS(m, k)    ((m) >> (k)&1u)
#define BELOW(m, k)                                                                                                    \
	(((k) > 0) * HAS(m, 0) + ((k) > 1) * HAS(m, 1) + ((k) > 2) * HAS(m, 2) + ((k) > 3) * HAS(m, 3) +               \
	 ((k) > 4) * HAS(m, 4) + ((k) > 5) * HAS(m, 5) + ((k) > 6) * HAS(m, 6))
#define LANE(m, k)   (HAS(m, k) * (k##u << 4 * BELOW(m, k)))
#define PACKED(m)    (LANE(m, 1) | LANE(m, 2) | LANE(m, 3) | LANE(m, 4) | LANE(m, 5) | LANE(m, 6) | LANE(m, 7))
#define PACKED_4(m)  PACKED(m), PACKED((m) + 1), PACKED((m) + 2), PACKED((m) + 3)
#define PACKED_16(m) PACKED_4(m), PACKED_4((m) + 4), PACKED_4((m) + 8), PACKED_4((m) + 12)
#define PACKED_64(m) PACKED_16(m), PACKED_16((m) + 16), PACKED_16((m) + 32), PACKED_16((m) + 48)
static const uint32_t packed[256] = {PACKED_64(0u), PACKED_64(64u), PACKED_64(128u), PACKED_64(192u)};

static __m256i load(const void *p) { return _mm256_loadu_si256((const __m256i *)p); }

/* Lanes of a vector that a set of them moves to its front. */
static __m256i front(unsigned set)
{
	const __m256i shift = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
	return _mm256_srlv_epi32(_mm256_set1_epi32((int)packed[set]), shift);
}

static size_t plan(lobe_split_plan *p, const uint32_t *key, uint32_t k, size_t n)
{
	const __m256i wanted = _mm256_set1_epi32((int)k), first = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
	size_t count = 0, i = 0;
	for (; i + 8 <= n; i += 8) {
		const __m256i same = _mm256_cmpeq_epi32(load(key + i), wanted);
		const unsigned m = (unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(same));
		const __m256i e = _mm256_add_epi32(_mm256_set1_epi32((int)i), first);
		p->bits[i / 8] = (unsigned char)m;
		_mm256_storeu_si256((__m256i *)(void *)(p->list + count), _mm256_permutevar8x32_epi32(e, front(m)));
		count += (size_t)__builtin_popcount(m);
	}
	for (; i < n; i++) {
		p->list[count] = (uint32_t)i;
		count += key[i] == k;
	}
	return count;
}

static void compress(void *const *to, const void *const *from, int arrays, const lobe_split_plan *p, size_t n,
		     size_t count)
{
	size_t at = 0;
	for (size_t i = 0; i + 8 <= n; i += 8) {
		const unsigned m = p->bits[i / 8];
		const __m256i lanes = front(m);
		for (int a = 0; a < arrays; a++)
			_mm256_storeu_si256((__m256i *)(void *)((word *)to[a] + at),
					    _mm256_permutevar8x32_epi32(load((const word *)from[a] + i), lanes));
		at += (size_t)__builtin_popcount(m);
	}
	for (; at < count; at++)
		for (int a = 0; a < arrays; a++)
			((word *)to[a])[at] = ((const word *)from[a])[p->list[at]];
}

#else

static size_t plan(lobe_split_plan *p, const uint32_t *key, uint32_t k, size_t n)
{
	size_t count = 0;
	for (size_t i = 0; i < n; i++) {
		p->list[count] = (uint32_t)i;
		count += key[i] == k;
	}
	return count;
}

static void compress(void *const *to, const void *const *from, int arrays, const lobe_split_plan *p, size_t n,
		     size_t count)
{
	(void)n;
	for (int a = 0; a < arrays; a++)
		for (size_t i = 0; i < count; i++)
			((word *)to[a])[i] = ((const word *)from[a])[p->list[i]];
}

#endif
#endif

const lobe_split PASTE(lobe_split_, LOBE_ROW_ISA) = {look_up, plan, compress, expand};
