/* complex.h - complex numbers, as far as interference needs them.
 *
 * Products and sums are rounded one by one. Nothing here needs lobe_fma's single rounding, and where a processor has no
 * such instruction each costs twenty others: a thin film takes some hundreds. */
#ifndef LOBE_CORE_COMPLEX_H
#define LOBE_CORE_COMPLEX_H

#include "../backend/backend.h"

typedef struct {
	lobe_real re, im;
} lobe_complex;

LOBE_FN lobe_complex lobe_complex_make(lobe_real re, lobe_real im)
{
	lobe_complex z;
	z.re = re;
	z.im = im;
	return z;
}

LOBE_FN lobe_complex lobe_complex_add(lobe_complex a, lobe_complex b)
{
	return lobe_complex_make(a.re + b.re, a.im + b.im);
}

LOBE_FN lobe_complex lobe_complex_scale(lobe_complex a, lobe_real s) { return lobe_complex_make(a.re * s, a.im * s); }

LOBE_FN lobe_complex lobe_complex_mul(lobe_complex a, lobe_complex b)
{
	return lobe_complex_make(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

/* |a|^2 */
LOBE_FN lobe_real lobe_complex_norm(lobe_complex a) { return a.re * a.re + a.im * a.im; }

#endif
