/* fresnel_exact.h - Fresnel's formulas by MPFR, the angles and indices at which tests ask, and where the worst of them
 * is. */
#ifndef LOBE_TESTS_FRESNEL_EXACT_H
#define LOBE_TESTS_FRESNEL_EXACT_H

#define U 0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */

typedef struct {
	double reflectance, transmittance, cos_t;
	double rp;   /* amplitude of the polarisation that vanishes at Brewster's angle */
	double edge; /* g^2: how far c^2 is from total reflection, < 0 at total reflection */
} exact_fresnel;

/* To 400 bits: R = (eta - 1)^2/4 is 1e-15 next to terms of 1, and T = 1 - R is formed by subtraction. c: cosine of the
 * incident side; eta: far index over near. */
exact_fresnel exact_dielectric(float c, float eta);

/* Cosine number i < COSINES: from 1e-7 to 1, by powers, by equal steps, and close to 1. */
enum { COSINES = 600 };
float cosine(int i);

/* Index number i < INDICES: from 1/1000 to 1000, 1 +- 2^-k, 1. */
enum { INDICES = 260 };
float index_of(int i);

/* A maximum and the arguments where it was found. */
typedef struct {
	double value;
	float c, eta;
} worst;

void keep_worst(worst *w, double value, float c, float eta);
void measured_at(const char *what, worst w, double bound);

#endif
