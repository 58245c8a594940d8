/* fresnel.h - reflection, refraction and total reflection at a smooth interface.
 *
 * Throughout, c = |cos theta| of the incident side against the (micro)normal, in [0, 1], and eta = index of the far
 * side over the index of the incident side. Unpolarised light. */
#ifndef LOBE_CORE_FRESNEL_H
#define LOBE_CORE_FRESNEL_H

#include "vec.h"

/* reflectance + transmittance = 1 to rounding. cos_t: cosine of the refracted side, >= 0; 0 at total reflection.
 * bend: eta cos_t - c, for lobe_refract. */
typedef struct {
	lobe_real reflectance, transmittance, cos_t, bend;
} lobe_fresnel;

/* Amplitudes between two dielectrics of indices n1 and n2, from n1 cos_1 = c and n2 cos_2 = g, k = n2^2 - n1^2 = g^2 - c^2
 * and s2, the square of n sin on both sides. With A = c + g, B = n2^2 c + n1^2 g they (Born and Wolf, 1.5.2)
 *	r_s = (c - g)/A                = -k/A^2
 *	r_p = (n2^2 c - n1^2 g)/B      = k (c g - s2)/(A B)
 * are free of cancellation however near the indices are (but for the zero of r_p at Brewster's angle).
 * a = 1/A, b = 1/B, rs = -r_s, rp = r_p. */
typedef struct {
	lobe_real a, b, rs, rp;
} lobe_fresnel_pair;

LOBE_FN lobe_fresnel_pair lobe_fresnel_pair_make(lobe_real c, lobe_real g, lobe_real k, lobe_real s2,
						 lobe_real n1_squared, lobe_real n2_squared)
{
	const lobe_real big_a = c + g;
	const lobe_real big_b = lobe_fma(n2_squared, c, n1_squared * g);
	const lobe_real inv = LOBE_R(1.0) / (big_a * big_b);
	lobe_fresnel_pair f;
	f.a = inv * big_b;
	f.b = inv * big_a;
	f.rs = k * f.a * f.a;
	f.rp = k * lobe_fma(c, g, -s2) * f.a * f.b;
	return f;
}

/* The interface of index eta. c: at least 2^-40; g = eta cos_t, 0 at total reflection; k = (eta - 1)(eta + 1);
 * s2 = sin^2. */
typedef struct {
	lobe_real c, g, k, s2, eta2;
	lobe_fresnel_pair r;
	int total;
} lobe_fresnel_amplitudes;

/* Domain: eta in [1/1000, 1000]. g^2 is c^2 + k or, where that cancels, eta^2 - sin^2. */
LOBE_FN lobe_fresnel_amplitudes lobe_fresnel_amplitudes_make(lobe_real c_in, lobe_real eta)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	lobe_fresnel_amplitudes f;
	f.c = lobe_max(c_in, LOBE_R(0x1p-40));
	f.k = (eta - one) * (eta + one);
	f.eta2 = eta * eta;
	f.s2 = (one - f.c) * (one + f.c);
	const lobe_real g2_thin = lobe_fma(eta, eta, -f.s2);
	const lobe_real g2_thick = lobe_fma(f.c, f.c, f.k);
	const lobe_real g2 = f.eta2 < LOBE_R(0.5) ? g2_thin : g2_thick;
	f.total = g2 <= zero;
	f.g = lobe_sqrt(f.total ? zero : g2);
	f.r = lobe_fresnel_pair_make(f.c, f.g, f.k, f.s2, one, f.eta2);
	return f;
}

/* Exact dielectric Fresnel. Domain: eta in [1/1000, 1000]. Near total reflection
 *	1 - F = 2 g c (1/A^2 + eta^2/B^2)
 * does not cancel either. eta = 1 is no interface: F = 0 even at c = 0. Below 2^-40 c counts as 2^-40. A NaN eta gives
 * NaN.
 *
 * Relative error, eta > 1: reflectance 9.3e-7, transmittance 4.4e-7, cos_t 1.4e-7; eta < 1, beyond what a rounding of
 * eta or c does near the edge of total reflection: 7.7e-7, 3.4e-7, 1.4e-7 (tests/test_fresnel.c, against MPFR). */
LOBE_FN lobe_fresnel lobe_fresnel_dielectric(lobe_real c, lobe_real eta)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0), two = LOBE_R(2.0);
	const lobe_fresnel_amplitudes m = lobe_fresnel_amplitudes_make(c, eta);
	const lobe_real refl = LOBE_R(0.5) * lobe_fma(m.r.rs, m.r.rs, m.r.rp * m.r.rp);
	const lobe_real trans = two * m.g * m.c * lobe_fma(m.r.a, m.r.a, m.eta2 * m.r.b * m.r.b);
	const lobe_real refl_at_most_1 = lobe_at_most(refl, one);
	const lobe_real trans_at_most_1 = lobe_at_most(trans, one);
	const lobe_real through = m.k == zero ? one : trans_at_most_1;
	lobe_fresnel f;
	f.reflectance = m.total ? one : refl_at_most_1;
	f.transmittance = m.total ? zero : through;
	f.cos_t = m.g / eta;
	f.bend = m.k * m.r.a;
	return f;
}

/* The refracted direction of w through an interface with unit normal m, both on the incident side: w.m = c > 0, and
 * f = lobe_fresnel_dielectric(c, eta), inv_eta = 1/eta. Unit to 2.3e-7 max(1, 1/eta)^2, as far as c is w.m. Snell's law
 * in the form
 *	-(w + (eta cos_t - c) m)/eta,   eta cos_t - c = k/A,
 * which turns into -w without cancellation as eta goes to 1. At total reflection the result means nothing. */
LOBE_FN lobe_vec3 lobe_refract(lobe_vec3 w, lobe_vec3 m, lobe_real inv_eta, lobe_fresnel f)
{
	return lobe_vec3_scale(lobe_vec3_fma(f.bend, m, w), -inv_eta);
}

/* The mirrored direction of w about the unit normal m, c = w.m: 2 c m - w. */
LOBE_FN lobe_vec3 lobe_reflect(lobe_vec3 w, lobe_vec3 m, lobe_real c)
{
	return lobe_vec3_fma(c + c, m, lobe_vec3_make(-w.x, -w.y, -w.z));
}

/* What lobe_fresnel_conductor needs of the angle, shared by the three colours. */
typedef struct {
	lobe_real c, c2, s2, s4;
} lobe_fresnel_angle;

LOBE_FN lobe_fresnel_angle lobe_fresnel_angle_make(lobe_real c)
{
	const lobe_real one = LOBE_R(1.0);
	lobe_fresnel_angle a;
	a.c = c;
	a.c2 = c * c;
	a.s2 = (one - c) * (one + c);
	a.s4 = a.s2 * a.s2;
	return a;
}

/* From the square of the cosine, where that is known first: the root is then not on the way to all the rest. */
LOBE_FN lobe_fresnel_angle lobe_fresnel_angle_from_cos2(lobe_real c2)
{
	lobe_fresnel_angle a;
	a.c = lobe_sqrt(c2);
	a.c2 = c2;
	a.s2 = LOBE_R(1.0) - c2;
	a.s4 = a.s2 * a.s2;
	return a;
}

/* The root A + iK of (n + ik)^2 - sin^2, K >= 0, by its larger part: what a metal makes of the cosine, as g is of a
 * dielectric. t = n^2 - k^2 - s^2, q = A^2 + K^2, sum = q + |t|, nk2 = 2nk.
 *
 * A = sqrt((q + t)/2), but for a metal t < 0 and q + t cancels; then A = nk/K with K = sqrt((q - t)/2), which does not.
 * big = max(A, K) is A where t >= 0. */
typedef struct {
	lobe_real t, q, sum, nk2, big;
} lobe_fresnel_conductor_root;

LOBE_FN lobe_fresnel_conductor_root lobe_fresnel_conductor_root_make(lobe_real s2, lobe_real n, lobe_real k)
{
	lobe_fresnel_conductor_root r;
	r.nk2 = (n + n) * k;
	r.t = (n - k) * (n + k) - s2;
	r.q = lobe_sqrt(lobe_fma(r.t, r.t, r.nk2 * r.nk2));
	r.sum = r.q + lobe_abs(r.t);
	r.big = lobe_sqrt(LOBE_R(0.5) * r.sum);
	return r;
}

/* Exact reflectance of a conductor with complex index n + ik over the incident side's real one.
 * Domain: n in [1/1000, 1000], k in [0, 1000]. 0 when n or k is NaN.
 *
 * The usual form (Born and Wolf, 14.2) needs 2Ac and q. Multiplied through by B = max(A, K), both cases of the root need
 * one root and no division:
 *	F_s = N/D,  N, D = (q + c^2) B -+ X c,        X = q + t if t >= 0, else 2nk
 *	F = F_s E/(E + X c s^2),                      E = (q c^2 + s^4) B
 * where the second line is (F_s + F_p)/2. Error 3.1e-7 relative for real metals, 3.1e-7 absolute over the domain, but
 * for what a rounding of t does where n^2 is near sin^2 and k near 0 (tests/test_fresnel.c).
 *
 * The terms of F = N E/(D (E + X c s^2)), of which numerator and denominator are made. */
typedef struct {
	lobe_real p, xc, e, scale;
} lobe_fresnel_conductor_terms;

LOBE_FN lobe_fresnel_conductor_terms lobe_fresnel_conductor_terms_make(lobe_fresnel_angle a, lobe_real n, lobe_real k)
{
	const lobe_fresnel_conductor_root r = lobe_fresnel_conductor_root_make(a.s2, n, k);
	lobe_fresnel_conductor_terms f;
	f.xc = (r.t >= LOBE_R(0.0) ? r.sum : r.nk2) * a.c;
	f.p = (r.q + a.c2) * r.big;
	f.e = lobe_fma(r.q, a.c2, a.s4) * r.big;
	f.scale = lobe_fma(f.xc, a.s2, f.e);
	return f;
}

LOBE_FN lobe_real lobe_fresnel_conductor_num(lobe_fresnel_conductor_terms f) { return (f.p - f.xc) * f.e; }

/* Mostly between 1e-12 and 4e18 over the domain; 0 where k = 0 and n = sin, which 2^-75 keeps it off. */
LOBE_FN lobe_real lobe_fresnel_conductor_den(lobe_fresnel_conductor_terms f)
{
	return lobe_fma(f.p + f.xc, f.scale, LOBE_R(0x1p-75));
}

LOBE_FN lobe_real lobe_fresnel_conductor(lobe_real c, lobe_real n, lobe_real k)
{
	const lobe_fresnel_conductor_terms f = lobe_fresnel_conductor_terms_make(lobe_fresnel_angle_make(c), n, k);
	return lobe_max(lobe_fresnel_conductor_num(f) / lobe_fresnel_conductor_den(f), LOBE_R(0.0));
}

/* The three colours; red and green share a division, as the range of the denominators allows for two. */
LOBE_FN lobe_rgb lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle a, lobe_rgb n, lobe_rgb k)
{
	const lobe_real zero = LOBE_R(0.0);
	const lobe_fresnel_conductor_terms r = lobe_fresnel_conductor_terms_make(a, n.r, k.r);
	const lobe_fresnel_conductor_terms g = lobe_fresnel_conductor_terms_make(a, n.g, k.g);
	const lobe_fresnel_conductor_terms b = lobe_fresnel_conductor_terms_make(a, n.b, k.b);
	const lobe_real den_r = lobe_fresnel_conductor_den(r);
	const lobe_real den_g = lobe_fresnel_conductor_den(g);
	const lobe_real inv = LOBE_R(1.0) / (den_r * den_g);
	return lobe_rgb_make(lobe_max(lobe_fresnel_conductor_num(r) * (den_g * inv), zero),
			     lobe_max(lobe_fresnel_conductor_num(g) * (den_r * inv), zero),
			     lobe_max(lobe_fresnel_conductor_num(b) / lobe_fresnel_conductor_den(b), zero));
}

LOBE_FN lobe_rgb lobe_fresnel_conductor_rgb(lobe_real c, lobe_rgb n, lobe_rgb k)
{
	return lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle_make(c), n, k);
}

#endif
