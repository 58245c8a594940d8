/* student_t.h - slopes of Student's t-distribution: from GGX (gamma = 2) to Beckmann (gamma -> infinity), and with
 * heavier tails than GGX below 2.
 *
 * Ribardiere et al. 2017, "STD: Student's t-Distribution of Slopes for Microfacet Based BSDFs". The functions are those
 * that facet.h explains; width 1 is theirs, D = cos^-4 (1 + tan^2/(gamma - 1))^-gamma/pi.
 *
 * Masking is exact (by table): with z = cot theta, s^2 = gamma - 1 and T the upper tail of Student's distribution of 2
 * gamma - 2 degrees of freedom, Lambda = C s^2 (1 + z^2/s^2)^(3/2 - gamma)/((2 gamma - 3) z) - T, C = Gamma(gamma -
 * 1/2) (gamma - 1)/(sqrt(pi) Gamma(gamma) s). The two terms cancel where Lambda is small; h of profile.h does not.
 * Below gamma = 3/2 the mean slope, and with it the area seen at grazing, is infinite.
 *
 * Largest relative error, single precision against quadrature, gamma = 1.6 to 1000 (tests/test_distributions.c):
 * density 2e-6, hidden 3e-6, tail 2e-6 where the value is above 1e-4 of its largest; 2e-5 each down to 1e-33 of it.
 * Lambda against the closed form above, gamma = 1.501 to 1000: 2e-6 (tests/test_distributions_forms.c). */
#ifndef LOBE_MICROFACET_STUDENT_T_H
#define LOBE_MICROFACET_STUDENT_T_H

#include "../core/powers.h"
#include "profile_visible.h"
#include "shape.h"

/* gamma > 3/2 by a thousandth at least, where the mean slope is 500 times the median. */
#define LOBE_STUDENT_T_GAMMA_MIN LOBE_R(1.501)
#define LOBE_STUDENT_T_GAMMA_MAX LOBE_R(1e+8)

/* d.exponent: gamma. d.norm: 1/(gamma - 1). */
LOBE_FN lobe_facet_density lobe_student_t_density(lobe_distribution d, lobe_vec3 h)
{
	const lobe_real r2 = lobe_vec3_xy2(h) * d.norm;
	const lobe_real z2 = h.z * h.z;
	lobe_facet_density f;
	f.inv = LOBE_R(1.0) / (r2 + z2);
	f.factor = lobe_decay(r2 / z2, d.exponent - LOBE_R(2.0));
	return f;
}

LOBE_FN lobe_real lobe_student_t_hidden(lobe_distribution d, lobe_vec3 v) { return lobe_profile_hidden(d.table, v); }
LOBE_FN lobe_real lobe_student_t_tail(lobe_distribution d, lobe_real t2)
{
	return lobe_decay(t2 * d.norm, d.exponent - LOBE_R(1.0));
}
LOBE_FN lobe_real lobe_student_t_tail_inverse(lobe_distribution d, lobe_real q)
{
	return lobe_decay_inverse(q, d.norm) / d.norm;
}
LOBE_FN lobe_vec3 lobe_student_t_visible(lobe_distribution d, lobe_vec3 v, lobe_vec2 u)
{
	return lobe_profile_visible(d.table, v, u);
}

/* Gamma(x)/Gamma(x + 1/2), x >= 1: 8 steps of the recurrence up to where the asymptotic series holds (3e-9). */
LOBE_FN lobe_real lobe_gamma_ratio(lobe_real x)
{
	lobe_real product = LOBE_R(1.0);
	for (lobe_uint i = 0u; i < 8u; i++) {
		product *= (x + LOBE_R(0.5)) / x;
		x += LOBE_R(1.0);
	}
	const lobe_real y = LOBE_R(1.0) / x;
	lobe_real p = LOBE_R(-6.40869140625e-04);
	p = lobe_fma(p, y, LOBE_R(4.8828125e-03));
	p = lobe_fma(p, y, LOBE_R(7.8125e-03));
	p = lobe_fma(p, y, LOBE_R(-0.125));
	return product / (lobe_sqrt(x) * lobe_fma(p, y, LOBE_R(1.0)));
}

/* For comparison, hidden(v) by the rational fit that the paper gives for the second term of Lambda. Some programs carry
 * a wrong sign in front of 14.402, which makes Lambda negative. The fit is absolute: measured .0071 of Lambda for gamma
 * = 1.6 to 10 and cot theta .05 to 5, and below 0 where Lambda is small. */
LOBE_FN lobe_real lobe_student_t_hidden_fit(lobe_distribution d, lobe_vec3 v)
{
	const lobe_real g = d.exponent;
	const lobe_real one = LOBE_R(1.0);
	const lobe_real s = lobe_sqrt(lobe_vec3_xy2(v));
	const lobe_real height = lobe_abs(v.z);
	const lobe_real z = height / s;
	const lobe_real root = lobe_sqrt(g - one);

	const lobe_real n21 = lobe_fma(lobe_fma(LOBE_R(4.892), z, LOBE_R(2.655)), z, LOBE_R(1.066)) * z;
	const lobe_real d21 =
		lobe_fma(lobe_fma(lobe_fma(LOBE_R(4.418), z, LOBE_R(4.305)), z, LOBE_R(2.969)), z, LOBE_R(1.038));
	const lobe_real n22 =
		lobe_fma(lobe_fma(lobe_fma(LOBE_R(-2.745), g, LOBE_R(20.574)), g, LOBE_R(-27.145)), g, LOBE_R(14.402));
	const lobe_real d22 =
		lobe_fma(lobe_fma(lobe_fma(LOBE_R(29.938), g, LOBE_R(-84.341)), g, LOBE_R(86.567)), g, LOBE_R(-30.612));
	const lobe_real n23 = lobe_fma(lobe_fma(lobe_fma(LOBE_R(93.268), g, LOBE_R(-299.305)), g, LOBE_R(324.987)), g,
				       LOBE_R(-129.404));
	const lobe_real d23 = lobe_fma(lobe_fma(lobe_fma(LOBE_R(86.064), g, LOBE_R(-245.663)), g, LOBE_R(256.006)), g,
				       LOBE_R(-92.609));
	const lobe_real n24 =
		lobe_fma(lobe_fma(lobe_fma(LOBE_R(5.223), z, LOBE_R(-0.623)), z, LOBE_R(6.074)), z, LOBE_R(6.537));
	const lobe_real d24 =
		lobe_fma(lobe_fma(lobe_fma(LOBE_R(6.347), z, LOBE_R(-3.218)), z, LOBE_R(6.103)), z, LOBE_R(6.538));
	const lobe_real second = n21 / d21 * lobe_fma(n23 / d23, n24 / d24, n22 / d22);

	/* The first term times z, so that it holds at the horizon: (gamma - 1)^(3/2) (1 + z^2/(gamma - 1))^(3/2 -
	 * gamma). */
	const lobe_real first =
		(g - one) * root * lobe_decay(z * z * d.norm, g - LOBE_R(1.5)) / (LOBE_R(2.0) * g - LOBE_R(3.0));
	const lobe_real c = lobe_gamma_ratio(g - LOBE_R(0.5)) * LOBE_R(0.564189583547756287);
	return s * (c * lobe_fma(root * z, second, first) - LOBE_R(0.5) * z);
}

#endif
