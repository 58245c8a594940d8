/* test_masking.c - masking and shadowing: weak furnaces, exact albedos, bounds, symmetries and limits of every joint,
 * and the beta function. Known values: Heitz 2014's statements, and quadrature made apart from this library. */
#include "directions.h"
#include "measured.h"
#include "microsurface_cases.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <gsl/gsl_sf_gamma.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static lobe_linear stretch(double ax, double ay)
{
	return lobe_linear_make((float)ax, 0.0f, 0.0f, (float)ay, 0.0f, 0.0f);
}

static lobe_microsurface ggx(double alpha)
{
	return lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), stretch(alpha, alpha));
}

static lobe_seen_facet seen_facet(lobe_vec3 o, lobe_vec3 i, lobe_vec3 h)
{
	lobe_seen_facet m;
	m.o = lobe_dot(o, h);
	m.i = lobe_dot(i, h);
	m.z = h.z;
	m.length2 = lobe_dot(h, h);
	return m;
}

/* --- weak furnace: int G1(o, m) max(0, o.m) D(m) dm = the mean plane's area seen from o --------------------------- */

/* G1/z, of those maskings that have one of a single direction: G2 with a light that shadows nothing, along the mean
 * normal of an unsheared surface. */
typedef struct {
	lobe_microsurface s;
	lobe_vec3 wo;
	double o[3];
	int wrong; /* G1 of a surface 5 % wider */
} furnace;

static double g1_over_cos(const furnace *f, const double m[3])
{
	lobe_microsurface s = f->s;
	const lobe_vec3 h = lobe_vec3_make((float)m[0], (float)m[1], (float)m[2]);
	if (f->wrong)
		s.map = stretch(1.05 * (double)s.map.xx, 1.05 * (double)s.map.yy);
	const lobe_seen o = lobe_see(s, f->wo, 1.0f);
	switch (s.masking) {
	case LOBE_MASKING_SMITH:
		return 1.0 / (double)o.sigma;
	case LOBE_MASKING_VCAVITY:
		return (double)lobe_vcavity_g1_over_cos(o.z, lobe_dot(f->wo, h), h.z);
	default: {
		const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
		return (double)lobe_masking_g2_over_cos(s, o, lobe_see(s, up, 1.0f), seen_facet(f->wo, up, h), 0);
	}
	}
}

static double furnace_at(void *context, double x, double y)
{
	const furnace *f = context;
	double m[3];
	const double area = surface_facet(&f->s, x, y, m);
	const double c = textbook_dot(f->o, m);
	return c > 0.0 ? g1_over_cos(f, m) * c * surface_d(&f->s, m) * area : 0.0;
}

static double furnace_edge(void *context, double x, double y)
{
	const furnace *f = context;
	double m[3];
	surface_facet(&f->s, x, y, m);
	return textbook_dot(f->o, m);
}

/* Where a cavity's side begins to be hidden. */
static double furnace_kink(void *context, double x, double y)
{
	const furnace *f = context;
	double m[3];
	surface_facet(&f->s, x, y, m);
	const double z = f->o[2] - (double)f->s.map.mean_x * f->o[0] - (double)f->s.map.mean_y * f->o[1];
	return 2.0 * m[2] * z - textbook_dot(f->o, m);
}

static double weak_furnace(lobe_microsurface s, double mu, double phi, int wrong, double tolerance)
{
	furnace f = {s, direction_at(mu, phi), {0, 0, 0}, wrong};
	f.o[0] = (double)f.wo.x;
	f.o[1] = (double)f.wo.y;
	f.o[2] = (double)f.wo.z;
	const int kinked = s.masking == LOBE_MASKING_VCAVITY;
	quadrature q = {furnace_at, furnace_edge, kinked ? furnace_kink : NULL, &f, tolerance, 1e3 * tolerance, 5, 0.0};
	return integrate_square(&q, 10);
}

/* Smith's and the V-cavities', of every distribution, stretched, skewed and, for Smith's also where the mean plane
 * shows its back, tilted: outgoing light is normalised by what is seen. */
static void test_weak_furnace_is_1(void)
{
	static const double mus[] = {1.0, 0.6, 0.2, 0.03};
	const lobe_linear maps[] = {stretch(0.5, 0.5), stretch(1, 0.1),
				    lobe_linear_make(0.3f, 0.2f, -0.1f, 0.5f, 0.0f, 0.0f),
				    lobe_linear_make(0.4f, 0.1f, 0.0f, 0.3f, 0.4f, -0.3f)};
	double smith = 0.0, cavities = 0.0;
	unsigned n = 0, backs = 0;
	for (int k = 0; k < SHAPES; k++)
		for (size_t m = 0; m < sizeof maps / sizeof *maps; m++)
			for (size_t i = 0; i < sizeof mus / sizeof *mus; i++) {
				lobe_microsurface s = lobe_microsurface_make(shape_make(&shapes[k]), maps[m]);
				if ((m + i + (size_t)k) % 2 && !test_long())
					continue;
				const double phi = 0.5 + 2.0 * (double)i;
				smith = larger(smith, fabs(weak_furnace(s, mus[i], phi, 0, 1e-7) - 1.0));
				n++;
				s.masking = LOBE_MASKING_VCAVITY;
				if (!(lobe_see(s, direction_at(mus[i], phi), 1.0f).z > 0.0f)) {
					backs++;
					continue;
				}
				cavities = larger(cavities, fabs(weak_furnace(s, mus[i], phi, 0, 1e-7) - 1.0));
			}
	printf("  %u surfaces and views, %u of them from behind the mean plane\n", n, backs);
	measured("Smith: |weak furnace - 1|, every distribution", smith, 2e-5);
	measured("V-cavities: |weak furnace - 1|, every distribution", cavities, 2e-5);
	TEST_ASSERT_TRUE(backs > 0u);
	/* A masking that is not D's is seen. */
	TEST_ASSERT_TRUE(fabs(weak_furnace(ggx(0.5), 0.3, 0.0, 1, 1e-7) - 1.0) > 5e-3);
}

/* The others fail, each by its own: Schlick-Smith's three by values known from elsewhere, the rest by closed forms. */
static void test_weak_furnace_of_what_is_no_surface(void)
{
	static const double mus[] = {0.1, 0.3, 0.7};
	static const struct {
		const char *name;
		lobe_uint masking;
		double value[3];
	} known[] = {{"Schlick-Smith, alpha/2", LOBE_MASKING_SCHLICK_GGX, {0.935, 0.909, 0.959}},
		     {"Schlick-Smith, alpha sqrt(2/pi)", LOBE_MASKING_SCHLICK_SMITH, {0.662, 0.745, 0.906}},
		     {"Schlick-Smith, (r + 1)^2/8", LOBE_MASKING_SCHLICK_GGX_LIGHTS, {0.710, 0.778, 0.918}}};
	for (size_t k = 0; k < sizeof known / sizeof *known; k++)
		for (int i = 0; i < 3; i++) {
			const double got = weak_furnace(lobe_microsurface_masking(ggx(0.5), known[k].masking), mus[i],
							0.4, 0, 1e-6);
			printf("  %-32s alpha .5 mu %.1f: %.4f, known %.3f\n", known[k].name, mus[i], got,
			       known[k].value[i]);
			TEST_ASSERT_DOUBLE_WITHIN(5.1e-4, known[k].value[i], got);
		}
	/* sigma = (mu + t)/2 is what an unmasked surface shows: G1 sigma/mu. */
	for (int i = 0; i < 3; i++) {
		const double mu = mus[i], t = sqrt(0.25 * (1.0 - mu * mu) + mu * mu), sigma = 0.5 * (mu + t);
		const double a = pow(0.5 + 0.5 * sqrt(0.5), 2.0), td = sqrt(a * a * (1.0 - mu * mu) + mu * mu);
		const double expected[3] = {sigma / mu, sigma, 2.0 * sigma / (mu + td)};
		static const lobe_uint maskings[3] = {LOBE_MASKING_NONE, LOBE_MASKING_IMPLICIT, LOBE_MASKING_DISNEY};
		static const char *const names[3] = {"none", "implicit", "Disney"};
		for (int k = 0; k < 3; k++) {
			const double got =
				weak_furnace(lobe_microsurface_masking(ggx(0.5), maskings[k]), mu, 0.4, 0, 1e-6);
			printf("  %-32s alpha .5 mu %.1f: %.4f, closed form %.4f\n", names[k], mu, got, expected[k]);
			TEST_ASSERT_DOUBLE_WITHIN(1e-4 * expected[k], expected[k], got);
			TEST_ASSERT_TRUE(fabs(got - 1.0) > 0.02);
		}
	}
}

/* --- albedo with F = 1 -------------------------------------------------------------------------------------------- */

typedef struct {
	lobe_microfacet_conductor p;
	lobe_vec3 wo;
	direction_map map;
} mirror;

static double mirror_at(void *context, double x, double y)
{
	const mirror *a = context;
	double w[3];
	const double area = map_direction(&a->map, x, y, w);
	if (!(area > 0.0))
		return 0.0;
	return area * (double)lobe_microfacet_conductor_eval(a->p, a->wo,
							     lobe_vec3_make((float)w[0], (float)w[1], (float)w[2]))
			      .g;
}

static double mirror_edge(void *context, double x, double y) { return map_edge(&((const mirror *)context)->map, x, y); }

static double albedo(lobe_microsurface s, double mu)
{
	const lobe_rgb white = lobe_rgb_make(1.0f, 1.0f, 1.0f);
	mirror a;
	a.p = lobe_microfacet_conductor_make(s, lobe_fresnel_model_constant(white), LOBE_STRATEGY_VISIBLE);
	a.wo = direction_at(mu, 0.3);
	const double o[3] = {(double)a.wo.x, (double)a.wo.y, (double)a.wo.z};
	a.map = map_make(MAP_REFLECT, o, (double)(s.like * s.map.xx), (double)(s.like * s.map.yy), 0.0);
	quadrature q = {mirror_at, mirror_edge, NULL, &a, 3e-7, 3e-4, 5, 0.0};
	return integrate_square(&q, 10);
}

static void test_albedo_at_alpha_1_is_exact(void)
{
	static const double mus[] = {1.0, 0.7, 0.3, 0.05};
	double height = 0.0, separable = 0.0;
	for (size_t i = 0; i < sizeof mus / sizeof *mus; i++) {
		const double mu = (double)(float)mus[i];
		lobe_microsurface s = ggx(1.0);
		height = larger(height, fabs(albedo(s, mus[i]) - (1.0 - mu * log((1.0 + mu) / mu))));
		s.joint = LOBE_JOINT_SEPARABLE;
		separable = larger(separable, fabs(albedo(s, mus[i]) - 2.0 * (1.0 - log(2.0)) / (1.0 + mu)));
	}
	measured("GGX alpha 1: E(mu) height-correlated, off", height, 1e-5);
	measured("GGX alpha 1: E(mu) separable, off", separable, 1e-5);
}

/* E(mu, alpha) of GGX by quadrature made apart from this library, to four digits: correlated, separable. */
static void test_albedo_matches_the_reference_table(void)
{
	static const double alphas[] = {0.1, 0.25, 0.5, 0.75, 1.0};
	static const double mus[] = {0.05, 0.1, 0.25, 0.5};
	static const double reference[5][4][2] = {
		{{0.9118, 0.8860}, {0.8835, 0.8728}, {0.9216, 0.9203}, {0.9692, 0}},
		{{0.9331, 0.8746}, {0.8916, 0.8543}, {0.8401, 0.8285}, {0.8573, 0.8551}},
		{{0.9125, 0.7923}, {0.8601, 0.7723}, {0.7652, 0.7256}, {0.6983, 0.6860}},
		{{0.8806, 0.6880}, {0.8107, 0.6645}, {0.6802, 0.6060}, {0.5646, 0.5374}},
		{{0.8478, 0.5845}, {0.7602, 0.5579}, {0.5976, 0.4910}, {0.4507, 0.4091}},
	};
	double worst = 0.0;
	for (int a = 0; a < 5; a++)
		for (int i = 0; i < 4; i++)
			for (int k = 0; k < 2; k++) {
				if (reference[a][i][k] == 0.0)
					continue;
				lobe_microsurface s = ggx(alphas[a]);
				s.joint = k ? LOBE_JOINT_SEPARABLE : LOBE_JOINT_HEIGHT;
				worst = larger(worst, fabs(albedo(s, mus[i]) - reference[a][i][k]));
			}
	measured("E(mu, alpha), 39 entries of four digits: off", worst, 6.5e-5);
}

/* Kelemen's and Neumann's have no masking of one direction. With GGX, alpha 1: D = 1/pi, and G2/(4 mu_o mu_i) is
 * 1/|H|^2 = 1/(2 + 2 o.i) or 1/(4 max): the integral of the latter is 1/4 + mu_o^2/4 - mu_o^2/2 ... done here by
 * sums. */
static double sum_over_hemisphere(double mu, int neumann)
{
	const int n = 2000, turns = 400;
	const double s_o = sqrt(1.0 - mu * mu);
	double sum = 0.0;
	for (int i = 0; i < n; i++) {
		const double z = (i + 0.5) / n, s = sqrt(1.0 - z * z);
		if (neumann) {
			sum += 2.0 * z / (4.0 * fmax(mu, z)) / n;
			continue;
		}
		for (int k = 0; k < turns; k++) {
			const double cosine = mu * z + s_o * s * cos(TWO_PI * (k + 0.5) / turns);
			sum += 2.0 * z / (2.0 + 2.0 * cosine) / ((double)n * turns);
		}
	}
	return sum;
}

static void test_kelemen_and_neumann(void)
{
	static const double mus[] = {0.9, 0.5, 0.2};
	double worst = 0.0, dimmest = 1.0, brightest = 0.0;
	for (int i = 0; i < 3; i++)
		for (int neumann = 0; neumann < 2; neumann++) {
			const double got = albedo(lobe_microsurface_masking(ggx(1.0), neumann ? LOBE_MASKING_NEUMANN
											      : LOBE_MASKING_KELEMEN),
						  mus[i]);
			worst = larger(worst, fabs(got - sum_over_hemisphere(mus[i], neumann)));
			printf("  %s, alpha 1, mu %.1f: albedo %.4f\n", neumann ? "Neumann" : "Kelemen", mus[i], got);
		}
	for (int i = 0; i < 3; i++) {
		dimmest = fmin(dimmest, albedo(lobe_microsurface_masking(ggx(0.01), LOBE_MASKING_NEUMANN), 0.5));
		brightest = larger(brightest, albedo(lobe_microsurface_masking(ggx(1.0), LOBE_MASKING_NONE), 0.1));
	}
	measured("Kelemen, Neumann: albedo against a sum, off", worst, 2e-4);
	/* A mirror's albedo is 1: Neumann's knows no width and takes half of it away; without masking light is made. */
	TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.5, dimmest);
	TEST_ASSERT_TRUE(brightest > 1.5);
}

/* --- joints ------------------------------------------------------------------------------------------------------- */

static const lobe_uint joints[] = {LOBE_JOINT_HEIGHT, LOBE_JOINT_SEPARABLE, LOBE_JOINT_DIRECTION,
				   LOBE_JOINT_HEIGHT_DIRECTION};

/* G2 of a pair on one side (of the facet between them), and G1 of each, by the surface's own masking. */
static double g2(lobe_microsurface s, lobe_vec3 o, lobe_vec3 i)
{
	const lobe_seen a = lobe_see(s, o, 1.0f), b = lobe_see(s, i, 1.0f);
	const lobe_vec3 h = lobe_vec3_add(o, i);
	return (double)a.z * (double)lobe_masking_g2_over_cos(s, a, b, seen_facet(o, i, h), 0);
}

static double g1(lobe_microsurface s, lobe_vec3 o)
{
	const lobe_seen a = lobe_see(s, o, 1.0f);
	return (double)a.z / (double)(a.z + a.hides);
}

/* G2 <= min(G1), = for i = o where directions are correlated; symmetric; between the separable and the least;
 * V-cavities and the across forms too. */
static void test_joints_keep_their_bounds(void)
{
	double above = 0.0, asymmetry = 0.0, same = 0.0, order = 0.0, cavity_above = 0.0, across_above = 0.0;
	for (uint32_t j = 0; j < 20000u; j++) {
		float a[3], b[3], u[3];
		test_direction(900u, j, a);
		test_direction(901u, j, b);
		test_u3(902u, j, u);
		const lobe_vec3 o = lobe_vec3_make(a[0], a[1], fabsf(a[2])),
				i = lobe_vec3_make(b[0], b[1], fabsf(b[2]));
		lobe_microsurface s = lobe_microsurface_make(
			shape_make(&shapes[j % SHAPES]),
			lobe_linear_make(0.01f + 0.9f * u[0], 0.0f, 0.3f * u[2], 0.01f + 0.9f * u[1], 0.0f, 0.0f));
		const double least = fmin(g1(s, o), g1(s, i)), product = g1(s, o) * g1(s, i);
		double got[4];
		for (int k = 0; k < 4; k++) {
			s.joint = joints[k];
			got[k] = g2(s, o, i);
			above = larger(above, got[k] / least - 1.0);
			order = larger(order, 1.0 - got[k] / product);
			asymmetry = larger(asymmetry, fabs(got[k] - g2(s, i, o)) / got[k]);
		}
		s.joint = LOBE_JOINT_DIRECTION;
		same = larger(same, fabs(g2(s, o, o) / g1(s, o) - 1.0));
		s.joint = LOBE_JOINT_HEIGHT_DIRECTION;
		same = larger(same, fabs(g2(s, o, o) / g1(s, o) - 1.0));
		s.masking = LOBE_MASKING_VCAVITY;
		const lobe_vec3 h = lobe_vec3_add(o, i);
		const double v_o = (double)lobe_vcavity_g1(o.z, lobe_dot(o, h), h.z),
			     v_i = (double)lobe_vcavity_g1(i.z, lobe_dot(i, h), h.z);
		cavity_above = larger(cavity_above, g2(s, o, i) - fmin(v_o, v_i));
		/* Across: what is seen through is no more than each sees. */
		s.masking = LOBE_MASKING_SMITH;
		s.across = LOBE_ACROSS_BETA;
		const lobe_vec3 below = lobe_vec3_make(i.x, i.y, -i.z);
		const lobe_seen so = lobe_see(s, o, 1.0f), si = lobe_see(s, below, -1.0f);
		const double beta = (double)so.z * (double)lobe_masking_g2_over_cos(s, so, si, seen_facet(o, i, h), 1);
		across_above = larger(across_above, beta / least - 1.0);
	}
	measured("G2 above min(G1), relative", above, 1e-6);
	measured("G1 G1 above G2, relative", order, 1e-6);
	measured("joints: |G2(o,i) - G2(i,o)|, relative", asymmetry, 1e-6);
	measured("direction-correlated, i = o: |G2/G1 - 1|", same, 1e-6);
	measured("V-cavities: G2 above min(G1)", cavity_above, 1e-6);
	measured("beta across above min(G1), relative", across_above, 1e-5);
}

/* Opposite azimuths at angle p = pi: l = 13.85/14.85; the factor wraps and knows no sense of rotation. */
static void test_van_ginneken(void)
{
	const double at_pi = 4.41 * PI / (4.41 * PI + 1.0);
	double worst = 0.0;
	for (int k = -400; k <= 400; k++) {
		const double p = PI * k / 100.0, wrapped = fabs(remainder(p, TWO_PI));
		const lobe_vec3 o = direction_at(0.5, 3.0), i = direction_at(0.2, 3.0 + p);
		const double expected = 4.41 * wrapped / (4.41 * wrapped + 1.0);
		worst = larger(worst, fabs((double)lobe_masking_azimuth_make(o, i).apart - expected));
	}
	measured("van Ginneken's factor, any azimuths: off", worst, 2e-6);
	const lobe_vec3 o = direction_at(0.3, 0.0), i = direction_at(0.2, PI);
	lobe_microsurface s = ggx(0.7);
	const double lo = 1.0 / g1(s, o) - 1.0, li = 1.0 / g1(s, i) - 1.0;
	s.joint = LOBE_JOINT_HEIGHT_DIRECTION;
	TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 / (1.0 + fmax(lo, li) + at_pi * fmin(lo, li)), g2(s, o, i));
	s.joint = LOBE_JOINT_DIRECTION;
	TEST_ASSERT_DOUBLE_WITHIN(1e-6, at_pi * g1(s, o) * g1(s, i) + (1.0 - at_pi) * fmin(g1(s, o), g1(s, i)),
				  g2(s, o, i));
	s.joint = LOBE_JOINT_HEIGHT;
	TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 / (1.0 + lo + li), g2(s, o, i));
}

/* Nothing jumps where a view passes from the mean plane's front to its back. */
static void test_behind_the_mean_plane(void)
{
	lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
						     lobe_linear_make(0.4f, 0.0f, 0.0f, 0.4f, 1.0f, 0.0f));
	const lobe_vec3 i = direction_at(0.9, 2.0);
	double jump = 0.0;
	for (int k = 0; k < 4; k++) {
		double value[2];
		for (int side = 0; side < 2; side++) {
			/* w.z - w.x = +- 1e-6 */
			const double angle = 0.25 * PI + (side ? 1e-6 : -1e-6);
			const lobe_vec3 o = lobe_vec3_make((float)cos(angle), 0.0f, (float)sin(angle));
			s.joint = joints[k];
			const lobe_vec3 h = lobe_vec3_add(o, i);
			value[side] = (double)lobe_masking_g2_over_cos(s, lobe_see(s, o, 1.0f), lobe_see(s, i, 1.0f),
								       seen_facet(o, i, h), 0);
			TEST_ASSERT_TRUE(value[side] > 0.0);
		}
		jump = larger(jump, fabs(value[0] / value[1] - 1.0));
	}
	measured("G2/z_o on both sides of the mean plane's edge, relative", jump, 1e-4);
	const lobe_vec3 o = direction_at(0.9, 2.0), back = direction_at(0.5, 0.0);
	TEST_ASSERT_EQUAL_FLOAT(0.0f, lobe_masking_g2_over_cos(s, lobe_see(s, o, 1.0f), lobe_see(s, back, 1.0f),
							       seen_facet(o, back, lobe_vec3_add(o, back)), 0));
}

/* --- beta --------------------------------------------------------------------------------------------------------- */

static void test_beta(void)
{
	double worst = 0.0, worst_scaled = 0.0;
	for (int i = 0; i <= 120; i++)
		for (int k = 0; k <= 120; k++) {
			const double a = (double)(float)(1.0 + (i ? pow(10.0, -4.0 + i * 0.1) : 0.0));
			const double b = (double)(float)(1.0 + (k ? pow(10.0, -4.0 + k * 0.1) : 0.0));
			const double exact = gsl_sf_lnbeta(a, b);
			if (exact < -85.0)
				continue;
			const double off = fabs((double)lobe_beta((float)a, (float)b) / exp(exact) - 1.0);
			worst = exact > -7.0 ? larger(worst, off) : worst;
			worst_scaled = larger(worst_scaled, off / (1.0 + fabs(exact)));
		}
	measured("B(a, b) against GSL where above 1e-3, relative", worst, 1.2e-6);
	measured("B(a, b), relative over 1 + |ln B|", worst_scaled, 2.3e-7);
	TEST_ASSERT_EQUAL_FLOAT(0.0f, lobe_beta(0x1p60f, 0x1p60f));
}

/* Walter's rational Lambda against Beckmann's own. */
static double beckmann_g1(double a)
{
	const double lambda = 0.5 * (erf(a) - 1.0) + exp(-a * a) / (2.0 * a * 1.7724538509055160273);
	return 1.0 / (1.0 + lambda);
}

static void test_rational(void)
{
	double worst = 0.0, uncut = 0.0;
	for (int k = 1; k <= 4000; k++) {
		const double a = 0.001 * k;
		const double s = 1.0 / sqrt(1.0 + a * a), z = a * s; /* width 1: a = cot */
		const lobe_vec3 v = lobe_vec3_make((float)s, 0.0f, (float)z);
		const double hidden = (double)lobe_beckmann_hidden_rational(v);
		worst = larger(worst, fabs(z / (z + hidden) - beckmann_g1(a)));
		const double lambda = (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a);
		uncut = larger(uncut, fabs(1.0 / (1.0 + lambda) - beckmann_g1(a)));
	}
	measured("Walter's rational G1 against Beckmann's: off", worst, 0.00312);
	/* Without Walter's cut at a = 1.6 it goes wrong. */
	TEST_ASSERT_TRUE(uncut > 0.03);
}

/* Near the root of its numerator, on which it ends, against the published polynomial in long double. */
static void test_rational_ends_with_its_digits(void)
{
	double off = 0.0, planted = 0.0;
	for (int k = 0; k <= 4000; k++) {
		const float z = 1.5f + 2.4e-5f * (float)k;
		const long double a = (long double)z;
		const long double exact = a * (1.0L - 1.259L * a + 0.396L * a * a) / (3.535L * a + 2.181L * a * a);
		const float sum = lobe_fma(1.0f, 1.0f, z * lobe_fma(0.396f, z, -1.259f));
		const double hidden = (double)lobe_beckmann_hidden_rational(lobe_vec3_make(1.0f, 0.0f, z));
		off = larger(off, fabs(hidden / (double)exact - 1.0));
		planted = larger(planted, fabs((double)(sum / (2.181f * z + 3.535f)) / (double)exact - 1.0));
	}
	measured("Walter's rational Lambda from 1.5 to 1.596, relative", off, 5e-7);
	TEST_ASSERT_TRUE(planted > 1e-4);
}

/* A lobe_seen of which masking uses z alone. */
static lobe_seen seen_z(float z)
{
	lobe_seen d = {{0.0f, 0.0f, 0.0f}, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
	d.z = z;
	return d;
}

/* G1 + G1 - 1 of V-cavities across the surface, in long double of the same areas, where one direction sees all of the
 * side or nearly so, and the other little. Planted: as it is written. */
static void test_vcavities_across(void)
{
	double off = 0.0, planted = 0.0;
	for (uint32_t i = 0; i < 100000u; i++) {
		const float least = powf(10.0f, -6.0f * test_uniform(21, i)), m_z = 0.1f + 0.9f * test_uniform(22, i);
		const float z = 0.05f + 0.95f * test_uniform(23, i);
		/* The greater is above 1, or below it by as much as the lesser is above 0 at most. */
		const float g = i % 2 ? 1.0f + test_uniform(24, i) : 1.0f - 0.9f * least * test_uniform(24, i);
		lobe_seen_facet m = {2.0f * m_z * z / g, 2.0f * m_z * z / least, m_z, 1.0f};
		const long double sees[2] = {fminl(1.0L, 2.0L * (long double)m_z * (long double)z / (long double)m.o),
					     fminl(1.0L, 2.0L * (long double)m_z * (long double)z / (long double)m.i)};
		const long double exact = sees[0] + sees[1] - 1.0L;
		if (exact < 0.1L * (long double)least)
			continue;
		const float as_is = lobe_vcavity_g1(z, m.o, m_z) - (1.0f - lobe_vcavity_g1(z, m.i, m_z));
		const double one = (double)(z * lobe_masking_vcavity(seen_z(z), seen_z(z), m, 1));
		const float swap = m.o;
		m.o = m.i;
		m.i = swap;
		const double other = (double)(z * lobe_masking_vcavity(seen_z(z), seen_z(z), m, 1));
		off = larger(off, larger(fabs(one / (double)exact - 1.0), fabs(other / (double)exact - 1.0)));
		planted = larger(planted, fabs((double)as_is / (double)exact - 1.0));
	}
	measured("V-cavities across: G1(o) + G1(i) - 1, relative", off, 2e-6);
	TEST_ASSERT_TRUE(planted > 1e-3);
}

/* Direction-correlated masking of nearly opposite azimuths is 1/14.85 of the lesser G1, and a product: the weight of
 * the lesser as a number of its own. Against long double of the same areas. */
static void test_direction_correlated_keeps_its_digits(void)
{
	double off = 0.0;
	for (uint32_t i = 0; i < 20000u; i++) {
		const double p = 3.0 + 0.14 * (double)test_uniform(31, i);
		const lobe_seen o =
			lobe_see(ggx(0.9), direction_at(1.5 * (double)test_uniform(32, i) + 0.05, 0.3), 1.0f);
		const lobe_seen a =
			lobe_see(ggx(0.9), direction_at(1.5 * (double)test_uniform(33, i) + 0.05, 0.3 + p), 1.0f);
		const long double angle = acosl(
			((long double)o.v.x * (long double)a.v.x + (long double)o.v.y * (long double)a.v.y) /
			sqrtl(((long double)o.v.x * (long double)o.v.x + (long double)o.v.y * (long double)o.v.y) *
			      ((long double)a.v.x * (long double)a.v.x + (long double)a.v.y * (long double)a.v.y)));
		const long double l = 4.41L * angle / (4.41L * angle + 1.0L);
		const long double g_o = (long double)o.z / ((long double)o.z + (long double)o.hides),
				  g_a = (long double)a.z / ((long double)a.z + (long double)a.hides);
		const long double exact = l * g_o * g_a + (1.0L - l) * fminl(g_o, g_a);
		const double got = (double)o.z * (double)lobe_masking_smith(LOBE_JOINT_DIRECTION, o, a);
		off = larger(off, fabs(got / (double)exact - 1.0));
	}
	measured("direction-correlated, opposite azimuths: relative", off, 1e-6);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_weak_furnace_is_1);
	RUN_TEST(test_weak_furnace_of_what_is_no_surface);
	RUN_TEST(test_albedo_at_alpha_1_is_exact);
	RUN_TEST(test_albedo_matches_the_reference_table);
	RUN_TEST(test_kelemen_and_neumann);
	RUN_TEST(test_joints_keep_their_bounds);
	RUN_TEST(test_van_ginneken);
	RUN_TEST(test_behind_the_mean_plane);
	RUN_TEST(test_beta);
	RUN_TEST(test_rational);
	RUN_TEST(test_rational_ends_with_its_digits);
	RUN_TEST(test_vcavities_across);
	RUN_TEST(test_direction_correlated_keeps_its_digits);
	return UNITY_END() != 0;
}
