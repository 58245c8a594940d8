/* explog.h - exponentials, logarithms and powers; a part of real.h, to be included by that alone. */
#ifndef LOBE_CORE_EXPLOG_H
#define LOBE_CORE_EXPLOG_H

/* Adding this rounds |x| < 2^21 to a whole number k, and leaves k + 256 in the last ten bits of the sum. */
#define LOBE_EXP_SHIFT LOBE_R(0x1.8002p+23)

/* p*2^k for the k in the last bits of x + LOBE_EXP_SHIFT, -250 < k < 250. The power is applied in two halves, of which
 * the first never leaves the normal numbers: a subnormal result is rounded once. */
LOBE_FN lobe_real lobe_scale_exp(lobe_real p, lobe_real shifted)
{
	const lobe_uint k = lobe_to_bits(shifted) & 0x3ffu;
	const lobe_uint first = k >> 1;
	return p * lobe_from_bits((first - 1u) << 23) * lobe_from_bits((k - first - 1u) << 23);
}

/* 2^r for |r| <= 1/2. */
LOBE_FN lobe_real lobe_exp2_fraction(lobe_real r)
{
	lobe_real p = LOBE_R(0x1.3fa208p-13);
	p = lobe_fma(p, r, LOBE_R(0x1.5f0b82p-10));
	p = lobe_fma(p, r, LOBE_R(0x1.3b30ap-7));
	p = lobe_fma(p, r, LOBE_R(0x1.c6af76p-5));
	p = lobe_fma(p, r, LOBE_R(0x1.ebfbd8p-3));
	p = lobe_fma(p, r, LOBE_R(0x1.62e43p-1));
	return lobe_fma(p, r, LOBE_R(1.0));
}

/* 2^x. Domain: every float; exp2(-inf) = 0. Above the largest float it is inf, and subnormal results are rounded right.
 * Measured: 0.88 ulp at x = -126.496498. */
LOBE_FN lobe_real lobe_exp2(lobe_real x)
{
	const lobe_real lo = LOBE_R(-151.0);
	const lobe_real hi = LOBE_R(129.0);
	const lobe_real v = x < lo ? lo : (x > hi ? hi : x);
	const lobe_real shifted = v + LOBE_EXP_SHIFT;
	const lobe_real r = v - (shifted - LOBE_EXP_SHIFT);
	return lobe_nan_or(x, lobe_scale_exp(lobe_exp2_fraction(r), shifted));
}

/* e^r for |r| <= ln(2)/2. */
LOBE_FN lobe_real lobe_exp_fraction(lobe_real r)
{
	lobe_real p = LOBE_R(0x1.694c86p-10);
	p = lobe_fma(p, r, LOBE_R(0x1.12397cp-7));
	p = lobe_fma(p, r, LOBE_R(0x1.555a26p-5));
	p = lobe_fma(p, r, LOBE_R(0x1.555492p-3));
	p = lobe_fma(p, r, LOBE_R(0x1.fffffap-2));
	p = lobe_fma(p, r, LOBE_R(1.0));
	return lobe_fma(p, r, LOBE_R(1.0));
}

/* e^x. Domain: every float; exp(-inf) = 0. Above the largest float it is inf, and subnormal results are rounded right.
 * x = k ln 2 + r with ln 2 in two floats. Measured: 0.90 ulp at x = -5.84864187. */
LOBE_FN lobe_real lobe_exp(lobe_real x)
{
	const lobe_real lo = LOBE_R(-104.0);
	const lobe_real hi = LOBE_R(89.0);
	const lobe_real v = x < lo ? lo : (x > hi ? hi : x);
	const lobe_real shifted = lobe_fma(v, LOBE_R(0x1.715476p+0), LOBE_EXP_SHIFT);
	const lobe_real k = shifted - LOBE_EXP_SHIFT;
	const lobe_real r = lobe_fma(k, LOBE_R(0x1.05c61p-29), lobe_fma(k, LOBE_R(-0x1.62e43p-1), v));
	return lobe_nan_or(x, lobe_scale_exp(lobe_exp_fraction(r), shifted));
}

/* e^x for |x| <= 87 without what any other x needs; the same bits. */
LOBE_FN lobe_real lobe_exp_normal(lobe_real x)
{
	const lobe_real whole = LOBE_R(0x1.8p+23); /* leaves k in the last bits */
	const lobe_real shifted = lobe_fma(x, LOBE_R(0x1.715476p+0), whole);
	const lobe_real k = shifted - whole;
	const lobe_real r = lobe_fma(k, LOBE_R(0x1.05c61p-29), lobe_fma(k, LOBE_R(-0x1.62e43p-1), x));
	return lobe_from_bits(lobe_to_bits(lobe_exp_fraction(r)) + (lobe_to_bits(shifted) << 23));
}

/* e^x for x <= 0, and 0 for x < -87: never a subnormal number. One of those among the elements of a vector, as operand
 * or result, takes some processors as long as a hundred operations. x is no NaN, or the result does not count. */
LOBE_FN lobe_real lobe_exp_or_zero(lobe_real x)
{
	const lobe_real lo = LOBE_R(-87.0);
	const lobe_real e = lobe_exp_normal(x < lo ? lo : x);
	return x < lo ? LOBE_R(0.0) : e;
}

/* x = 2^exponent * (1 + fraction) with 1 + fraction in [sqrt(1/2), sqrt(2)), for 0 < x < inf. */
typedef struct {
	lobe_real exponent, fraction;
} lobe_binary;

/* bits of a normal number and the exponent's bias. Adding the bits of 1 - those of sqrt(1/2) carries into the exponent
 * where the mantissa is sqrt(2) or more. */
LOBE_FN lobe_binary lobe_bits_to_binary(lobe_uint bits_in, lobe_int bias)
{
	const lobe_uint bits = bits_in + 0x4afb0du;
	lobe_binary b;
	b.exponent = (lobe_real)((lobe_int)(bits >> 23) - bias);
	b.fraction = lobe_from_bits((bits & 0x7fffffu) + 0x3f3504f3u) - LOBE_R(1.0);
	return b;
}

LOBE_FN lobe_binary lobe_normal_to_binary(lobe_real x) { return lobe_bits_to_binary(lobe_to_bits(x), 127); }

LOBE_FN lobe_binary lobe_to_binary(lobe_real x)
{
	const lobe_uint subnormal = x < LOBE_R(0x1p-126);
	return lobe_bits_to_binary(lobe_to_bits(subnormal ? x * LOBE_R(0x1p+23) : x), subnormal ? 150 : 127);
}

/* v, the logarithm of x > 0, or what belongs to any other x. */
LOBE_FN lobe_real lobe_log_domain(lobe_real x, lobe_real v)
{
	const lobe_real other = x == LOBE_R(0.0) ? -lobe_real_inf() : lobe_real_nan();
	return x > LOBE_R(0.0) ? (x <= LOBE_REAL_MAX ? v : x) : other;
}

/* Its natural logarithm. */
LOBE_FN lobe_real lobe_log_binary(lobe_binary b)
{
	const lobe_real f = b.fraction;
	lobe_real p = LOBE_R(-0x1.2a6f78p-4);
	p = lobe_fma(p, f, LOBE_R(0x1.015974p-3));
	p = lobe_fma(p, f, LOBE_R(-0x1.0e96ccp-3));
	p = lobe_fma(p, f, LOBE_R(0x1.239ce2p-3));
	p = lobe_fma(p, f, LOBE_R(-0x1.5466fep-3));
	p = lobe_fma(p, f, LOBE_R(0x1.99944ep-3));
	p = lobe_fma(p, f, LOBE_R(-0x1.000234p-2));
	p = lobe_fma(p, f, LOBE_R(0x1.55557p-2));
	p = lobe_fma(p, f, LOBE_R(-0.5));
	const lobe_real rest = lobe_fma(f * f, p, b.exponent * LOBE_R(-0x1.05c61p-29));
	return lobe_fma(b.exponent, LOBE_R(0x1.62e43p-1), f + rest);
}

/* Natural logarithm. Domain: x >= 0, subnormal numbers too; log(+-0) = -inf, log(inf) = inf, NaN below 0.
 * Measured: 0.86 ulp at x = 1.2758323. */
LOBE_FN lobe_real lobe_log(lobe_real x) { return lobe_log_domain(x, lobe_log_binary(lobe_to_binary(x))); }

/* The same for a normal number. */
LOBE_FN lobe_real lobe_log_normal(lobe_real x) { return lobe_log_binary(lobe_normal_to_binary(x)); }

/* The same to 1.5e-5, and near 1 to 1.1e-4 of itself: for a start. */
LOBE_FN lobe_real lobe_log_rough(lobe_real x)
{
	const lobe_binary b = lobe_normal_to_binary(x);
	const lobe_real f = b.fraction;
	lobe_real p = LOBE_R(0x1.66ab7ep-3);
	p = lobe_fma(p, f, LOBE_R(-0x1.18109cp-2));
	p = lobe_fma(p, f, LOBE_R(0x1.597114p-2));
	p = lobe_fma(p, f, LOBE_R(-0x1.ff370ep-2));
	p = lobe_fma(p, f, LOBE_R(0x1.fff55ep-1));
	return lobe_fma(b.exponent, LOBE_R(0x1.62e43p-1), f * p);
}

/* Logarithm to base 2. Domain: x >= 0, subnormal numbers too; log2(+-0) = -inf, log2(inf) = inf, NaN below 0. Exact at
 * powers of two. Measured: 1.60 ulp at x = 0.705300152. */
LOBE_FN lobe_real lobe_log2(lobe_real x)
{
	const lobe_binary b = lobe_to_binary(x);
	const lobe_real f = b.fraction;
	lobe_real p = LOBE_R(-0x1.c367c8p-4);
	p = lobe_fma(p, f, LOBE_R(0x1.7e0e4cp-3));
	p = lobe_fma(p, f, LOBE_R(-0x1.877adep-3));
	p = lobe_fma(p, f, LOBE_R(0x1.a2e68p-3));
	p = lobe_fma(p, f, LOBE_R(-0x1.eab182p-3));
	p = lobe_fma(p, f, LOBE_R(0x1.277ef4p-2));
	p = lobe_fma(p, f, LOBE_R(-0x1.715ac8p-2));
	p = lobe_fma(p, f, LOBE_R(0x1.ec7094p-2));
	p = lobe_fma(p, f, LOBE_R(-0x1.71547p-1));
	p = lobe_fma(p, f, LOBE_R(0x1.4aeae6p-26));
	return lobe_log_domain(x, lobe_fma(f, LOBE_R(0x1.715476p+0), lobe_fma(f, p, b.exponent)));
}

/* x^y. Domain: x >= 0 and every y. x^0 = 1 for every x, 1^y = 1 for every y, 0^y is 0 for y > 0 and inf for y < 0,
 * +-inf as in C99; -0 counts as 0. x < 0 gives NaN, also where y is whole (unless y is 0). Measured: 0.92 ulp at
 * (0x1.9c9aa6p-3, 0x1.b5cab6p+5), of 3e7 random pairs.
 *
 * 2^(y log2 x) needs log2 x to 35 bits. It is an odd series in s = fraction/(2 + fraction); s, the first two terms and
 * their sum with the exponent are sums of two floats. */
LOBE_FN lobe_real lobe_pow(lobe_real x, lobe_real y)
{
	const lobe_binary b = lobe_to_binary(x);
	const lobe_real f = b.fraction;
	const lobe_real den = LOBE_R(2.0) + f;
	const lobe_real den_rest = f - (den - LOBE_R(2.0));
	const lobe_real inverse = LOBE_R(1.0) / den;
	const lobe_real s = f * inverse;
	const lobe_real s_rest = inverse * lobe_fma(-s, den_rest, lobe_fma(-s, den, f));
	const lobe_real square = s * s;
	const lobe_real square_rest = lobe_fma(s + s, s_rest, lobe_fma(s, s, -square));

	/* first: s*c1. second: s*square*(c3 + c5 square + ...). */
	const lobe_real c1 = LOBE_R(0x1.715476p+1);
	const lobe_real c3 = LOBE_R(0x1.ec709ep-1);
	const lobe_real first = s * c1;
	const lobe_real first_rest = lobe_fma(s, LOBE_R(0x1.4ae0cp-25), lobe_fma(s_rest, c1, lobe_fma(s, c1, -first)));
	lobe_real p = LOBE_R(0x1.5c672ap-2);
	p = lobe_fma(p, square, LOBE_R(0x1.a5960ep-2));
	p = lobe_fma(p, square, LOBE_R(0x1.277768p-1));
	p = lobe_fma(p, square, LOBE_R(-0x1.77bd1p-26));
	const lobe_real q = square * c3;
	const lobe_real q_rest = lobe_fma(square, p, lobe_fma(square_rest, c3, lobe_fma(square, c3, -q)));
	const lobe_real second = s * q;
	const lobe_real second_rest = lobe_fma(s, q_rest, lobe_fma(s_rest, q, lobe_fma(s, q, -second)));

	const lobe_real sum1 = b.exponent + first;
	const lobe_real sum2 = sum1 + second;
	const lobe_real rest1 = first - (sum1 - b.exponent);
	const lobe_real rest2 = second - (sum2 - sum1);
	const lobe_real rest = (rest1 + rest2) + (first_rest + second_rest);
	const lobe_real log_hi = sum2 + rest;
	const lobe_real log_lo = rest - (log_hi - sum2);

	const lobe_real hi = y * log_hi;
	const lobe_real lo = lobe_fma(y, log_lo, lobe_fma(y, log_hi, -hi));
	const lobe_uint in_range = lobe_abs(hi) < LOBE_R(160.0);
	const lobe_real v = in_range ? hi : (hi < LOBE_R(0.0) ? LOBE_R(-160.0) : LOBE_R(160.0));
	const lobe_real shifted = v + LOBE_EXP_SHIFT;
	const lobe_real r = (v - (shifted - LOBE_EXP_SHIFT)) + (in_range ? lo : LOBE_R(0.0));
	const lobe_real finite = lobe_scale_exp(lobe_exp2_fraction(r), shifted);

	/* What the logarithm of 0 and infinity would have done. */
	const lobe_real zero_or_inf = (x < LOBE_R(1.0)) == (y < LOBE_R(0.0)) ? lobe_real_inf() : LOBE_R(0.0);
	const lobe_uint ordinary = (x > LOBE_R(0.0)) & (x <= LOBE_REAL_MAX);
	const lobe_uint valid = (x >= LOBE_R(0.0)) & (y == y);
	const lobe_real z = valid ? (ordinary ? finite : zero_or_inf) : lobe_real_nan();
	return ((x == LOBE_R(1.0)) | (y == LOBE_R(0.0))) ? LOBE_R(1.0) : z;
}

#endif
