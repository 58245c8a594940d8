#include "textbook.h"

#include "support.h"

#include <complex.h>
#include <math.h>

double textbook_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void textbook_normalize(double v[3])
{
	const double n = sqrt(textbook_dot(v, v));
	for (int k = 0; k < 3; k++)
		v[k] /= n;
}

double textbook_ggx_d(double ax, double ay, const double m[3])
{
	if (m[2] <= 0.0)
		return 0.0;
	const double cos2 = m[2] * m[2];
	const double sum = m[0] * m[0] / (ax * ax) / cos2 + m[1] * m[1] / (ay * ay) / cos2;
	return 1.0 / (PI * ax * ay * cos2 * cos2 * (1.0 + sum) * (1.0 + sum));
}

double textbook_ggx_lambda(double ax, double ay, const double w[3])
{
	const double a2_tan2 = (ax * ax * w[0] * w[0] + ay * ay * w[1] * w[1]) / (w[2] * w[2]);
	return (sqrt(1.0 + a2_tan2) - 1.0) / 2.0;
}

static double beckmann_d(double ax, double ay, const double m[3])
{
	if (m[2] <= 0.0)
		return 0.0;
	const double cos2 = m[2] * m[2];
	const double sum = m[0] * m[0] / (ax * ax) / cos2 + m[1] * m[1] / (ay * ay) / cos2;
	return exp(-sum) / (PI * ax * ay * cos2 * cos2);
}

/* (erf(a) - 1)/2 as -erfc(a)/2, which alone keeps its digits for large a. */
static double beckmann_lambda(double ax, double ay, const double w[3])
{
	const double a = fabs(w[2]) / sqrt(ax * ax * w[0] * w[0] + ay * ay * w[1] * w[1]);
	return a < 26.0 ? exp(-a * a) / (2.0 * a * sqrt(PI)) - erfc(a) / 2.0 : 0.0;
}

double textbook_d(textbook_ndf ndf, double ax, double ay, const double m[3])
{
	return ndf == TEXTBOOK_BECKMANN ? beckmann_d(ax, ay, m) : textbook_ggx_d(ax, ay, m);
}

double textbook_lambda(textbook_ndf ndf, double ax, double ay, const double w[3])
{
	return ndf == TEXTBOOK_BECKMANN ? beckmann_lambda(ax, ay, w) : textbook_ggx_lambda(ax, ay, w);
}

double textbook_fresnel(double c, double eta)
{
	const double g2 = eta * eta - 1.0 + c * c;
	if (eta == 1.0)
		return 0.0;
	if (g2 <= 0.0)
		return 1.0;
	const double g = sqrt(g2);
	const double s = (g - c) / (g + c);
	const double p = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
	return 0.5 * s * s * (1.0 + p * p);
}

/* |(a - b)/(a + b)|^2 of complex a and b. */
static double ratio2(double ar, double ai, double br, double bi)
{
	return ((ar - br) * (ar - br) + (ai - bi) * (ai - bi)) / ((ar + br) * (ar + br) + (ai + bi) * (ai + bi));
}

double textbook_fresnel_conductor(double c, double n, double k)
{
	/* N cos theta_t = root of N^2 - sin^2, in the first quadrant. */
	const double re = n * n - k * k - (1.0 - c * c), im = 2.0 * n * k;
	const double arg = 0.5 * atan2(im, re), size = sqrt(hypot(re, im));
	const double root_re = size * cos(arg), root_im = size * sin(arg);
	const double s = ratio2(c, 0.0, root_re, root_im);
	const double p = ratio2((n * n - k * k) * c, im * c, root_re, root_im);
	return 0.5 * (s + p);
}

/* r_s and r_p between media a and b, ca and cb the cosines in them. */
static double complex amplitude(double complex na, double complex ca, double complex nb, double complex cb, int p)
{
	return p ? (nb * ca - na * cb) / (nb * ca + na * cb) : (na * ca - nb * cb) / (na * ca + nb * cb);
}

/* The cosine in a medium of index n, for the sine times index s of all layers. */
static double complex cosine_in(double complex n, double s)
{
	const double complex root = csqrt(1.0 - s * s / (n * n));
	return cimag(n * root) < 0.0 ? -root : root;
}

double textbook_airy(double c, double n0, double nf, double d, double n, double k, double wavelength)
{
	const double s = n0 * sqrt((1.0 - c) * (1.0 + c));
	const double complex nb = n + k * (double complex)I, cf = cosine_in(nf, s), cb = cosine_in(nb, s);
	const double complex turn = cexp((double complex)I * 4.0 * PI * nf * cf * d / wavelength);
	double sum = 0.0;
	for (int p = 0; p < 2; p++) {
		const double complex top = amplitude(n0, c, nf, cf, p), bottom = amplitude(nf, cf, nb, cb, p);
		const double r = cabs((top + bottom * turn) / (1.0 + top * bottom * turn));
		sum += 0.5 * r * r;
	}
	return sum;
}

double textbook_rough_metal(textbook_ndf ndf, double ax, double ay, double n, double k, const double wo[3],
			    const double wi[3])
{
	double h[3];
	for (int i = 0; i < 3; i++)
		h[i] = wo[i] + wi[i];
	textbook_normalize(h);
	if (wo[2] <= 0.0 || wi[2] <= 0.0)
		return 0.0;
	const double g = 1.0 / (1.0 + textbook_lambda(ndf, ax, ay, wo) + textbook_lambda(ndf, ax, ay, wi));
	const double f = textbook_fresnel_conductor(textbook_dot(wo, h), n, k);
	return f * textbook_d(ndf, ax, ay, h) * g / (4.0 * wo[2]);
}

double textbook_rough_glass(textbook_ndf ndf, double ax, double ay, double eta, const double wo[3], const double wi[3])
{
	const double eta_o = wo[2] > 0.0 ? 1.0 : eta;
	const double eta_i = wi[2] > 0.0 ? 1.0 : eta;
	const int reflects = wo[2] * wi[2] > 0.0;
	double h[3];
	for (int k = 0; k < 3; k++)
		h[k] = reflects ? wo[k] + wi[k] : -(eta_i * wi[k] + eta_o * wo[k]);
	textbook_normalize(h);
	/* Facets are oriented towards +z; which side light comes from is told by the signs of o.h and i.h. */
	if (h[2] < 0.0)
		for (int k = 0; k < 3; k++)
			h[k] = -h[k];
	const double oh = textbook_dot(wo, h);
	const double ih = textbook_dot(wi, h);
	if (oh * wo[2] <= 0.0 || ih * wi[2] <= 0.0)
		return 0.0;
	const double d = textbook_d(ndf, ax, ay, h);
	const double lo = textbook_lambda(ndf, ax, ay, wo);
	const double li = textbook_lambda(ndf, ax, ay, wi);
	if (reflects) {
		const double f = textbook_fresnel(fabs(oh), wo[2] > 0.0 ? eta : 1.0 / eta);
		return f * d / (1.0 + lo + li) / (4.0 * fabs(wo[2]));
	}
	const double f = textbook_fresnel(fabs(ih), eta_o / eta_i);
	const double g = 1.0 / ((1.0 + lo) * (1.0 + li));
	const double den = eta_i * ih + eta_o * oh;
	return fabs(ih) * fabs(oh) / fabs(wo[2]) * eta_o * eta_o * (1.0 - f) * g * d / (den * den);
}
