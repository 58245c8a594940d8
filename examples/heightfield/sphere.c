/* sphere.c - see sphere.h. */
#include "sphere.h"

#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 8, STEPS_MAX = 1 << 16 };

/* --- light ------------------------------------------------------------------------------------------------------ */

/* A round lamp with a soft edge: brightness in its middle, and its size, 1 - cos of an angle. */
static lobe_rgb lamp(lobe_vec3 w, lobe_vec3 towards, float size, lobe_rgb brightness)
{
	const float fall = (1.0f - lobe_dot(w, towards)) / size;
	return lobe_rgb_scale(brightness, lobe_exp(-fall * fall));
}

static lobe_rgb plus(lobe_rgb a, lobe_rgb b) { return lobe_rgb_make(a.r + b.r, a.g + b.g, a.b + b.b); }

/* From direction w, y up: a dim sky over a dark floor, a lamp from the left above and a cold one from the right. */
static lobe_rgb light(lobe_vec3 w)
{
	const lobe_vec3 left = lobe_normalize(lobe_vec3_make(-0.55f, 0.6f, 0.6f));
	const lobe_vec3 right = lobe_normalize(lobe_vec3_make(0.8f, 0.1f, 0.35f));
	const float up = 0.5f + 0.5f * w.y;
	const lobe_rgb sky = lobe_rgb_make(0.05f + 0.12f * up, 0.045f + 0.14f * up, 0.04f + 0.19f * up);
	return plus(sky, plus(lamp(w, left, 0.05f, lobe_rgb_make(5.0f, 4.5f, 3.9f)),
			      lamp(w, right, 0.1f, lobe_rgb_make(0.9f, 1.3f, 2.0f))));
}

/* --- the field as geometry -------------------------------------------------------------------------------------- */

/* Without the plane, by which directions and heights are sheared, the heights repeat in both axes. */
struct relief {
	int size;
	float *heights;
	double mean_x, mean_y, top, bottom;
	double steepest; /* slope along an edge of a texel */
};

struct point {
	double x, y, z;
};

/* The texels around (x, y), and where it lies between them. */
struct corners {
	double u, v, a, b, c, d;
};

static struct corners corners_of(const struct relief *r, double x, double y)
{
	const int n = r->size;
	const double fx = floor(x), fy = floor(y);
	/* n is a power of 2. */
	const int i = (int)fx & (n - 1), j = (int)fy & (n - 1), k = (i + 1) & (n - 1), l = (j + 1) & (n - 1);
	const float *row = r->heights + (size_t)j * (size_t)n, *next = r->heights + (size_t)l * (size_t)n;
	const struct corners q = {x - fx, y - fy, (double)row[i], (double)row[k], (double)next[i], (double)next[k]};
	return q;
}

static double height_at(const struct relief *r, double x, double y)
{
	const struct corners q = corners_of(r, x, y);
	const double below = q.a + q.u * (q.b - q.a), above = q.c + q.u * (q.d - q.c);
	return below + q.v * (above - below);
}

/* The normal there, plane and all; of any length. */
static lobe_vec3 normal_at(const struct relief *r, double x, double y)
{
	const struct corners q = corners_of(r, x, y);
	const double sx = (1.0 - q.v) * (q.b - q.a) + q.v * (q.d - q.c),
		     sy = (1.0 - q.u) * (q.c - q.a) + q.u * (q.d - q.b);
	return lobe_vec3_make((float)-(sx + r->mean_x), (float)-(sy + r->mean_y), 1.0f);
}

/* Whether the surface is met going from p along d, and then where; otherwise the ray has left above. A step cannot pass
 * through the surface, or is one texel long, where waves are some 50 texels; a crossing is then found by false
 * position. */
static int trace_ray(const struct relief *r, struct point *p, struct point d)
{
	const double across = sqrt(d.x * d.x + d.y * d.y), closing = fabs(d.z) + 1.5 * r->steepest * across;
	const double least = fmin(across > 0.0 ? 1.0 / across : HUGE_VAL, (r->top - r->bottom) / fabs(d.z));
	double above = fmax(p->z - height_at(r, p->x, p->y), 0.0);
	/* Directions that graze the top could go on for ever. */
	for (int i = 0; i < STEPS_MAX && (d.z < 0.0 || p->z < r->top); i++) {
		const double step = fmax(least, above / closing);
		const struct point q = {p->x + step * d.x, p->y + step * d.y, p->z + step * d.z};
		const double next = q.z - height_at(r, q.x, q.y);
		if (next <= 0.0) {
			double lo = 0.0, hi = step, f_lo = fmax(above, 1e-12), f_hi = next;
			for (int k = 0; k < 6; k++) {
				/* Halfway in between as well, for surfaces that bend. */
				const double t = k & 1 ? 0.5 * (lo + hi) : lo + (hi - lo) * f_lo / (f_lo - f_hi);
				const double f = p->z + t * d.z - height_at(r, p->x + t * d.x, p->y + t * d.y);
				if (f > 0.0) {
					lo = t;
					f_lo = f;
				} else {
					hi = t;
					f_hi = f;
				}
			}
			p->x += lo * d.x;
			p->y += lo * d.y;
			p->z += lo * d.z;
			return 1;
		}
		*p = q;
		above = next;
	}
	return 0;
}

/* Directions as the relief without its plane sees them. */
static struct point sheared(const struct relief *r, lobe_vec3 w)
{
	const struct point d = {(double)w.x, (double)w.y,
				(double)w.z - r->mean_x * (double)w.x - r->mean_y * (double)w.y};
	return d;
}

/* One ray from wo onto the relief: where it is mirrored to. 0 if it is met again, or the relief is seen from behind. */
static int mirror_field(const struct relief *r, lobe_vec3 wo, const float u[3], lobe_vec3 *wi)
{
	const struct point v = sheared(r, wo), back = {-v.x, -v.y, -v.z};
	const double n = (double)r->size;
	struct point p = {n * (double)u[0], n * (double)u[1], r->top};
	if (v.z <= 0.0)
		return 0;
	trace_ray(r, &p, back);
	const lobe_vec3 m = normal_at(r, p.x, p.y);
	*wi = lobe_reflect(wo, m, lobe_dot(wo, m) / lobe_dot(m, m));
	const struct point out = sheared(r, *wi);
	if (out.z <= 0.0)
		return 0;
	return !trace_ray(r, &p, out);
}

/* --- the ball ---------------------------------------------------------------------------------------------------- */

/* A point of the ball: its frame in the world, the viewer at +z. */
struct place {
	lobe_vec3 tangent, bitangent, normal, wo;
};

/* 0 beside the ball. */
static int place_at(struct place *p, float x, float y)
{
	const float z2 = 1.0f - x * x - y * y;
	if (z2 <= 0.0f)
		return 0;
	p->normal = lobe_vec3_make(x, y, lobe_sqrt(z2));
	/* The tangent runs round the vertical axis. */
	p->tangent = lobe_normalize(lobe_vec3_make(p->normal.z, 0.0f, -x));
	p->bitangent = lobe_cross(p->normal, p->tangent);
	p->wo = lobe_vec3_make(p->tangent.z, p->bitangent.z, p->normal.z);
	return 1;
}

static lobe_vec3 to_world(const struct place *p, lobe_vec3 w)
{
	return lobe_vec3_fma(w.x, p->tangent, lobe_vec3_fma(w.y, p->bitangent, lobe_vec3_scale(p->normal, w.z)));
}

static lobe_rgb sample_field(const struct relief *r, const struct place *p, const float u[3])
{
	lobe_vec3 wi;
	if (!mirror_field(r, p->wo, u, &wi))
		return lobe_rgb_make(0.0f, 0.0f, 0.0f);
	return light(to_world(p, wi));
}

static lobe_rgb sample_surface(lobe_smith s, const struct place *p, const float u[3])
{
	const lobe_vec3 m = lobe_smith_visible(s, p->wo, lobe_vec2_make(u[0], u[1]));
	const lobe_vec3 wi = lobe_reflect(p->wo, m, lobe_dot(p->wo, m));
	const float g1 = lobe_smith_g1(s, p->wo);
	const float weight = g1 > 0.0f ? lobe_smith_g2(s, p->wo, wi) / g1 : 0.0f;
	return lobe_rgb_scale(light(to_world(p, wi)), weight);
}

/* The relief, or the surface where there is none. */
static void render(const struct sphere_view *view, const struct relief *relief, lobe_smith surface)
{
	const float size = (float)view->size, radius = 0.47f;
	for (int j = 0; j < view->size; j++) {
		for (int i = 0; i < view->size; i++) {
			lobe_rgb sum = {0.0f, 0.0f, 0.0f};
			for (uint32_t k = 0; k < view->spp; k++) {
				const struct random_key key = {7, (uint32_t)(j * view->size + i), k, 0};
				float at[3], u[3];
				struct place p;
				random_spread(key, RANDOM_CAMERA, at);
				random_spread(key, RANDOM_LOBE, u);
				const float x = (((float)i + at[0]) / size - 0.5f) / radius;
				const float y = (0.5f - ((float)j + at[1]) / size) / radius;
				if (!place_at(&p, x, y))
					sum = plus(sum, lobe_rgb_make(0.03f, 0.03f, 0.035f));
				else
					sum = plus(sum, relief ? sample_field(relief, &p, u)
							       : sample_surface(surface, &p, u));
			}
			float *rgb =
				view->image->rgb + 3 * ((size_t)j * (size_t)view->image->width + (size_t)(view->x + i));
			rgb[0] = sum.r / (float)view->spp;
			rgb[1] = sum.g / (float)view->spp;
			rgb[2] = sum.b / (float)view->spp;
		}
		*view->done += (uint64_t)view->size;
		progress_show(view->progress, *view->done);
	}
}

int sphere_of_field(const struct sphere_view *view, const struct field *field, double mean_x, double mean_y)
{
	const size_t n = (size_t)field->size;
	lobe_smith none;
	struct relief r = {field->size, malloc(n * n * sizeof(float)), mean_x, mean_y, -HUGE_VAL, HUGE_VAL, 0.0};
	if (!r.heights)
		return -1;
	for (size_t i = 0; i < n * n; i++) {
		const double z = (double)field->heights[i] - mean_x * (double)(i % n) - mean_y * (double)(i / n);
		r.heights[i] = (float)z;
		r.top = fmax(r.top, z);
		r.bottom = fmin(r.bottom, z);
		if (i % n)
			r.steepest = fmax(r.steepest, fabs(z - (double)r.heights[i - 1]));
		if (i >= n)
			r.steepest = fmax(r.steepest, fabs(z - (double)r.heights[i - n]));
	}
	memset(&none, 0, sizeof none);
	render(view, &r, none);
	free(r.heights);
	return 0;
}

void sphere_of_surface(const struct sphere_view *view, lobe_smith surface) { render(view, NULL, surface); }

double sphere_difference(const struct image *image, int a, int b, int size)
{
	double difference = 0.0, sum = 0.0;
	for (int y = 0; y < size; y += BLOCK)
		for (int x = 0; x < size; x += BLOCK) {
			double mean_a = 0.0, mean_b = 0.0;
			for (int j = y; j < y + BLOCK && j < size; j++)
				for (int i = 3 * x; i < 3 * (x + BLOCK) && i < 3 * size; i++) {
					const float *row = image->rgb + 3 * (size_t)j * (size_t)image->width;
					mean_a += (double)row[3 * a + i];
					mean_b += (double)row[3 * b + i];
				}
			difference += fabs(mean_a - mean_b);
			sum += mean_b;
		}
	return difference / sum;
}
