/* erf.h - the error function, its complement scaled, and its inverse; a part of real.h, to be
 * included by that alone. */
#ifndef LOBE_CORE_ERF_H
#define LOBE_CORE_ERF_H

/* 2/sqrt(pi) times the integral of exp(-t^2) from 0 to x. Domain: every float; odd, erf(+-inf) = +-1.
 * Measured: 1.28 ulp at x = 0.912329793.
 * x + x p(x^2) below 7/8, else 1 - 2^-g(x) with a polynomial g for -log2(1 - erf). From 4 on it is 1. */
LOBE_FN lobe_real lobe_erf(lobe_real x)
{
	const lobe_real a = lobe_abs(x);
	const lobe_real square = a * a;
	lobe_real p = LOBE_R(-0x1.440b16p-11);
	p = lobe_fma(p, square, LOBE_R(0x1.4979b2p-8));
	p = lobe_fma(p, square, LOBE_R(-0x1.b6e418p-6));
	p = lobe_fma(p, square, LOBE_R(0x1.ce1fd2p-4));
	p = lobe_fma(p, square, LOBE_R(-0x1.8127p-2));
	p = lobe_fma(p, square, LOBE_R(0x1.06eba6p-3));
	const lobe_real inner = lobe_fma(a, p, a);

	const lobe_real b = a > LOBE_R(4.0) ? LOBE_R(4.0) : a;
	lobe_real g = LOBE_R(-0x1.2e6866p-12);
	g = lobe_fma(g, b, LOBE_R(0x1.23660ap-8));
	g = lobe_fma(g, b, LOBE_R(-0x1.0882f6p-5));
	g = lobe_fma(g, b, LOBE_R(0x1.34058ep-3));
	g = lobe_fma(g, b, LOBE_R(0x1.d664d6p-1));
	g = lobe_fma(g, b, LOBE_R(0x1.a09034p+0));
	g = lobe_fma(g, b, LOBE_R(0x1.b45a76p-13));
	const lobe_real shifted = LOBE_EXP_SHIFT - g;
	const lobe_real r = (LOBE_EXP_SHIFT - shifted) - g;
	const lobe_real big = LOBE_R(1.0) - lobe_scale_exp(lobe_exp2_fraction(r), shifted);
	return lobe_nan_or(x, lobe_flip_sign(a < LOBE_R(0.875) ? inner : big, lobe_sign_bit(x)));
}

/* exp(x^2) times the complement 1 - erf(x) as a quotient, for who divides anyway; 0 <= x <= 2^14. Polynomials as in
 * Cody 1969, "Rational Chebyshev approximations for the error function". All coefficients are positive, so that nothing
 * cancels. They are our own, fitted like those of erfinv. */
LOBE_FN lobe_quotient lobe_erfcx_quotient(lobe_real x)
{
	lobe_real p = LOBE_R(0x1.6eeab2p-5);
	p = lobe_fma(p, x, LOBE_R(0x1.22399cp-2));
	p = lobe_fma(p, x, LOBE_R(0x1.aef6c4p-1));
	p = lobe_fma(p, x, LOBE_R(0x1.56ddaap+0));
	p = lobe_fma(p, x, LOBE_R(1.0));
	lobe_real q = LOBE_R(0x1.452be8p-4);
	q = lobe_fma(q, x, LOBE_R(0x1.0134b2p-1));
	q = lobe_fma(q, x, LOBE_R(0x1.88140cp+0));
	q = lobe_fma(q, x, LOBE_R(0x1.5026eap+1));
	q = lobe_fma(q, x, LOBE_R(0x1.3bdda4p+1));
	q = lobe_fma(q, x, LOBE_R(1.0));
	lobe_quotient r;
	r.num = p;
	r.den = q;
	return r;
}

/* exp(x^2) times the complement 1 - erf(x): what is left of it where both would underflow. Domain: x >= 0, NaN below;
 * erfcx(inf) = 0. Measured: 6.45 ulp at x = 4658.28223; 3 ulp below 1. From 2^14 on it is 1/(sqrt(pi) x). */
LOBE_FN lobe_real lobe_erfcx(lobe_real x)
{
	const lobe_quotient inner = lobe_erfcx_quotient(x);
	const lobe_uint outer = x > LOBE_R(0x1p+14);
	const lobe_real v = (outer ? LOBE_R(0x1.20dd76p-1) : inner.num) / (outer ? x : inner.den);
	return x >= LOBE_R(0.0) ? v : lobe_real_nan();
}

/* exp(x^2) times the integral of the complement 1 - erf from x to infinity: 1/sqrt(pi) - x erfcx(x) without its
 * cancellation. Domain: x >= 0, NaN below; ierfcx(inf) = 0. Measured: 7.29 ulp at x = 8715.1123; 4 ulp below 1.
 * As above; from 2^14 on 1/(2 sqrt(pi) x^2). */
LOBE_FN lobe_real lobe_ierfcx(lobe_real x)
{
	lobe_real p = LOBE_R(0x1.d83d0ep-7);
	p = lobe_fma(p, x, LOBE_R(0x1.8cf6a6p-4));
	p = lobe_fma(p, x, LOBE_R(0x1.4e0812p-2));
	p = lobe_fma(p, x, LOBE_R(0x1.391b8ap-1));
	p = lobe_fma(p, x, LOBE_R(0x1.20dd74p-1));
	lobe_real q = LOBE_R(0x1.a282acp-5);
	q = lobe_fma(q, x, LOBE_R(0x1.5fccfap-2));
	q = lobe_fma(q, x, LOBE_R(0x1.3ba16ap+0));
	q = lobe_fma(q, x, LOBE_R(0x1.579fe6p+1));
	q = lobe_fma(q, x, LOBE_R(0x1.d20dd4p+1));
	q = lobe_fma(q, x, LOBE_R(0x1.6d9d9ap+1));
	q = lobe_fma(q, x, LOBE_R(1.0));
	const lobe_uint outer = x > LOBE_R(0x1p+14);
	const lobe_real x2 = LOBE_R(0x1p-64) * x * x;
	const lobe_real v = (outer ? LOBE_R(0x1.20dd76p-66) : p) / (outer ? x2 : q);
	return x >= LOBE_R(0.0) ? v : lobe_real_nan();
}

/* The y with erf(y) = x, |x| < 1, for who knows d = 1 - x^2 better than x tells; d >= 2^-26.
 * x p(w) with w = -log(d), and with sqrt(w) in place of w from 5 on (Giles 2010, "Approximating the erfinv
 * function"). The polynomials are our own: least maximum relative error by iteratively reweighted least squares,
 * refitted after each coefficient was rounded to a float. */
LOBE_FN lobe_real lobe_erfinv_from(lobe_real x, lobe_real d)
{
	const lobe_real w = -lobe_log_normal(d);
	lobe_real p = LOBE_R(-0x1.7d6574p-28);
	p = lobe_fma(p, w, LOBE_R(0x1.42b946p-23));
	p = lobe_fma(p, w, LOBE_R(-0x1.668676p-20));
	p = lobe_fma(p, w, LOBE_R(0x1.d26ecep-21));
	p = lobe_fma(p, w, LOBE_R(0x1.bf6148p-15));
	p = lobe_fma(p, w, LOBE_R(-0x1.2983bp-13));
	p = lobe_fma(p, w, LOBE_R(-0x1.303d64p-9));
	p = lobe_fma(p, w, LOBE_R(0x1.7a3b5ep-7));
	p = lobe_fma(p, w, LOBE_R(0x1.db2a98p-3));
	p = lobe_fma(p, w, LOBE_R(0x1.c5bf88p-1));

	const lobe_real v = lobe_sqrt(w) - LOBE_R(3.0);
	lobe_real q = LOBE_R(-0x1.b2d524p-13);
	q = lobe_fma(q, v, LOBE_R(0x1.ae456p-14));
	q = lobe_fma(q, v, LOBE_R(0x1.6515c8p-10));
	q = lobe_fma(q, v, LOBE_R(-0x1.e1a546p-9));
	q = lobe_fma(q, v, LOBE_R(0x1.77a0eap-8));
	q = lobe_fma(q, v, LOBE_R(-0x1.f38bc4p-8));
	q = lobe_fma(q, v, LOBE_R(0x1.3559dap-7));
	q = lobe_fma(q, v, LOBE_R(0x1.006db8p+0));
	q = lobe_fma(q, v, LOBE_R(0x1.6a9efcp+1));

	return x * (w < LOBE_R(5.0) ? p : q);
}

/* The y with erf(y) = x. Domain: [-1, 1], NaN outside; odd, erfinv(+-1) = +-inf. Measured: 2.40 ulp at
 * x = 0.999978364. */
LOBE_FN lobe_real lobe_erfinv(lobe_real x)
{
	const lobe_real y = lobe_erfinv_from(x, lobe_fma(-x, x, LOBE_R(1.0)));
	const lobe_real a = lobe_abs(x);
	const lobe_real edge = a == LOBE_R(1.0) ? lobe_flip_sign(lobe_real_inf(), lobe_sign_bit(x)) : lobe_real_nan();
	return a < LOBE_R(1.0) ? y : edge;
}

#endif
