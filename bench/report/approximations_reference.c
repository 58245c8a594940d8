/* approximations_reference.c - the references once more in long double: what their double precision is off by.
 *
 * The same equations as tests/textbook.c prints them, in another arrangement where there is one, so that a reference's
 * error is measured, not estimated. Where long double is double's twin (some ARM ABIs) it measures the arrangement
 * alone. */
#include <complex.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

#include "approximations.h"
#include "real_reference.h"

#define SQRT_PI 1.772453850905516027298167483341145183L

/* Walter et al. 2007, eq. 22, by the refracted cosine; the Fresnel equations in complex numbers. */
double approximations_doubt_fresnel(double exact, double c, double n, double k)
{
	const long double z = (long double)c, sine2 = (1.0L - z) * (1.0L + z);
	const long double complex index = (long double)n + (long double)k * (long double complex)I;
	const long double complex root = csqrtl(index * index - sine2);
	const long double s = cabsl((z - root) / (z + root));
	const long double p = cabsl((index * index * z - root) / (index * index * z + root));
	return (double)fabsl(0.5L * (s * s + p * p) - (long double)exact);
}

/* 1/(1 + Lambda) of Beckmann at a = cot theta/alpha. */
double approximations_doubt_beckmann_g1(double exact, double a_in)
{
	const long double a = (long double)a_in;
	const long double lambda = 0.5L * (expl(-a * a) / (a * SQRT_PI) - erfcl(a));
	return (double)fabsl(1.0L / (1.0L + lambda) - (long double)exact);
}

static long double ggx_lambda(double alpha, const double w[3])
{
	const long double a = (long double)alpha;
	const long double x = (long double)w[0], y = (long double)w[1], z = (long double)w[2];
	const long double slope2 = a * a * (x * x + y * y) / (z * z);
	return 0.5L * slope2 / (1.0L + sqrtl(1.0L + slope2));
}

double approximations_doubt_ggx_g2(double exact, double alpha, const double o[3], const double i[3], int across)
{
	const long double lo = ggx_lambda(alpha, o), li = ggx_lambda(alpha, i);
	const long double both = across ? expl(lgammal(1.0L + lo) + lgammal(1.0L + li) - lgammal(2.0L + lo + li))
					: 1.0L / (1.0L + lo + li);
	return (double)fabsl(both - (long double)exact);
}

/* Relative. D of the facet with tan theta/alpha = t over that of the level one, and |z| Lambda at cot
 * theta/alpha = t. */
double approximations_doubt_density(double exact, int beckmann, double t_in)
{
	const long double t = (long double)t_in, square = 1.0L + t * t;
	return (double)fabsl((beckmann ? expl(-t * t) : 1.0L / (square * square)) / (long double)exact - 1.0L);
}

double approximations_doubt_hidden(double exact, int beckmann, double t_in)
{
	const long double t = (long double)t_in;
	const long double hidden =
		beckmann ? 0.5L * (expl(-t * t) / SQRT_PI - t * erfcl(t)) : 0.5L * (sqrtl(1.0L + t * t) - t);
	return (double)fabsl(hidden / (long double)exact - 1.0L);
}

/* In ulp of a float, from MPFR's value. */
double approximations_doubt_real(const char *name, double reference, float x, float y)
{
	mpfr_t exact, other;
	double off = 0.0;
	int known = 1;
	mpfr_inits2(REFERENCE_BITS, exact, other, (mpfr_ptr)0);
	mpfr_set_flt(exact, x, MPFR_RNDN);
	mpfr_set_flt(other, y, MPFR_RNDN);
	if (strcmp(name, "pow") == 0) {
		mpfr_pow(exact, exact, other, MPFR_RNDN);
	} else if (strcmp(name, "atan2") == 0) {
		mpfr_atan2(exact, exact, other, MPFR_RNDN);
	} else {
		known = 0;
		for (size_t i = 0; i < REAL_FUNCTION_COUNT; i++)
			if (strcmp(real_functions[i].name, name) == 0) {
				real_functions[i].exact(exact, x);
				known = 1;
			}
	}
	if (known && mpfr_number_p(exact) && !mpfr_zero_p(exact)) {
		const mpfr_exp_t e = mpfr_get_exp(exact) - 1;
		mpfr_sub_d(other, exact, reference, MPFR_RNDN);
		off = fabs(mpfr_get_d(other, MPFR_RNDN)) * ldexp(1.0, 23 - (int)(e < -126 ? -126 : e));
	}
	mpfr_clears(exact, other, (mpfr_ptr)0);
	return known ? off : HUGE_VAL;
}
