/* test_smith_integrals.c - microfacet/smith.h under linear maps: integrals over facets by quadrature, of D against 1
 * and the mean slope, and of D max(0, w.m) against the projected area. */
#include "lobe/microfacet/smith.h"

#include "directions.h"
#include "leadr_surfaces.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

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

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_normalisation);
	RUN_TEST(test_projected_area);
	return UNITY_END() != 0;
}
