/* approximations_field.c - masking of pairs of directions simulated on explicit height fields, as a judge of all
 * models.
 *
 * What is seen of a stretched surface is what is seen of one of width 1 from the stretched direction, so that alpha is
 * a matter of angles. A new field (approximations_field.h) is drawn for each answer: answers are independent, and their
 * standard error is the binomial one. tests/test_report_field.c holds the simulation against one that shares nothing
 * with it, and shows that errors planted in it are found. */
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "approximations.h"
#include "approximations_field.h"
#include "csv.h"
#include "pi.h"
#include "support.h"
#include "textbook.h"

enum { WAVES = APPROXIMATIONS_WAVES, LANES = 16, MODELS = 7 };

static const double alphas[] = {0.2, 0.5, 1.0};
static const double pairs[][3] = {
	/* theta_o, theta_i, azimuth between them [degrees] */
	{60, 60, 180}, {60, 60, 90},  {60, 60, 0}, {75, 60, 180}, {75, 60, 0},  {75, 75, 180},
	{75, 75, 60},  {85, 60, 180}, {85, 60, 0}, {85, 85, 180}, {85, 80, 20}, {45, 75, 120},
};
enum { ALPHAS = sizeof alphas / sizeof *alphas, PAIRS = sizeof pairs / sizeof *pairs };

/* Numbers 0 .. 3 WAVES - 1 of that answer. */
void approximations_field_make(approximations_field *f, uint32_t stream, uint64_t answer, double slope_x,
			       double slope_y)
{
	float sx = 0.0f, sy = 0.0f;
	f->height = 0.0f;
	for (uint64_t i = 0; i < WAVES; i++) {
		float u[3];
		test_u3(stream, answer * WAVES + i, u);
		const float r = sqrtf(-2.0f * lobe_log(u[0] + 0x1p-25f));
		const lobe_sincos turn = lobe_sincos_2pi(u[1]), phase = lobe_sincos_2pi(u[2]);
		f->kx[i] = r * turn.c;
		f->ky[i] = r * turn.s;
		f->re[i] = phase.c / sqrtf((float)WAVES);
		f->im[i] = phase.s / sqrtf((float)WAVES);
		f->height += f->re[i];
		sx -= f->kx[i] * f->im[i];
		sy -= f->ky[i] * f->im[i];
	}
	f->lack_x = (float)slope_x - sx;
	f->lack_y = (float)slope_y - sy;
}

int approximations_field_is_free(const approximations_field *f, float dx, float dy, float cot, float side)
{
	float re[WAVES], im[WAVES], c[WAVES], s[WAVES];
	for (int i = 0; i < WAVES; i++) {
		const lobe_sincos turn = lobe_sincos_2pi((f->kx[i] * dx + f->ky[i] * dy) *
							 (APPROXIMATIONS_FIELD_STEP / 6.28318530717958648f));
		c[i] = turn.c;
		s[i] = turn.s;
		re[i] = f->re[i];
		im[i] = f->im[i];
	}
	const float lack = f->lack_x * dx + f->lack_y * dy, start = side * f->height;
	for (int k = 1;; k++) {
		const float t = APPROXIMATIONS_FIELD_STEP * (float)k, ray = start + cot * t;
		float sum[LANES] = {0.0f}, height = 0.0f;
		/* Five deviations up there is no field any more. */
		if (ray > 3.6f)
			return 1;
		for (int i = 0; i < WAVES; i += LANES)
			for (int l = 0; l < LANES; l++) {
				const float next = re[i + l] * c[i + l] - im[i + l] * s[i + l];
				im[i + l] = re[i + l] * s[i + l] + im[i + l] * c[i + l];
				re[i + l] = next;
				sum[l] += next;
			}
		for (int l = 0; l < LANES; l++)
			height += sum[l];
		height += lack * t * lobe_exp(-0.5f * t * t);
		if (side * height > ray)
			return 0;
	}
}

/* --- models ------------------------------------------------------------------------------------------------------- */

static const char *const models[2][MODELS] = {{"Smith; separable", "Smith; height-correlated",
					       "Smith; direction-correlated", "Smith; height and direction",
					       "V-cavities", "Schlick-Smith k = alpha sqrt(2/pi)", "none"},
					      {"separable", "beta function", "1/(1 + Lo + Li) as on one side"}};

typedef struct {
	double o[3], i[3], m[3]; /* m: the facet, not unit */
	double alpha;
} pair;

static double model_of(const pair *p, int across, int k)
{
	const double lo = textbook_lambda(TEXTBOOK_BECKMANN, p->alpha, p->alpha, p->o);
	const double in[3] = {p->i[0], p->i[1], fabs(p->i[2])};
	const double li = textbook_lambda(TEXTBOOK_BECKMANN, p->alpha, p->alpha, in);
	if (across)
		return k == 0   ? 1.0 / ((1.0 + lo) * (1.0 + li))
		       : k == 1 ? gsl_sf_beta(1.0 + lo, 1.0 + li)
				: 1.0 / (1.0 + lo + li);
	static const lobe_uint joints[4] = {LOBE_JOINT_SEPARABLE, LOBE_JOINT_HEIGHT, LOBE_JOINT_DIRECTION,
					    LOBE_JOINT_HEIGHT_DIRECTION};
	static const lobe_uint maskings[3] = {LOBE_MASKING_VCAVITY, LOBE_MASKING_SCHLICK_SMITH, LOBE_MASKING_NONE};
	lobe_microsurface s =
		lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_BECKMANN),
				       lobe_linear_make((float)p->alpha, 0.0f, 0.0f, (float)p->alpha, 0.0f, 0.0f));
	if (k < 4)
		s.joint = joints[k];
	else
		s.masking = maskings[k - 4];
	const lobe_vec3 o = lobe_vec3_make((float)p->o[0], (float)p->o[1], (float)p->o[2]);
	const lobe_vec3 i = lobe_vec3_make((float)p->i[0], (float)p->i[1], (float)p->i[2]);
	const lobe_vec3 h = lobe_vec3_add(o, i);
	lobe_seen_facet m;
	m.length2 = lobe_dot(h, h);
	m.o = m.i = 0.5f * m.length2;
	m.z = h.z;
	return (double)o.z * (double)lobe_masking_g2_over_cos(s, lobe_see(s, o, 1.0f), lobe_see(s, i, 1.0f), m, 0);
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const int across = (int)(unit / (ALPHAS * PAIRS));
	const double alpha = alphas[unit / PAIRS % ALPHAS], *angles = pairs[unit % PAIRS];
	const uint64_t answers = quick ? 16384u : 262144u;
	const double to = angles[0] * PI / 180.0, ti = angles[1] * PI / 180.0, phi = angles[2] * PI / 180.0;
	pair p = {{sin(to), 0.0, cos(to)}, {sin(ti) * cos(phi), sin(ti) * sin(phi), cos(ti)}, {0, 0, 0}, alpha};
	double seen[3] = {0.0, 0.0, 0.0};
	/* Below: into glass, whose facet is o + 1.5 i turned upwards. */
	if (across)
		p.i[2] = -p.i[2];
	for (int k = 0; k < 3; k++)
		p.m[k] = across ? -(p.o[k] + 1.5 * p.i[k]) : p.o[k] + p.i[k];
	/* Of the surface of width 1; no such facet where it faces away from either. */
	const double slope_x = -p.m[0] / p.m[2] / alpha, slope_y = -p.m[1] / p.m[2] / alpha;
	if (!(p.m[2] > 0.0 && textbook_dot(p.o, p.m) > 0.0 && (across ? -1.0 : 1.0) * textbook_dot(p.i, p.m) > 0.0) ||
	    hypot(slope_x, slope_y) > 2.5)
		return 0;
	for (uint64_t n = 0; n < answers; n++) {
		approximations_field f;
		approximations_field_make(&f, 4000u + (uint32_t)unit, n, slope_x, slope_y);
		const int a = approximations_field_is_free(&f, 1.0f, 0.0f, (float)(cos(to) / (sin(to) * alpha)), 1.0f);
		const int b = approximations_field_is_free(&f, (float)cos(phi), (float)sin(phi),
							   (float)(cos(ti) / (sin(ti) * alpha)), across ? -1.0f : 1.0f);
		seen[0] += a;
		seen[1] += b;
		seen[2] += a & b;
	}
	const double n = (double)answers, both = seen[2] / n;
	const double error = sqrt(fmax(both * (1.0 - both), 1.0 / n) / n);
	for (int k = 0; k < MODELS && models[across][k]; k++)
		report_row(rows, "%s,%g,%g,%g,%g,%.0f,%.5f,%.5f,%.5f,%.5f,%s,%.5f", across ? "across" : "same", alpha,
			   angles[0], angles[1], angles[2], n, seen[0] / n, seen[1] / n, both, error, models[across][k],
			   model_of(&p, across, k));
	return 0;
}

static size_t units(int quick)
{
	(void)quick;
	return 2 * ALPHAS * PAIRS;
}

const report_study approximations_field_study = {
	.name = "approximations_field",
	.columns = "side,alpha,theta_o,theta_i,phi,answers,seen_o,seen_i,seen_both,error,model,value",
	.units = units,
	.run = run,
};
