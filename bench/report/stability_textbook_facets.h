/* stability_textbook_facets.h - what stability_textbook.h makes its lobes of: Fresnel's formulas, D, Lambda, masking,
 * and reflection and refraction by a facet. A part of that template, included by it once for each type. */

static REAL REAL_(dot)(const REAL a[3], const REAL b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Reflectance of a dielectric; c: cosine on the near side, eta: far index over near index. Walter et al. 2007, eq.
 * 22. */
static REAL REAL_(fresnel)(REAL c, REAL eta)
{
	const REAL g2 = eta * eta - 1 + c * c;
	if (eta == 1)
		return 0;
	if (g2 <= 0)
		return 1;
	const REAL g = REAL_SQRT(g2);
	const REAL s = (g - c) / (g + c);
	const REAL p = (c * (g + c) - 1) / (c * (g - c) + 1);
	return s * s * (1 + p * p) / 2;
}

/* Transmittance: 1 - F, which cancels, so the digits that are left are counted by comparing two types. Without an
 * interface everything passes, also at c = 0. */
static REAL REAL_(transmittance)(REAL c, REAL eta) { return 1 - REAL_(fresnel)(c, eta); }

/* |(a - b)/(a + b)|^2 of complex a and b. */
static REAL REAL_(ratio2)(REAL ar, REAL ai, REAL br, REAL bi)
{
	return ((ar - br) * (ar - br) + (ai - bi) * (ai - bi)) / ((ar + br) * (ar + br) + (ai + bi) * (ai + bi));
}

/* Reflectance of a conductor n + ik: the mean of |r_s|^2 and |r_p|^2, with the complex N cos theta_t = sqrt(N^2 -
 * sin^2) in the first quadrant. */
static REAL REAL_(fresnel_conductor)(REAL c, REAL n, REAL k)
{
	const REAL re = n * n - k * k - (1 - c * c), im = 2 * n * k;
	const REAL size = REAL_SQRT(re * re + im * im);
	/* The larger part from the half angle, the other from the product of the two. */
	const REAL large = REAL_SQRT((size + REAL_FABS(re)) / 2);
	const REAL small = large > 0 ? im / (2 * large) : 0;
	const REAL root_re = re >= 0 ? large : small, root_im = re >= 0 ? small : large;
	if (n == 1 && k == 0)
		return 0;
	return (REAL_(ratio2)(c, 0, root_re, root_im) + REAL_(ratio2)((n * n - k * k) * c, im * c, root_re, root_im)) /
	       2;
}

/* Schlick 1994 between f0 and f90. */
static REAL REAL_(schlick)(REAL c, REAL f0, REAL f90)
{
	const REAL m = 1 - c;
	return f0 + (f90 - f0) * m * m * m * m * m;
}

/* Slopes s of the surface of width 1 become A s + mean. */
typedef struct {
	REAL xx, xy, yx, yy, mean_x, mean_y;
	int beckmann;
} REAL_(surface);

/* D(m) = P22(-m.x/m.z, -m.y/m.z)/m.z^4 with P22 that of A^-1 (slope - mean), over |det A|: Heitz 2014, section 5.3,
 * eqs. 80 and 85 where A is diagonal; Dupuy et al. 2013. */
static REAL REAL_(d)(REAL_(surface) s, const REAL m[3])
{
	if (m[2] <= 0)
		return 0;
	const REAL det = s.xx * s.yy - s.xy * s.yx;
	const REAL x = -m[0] / m[2] - s.mean_x, y = -m[1] / m[2] - s.mean_y;
	const REAL t_x = (s.yy * x - s.xy * y) / det, t_y = (s.xx * y - s.yx * x) / det;
	const REAL r2 = t_x * t_x + t_y * t_y;
	const REAL p22 = s.beckmann ? REAL_EXP(-r2) / REAL_PI : 1 / (REAL_PI * (1 + r2) * (1 + r2));
	return p22 / (REAL_FABS(det) * m[2] * m[2] * m[2] * m[2]);
}

/* What a direction sees: z, the mean plane's area (0 from its back), and h = |z| Lambda, that of the facets which face
 * away. Lambda = (sqrt(1 + 1/a^2) - 1)/2, or exp(-a^2)/(2 a sqrt pi) - erfc(a)/2, with a the cotangent over the width
 * in the direction (Heitz 2014, eqs. 86 and 83), both times |z|. */
typedef struct {
	REAL z, h;
} REAL_(seen);

static REAL_(seen) REAL_(see)(REAL_(surface) s, const REAL w[3])
{
	const REAL x = s.xx * w[0] + s.yx * w[1], y = s.xy * w[0] + s.yy * w[1];
	const REAL z = w[2] - s.mean_x * w[0] - s.mean_y * w[1];
	const REAL r = REAL_SQRT(x * x + y * y), a = r > 0 ? REAL_FABS(z) / r : 0;
	REAL_(seen) seen;
	seen.z = z > 0 ? z : 0;
	if (r == 0)
		seen.h = 0;
	else if (s.beckmann)
		seen.h = r * REAL_EXP(-a * a) / (2 * REAL_SQRT(REAL_PI)) - REAL_FABS(z) * REAL_ERFC(a) / 2;
	else
		seen.h = (REAL_SQRT(r * r + z * z) - REAL_FABS(z)) / 2;
	return seen;
}

/* G2 over the mean plane's area as o sees it: 1/(1 + Lambda_o + Lambda_i) on one side (eq. 99), the product of the two
 * G1 where that is asked for, both over z_o. 0 where i sees the mean plane's back. */
static REAL REAL_(g2_over_cos)(REAL_(seen) o, REAL_(seen) i, int separable)
{
	if (!(i.z > 0))
		return 0;
	return separable ? i.z / ((o.z + o.h) * (i.z + i.h)) : 1 / (o.z + o.h + o.z * i.h / i.z);
}

/* Reflection and refraction by a facet: reflectance f or transmittance of it given, value and density and weight of
 * what it makes of the light. */
typedef struct {
	REAL eval, pdf,
		weight; /* eval: of reflectance 1; pdf: the event being chosen with probability 1; weight: their ratio */
	REAL cosine;
	int there;
} REAL_(facet);

/* The share of the cap below the mean plane's horizon that is sampled of GGX for reflections: Eto and Tokuyoshi 2023,
 * with the sine from above, by the tangents that core/real.h has. */
static REAL REAL_(bounded)(REAL_(surface) s, const REAL o[3])
{
	const REAL a = s.xx < s.yy ? s.xx : s.yy, sine2 = o[0] * o[0] + o[1] * o[1];
	REAL r = (3 + sine2) / 2;
	for (REAL at = 1; at > (REAL)1e-18; at /= 2) {
		const REAL tangent = 1 + (at + sine2 / at) / 2;
		r = r < tangent ? r : tangent;
	}
	/* Of the cosine that has that sine. */
	return (1 - a * a) * r * r / (r * r + a * a * r * (2 - r));
}

/* o and i above the surface. Cook and Torrance 1982, Walter et al. 2007, eq. 20; Heitz and d'Eon 2014 for the
 * density, and k as above, or 1. */
static REAL_(facet) REAL_(reflection)(REAL_(surface) s, const REAL o[3], const REAL i[3], int separable, REAL k)
{
	REAL_(facet) f = {0, 0, 0, 0, 0};
	REAL h[3];
	for (int j = 0; j < 3; j++)
		h[j] = o[j] + i[j];
	const REAL length = REAL_SQRT(REAL_(dot)(h, h));
	if (!(length > 0) || !(o[2] > 0) || !(i[2] > 0))
		return f;
	for (int j = 0; j < 3; j++)
		h[j] /= length;
	const REAL_(seen) seen_o = REAL_(see)(s, o), seen_i = REAL_(see)(s, i);
	const REAL d = REAL_(d)(s, h), g = REAL_(g2_over_cos)(seen_o, seen_i, separable);
	/* One number where directions are unit. */
	const REAL area = (1 + k) * seen_o.z / 2 + seen_o.h, c = (REAL_(dot)(o, h) + REAL_(dot)(i, h)) / 2;
	f.there = 1;
	f.cosine = c;
	f.eval = d * g / 4;
	f.pdf = d / (4 * area);
	f.weight = g * area;
	return f;
}

/* o above, i below; e: the far index over the near one. Walter et al. 2007, eqs. 16, 17 and 21, without the scale of
 * radiance. */
static REAL_(facet) REAL_(refraction)(REAL_(surface) s, const REAL o[3], const REAL i[3], REAL e, int separable)
{
	REAL_(facet) f = {0, 0, 0, 0, 0};
	REAL h[3], back[3];
	for (int k = 0; k < 3; k++) {
		h[k] = -(o[k] + e * i[k]);
		back[k] = -i[k];
	}
	const REAL length = REAL_SQRT(REAL_(dot)(h, h));
	if (!(length > 0) || !(o[2] > 0) || !(i[2] < 0))
		return f;
	const REAL up = h[2] < 0 ? -1 : 1;
	for (int k = 0; k < 3; k++)
		h[k] *= up / length;
	const REAL oh = REAL_(dot)(o, h), ih = REAL_(dot)(i, h);
	if (!(oh > 0) || !(ih < 0))
		return f;
	const REAL_(seen) seen_o = REAL_(see)(s, o), seen_i = REAL_(see)(s, back);
	const REAL d = REAL_(d)(s, h), g = REAL_(g2_over_cos)(seen_o, seen_i, separable);
	const REAL sigma = seen_o.z + seen_o.h, den = e * ih + oh;
	f.there = 1;
	f.cosine = oh > 1 ? 1 : oh;
	f.eval = -ih * oh * e * e * g * d / (den * den);
	f.pdf = -ih * oh * e * e * d / (den * den * sigma);
	f.weight = g * sigma;
	return f;
}

/* --- parts, for stability_forms.c: x as stability_part says ------------------------------------------------------- */

static REAL REAL_(part)(stability_part part, const REAL *x)
{
	switch (part) {
	case STABILITY_PART_D: {
		const REAL_(surface) s = {x[6], 0, 0, x[6], 0, 0, 0};
		REAL h[3];
		for (int k = 0; k < 3; k++)
			h[k] = x[k] + x[3 + k];
		const REAL length = REAL_SQRT(REAL_(dot)(h, h));
		for (int k = 0; k < 3; k++)
			h[k] /= length;
		return REAL_(d)(s, h);
	}
	case STABILITY_PART_LAMBDA: {
		const REAL_(surface) s = {x[3], 0, 0, x[3], 0, 0, 0};
		return REAL_(see)(s, x).h / x[2];
	}
	case STABILITY_PART_REFRACTION: {
		const REAL_(surface) s = {x[6], 0, 0, x[6], 0, 0, 0};
		const REAL_(facet) f = REAL_(refraction)(s, x, x + 3, x[7], 1);
		return f.there ? REAL_(transmittance)(f.cosine, x[7]) * f.eval / (x[7] * x[7]) : 0;
	}
	case STABILITY_PART_CONDUCTOR:
		return REAL_(fresnel_conductor)(x[0], x[1], x[2]);
	default:
		return REAL_(fresnel)(x[0], x[1]);
	}
}
