/* stability_forms.c - formulas as books and engines print them, in single precision, beside the library's; and two
 * lobes with a defect made of them. */
#include <math.h>
#include <string.h>

#include "stability_dice.h"
#include "stability_reference.h"

enum { FORM_KARIS, FORM_SINE, FORM_LAMBDA, FORM_REFRACTION, FORM_CONDUCTOR, FORM_DIELECTRIC };

const stability_form stability_forms[STABILITY_FORMS] = {
	{"D of GGX", "from the unnormalised half vector", "Karis 2013: a2/(pi ((n.h a2 - n.h) n.h + 1)^2)", "alpha"},
	{"D of GGX from 1 - cos^2", "from the unnormalised half vector", "tan^2 = (1 - cos^2)/cos^2", "alpha"},
	{"Lambda of GGX", "hidden(v)/z, a quotient", "(sqrt(1 + alpha^2 tan^2) - 1)/2, tan^2 from 1 - cos^2", "cos"},
	{"refraction by GGX", "every power of |H| cancelled", "Walter 2007, eqs. 16 to 22", "|eta - 1|"},
	{"Fresnel of a metal", "its larger root first", "a = sqrt(max(0, (|N^2 - sin^2| + t)/2))", "k"},
	{"Fresnel of glass", "(eta - 1)(eta + 1)/A^2", "Walter 2007, eq. 22", "|eta - 1|"},
};

/* --- as printed ---------------------------------------------------------------------------------------------------- */

static const float pi = 3.14159265f;

static lobe_vec3 half_vector(lobe_vec3 o, lobe_vec3 i)
{
	const lobe_vec3 h = lobe_vec3_add(o, i);
	return lobe_vec3_scale(h, 1.0f / sqrtf(lobe_dot(h, h)));
}

static float karis_d(float n_h, float alpha)
{
	const float a2 = alpha * alpha, d = (n_h * a2 - n_h) * n_h + 1.0f;
	return a2 / (pi * d * d);
}

/* D of the library's GGX at the half vector of that sum. */
static float library_d(lobe_stretch stretch, lobe_vec3 sum)
{
	return 2.0f * lobe_reflection_density(LOBE_NDF_GGX, stretch, lobe_vec3_squares(sum), 1.0f, 1.0f, 1.0f);
}

/* Heitz 2014, eq. 85; widths as one sees them along h. */
static float sine_d(lobe_vec3 h, float ax, float ay)
{
	const float cos2 = h.z * h.z, tan2 = (1.0f - cos2) / cos2;
	const float along = h.x * h.x + h.y * h.y;
	const float wide = along > 0.0f ? (h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay)) / along : 1.0f / (ax * ay);
	const float t = 1.0f + tan2 * wide;
	return 1.0f / (pi * ax * ay * cos2 * cos2 * t * t);
}

static float tangent_lambda(lobe_vec3 w, float ax, float ay)
{
	const float along = w.x * w.x + w.y * w.y;
	const float a2 = along > 0.0f ? (w.x * w.x * ax * ax + w.y * w.y * ay * ay) / along : ax * ay;
	const float tangent = sqrtf(1.0f - w.z * w.z) / w.z;
	return (sqrtf(1.0f + a2 * tangent * tangent) - 1.0f) * 0.5f;
}

static float printed_fresnel(float c, float eta)
{
	const float g2 = eta * eta - 1.0f + c * c;
	if (g2 <= 0.0f)
		return 1.0f;
	const float g = sqrtf(g2), s = (g - c) / (g + c), p = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
	return 0.5f * s * s * (1.0f + p * p);
}

static float printed_conductor(float c, float n, float k)
{
	const float s2 = 1.0f - c * c, t0 = n * n - k * k - s2, ab = sqrtf(t0 * t0 + 4.0f * n * n * k * k);
	const float a = sqrtf(fmaxf(0.0f, 0.5f * (ab + t0))), t1 = ab + c * c, t2 = 2.0f * a * c;
	const float rs = (t1 - t2) / (t1 + t2), t3 = c * c * ab + s2 * s2, t4 = t2 * s2;
	return 0.5f * (rs + rs * (t3 - t4) / (t3 + t4));
}

static float printed_refraction(lobe_vec3 o, lobe_vec3 i, float alpha, float eta)
{
	lobe_vec3 h = lobe_vec3_make(-(o.x + eta * i.x), -(o.y + eta * i.y), -(o.z + eta * i.z));
	h = lobe_vec3_scale(h, (h.z < 0.0f ? -1.0f : 1.0f) / sqrtf(lobe_dot(h, h)));
	const float oh = lobe_dot(o, h), ih = lobe_dot(i, h), den = eta * ih + oh;
	if (!(oh > 0.0f && ih < 0.0f))
		return 0.0f;
	const float g = 1.0f / ((1.0f + tangent_lambda(o, alpha, alpha)) *
				(1.0f + tangent_lambda(lobe_vec3_make(i.x, i.y, -i.z), alpha, alpha)));
	return -ih * oh / o.z * (1.0f - printed_fresnel(oh, eta)) * g * sine_d(h, alpha, alpha) / (den * den);
}

/* --- beside the library's ------------------------------------------------------------------------------------------- */

static lobe_vec3 direction(dice *d)
{
	const double z = dice_uniform(d) < 0.5 ? dice_decades(d, -7, 0) : dice_uniform(d), phi = dice_angle(d);
	const double r = sqrt((1.0 - z) * (1.0 + z));
	return lobe_vec3_make((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z);
}

static void put(long double *x, lobe_vec3 w)
{
	x[0] = (long double)w.x;
	x[1] = (long double)w.y;
	x[2] = (long double)w.z;
}

static double floor_of(stability_part part, long double *x, size_t inputs, long double exact)
{
	long double sum = 0.0L;
	for (size_t k = 0; k < inputs; k++) {
		const long double old = x[k], step = stability_half_ulp(old);
		long double most = 0.0L;
		for (int side = -1; side <= 1; side += 2) {
			x[k] = old + (long double)side * step;
			most = fmaxl(most, fabsl(stability_exact_part(part, x) - exact));
		}
		x[k] = old;
		sum += most * most;
	}
	return (double)fmaxl(sqrtl(sum), stability_half_ulp(exact));
}

stability_form_result stability_form_at(int form, uint64_t n)
{
	dice d = {7400u + (uint32_t)form, n * 32u};
	const lobe_vec3 up = direction(&d);
	const float alpha = (float)dice_decades(&d, -4, 0);
	const double how = dice_uniform(&d);
	stability_form_result r;
	long double x[8] = {0};
	stability_part part = STABILITY_PART_D;
	size_t inputs = 7;
	memset(&r, 0, sizeof r);
	const lobe_vec3 u = lobe_vec3_make((float)dice_uniform(&d), (float)dice_uniform(&d), how < 0.5 ? 0.0f : 0.999f);
	switch (form) {
	case FORM_KARIS:
	case FORM_SINE: {
		const lobe_ggx_schlick p =
			lobe_ggx_schlick_make(alpha, alpha, lobe_rgb_make(1, 1, 1), lobe_rgb_make(1, 1, 1));
		const lobe_sample s = lobe_ggx_schlick_sample(p, up, u);
		const lobe_vec3 i = s.event ? s.wi : up, sum = lobe_vec3_add(up, i), h = half_vector(up, i);
		r.x = (double)alpha;
		r.ours = (double)library_d(p.stretch, sum);
		r.textbook = (double)(form == FORM_KARIS ? karis_d(h.z, alpha) : sine_d(h, alpha, alpha));
		put(x, up);
		put(x + 3, i);
		x[6] = (long double)alpha;
		break;
	}
	case FORM_LAMBDA: {
		const lobe_vec3 v = lobe_vec3_make(alpha * up.x, alpha * up.y, up.z);
		part = STABILITY_PART_LAMBDA;
		inputs = 4;
		r.x = (double)up.z;
		r.ours = (double)(lobe_ggx_hidden(v) / up.z);
		r.textbook = (double)tangent_lambda(up, alpha, alpha);
		put(x, up);
		x[3] = (long double)alpha;
		break;
	}
	case FORM_REFRACTION: {
		const double near = (dice_uniform(&d) < 0.5 ? -1.0 : 1.0) * dice_decades(&d, -6, -0.3);
		const float wide = (float)dice_decades(&d, -1, 0), eta = (float)(1.0 + near);
		const lobe_ggx_dielectric p = lobe_ggx_dielectric_make(wide, wide, eta);
		const lobe_sample s = lobe_ggx_dielectric_sample(p, up, lobe_vec3_make(u.x, u.y, 0.999999f));
		part = STABILITY_PART_REFRACTION;
		inputs = 8;
		r.x = fabs(near);
		put(x, up);
		put(x + 3, s.wi);
		x[6] = (long double)wide;
		x[7] = (long double)eta;
		if (s.event != (LOBE_EVENT_TRANSMIT | LOBE_EVENT_GLOSSY))
			return r;
		r.ours = (double)lobe_ggx_dielectric_eval(p, up, s.wi).g;
		r.textbook = (double)printed_refraction(up, s.wi, wide, eta);
		break;
	}
	case FORM_CONDUCTOR: {
		/* Metals: an index that is not air's. */
		const float c = up.z, a = (float)dice_decades(&d, -2, 1), k = (float)dice_decades(&d, -2, 2);
		part = STABILITY_PART_CONDUCTOR;
		inputs = 3;
		r.x = (double)k;
		r.ours = (double)lobe_fresnel_conductor(c, a, k);
		r.textbook = (double)printed_conductor(c, a, k);
		x[0] = (long double)c;
		x[1] = (long double)a;
		x[2] = (long double)k;
		break;
	}
	default: {
		const double near = dice_decades(&d, -7, 2);
		const float c = up.z, eta = (float)(1.0 + near);
		part = STABILITY_PART_DIELECTRIC;
		inputs = 2;
		r.x = near;
		r.ours = (double)lobe_fresnel_dielectric(c, eta).reflectance;
		r.textbook = (double)printed_fresnel(c, eta);
		x[0] = (long double)c;
		x[1] = (long double)eta;
		break;
	}
	}
	const long double exact = stability_exact_part(part, x);
	r.exact = (double)exact;
	r.floor = floor_of(part, x, inputs, exact);
	return r;
}

/* --- lobes with a defect --------------------------------------------------------------------------------------------- */

static double defective(const stability_case *c, stability_verb verb, int by_sine, int by_tangent)
{
	const lobe_vec3 o = lobe_vec3_make(c->wo[0], c->wo[1], c->wo[2]),
			i = lobe_vec3_make(c->wi[0], c->wi[1], c->wi[2]);
	const lobe_ggx_conductor p = stability_bsdf(c).as.ggx_conductor;
	const float ax = p.stretch.alpha_x, ay = p.stretch.alpha_y;
	const lobe_vec3 sum = lobe_vec3_add(o, i);
	if (!(o.z > 0.0f && i.z > 0.0f) || verb == STABILITY_WEIGHT)
		return 0.0;
	const float quarter_d = by_sine ? 0.25f * sine_d(half_vector(o, i), ax, ay) : 0.25f * library_d(p.stretch, sum);
	const float t_o = lobe_reflection_t(LOBE_NDF_GGX, p.stretch, o),
		    t_i = lobe_reflection_t(LOBE_NDF_GGX, p.stretch, i);
	const float lambda_o = by_tangent ? tangent_lambda(o, ax, ay) : 0.5f * (t_o / o.z - 1.0f);
	const float lambda_i = by_tangent ? tangent_lambda(i, ax, ay) : 0.5f * (t_i / i.z - 1.0f);
	const lobe_facet_bound b = lobe_ggx_bound(lobe_stretch_narrow2(p.stretch), o);
	if (verb == STABILITY_PDF)
		return (double)(quarter_d / (o.z * (0.5f + 0.5f * b.part / b.whole + lambda_o)));
	const lobe_rgb f = lobe_rough_conductor_fresnel(p, lobe_dot(sum, sum), 1.0f);
	const float value = quarter_d / (o.z * (1.0f + lambda_o + lambda_i));
	return (double)(value * (c->channel == 0 ? f.r : c->channel == 1 ? f.g : f.b));
}

double stability_defect_d(const stability_case *c, stability_verb verb) { return defective(c, verb, 1, 0); }
double stability_defect_lambda(const stability_case *c, stability_verb verb) { return defective(c, verb, 0, 1); }
