/* airy.h - a thin film on a base: the exact reflectance of one wavelength.
 *
 * Airy's sum of all interreflections between two parallel interfaces (Born and Wolf, 1.6.4 and 14.4.1), each
 * polarisation by itself. r12 belongs to the interface between outside and film, real; r23 to that between film and
 * base, complex over a metal; e^(i delta), delta = 2 pi OPD/wavelength, to the way there and back in the film, whose
 * optical path is OPD = 2 d sqrt(film^2 - sin^2). With T = 1 - |r|^2 and w = r23 e^(i delta)
 *	R = |(r12 + w)/(1 + r12 w)|^2,   1 - R = T12 T23/|1 + r12 w|^2
 * neither of which cancels but where waves do.
 *
 * Lengths are in nanometres. film, n, k: index of the film and of the base, all over that of the outside. film >= 1, or
 * there would be total reflection in the film; thin_film.h has the way out for a base that is rarer than the outside.
 *
 * No film is no film: with d = 0 the result is the base's own Fresnel reflectance to rounding, with film = 1 too, and
 * so it is where OPD is a whole number of wavelengths. Absolute error where OPD is below a wavelength 9.8e-7 over a
 * dielectric, 3.9e-6 over a metal, beyond by 2.6e-6 for each wavelength: a rounding of the phase
 * (tests/test_airy.c, against complex double). */
#ifndef LOBE_CORE_AIRY_H
#define LOBE_CORE_AIRY_H

#include "complex.h"
#include "fresnel.h"
#include "real.h"

/* d [nm], in [0, 1e6]; index in [1, 1000]. 0 nm is no film. */
typedef struct {
	lobe_real thickness, index;
} lobe_film;

/* thickness: d [nm]. index: over that of the medium outside. Neither is checked here; a scene does. */
LOBE_FN lobe_film lobe_film_make(lobe_real thickness, lobe_real index)
{
	lobe_film f;
	f.thickness = thickness;
	f.index = index;
	return f;
}

/* The interface between outside and film: g = sqrt(film^2 - sin^2), amplitudes (rs = -r_s, rp = r_p) and transmittances
 * of both polarisations. */
typedef struct {
	lobe_real c, g, s2, rs, rp, ts, tp;
} lobe_film_top;

LOBE_FN lobe_film_top lobe_film_top_make(lobe_real c, lobe_real index)
{
	const lobe_fresnel_interface m = lobe_fresnel_interface_unit(c, (LOBE_R(1.0) - c) * (LOBE_R(1.0) + c), index);
	const lobe_fresnel_amplitudes r = lobe_fresnel_amplitudes_make(m);
	const lobe_real one = LOBE_R(1.0);
	const lobe_real cg4 = LOBE_R(4.0) * m.c * m.g;
	lobe_film_top t;
	t.c = m.c;
	t.g = m.g;
	t.s2 = (one - m.c) * (one + m.c);
	t.rs = r.bend * r.a;
	t.rp = r.bend * m.x * r.b;
	t.ts = m.k == LOBE_R(0.0) ? one : cg4 * r.a * r.a;
	t.tp = m.k == LOBE_R(0.0) ? one : cg4 * m.eta2 * r.b * r.b;
	return t;
}

/* The interface below, one polarisation: amplitude, in the signs of lobe_film_top, and transmittance. */
typedef struct {
	lobe_complex r;
	lobe_real t;
} lobe_film_bottom;

/* (v - u)/(v + u) of complex u and v, and 1 - its square: from the parts of u conj(v). */
LOBE_FN lobe_film_bottom lobe_film_bottom_from_ratio(lobe_complex u, lobe_complex v)
{
	const lobe_complex sum = lobe_complex_make(u.re + v.re, u.im + v.im);
	const lobe_real inv = LOBE_R(1.0) / lobe_max(lobe_complex_norm(sum), LOBE_R(0x1p-80));
	const lobe_real across = u.re * v.im - u.im * v.re;
	const lobe_real along = u.re * v.re + u.im * v.im;
	lobe_film_bottom b;
	b.r.re = ((v.re - u.re) * sum.re + (v.im - u.im) * sum.im) * inv;
	b.r.im = (across + across) * inv;
	b.t = LOBE_R(4.0) * along * inv;
	return b;
}

/* The same of a real u, without the products by 0. */
LOBE_FN lobe_film_bottom lobe_film_bottom_from_real(lobe_real u, lobe_complex v)
{
	const lobe_real sum = u + v.re, im2 = v.im * v.im;
	const lobe_real inv = LOBE_R(1.0) / lobe_max(sum * sum + im2, LOBE_R(0x1p-80));
	const lobe_real across = u * v.im;
	lobe_film_bottom b;
	b.r.re = ((v.re - u) * sum + im2) * inv;
	b.r.im = (across + across) * inv;
	b.t = LOBE_R(4.0) * (u * v.re) * inv;
	return b;
}

typedef struct {
	lobe_film_bottom s, p;
} lobe_film_bottoms;

/* film to n + ik; r_s = -(g - G)/(g + G), r_p = (N^2 g - film^2 G)/(N^2 g + film^2 G), G = sqrt(N^2 - sin^2). */
LOBE_FN lobe_film_bottoms lobe_film_bottoms_conductor(lobe_film_top top, lobe_real index, lobe_real n, lobe_real k)
{
	const lobe_real zero = LOBE_R(0.0);
	const lobe_fresnel_conductor_root m = lobe_fresnel_conductor_root_make(top.c * top.c, n, k);
	const lobe_real large = lobe_sqrt(LOBE_R(0.5) * m.sum);
	const lobe_real lesser = LOBE_R(0.5) * m.nk2 / large;
	const int thick = m.t >= zero;
	const lobe_complex root = lobe_complex_make(thick ? large : lesser, thick ? lesser : large);
	const lobe_complex n2_g = lobe_complex_make((n - k) * (n + k) * top.g, m.nk2 * top.g);
	lobe_film_bottoms b;
	b.s = lobe_film_bottom_from_real(top.g, root);
	b.p = lobe_film_bottom_from_ratio(lobe_complex_scale(root, index * index), n2_g);
	return b;
}

/* Amplitudes between two dielectrics of indices n1 and n2, from n1 cos_1 = c and n2 cos_2 = g, k = n2^2 - n1^2 = g^2 -
 * c^2 and s2, the square of n sin on both sides. With A = c + g, B = n2^2 c + n1^2 g they (Born and Wolf, 1.5.2)
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

/* film to a dielectric of index eta >= 1. */
LOBE_FN lobe_film_bottoms lobe_film_bottoms_dielectric(lobe_film_top top, lobe_real index, lobe_real eta)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_real k = (eta - index) * (eta + index);
	const lobe_real g = lobe_sqrt(lobe_fma(top.c, top.c, (eta - one) * (eta + one)));
	const lobe_real film2 = index * index, eta2 = eta * eta;
	const lobe_fresnel_pair r = lobe_fresnel_pair_make(top.g, g, k, top.s2, film2, eta2);
	const lobe_real cg4 = LOBE_R(4.0) * top.g * g;
	lobe_film_bottoms b;
	b.s.r = lobe_complex_make(r.rs, zero);
	b.p.r = lobe_complex_make(r.rp, zero);
	b.s.t = k == zero ? one : cg4 * r.a * r.a;
	b.p.t = k == zero ? one : cg4 * (film2 * r.b) * (eta2 * r.b);
	return b;
}

/* Reflectance and transmittance of one polarisation, turn: e^(i delta). They add up to 1 to rounding. */
typedef struct {
	lobe_real reflectance, transmittance;
} lobe_airy;

/* Where both interfaces reflect nearly all, at grazing angles, the sum is a sharp resonance and 1 + r12 w a small
 * difference. With z = -r12 w it is 1 - z, whose real part is formed as (1 - |z|) + (|z| - Re z), both free of
 * cancellation:
 *	1 - |z| = (T12 + R12 T23)/(1 + |z|),   |z| - Re z = (Im z)^2/(|z| + Re z)
 * and R is 1 - T there; elsewhere it keeps its own relative precision. */
LOBE_FN lobe_airy lobe_airy_sum(lobe_real r12, lobe_real t12, lobe_film_bottom bottom, lobe_complex turn)
{
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0);
	const lobe_complex w = lobe_complex_mul(bottom.r, turn);
	const lobe_complex z = lobe_complex_scale(w, -r12);
	const lobe_real size = lobe_sqrt(lobe_complex_norm(z));
	const lobe_real less = lobe_fma(r12 * r12, bottom.t, t12) / (one + size);
	const lobe_real ahead = size + lobe_abs(z.re);
	const lobe_real bent = z.im * z.im / lobe_max(ahead, LOBE_R(0x1p-60));
	const lobe_real aside = z.re > zero ? bent : ahead;
	const lobe_real den = lobe_complex_norm(lobe_complex_make(less + aside, z.im));
	const lobe_real inv = one / lobe_max(den, LOBE_R(0x1p-100));
	const lobe_real passes = lobe_at_most(t12 * bottom.t * inv, one);
	const lobe_real own = lobe_at_most(lobe_complex_norm(lobe_complex_make(r12 + w.re, w.im)) * inv, one);
	lobe_airy a;
	a.reflectance = den < LOBE_R(0.25) ? one - passes : own;
	a.transmittance = passes;
	return a;
}

/* How much longer the way through the film and back is [nm]. */
LOBE_FN lobe_real lobe_film_opd(lobe_film film, lobe_film_top top) { return (film.thickness + film.thickness) * top.g; }

/* e^(i delta) */
LOBE_FN lobe_complex lobe_film_turn(lobe_film film, lobe_film_top top, lobe_real wavelength)
{
	const lobe_sincos t = lobe_sincos_2pi(lobe_film_opd(film, top) / wavelength);
	return lobe_complex_make(t.c, t.s);
}

/* Unpolarised reflectance of film over n + ik, wavelength in vacuum [nm] over the index of the outside. c: cosine
 * outside. */
LOBE_FN lobe_real lobe_airy_conductor(lobe_real c, lobe_film film, lobe_real n, lobe_real k, lobe_real wavelength)
{
	const lobe_film_top top = lobe_film_top_make(c, film.index);
	const lobe_film_bottoms b = lobe_film_bottoms_conductor(top, film.index, n, k);
	const lobe_complex turn = lobe_film_turn(film, top, wavelength);
	const lobe_airy s = lobe_airy_sum(top.rs, top.ts, b.s, turn);
	const lobe_airy p = lobe_airy_sum(top.rp, top.tp, b.p, turn);
	return LOBE_R(0.5) * (s.reflectance + p.reflectance);
}

/* The same over a dielectric of index eta >= 1, with what passes into it. */
LOBE_FN lobe_airy lobe_airy_dielectric(lobe_real c, lobe_film film, lobe_real eta, lobe_real wavelength)
{
	const lobe_film_top top = lobe_film_top_make(c, film.index);
	const lobe_film_bottoms b = lobe_film_bottoms_dielectric(top, film.index, eta);
	const lobe_complex turn = lobe_film_turn(film, top, wavelength);
	const lobe_airy s = lobe_airy_sum(top.rs, top.ts, b.s, turn);
	const lobe_airy p = lobe_airy_sum(top.rp, top.tp, b.p, turn);
	lobe_airy a;
	a.reflectance = LOBE_R(0.5) * (s.reflectance + p.reflectance);
	a.transmittance = LOBE_R(0.5) * (s.transmittance + p.transmittance);
	return a;
}

#endif
