/* test_masking_field.c - masking measured on explicit random surfaces: what is seen of a Gaussian height field, of the
 * same field stretched, skewed and tilted, and what Smith's model says of both.
 *
 * What of a surface is seen from a direction w is decided within the vertical planes through w. So a field is cut along
 * such planes, at a long row of points, and swept from the far end: a point is seen when its height above the line of
 * sight through the origin exceeds that of all points between it and the viewer.
 *
 * The field is a sum of waves of random directions, lengths and phases: Gaussian by the central limit theorem over many
 * realisations, each with slopes of variance 1/2, the surface of width 1. Its mapped version is built from the map of
 * points p -> M p alone: other wave numbers and a plane; the library's map only says from where the first is to be
 * seen. */
#include "lobe/microfacet/linear.h"

#include "leadr.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAVES = 128, POINTS = 12000, BINS = 6 };
#define STEP 0.05 /* of points along a cut; the correlation length is sqrt(2) */

static int fields(void) { return test_long() ? 1000 : 100; }

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- fields ------------------------------------------------------------------------------------------------------- */

/* Heights sum amplitude cos(k.x + phase) + tilt.x. */
typedef struct {
	double kx[WAVES], ky[WAVES], phase[WAVES];
	double amplitude, tilt_x, tilt_y;
} field;

static double uniform(uint32_t stream, uint64_t i) { return ((double)test_bits(stream, i) + 0.5) * 0x1p-32; }

/* Wave numbers normally distributed, variance 1 each: correlation exp(-r^2/2), slopes of variance 1/2. */
static field field_make(uint32_t seed)
{
	field f;
	for (uint64_t i = 0; i < WAVES; i++) {
		const double r = sqrt(-2.0 * log(uniform(seed, 3 * i))), turn = TWO_PI * uniform(seed, 3 * i + 1);
		f.kx[i] = r * cos(turn);
		f.ky[i] = r * sin(turn);
		f.phase[i] = TWO_PI * uniform(seed, 3 * i + 2);
	}
	f.amplitude = 1.0 / sqrt((double)WAVES);
	f.tilt_x = f.tilt_y = 0.0;
	return f;
}

/* M = (xx xy 0; yx yy 0; zx zy zz) */
typedef struct {
	double xx, xy, yx, yy, zx, zy, zz;
} point_map;

/* The surface that the points of f are moved to: its height at x' is zz f(x) + z.x with x = B^-1 x'. */
static field field_mapped(const field *f, const point_map *m)
{
	field r = *f;
	const double det = m->xx * m->yy - m->xy * m->yx;
	for (int i = 0; i < WAVES; i++) {
		r.kx[i] = (m->yy * f->kx[i] - m->yx * f->ky[i]) / det;
		r.ky[i] = (m->xx * f->ky[i] - m->xy * f->kx[i]) / det;
	}
	r.amplitude = m->zz * f->amplitude;
	r.tilt_x = (m->yy * m->zx - m->yx * m->zy) / det;
	r.tilt_y = (m->xx * m->zy - m->xy * m->zx) / det;
	return r;
}

/* Heights at x + t d, t = 0, step ... */
static void cut(const field *f, double x, double y, double dx, double dy, double step, double height[POINTS])
{
	for (int j = 0; j < POINTS; j++)
		height[j] = f->tilt_x * (x + j * step * dx) + f->tilt_y * (y + j * step * dy);
	for (int i = 0; i < WAVES; i++) {
		const double at = f->kx[i] * x + f->ky[i] * y + f->phase[i],
			     turn = step * (f->kx[i] * dx + f->ky[i] * dy);
		const double c = cos(turn), s = sin(turn);
		double re = f->amplitude * cos(at), im = f->amplitude * sin(at);
		for (int j = 0; j < POINTS; j++) {
			const double next = re * c - im * s;
			height[j] += re;
			im = re * s + im * c;
			re = next;
		}
	}
}

/* --- what is seen ------------------------------------------------------------------------------------------------- */

/* Of a cut, per its length: projected area of all that faces the viewer and of what is seen; and by number, the points
 * that face, those seen, and both by their slopes. */
typedef struct {
	double facing_area, seen_area;
	double facing, seen;
	double facing_in[BINS], seen_in[BINS];
} view;

/* w: unit, in the plane of the cut, towards its far end. Points too near the end to be hidden by what lies beyond,
 * which is not there, are left out. scale: of slopes, two bins each. */
static view look(const double height[POINTS], double step, double across, double z, double scale)
{
	view r;
	memset(&r, 0, sizeof r);
	const double cot = z / across;
	/* Heights are within 5 deviations of the mean plane; the sight rises above that after at most 2/3 of the
	 * cut. */
	double top = -HUGE_VAL;
	int used = 0;
	for (int j = POINTS - 2; j >= 0; j--) {
		/* Above the line of sight. */
		const double here = height[j] - cot * j * step, next = height[j + 1] - cot * (j + 1) * step;
		if (next > top)
			top = next;
		if (j >= POINTS / 3)
			continue;
		const double drop = here - next; /* of the step, seen along w */
		used++;
		if (drop > 0.0) {
			const double depth = drop / (step * scale);
			const int bin = depth < BINS / 2.0 ? (int)(2.0 * depth) : BINS - 1;
			r.facing_area += drop * across;
			r.facing += 1.0;
			r.facing_in[bin] += 1.0;
			if (here > top) {
				r.seen_area += (here - top) * across;
				r.seen += 1.0;
				r.seen_in[bin] += 1.0;
			}
		}
	}
	r.facing_area /= used * step;
	r.seen_area /= used * step;
	r.facing /= used;
	r.seen /= used;
	return r;
}

/* --- the comparison ----------------------------------------------------------------------------------------------- */

/* To widths of .5 and .33, correlated, with mean slopes (.3, -.27). */
static const point_map M = {2.0, 0.6, 0.0, 3.0, 0.6, -0.63, 1.0};

/* The same, as a user would ask for it. */
static lobe_linear library_map(void)
{
	return lobe_linear_from_points((float)M.xx, (float)M.xy, (float)M.yx, (float)M.yy, (float)M.zx, (float)M.zy,
				       (float)M.zz);
}

/* Polar angle and azimuth, degrees. */
static const double views[][2] = {{30.0, 20.0},  {50.0, -42.0}, {62.0, -30.0},
				  {65.0, -60.0}, {80.0, 40.0},  {80.0, 160.0}};
#define VIEWS (sizeof views / sizeof views[0])

typedef struct {
	double n, sum, sum2;
} average;

static void add(average *a, double x)
{
	a->n += 1.0;
	a->sum += x;
	a->sum2 += x * x;
}
static double mean(const average *a) { return a->sum / a->n; }
static double error(const average *a) { return sqrt(fmax(a->sum2 / a->n - mean(a) * mean(a), 0.0) / (a->n - 1.0)); }

/* Of a view: the base field, the mapped one at the images of the same points, and at other points of the same line. */
typedef struct {
	average area, seen_area, facing, seen;
	double facing_in[BINS], seen_in[BINS];
} sums;

static void gather(sums *s, const view *v)
{
	add(&s->area, v->facing_area);
	add(&s->seen_area, v->seen_area);
	add(&s->facing, v->facing);
	add(&s->seen, v->seen);
	for (int b = 0; b < BINS; b++) {
		s->facing_in[b] += v->facing_in[b];
		s->seen_in[b] += v->seen_in[b];
	}
}

static double share(const sums *s) { return mean(&s->seen) / mean(&s->facing); }

enum { BASE, IMAGE, OTHER, WAYS };

static void measure(size_t which, sums result[WAYS], double v[3], double w[3])
{
	static double height[POINTS];
	const double theta = views[which][0] * PI / 180.0, phi = views[which][1] * PI / 180.0;
	w[0] = sin(theta) * cos(phi);
	w[1] = sin(theta) * sin(phi);
	w[2] = cos(theta);
	const lobe_vec3 d = lobe_linear_direction(library_map(), lobe_vec3_make((float)w[0], (float)w[1], (float)w[2]));
	v[0] = (double)d.x;
	v[1] = (double)d.y;
	v[2] = (double)d.z;
	const double across = hypot(v[0], v[1]), mapped_across = hypot(w[0], w[1]);
	const double dx = v[0] / across, dy = v[1] / across, ex = w[0] / mapped_across, ey = w[1] / mapped_across;
	/* A step of the base cut, moved by M, is so long. */
	const double stretch = hypot(M.xx * dx + M.xy * dy, M.yx * dx + M.yy * dy);
	memset(result, 0, WAYS * sizeof *result);
	for (int i = 0; i < fields(); i++) {
		const uint32_t seed = 1000u * (uint32_t)which + (uint32_t)i;
		const field f = field_make(seed), g = field_mapped(&f, &M);
		const double x = 100.0 * uniform(seed, 1000), y = 100.0 * uniform(seed, 1001);
		const double mx = M.xx * x + M.xy * y, my = M.yx * x + M.yy * y;
		view seen;
		cut(&f, x, y, dx, dy, STEP, height);
		seen = look(height, STEP, across, v[2], 1.0);
		gather(&result[BASE], &seen);
		/* Slopes of the mapped field are 1/stretch of the base's along the cut, seen from the mapped
		 * direction. */
		cut(&g, mx, my, ex, ey, STEP * stretch, height);
		seen = look(height, STEP * stretch, mapped_across, w[2], 1.0 / stretch);
		gather(&result[IMAGE], &seen);
		cut(&g, mx + 0.3 * ex, my + 0.3 * ey, ex, ey, 0.7 * STEP * stretch, height);
		seen = look(height, 0.7 * STEP * stretch, mapped_across, w[2], 1.0 / stretch);
		gather(&result[OTHER], &seen);
	}
}

static void test_masking_of_an_explicit_surface(void)
{
	static const leadr one = {LEADR_BECKMANN, 1.0, 1.0, 0.0, 0.0, 0.0};
	double images = 0.0, others = 0.0, area = 0.0, conserved = 0.0, smith = 0.0, smith_area = 0.0, slopes = 0.0,
	       planted = 0.0, planted_area = HUGE_VAL;
	printf("  %10s %9s %22s %22s %10s %10s %10s\n", "view", "", "sigma(w)", "G1 by area", "seen of", "mapped",
	       "forgets");
	printf("  %10s %9s %11s %10s %11s %10s %10s %10s %10s\n", "[degrees]", "v.z", "measured", "theory", "measured",
	       "Smith", "facing", "field", "the shear");
	for (size_t i = 0; i < VIEWS; i++) {
		sums s[WAYS];
		double v[3], w[3];
		measure(i, s, v, w);
		const double sigma = leadr_sigma(&one, v), g1 = v[2] / sigma;
		const double measured_g1 = mean(&s[IMAGE].seen_area) / mean(&s[IMAGE].area);
		/* Planted: the same map without its shear. */
		lobe_linear level = library_map();
		level.mean_x = level.mean_y = 0.0f;
		const lobe_vec3 d = lobe_linear_direction(level, lobe_vec3_make((float)w[0], (float)w[1], (float)w[2]));
		const double flat[3] = {(double)d.x, (double)d.y, (double)d.z};
		const double flat_sigma = leadr_sigma(&one, flat), flat_g1 = flat[2] / flat_sigma;
		printf("  %4.0f, %4.0f %9.3f %11.4f %10.4f %11.4f %10.4f %10.4f %10.4f %10.4f\n", views[i][0],
		       views[i][1], v[2], mean(&s[IMAGE].area), sigma, measured_g1, g1, share(&s[BASE]),
		       share(&s[IMAGE]), flat_g1);
		images = larger(images, fabs(share(&s[IMAGE]) - share(&s[BASE])));
		others = larger(others, fabs(share(&s[OTHER]) - share(&s[BASE])) /
						(error(&s[BASE].seen) / mean(&s[BASE].facing)));
		area = larger(area, fabs(mean(&s[IMAGE].area) - sigma) / error(&s[IMAGE].area));
		conserved = larger(conserved, fabs(mean(&s[IMAGE].seen_area) - v[2]) / error(&s[IMAGE].seen_area));
		smith_area = larger(smith_area, fabs(measured_g1 - g1));
		smith = larger(smith, fabs(share(&s[IMAGE]) - g1));
		for (int b = 0; b < BINS; b++)
			if (s[IMAGE].facing_in[b] > 1000.0)
				slopes = larger(slopes, fabs(s[IMAGE].seen_in[b] / s[IMAGE].facing_in[b] - g1));
		planted = larger(planted, fabs(share(&s[IMAGE]) - flat_g1));
		planted_area = fmin(planted_area, fabs(mean(&s[IMAGE].area) - flat_sigma) / error(&s[IMAGE].area));
	}
	/* The library's direction is in floats: 1 of 10^5 points may be that near to being hidden. */
	measured("invariance: seen of facing points, against their images", images, 3e-5);
	measured("  against other points of the surface, in standard errors", others, 3.0);
	measured("sigma of the explicit surface against theory, in standard errors", area, 4.0);
	measured("seen area against the mean plane's v.z, in standard errors", conserved, 4.0);
	measured("Smith's G1 against seen area over facing area", smith_area, 0.02);
	measured("Smith's G1 against the share of facing points that is seen", smith, 0.1);
	printf("  %-60s %11.4g\n", "  and of those of one slope (Smith: the same for all)", slopes);
	printf("  %-60s %11.4g\n", "planted, masking that forgets the shear: G1 off by up to", planted);
	printf("  %-60s %11.4g\n", "  its sigma off by at least, in standard errors", planted_area);
	TEST_ASSERT_TRUE(planted > 0.3 && planted_area > 10.0);
}

/* From behind the mean plane a surface without an end shows nothing, and yet some of its facets face there. */
static void test_facing_away(void)
{
	static double height[POINTS];
	static const leadr one = {LEADR_BECKMANN, 1.0, 1.0, 0.0, 0.0, 0.0};
	const double theta = 80.0 * PI / 180.0, phi = -42.0 * PI / 180.0;
	const double w[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
	const lobe_vec3 d = lobe_linear_direction(library_map(), lobe_vec3_make((float)w[0], (float)w[1], (float)w[2]));
	const double v[3] = {(double)d.x, (double)d.y, (double)d.z};
	average area = {0, 0, 0};
	double seen = 0.0;
	TEST_ASSERT_TRUE(v[2] < -0.05 && w[2] > 0.1);
	for (int i = 0; i < fields(); i++) {
		const field f = field_make(9000u + (uint32_t)i), g = field_mapped(&f, &M);
		cut(&g, 0.0, 0.0, cos(phi), sin(phi), 0.1, height);
		const view r = look(height, 0.1, sin(theta), w[2], 1.0);
		add(&area, r.facing_area);
		seen += r.seen;
	}
	printf("  v.z = %.3f: facing area %.4f, theory %.4f; seen %.1g\n", v[2], mean(&area), leadr_sigma(&one, v),
	       seen);
	measured("sigma from behind, in standard errors", fabs(mean(&area) - leadr_sigma(&one, v)) / error(&area), 4.0);
	TEST_ASSERT_TRUE(seen == 0.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_masking_of_an_explicit_surface);
	RUN_TEST(test_facing_away);
	return UNITY_END() != 0;
}
