/* disk.c - see disk.h. */
#include "disk.h"

#include <math.h>
#include <stdlib.h>

enum { BLOCK = 8, INSIDE = 4 }; /* points a cell is averaged over: INSIDE^2 */

int disk_alloc(struct disk *disk, int side)
{
	disk->side = side;
	disk->density = calloc((size_t)side * (size_t)side, sizeof *disk->density);
	return disk->density ? 0 : -1;
}

void disk_free(struct disk *disk)
{
	free(disk->density);
	disk->density = NULL;
}

void disk_of_slopes(struct disk *disk, const lobe_slope_moments *slopes, size_t count)
{
	const double side = (double)disk->side, cell = 4.0 / (side * side);
	for (size_t i = 0; i < count; i++) {
		const double len = sqrt(1.0 + slopes[i].xx + slopes[i].yy);
		/* The last cell has its edge: a slope so steep that its sine is 1. */
		const double x = fmin(0.5 * side * (1.0 - slopes[i].x / len), side - 1.0);
		const double y = fmin(0.5 * side * (1.0 - slopes[i].y / len), side - 1.0);
		disk->density[(size_t)y * (size_t)disk->side + (size_t)x] += 1.0 / ((double)count * cell);
	}
}

/* density(context, m) over all cells. */
static void fill(struct disk *disk, double (*density)(const void *, lobe_vec3), const void *context)
{
	const double step = 2.0 / (disk->side * INSIDE);
	for (int j = 0; j < disk->side * INSIDE; j++)
		for (int i = 0; i < disk->side * INSIDE; i++) {
			const double x = (i + 0.5) * step - 1.0, y = (j + 0.5) * step - 1.0, z2 = 1.0 - x * x - y * y;
			if (z2 > 0.0)
				disk->density[(size_t)(j / INSIDE) * (size_t)disk->side + (size_t)(i / INSIDE)] +=
					density(context, lobe_vec3_make((float)x, (float)y, (float)sqrt(z2))) /
					(INSIDE * INSIDE);
		}
}

static double wanted_d(const void *context, lobe_vec3 m)
{
	const double z = (double)m.z;
	return wanted_p22(context, -(double)m.x / z, -(double)m.y / z) / (z * z * z * z);
}

static double surface_d(const void *context, lobe_vec3 m)
{
	return (double)lobe_smith_d(*(const lobe_smith *)context, m);
}

void disk_of_wanted(struct disk *disk, const struct wanted *w) { fill(disk, wanted_d, w); }

void disk_of_surface(struct disk *disk, lobe_smith surface) { fill(disk, surface_d, &surface); }

double disk_distance(const struct disk *a, const struct disk *b)
{
	const double cell = 4.0 / ((double)a->side * (double)a->side);
	double sum = 0.0;
	for (int y = 0; y < a->side; y += BLOCK)
		for (int x = 0; x < a->side; x += BLOCK) {
			double difference = 0.0;
			for (int j = y; j < y + BLOCK && j < a->side; j++)
				for (int i = x; i < x + BLOCK && i < a->side; i++) {
					const size_t at = (size_t)j * (size_t)a->side + (size_t)i;
					difference += a->density[at] - b->density[at];
				}
			sum += 0.5 * fabs(difference) * cell;
		}
	return sum;
}

/* From black by violet and orange to a pale yellow, lightness rising throughout. */
static void colour(double t, float rgb[3])
{
	static const float stops[6][3] = {{0.001f, 0.001f, 0.004f}, {0.035f, 0.010f, 0.120f}, {0.190f, 0.015f, 0.160f},
					  {0.600f, 0.070f, 0.050f}, {0.930f, 0.330f, 0.030f}, {0.980f, 0.950f, 0.480f}};
	const double at = fmin(fmax(t, 0.0), 1.0) * 5.0;
	const int i = at < 5.0 ? (int)at : 4;
	const float f = (float)(at - i);
	for (int k = 0; k < 3; k++)
		rgb[k] = stops[i][k] + f * (stops[i + 1][k] - stops[i][k]);
}

void disk_draw(const struct disk *disk, double peak, struct image *image, int x, int scale)
{
	const int pixels = disk->side * scale;
	for (int j = 0; j < pixels; j++)
		for (int i = 0; i < pixels; i++) {
			/* The top row first; y points up. */
			const int row = disk->side - 1 - j / scale;
			const double d = disk->density[(size_t)row * (size_t)disk->side + (size_t)(i / scale)];
			const double u = 2.0 * (i + 0.5) / pixels - 1.0, v = 2.0 * (j + 0.5) / pixels - 1.0;
			float *rgb = image->rgb + 3 * ((size_t)j * (size_t)image->width + (size_t)(x + i));
			if (u * u + v * v > 1.0)
				rgb[0] = rgb[1] = rgb[2] = 0.6f;
			else
				colour(d > 0.0 ? 1.0 + log10(d / peak) / 3.0 : 0.0, rgb);
		}
}
