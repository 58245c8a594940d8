/* powers.h - logarithms and exponentials near 1 and 0, where log(1 + x) and exp(x) - 1 cancel.
 *
 * What rounding 1 + x or exp(x) took away is put back by a quotient (Kahan): both functions keep the relative accuracy
 * of lobe_log and lobe_exp. Measured by tests/test_distributions_forms.c: 2.4 ulp. */
#ifndef LOBE_CORE_POWERS_H
#define LOBE_CORE_POWERS_H

#include "real.h"

/* log(1 + x)/x, 1 at 0. Domain: -1 < x < inf. */
LOBE_FN lobe_real lobe_log1p_over(lobe_real x)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real u = one + x;
	const lobe_real rounded = u - one;
	return rounded == LOBE_R(0.0) ? one : lobe_log(u) / rounded;
}

/* log(1 + x). Domain: x > -1, infinity too. */
LOBE_FN lobe_real lobe_log1p(lobe_real x) { return x > LOBE_R(1e+9) ? lobe_log(x) : x * lobe_log1p_over(x); }

/* exp(x) - 1. Domain: every number. */
LOBE_FN lobe_real lobe_expm1(lobe_real x)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real u = lobe_exp(x);
	const lobe_real less = u - one;
	const lobe_real ratio = u == one ? x : less * (x / lobe_log(u));
	return lobe_abs(x) < one ? ratio : less;
}

/* (exp(x) - 1)/x, 1 at 0. */
LOBE_FN lobe_real lobe_expm1_over(lobe_real x) { return x == LOBE_R(0.0) ? LOBE_R(1.0) : lobe_expm1(x) / x; }

/* (1 + x)^-e for x >= 0 and any e, to a few roundings of itself however small it is: by lobe_pow, whose logarithm has
 * more digits than a float, of u = 1 + x rounded, times (1 + rest/u)^-e for what that took away. Measured by
 * tests/test_distributions_forms.c: 3 ulp for e to 1e5, 16 to 1.3e8. */
LOBE_FN lobe_real lobe_decay(lobe_real x, lobe_real e)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real u = one + x;
	const lobe_real rest = x > one ? one - (u - x) : x - (u - one);
	const lobe_real lost = x < LOBE_R(0x1p+60) ? rest / u : LOBE_R(0.0);
	return lobe_pow(u, -e) * lobe_exp(-e * lost);
}

/* The x of (1 + x)^-e = q: q^(-1/e) - 1, given inv_e = 1/e. q in (0, 1]. */
LOBE_FN lobe_real lobe_decay_inverse(lobe_real q, lobe_real inv_e) { return lobe_expm1(-inv_e * lobe_log(q)); }

#endif
