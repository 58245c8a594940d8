/* fresnel_exact.c - the amplitudes of a dielectric interface in 400 bits. */
#include "fresnel_exact.h"

#include <math.h>
#include <mpfr.h>
#include <stdio.h>

#include "measured.h"

enum { BITS = 400 };

/* Fresnel's amplitudes as textbooks print them, (cos_i - eta cos_t)/(cos_i + eta cos_t) and so on. */
exact_fresnel exact_dielectric(float c, float eta)
{
	static mpfr_t c1, n, g2, g, num, den, rs, rp, r;
	static int ready = 0;
	if (!ready) {
		mpfr_inits2(BITS, c1, n, g2, g, num, den, rs, rp, r, (mpfr_ptr)0);
		ready = 1;
	}
	exact_fresnel e;
	mpfr_set_flt(c1, c, MPFR_RNDN);
	mpfr_set_flt(n, eta, MPFR_RNDN);
	/* g = eta cos_t = sqrt(eta^2 - (1 - c^2)) */
	mpfr_sqr(g2, n, MPFR_RNDN);
	mpfr_sqr(r, c1, MPFR_RNDN);
	mpfr_add(g2, g2, r, MPFR_RNDN);
	mpfr_sub_ui(g2, g2, 1, MPFR_RNDN);
	e.edge = mpfr_get_d(g2, MPFR_RNDN);
	if (mpfr_sgn(g2) <= 0) {
		e.reflectance = 1.0;
		e.transmittance = 0.0;
		e.cos_t = 0.0;
		e.rp = 1.0;
		return e;
	}
	mpfr_sqrt(g, g2, MPFR_RNDN);
	mpfr_div(r, g, n, MPFR_RNDN);
	e.cos_t = mpfr_get_d(r, MPFR_RNDN);
	mpfr_sub(num, c1, g, MPFR_RNDN);
	mpfr_add(den, c1, g, MPFR_RNDN);
	mpfr_div(rs, num, den, MPFR_RNDN);
	mpfr_mul(c1, c1, n, MPFR_RNDN); /* eta cos_i against cos_t, both times eta */
	mpfr_mul(c1, c1, n, MPFR_RNDN);
	mpfr_sub(num, c1, g, MPFR_RNDN);
	mpfr_add(den, c1, g, MPFR_RNDN);
	mpfr_div(rp, num, den, MPFR_RNDN);
	e.rp = mpfr_get_d(rp, MPFR_RNDN);
	mpfr_sqr(rs, rs, MPFR_RNDN);
	mpfr_sqr(rp, rp, MPFR_RNDN);
	mpfr_add(r, rs, rp, MPFR_RNDN);
	mpfr_div_ui(r, r, 2, MPFR_RNDN);
	e.reflectance = mpfr_get_d(r, MPFR_RNDN);
	mpfr_ui_sub(r, 1, r, MPFR_RNDN);
	e.transmittance = mpfr_get_d(r, MPFR_RNDN);
	return e;
}

float cosine(int i)
{
	if (i < 200)
		return (float)pow(10.0, -7.0 * (200 - i) / 200.0);
	if (i < 500)
		return (float)((i - 199) / 301.0);
	if (i < 599)
		return (float)(1.0 - pow(10.0, -7.2 * (i - 499) / 100.0));
	return 1.0f;
}

float index_of(int i)
{
	if (i < 200)
		return (float)pow(10.0, 3.0 * (i - 100) / 100.0);
	if (i < 225)
		return (float)(1.0 + ldexp(1.0, -(i - 200 + 1) > -23 ? -(i - 200 + 1) : -23));
	if (i < 250)
		return (float)(1.0 - ldexp(1.0, -(i - 225 + 1) > -24 ? -(i - 225 + 1) : -24));
	const float common[] = {1.0f, 1.33f, 1.5f, 1.0f / 1.33f, 1.0f / 1.5f, 2.42f, 4.0f, 0.25f, 0.001f, 1000.0f};
	return common[i - 250];
}

void keep_worst(worst *w, double value, float c, float eta)
{
	/* Not <=, so that a NaN is kept. */
	if (!(value <= w->value)) {
		w->value = value;
		w->c = c;
		w->eta = eta;
	}
}

void measured_at(const char *what, worst w, double bound)
{
	measured(what, w.value, bound);
	printf("  %60s at c = %.9g, eta = %.9g\n", "", (double)w.c, (double)w.eta);
}
