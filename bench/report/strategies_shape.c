/* strategies_shape.c - a light as lobe/recommend.h describes it: a disk or a glow, and a sky.
 *
 * Analytic lights are such shapes themselves (but that a sun's sky is described by its own slope). To a probe one is
 * fitted: around the direction of most light, or of most light squared, the disk or glow of which the integral of L^2
 * over its density is least, which is the second moment of light sampled by it. What is below the horizon is left out:
 * no lobe sees it. Or the light itself is asked, at points of its own drawing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pi.h"
#include "strategies.h"

/* Rings around the axis, evenly in the logarithm of 1 - cos from 1e-6 on. */
enum { RINGS = 260 };
static double ring_height(double ring) { return 2.0 * pow(10.0, ring / 40.0 - 6.5); }

static int ring_of(double height)
{
	const int i = (int)(40.0 * (log10(fmax(height, 1e-6) / 2.0) + 6.5));
	return i < 0 ? 0 : i >= RINGS ? RINGS - 1 : i;
}

/* Calls with each texel above the horizon: its direction, luminance and solid angle. */
typedef struct {
	double direction[2][3], total; /* of L^2 and of L */
	double axis[3], squares[RINGS];
} sums;

static void gather(const struct light *light, sums *s, int rings)
{
	const size_t w = (size_t)light->width;
	for (size_t y = 0; 2 * y < (size_t)light->height; y++)
		for (size_t x = 0; x < w; x++) {
			const double l = (double)strategies_luminance(light->texel[y * w + x].radiance);
			const double top = (double)light->cos_theta[y],
				     z = 0.5 * (top + (double)light->cos_theta[y + 1]);
			const double area = 2.0 * PI / (double)w * (top - (double)light->cos_theta[y + 1]);
			const double turn = 2.0 * PI * (((double)x + 0.5) / (double)w - 0.5),
				     r = sqrt((1.0 - z) * (1.0 + z));
			const double v[3] = {r * sin(turn), r * cos(turn), z};
			if (rings) {
				const double c = v[0] * s->axis[0] + v[1] * s->axis[1] + v[2] * s->axis[2];
				s->squares[ring_of(1.0 - c)] += l * l * area;
				continue;
			}
			s->total += l * area;
			for (int k = 0; k < 3; k++) {
				s->direction[0][k] += l * l * area * v[k];
				s->direction[1][k] += l * area * v[k];
			}
		}
}

/* Densities of the rings: of a disk, and of a glow. */
enum { SIZES = 33, SHARES = 20 };
typedef struct {
	double of[SIZES][RINGS];
} profiles;

static float size_of(int i) { return (float)(2e-5 * pow(10.0, i / 6.0)); }

static void tabulate(profiles *disk, profiles *glow)
{
	for (int i = 0; i < SIZES; i++) {
		const double area = (double)size_of(i);
		const double n =
			(double)lobe_light_shape_glow(lobe_vec3_make(0.0f, 0.0f, 1.0f), size_of(i), 1.0f).exponent;
		for (int k = 0; k < RINGS; k++) {
			const double h = ring_height(k + 0.5);
			disk->of[i][k] = h < area / (2.0 * PI) ? 1.0 / area : 0.0;
			glow->of[i][k] = (n + 1.0) / (4.0 * PI) * pow(fmax(1.0 - 0.5 * h, 0.0), n);
		}
	}
}

static double cost_of(const sums *s, const double *disk, double disk_share, const double *glow, double glow_share)
{
	double cost = 0.0;
	for (int i = 0; i < RINGS; i++)
		cost += s->squares[i] /
			(disk_share * disk[i] + glow_share * glow[i] + (1.0 - disk_share - glow_share) / (2.0 * PI));
	return cost;
}

lobe_light_shape strategies_fit(const struct light *light)
{
	static profiles disk, glow;
	lobe_light_shape best = lobe_light_shape_sky(0.0f);
	double least = HUGE_VAL;
	sums s;
	memset(&s, 0, sizeof s);
	tabulate(&disk, &glow);
	gather(light, &s, 0);
	for (int which = 0; which < 2; which++) {
		const double *d = s.direction[which], length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
		if (!(length > 0.0))
			break;
		for (int k = 0; k < 3; k++)
			s.axis[k] = d[k] / length;
		memset(s.squares, 0, sizeof s.squares);
		gather(light, &s, 1);
		const lobe_vec3 axis = lobe_vec3_make((float)s.axis[0], (float)s.axis[1], (float)s.axis[2]);
		for (int i = 0; i < SIZES; i += 2)
			for (int k = i; k < SIZES; k += 2)
				for (int a = 0; a < SHARES; a++)
					for (int b = 0; a + b < SHARES; b++) {
						const double x = (double)a / SHARES, y = (double)b / SHARES;
						const double cost = cost_of(&s, disk.of[i], x, glow.of[k], y);
						if (cost >= least)
							continue;
						least = cost;
						best = lobe_light_shape_with_glow(
							lobe_light_shape_disk(axis, size_of(i), (float)x), size_of(k),
							(float)y);
					}
	}
	return best;
}

static lobe_light_seen seen(const strategies_light *light, lobe_vec3 w)
{
	lobe_light_seen s;
	const lobe_rgb radiance = strategies_radiance(light, w, &s.pdf);
	s.radiance = strategies_luminance(radiance);
	return s;
}

lobe_recommend_sums strategies_asked(const strategies_case *c)
{
	const lobe_microsurface surface = c->lobe[LOBE_STRATEGY_VISIBLE].surface;
	lobe_recommend_sums s = lobe_recommend_start(LOBE_RECOMMEND_POINTS);
	for (int pass = 0; pass < 2; pass++)
		for (lobe_uint i = 1; i <= LOBE_RECOMMEND_POINTS; i++) {
			const lobe_vec3 u = lobe_recommend_u(i), b = lobe_recommend_direction(surface, c->wo, i);
			const struct light_sample l = strategies_draw(&c->light, u.x, u.y);
			lobe_light_seen at_b = {0.0f, 0.0f}, at_l;
			if (b.z > 0.0f)
				at_b = seen(&c->light, b);
			at_l.radiance = strategies_luminance(l.radiance);
			at_l.pdf = l.pdf;
			s = lobe_recommend_add(s, pass, i, surface, c->wo, b, at_b, l.wi, at_l);
		}
	return s;
}

lobe_light_shape strategies_shape(const strategies_light *light)
{
	const strategies_part *p = light->part, *sky = &light->part[light->parts > 1];
	lobe_light_shape shape = light->shape;
	if (light->probe)
		return shape;
	if (p->kind == STRATEGIES_SKY)
		return lobe_light_shape_sky(p->b / p->a);
	if (p->kind == STRATEGIES_GLOW)
		return lobe_light_shape_glow(p->frame.n, (float)light->solid_angle, 1.0f);
	shape = lobe_light_shape_disk(p->frame.n, LOBE_2PI * p->a, p->share);
	shape.slope = light->parts > 1 ? sky->b / sky->a : 0.0f;
	return shape;
}
