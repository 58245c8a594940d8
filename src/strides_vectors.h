/* strides_vectors.h - packing and unpacking three words that lie side by side in a struct, as the components of a vector
 * mostly do, four elements at a time (SSE2): up to 1.2 times as fast as word by word. Included by strides.c. */
#ifndef LOBE_STRIDES_VECTORS_H
#define LOBE_STRIDES_VECTORS_H

#include "internal.h"

typedef lobe_word word;
#define WORD(array, stride, i) (*(word *)(void *)((unsigned char *)(array) + (stride) * (i)))

#ifdef LOBE_X86
#include <emmintrin.h>

static __m128i load(const void *from, size_t stride, size_t i)
{
	return _mm_loadu_si128((const __m128i *)(const void *)((const unsigned char *)from + stride * i));
}

/* How many of n are done. An element is read with the word behind it, so the last is left: there may be none. */
static size_t pack_vectors(word *restrict x, word *restrict y, word *restrict z, const word *restrict from,
			   size_t stride, size_t n)
{
	size_t i = 0;
	for (; i + 4 < n; i += 4) {
		const __m128i a = load(from, stride, i), b = load(from, stride, i + 1);
		const __m128i c = load(from, stride, i + 2), d = load(from, stride, i + 3);
		const __m128i ab = _mm_unpacklo_epi32(a, b), cd = _mm_unpacklo_epi32(c, d);
		const __m128i zz = _mm_unpacklo_epi64(_mm_unpackhi_epi32(a, b), _mm_unpackhi_epi32(c, d));
		_mm_storeu_si128((__m128i *)(void *)(x + i), _mm_unpacklo_epi64(ab, cd));
		_mm_storeu_si128((__m128i *)(void *)(y + i), _mm_unpackhi_epi64(ab, cd));
		_mm_storeu_si128((__m128i *)(void *)(z + i), zz);
	}
	return i;
}

/* Words are written in twos: of four, the fourth would be another's. */
static void store_2(word *to, size_t stride, size_t i, __m128i w)
{
	_mm_storel_epi64((__m128i *)(void *)&WORD(to, stride, i), w);
}

static size_t unpack_vectors(word *restrict to, const word *restrict x, const word *restrict y, const word *restrict z,
			     size_t stride, size_t n)
{
	size_t i = 0;
	for (; i + 4 <= n; i += 4) {
		const __m128i a = load(x, 4, i), b = load(y, 4, i);
		const __m128i low = _mm_unpacklo_epi32(a, b), high = _mm_unpackhi_epi32(a, b);
		store_2(to, stride, i, low);
		store_2(to, stride, i + 1, _mm_unpackhi_epi64(low, low));
		store_2(to, stride, i + 2, high);
		store_2(to, stride, i + 3, _mm_unpackhi_epi64(high, high));
		for (size_t k = i; k < i + 4; k++)
			WORD(to + 2, stride, k) = z[k];
	}
	return i;
}
#else
/* None are done. */
static size_t pack_vectors(word *x, word *y, word *z, const word *from, size_t stride, size_t n)
{
	(void)x, (void)y, (void)z, (void)from, (void)stride, (void)n;
	return 0;
}

static size_t unpack_vectors(word *to, const word *x, const word *y, const word *z, size_t stride, size_t n)
{
	(void)to, (void)x, (void)y, (void)z, (void)stride, (void)n;
	return 0;
}
#endif

#endif
