/* light.c - see light.h. */
#include "light.h"

#include "pi.h"

#include <float.h>
#include <stdlib.h>

enum { STUDIO_WIDTH = 512, STUDIO_HEIGHT = 256 };

static float luminance(lobe_rgb c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

static int alloc(struct light *light, int width, int height, float degrees)
{
	const size_t w = (size_t)width, h = (size_t)height;
	light->width = width;
	light->height = height;
	light->turn = degrees / 360.0f;
	light->turn -= floorf(light->turn);
	light->texel = malloc(w * h * sizeof *light->texel);
	light->row_cdf = malloc((h + 1) * sizeof *light->row_cdf);
	light->col_cdf = malloc(h * (w + 1) * sizeof *light->col_cdf);
	light->row_guide = malloc(h * sizeof *light->row_guide);
	light->col_guide = malloc(h * w * sizeof *light->col_guide);
	light->cos_theta = malloc((h + 1) * sizeof *light->cos_theta);
	if (light->texel && light->row_cdf && light->col_cdf && light->row_guide && light->col_guide &&
	    light->cos_theta)
		return 0;
	light_free(light);
	return -1;
}

void light_free(struct light *light)
{
	free(light->texel);
	free(light->row_cdf);
	free(light->col_cdf);
	free(light->row_guide);
	free(light->col_guide);
	free(light->cos_theta);
	light->texel = NULL;
	light->row_cdf = light->col_cdf = light->cos_theta = NULL;
	light->row_guide = light->col_guide = NULL;
}

/* Divides running sums by the last one; a total of 0 leaves a distribution that is never used (its pdf is 0). */
static void finish_cdf(float *cdf, uint16_t *guide, const double *sum, size_t n)
{
	for (size_t i = 0; i <= n; i++)
		cdf[i] = sum[n] > 0.0 ? (float)(sum[i] / sum[n]) : (float)i / (float)n;
	cdf[n] = 1.0f;
	for (size_t k = 0, i = 0; k < n; k++) {
		/* The interval of the smallest u for which find() looks here, or one before, since its product is
		 * rounded. */
		while (cdf[i + 1] <= ((float)k - 0.5f) / (float)n)
			i++;
		guide[k] = (uint16_t)i;
	}
}

/* A row first, then a texel in it, then a point in the texel uniform in longitude and in cos(theta), that is uniform in
 * solid angle: so the density is the texel's luminance over the integral of luminance, constant on the texel. */
static int build(struct light *light)
{
	const size_t w = (size_t)light->width, h = (size_t)light->height;
	const size_t longest = (w > h ? w : h) + 1;
	double *sum = malloc((longest + h + 1) * sizeof *sum);
	if (!sum)
		return -1;
	double *rows = sum + longest;
	for (size_t y = 0; y <= h; y++)
		light->cos_theta[y] = (float)cos(PI * (double)y / (double)h);
	light->cos_theta[h] = -1.0f;
	rows[0] = 0.0;
	for (size_t y = 0; y < h; y++) {
		const double solid_angle =
			2.0 * PI / (double)w * ((double)light->cos_theta[y] - (double)light->cos_theta[y + 1]);
		sum[0] = 0.0;
		for (size_t x = 0; x < w; x++)
			sum[x + 1] = sum[x] + (double)luminance(light->texel[y * w + x].radiance);
		finish_cdf(light->col_cdf + y * (w + 1), light->col_guide + y * w, sum, w);
		rows[y + 1] = rows[y] + sum[w] * solid_angle;
	}
	finish_cdf(light->row_cdf, light->row_guide, rows, h);
	for (size_t i = 0; i < w * h; i++)
		light->texel[i].pdf =
			rows[h] > 0.0 ? (float)((double)luminance(light->texel[i].radiance) / rows[h]) : 0.0f;
	free(sum);
	return 0;
}

int light_from_image(struct light *light, const struct image *image, float degrees, size_t *repaired)
{
	const size_t n = (size_t)image->width * (size_t)image->height;
	if (alloc(light, image->width, image->height, degrees) != 0)
		return -1;
	*repaired = 0;
	for (size_t i = 0; i < n; i++) {
		float c[3];
		size_t bad = 0;
		for (size_t k = 0; k < 3; k++) {
			const float x = image->rgb[3 * i + k];
			/* Infinity is what did not fit into a half. The other bound keeps every product finite. */
			c[k] = !(x >= 0.0f) ? 0.0f : (x > FLT_MAX ? 65504.0f : lobe_min(x, 1e9f));
			bad |= c[k] != x;
		}
		light->texel[i].radiance = lobe_rgb_make(c[0], c[1], c[2]);
		*repaired += bad;
	}
	if (build(light) == 0)
		return 0;
	light_free(light);
	return -1;
}

/* --- lookup and sampling ---------------------------------------------------------------------------------------- */

static int clamp_index(int i, int n) { return i < 0 ? 0 : (i >= n ? n - 1 : i); }

lobe_rgb light_radiance(const struct light *light, lobe_vec3 w, float *pdf)
{
	float u = 0.5f + lobe_atan2(w.x, w.y) * (0.5f * LOBE_INV_PI) + light->turn;
	const float v = lobe_acos(lobe_clamp(w.z, -1.0f, 1.0f)) * LOBE_INV_PI;
	u -= floorf(u);
	const int x = clamp_index((int)(u * (float)light->width), light->width);
	const int y = clamp_index((int)(v * (float)light->height), light->height);
	const size_t i = (size_t)y * (size_t)light->width + (size_t)x;
	*pdf = light->texel[i].pdf;
	return light->texel[i].radiance;
}

/* The interval of cdf[0..n] that u in [0,1) falls in, and how far into it. The guide says where the n-th part of [0,1)
 * that u is in begins, and few steps are left from there (Chen and Asau 1974); a binary search would take log n, none
 * of them predictable. */
static int find(const float *cdf, const uint16_t *guide, int n, float u, float *rest)
{
	int i = guide[(int)(u * (float)n)];
	while (cdf[i + 1] <= u)
		i++;
	*rest = (u - cdf[i]) / (cdf[i + 1] - cdf[i]);
	return i;
}

struct light_sample light_draw(const struct light *light, float u1, float u2)
{
	struct light_sample s;
	float in_row, in_col;
	const size_t width = (size_t)light->width;
	const int y = find(light->row_cdf, light->row_guide, light->height, u1, &in_row);
	const int x = find(light->col_cdf + (size_t)y * (width + 1), light->col_guide + (size_t)y * width, light->width,
			   u2, &in_col);
	const size_t i = (size_t)y * width + (size_t)x;
	const float z = light->cos_theta[y] + in_row * (light->cos_theta[y + 1] - light->cos_theta[y]);
	const float turns = ((float)x + in_col) / (float)light->width - light->turn - 0.5f;
	const float r = lobe_sqrt(lobe_max(0.0f, (1.0f - z) * (1.0f + z)));
	const lobe_sincos sc = lobe_sincos_2pi(turns - floorf(turns));
	s.wi = lobe_vec3_make(r * sc.s, r * sc.c, z);
	s.radiance = light->texel[i].radiance;
	s.pdf = light->texel[i].pdf;
	return s;
}

/* --- the studio ------------------------------------------------------------------------------------------------- */

/* 1 below a, 0 above b, smooth between. */
static float fade(float x, float a, float b)
{
	const float t = lobe_clamp((b - x) / (b - a), 0.0f, 1.0f);
	return t * t * (3.0f - 2.0f * t);
}

/* A rectangular lamp around direction (longitude from +y towards +x, latitude; degrees) with half sizes in tangents. */
struct soft_box {
	float longitude, latitude, half_width, half_height, softness;
	lobe_rgb colour;
};

static float soft_box(const struct soft_box *box, lobe_vec3 w)
{
	const lobe_sincos lon = lobe_sincos_2pi(box->longitude / 360.0f);
	const lobe_sincos lat = lobe_sincos_2pi(box->latitude / 360.0f);
	const lobe_vec3 n = lobe_vec3_make(lat.c * lon.s, lat.c * lon.c, lat.s);
	const lobe_vec3 side = lobe_vec3_make(lon.c, -lon.s, 0.0f);
	const float depth = lobe_dot(w, n);
	if (depth < 0.05f)
		return 0.0f;
	const float x = lobe_abs(lobe_dot(w, side) / depth);
	const float y = lobe_abs(lobe_dot(w, lobe_cross(side, n)) / depth);
	return fade(x, box->half_width - box->softness, box->half_width) *
	       fade(y, box->half_height - box->softness, box->half_height);
}

static lobe_rgb mix(lobe_rgb a, lobe_rgb b, float t)
{
	return lobe_rgb_make(a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t);
}

static lobe_rgb studio(lobe_vec3 w)
{
	static const struct soft_box boxes[] = {
		{-128.0f, 48.0f, 0.62f, 0.40f, 0.10f, {6.2f, 5.6f, 4.9f}}, /* key: left, behind the camera */
		{112.0f, 30.0f, 0.16f, 0.75f, 0.06f, {3.2f, 3.6f, 4.2f}},  /* fill: a strip on the right */
		{10.0f, 40.0f, 1.00f, 0.14f, 0.06f, {3.6f, 3.6f, 3.7f}},   /* rim: a bar behind the scene */
	};
	const lobe_rgb zenith = {0.10f, 0.14f, 0.21f}, horizon = {0.46f, 0.44f, 0.41f}, floor = {0.08f, 0.076f, 0.072f};
	const lobe_rgb sun_colour = {23.0f, 19.0f, 13.5f};
	const lobe_vec3 sun = lobe_normalize(lobe_vec3_make(0.62f, -0.35f, 0.70f));
	lobe_rgb c = w.z > 0.0f ? mix(horizon, zenith, lobe_sqrt(w.z)) : mix(horizon, floor, fade(-w.z, 0.25f, 0.0f));
	for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++)
		c = mix(c, boxes[i].colour, soft_box(&boxes[i], w));
	/* A disk of 7 degrees, larger and dimmer than the real sun, so that a few samples find it through glass too. */
	return mix(c, sun_colour, fade(1.0f - lobe_dot(w, sun), 0.006f, 0.009f));
}

int light_studio(struct light *light, float degrees)
{
	if (alloc(light, STUDIO_WIDTH, STUDIO_HEIGHT, degrees) != 0)
		return -1;
	for (int y = 0; y < STUDIO_HEIGHT; y++)
		for (int x = 0; x < STUDIO_WIDTH; x++) {
			const lobe_sincos theta = lobe_sincos_2pi(((float)y + 0.5f) / (2.0f * STUDIO_HEIGHT));
			const lobe_sincos phi = lobe_sincos_2pi(((float)x + 0.5f) / STUDIO_WIDTH);
			/* phi counts from the picture's left edge, at -y. */
			const lobe_vec3 w = lobe_vec3_make(-theta.s * phi.s, -theta.s * phi.c, theta.c);
			light->texel[(size_t)y * STUDIO_WIDTH + (size_t)x].radiance = studio(w);
		}
	if (build(light) == 0)
		return 0;
	light_free(light);
	return -1;
}
