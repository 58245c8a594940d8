/* test_linear.c - microfacet/linear.h and smith.h: maps, their constructors, D, projected area, masking. */
#include "lobe/microfacet/smith.h"

#include "leadr.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static double uniform(uint32_t stream, uint64_t i) { return (double)test_uniform(stream, i); }

/* The distributions without a shape that this build has and that leadr.c knows. */
static const struct {
	lobe_uint ndf;
	const char *name;
} fixed[] = {
#define LOBE_NDF_FIXED(NAME, name, number) {number, #name},
#define LOBE_NDF_SHAPED(NAME, name, number)
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
};
#define FIXED (sizeof fixed / sizeof fixed[0])

static int kind_of(size_t i) { return !strcmp(fixed[i].name, "ggx") ? 0 : !strcmp(fixed[i].name, "beckmann") ? 1 : -1; }

static lobe_linear map_of(const leadr *s)
{
	return lobe_linear_tilted(lobe_linear_correlated((float)s->ax, (float)s->ay, (float)s->rho), (float)s->tx,
				  (float)s->ty);
}

static lobe_smith surface_of(const leadr *s, size_t distribution)
{
	return lobe_smith_make(lobe_distribution_make(fixed[distribution].ndf), map_of(s));
}

/* x as a float. volatile: gcc 12 at -O2 drops the rounding of two side by side that are used as doubles again. */
static double single(double x)
{
	volatile float f = (float)x;
	return (double)f;
}

/* Parameters that are floats, so that both sides have the same. */
static leadr as_floats(leadr s)
{
	s.ax = single(s.ax);
	s.ay = single(s.ay);
	s.rho = single(s.rho);
	s.tx = single(s.tx);
	s.ty = single(s.ty);
	return s;
}

static lobe_vec3 rounded(const double v[3]) { return lobe_vec3_make((float)v[0], (float)v[1], (float)v[2]); }

/* --- constructors ------------------------------------------------------------------------------------------------- */

static int same(lobe_vec3 a, lobe_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static void test_stretch_has_the_same_bits(void)
{
	const float widths[] = {1e-5f, 1e-4f, 3e-3f, 0.1f, 0.7f, 1.0f};
	for (size_t i = 0; i < 6; i++)
		for (size_t j = 0; j < 6; j++) {
			const lobe_linear m = lobe_linear_stretch(widths[i], widths[j]);
			const lobe_stretch s = lobe_stretch_make(widths[i], widths[j]);
			TEST_ASSERT_TRUE(m.norm == s.norm);
			for (uint64_t k = 0; k < 2000; k++) {
				float w[3];
				test_direction(1, k, w);
				const lobe_vec3 v = lobe_vec3_make(w[0], w[1], w[2]);
				TEST_ASSERT_TRUE(same(lobe_linear_direction(m, v), lobe_stretch_direction(s, v)));
				TEST_ASSERT_TRUE(same(lobe_linear_facet(m, v), lobe_stretch_facet(s, v)));
				TEST_ASSERT_TRUE(same(lobe_linear_normal(m, v), lobe_stretch_normal(s, v)));
			}
		}
	TEST_ASSERT_TRUE(lobe_linear_stretch(3.0f, 1.0f).xx == 3.0f);
	TEST_ASSERT_TRUE(isnan(lobe_linear_stretch(NAN, 1.0f).norm));
}

/* A A^T of a map, divided by 2: the covariance of a Beckmann surface. And A A^-1. */
typedef struct {
	double xx, yy, xy;
} covariance;

static covariance covariance_of(lobe_linear m)
{
	const double xx = (double)m.xx, xy = (double)m.xy, yx = (double)m.yx, yy = (double)m.yy;
	const covariance c = {0.5 * (xx * xx + xy * xy), 0.5 * (yx * yx + yy * yy), 0.5 * (xx * yx + xy * yy)};
	return c;
}

/* How far A A^-1 is from the identity, and norm from 1/(pi |det A|), where the rounding of the entries of A itself may
 * make U times the condition of it. */
static double inverse_error(lobe_linear m)
{
	const double xx = (double)m.xx, xy = (double)m.xy, yx = (double)m.yx, yy = (double)m.yy;
	const double ixx = (double)m.ixx, ixy = (double)m.ixy, iyx = (double)m.iyx, iyy = (double)m.iyy;
	const double det = xx * yy - xy * yx, norm2 = xx * xx + xy * xy + yx * yx + yy * yy;
	double worst = fabs((double)m.norm * PI * fabs(det) - 1.0);
	worst = worse(worst, fabs(ixx * xx + ixy * yx - 1.0));
	worst = worse(worst, fabs(iyx * xy + iyy * yy - 1.0));
	/* The other two have different units when the axes are not turned: relative to what cancels. */
	worst = worse(worst, fabs(ixx * xy + ixy * yy) / (fabs(ixx * xy) + 1e-300) * (xy != 0.0));
	worst = worse(worst, fabs(iyx * xx + iyy * yx) / (fabs(iyx * xx) + 1e-300) * (yx != 0.0));
	return worst / fmax(norm2 / fabs(det), 1.0);
}

static const double rhos[] = {-0.9999, -0.99, -0.5, 0.0, 0.3, 0.9, 0.999, 0.9999};
static const double alphas[] = {1e-4, 1e-3, 0.05, 0.4, 1.0, 10.0};

static void test_constructors(void)
{
	double worst = 0.0, inverse = 0.0, rotated = 0.0, moments = 0.0, printed = 0.0;
	for (size_t i = 0; i < 6; i++)
		for (size_t j = 0; j < 6; j++) {
			const float ax = (float)alphas[i], ay = (float)alphas[j];
			for (size_t k = 0; k < 8; k++) {
				const float rho = (float)rhos[k];
				const double xx = 0.5 * (double)ax * (double)ax, yy = 0.5 * (double)ay * (double)ay;
				const double xy = 0.5 * (double)rho * (double)ax * (double)ay;
				const lobe_linear m = lobe_linear_correlated(ax, ay, rho);
				const covariance c = covariance_of(m);
				worst = worse(worst, fabs(c.xx / xx - 1.0));
				worst = worse(worst, fabs(c.yy / yy - 1.0));
				worst = worse(worst, fabs(c.xy - xy) / sqrt(xx * yy));
				inverse = worse(inverse, inverse_error(m));
				/* Through moments that are floats; widths below the least are another matter. */
				const float fx = (float)xx, fy = (float)yy, fxy = (float)xy;
				const lobe_linear n = lobe_linear_from_moments(0.0f, 0.0f, fx, fy, fxy);
				const double det = (double)fx * (double)fy - (double)fxy * (double)fxy;
				const double large = 0.5 * ((double)fx + (double)fy) +
						     hypot(0.5 * ((double)fx - (double)fy), (double)fxy);
				if (det / large > 0.51e-8) {
					const covariance d = covariance_of(n);
					/* det A = 2 sqrt(det Cov), which no cancellation may touch. */
					const double norm = 1.0 / (TWO_PI * sqrt(det));
					moments = worse(moments, fabs((double)n.norm / norm - 1.0));
					moments = worse(moments, fabs(d.xx - (double)fx) / large);
					moments = worse(moments, fabs(d.yy - (double)fy) / large);
					moments = worse(moments, fabs(d.xy - (double)fxy) / large);
					inverse = worse(inverse, inverse_error(n));
					const float cancels = fx * fy - fxy * fxy;
					printed = larger(printed, fabs((double)cancels / det - 1.0));
				}
			}
			const double angle = 0.37 + (double)i;
			const double c = cos(angle), s = sin(angle), a2 = (double)ax * (double)ax,
				     b2 = (double)ay * (double)ay;
			const lobe_linear m = lobe_linear_rotated(ax, ay, (float)angle);
			const covariance r = covariance_of(m);
			rotated = worse(rotated, fabs(r.xx - 0.5 * (c * c * a2 + s * s * b2)) / (a2 + b2));
			rotated = worse(rotated, fabs(r.yy - 0.5 * (s * s * a2 + c * c * b2)) / (a2 + b2));
			rotated = worse(rotated, fabs(r.xy - 0.5 * c * s * (a2 - b2)) / (a2 + b2));
			inverse = worse(inverse, inverse_error(m));
		}
	measured("correlated: A A^T/2 against the covariance, in U", worst / U, 6.0);
	measured("rotated: the same, in U of the larger axis", rotated / U, 12.0);
	measured("from_moments: A A^T/2 and norm, in U", moments / U, 12.0);
	measured("A A^-1 and norm pi det, in U condition(A)", inverse / U, 6.0);
	printf("  %-60s %11.4g\n", "var_x var_y - cov^2 in float: relative error", printed);
	TEST_ASSERT_TRUE(printed > 1e3 * U);
	/* What cannot be: a covariance too large, no variance, numbers that are none, rho beyond 1. */
	const lobe_linear bad = lobe_linear_from_moments(0.0f, 0.0f, 0.5f, 0.5f, 0.51f);
	measured("|cov| too large: narrow axis", fabs(1.0 / (PI * (double)bad.norm * 1e-4 * sqrt(2.02)) - 1.0),
		 4.0 * U);
	TEST_ASSERT_TRUE(isnan(lobe_linear_from_moments(0.0f, 0.0f, NAN, 1.0f, 0.0f).norm));
	TEST_ASSERT_TRUE(isnan(lobe_linear_from_moments(0.0f, 0.0f, 1.0f, 1.0f, NAN).norm));
	TEST_ASSERT_TRUE(lobe_linear_correlated(0.5f, 0.5f, 1.0f).yx == lobe_linear_correlated(0.5f, 0.5f, 0.9999f).yx);
	TEST_ASSERT_TRUE(isnan(lobe_linear_correlated(0.5f, 0.5f, NAN).norm));
	TEST_ASSERT_FALSE(lobe_linear_make(1.0f, 2.0f, 2.0f, 4.0f, 0.0f, 0.0f).norm <= LOBE_REAL_MAX);
}

/* Two maps one after the other do what their composition does, and matrices of points multiply. */
static void test_composition(void)
{
	double worst = 0.0, points = 0.0, formula = 0.0;
	for (uint64_t i = 0; i < 2000; i++) {
		float p[16];
		for (uint64_t k = 0; k < 16; k++)
			p[k] = 2.0f * test_uniform(2, 16 * i + k) - 1.0f;
		p[3] += p[3] < 0.0f ? -1.0f : 1.0f; /* not singular */
		p[0] += p[3] < 0.0f ? -1.5f : 1.5f;
		const lobe_linear inner = lobe_linear_make(p[0], 0.5f * p[1], 0.5f * p[2], p[3], p[4], p[5]);
		const lobe_linear outer =
			lobe_linear_from_points(2.0f + p[6], p[7], p[8], 2.0f + p[9], p[10], p[11], 1.5f + p[12]);
		const lobe_linear both = lobe_linear_compose(outer, inner);
		float w[3];
		test_direction(3, i, w);
		const lobe_vec3 v = lobe_vec3_make(w[0], w[1], w[2]);
		const lobe_vec3 a[3] = {lobe_linear_direction(both, v), lobe_linear_normal(both, v),
					lobe_linear_facet(both, v)};
		const lobe_vec3 b[3] = {lobe_linear_direction(inner, lobe_linear_direction(outer, v)),
					lobe_linear_normal(outer, lobe_linear_normal(inner, v)),
					lobe_linear_facet(inner, lobe_linear_facet(outer, v))};
		for (int k = 0; k < 3; k++) {
			const lobe_vec3 d = lobe_vec3_fma(LOBE_R(-1.0), a[k], b[k]);
			worst = worse(worst, sqrt((double)lobe_dot(d, d) / (double)lobe_dot(a[k], a[k])));
		}
		worst = worse(worst, fabs((double)both.norm / ((double)inner.norm * (double)outer.norm * PI) - 1.0));

		/* Atanasov et al. 2022: h' = M^T h, w' = M^-1 w up to length, D_M = |det M| D(h')/|M^T h|^4. */
		const double M[3][3] = {{2.0 + (double)p[6], (double)p[7], 0.0},
					{(double)p[8], 2.0 + (double)p[9], 0.0},
					{(double)p[10], (double)p[11], 1.5 + (double)p[12]}};
		double h[3], back[3], len2 = 0.0;
		const lobe_vec3 d = lobe_linear_direction(outer, v);
		const double dv[3] = {(double)d.x, (double)d.y, (double)d.z};
		for (int k = 0; k < 3; k++) {
			h[k] = back[k] = 0.0;
			for (int l = 0; l < 3; l++) {
				h[k] += M[l][k] * (double)w[l];
				back[k] += M[k][l] * dv[l];
			}
			len2 += h[k] * h[k];
		}
		/* M d = w times a number, here zz. */
		for (int k = 0; k < 3; k++)
			points = worse(points, fabs(back[k] / M[2][2] - (double)w[k]));
		const double det = (M[0][0] * M[1][1] - M[0][1] * M[1][0]) * M[2][2];
		const leadr one = {LEADR_GGX, 1.0, 1.0, 0.0, 0.0, 0.0};
		const lobe_smith s = lobe_smith_make(lobe_distribution_make(LOBE_NDF_GGX), outer);
		/* leadr_d is of degree -4: the length of h falls out. */
		if (w[2] > 0.0f)
			formula = worse(
				formula,
				fabs((double)lobe_smith_d(s, v) / (fabs(det) * M[2][2] * leadr_d(&one, h)) - 1.0));
	}
	measured("composition against one after the other", worst, 100.0 * U);
	measured("w' = M^-1 w", points, 30.0 * U);
	measured("D_M = |det M| zz D(M^T h)/|M^T h|^4: relative", formula, 60.0 * U);
	/* Skewing the points: a shear of the plane, as Atanasov et al. write GGX. */
	const lobe_linear skew = lobe_linear_from_points(1.0f, 0.0f, 0.0f, 2.0f, 0.25f, -1.0f, 1.0f);
	TEST_ASSERT_TRUE(skew.xx == 1.0f && skew.yy == 0.5f && skew.mean_x == 0.25f && skew.mean_y == -0.5f);
}

/* --- D and sigma against LEADR ------------------------------------------------------------------------------------ */

/* Anything in the domain. */
static leadr random_surface(uint32_t stream, uint64_t i, leadr_kind kind)
{
	leadr s;
	s.kind = kind;
	s.ax = pow(10.0, -4.0 + 5.0 * uniform(stream, 8 * i));
	s.ay = pow(10.0, -4.0 + 5.0 * uniform(stream, 8 * i + 1));
	s.rho = rhos[test_bits(stream, 8 * i + 2) % 8];
	s.tx = i % 2 ? 0.0 : pow(100.0, uniform(stream, 8 * i + 3));
	s.ty = i % 4 ? 0.0 : -pow(100.0, uniform(stream, 8 * i + 4));
	return as_floats(s);
}

static void test_d(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double worst = 0.0;
		for (uint64_t i = 0; i < 200000; i++) {
			const leadr s = random_surface(4, i, (leadr_kind)kind_of(n));
			const lobe_smith m = surface_of(&s, n);
			/* A facet within 8 widths of the mean (4 where exp takes over). */
			const double r = (s.kind == LEADR_GGX ? 8.0 : 4.0) * uniform(5, 2 * i),
				     phi = TWO_PI * uniform(5, 2 * i + 1);
			const double x = r * cos(phi), y = r * sin(phi);
			double h[3] = {-(s.ax * x + s.tx), -(s.ay * (s.rho * x + sqrt(1.0 - s.rho * s.rho) * y) + s.ty),
				       1.0};
			const double len = sqrt(h[0] * h[0] + h[1] * h[1] + 1.0);
			for (int k = 0; k < 3; k++)
				h[k] = single(h[k] / len);
			const double exact = leadr_d(&s, h), got = (double)lobe_smith_d(m, rounded(h));
			/* Rounding of a tilted normal may throw its facet far out of these 8 widths. */
			if (exact > 1e-37 && exact < 1e37 && exact * s.ax * s.ay > 1e-12)
				worst = worse(worst,
					      fabs(got / exact - 1.0) / leadr_condition(&s) / leadr_steepness(&s, h));
		}
		char what[80];
		snprintf(what, sizeof what, "%s: D, relative error over condition(A)%s", fixed[n].name,
			 kind_of(n) == LEADR_GGX ? "" : " (1 + r^2)");
		measured(what, worst, 6e-7);
	}
}

/* sigma relative to what does not cancel: v.z is a difference when the view is along the mean plane, v.x and v.y are
 * when the view is along a narrow axis. Far below Beckmann's horizon sigma falls as exp(-cot^2), and errors grow with
 * cot^2. */
static void test_sigma(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double worst = 0.0;
		unsigned away = 0;
		for (uint64_t i = 0; i < 200000; i++) {
			const leadr s = random_surface(6, i, (leadr_kind)kind_of(n));
			float w[3];
			double k[3], v[3];
			test_direction(7, i, w);
			for (int c = 0; c < 3; c++)
				k[c] = (double)w[c];
			leadr_direction(&s, k, v);
			const double exact = leadr_sigma(&s, k), across = hypot(v[0], v[1]);
			const double got = (double)lobe_smith_sigma(surface_of(&s, n), rounded(k));
			const double cancels = (s.ax * fabs(k[0]) + s.ay * fabs(k[1])) / across;
			const double cot2 =
				s.kind == LEADR_BECKMANN && v[2] < 0.0 ? v[2] * v[2] / (across * across) : 0.0;
			away += k[2] > 0.0 && v[2] < 0.0;
			if (exact > 1e-30 && cot2 < 20.0)
				worst = worse(worst, fabs(got - exact) / (exact * cancels * (1.0 + cot2) +
									  fabs(k[0] * s.tx) + fabs(k[1] * s.ty)));
		}
		char what[80];
		snprintf(what, sizeof what, "%s: sigma, error in U of its terms", fixed[n].name);
		measured(what, worst / U, 12.0);
		printf("  %-60s %11u\n", "  directions above the horizon that the mean plane faces away from", away);
		TEST_ASSERT_TRUE(away > 10000u);
	}
}

/* --- integrals by quadrature -------------------------------------------------------------------------------------- */

static const leadr surfaces[] = {
	{LEADR_GGX, 0.3, 0.3, 0.0, 0.0, 0.0},     {LEADR_GGX, 0.3, 0.3, 0.0, 0.7, -0.4},
	{LEADR_GGX, 0.5, 0.1, 0.8, 0.2, 0.3},     {LEADR_GGX, 0.02, 0.3, -0.95, 1.5, 0.0},
	{LEADR_GGX, 1.0, 0.6, 0.9999, -0.5, 2.0}, {LEADR_GGX, 0.1, 0.1, -0.3, 8.0, -6.0},
};
#define SURFACES (sizeof surfaces / sizeof surfaces[0])

/* What is integrated over facets of the standard surface, n = (r cos, r sin, 1), at the library's D. The tail of r is
 * x^2, so that x runs over (0, 1) and r x is smooth. */
typedef struct {
	leadr s;
	lobe_smith surface;
	double w[3], v[3];
	int power; /* 0: slope moments 1; 1, 2: of m.x, m.y; 3: max(0, w.m) */
} integrand;

/* Slopes of the facet, and the library's P22 there. P22 of float slopes: the tilt is taken out before rounding would
 * drown narrow slopes in it. */
static double p22_at(const integrand *f, double r, double phi, double *slope_x, double *slope_y)
{
	const double x = -r * cos(phi), y = -r * sin(phi);
	*slope_x = f->s.ax * x + f->s.tx;
	*slope_y = f->s.ay * (f->s.rho * x + sqrt(1.0 - f->s.rho * f->s.rho) * y) + f->s.ty;
	return (double)lobe_smith_p22(f->surface, (float)*slope_x, (float)*slope_y);
}

/* At radius r, over phi. */
static double ring(const integrand *f, double r, gsl_integration_glfixed_table *rule)
{
	/* Facets that face w: v.z + r |v.xy| cos(phi - azimuth) > 0. */
	const double across = hypot(f->v[0], f->v[1]), middle = atan2(f->v[1], f->v[0]);
	const double cosine = across * r > 0.0 ? -f->v[2] / (across * r) : f->v[2] > 0.0 ? -1.0 : 1.0;
	const double half = f->power < 3 || cosine <= -1.0 ? PI : cosine >= 1.0 ? 0.0 : acos(cosine);
	double sum = 0.0;
	for (size_t j = 0; j < 48; j++) {
		double phi, weight, x, y;
		gsl_integration_glfixed_point(middle - half, middle + half, j, &phi, &weight, rule);
		const double p = p22_at(f, r, phi, &x, &y);
		const double what[4] = {1.0, -x, -y, fmax(f->w[2] - f->w[0] * x - f->w[1] * y, 0.0)};
		sum += weight * p * what[f->power];
	}
	return sum;
}

static double integral(const integrand *f)
{
	gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(48),
				      *outer = gsl_integration_glfixed_table_alloc(160);
	const double det = f->s.ax * f->s.ay * sqrt(1.0 - f->s.rho * f->s.rho);
	/* Rings are whole on one side of this radius, arcs on the other. */
	const double across = hypot(f->v[0], f->v[1]);
	const double r0 = f->power == 3 && across > 0.0 ? fabs(f->v[2]) / across : 1.0;
	const double split = sqrt(leadr_tail(f->s.kind, r0 * r0));
	double sum = 0.0;
	for (int part = 0; part < 2; part++)
		for (size_t i = 0; i < 160; i++) {
			double x, weight;
			gsl_integration_glfixed_point(part ? split : 0.0, part ? 1.0 : split, i, &x, &weight, outer);
			if (x < 1e-100)
				continue; /* all rings are whole: beyond this radius there is nothing */
			const double r = sqrt(leadr_tail_inverse(f->s.kind, x * x));
			/* r dr = x dx/(density of r^2): GGX tail^2, Beckmann tail. */
			const double q = x * x, density = f->s.kind == LEADR_GGX ? q * q : q;
			sum += weight * x / density * ring(f, r, rule);
		}
	gsl_integration_glfixed_table_free(rule);
	gsl_integration_glfixed_table_free(outer);
	return sum * det;
}

/* int D m.z dm = 1 whatever the tilt, and int D m dm = (-mean, 1). Not 1 is int D m.n dm with the mean plane's unit
 * normal n: that is the area of the mean plane. */
static void test_normalisation(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double worst = 0.0, vector = 0.0;
		for (size_t i = 0; i < SURFACES; i++) {
			integrand f;
			memset(&f, 0, sizeof f);
			f.s = as_floats(surfaces[i]);
			f.s.kind = (leadr_kind)kind_of(n);
			f.surface = surface_of(&f.s, n);
			const double one = integral(&f);
			f.power = 1;
			const double x = integral(&f);
			f.power = 2;
			const double y = integral(&f);
			const double size = hypot(f.s.tx, f.s.ty) + leadr_condition(&f.s) * fmax(f.s.ax, f.s.ay);
			worst = worse(worst, fabs(one - 1.0) / leadr_condition(&f.s));
			vector = worse(vector, fabs(x + f.s.tx) / size);
			vector = worse(vector, fabs(y + f.s.ty) / size);
			if (i == 5) {
				const double area = sqrt(1.0 + f.s.tx * f.s.tx + f.s.ty * f.s.ty);
				const double along = (one - x * f.s.tx - y * f.s.ty) / area;
				printf("  int D m.z dm = %.6f, int D m.n dm = %.6f = 1/n.z for mean slopes (%g, %g)\n",
				       one, along, f.s.tx, f.s.ty);
				TEST_ASSERT_TRUE(fabs(along / area - 1.0) < 1e-4);
			}
		}
		char what[80];
		snprintf(what, sizeof what, "%s: |int D m.z - 1| over condition(A)", fixed[n].name);
		measured(what, worst, 1e-6);
		snprintf(what, sizeof what, "%s: int D m against (-mean, 1): relative", fixed[n].name);
		measured(what, vector, 1e-6);
	}
}

static const double views[][2] = {{1.0, 0.0},  {0.8, 0.6},  {0.5, 3.0}, {0.2, 5.2},
				  {0.05, 0.4}, {0.01, 2.5}, {-0.3, 1.0}};
#define VIEWS (sizeof views / sizeof views[0])

static void test_projected_area(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double worst = 0.0, ignored = 0.0;
		unsigned away = 0;
		for (size_t i = 0; i < SURFACES; i++)
			for (size_t j = 0; j < VIEWS; j++) {
				integrand f;
				f.s = as_floats(surfaces[i]);
				f.s.kind = (leadr_kind)kind_of(n);
				f.surface = surface_of(&f.s, n);
				const double c = views[j][0], sine = sqrt(1.0 - c * c);
				f.w[0] = single(sine * cos(views[j][1]));
				f.w[1] = single(sine * sin(views[j][1]));
				f.w[2] = single(c);
				leadr_direction(&f.s, f.w, f.v);
				f.power = 3;
				away += f.v[2] < 0.0 && c > 0.0;
				if (leadr_sigma(&f.s, f.w) < 1e-6)
					continue; /* beyond the radii of this quadrature */
				const double area = integral(&f);
				const double sigma = (double)lobe_smith_sigma(f.surface, rounded(f.w));
				const double terms = area + fabs(f.w[0] * f.s.tx) + fabs(f.w[1] * f.s.ty);
				worst = worse(worst, fabs(sigma - area) / terms / leadr_condition(&f.s));
				/* Planted: a sigma that forgets the tilt. */
				leadr flat = f.s;
				flat.tx = flat.ty = 0.0;
				ignored = larger(ignored, fabs(leadr_sigma(&flat, f.w) / area - 1.0));
			}
		char what[80];
		snprintf(what, sizeof what, "%s: sigma against int D max(0, w.m), over condition(A)", fixed[n].name);
		measured(what, worst, 2e-6);
		printf("  %-60s %11.4g\n", "  the same without the tilt: relative error", ignored);
		printf("  %-60s %11u\n", "  directions among them that the mean plane faces away from", away);
		TEST_ASSERT_TRUE(ignored > 0.1 && away >= 5u);
	}
}

/* --- masking ------------------------------------------------------------------------------------------------------ */

static void test_masking(void)
{
	for (size_t n = 0; n < FIXED; n++) {
		if (kind_of(n) < 0)
			continue;
		double g1 = 0.0, g2 = 0.0;
		for (uint64_t i = 0; i < 50000; i++) {
			leadr s = random_surface(8, i, (leadr_kind)kind_of(n));
			s.tx = s.tx > 0.0 ? s.tx / 100.0 : 0.0; /* to 1: else the plane seldom faces both */
			s.ty /= 100.0;
			s = as_floats(s);
			const lobe_smith m = surface_of(&s, n);
			float o[3], w[3];
			double ko[3], ki[3], vo[3], vi[3];
			test_direction(9, 2 * i, o);
			test_direction(9, 2 * i + 1, w);
			for (int c = 0; c < 3; c++) {
				ko[c] = (double)o[c];
				ki[c] = (double)w[c];
			}
			leadr_direction(&s, ko, vo);
			leadr_direction(&s, ki, vi);
			const double got1 = (double)lobe_smith_g1(m, rounded(ko));
			const double got2 = (double)lobe_smith_g2(m, rounded(ko), rounded(ki));
			TEST_ASSERT_TRUE(vo[2] > 1e-6 || got1 < 0.01 || s.ax < 0.01 || s.ay < 0.01);
			if (vo[2] > 0.01)
				g1 = worse(g1, fabs(got1 * (1.0 + leadr_lambda(s.kind, vo)) - 1.0));
			if (vo[2] > 0.01 && vi[2] > 0.01)
				g2 = worse(g2, fabs(got2 * (1.0 + leadr_lambda(s.kind, vo) + leadr_lambda(s.kind, vi)) -
						    1.0));
			TEST_ASSERT_TRUE(got2 == 0.0 || (vo[2] > -1e-6 && vi[2] > -1e-6));
		}
		char what[80];
		/* v.z, a difference of terms to 1, is above 0.01. */
		snprintf(what, sizeof what, "%s: G1 against 1/(1 + Lambda(M^-1 w))", fixed[n].name);
		measured(what, g1, 1e-5);
		snprintf(what, sizeof what, "%s: G2 against 1/(1 + Lambda_o + Lambda_i)", fixed[n].name);
		measured(what, g2, 2e-5);
	}
}

/* Whatever the parameters: finite and not negative; in the domain there is a normal to see wherever facets face w. */
static void extremes_of(lobe_smith s, lobe_vec3 o, lobe_vec2 u, int in_domain)
{
	const lobe_vec3 m = lobe_smith_visible(s, o, u);
	const float out[] = {lobe_smith_d(s, o),
			     lobe_smith_p22(s, o.x, o.y),
			     lobe_smith_sigma(s, o),
			     lobe_smith_g1(s, o),
			     lobe_smith_g2(s, o, o),
			     lobe_smith_visible_pdf(s, o, m),
			     m.z,
			     m.x * m.x,
			     m.y * m.y};
	for (size_t i = 0; i < sizeof out / sizeof out[0]; i++)
		TEST_ASSERT_TRUE(out[i] >= 0.0f && out[i] <= LOBE_REAL_MAX);
	const float len2 = lobe_dot(m, m);
	TEST_ASSERT_TRUE(in_domain ? fabsf(len2 - 1.0f) < 1e-6f : len2 == 0.0f || fabsf(len2 - 1.0f) < 1e-6f);
}

static void test_extremes(void)
{
	const float widths[] = {0.0f, 1e-4f, 1.0f, 100.0f, -1.0f, 1e30f, NAN, INFINITY};
	const float tilts[][2] = {{0, 0}, {100, -100}, {-1, 0.5f}, {1e-4f, 0}, {1e30f, 0}, {NAN, 0}, {0, INFINITY}};
	const float u[] = {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f};
	const float ws[][3] = {{0, 0, 1},         {1, 0, 0}, {-1, 0, 0},        {0.6f, 0, 0.8f}, {0, 1, 1e-6f},
			       {-0.6f, 0, -0.8f}, {0, 0, 0}, {NAN, 0.5f, 0.5f}, {0, 0, -1}};
	unsigned count = 0, regular = 0;
	for (size_t i = 0; i < FIXED * 8 * 8 * 7 * 9 * 16; i++) {
		const size_t n = i % FIXED, a = i / FIXED % 8, b = i / FIXED / 8 % 8, t = i / FIXED / 64 % 7;
		const size_t w = i / FIXED / 64 / 7 % 9, k = i / FIXED / 64 / 7 / 9;
		const lobe_linear map = lobe_linear_tilted(
			lobe_linear_correlated(widths[a], widths[b], (float)rhos[(a + b + t + w + k) % 8]), tilts[t][0],
			tilts[t][1]);
		const int in_domain = kind_of(n) == LEADR_GGX && a < 5 && b < 5 && t < 4 && w < 6;
		extremes_of(lobe_smith_make(lobe_distribution_make(fixed[n].ndf), map),
			    lobe_vec3_make(ws[w][0], ws[w][1], ws[w][2]), lobe_vec2_make(u[k / 4], u[k % 4]),
			    in_domain);
		count++;
		regular += (unsigned)in_domain;
	}
	printf("  %u combinations, %u of them in the domain\n", count, regular);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_stretch_has_the_same_bits);
	RUN_TEST(test_constructors);
	RUN_TEST(test_composition);
	RUN_TEST(test_d);
	RUN_TEST(test_sigma);
	RUN_TEST(test_normalisation);
	RUN_TEST(test_projected_area);
	RUN_TEST(test_masking);
	RUN_TEST(test_extremes);
	return UNITY_END() != 0;
}
