/* beta.h - Euler's beta function where both arguments are at least 1. For comparison lobes: six logarithms' worth. */
#ifndef LOBE_CORE_BETA_H
#define LOBE_CORE_BETA_H

#include "real.h"
#include "vec.h"

/* ln Gamma(x) = (x - 1/2) ln x - x + ln(2 pi)/2 + this (Binet's function), x >= 1, off by at most 6e-9. A polynomial in
 * 1/x, times 1/x, through Chebyshev's nodes. */
LOBE_FN lobe_real lobe_binet(lobe_real x)
{
	const lobe_real y = LOBE_R(1.0) / x;
	lobe_real p = LOBE_R(0x1.2a41360p-13);
	p = lobe_fma(p, y, LOBE_R(-0x1.528458p-11));
	p = lobe_fma(p, y, LOBE_R(0x1.16cc80p-10));
	p = lobe_fma(p, y, LOBE_R(-0x1.fef2a8p-15));
	p = lobe_fma(p, y, LOBE_R(-0x1.6b28dep-9));
	p = lobe_fma(p, y, LOBE_R(-0x1.77864cp-22));
	p = lobe_fma(p, y, LOBE_R(0x1.555556p-4));
	return p * y;
}

/* ln(1 + x/y), 0 <= x <= y, as 2 artanh(x/(x + 2y)), whose argument is at most 1/3. */
LOBE_FN lobe_real lobe_log_one_plus_ratio(lobe_real x, lobe_real y)
{
	const lobe_real r = x / lobe_fma(LOBE_R(2.0), y, x);
	const lobe_real r2 = r * r;
	lobe_real p = LOBE_R(1.0) / LOBE_R(15.0);
	p = lobe_fma(p, r2, LOBE_R(1.0) / LOBE_R(13.0));
	p = lobe_fma(p, r2, LOBE_R(1.0) / LOBE_R(11.0));
	p = lobe_fma(p, r2, LOBE_R(1.0) / LOBE_R(9.0));
	p = lobe_fma(p, r2, LOBE_R(1.0) / LOBE_R(7.0));
	p = lobe_fma(p, r2, LOBE_R(1.0) / LOBE_R(5.0));
	p = lobe_fma(p, r2, LOBE_R(1.0) / LOBE_R(3.0));
	return (r + r) * lobe_fma(p, r2, LOBE_R(1.0));
}

/* B(a, b) = Gamma(a) Gamma(b)/Gamma(a + b), a and b in [1, 2^60]; 0 where it is below 1e-38. By Stirling's formula with
 * Binet's rest, in which the logarithm of the larger argument's share, near 0 and multiplied by that argument, is taken
 * without cancellation. Relative error 2.3e-7 (1 + |ln B|) (tests/test_beta.c, against GSL). */
LOBE_FN lobe_real lobe_beta(lobe_real a, lobe_real b)
{
	const lobe_real half_ln_2pi = LOBE_R(0.918938533204672741780);
	const lobe_real x = lobe_min(a, b), y = lobe_max(a, b);
	const lobe_real sum = x + y;
	const lobe_real rest = lobe_binet(x) + lobe_binet(y) - lobe_binet(sum) + half_ln_2pi;
	const lobe_real lesser = (x - LOBE_R(0.5)) * lobe_log(x / sum);
	const lobe_real large = (y - LOBE_R(0.5)) * lobe_log_one_plus_ratio(x, y);
	return lobe_exp(lesser - large - LOBE_R(0.5) * lobe_log(sum) + rest);
}

#endif
