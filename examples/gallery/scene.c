/* scene.c - see scene.h. */
#include "scene.h"

#include "lobe/shading.h"

/* Balls of radius 1 stand on z = 0 in the middle of rectangular cells, row 0 in front. */
static const float CELL_X = 2.6f, CELL_Y = 3.2f;
static const float TABLE = 60.0f; /* radius; beyond it is the probe */

/* --- materials -------------------------------------------------------------------------------------------------- */

static lobe_bsdf metal(uint32_t name, float roughness_x, float roughness_y)
{
	return lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(
		roughness_x * roughness_x, roughness_y * roughness_y, lobe_metal_eta(name), lobe_metal_k(name)));
}

static lobe_bsdf glass(uint32_t name, float roughness)
{
	const float alpha = roughness * roughness;
	return lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(alpha, alpha, lobe_glass_eta(name)));
}

static lobe_bsdf clay(float r, float g, float b)
{
	return lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(r, g, b)));
}

/* From front to back. Within a row roughness grows to the right, or names change. */
enum { ROW_METAL, ROW_GLASS, ROW_BRUSHED, ROW_ROUGH_GLASS, ROW_ROUGH_METAL, ROW_CLAY };

void scene_make(struct scene *scene)
{
	static const uint32_t glasses[SCENE_COLUMNS] = {LOBE_GLASS_ICE, LOBE_GLASS_WATER,    LOBE_GLASS_ACRYLIC,
							LOBE_GLASS_BK7, LOBE_GLASS_SAPPHIRE, LOBE_GLASS_DIAMOND};
	static const uint32_t metals[SCENE_COLUMNS] = {LOBE_METAL_GOLD,      LOBE_METAL_SILVER, LOBE_METAL_COPPER,
						       LOBE_METAL_ALUMINIUM, LOBE_METAL_IRON,   LOBE_METAL_CHROMIUM};
	static const uint32_t brushed[SCENE_COLUMNS] = {LOBE_METAL_TITANIUM, LOBE_METAL_NICKEL, LOBE_METAL_PLATINUM,
							LOBE_METAL_TUNGSTEN, LOBE_METAL_COPPER, LOBE_METAL_GOLD};
	static const float roughness[SCENE_COLUMNS] = {0.1f, 0.25f, 0.4f, 0.55f, 0.7f, 0.9f};
	/* Rougher glass would be dark: a single-scattering lobe loses what would hit the microsurface again. */
	static const float frost[SCENE_COLUMNS] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
	/* along and across the brushing */
	static const float brush[SCENE_COLUMNS][2] = {{0.15f, 0.3f}, {0.15f, 0.45f}, {0.15f, 0.6f},
						      {0.25f, 0.7f}, {0.2f, 0.6f},   {0.12f, 0.5f}};
	static const float clays[SCENE_COLUMNS][3] = {{0.62f, 0.16f, 0.10f}, {0.75f, 0.42f, 0.12f},
						      {0.28f, 0.42f, 0.16f}, {0.10f, 0.30f, 0.45f},
						      {0.36f, 0.18f, 0.40f}, {0.75f, 0.72f, 0.66f}};
	for (int i = 0; i < SCENE_COLUMNS; i++) {
		lobe_bsdf *m = scene->material + i;
		m[ROW_GLASS * SCENE_COLUMNS] = glass(glasses[i], 0.05f);
		m[ROW_METAL * SCENE_COLUMNS] = metal(metals[i], 0.12f, 0.12f);
		m[ROW_ROUGH_GLASS * SCENE_COLUMNS] = glass(LOBE_GLASS_BK7, frost[i]);
		m[ROW_ROUGH_METAL * SCENE_COLUMNS] = metal(LOBE_METAL_GOLD, roughness[i], roughness[i]);
		m[ROW_BRUSHED * SCENE_COLUMNS] = metal(brushed[i], brush[i][0], brush[i][1]);
		m[ROW_CLAY * SCENE_COLUMNS] = clay(clays[i][0], clays[i][1], clays[i][2]);
	}
	scene->material[SCENE_GROUND] = clay(0.20f, 0.197f, 0.193f);
	scene->material[SCENE_GROUND + 1] = clay(0.28f, 0.276f, 0.27f);

	/* From in front and above, with a long lens, so that the last row is not much smaller than the first. */
	const lobe_vec3 target = lobe_vec3_make(0.0f, -0.75f, 0.8f);
	scene->eye = lobe_vec3_make(0.0f, -33.0f, 29.5f);
	scene->forward = lobe_normalize(lobe_vec3_fma(-1.0f, scene->eye, target));
	const lobe_vec3 right = lobe_normalize(lobe_cross(scene->forward, lobe_vec3_make(0.0f, 0.0f, 1.0f)));
	const float zoom = 0.163f;
	scene->right = lobe_vec3_scale(right, zoom);
	scene->up = lobe_vec3_scale(lobe_cross(right, scene->forward), zoom);
}

/* --- geometry: plain products and sums where it is asked most, since without the processor's fused multiply-add
 * lobe_dot and its like cost several times as much ---------------------------------------------------------------- */

struct ray scene_camera_ray(const struct scene *scene, float x, float y, float aspect)
{
	/* The whole grid stays in the picture, whatever its shape: 4:3 fits it. */
	const float fit = aspect < 4.0f / 3.0f ? 4.0f / 3.0f / aspect : 1.0f;
	struct ray ray;
	ray.origin = scene->eye;
	ray.dir = lobe_normalize(
		lobe_vec3_fma(x * aspect * fit, scene->right, lobe_vec3_fma(y * fit, scene->up, scene->forward)));
	ray.from = SCENE_NOTHING;
	ray.inside = 0;
	return ray;
}

static lobe_vec3 ball_centre(int ball)
{
	const int column = ball % SCENE_COLUMNS, row = ball / SCENE_COLUMNS;
	return lobe_vec3_make(((float)column - 0.5f * (SCENE_COLUMNS - 1)) * CELL_X,
			      ((float)row - 0.5f * (SCENE_ROWS - 1)) * CELL_Y, 1.0f);
}

/* Distance to a ball that the ray does not start on, negative if it misses. The discriminant is formed from the
 * ray's distance to the centre, which keeps its digits far away (Haines et al. 2019, "Precision improvements for
 * ray/sphere intersection", Ray Tracing Gems, chapter 7). */
static float ball_distance(const struct ray *ray, int ball)
{
	const lobe_vec3 centre = ball_centre(ball), dir = ray->dir;
	const float x = ray->origin.x - centre.x, y = ray->origin.y - centre.y, z = ray->origin.z - centre.z;
	const float along = x * dir.x + y * dir.y + z * dir.z;
	const float nx = x - along * dir.x, ny = y - along * dir.y, nz = z - along * dir.z;
	const float d = 1.0f - (nx * nx + ny * ny + nz * nz);
	return d < 0.0f ? -1.0f : -along - lobe_sqrt(d);
}

/* [near, far] of the ray between the planes at low and high of one axis. */
static void clip(float origin, float dir, float low, float high, float *near, float *far)
{
	/* Infinite where the ray is parallel: then inside gives all, outside nothing. */
	const float inverse = 1.0f / dir;
	const float a = (low - origin) * inverse, b = (high - origin) * inverse;
	*near = lobe_max(*near, lobe_min(a, b));
	*far = lobe_min(*far, lobe_max(a, b));
}

static int clamp_cell(float x, int n) { return x < 0.0f ? 0 : (x >= (float)n ? n - 1 : (int)x); }

/* The balls stand in a grid, so the grid itself finds the first one: walk its cells in the order the ray crosses them
 * (Amanatides and Woo 1987). */
static int first_ball(const struct ray *ray, float *distance)
{
	const float x0 = -0.5f * SCENE_COLUMNS * CELL_X, y0 = -0.5f * SCENE_ROWS * CELL_Y;
	const lobe_vec3 o = ray->origin, d = ray->dir;
	float near = 0.0f, far = LOBE_REAL_MAX;
	clip(o.x, d.x, x0, -x0, &near, &far);
	clip(o.y, d.y, y0, -y0, &near, &far);
	clip(o.z, d.z, 0.0f, 2.0f, &near, &far);
	if (!(near <= far))
		return SCENE_NOTHING;
	int column = clamp_cell((o.x + near * d.x - x0) / CELL_X, SCENE_COLUMNS);
	int row = clamp_cell((o.y + near * d.y - y0) / CELL_Y, SCENE_ROWS);
	const int step_x = d.x < 0.0f ? -1 : 1, step_y = d.y < 0.0f ? -1 : 1;
	const float per_x = CELL_X / lobe_abs(d.x), per_y = CELL_Y / lobe_abs(d.y);
	float next_x = (x0 + (float)(column + (step_x > 0)) * CELL_X - o.x) / d.x;
	float next_y = (y0 + (float)(row + (step_y > 0)) * CELL_Y - o.y) / d.y;
	for (;;) {
		const int ball = row * SCENE_COLUMNS + column;
		if (ball != ray->from) {
			const float t = ball_distance(ray, ball);
			if (t > 0.0f) {
				*distance = t;
				return ball;
			}
		}
		/* A parallel ray has an infinite or NaN next_x; the comparison then takes the other axis. */
		if (next_x < next_y || !(next_y < LOBE_REAL_MAX)) {
			if (!(next_x < far))
				return SCENE_NOTHING;
			column += step_x;
			next_x += per_x;
		} else {
			if (!(next_y < far))
				return SCENE_NOTHING;
			row += step_y;
			next_y += per_y;
		}
		if (column < 0 || column >= SCENE_COLUMNS || row < 0 || row >= SCENE_ROWS)
			return SCENE_NOTHING;
	}
}

int scene_intersect(const struct ray *ray, float *distance)
{
	if (ray->inside) {
		/* From a point of the ball itself: the other end of the chord. A ray that leaves by rounding gets 0. */
		const lobe_vec3 c = lobe_vec3_fma(-1.0f, ball_centre(ray->from), ray->origin);
		*distance = lobe_max(0.0f, -2.0f * lobe_dot(c, ray->dir));
		return ray->from;
	}
	const int ball = first_ball(ray, distance);
	if (ball != SCENE_NOTHING || ray->from == SCENE_GROUND || !(ray->dir.z < 0.0f))
		return ball;
	const float t = -ray->origin.z / ray->dir.z;
	const float x = ray->origin.x + t * ray->dir.x, y = ray->origin.y + t * ray->dir.y;
	if (!(t >= 0.0f && x * x + y * y < TABLE * TABLE))
		return SCENE_NOTHING;
	*distance = t;
	return SCENE_GROUND;
}

struct hit scene_hit(const struct ray *ray, int what, float distance)
{
	struct hit hit;
	hit.position = lobe_vec3_fma(distance, ray->dir, ray->origin);
	if (what == SCENE_GROUND) {
		hit.position.z = 0.0f;
		hit.frame = lobe_frame_from_normal(lobe_vec3_make(0.0f, 0.0f, 1.0f));
		/* Squares of two by two cells, with the balls in their corners' middle. */
		const int square = (int)floorf(hit.position.x / CELL_X) + (int)floorf(hit.position.y / CELL_Y);
		hit.material = SCENE_GROUND + (uint32_t)(square & 1);
		return hit;
	}
	/* Back onto the sphere, so that rounding does not add up. */
	const lobe_vec3 centre = ball_centre(what);
	const lobe_vec3 n = lobe_normalize(lobe_vec3_fma(-1.0f, centre, hit.position));
	hit.position = lobe_vec3_add(centre, n);
	hit.material = (uint32_t)what;
	hit.frame = lobe_frame_from_normal(n);
	if (what / SCENE_COLUMNS == ROW_BRUSHED) {
		/* Brushed round an axis, as if turned on a lathe. */
		const lobe_vec3 axis = lobe_vec3_make(0.0f, -0.6f, 0.8f);
		const lobe_vec3 along = lobe_cross(axis, n);
		if (lobe_dot(along, along) > 1e-8f)
			hit.frame = lobe_frame_from_normal_tangent(n, along);
	}
	return hit;
}
