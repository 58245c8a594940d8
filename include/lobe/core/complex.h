/* complex.h - complex numbers, as far as interference needs them. */
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

LOBE_FN lobe_complex lobe_complex_scale(lobe_complex a, lobe_real s) { return lobe_complex_make(a.re * s, a.im * s); }

/* a*b + c */
LOBE_FN lobe_complex lobe_complex_fma(lobe_complex a, lobe_complex b, lobe_complex c)
{
	return lobe_complex_make(lobe_fma(a.re, b.re, lobe_fma(-a.im, b.im, c.re)),
				 lobe_fma(a.re, b.im, lobe_fma(a.im, b.re, c.im)));
}

LOBE_FN lobe_complex lobe_complex_mul(lobe_complex a, lobe_complex b)
{
	return lobe_complex_make(lobe_fma(a.re, b.re, -(a.im * b.im)), lobe_fma(a.re, b.im, a.im * b.re));
}

/* |a|^2 */
LOBE_FN lobe_real lobe_complex_norm(lobe_complex a) { return lobe_fma(a.re, a.re, a.im * a.im); }

#endif
