/* thin_film.h - the colour of a thin film: reflectance in RGB, without a spectrum.
 *
 * Belcour and Barla 2017, "A practical extension to microfacet theory for the modeling of varying iridescence". Airy's
 * reflectance (airy.h) of one polarisation is a Fourier series in the optical path OPD over the wavelength,
 *	1 - R = A (1 + 2 Re sum_m z^m e^(i m 2 pi OPD/wavelength)),   z = -r12 r23,   A = T12 T23/(1 - |z|^2),
 * and what a sensor of Gaussian sensitivity over 1/wavelength makes of each term is known in closed form: a factor S_m,
 * the Fourier transform of its sensitivity at m OPD. The sensors are those of the paper, four Gaussians that fit the
 * CIE 1931 observer, here turned into linear sRGB whose white is light of equal energy (Bradford), each channel's
 * weights adding up to 1.
 *
 * Where this differs from the paper: amplitudes stay complex, so no phase is taken out of them and put back; and the
 * series is not cut off. Its first four terms are exact, the rest is summed as the geometric series that they go on as,
 *	sum_(m>4) z^m S_m = z^5 S_5/(1 - z q),   q = S_6/S_5 of the channel's main Gaussian,
 * which is the whole rest where the film is so thin that S_m = 1 for all m. So a film of thickness 0 is exactly none,
 * without a blend of the index towards 1, and so is one of index 1; a thick film's colour goes to that of A.
 *
 * Largest distance from the spectral integral with the same sensitivities, film index 1 to 2.5, thickness 0 to 1500 nm,
 * cosine .001 to 1: over the metals of optics.def .063 (mean 1.7e-4; at cosines above .3: .011), over dielectrics of
 * index 1 to 3 .013 (mean 8e-6; above .3: 5e-4). At thickness 0 single precision is off by 1.4e-6
 * (tests/test_thin_film.c).
 *
 * Saturated interference colours lie outside of sRGB's gamut: results are clamped to [0, 1]. Without a spectrum the
 * base is one index per channel. Lengths in nanometres, indices over that of the outside, film index >= 1. */
#ifndef LOBE_CORE_THIN_FILM_H
#define LOBE_CORE_THIN_FILM_H

#include "airy.h"

/* S_m of the three channels. */
typedef struct {
	lobe_complex r, g, b;
} lobe_film_colour;

/* The four Gaussians, X's two lobes, Y and Z: transform of each at m OPD, and what takes it to the next order. For one
 * Gaussian that is d^(m^2) e^(i m theta), and a step multiplies by d^(2m+1) e^(i theta). */
typedef struct {
	lobe_complex at, step;
	lobe_real d2;
} lobe_film_wave;

typedef struct {
	lobe_film_wave x, x2, y, z;
} lobe_film_waves;

/* Order 1. centre [1/nm], falloff: 2 pi^2 log2(e) times the variance [1/nm^2]. */
LOBE_FN lobe_film_wave lobe_film_wave_make(lobe_real opd, lobe_real centre, lobe_real falloff)
{
	const lobe_sincos t = lobe_sincos_2pi(opd * centre);
	const lobe_real d = lobe_exp2(-(opd * opd) * falloff);
	lobe_film_wave w;
	w.d2 = d * d;
	w.at = lobe_complex_make(d * t.c, d * t.s);
	w.step = lobe_complex_scale(w.at, w.d2);
	return w;
}

LOBE_FN lobe_film_wave lobe_film_wave_next(lobe_film_wave w)
{
	lobe_film_wave next;
	next.d2 = w.d2;
	next.at = lobe_complex_mul(w.at, w.step);
	next.step = lobe_complex_scale(w.step, w.d2);
	return next;
}

LOBE_FN lobe_film_waves lobe_film_waves_make(lobe_real opd)
{
	lobe_film_waves w;
	w.x = lobe_film_wave_make(opd, LOBE_R(1.6810e-3), LOBE_R(2.46491222e-7));
	w.x2 = lobe_film_wave_make(opd, LOBE_R(2.2399e-3), LOBE_R(2.57905068e-7));
	w.y = lobe_film_wave_make(opd, LOBE_R(1.7953e-3), LOBE_R(5.29946445e-7));
	w.z = lobe_film_wave_make(opd, LOBE_R(2.2084e-3), LOBE_R(3.76594254e-7));
	return w;
}

LOBE_FN lobe_film_waves lobe_film_waves_next(lobe_film_waves w)
{
	lobe_film_waves next;
	next.x = lobe_film_wave_next(w.x);
	next.x2 = lobe_film_wave_next(w.x2);
	next.y = lobe_film_wave_next(w.y);
	next.z = lobe_film_wave_next(w.z);
	return next;
}

/* One channel: the weights of the Gaussians in it. */
LOBE_FN lobe_complex lobe_film_channel(lobe_film_waves w, lobe_real x, lobe_real x2, lobe_real y, lobe_real z)
{
	return lobe_complex_make((x * w.x.at.re + x2 * w.x2.at.re) + (y * w.y.at.re + z * w.z.at.re),
				 (x * w.x.at.im + x2 * w.x2.at.im) + (y * w.y.at.im + z * w.z.at.im));
}

LOBE_FN lobe_film_colour lobe_film_colour_make(lobe_film_waves w)
{
	lobe_film_colour s;
	s.r = lobe_film_channel(w, LOBE_R(2.66236469), LOBE_R(0.48388658), LOBE_R(-1.66612412), LOBE_R(-0.48012715));
	s.g = lobe_film_channel(w, LOBE_R(-0.84242389), LOBE_R(-0.15311112), LOBE_R(1.95576345), LOBE_R(0.03977156));
	s.b = lobe_film_channel(w, LOBE_R(0.05381666), LOBE_R(0.00978121), LOBE_R(-0.21459656), LOBE_R(1.15099869));
	return s;
}

/* All that depends on OPD alone: S_1 to S_5, q, and 1 - Re q. */
typedef struct {
	lobe_film_colour s1, s2, s3, s4, s5, q;
	lobe_rgb less_q;
} lobe_film_series;

LOBE_FN lobe_film_series lobe_film_series_make(lobe_real opd)
{
	const lobe_film_waves w1 = lobe_film_waves_make(opd);
	const lobe_film_waves w2 = lobe_film_waves_next(w1);
	const lobe_film_waves w3 = lobe_film_waves_next(w2);
	const lobe_film_waves w4 = lobe_film_waves_next(w3);
	const lobe_film_waves w5 = lobe_film_waves_next(w4);
	lobe_film_series f;
	f.s1 = lobe_film_colour_make(w1);
	f.s2 = lobe_film_colour_make(w2);
	f.s3 = lobe_film_colour_make(w3);
	f.s4 = lobe_film_colour_make(w4);
	f.s5 = lobe_film_colour_make(w5);
	f.q.r = w5.x.step;
	f.q.g = w5.y.step;
	f.q.b = w5.z.step;
	f.less_q = lobe_rgb_make(LOBE_R(1.0) - f.q.r.re, LOBE_R(1.0) - f.q.g.re, LOBE_R(1.0) - f.q.b.re);
	return f;
}

/* One polarisation of one channel: z and the distance 1 - Re z, R and 1 - R of a thick film.
 *
 * Both interfaces of a dense film reflect nearly all, z comes near 1, and the series is as large as 1/(1 - z). Then 1 -
 * Re z is (1 - (Re z)^2)/(1 + Re z), where 1 - (Re z)^2 = (1 - |z|^2) + (Im z)^2 is made of what T12 and T23 know. */
typedef struct {
	lobe_complex z;
	lobe_real less_re, mean_r, mean_t;
} lobe_film_terms;

LOBE_FN lobe_film_terms lobe_film_terms_make(lobe_real r12, lobe_real t12, lobe_film_bottom bottom)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real top = r12 * r12;
	const lobe_real lost = lobe_max(top * bottom.t + t12, LOBE_R(0x1p-60)); /* 1 - |z|^2 */
	const lobe_real inv = one / lost;
	lobe_film_terms f;
	f.z = lobe_complex_scale(bottom.r, -r12);
	const lobe_real more = one + lobe_abs(f.z.re);
	const lobe_real less = (lost + f.z.im * f.z.im) / more;
	f.less_re = f.z.re > LOBE_R(0.0) ? less : more;
	f.mean_r = (top * bottom.t + lobe_complex_norm(bottom.r) * t12) * inv;
	f.mean_t = t12 * bottom.t * inv;
	return f;
}

/* Re sum_m z^m S_m of one channel. less_q: 1 - Re q. */
LOBE_FN lobe_real lobe_film_sum(lobe_film_terms f, lobe_complex s1, lobe_complex s2, lobe_complex s3, lobe_complex s4,
				lobe_complex s5, lobe_complex q, lobe_real less_q)
{
	const lobe_complex z = f.z;
	/* conj(1 - zq), its real part 1 - Re z + Re z (1 - Re q) + Im z Im q */
	const lobe_complex den =
		lobe_complex_make(f.less_re + (z.re * less_q + z.im * q.im), z.re * q.im + z.im * q.re);
	const lobe_real inv = LOBE_R(1.0) / lobe_max(lobe_complex_norm(den), LOBE_R(0x1p-60));
	const lobe_complex rest = lobe_complex_scale(lobe_complex_mul(s5, den), inv);
	lobe_complex sum = lobe_complex_add(s4, lobe_complex_mul(z, rest));
	sum = lobe_complex_add(s3, lobe_complex_mul(z, sum));
	sum = lobe_complex_add(s2, lobe_complex_mul(z, sum));
	sum = lobe_complex_add(s1, lobe_complex_mul(z, sum));
	return z.re * sum.re - z.im * sum.im;
}

/* The same where z is real, as it is over a dielectric: of the series only the real part remains. */
LOBE_FN lobe_real lobe_film_sum_real(lobe_film_terms f, lobe_complex s1, lobe_complex s2, lobe_complex s3,
				     lobe_complex s4, lobe_complex s5, lobe_complex q, lobe_real less_q)
{
	const lobe_real z = f.z.re;
	const lobe_complex den = lobe_complex_make(f.less_re + z * less_q, z * q.im);
	const lobe_real inv = LOBE_R(1.0) / lobe_max(lobe_complex_norm(den), LOBE_R(0x1p-60));
	const lobe_real rest = (s5.re * den.re - s5.im * den.im) * inv;
	return z * (s1.re + z * (s2.re + z * (s3.re + z * (s4.re + z * rest))));
}

/* Twice the transmittance (or reflectance) of unpolarised light: mean +- 2 A sum for each polarisation. */
LOBE_FN lobe_airy lobe_film_unpolarised(lobe_film_terms s, lobe_real sum_s, lobe_film_terms p, lobe_real sum_p)
{
	const lobe_real waves = s.mean_t * sum_s + p.mean_t * sum_p;
	const lobe_real zero = LOBE_R(0.0), one = LOBE_R(1.0), share = LOBE_R(0.5);
	lobe_airy a;
	a.reflectance = lobe_clamp(share * (s.mean_r + p.mean_r) - waves, zero, one);
	a.transmittance = lobe_clamp(share * (s.mean_t + p.mean_t) + waves, zero, one);
	return a;
}

#define LOBE_FILM_SUM(sum, f, channel, terms)                                                                          \
	sum(terms, (f).s1.channel, (f).s2.channel, (f).s3.channel, (f).s4.channel, (f).s5.channel, (f).q.channel,      \
	    (f).less_q.channel)

/* Reflectance of film over the metal eta + ik. c: cosine outside. */
LOBE_FN lobe_rgb lobe_thin_film_conductor_rgb(lobe_real c, lobe_film film, lobe_rgb eta, lobe_rgb k)
{
	const lobe_film_top top = lobe_film_top_make(c, film.index);
	const lobe_film_series f = lobe_film_series_make(lobe_film_opd(film, top));
	const lobe_film_bottoms r = lobe_film_bottoms_conductor(top, film.index, eta.r, k.r);
	const lobe_film_bottoms g = lobe_film_bottoms_conductor(top, film.index, eta.g, k.g);
	const lobe_film_bottoms b = lobe_film_bottoms_conductor(top, film.index, eta.b, k.b);
	const lobe_film_terms rs = lobe_film_terms_make(top.rs, top.ts, r.s);
	const lobe_film_terms rp = lobe_film_terms_make(top.rp, top.tp, r.p);
	const lobe_film_terms gs = lobe_film_terms_make(top.rs, top.ts, g.s);
	const lobe_film_terms gp = lobe_film_terms_make(top.rp, top.tp, g.p);
	const lobe_film_terms bs = lobe_film_terms_make(top.rs, top.ts, b.s);
	const lobe_film_terms bp = lobe_film_terms_make(top.rp, top.tp, b.p);
	const lobe_airy red = lobe_film_unpolarised(rs, LOBE_FILM_SUM(lobe_film_sum, f, r, rs), rp,
						    LOBE_FILM_SUM(lobe_film_sum, f, r, rp));
	const lobe_airy green = lobe_film_unpolarised(gs, LOBE_FILM_SUM(lobe_film_sum, f, g, gs), gp,
						      LOBE_FILM_SUM(lobe_film_sum, f, g, gp));
	const lobe_airy blue = lobe_film_unpolarised(bs, LOBE_FILM_SUM(lobe_film_sum, f, b, bs), bp,
						     LOBE_FILM_SUM(lobe_film_sum, f, b, bp));
	return lobe_rgb_make(red.reflectance, green.reflectance, blue.reflectance);
}

/* Reflectance and transmittance of film between two dielectrics, which add up to 1 to rounding, and their means over
 * the three channels. */
typedef struct {
	lobe_rgb reflectance, transmittance;
	lobe_real mean_reflectance, mean_transmittance;
} lobe_film_fresnel;

/* index of film and base, eta >= 1, over the outside. c: cosine outside. The reflectance from inside the base is the
 * same at the refracted cosine, and 1 beyond the angle of total reflection. */
LOBE_FN lobe_film_fresnel lobe_thin_film_dielectric_rgb(lobe_real c, lobe_film film, lobe_real eta)
{
	const lobe_film_top top = lobe_film_top_make(c, film.index);
	const lobe_film_series f = lobe_film_series_make(lobe_film_opd(film, top));
	const lobe_film_bottoms bottoms = lobe_film_bottoms_dielectric(top, film.index, eta);
	const lobe_film_terms s = lobe_film_terms_make(top.rs, top.ts, bottoms.s);
	const lobe_film_terms p = lobe_film_terms_make(top.rp, top.tp, bottoms.p);
	const lobe_airy red = lobe_film_unpolarised(s, LOBE_FILM_SUM(lobe_film_sum_real, f, r, s), p,
						    LOBE_FILM_SUM(lobe_film_sum_real, f, r, p));
	const lobe_airy green = lobe_film_unpolarised(s, LOBE_FILM_SUM(lobe_film_sum_real, f, g, s), p,
						      LOBE_FILM_SUM(lobe_film_sum_real, f, g, p));
	const lobe_airy blue = lobe_film_unpolarised(s, LOBE_FILM_SUM(lobe_film_sum_real, f, b, s), p,
						     LOBE_FILM_SUM(lobe_film_sum_real, f, b, p));
	lobe_film_fresnel r;
	r.reflectance = lobe_rgb_make(red.reflectance, green.reflectance, blue.reflectance);
	r.transmittance = lobe_rgb_make(red.transmittance, green.transmittance, blue.transmittance);
	r.mean_reflectance = lobe_rgb_mean(r.reflectance);
	r.mean_transmittance = lobe_rgb_mean(r.transmittance);
	return r;
}

#endif
