/* root.h - square roots by products, for who has spent the divider.
 *
 * Processors have one unit for divisions and roots, and a lobe that needs ten of them waits for it while the multipliers
 * idle. These two have the same bits everywhere, like all of real.h. A start from the bits, good to 3.5 %, is raised to
 * 2.4e-5 by a polynomial of second degree in z = x y^2 (least maximum error over one period of the start), which a
 * step of Newton's method then squares.
 *
 * Domain: 0 and [2^-100, 2^100]; NaN gives NaN. What they give for any other number is some number or NaN. */
#ifndef LOBE_CORE_ROOT_H
#define LOBE_CORE_ROOT_H

#include "../backend/backend.h"

#if LOBE_DOUBLE

LOBE_FN lobe_real lobe_inv_root(lobe_real x) { return 1.0 / sqrt(x); }
LOBE_FN lobe_real lobe_root(lobe_real x) { return sqrt(x); }

#else

/* 1/sqrt(x) to 2.4e-5. */
LOBE_FN lobe_real lobe_inv_root_start(lobe_real x)
{
	const lobe_real y = lobe_from_bits(0x5f36e000u - (lobe_to_bits(x) >> 1));
	const lobe_real z = x * y * y;
	const lobe_real p = lobe_fma(LOBE_R(0x1.854b1cp-2), z, LOBE_R(-0x1.42ea3p+0));
	return y * lobe_fma(p, z, LOBE_R(0x1.e19714p+0));
}

/* 1/sqrt(x); some large number for x = 0. */
LOBE_FN lobe_real lobe_inv_root(lobe_real x)
{
	const lobe_real y = lobe_inv_root_start(x);
	const lobe_real rest = lobe_fma(-(x * y), y, LOBE_R(1.0));
	return lobe_fma(LOBE_R(0.5) * y, rest, y);
}

/* sqrt(x) */
LOBE_FN lobe_real lobe_root(lobe_real x)
{
	const lobe_real y = lobe_inv_root_start(x);
	const lobe_real s = x * y;
	return lobe_fma(lobe_fma(-s, s, x), LOBE_R(0.5) * y, s);
}

#endif
#endif
