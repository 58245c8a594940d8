#include "lobe_histogram.h"

#include "double.h"
#include "lobe/lobe.h"
#include "support.h"
#include "textbook.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double pdf_at(const scene *s, const double wi[3], double x)
{
	if (s->in_double) {
		const double wo[3] = {(double)s->wo.x, (double)s->wo.y, (double)s->wo.z};
		return double_pdf(s->c->kind, s->c->parameter, wo, wi);
	}
	const lobe_vec3 w = lobe_vec3_make((float)wi[0], (float)wi[1], (float)wi[2]);
	const double pdf = (double)lobe_bsdf_pdf(s->wrong == WRONG_ALPHA ? s->wrong_bsdf : s->c->bsdf, s->wo, w);
	/* 2 % of the mass of the outer half taken away and given to the inner one keeps the integral nearly as it was.
	 */
	return s->wrong == WRONG_SCALE ? pdf * (x < 0.5 ? 0.98 : 1.02) : pdf;
}

static double reflect_pdf(void *context, double x, double y)
{
	const scene *s = context;
	double wi[3];
	const double area = map_direction(&s->reflect, x, y, wi);
	return area > 0.0 ? area * pdf_at(s, wi, x) : 0.0;
}

static double reflect_edge(void *context, double x, double y)
{
	return map_edge(&((const scene *)context)->reflect, x, y);
}

static double reflect_kink(void *context, double x, double y)
{
	return map_kink(&((const scene *)context)->reflect, x, y);
}

static double transmit_edge(void *context, double x, double y)
{
	return map_edge(&((const scene *)context)->transmit, x, y);
}

static double transmit_pdf(void *context, double x, double y)
{
	const scene *s = context;
	double wi[3];
	const double area = map_direction(&s->transmit, x, y, wi);
	return area > 0.0 ? area * pdf_at(s, wi, x) : 0.0;
}

/* Probability of a visible facet times that of refraction through it. */
static double delta_share(void *context, double x, double y)
{
	const scene *s = context;
	const direction_map *m = &s->transmit;
	double facet[3];
	if (map_edge(m, x, y) <= 0.0)
		return 0.0;
	const double area = map_facet(m, x, y, facet);
	const double c = textbook_dot(m->o, facet);
	const double g1_over_z = 1.0 / (m->o[2] * (1.0 + textbook_lambda(s->c->ndf, m->ax, m->ay, m->o)));
	return area * textbook_d(s->c->ndf, m->ax, m->ay, facet) * c * g1_over_z * (1.0 - textbook_fresnel(c, m->e));
}

scene scene_make(const test_case *c, lobe_vec3 wo, int in_double, int wrong)
{
	const double w[3] = {(double)wo.x, (double)wo.y, (double)wo.z};
	const map_kind kind = c->alpha_x > 0.0 ? MAP_REFLECT : MAP_SPHERE;
	scene s;
	s.c = c;
	s.wo = wo;
	s.in_double = in_double;
	s.wrong = wrong;
	s.wrong_bsdf = c->bsdf;
	s.reflect = map_make(kind, w, c->alpha_x, c->alpha_y, c->eta);
	s.transmit = map_make(MAP_TRANSMIT, w, c->alpha_x, c->alpha_y, c->eta);
	return s;
}

static double integrate(const scene *s, quadrature_integrand f, quadrature_integrand edge, double *bins, double *error)
{
	scene copy = *s;
	const int kinked = f == reflect_pdf && (s->c->flags & CASE_TRANSMITS) && s->reflect.e < 1.0;
	quadrature q = {
		f,  s->reflect.kind == MAP_SPHERE ? NULL : edge, kinked ? reflect_kink : NULL, &copy, 1e-7, 1e-3, 5,
		0.0};
	double sum = 0.0;
	for (int i = 0; i < SIDE; i++)
		for (int k = 0; k < SIDE; k++)
			sum += bins[i * SIDE + k] = quadrature_box(&q, (double)i / SIDE, (i + 1.0) / SIDE,
								   (double)k / SIDE, (k + 1.0) / SIDE);
	*error += q.error;
	return sum;
}

void expect(const scene *s, histogram *h)
{
	double unused[GRID];
	memset(h, 0, sizeof *h);
	double sum = integrate(s, reflect_pdf, reflect_edge, h->expected, &h->quadrature_error);
	if (s->c->flags & CASE_DELTA)
		sum += h->expected[DELTA] = integrate(s, delta_share, transmit_edge, unused, &h->quadrature_error);
	else if (s->c->flags & CASE_TRANSMITS)
		sum += integrate(s, transmit_pdf, transmit_edge, h->expected + GRID, &h->quadrature_error);
	h->expected[REJECT] = 1.0 - sum;
}

static int bin_of(const scene *s, const double wi[3], lobe_uint event)
{
	double x, y;
	if (event == 0u)
		return REJECT;
	if (event & LOBE_EVENT_DELTA)
		return DELTA;
	map_coordinates(event & LOBE_EVENT_TRANSMIT ? &s->transmit : &s->reflect, wi, &x, &y);
	const int i = (int)(x * SIDE), k = (int)(y * SIDE);
	return (event & LOBE_EVENT_TRANSMIT ? GRID : 0) + (i < SIDE ? i : SIDE - 1) * SIDE + (k < SIDE ? k : SIDE - 1);
}

/* SAMPLES samples of the single precision build, by the row loops: the bits are those of the scalar function
 * (test_equivalence.c), which would take minutes for a film. */
enum { BATCH_IN = 6, BATCH_OUT = 3 };
static float *batch_in[BATCH_IN], *batch_out[BATCH_OUT];
static uint32_t *batch_event;
static lobe_device *device;

void batch_open(void)
{
	int ok = lobe_device_open(&device, "native") == LOBE_OK;
	for (int k = 0; k < BATCH_IN; k++)
		ok = ok && (batch_in[k] = malloc(SAMPLES * sizeof(float))) != NULL;
	for (int k = 0; k < BATCH_OUT; k++)
		ok = ok && (batch_out[k] = malloc(SAMPLES * sizeof(float))) != NULL;
	batch_event = malloc(SAMPLES * sizeof *batch_event);
	if (!ok || !batch_event)
		exit(2);
}

void batch_close(void)
{
	for (int k = 0; k < BATCH_IN; k++)
		free(batch_in[k]);
	for (int k = 0; k < BATCH_OUT; k++)
		free(batch_out[k]);
	free(batch_event);
	lobe_device_close(device);
}

static void batch_sample(const lobe_bsdf *bsdf, lobe_vec3 wo, uint32_t stream)
{
	lobe_scene *of_one;
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = SAMPLES;
	b.event = batch_event;
	for (uint32_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(stream, i, u);
		for (int k = 0; k < 3; k++)
			batch_in[3 + k][i] = u[k];
		batch_in[0][i] = wo.x;
		batch_in[1][i] = wo.y;
		batch_in[2][i] = wo.z;
	}
	for (int k = 0; k < 3; k++) {
		b.wo[k] = batch_in[k];
		b.u[k] = batch_in[3 + k];
		b.sample_wi[k] = batch_out[k];
	}
	if (lobe_scene_create(&of_one, device, bsdf, 1) != LOBE_OK || lobe_scene_sample(of_one, &b) != LOBE_OK) {
		printf("  %s\n", lobe_error_message());
		exit(2);
	}
	lobe_scene_destroy(of_one);
}

void observe(const scene *s, uint32_t stream, histogram *h)
{
	const double wo[3] = {(double)s->wo.x, (double)s->wo.y, (double)s->wo.z};
	memset(h->observed, 0, sizeof h->observed);
	if (!s->in_double)
		batch_sample(&s->c->bsdf, s->wo, stream);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		if (s->in_double) {
			float u[3];
			test_u3(stream, i, u);
			const double v[3] = {(double)u[0], (double)u[1], (double)u[2]};
			const double_sample r = double_sample_at(s->c->kind, s->c->parameter, wo, v);
			h->observed[bin_of(s, r.wi, r.event)]++;
		} else {
			const double wi[3] = {(double)batch_out[0][i], (double)batch_out[1][i],
					      (double)batch_out[2][i]};
			h->observed[bin_of(s, wi, batch_event[i])]++;
		}
	}
}

chi_square fit_of(const histogram *h)
{
	return chi_square_with_rest(h->expected, h->observed, BINS, REJECT, h->quadrature_error * SAMPLES);
}
