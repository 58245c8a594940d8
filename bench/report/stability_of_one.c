/* stability_of_one.c - answers asked again with a reflectance, a cosine or a point of the sphere off by a rounding of
 * 1. */
#include "stability_of_one.h"

#include <math.h>
#include <string.h>

static lobe_vec3 vec3(const float w[3]) { return lobe_vec3_make(w[0], w[1], w[2]); }

static void take(stability_of_one *most, double size, stability_class cause)
{
	if (size > most->size) {
		most->size = size;
		most->cause = cause;
	}
}

/* Cosines of 1 in the areas that the sum is divided by, and the sum, which is meant for parts of the smooth surface's
 * value. */
static void diffuse(stability_of_one *most, const stability_case *c, stability_question q, const long double *x)
{
	const lobe_microsurface s = stability_bsdf(c).as.microfacet_diffuse.surface;
	const float wi[3] = {(float)x[3], (float)x[4], (float)x[5]};
	const lobe_seen o = lobe_see(s, vec3(c->wo), 1.0f), i = lobe_see(s, vec3(wi), 1.0f);
	const double cavity = s.masking == LOBE_MASKING_VCAVITY ? 0.5 / (double)o.z + 0.5 / (double)i.z : 0.0;
	const double reflectance = c->parameter[2 + c->channel];
	const double smooth =
		q.verb == STABILITY_WEIGHT ? reflectance : reflectance * (double)wi[2] * 0.318309886183790672;
	take(most,
	     (double)stability_answer(0, q, x) * (1.0 / (double)o.sigma + 1.0 / (double)i.sigma + cavity) * 0x1p-24,
	     STABILITY_FACETS);
	take(most, smooth * 0x1p-24, STABILITY_FACETS);
}

/* The directions of the same facet whose cosine to it is another by delta; e: far index over near one as wo sees it. 0
 * where there are none. */
static int nudged(const long double *x, long double e, long double delta, long double *y)
{
	const long double side = x[2] > 0.0L ? 1.0L : -1.0L;
	const int across = x[2] * x[5] < 0.0L;
	const long double e_r = across ? e : 1.0L;
	long double m[3], t[3], length = 0.0L, c = 0.0L, s = 0.0L;
	for (int k = 0; k < 3; k++)
		m[k] = side * (x[k] + e_r * x[3 + k]);
	const long double up = m[2] < 0.0L ? -1.0L : 1.0L;
	length = sqrtl(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
	if (!(length > 0.0L))
		return 0;
	for (int k = 0; k < 3; k++) {
		m[k] *= up / length;
		c += m[k] * side * x[k];
	}
	for (int k = 0; k < 3; k++) {
		t[k] = side * x[k] - c * m[k];
		s += t[k] * t[k];
	}
	const long double moved = c + delta, sine = sqrtl(fmaxl(0.0L, 1.0L - moved * moved));
	const long double g2 = e * e - 1.0L + moved * moved;
	if (!(s > 0.0L) || !(moved > 0.0L) || moved > 1.0L || (across && g2 < 0.0L))
		return 0;
	memcpy(y, x, STABILITY_INPUTS * sizeof *y);
	for (int k = 0; k < 3; k++) {
		const long double o = moved * m[k] + sine * t[k] / sqrtl(s);
		const long double i = across ? -(o + (sqrtl(g2) - moved) * m[k]) / e : 2.0L * moved * m[k] - o;
		y[k] = side * o;
		y[3 + k] = side * i;
	}
	return 1;
}

/* The cosine of wo to the facet. */
static double cosine_of(const long double *x, long double e)
{
	const long double e_r = x[2] * x[5] < 0.0L ? e : 1.0L;
	long double length2 = 0.0L, along = 0.0L;
	for (int k = 0; k < 3; k++) {
		const long double h = x[k] + e_r * x[3 + k];
		length2 += h * h;
		along += h * x[k];
	}
	return length2 > 0.0L ? (double)fminl(fabsl(along) / sqrtl(length2), 1.0L) : 1.0;
}

/* How often a wave goes to and fro in a film on glass before it is spent, by the amplitudes across the plane of
 * incidence; c: cosine on the near side, e: far index over near. */
static double bounces(double c, double e, double index, double base)
{
	const double thin2 = e < 1.0 ? 1.0 - (1.0 - c * c) / (e * e) : c * c;
	if (!(thin2 > 0.0))
		return 1.0;
	const double g = sqrt(index * index - 1.0 + thin2), far = sqrt(base * base - 1.0 + thin2);
	const double r12 = (g - sqrt(thin2)) / (g + sqrt(thin2)), r23 = fabs(far - g) / (far + g);
	return 1.0 / (1.0 - r12 * r23);
}

/* Films have GGX's surface and masking: what is left of an answer over that of a white one is the film's share, of a
 * weight over the mean share. Over a metal a film of index n resonates over about n/4 bounces. */
static void film(stability_of_one *most, const stability_case *c, stability_question q, const long double *x)
{
	const int glass = c->kind == LOBE_KIND_IRIDESCENT_DIELECTRIC;
	const double index = glass ? c->parameter[3] / fmin(c->parameter[4], 1.0) : c->parameter[3];
	const long double base = glass ? x[6 + 4] : 1.0L, e = x[2] > 0.0L ? base : 1.0L / base;
	const double often = glass ? bounces(cosine_of(x, e), (double)e, index, (double)fmaxl(base, 1.0L / base)) : 1.0;
	const double unit = 0x1p-22 * fmax(often, 0.25 * index);
	long double bare[STABILITY_INPUTS], moved[STABILITY_INPUTS];
	memcpy(bare, x, sizeof bare);
	if (glass) {
		bare[6 + 2] = x[6 + 4];
		bare[6 + 3] = x[6 + 5];
	}
	stability_question white = q, density = q;
	white.kind = glass ? LOBE_KIND_GGX_DIELECTRIC : LOBE_KIND_GGX_CONDUCTOR;
	white.white = 1;
	const long double value = stability_exact(white, bare);
	if (!(value > 0.0L))
		return;
	for (int side = -1; side <= 1; side += 2) {
		if (!nudged(x, e, side * 0x1p-24L, moved))
			continue;
		long double other[STABILITY_INPUTS];
		memcpy(other, bare, sizeof other);
		memcpy(other, moved, 6 * sizeof *other);
		const long double there = stability_exact(white, other);
		if (there > 0.0L) {
			const long double share = stability_double_build(q, x) / value;
			const long double share_there = stability_double_build(q, moved) / there;
			take(most, (double)(value * fabsl(share_there - share)), STABILITY_COSINE);
		}
	}
	if (!glass || q.verb != STABILITY_WEIGHT) {
		take(most, unit * (double)value, STABILITY_INTERFERENCE);
		return;
	}
	white.verb = density.verb = STABILITY_PDF;
	take(most, unit * (double)(value * stability_exact(white, bare)) / stability_double_build(density, x),
	     STABILITY_INTERFERENCE);
}

/* Glass of a surface that the textbook does not have: the facet and what it reflects are the same on a surface that it
 * has, by the ratios of its answers. Weights have no reflectance, as the event's share is that of the light. */
static void glass(stability_of_one *most, const stability_case *c, stability_question q, const long double *x)
{
	long double known[STABILITY_INPUTS], moved = 0.0L;
	const double value = stability_double_build(q, x);
	memcpy(known, x, sizeof known);
	known[6 + 8] = LOBE_NDF_GGX;
	known[6 + 15] = LOBE_MASKING_SMITH;
	const long double exact = stability_exact(q, known);
	if (q.verb != STABILITY_WEIGHT && exact > 0.0L) {
		for (int side = -1; side <= 1; side += 2) {
			q.nudge = side * 0x1p-24;
			moved = fmaxl(moved, fabsl(stability_exact(q, known) - exact));
		}
		take(most, value * (double)(moved / exact), STABILITY_COSINE);
		q.nudge = 0.0;
		q.white = 1;
		take(most, value * (double)(stability_exact(q, known) / exact) * 0x1p-24, STABILITY_INTERFACE);
	}
	const lobe_microsurface s = stability_bsdf(c).as.microfacet_dielectric.surface;
	const int smith = s.masking == LOBE_MASKING_SMITH || s.masking == LOBE_MASKING_SMITH_RATIONAL;
	if (x[2] * x[5] < 0.0L && smith && s.across == LOBE_ACROSS_BETA) {
		const float wi[3] = {(float)x[3], (float)x[4], (float)x[5]};
		const float side = c->wo[2] > 0.0f ? 1.0f : -1.0f;
		const double a = (double)lobe_masking_one_plus_lambda(lobe_see(s, vec3(c->wo), side));
		const double b = (double)lobe_masking_one_plus_lambda(lobe_see(s, vec3(wi), -side));
		const double log_beta = lgamma(a) + lgamma(b) - lgamma(a + b);
		take(most, value * (1.0 + fabs(log_beta)) * 0x1p-24, STABILITY_LOGARITHM);
	}
}

/* The square of a facet's slope in widths. */
static double steepness(lobe_vec3 f) { return (double)lobe_vec3_xy2(f) / ((double)f.z * (double)f.z); }

/* -log of what is seen of a Gaussian surface from behind its mean plane. */
static double tail(lobe_vec3 v)
{
	const double z = (double)v.z;
	return z < 0.0 ? z * z / (double)lobe_vec3_xy2(v) : 0.0;
}

/* What the headers of tabulated distributions say that a density or a hidden area is good for beyond ordinary ones, by
 * its share in its largest. */
static double rare(double share) { return share < 1e-4 ? 2e-5 : 0.0; }

static double rare_density(lobe_distribution d, lobe_vec3 h)
{
	const lobe_facet_density at = lobe_distribution_density(d, lobe_normalize(h));
	const lobe_facet_density peak = lobe_distribution_density(d, lobe_vec3_make(0.0f, 0.0f, 1.0f));
	return rare((double)(at.inv * at.inv * at.factor) / (double)(peak.inv * peak.inv * peak.factor));
}

/* Of a surface seen from behind its mean plane, which shows its hidden area alone. */
static double rare_hidden(lobe_distribution d, lobe_vec3 v)
{
	const lobe_vec3 rim = lobe_vec3_make(lobe_sqrt(lobe_vec3_xy2(v)), 0.0f, 0.0f);
	return v.z < 0.0f ? rare((double)lobe_distribution_hidden(d, v) / (double)lobe_distribution_hidden(d, rim)) : 0.0;
}

/* What a distribution is good for. Tabulated ones are what their headers say (gtr.h and its like: density 2e-6, hidden
 * 3e-6, and 2e-5 where they are rare), of which a reason is a sixteenth; a Gaussian's tails are as good as their
 * exponents. e: far index over near one. */
static void shape(stability_of_one *most, double value, lobe_microsurface s, const long double *x, long double e)
{
	const lobe_distribution d = s.distribution;
	const float side = x[2] > 0.0L ? 1.0f : -1.0f;
	const int across = x[2] * x[5] < 0.0L;
	const long double e_r = across ? e : 1.0L;
	const lobe_vec3 o = lobe_linear_direction(
		s.map, lobe_vec3_make(side * (float)x[0], side * (float)x[1], side * (float)x[2]));
	const lobe_vec3 i = lobe_linear_direction(
		s.map, lobe_vec3_make(side * (float)x[3], side * (float)x[4], side * (float)x[5]));
	const lobe_vec3 h = lobe_linear_facet(
		s.map, lobe_vec3_make(side * (float)(x[0] + e_r * x[3]), side * (float)(x[1] + e_r * x[4]),
				      side * (float)(x[2] + e_r * x[5])));
	if (d.ndf == LOBE_NDF_BECKMANN) {
		const double exponents = steepness(h) + tail(o) + (across ? 0.0 : tail(i));
		take(most, value * exponents * 0x1p-24, STABILITY_SHAPE);
	} else if (d.ndf != LOBE_NDF_GGX) {
		const double off = 5e-6 + rare_density(d, h) + rare_hidden(d, o) + (across ? 0.0 : rare_hidden(d, i));
		take(most, value * off / STABILITY_LIMIT, STABILITY_SHAPE);
	}
}

/* The surface of a comparison lobe, and the index that its facets refract by. */
static void shape_of(stability_of_one *most, double value, const stability_case *c, const long double *x)
{
	const lobe_bsdf b = stability_bsdf(c);
	if (c->kind == LOBE_KIND_MICROFACET_CONDUCTOR)
		shape(most, value, b.as.microfacet_conductor.surface, x, 1.0L);
	if (c->kind == LOBE_KIND_MICROFACET_DIELECTRIC)
		shape(most, value, b.as.microfacet_dielectric.surface, x,
		      x[2] > 0.0L ? x[6 + 2] : 1.0L / x[6 + 2]);
}

static stability_class reflectance_of(lobe_uint kind)
{
	switch (kind) {
	case LOBE_KIND_GGX_SCHLICK:
		return STABILITY_SCHLICK;
	case LOBE_KIND_GGX_CONDUCTOR:
	case LOBE_KIND_BECKMANN_CONDUCTOR:
	case LOBE_KIND_SMOOTH_CONDUCTOR:
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		return STABILITY_METAL;
	default:
		return STABILITY_INTERFACE;
	}
}

stability_of_one stability_of_one_make(const stability_case *c, stability_question q,
				       const long double x[STABILITY_INPUTS])
{
	stability_of_one most = {0.0, STABILITY_PLAIN};
	long double mirror[STABILITY_INPUTS], moved = 0.0L;
	switch (c->kind) {
	case LOBE_KIND_MICROFACET_DIFFUSE:
		diffuse(&most, c, q, x);
		return most;
	case LOBE_KIND_IRIDESCENT_CONDUCTOR:
	case LOBE_KIND_IRIDESCENT_DIELECTRIC:
		film(&most, c, q, x);
		return most;
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		if (stability_is_textbook(c))
			break;
		memcpy(mirror, x, sizeof mirror);
		mirror[6 + 19] = LOBE_FRESNEL_CONSTANT;
		for (int k = 2; k < 5; k++)
			mirror[6 + k] = 1.0L;
		take(&most, stability_double_build(q, mirror) * 0x1p-24, STABILITY_METAL);
		shape_of(&most, stability_double_build(q, x), c, x);
		return most;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		if (stability_is_textbook(c))
			break;
		glass(&most, c, q, x);
		shape_of(&most, stability_double_build(q, x), c, x);
		return most;
	default:
		break;
	}
	const long double exact = stability_exact(q, x);
	shape_of(&most, (double)exact, c, x);
	if (q.verb == STABILITY_DIRECTION) {
		/* By one rounding and by four: the answer may turn round in between. */
		for (int k = 0; k < 8; k++) {
			const double by = k & 4 ? 4.0 : 1.0;
			q.nudge = k & 1 ? by * 0x1p-24 : -by * 0x1p-24;
			q.white = k >> 1 & 1;
			moved = fmaxl(moved, fabsl(stability_exact(q, x) - exact) / (long double)by);
		}
		take(&most, fmax((double)moved, 0x1p-24), STABILITY_RIM);
		return most;
	}
	for (int side = -1; side <= 1; side += 2) {
		q.nudge = side * 0x1p-24;
		moved = fmaxl(moved, fabsl(stability_exact(q, x) - exact));
	}
	take(&most, (double)moved, STABILITY_COSINE);
	q.nudge = 0.0;
	q.white = 1;
	take(&most, fabs((double)stability_exact(q, x)) * 0x1p-24, reflectance_of(c->kind));
	return most;
}
