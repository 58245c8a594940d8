/* furnaces_energy.c - the energy that a surface sends back in constant light, and the facets that a direction sees. */
#include <math.h>

#include "furnaces.h"
#include "pi.h"
#include "textbook.h"

static const double tolerances[] = {1e-4, 5e-6, 5e-7};
static const size_t points_most[] = {32, 64, 64};

/* --- white furnace ------------------------------------------------------------------------------------------------ */

typedef struct {
	const furnaces_surface *surface;
	lobe_bsdf bsdf;
	lobe_vec3 wo;
	double side;
} view;

static lobe_rgb eval(const view *v, const double wi[3])
{
	const lobe_vec3 w = lobe_vec3_make((float)wi[0], (float)wi[1], (float)(v->side * wi[2]));
	return v->surface->eval ? v->surface->eval(v->bsdf, v->wo, w) : lobe_bsdf_eval(v->bsdf, v->wo, w);
}

static void add_rgb(double sum[3], double weight, lobe_rgb f)
{
	sum[0] += weight * (double)f.r;
	sum[1] += weight * (double)f.g;
	sum[2] += weight * (double)f.b;
}

static void add_reflected(const furnaces_integrand *f, const furnaces_facet *m, double weight, double sum[3])
{
	const double scale = 2.0 * m->facing / m->length2;
	const double wi[3] = {scale * m->s[0] - f->o[0], scale * m->s[1] - f->o[1], scale * m->s[2] - f->o[2]};
	/* dwi = 4 o.m dm */
	add_rgb(sum, weight * 4.0 * m->facing / sqrt(m->length2), eval(f->context, wi));
}

/* i = -(o + (g - c) m)/e, and dwi = (g - c)^2/(e g) dm: Walter et al. 2007, eqs. 17 and 40, with g the cosine on the
 * far side times e. */
static void add_refracted(const furnaces_integrand *f, const furnaces_facet *m, double weight, double sum[3])
{
	const double length = sqrt(m->length2), c = m->facing / length, step2 = (f->e - 1.0) * (f->e + 1.0);
	const double g2 = c * c + step2, g = sqrt(fmax(g2, 0.0)), step = step2 / (g + c);
	double wi[3];
	/* Next to total reflection to all digits, on pieces as narrow as a rounding. */
	if (!(g2 > 0.0))
		return;
	for (int k = 0; k < 3; k++)
		wi[k] = -(f->o[k] + step * m->s[k] / length) / f->e;
	add_rgb(sum, weight * step * step / (f->e * g), eval(f->context, wi));
}

/* Half a rounding of wi moves the half vector, 2 o.m long, by so many widths; the errors of some thousand points are
 * independent. */
static double rounding(const furnaces_made *made, double cosine)
{
	return 0x1p-24 / (2.0 * fmax(cosine, 0x1p-24) * fmin(made->ax, made->ay)) / 32.0;
}

static void over_facets(const view *v, const furnaces_made *made, furnaces_effort effort, furnaces_energy *e)
{
	furnaces_integrand f = {
		.ax = made->ax, .ay = made->ay, .tail = made->tail, .context = v, .kinks = v->surface->kinks};
	const double tolerance = tolerances[effort];
	const size_t most = points_most[effort];
	f.o[0] = (double)v->wo.x;
	f.o[1] = 0.0;
	f.o[2] = v->side * (double)v->wo.z;
	textbook_normalize(f.o);
	f.e = made->eta > 0.0 ? (v->side > 0.0 ? made->eta : 1.0 / made->eta) : 1.0;
	f.add = add_reflected;
	f.bounds = 1u << FURNACES_VISIBLE | 1u << FURNACES_REFLECTED;
	if (made->eta > 0.0 && f.e < 1.0)
		f.kinks |= 1u << FURNACES_TOTAL;
	e->error = furnaces_integral(&f, 1.0, tolerance, most, e->rgb) + rounding(made, f.o[2]);
	if (made->eta > 0.0) {
		double rest[3];
		f.add = add_refracted;
		f.kinks = 0;
		f.bounds = 1u << FURNACES_VISIBLE | 1u << FURNACES_REFRACTED | (f.e < 1.0 ? 1u << FURNACES_TOTAL : 0u);
		e->error += furnaces_integral(&f, 1.0, tolerance, most, rest);
		for (int k = 0; k < 3; k++)
			e->rgb[k] += rest[k];
	}
}

/* Equal steps of the cosine and the azimuth. */
static void sum_directions(const view *v, int n, double sum[3])
{
	sum[0] = sum[1] = sum[2] = 0.0;
	for (int i = 0; i < n; i++)
		for (int k = 0; k < n; k++) {
			const double z = (i + 0.5) / n, s = sqrt((1.0 - z) * (1.0 + z)), phi = PI * (k + 0.5) / n;
			const double wi[3] = {s * cos(phi), s * sin(phi), z};
			add_rgb(sum, 2.0 * PI / ((double)n * n), eval(v, wi));
		}
}

/* Middles of cells converge with their square, but eval's own fixed facets make jumps that do not: what is stated is
 * the greater change from a half and from a third of the points, which are not both small by chance. */
static void over_directions(const view *v, furnaces_effort effort, furnaces_energy *e)
{
	static const int sides[] = {12, 24, 48};
	const int n = sides[effort];
	sum_directions(v, n, e->rgb);
	for (int part = 2; part <= 3; part++) {
		double coarse[3];
		sum_directions(v, n / part, coarse);
		for (int k = 0; k < 3; k++)
			e->error = fmax(e->error, fabs(e->rgb[k] - coarse[k]));
	}
}

/* u.z chooses between reflection and transmission: both ends of it show both events, or one of them twice. */
static void over_events(const view *v, furnaces_energy *e)
{
	const lobe_sample first = lobe_bsdf_sample(v->bsdf, v->wo, lobe_vec3_make(0.5f, 0.5f, 0.0f));
	const lobe_sample last = lobe_bsdf_sample(v->bsdf, v->wo, lobe_vec3_make(0.5f, 0.5f, 1.0f - 0x1p-24f));
	add_rgb(e->rgb, (double)first.pdf, first.weight);
	if (last.event != first.event)
		add_rgb(e->rgb, (double)last.pdf, last.weight);
	e->error = 4.0 * 0x1p-24;
}

furnaces_energy furnaces_energy_at(const furnaces_surface *s, double value, double cosine, furnaces_effort effort)
{
	const furnaces_made made = s->make(s, value);
	const double side = s->inside ? -1.0 : 1.0;
	const view v = {s, made.bsdf,
			lobe_vec3_make((float)sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0f, (float)(side * cosine)),
			side};
	furnaces_energy e = {{0.0, 0.0, 0.0}, 0.0};
	if (s->way == FURNACES_FACETS)
		over_facets(&v, &made, effort, &e);
	else if (s->way == FURNACES_HEMISPHERE)
		over_directions(&v, effort, &e);
	else
		over_events(&v, &e);
	return e;
}

/* --- weak furnace ------------------------------------------------------------------------------------------------- */

typedef struct {
	lobe_microsurface surface;
	lobe_seen o;
	lobe_vec3 wo;
} weak_view;

/* G1/z of a facet: G2 with a light along the mean normal, which shadows nothing, where masking has no other form. */
static double g1_over_cos(const weak_view *v, lobe_vec3 h)
{
	const lobe_vec3 up = lobe_vec3_make(0.0f, 0.0f, 1.0f);
	lobe_seen_facet m;
	if (v->surface.masking == LOBE_MASKING_SMITH || v->surface.masking == LOBE_MASKING_SMITH_RATIONAL)
		return 1.0 / ((double)v->o.z + (double)v->o.hides);
	if (v->surface.masking == LOBE_MASKING_VCAVITY)
		return (double)lobe_vcavity_g1_over_cos(v->o.z, lobe_dot(v->wo, h), h.z);
	m.o = lobe_dot(v->wo, h);
	m.i = h.z;
	m.z = h.z;
	m.length2 = lobe_dot(h, h);
	return (double)lobe_masking_g2_over_cos(v->surface, v->o, lobe_see(v->surface, up, 1.0f), m, 0);
}

static void add_weak(const furnaces_integrand *f, const furnaces_facet *m, double weight, double sum[3])
{
	const weak_view *v = f->context;
	const double length = sqrt(m->length2);
	const lobe_vec3 h = lobe_vec3_make((float)(m->s[0] / length), (float)(m->s[1] / length), (float)(1.0 / length));
	const lobe_facet_density d =
		lobe_distribution_density(v->surface.distribution, lobe_linear_facet(v->surface.map, h));
	/* Facets that the rounding of h turns away. */
	if (!(lobe_dot(v->wo, h) > 0.0f))
		return;
	const double density = (double)v->surface.map.norm * (double)d.inv * (double)d.inv * (double)d.factor;
	sum[0] += weight * (m->facing / length) * density * g1_over_cos(v, h);
}

furnaces_energy furnaces_weak_at(unsigned shape, unsigned masking, double alpha, double cosine, double wrong)
{
	weak_view v;
	const lobe_microsurface seen = lobe_microsurface_masking(
		furnaces_microsurface(shape, alpha * (1.0 + wrong), alpha * (1.0 + wrong)), masking);
	furnaces_integrand f = {
		.ax = alpha, .ay = alpha, .e = 1.0, .tail = furnaces_shape_tail(shape), .add = add_weak, .context = &v};
	furnaces_energy e = {{0.0, 0.0, 0.0}, 0.0};
	v.surface = lobe_microsurface_masking(furnaces_microsurface(shape, alpha, alpha), masking);
	v.wo = lobe_vec3_make((float)sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0f, (float)cosine);
	v.o = lobe_see(seen, v.wo, 1.0f);
	f.o[0] = (double)v.wo.x;
	f.o[1] = 0.0;
	f.o[2] = (double)v.wo.z;
	textbook_normalize(f.o);
	f.bounds = 1u << FURNACES_VISIBLE;
	f.kinks = masking == LOBE_MASKING_VCAVITY ? 1u << FURNACES_CAVITY_O : 0u;
	e.error = furnaces_integral(&f, 1.0, 3e-7, 64, e.rgb);
	return e;
}

/* What an unmasked GGX surface shows is sigma = (mu + t)/2 (Heitz 2014, eq. 86 times mu): the weak furnace is
 * sigma G1/mu. */
double furnaces_weak_known(unsigned masking, double alpha, double cosine)
{
	const double mu = (double)(float)cosine, s2 = (1.0 - mu) * (1.0 + mu);
	const double sigma = 0.5 * (mu + sqrt(alpha * alpha * s2 + mu * mu));
	const double r = 0.5 + 0.5 * sqrt(alpha), disney = r * r;
	double k;
	switch (masking) {
	case LOBE_MASKING_SMITH:
	case LOBE_MASKING_VCAVITY:
		return 1.0;
	case LOBE_MASKING_NONE:
		return sigma / mu;
	case LOBE_MASKING_IMPLICIT:
		return sigma;
	case LOBE_MASKING_DISNEY:
		return 2.0 * sigma / (mu + sqrt(disney * disney * s2 + mu * mu));
	case LOBE_MASKING_SCHLICK_SMITH:
		k = alpha * sqrt(2.0 / PI);
		break;
	case LOBE_MASKING_SCHLICK_GGX:
		k = 0.5 * alpha;
		break;
	case LOBE_MASKING_SCHLICK_GGX_LIGHTS:
		k = 0.5 * r * r;
		break;
	default:
		return (double)NAN;
	}
	return sigma / (mu * (1.0 - k) + k);
}
