/* film_cases.h - films on bases, and angles, that tests of core/airy.h, core/thin_film.h and the lobes with a film go
 * through. */
#ifndef LOBE_TESTS_FILM_CASES_H
#define LOBE_TESTS_FILM_CASES_H

#include "lobe/core/optics.h"
#include "lobe/core/thin_film.h"

#include <stdint.h>

#define U 0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */

static inline double channel(lobe_rgb c, int k) { return (double)(k == 0 ? c.r : k == 1 ? c.g : c.b); }

/* A film, an angle and a base: number i of many. Metals of optics.def, or k = 0. */
typedef struct {
	float c, d, film, n[3], k[3];
} stack;

stack make_stack(uint32_t i, int metal);

static inline lobe_film film_of(stack s) { return lobe_film_make(s.d, s.film); }
static inline lobe_rgb n_of(stack s) { return lobe_rgb_make(s.n[0], s.n[1], s.n[2]); }
static inline lobe_rgb k_of(stack s) { return lobe_rgb_make(s.k[0], s.k[1], s.k[2]); }

/* Reflectance of the base without a film, in one channel. */
double base_of(stack s, int m);

#endif
