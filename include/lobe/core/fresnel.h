/* fresnel.h - reflection, refraction and total reflection at a smooth interface.
 *
 * Throughout, c = |cos theta| of the incident side against the (micro)normal, in [0, 1], and eta = index of the far
 * side over the index of the incident side. Unpolarised light. */
#ifndef LOBE_CORE_FRESNEL_H
#define LOBE_CORE_FRESNEL_H

#include "real.h"
#include "vec.h"

/* reflectance + transmittance = 1 to rounding. cos_t: cosine of the refracted side, >= 0; 0 at total reflection.
 * bend: eta cos_t - c, for lobe_refract. */
typedef struct {
	lobe_real reflectance, transmittance, cos_t, bend;
} lobe_fresnel;

/* The root of g^2, 0 where that is below 0: at total reflection. */
LOBE_FN lobe_real lobe_fresnel_g(lobe_real g2) { return lobe_sqrt(lobe_max(LOBE_R(0.0), g2)); }

/* The interface of index eta, at a normal m of any length: c = w.m, g = eta |m| cos_t, m2 = |m|^2 and x = c g - |w x
 * m|^2 for the unit direction w. All of it scales with |m|, on which no reflectance depends, so that a facet or a half
 * vector need not be normalised. k = (eta - 1)(eta + 1). */
typedef struct {
	lobe_real c, g, x, m2;
	lobe_real eta, eta2, k;
} lobe_fresnel_interface;

/* What the index gives. */
LOBE_FN lobe_fresnel_interface lobe_fresnel_interface_make(lobe_real eta)
{
	lobe_fresnel_interface f;
	f.eta = eta;
	f.eta2 = eta * eta;
	f.k = (eta - LOBE_R(1.0)) * (eta + LOBE_R(1.0));
	f.c = f.g = f.x = f.m2 = LOBE_R(0.0);
	return f;
}

/* a where first, else b. */
LOBE_FN lobe_fresnel_interface lobe_fresnel_interface_select(int first, lobe_fresnel_interface a,
							     lobe_fresnel_interface b)
{
	b.c = first ? a.c : b.c;
	b.g = first ? a.g : b.g;
	b.x = first ? a.x : b.x;
	b.m2 = first ? a.m2 : b.m2;
	b.eta = first ? a.eta : b.eta;
	b.eta2 = first ? a.eta2 : b.eta2;
	b.k = first ? a.k : b.k;
	return b;
}

/* 1 - c^2, the squared sine of incidence on an interface of index eta. From within dense glass light leaves in a cone
 * so narrow that its cosine has no digits left: there it is that of cross, a vector as long
 * as the direction times the unit normal. */
LOBE_FN lobe_real lobe_sine2(lobe_real c, lobe_real eta, lobe_vec3 cross)
{
	const lobe_real one = LOBE_R(1.0);
	return eta < LOBE_R(0.5) ? lobe_dot(cross, cross) : (one - c) * (one + c);
}

/* At a unit normal, from the cosine and the squared sine: g^2 is c^2 + k or, where that cancels, eta^2 - sin^2. */
LOBE_FN lobe_fresnel_interface lobe_fresnel_interface_unit(lobe_real c, lobe_real s2, lobe_real eta)
{
	const lobe_real one = LOBE_R(1.0);
	lobe_fresnel_interface f = lobe_fresnel_interface_make(eta);
	f.c = c;
	const lobe_real thin = lobe_fma(eta, eta, -s2);
	const lobe_real thick = lobe_fma(f.c, f.c, f.k);
	f.g = lobe_fresnel_g(f.eta2 < LOBE_R(0.5) ? thin : thick);
	f.x = lobe_fma(f.c, f.g, -s2);
	f.m2 = one;
	return f;
}

/* The same where the refracted direction is known too, with the cosine cos_t: from the denser side that does not cancel
 * near total reflection. */
LOBE_FN lobe_fresnel_interface lobe_fresnel_interface_across(lobe_fresnel_interface f, lobe_real s2, lobe_real cos_t)
{
	const int dense = f.k < LOBE_R(0.0);
	f.g = dense ? f.eta * cos_t : f.g;
	f.x = lobe_fma(f.c, f.g, -s2);
	return f;
}

/* At a normal, which the caller has c, g, x and m2 of, by whatever form keeps their digits there. */
LOBE_FN lobe_fresnel_interface lobe_fresnel_interface_at(lobe_fresnel_interface f, lobe_real c, lobe_real g,
							 lobe_real x, lobe_real m2)
{
	f.c = c;
	f.g = g;
	f.x = x;
	f.m2 = m2;
	return f;
}

/* Amplitudes (Born and Wolf, 1.5.2) from A = c + g and B = eta^2 c + g,
 *	r_s = (c - g)/A         = -bend m2 a,       bend = k/A, a = 1/A
 *	r_p = (eta^2 c - g)/B   = bend x b,         b = 1/B
 * free of cancellation however near eta is to 1 (but for the zero of r_p at Brewster's angle). bend is that of
 * lobe_refract, for m of whatever length. (2^-60: where eta = 1 and c = 0, or c = 0 in total reflection, A and B are
 * 0.) */
typedef struct {
	lobe_real a, b, bend;
} lobe_fresnel_amplitudes;

LOBE_FN lobe_fresnel_amplitudes lobe_fresnel_amplitudes_make(lobe_fresnel_interface f)
{
	const lobe_real c = f.c + LOBE_R(0x1p-60);
	const lobe_real big_a = c + f.g;
	const lobe_real big_b = lobe_fma(f.eta2, c, f.g);
	const lobe_real inv = LOBE_R(1.0) / (big_a * big_b);
	lobe_fresnel_amplitudes r;
	r.a = inv * big_b;
	r.b = inv * big_a;
	r.bend = f.k * r.a;
	return r;
}

/* Reflectance F and transmittance 1 - F = 2 g c (1/A^2 + eta^2/B^2), which does not cancel near total reflection, have
 * one form, s t ((x a)^2 + (y b)^2): with s = bend, t = bend/2 and (x, y) = (m2, x), or with s = c, t = 2 g and (1,
 * eta). */
LOBE_FN lobe_real lobe_fresnel_part(lobe_fresnel_amplitudes r, lobe_real s, lobe_real t, lobe_real x, lobe_real y)
{
	const lobe_real xa = x * r.a, yb = y * r.b;
	return (s * t) * lobe_fma(xa, xa, yb * yb);
}

LOBE_FN lobe_real lobe_fresnel_reflectance(lobe_fresnel_interface f, lobe_fresnel_amplitudes r)
{
	return lobe_fresnel_part(r, r.bend, LOBE_R(0.5) * r.bend, f.m2, f.x);
}

/* Whether a number below 1 is below F. */
LOBE_FN int lobe_fresnel_reflects(lobe_fresnel_interface f, lobe_fresnel_amplitudes r, lobe_real u)
{
	return u + u < lobe_fresnel_part(r, r.bend, r.bend, f.m2, f.x);
}

LOBE_FN lobe_real lobe_fresnel_transmittance(lobe_fresnel_interface f, lobe_fresnel_amplitudes r)
{
	return lobe_fresnel_part(r, f.c, f.g + f.g, LOBE_R(1.0), f.eta);
}

/* One of the two. */
LOBE_FN lobe_real lobe_fresnel_share(lobe_fresnel_interface f, int reflects)
{
	const lobe_fresnel_amplitudes r = lobe_fresnel_amplitudes_make(f);
	const lobe_real one = LOBE_R(1.0), half_bend = LOBE_R(0.5) * r.bend, g2 = f.g + f.g;
	const lobe_real share = lobe_fresnel_part(r, reflects ? r.bend : f.c, reflects ? half_bend : g2,
						  reflects ? f.m2 : one, reflects ? f.x : f.eta);
	return lobe_at_most(share, one);
}

/* lobe_fresnel_dielectric of an interface at a unit normal, whose angles the caller may know better than by the cosine. */
LOBE_FN lobe_fresnel lobe_fresnel_dielectric_at(lobe_fresnel_interface f)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_fresnel_amplitudes m = lobe_fresnel_amplitudes_make(f);
	/* One comparison: of two gcc makes a branch. */
	const int total = f.g <= (f.k < zero ? zero : -one);
	const lobe_real reflected = lobe_at_most(lobe_fresnel_reflectance(f, m), one);
	const lobe_real transmitted = lobe_at_most(lobe_fresnel_transmittance(f, m), one);
	const lobe_real through = f.k == zero ? one : transmitted;
	lobe_fresnel r;
	r.reflectance = total ? one : reflected;
	r.transmittance = total ? zero : through;
	r.cos_t = f.g / f.eta;
	r.bend = m.bend;
	return r;
}

/* Exact dielectric Fresnel. Domain: eta in [1/1000, 1000]. Near total reflection
 *	1 - F = 2 g c (1/A^2 + eta^2/B^2)
 * does not cancel either. eta = 1 is no interface: F = 0 even at c = 0. A NaN eta gives NaN.
 *
 * Relative error, eta > 1: reflectance 8.4e-7, transmittance 5.3e-7, cos_t 1.4e-7; eta < 1, beyond what a rounding of
 * eta or c does near the edge of total reflection: 7.7e-7, 3.4e-7, 1.4e-7 (tests/test_fresnel.c, against MPFR). */
LOBE_FN lobe_fresnel lobe_fresnel_dielectric(lobe_real c, lobe_real eta)
{
	return lobe_fresnel_dielectric_at(lobe_fresnel_interface_unit(c, (LOBE_R(1.0) - c) * (LOBE_R(1.0) + c), eta));
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

/* What lobe_fresnel_conductor needs of the angle, shared by the three colours: cos^2, sin^2 and its square. The sum of
 * the two is 1 to the last digit, which counts for more than their own last digits: reflectance hardly changes with the
 * angle near normal incidence. */
typedef struct {
	lobe_real c2, s2, s4;
} lobe_fresnel_angle;

LOBE_FN lobe_fresnel_angle lobe_fresnel_angle_make(lobe_real c2)
{
	lobe_fresnel_angle a;
	a.c2 = c2;
	a.s2 = LOBE_R(1.0) - c2;
	a.s4 = a.s2 * a.s2;
	return a;
}

/* The root A + iK of N^2 - sin^2, N = n + ik, K >= 0, by its larger part: what a metal makes of the cosine, as g is of
 * a dielectric. m + 2ink = N^2 - 1, nk2 = 2nk, t = m + cos^2 or, where that cancels, n^2 - k^2 - sin^2, q = A^2 + K^2,
 * sum = q + |t|.
 *
 * A = sqrt((q + t)/2), but for a metal t < 0 and q + t cancels; then A = nk/K with K = sqrt((q - t)/2), which does not.
 * 2^-90 keeps all but t off 0, where k = 0 and n = sin; q is then less than a rounding of t. */
typedef struct {
	lobe_real m, t, q, sum, nk2;
} lobe_fresnel_conductor_root;

LOBE_FN lobe_fresnel_conductor_root lobe_fresnel_conductor_root_make(lobe_real c2, lobe_real n, lobe_real k)
{
	const lobe_real one = LOBE_R(1.0);
	const int thin = n < LOBE_R(0.75);
	lobe_fresnel_conductor_root r;
	r.nk2 = (n + n) * k;
	r.m = lobe_fma(-k, k, (n - one) * (n + one));
	r.t = (thin ? (n - k) * (n + k) : r.m) + (c2 - (thin ? one : LOBE_R(0.0)));
	r.q = lobe_sqrt(lobe_fma(r.t, r.t, lobe_fma(r.nk2, r.nk2, LOBE_R(0x1p-90))));
	r.sum = r.q + lobe_abs(r.t);
	return r;
}

/* Exact reflectance of a conductor with complex index N = n + ik over the incident side's real one.
 * Domain: n in [1/1000, 1000], k in [0, 1000]. 0 when n or k is NaN.
 *
 * From r_s = (c - G)/(c + G), G = A + iK, and the ratio of |r_p|^2 to |r_s|^2 (Born and Wolf, 14.2). c^2 - G^2 = 1 -
 * N^2 is the same at every angle, so that with M = |N^2 - 1|^2, a sum of squares, nothing cancels, however near N is to
 * 1:
 *	F_s = M/W^2,                 W = |c + G|^2 = q + c^2 + 2Ac
 *	(F_s + F_p)/2 = F_s E/(E + 2Ac s^2),             E = q c^2 + s^4
 * Multiplied through by S = 2 max(A, K)^2 = q + |t|, both cases of the root need one root more and no division:
 * 2AcS = (S if t >= 0, else 2nk) sqrt(2 c^2 S). Relative error 5.7e-7, but for what roundings of t and cos^2 do, which
 * counts where n^2 is near sin^2 and k near 0 (tests/test_fresnel_conductor.c).
 *
 * den is S^3 W^2 (E + 2Ac s^2), between 1e-35 and 1e38; for the small S of |N| < 1, with S times 2^36. */
LOBE_FN lobe_quotient lobe_fresnel_conductor_quotient(lobe_fresnel_angle a, lobe_real n, lobe_real k)
{
	const lobe_fresnel_conductor_root r = lobe_fresnel_conductor_root_make(a.c2, n, k);
	const lobe_real scale = lobe_fma(n, n, k * k) > LOBE_R(1.0) ? LOBE_R(1.0) : LOBE_R(0x1p36);
	const lobe_real s = scale * r.sum;
	const lobe_real x = (r.t >= LOBE_R(0.0) ? s : scale * r.nk2) * lobe_sqrt((a.c2 + a.c2) * r.sum);
	const lobe_real w = lobe_fma(r.q + a.c2, s, x);
	const lobe_real e = lobe_fma(r.q, a.c2, a.s4) * s;
	lobe_quotient f;
	f.num = (lobe_fma(r.m, r.m, r.nk2 * r.nk2) * s) * (s * e);
	f.den = (w * w) * lobe_fma(x, a.s2, e);
	return f;
}

/* The quotient, of which roundings may make more than 1. */
LOBE_FN lobe_real lobe_fresnel_conductor_at(lobe_fresnel_angle a, lobe_real n, lobe_real k)
{
	const lobe_quotient f = lobe_fresnel_conductor_quotient(a, n, k);
	return lobe_at_most(f.num / f.den, LOBE_R(1.0));
}

/* Reflectance of a conductor of index n + ik at the cosine c in [0, 1], unpolarised, in [0, 1]; 0 where an argument is
 * no number. n in [1/1000, 1000], k in [0, 1000], over the index outside. */
LOBE_FN lobe_real lobe_fresnel_conductor(lobe_real c, lobe_real n, lobe_real k)
{
	return lobe_finite_or_zero(lobe_fresnel_conductor_at(lobe_fresnel_angle_make(c * c), n, k));
}

/* x times the reflectance of three colours, where x is a finite number. */
LOBE_FN lobe_rgb lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle a, lobe_rgb n, lobe_rgb k, lobe_real x)
{
	return lobe_rgb_make(lobe_fresnel_conductor_at(a, n.r, k.r) * x, lobe_fresnel_conductor_at(a, n.g, k.g) * x,
			     lobe_fresnel_conductor_at(a, n.b, k.b) * x);
}

/* The same of three colours. */
LOBE_FN lobe_rgb lobe_fresnel_conductor_rgb(lobe_real c, lobe_rgb n, lobe_rgb k)
{
	return lobe_rgb_finite_or_zero(
		lobe_fresnel_conductor_rgb_at(lobe_fresnel_angle_make(c * c), n, k, LOBE_R(1.0)));
}

#endif
