/* textbook.h - microfacet formulas in double as the papers print them: normalised half vector, tangents, Lambda. They
 * share no code and no rearrangement with the library. */
#ifndef LOBE_TESTS_TEXTBOOK_H
#define LOBE_TESTS_TEXTBOOK_H

double textbook_dot(const double a[3], const double b[3]);
void textbook_normalize(double v[3]);

typedef enum { TEXTBOOK_GGX, TEXTBOOK_BECKMANN } textbook_ndf;

/* D(m), Lambda(w) and G1 = 1/(1 + Lambda) of anisotropic GGX: Heitz 2014, eqs. 85, 86 and 43. */
double textbook_ggx_d(double ax, double ay, const double m[3]);
double textbook_ggx_lambda(double ax, double ay, const double w[3]);

/* D(m) and Lambda(w) of either: Beckmann's are eqs. 80 and 83. */
double textbook_d(textbook_ndf ndf, double ax, double ay, const double m[3]);
double textbook_lambda(textbook_ndf ndf, double ax, double ay, const double w[3]);

/* Reflectance; eta: far index over near index. Walter et al. 2007, eq. 22. */
double textbook_fresnel(double c, double eta);

/* Reflectance of a conductor n + ik: |r_s|^2 and |r_p|^2 of the Fresnel equations in complex numbers. */
double textbook_fresnel_conductor(double c, double n, double k);

/* Reflectance of a film of index nf, d thick, on a base n + ik, seen from a medium of index n0 at cosine c in it; d and
 * the vacuum wavelength in one unit. Fresnel's amplitudes in complex numbers, Airy's sum (Born and Wolf, 1.6.4, eq.
 * 57): also where a film reflects totally. */
double textbook_airy(double c, double n0, double nf, double d, double n, double k, double wavelength);

/* f |cos theta_i| of a rough conductor: F D G2/(4 cos theta_o), height-correlated (Heitz 2014, eq. 99). */
double textbook_rough_metal(textbook_ndf ndf, double ax, double ay, double n, double k, const double wo[3],
			    const double wi[3]);

/* f |cos theta_i| of rough glass for light from wi seen from wo: eqs. 20 and 21 of Walter et al. 2007 with eta_o the
 * index of wo's side. Height-correlated masking for a reflection, G1 G1 for a refraction. */
double textbook_rough_glass(textbook_ndf ndf, double ax, double ay, double eta, const double wo[3], const double wi[3]);

#endif
