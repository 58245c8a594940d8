/* test_smith_leadr.c - microfacet/smith.h under every linear map against LEADR's formulas (leadr.c): D, projected area,
 * masking, and their integrals by quadrature. */
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

static const double rhos[] = {-0.9999, -0.99, -0.5, 0.0, 0.3, 0.9, 0.999, 0.9999};

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
	RUN_TEST(test_d);
	RUN_TEST(test_sigma);
	RUN_TEST(test_normalisation);
	RUN_TEST(test_projected_area);
	RUN_TEST(test_masking);
	RUN_TEST(test_extremes);
	return UNITY_END() != 0;
}
