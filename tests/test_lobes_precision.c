/* test_lobes_precision.c - single precision against the same lobes in double (tests/double.c), and rough glass against
 * Walter's formula as the paper prints it.
 *
 * Both builds get the same floats, so what differs is rounding inside the lobe. A formula of n roundings none of which
 * is amplified is off by at most n u, u = 2^-24; where a difference of nearly equal numbers enters, its condition
 * multiplies u. ROUNDINGS counts the longest chain of a lobe (about 10 for Q and its square, 6 for masking, 10 for
 * Fresnel, 6 for the rest), conditions() the few places that amplify. Both come from the formulas, not from the result.
 */
#include "cases.h"
#include "cases_make.h"
#include "double.h"
#include "support.h"
#include "textbook.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

#define U         0x1p-24
#define ROUNDINGS 32.0

/* The condition of each part; their sum is what u is multiplied by, beside 1. */
typedef struct {
	double fresnel, index, input, tail;
	int undecided; /* total reflection hangs on the last bit */
} conditions;

static void widen(lobe_vec3 w, double v[3])
{
	v[0] = (double)w.x;
	v[1] = (double)w.y;
	v[2] = (double)w.z;
}

/* |F'| against F of a conductor: |r|^2 = |A + iK - c|^2/|A + iK + c|^2 cancels where the index is near that of air. */
static double conductor_condition(const test_case *c, double cosine)
{
	double worst = 0.0;
	for (int k = 0; k < 3; k++) {
		/* (A + iK)^2 = t + 2nk i, q its modulus. */
		const double n = c->parameter[2 + k], kappa = c->parameter[5 + k];
		const double t = n * n - kappa * kappa - (1.0 - cosine * cosine);
		const double q = hypot(t, 2.0 * n * kappa);
		const double x = 2.0 * sqrt(fmax(0.0, 0.5 * (q + t))) * cosine;
		worst = fmax(worst, (q + cosine * cosine + x) / fmax(q + cosine * cosine - x, 1e-30));
	}
	return worst;
}

/* Schlick's curve: a sum that cancels where it falls, and a power of 1 - c. */
static double schlick_condition(const test_case *c, double cosine)
{
	double worst = 0.0;
	const double m = fmax(1.0 - cosine, U), w = pow(m, 5.0);
	for (int k = 0; k < 3; k++) {
		const double f0 = c->parameter[2 + k], span = c->parameter[5 + k] - f0, f = f0 + span * w;
		if (f > 0.0)
			worst = fmax(worst, (f0 + fabs(span) * w * (6.0 + 10.0 / m)) / f);
	}
	return worst;
}

/* A thin film's R and 1 - R are means and differences of waves: what is off by a rounding of the phase is off by so
 * much of the whole, not of what is left. */
static double film_on_conductor_condition(const test_case *c, double cosine, lobe_film film, lobe_rgb eta, lobe_rgb k)
{
	const lobe_rgb f = lobe_thin_film_conductor_rgb((float)cosine, film, eta, k);
	return (8.0 + case_film_condition(c)) / fmax(fmin((double)f.r, (double)f.b), 1e-30);
}

static double iridescent_dielectric_condition(const test_case *c, double cosine, double e, int transmits)
{
	const lobe_iridescent_dielectric p = c->bsdf.as.iridescent_dielectric;
	const double cos_t = sqrt(fmax(0.0, 1.0 - (1.0 - cosine * cosine) / (e * e)));
	const lobe_film_fresnel f =
		lobe_thin_film_dielectric_rgb((float)(e < 1.0 ? cos_t : cosine), p.film, (float)fmax(e, 1.0 / e));
	const lobe_rgb share = transmits ? f.transmittance : f.reflectance;
	return (8.0 + case_film_condition(c)) / fmax(fmin((double)share.r, (double)share.b), 1e-30);
}

static double opaque_condition(const test_case *c, double cosine)
{
	const lobe_iridescent_conductor film = c->bsdf.as.iridescent_conductor;
	const lobe_fresnel_model f = c->bsdf.as.microfacet_conductor.fresnel;
	switch (c->kind) {
	case LOBE_KIND_GGX_SCHLICK:
		return schlick_condition(c, cosine);
	case LOBE_KIND_IRIDESCENT_CONDUCTOR:
		return film_on_conductor_condition(c, cosine, film.film, film.eta, film.k);
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return f.model == LOBE_FRESNEL_EXACT ? conductor_condition(c, cosine)
		       : f.model == LOBE_FRESNEL_FILM
			       ? film_on_conductor_condition(c, cosine, lobe_film_make(f.c, f.d), f.a, f.b)
			       : 1.0; /* sums of positive terms */
	default:
		return conductor_condition(c, cosine);
	}
}

static const lobe_microsurface *surface_of(const test_case *c)
{
	switch (c->kind) {
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return &c->bsdf.as.microfacet_conductor.surface;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		return &c->bsdf.as.microfacet_dielectric.surface;
	default:
		return NULL;
	}
}

/* A linear map's own cancellations: H on the surface of width 1, of whose squared length D is a negative power, and the
 * area of the mean plane, z - mean.w, as each direction sees it; and the logarithm of the beta function, whose error
 * comes with it. undecided: which face of the mean plane is seen hangs on the last bits. */
static double surface_condition(const lobe_microsurface *s, const double o[3], const double i[3], const double h[3],
				int *undecided)
{
	const lobe_linear *m = &s->map;
	const double up = h[2] < 0.0 ? -1.0 : 1.0, hz = up * h[2];
	const double x = up * h[0] + (double)m->mean_x * hz, y = up * h[1] + (double)m->mean_y * hz;
	const double big_x = fabs(h[0]) + fabs((double)m->mean_x) * hz,
		     big_y = fabs(h[1]) + fabs((double)m->mean_y) * hz;
	const double fx = (double)m->ixx * x + (double)m->ixy * y, fy = (double)m->iyx * x + (double)m->iyy * y;
	const double big_fx = fabs((double)m->ixx) * big_x + fabs((double)m->ixy) * big_y;
	const double big_fy = fabs((double)m->iyx) * big_x + fabs((double)m->iyy) * big_y;
	/* D is a power of 1 + tan^2; other than GGX's it is the exponential of a logarithm, whose error grows with
	 * it. */
	const lobe_distribution d = s->distribution;
	const double power = d.ndf == LOBE_NDF_PHONG ? 0.5 * (double)d.exponent + 2.0 : fmax(2.0, (double)d.exponent);
	const double length2 = fx * fx + fy * fy + hz * hz;
	double sum = 2.0 * power * ((fabs(fx) * big_fx + fabs(fy) * big_fy + hz * hz) / length2 - 1.0);
	if (d.ndf != LOBE_NDF_GGX)
		sum += 4.0 * power * log(length2 / (hz * hz));
	double log_beta = 0.0, gammas = 0.0;
	const double *const w[2] = {o, i};
	for (int k = 0; k < 2; k++) {
		const double a = (double)m->mean_x * w[k][0], b = (double)m->mean_y * w[k][1];
		const double z = fabs(w[k][2] - a - b), size = fabs(w[k][2]) + fabs(a) + fabs(b);
		const double vx = (double)m->xx * w[k][0] + (double)m->yx * w[k][1];
		const double vy = (double)m->xy * w[k][0] + (double)m->yy * w[k][1];
		const double one_plus_lambda = 0.5 * (sqrt(vx * vx + vy * vy + z * z) / z + 1.0);
		*undecided |= z < 8.0 * U * size;
		sum += size / z - 1.0;
		log_beta += lgamma(one_plus_lambda);
		gammas += one_plus_lambda;
	}
	/* What both see of a cavity's side: G1(o) + G1(i) - 1. */
	const double g_o = fmin(1.0, 2.0 * hz * fabs(o[2]) / fabs(textbook_dot(o, h)));
	const double g_i = fmin(1.0, 2.0 * hz * fabs(i[2]) / fabs(textbook_dot(i, h)));
	if (s->masking == LOBE_MASKING_VCAVITY && o[2] * i[2] < 0.0) {
		sum += 2.0 / fabs(g_o + g_i - 1.0);
		*undecided |= fabs(g_o + g_i - 1.0) < 64.0 * U;
	}
	if (s->across == LOBE_ACROSS_BETA && o[2] * i[2] < 0.0)
		sum += 8.0 * fabs(log_beta - lgamma(gammas)) + gammas;
	return sum;
}

/* A facet's i.m and o.m are differences where it is steep: what they are off by is some u of 1, to be compared with
 * their mean over the facets, of which Lambert's cosine is a measure. A cavity besides divides by them, where they are
 * above 2 z. */
static double diffuse_condition(const test_case *c, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_microfacet_diffuse p = c->bsdf.as.microfacet_diffuse;
	const lobe_seen o = lobe_see(p.surface, wo, 1.0f), i = lobe_see(p.surface, wi, 1.0f);
	if (!(o.sigma > 0.0f && i.sigma > 0.0f))
		return 0.0;
	const double cavity = p.surface.masking == LOBE_MASKING_VCAVITY ? 0.5 / (double)o.z + 0.5 / (double)i.z : 0.0;
	return 1.0 / (double)o.sigma + 1.0 / (double)i.sigma + cavity;
}

/* inexact: how far the directions themselves are off, in u (0 where both sides get the same ones). */
static conditions condition_of(const test_case *c, lobe_vec3 wo_f, lobe_vec3 wi_f, double inexact)
{
	conditions r = {0.0, 0.0, 0.0, 0.0, 0};
	double o[3], i[3], h[3], sum_oh = 0.0, sum_ih = 0.0;
	if (c->kind == LOBE_KIND_MICROFACET_DIFFUSE)
		r.tail = diffuse_condition(c, wo_f, wi_f);
	if (c->alpha_x <= 0.0)
		return r;
	widen(wo_f, o);
	widen(wi_f, i);
	const int transmits = o[2] * i[2] < 0.0;
	const double e_view = o[2] > 0.0 ? c->eta : 1.0 / c->eta;
	const double e = transmits ? e_view : 1.0;
	for (int k = 0; k < 3; k++) {
		h[k] = o[k] + e * i[k];
		sum_oh += fabs(o[k] * h[k]);
		sum_ih += fabs(i[k] * h[k]);
	}
	const double ax2 = c->alpha_x * c->alpha_x, ay2 = c->alpha_y * c->alpha_y;
	const double size = sqrt(textbook_dot(h, h));
	const double oh = fabs(textbook_dot(o, h)), ih = fabs(textbook_dot(i, h));
	const double q = h[0] * h[0] / ax2 + h[1] * h[1] / ay2 + h[2] * h[2];
	/* A quarter of the gradient of log D: of -2 log q, or of -tan^2 - 4 log h.z, whose exponent besides carries its
	 * own roundings into the result. */
	double slope = sqrt(h[0] * h[0] / (ax2 * ax2) + h[1] * h[1] / (ay2 * ay2) + h[2] * h[2]) / q;
	if (c->ndf == TEXTBOOK_BECKMANN) {
		const double z = fabs(h[2]), gx = h[0] / (ax2 * z * z), gy = h[1] / (ay2 * z * z);
		r.tail = (h[0] * h[0] / ax2 + h[1] * h[1] / ay2) / (z * z);
		slope = 0.5 * sqrt(gx * gx + gy * gy) + (0.5 * r.tail + 1.0) / z;
	}
	const double mapped = surface_of(c) ? surface_condition(surface_of(c), o, i, h, &r.undecided) : 0.0;
	if (!(c->flags & CASE_TRANSMITS)) {
		r.fresnel = mapped + opaque_condition(c, fmin(0.5 * size, 1.0));
		r.input = inexact * (4.0 * slope + 4.0 / size);
		return r;
	}
	/* o.H of a reflection is |H|^2/2, a sum of squares; of a refraction it is a dot product with its own
	 * cancellation. */
	const double dots = transmits ? sum_oh / oh + sum_ih / ih : 0.0;
	const double cosine = transmits ? oh / size : 0.5 * size;
	const double g2 = cosine * cosine + (e_view - 1.0) * (e_view + 1.0);
	const double g2_off =
		cosine * cosine * (1.0 + dots) + fabs(e_view * e_view - 1.0) + (o[2] < 0.0 ? e_view * e_view : 0.0);
	/* transmittance goes with g, reflectance with 1 - 4 g/c. */
	const double tir = e_view < 1.0 ? (transmits ? g2_off / fabs(g2) : g2_off / sqrt(fabs(g2)) / cosine) : 0.0;
	r.undecided |= e_view < 1.0 && fabs(g2) < 4.0 * U * (g2_off + inexact);
	r.fresnel = dots + tir + mapped;
	if (c->kind == LOBE_KIND_IRIDESCENT_DIELECTRIC)
		r.fresnel = iridescent_dielectric_condition(c, fmin(cosine, 1.0), e_view, transmits) *
			    (1.0 + dots + (e_view < 1.0 ? g2_off / fabs(g2) : 0.0));
	/* 1/eta is rounded, eta is not: from below H = o + i/eta inherits it, and e - 1 too. */
	if (o[2] < 0.0)
		r.index =
			e_view / fabs(e_view - 1.0) + (transmits ? e_view * (4.0 * slope + 1.0 / oh + 1.0 / ih) : 0.0);
	r.input = inexact * ((1.0 + e) * (4.0 * slope + 1.0 / oh + 1.0 / ih) + (e_view < 1.0 ? 1.0 / fabs(g2) : 0.0));
	return r;
}

typedef struct {
	unsigned long pairs;
	double well, at_well, extreme, worst_condition, ratio;
	const char *name_well, *name_ratio;
	unsigned long bad;
} tally;

/* Well conditioned: at most 10 u of amplification. */
static void compare(tally *t, const test_case *c, lobe_vec3 wo, lobe_vec3 wi, double got, double exact)
{
	/* Below, a float is subnormal and has fewer bits; above, it overflows. */
	if (!(exact > 1e-32 && exact < 1e37))
		return;
	const conditions k = condition_of(c, wo, wi, 0.0);
	if (k.undecided)
		return;
	const double amplified = k.fresnel + k.index + k.tail;
	const double off = fabs(got - exact) / exact;
	const double ratio = off / (U * (1.0 + amplified));
	t->pairs++;
	if (amplified <= 10.0 && off > t->well) {
		t->well = off;
		t->name_well = c->name;
		t->at_well = (double)wo.z;
	}
	if (amplified > 10.0)
		t->extreme = fmax(t->extreme, off);
	if (ratio > t->ratio) {
		t->ratio = ratio;
		t->name_ratio = c->name;
		t->worst_condition = amplified;
	}
	if (ratio > ROUNDINGS && t->bad++ < 4)
		printf("  %s: wo (%.9g %.9g %.9g) wi (%.9g %.9g %.9g): %.9g, double %.9g, off %.1e, condition %.1e\n",
		       c->name, (double)wo.x, (double)wo.y, (double)wo.z, (double)wi.x, (double)wi.y, (double)wi.z, got,
		       exact, off, amplified);
}

static void print_tally(const char *what, const tally *t)
{
	printf("  %-22s %7lu: relative error <= %.2e = %4.1f u (%s, cos %.0e); ill conditioned %.1e; any: %4.1f u "
	       "times the "
	       "condition (%s, %.0e)\n",
	       what, t->pairs, t->well, t->well / U, t->name_well ? t->name_well : "-", t->at_well, t->extreme,
	       t->ratio, t->name_ratio ? t->name_ratio : "-", t->worst_condition);
}

static void test_float_against_double(void)
{
	const uint32_t n = test_long() ? 20000u : 1000u;
	unsigned long bad = 0;
	for (int side = 0; side < 2; side++) {
		tally eval[3] = {{0}}, pdf[3] = {{0}};
		for (size_t i = 0; i < case_count(); i++) {
			const test_case *c = case_at(i);
			const int group = c->kind == LOBE_KIND_LAMBERT ? 0 : c->flags & CASE_TRANSMITS ? 2 : 1;
			for (size_t k = 0; k < case_wo_count(c); k++)
				for (uint32_t j = 0; j < n; j++) {
					float u[3];
					double o[3], d[3], f[3];
					const lobe_vec3 wo = case_wo(k);
					/* A random direction, or a sample and so a direction where the lobe is. */
					lobe_vec3 wi;
					if (j & 1u) {
						test_direction(70000u + (uint32_t)i, k * n + j, u);
						wi = lobe_vec3_make(u[0], u[1], u[2]);
					} else {
						test_u3(71000u + (uint32_t)i, k * n + j, u);
						wi = lobe_bsdf_sample(c->bsdf, wo, lobe_vec3_make(u[0], u[1], u[2])).wi;
					}
					if ((wo.z * wi.z > 0.0f) != (side == 0))
						continue;
					widen(wo, o);
					widen(wi, d);
					double_eval(c->kind, c->parameter, o, d, f);
					compare(&pdf[group], c, wo, wi, (double)lobe_bsdf_pdf(c->bsdf, wo, wi),
						double_pdf(c->kind, c->parameter, o, d));
					const lobe_rgb e = lobe_bsdf_eval(c->bsdf, wo, wi);
					compare(&eval[group], c, wo, wi, (double)e.r, f[0]);
					compare(&eval[group], c, wo, wi, (double)e.b, f[2]);
				}
		}
		static const char *const groups[] = {"diffuse", "metal", "glass"};
		for (int g = 0; g < 3; g++) {
			char name[64];
			if (side == 1 && g < 2)
				continue;
			sprintf(name, "%s %s eval", groups[g], side ? "transmitted" : "reflected");
			print_tally(name, &eval[g]);
			sprintf(name, "%s %s pdf", groups[g], side ? "transmitted" : "reflected");
			print_tally(name, &pdf[g]);
			TEST_ASSERT_GREATER_THAN(5000, eval[g].pairs);
			bad += eval[g].bad + pdf[g].bad;
		}
	}
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* The double build is the same code, so it shares the library's algebra; the textbook shares neither. alpha .05 .. 1,
 * eta 1.05 .. 3 and its inverse, both sides, |cos| > .02. Directions are floats, unit to u, which the textbook takes as
 * they are: condition_of counts that. */
static void rough_glass_against_walter(textbook_ndf ndf)
{
	unsigned long n[2] = {0}, bad = 0, unscaled = 0;
	double worst[2] = {0}, worst_ratio = 0.0, worst_double = 0.0;
	for (uint32_t j = 0; j < 400000u; j++) {
		float u[3], a[3], b[3];
		test_u3(80000u, j, u);
		test_direction(80001u, j, a);
		test_direction(80002u, j, b);
		if (fabsf(a[2]) < 0.02f || fabsf(b[2]) < 0.02f)
			continue;
		const lobe_real ax = 0.05f + 0.95f * u[0] * u[0], ay = 0.05f + 0.95f * u[1] * u[1];
		const lobe_real up = 1.05f + 1.95f * u[2], eta = j & 1u ? up : 1.0f / up;
		const lobe_vec3 wo = lobe_vec3_make(a[0], a[1], a[2]), wi = lobe_vec3_make(b[0], b[1], b[2]);
		test_case c = {"random glass",
			       LOBE_KIND_GGX_DIELECTRIC,
			       {0},
			       {0},
			       CASE_TWO_SIDED | CASE_TRANSMITS,
			       0,
			       0,
			       0,
			       0,
			       ndf};
		if (ndf == TEXTBOOK_BECKMANN)
			c.kind = LOBE_KIND_BECKMANN_DIELECTRIC;
		c.alpha_x = c.parameter[0] = (double)ax;
		c.alpha_y = c.parameter[1] = (double)ay;
		c.eta = c.parameter[2] = (double)eta;
		double o[3], i[3], f[3];
		widen(wo, o);
		widen(wi, i);
		textbook_normalize(o);
		textbook_normalize(i);
		const double exact = textbook_rough_glass(ndf, c.alpha_x, c.alpha_y, c.eta, o, i);
		c.bsdf = make_bsdf(c.kind, c.parameter);
		const double got = (double)lobe_bsdf_eval(c.bsdf, wo, wi).g;
		const conditions k = condition_of(&c, wo, wi, 1.0);
		if (k.undecided)
			continue;
		const int across = wo.z * wi.z < 0.0f;
		if (exact < 1e-20) {
			bad += got > 1e-12 * (1.0 + k.input);
			continue;
		}
		const double amplified = k.fresnel + k.index + k.input + k.tail;
		const double off = fabs(got - exact) / exact;
		/* In double, with directions unit to 2^-53, nothing but algebra is left. */
		double_eval(c.kind, c.parameter, o, i, f);
		const double off_double = fabs(f[1] - exact) / exact;
		n[across]++;
		if (amplified <= 100.0) {
			worst[across] = fmax(worst[across], off);
			worst_double = fmax(worst_double, off_double);
		}
		const double ratio = off / (U * (1.0 + amplified));
		worst_ratio = fmax(worst_ratio, ratio);
		/* A forgotten square of eta, which is what importance is, has to show. */
		const double e = a[2] > 0.0f ? c.eta : 1.0 / c.eta;
		unscaled += across && fabs(got * e * e - exact) / exact > ROUNDINGS * U * (1.0 + amplified);
		if ((ratio > ROUNDINGS || off_double > 1e-9 * (1.0 + amplified)) && bad++ < 4)
			printf("  alpha %.9g %.9g eta %.9g wo (%.9g %.9g %.9g) wi (%.9g %.9g %.9g): %.9g, Walter %.9g, "
			       "condition %.1e\n",
			       (double)ax, (double)ay, (double)eta, (double)wo.x, (double)wo.y, (double)wo.z,
			       (double)wi.x, (double)wi.y, (double)wi.z, got, exact, amplified);
	}
	printf("  Walter 2007, %s: %lu reflections off by at most %.1e, %lu refractions by %.1e where well conditioned "
	       "(double build "
	       "%.1e); %.1f u times the condition anywhere\n",
	       ndf == TEXTBOOK_BECKMANN ? "Beckmann" : "GGX", n[0], worst[0], n[1], worst[1], worst_double,
	       worst_ratio);
	/* Beckmann has next to no tails, and pairs of random directions mostly lie there. */
	TEST_ASSERT_GREATER_THAN(50000, n[0]);
	TEST_ASSERT_GREATER_THAN(ndf == TEXTBOOK_BECKMANN ? 20000 : 30000, n[1]);
	TEST_ASSERT_EQUAL_UINT(0, bad);
	TEST_ASSERT_GREATER_THAN(n[1] / 100 * 99, unscaled);
}

static void test_rough_glass_against_walter(void)
{
	rough_glass_against_walter(TEXTBOOK_GGX);
	rough_glass_against_walter(TEXTBOOK_BECKMANN);
}

/* The same for metals, of every index in optics.def. */
static void rough_metal_against_the_textbook(textbook_ndf ndf)
{
	unsigned long n = 0, bad = 0;
	double worst = 0.0, worst_ratio = 0.0;
	for (uint32_t j = 0; j < 200000u; j++) {
		float u[3], a[3], b[3];
		test_u3(81000u, j, u);
		test_direction(81001u, j, a);
		test_direction(81002u, j, b);
		if (fabsf(a[2]) < 0.02f || fabsf(b[2]) < 0.02f)
			continue;
		const lobe_real ax = 0.05f + 0.95f * u[0] * u[0], ay = 0.05f + 0.95f * u[1] * u[1];
		const lobe_rgb eta = lobe_metal_eta(j % LOBE_METAL_COUNT), kappa = lobe_metal_k(j % LOBE_METAL_COUNT);
		const lobe_vec3 wo = lobe_vec3_make(a[0], a[1], fabsf(a[2])),
				wi = lobe_vec3_make(b[0], b[1], fabsf(b[2]));
		test_case c = {"random metal", LOBE_KIND_GGX_CONDUCTOR, {0}, {0}, 0, 0, 0, 0, 0, ndf};
		if (ndf == TEXTBOOK_BECKMANN)
			c.kind = LOBE_KIND_BECKMANN_CONDUCTOR;
		c.alpha_x = c.parameter[0] = (double)ax;
		c.alpha_y = c.parameter[1] = (double)ay;
		c.parameter[2] = (double)eta.r;
		c.parameter[3] = (double)eta.g;
		c.parameter[4] = (double)eta.b;
		c.parameter[5] = (double)kappa.r;
		c.parameter[6] = (double)kappa.g;
		c.parameter[7] = (double)kappa.b;
		double o[3], i[3];
		widen(wo, o);
		widen(wi, i);
		textbook_normalize(o);
		textbook_normalize(i);
		c.bsdf = make_bsdf(c.kind, c.parameter);
		const lobe_rgb f = lobe_bsdf_eval(c.bsdf, wo, wi);
		const double got[3] = {(double)f.r, (double)f.g, (double)f.b};
		const conditions k = condition_of(&c, wo, wi, 1.0);
		for (int m = 0; m < 3; m++) {
			const double exact = textbook_rough_metal(ndf, c.alpha_x, c.alpha_y, c.parameter[2 + m],
								  c.parameter[5 + m], o, i);
			if (exact < 1e-30) { /* the tails of Beckmann */
				bad += got[m] > 1e-20;
				continue;
			}
			const double off = fabs(got[m] - exact) / exact;
			const double ratio = off / (U * (1.0 + k.fresnel + k.input + k.tail));
			n++;
			worst = fmax(worst, off);
			worst_ratio = fmax(worst_ratio, ratio);
			bad += ratio <= ROUNDINGS ? 0u : 1u;
		}
	}
	printf("  rough metal, textbook, %s: %lu values off by at most %.1e, %.1f u times the condition\n",
	       ndf == TEXTBOOK_BECKMANN ? "Beckmann" : "GGX", n, worst, worst_ratio);
	TEST_ASSERT_GREATER_THAN(ndf == TEXTBOOK_BECKMANN ? 200000 : 300000, n);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

static void test_rough_metal_against_the_textbook(void)
{
	rough_metal_against_the_textbook(TEXTBOOK_GGX);
	rough_metal_against_the_textbook(TEXTBOOK_BECKMANN);
}

/* What the comparison rests on: a relative error of 1e-5 in one value is seen. */
static void test_a_planted_error_is_caught(void)
{
	tally t = {0};
	const test_case *c = case_at(0);
	const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
	compare(&t, c, up, up, 1.0 + 20.0 * U, 1.0);
	TEST_ASSERT_EQUAL_UINT(0, t.bad);
	t.bad = 100; /* says nothing */
	compare(&t, c, up, up, 1.0 + 1e-5, 1.0);
	TEST_ASSERT_EQUAL_UINT(101, t.bad);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_float_against_double);
	RUN_TEST(test_rough_glass_against_walter);
	RUN_TEST(test_rough_metal_against_the_textbook);
	RUN_TEST(test_a_planted_error_is_caught);
	return UNITY_END() != 0;
}
