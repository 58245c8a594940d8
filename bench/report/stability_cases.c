/* stability_cases.c - corners of every lobe's domain, drawn from counters, and what such a case consists of. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases_make.h"
#include "stability.h"
#include "stability_dice.h"

/* Numbers of one case: at most DRAWS of them. */
enum { STREAM = 7300, DRAWS = 96 };

static dice dice_of(lobe_uint kind, uint64_t n, unsigned part)
{
	const dice d = {STREAM + kind, (2 * n + part) * (DRAWS / 2)};
	return d;
}

static int one_in(dice *d, unsigned n) { return dice_bits(d) % n == 0; }
static double sign(dice *d) { return dice_bits(d) & 1u ? 1.0 : -1.0; }

/* --- parameters --------------------------------------------------------------------------------------------------- */

static void draw_alphas(dice *d, double *p)
{
	const uint32_t how = dice_bits(d) % 8;
	const double ax = one_in(d, 4) ? 1e-4 : one_in(d, 8) ? 1.0 : dice_decades(d, -4, 0);
	const double other = dice_decades(d, -4, 0);
	p[0] = how == 0 ? 1e-4 : how == 1 ? 1.0 : ax;
	p[1] = how == 0 ? 1.0 : how == 1 ? 1e-4 : how < 4 ? other : ax;
}

/* 1/1000 .. 1000; half of them near 1. */
static double draw_eta(dice *d)
{
	static const double ends[] = {1.0,    1 + 0x1p-23, 1 - 0x1p-24, 1 + 1e-7, 1 - 1e-7,
				      1000.0, 1e-3,        1.5,         1 / 1.5,  1.33};
	const uint32_t how = dice_bits(d) % 8;
	const double near = 1.0 + sign(d) * dice_decades(d, -7, -0.3), any = dice_decades(d, -3, 3);
	return how < 4 ? near : how < 6 ? any : ends[dice_bits(d) % (sizeof ends / sizeof *ends)];
}

static void draw_index(dice *d, double *n, double *k)
{
	const uint32_t how = dice_bits(d) % 8;
	const double near = 1.0 + sign(d) * dice_decades(d, -7, -0.3);
	*n = how < 2 ? near : how == 2 ? 1.0 : dice_decades(d, -3, 3);
	*k = one_in(d, 6) ? 0.0 : one_in(d, 8) ? 100.0 : dice_decades(d, -7, 2);
}

static double draw_reflectance(dice *d)
{
	const uint32_t how = dice_bits(d) % 6;
	const double low = dice_decades(d, -7, 0), any = dice_uniform(d);
	return how == 0 ? 0.0 : how == 1 ? 1.0 : how == 2 ? low : any;
}

static void draw_film(dice *d, double *p, double least)
{
	const uint32_t how = dice_bits(d) % 8;
	p[0] = how == 0 ? 0.0 : how == 1 ? 1e-30 : how == 2 ? 1e6 : dice_decades(d, 0, 4);
	const double near = 1.0 + dice_decades(d, -7, 0), any = dice_decades(d, 0, 3);
	p[1] = least * (one_in(d, 6) ? 1.0 : dice_bits(d) & 1u ? near : any);
}

/* Slopes of width a_x, a_y and correlation rho about a mean, as their Cholesky factor (Dupuy et al. 2013). */
static void draw_surface(dice *d, double *p)
{
	static const double shapes[][3] = {
		{LOBE_NDF_GGX, 0, 1}, {LOBE_NDF_BECKMANN, 0, 1}, {LOBE_NDF_GGX, 0, 1},       {LOBE_NDF_BECKMANN, 0, 1},
		{LOBE_NDF_GGX, 0, 1}, {LOBE_NDF_PHONG, 30, 1},   {LOBE_NDF_STUDENT_T, 3, 1}, {LOBE_NDF_GTR, 1.5, 0.3},
	};
	const uint32_t shape = dice_bits(d) % 8, how = dice_bits(d) % 8;
	const double far = 1.0 - dice_decades(d, -4, 0), s = sign(d);
	const double rho = how < 2 ? 0.0 : how < 4 ? s * 0.9999 : s * far;
	const double mean = dice_decades(d, -3, 2), phi = dice_angle(d);
	const double tilted = dice_bits(d) % 3 ? mean : 0.0;
	draw_alphas(d, p);
	p[12] = rho * p[1];
	p[1] *= sqrt((1.0 - rho) * (1.0 + rho));
	p[13] = tilted * cos(phi);
	p[14] = tilted * sin(phi);
	for (int k = 0; k < 3; k++)
		p[8 + k] = shapes[shape][k];
	/* A third of the surfaces are masked and sampled in ways that only the double build has an answer for. */
	const uint32_t other = dice_bits(d) % 3, masking = dice_bits(d), joint = dice_bits(d), strategy = dice_bits(d);
	p[15] = other ? LOBE_MASKING_SMITH : masking % (LOBE_MASKING_LAST + 1);
	p[16] = other ? joint % 2 : joint % (LOBE_JOINT_LAST + 1);
	p[17] = other ? LOBE_ACROSS_SEPARABLE : joint / 16 % 2;
	p[18] = other ? LOBE_STRATEGY_VISIBLE : strategy % (LOBE_STRATEGY_LAST + 1);
	p[19] = LOBE_FRESNEL_EXACT;
}

void stability_draw_parameters(lobe_uint kind, uint64_t n, double p[CASE_PARAMETERS])
{
	dice d = dice_of(kind, n, 0);
	memset(p, 0, CASE_PARAMETERS * sizeof *p);
	switch (kind) {
	case LOBE_KIND_LAMBERT:
	case LOBE_KIND_MIRROR:
		for (int k = 0; k < 3; k++)
			p[k] = draw_reflectance(&d);
		break;
	case LOBE_KIND_GGX_CONDUCTOR:
	case LOBE_KIND_BECKMANN_CONDUCTOR:
		draw_alphas(&d, p);
		for (int k = 0; k < 3; k++)
			draw_index(&d, p + 2 + k, p + 5 + k);
		break;
	case LOBE_KIND_GGX_SCHLICK:
		draw_alphas(&d, p);
		for (int k = 2; k < 8; k++)
			p[k] = draw_reflectance(&d);
		break;
	case LOBE_KIND_GGX_DIELECTRIC:
	case LOBE_KIND_BECKMANN_DIELECTRIC:
		draw_alphas(&d, p);
		p[2] = draw_eta(&d);
		p[3] = dice_bits(&d) & 1u;
		break;
	case LOBE_KIND_SMOOTH_CONDUCTOR:
		for (int k = 0; k < 3; k++)
			draw_index(&d, p + k, p + 3 + k);
		break;
	case LOBE_KIND_SMOOTH_DIELECTRIC:
	case LOBE_KIND_THIN_DIELECTRIC:
		p[0] = draw_eta(&d);
		p[1] = kind == LOBE_KIND_SMOOTH_DIELECTRIC ? dice_bits(&d) & 1u : 0;
		break;
	case LOBE_KIND_IRIDESCENT_CONDUCTOR:
		draw_alphas(&d, p);
		draw_film(&d, p + 2, 1.0);
		for (int k = 0; k < 3; k++)
			draw_index(&d, p + 4 + k, p + 7 + k);
		break;
	case LOBE_KIND_IRIDESCENT_DIELECTRIC:
		draw_alphas(&d, p);
		p[4] = draw_eta(&d);
		draw_film(&d, p + 2, fmin(p[4], 1.0));
		p[5] = dice_bits(&d) & 1u;
		break;
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		draw_surface(&d, p);
		for (int k = 0; k < 3; k++)
			draw_index(&d, p + 2 + k, p + 5 + k);
		break;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		draw_surface(&d, p);
		p[2] = draw_eta(&d);
		p[3] = dice_bits(&d) & 1u;
		break;
	case LOBE_KIND_MICROFACET_DIFFUSE:
		draw_surface(&d, p);
		p[18] = p[19] = 0;
		for (int k = 2; k < 5; k++)
			p[k] = draw_reflectance(&d);
		break;
	default:
		break;
	}
	for (int k = 0; k < CASE_PARAMETERS; k++)
		p[k] = (double)(float)p[k];
	/* A film thinner than both sides, by a rounding, is out of the domain. */
	if (kind == LOBE_KIND_IRIDESCENT_DIELECTRIC)
		p[3] = fmax(p[3], fmin(p[4], 1.0));
}

/* --- directions --------------------------------------------------------------------------------------------------- */

static void round_to(const double w[3], double stretch, float out[3])
{
	const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
	for (int k = 0; k < 3; k++)
		out[k] = (float)(w[k] / length * stretch);
}

/* Off unit length by up to four ulp, one time in four. */
static double draw_stretch(dice *d)
{
	const double ulps = (double)(int)(dice_bits(d) % 9) - 4.0;
	return one_in(d, 4) ? 1.0 + ulps * 0x1p-23 : 1.0;
}

static void draw_direction(dice *d, float w[3])
{
	const uint32_t how = dice_bits(d) % 8, axis = dice_bits(d) % 16;
	const double grazing = dice_decades(d, -7, 0), pole = 1.0 - dice_decades(d, -14, -1), any = dice_uniform(d);
	const double z = sign(d) * (how < 4 ? grazing : how == 4 ? pole : how == 5 ? 1.0 : any);
	const double r = sqrt((1.0 - z) * (1.0 + z)), phi = dice_angle(d);
	/* Exactly along an axis now and then. */
	const double c = axis < 4 ? (double[]){1, 0, -1, 0}[axis] : cos(phi);
	const double s = axis < 4 ? (double[]){0, 1, 0, -1}[axis] : sin(phi);
	const double v[3] = {r * c, r * s, z};
	round_to(v, draw_stretch(d), w);
}

static float draw_u(dice *d)
{
	static const float ends[] = {0.0f, 0x1p-149f, 0x1p-24f, 0.5f, 0x1.fffffep-2f, 0x1.fffffep-1f};
	const uint32_t how = dice_bits(d) % 8;
	const float small = (float)dice_decades(d, -44, -7), any = (float)(dice_bits(d) >> 8) * 0x1p-24f;
	return how == 0 ? ends[dice_bits(d) % 6] : how == 1 ? small : any;
}

/* Near the mirror image of wo or its straight continuation: off by 10^-8 .. 1. */
static void draw_near(dice *d, const float wo[3], int across, float wi[3])
{
	const double spread = dice_decades(d, -8, 0);
	double w[3];
	for (int k = 0; k < 3; k++)
		w[k] = (k == 2 && !across ? 1.0 : -1.0) * (double)wo[k] + spread * (2.0 * dice_uniform(d) - 1.0);
	round_to(w, draw_stretch(d), wi);
}

lobe_bsdf stability_bsdf(const stability_case *c) { return make_bsdf(c->kind, c->parameter); }

void stability_draw_anywhere(stability_case *c, uint64_t n)
{
	dice d = dice_of(c->kind, n, 1);
	const uint32_t how = dice_bits(&d) % 4;
	draw_direction(&d, c->wo);
	for (int k = 0; k < 3; k++)
		c->u[k] = draw_u(&d);
	c->channel = (int)(dice_bits(&d) % 3);
	if (how < 2)
		draw_direction(&d, c->wi);
	else
		draw_near(&d, c->wo, how & 1, c->wi);
}

/* Three of four where the lobe is. */
static void draw_directions(stability_case *c, uint64_t n)
{
	stability_draw_anywhere(c, n);
	if (n % 4 == 0)
		return;
	const lobe_sample s = lobe_bsdf_sample(stability_bsdf(c), lobe_vec3_make(c->wo[0], c->wo[1], c->wo[2]),
					       lobe_vec3_make(c->u[0], c->u[1], c->u[2]));
	if (s.event != 0u && !(s.event & LOBE_EVENT_DELTA)) {
		c->wi[0] = s.wi.x;
		c->wi[1] = s.wi.y;
		c->wi[2] = s.wi.z;
	}
}

stability_case stability_draw(lobe_uint kind, uint64_t n)
{
	stability_case c;
	memset(&c, 0, sizeof c);
	c.kind = kind;
	stability_draw_parameters(kind, n, c.parameter);
	draw_directions(&c, n);
	return c;
}

/* --- a case's inputs, as places and as text -------------------------------------------------------------------------- */

size_t stability_parameters_of(const stability_case *c, int at[CASE_PARAMETERS])
{
	const int ch = c->channel;
	const int rough[] = {0, 1, 2 + ch, 5 + ch}, glass[] = {0, 1, 2}, colour[] = {ch}, metal[] = {ch, 3 + ch},
		  index[] = {0};
	const int film_metal[] = {0, 1, 2, 3, 4 + ch, 7 + ch}, film_glass[] = {0, 1, 2, 3, 4};
	const int any_metal[] = {0, 1, 11, 12, 13, 14, 2 + ch, 5 + ch}, any_glass[] = {0, 1, 11, 12, 13, 14, 2};
	const int diffuse[] = {0, 1, 11, 12, 13, 14, 2 + ch};
	const int *list = index;
	size_t length = 1;
#define LIST(name) list = name, length = sizeof name / sizeof *name
	switch (c->kind) {
	case LOBE_KIND_LAMBERT:
	case LOBE_KIND_MIRROR:
		LIST(colour);
		break;
	case LOBE_KIND_GGX_CONDUCTOR:
	case LOBE_KIND_BECKMANN_CONDUCTOR:
	case LOBE_KIND_GGX_SCHLICK:
		LIST(rough);
		break;
	case LOBE_KIND_GGX_DIELECTRIC:
	case LOBE_KIND_BECKMANN_DIELECTRIC:
		LIST(glass);
		break;
	case LOBE_KIND_SMOOTH_CONDUCTOR:
		LIST(metal);
		break;
	case LOBE_KIND_IRIDESCENT_CONDUCTOR:
		LIST(film_metal);
		break;
	case LOBE_KIND_IRIDESCENT_DIELECTRIC:
		LIST(film_glass);
		break;
	case LOBE_KIND_MICROFACET_CONDUCTOR:
		LIST(any_metal);
		break;
	case LOBE_KIND_MICROFACET_DIELECTRIC:
		LIST(any_glass);
		break;
	case LOBE_KIND_MICROFACET_DIFFUSE:
		LIST(diffuse);
		break;
	default:
		break;
	}
#undef LIST
	for (size_t k = 0; k < length; k++)
		at[k] = list[k];
	return length;
}

void stability_print(const stability_case *c, stability_verb verb, char *text, size_t size)
{
	const int samples = verb >= STABILITY_WEIGHT || stability_is_delta_only(c->kind);
	const float *second = samples ? c->u : c->wi;
	size_t used = (size_t)snprintf(text, size, "wo %a %a %a %s %a %a %a", (double)c->wo[0], (double)c->wo[1],
				       (double)c->wo[2], samples ? "u" : "wi", (double)second[0], (double)second[1],
				       (double)second[2]);
	for (int k = 0; k < CASE_PARAMETERS && used < size; k++)
		if (c->parameter[k] != 0.0)
			used += (size_t)snprintf(text + used, size - used, " p%d %a", k, c->parameter[k]);
	if (used < size)
		snprintf(text + used, size - used, " channel %d", c->channel);
}
