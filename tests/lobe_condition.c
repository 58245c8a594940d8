#include "lobe_condition.h"

#include "support.h"
#include "textbook.h"

#include <math.h>

#define U 0x1p-24

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

/* By how much the height of a facet counts that is nearly vertical, seen from below: H.z = o.z + i.z/eta inherits the
 * rounding of 1/eta. Densities fall with a power of it (as slopes do, of D itself 4 less), facets are counted by their
 * area on the plane, and cavities show of their sides what is in proportion to it. */
static double height_condition(const lobe_microsurface *s, double e, double iz, double hz)
{
	const lobe_distribution d = s->distribution;
	const double exponent = d.ndf == LOBE_NDF_PHONG ? 0.5 * (double)d.exponent + 2.0 : (double)d.exponent;
	const double power = d.ndf == LOBE_NDF_GGX || d.ndf == LOBE_NDF_BECKMANN ? 0.0 : fmax(0.0, 2.0 * exponent - 4.0);
	return (1.0 + power) * e * fabs(iz / hz);
}

/* A facet's i.m and o.m are differences where it is steep: what they are off by is some u of 1, to be compared with
 * their mean over the facets, of which Lambert's cosine is a measure where both directions see the same ones. A cavity
 * besides divides by them, where they are above 2 z. */
static double diffuse_condition(const test_case *c, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_microfacet_diffuse p = c->bsdf.as.microfacet_diffuse;
	const lobe_seen o = lobe_see(p.surface, wo, 1.0f), i = lobe_see(p.surface, wi, 1.0f);
	if (!(o.sigma > 0.0f && i.sigma > 0.0f))
		return 0.0;
	const double cavity = p.surface.masking == LOBE_MASKING_VCAVITY ? 0.5 / (double)o.z + 0.5 / (double)i.z : 0.0;
	const double smooth = (double)p.reflectance.r * (double)wi.z / PI;
	const double rough = (double)lobe_microfacet_diffuse_eval(p, wo, wi).r;
	return (1.0 / (double)o.sigma + 1.0 / (double)i.sigma + cavity) * fmax(1.0, smooth / fmax(rough, 1e-30));
}

conditions condition_of(const test_case *c, lobe_vec3 wo_f, lobe_vec3 wi_f, double inexact)
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
	if (o[2] < 0.0 && transmits && surface_of(c))
		r.index += height_condition(surface_of(c), e_view, i[2], h[2]);
	r.input = inexact * ((1.0 + e) * (4.0 * slope + 1.0 / oh + 1.0 / ih) + (e_view < 1.0 ? 1.0 / fabs(g2) : 0.0));
	return r;
}
