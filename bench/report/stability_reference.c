/* stability_reference.c - the textbook in long double (64 bits on x86) and in 113 bits. */
#include "stability_reference.h"

#include <float.h>
#include <math.h>

#include "double.h"

#define REAL         long double
#define REAL_(name)  name##_long
#define REAL_SQRT(x) sqrtl(x)
#define REAL_EXP(x)  expl(x)
#define REAL_ERFC(x) erfcl(x)
#define REAL_SIN(x)  sinl(x)
#define REAL_COS(x)  cosl(x)
#define REAL_FABS(x) fabsl(x)
#define REAL_PI      3.14159265358979323846264338327950288L
#include "stability_textbook.h"
#undef REAL
#undef REAL_
#undef REAL_SQRT
#undef REAL_EXP
#undef REAL_ERFC
#undef REAL_SIN
#undef REAL_COS
#undef REAL_FABS
#undef REAL_PI

long double stability_exact(stability_question q, const long double x[STABILITY_INPUTS])
{
	return q.verb == STABILITY_DIRECTION ? direction_long(q, x, x + 3, x + 6) : lobe_long(q, x, x + 3, x + 6);
}

long double stability_exact_part(stability_part part, const long double *x) { return part_long(part, x); }

/* Where long double is no wider than that already (aarch64) or there is no such type, nothing is added. */
#if defined(__SIZEOF_FLOAT128__) && LDBL_MANT_DIG == 64
/* libquadmath's, declared here since clang does not have its header. */
extern __float128 sqrtq(__float128), expq(__float128), erfcq(__float128), sinq(__float128), cosq(__float128),
	fabsq(__float128);
#define REAL         __float128
#define REAL_(name)  name##_quad
#define REAL_SQRT(x) sqrtq(x)
#define REAL_EXP(x)  expq(x)
#define REAL_ERFC(x) erfcq(x)
#define REAL_SIN(x)  sinq(x)
#define REAL_COS(x)  cosq(x)
#define REAL_FABS(x) fabsq(x)
/* In two parts, as C99 has no constant of the type. */
#define REAL_PI ((__float128)0x1.921fb54442d18p+1 + (__float128)0x1.1a62633145c07p-53)
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function" /* parts */
#endif
#include "stability_textbook.h"

long double stability_exacter(stability_question q, const long double x[STABILITY_INPUTS])
{
	__float128 wide[STABILITY_INPUTS];
	for (int k = 0; k < STABILITY_INPUTS; k++)
		wide[k] = x[k];
	return (long double)(q.verb == STABILITY_DIRECTION ? direction_quad(q, wide, wide + 3, wide + 6)
							   : lobe_quad(q, wide, wide + 3, wide + 6));
}
#else
long double stability_exacter(stability_question q, const long double x[STABILITY_INPUTS])
{
	return stability_exact(q, x);
}
#endif

double stability_double_build(stability_question q, const long double x[STABILITY_INPUTS])
{
	double wo[3], wi[3], p[CASE_PARAMETERS], f[3];
	for (int k = 0; k < 3; k++) {
		wo[k] = (double)x[k];
		wi[k] = (double)x[3 + k];
	}
	for (int k = 0; k < CASE_PARAMETERS; k++)
		p[k] = (double)x[6 + k];
	const double pdf = q.verb == STABILITY_EVAL ? 0.0 : double_pdf(q.kind, p, wo, wi);
	if (q.verb == STABILITY_PDF)
		return pdf;
	double_eval(q.kind, p, wo, wi, f);
	return q.verb == STABILITY_EVAL ? f[q.channel] : pdf > 0.0 ? f[q.channel] / pdf : 0.0;
}
