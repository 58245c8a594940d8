/* slopes.c - see slopes.h. */
#include <math.h>

#include "internal.h"
#include "lobe/slopes.h"

/* --- the map ---------------------------------------------------------------------------------------------------- */

/* Elements of a pyramid that fit into memory, and texels whose bytes can be counted. */
#define TEXELS_MAX (SIZE_MAX / (4 * sizeof(lobe_slope_moments)))

static int is_size(size_t width, size_t height)
{
	const uint64_t side_max = UINT32_MAX;
	return width > 0 && height > 0 && width <= side_max && height <= side_max && width <= TEXELS_MAX / height;
}

static size_t channels(const lobe_slope_map *map) { return map->kind == LOBE_SLOPES_HEIGHT ? 1 : 3; }

static size_t stride_of(const lobe_slope_map *map) { return map->stride ? map->stride : map->width * channels(map); }

static int is_positive(double x) { return x > 0.0 && x <= DBL_MAX; }

static lobe_status check_map(const lobe_slope_map *map)
{
	if (!map)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map is NULL");
	if ((unsigned)map->kind > LOBE_SLOPES_NORMAL_PICTURE)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.kind = %d is no LOBE_SLOPES_*", (int)map->kind);
	if (!map->texels)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.texels is NULL");
	if ((uintptr_t)map->texels % sizeof(float))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.texels is not aligned as float");
	if (map->width == 0 || map->height == 0)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.%s is 0", map->width ? "height" : "width");
	if (!is_size(map->width, map->height))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.width x map.height, %zu x %zu, is no size of memory",
				 map->width, map->height);
	if (map->stride && map->stride < map->width * channels(map))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.stride = %zu is less than a row of %zu floats", map->stride,
				 map->width * channels(map));
	if (stride_of(map) > SIZE_MAX / sizeof(float) / map->height)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.stride = %zu: %zu such rows are no size of memory",
				 map->stride, map->height);
	if (map->kind != LOBE_SLOPES_HEIGHT)
		return LOBE_OK;
	if (!is_positive(map->texel_x) || !is_positive(map->texel_y))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.%s = %g is not a positive distance",
				 is_positive(map->texel_x) ? "texel_y" : "texel_x",
				 is_positive(map->texel_x) ? map->texel_y : map->texel_x);
	if ((unsigned)map->edge > LOBE_EDGE_CLAMP)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.edge = %d is no LOBE_EDGE_*", (int)map->edge);
	return LOBE_OK;
}

/* --- slopes ----------------------------------------------------------------------------------------------------- */

typedef struct {
	double x, y;
} slope;

/* The two neighbours of i among n, and how many texels they are apart (0: there are none). */
typedef struct {
	size_t before, after;
	double distance;
} neighbours;

static neighbours neighbours_of(size_t i, size_t n, lobe_slope_edge edge)
{
	neighbours k;
	if (edge == LOBE_EDGE_WRAP) {
		k.before = i ? i - 1 : n - 1;
		k.after = i + 1 < n ? i + 1 : 0;
		k.distance = 2.0;
	} else {
		k.before = i ? i - 1 : 0;
		k.after = i + 1 < n ? i + 1 : i;
		k.distance = (double)(k.after - k.before);
	}
	return k;
}

static double difference(float before, float after, double distance)
{
	return distance > 0.0 ? ((double)after - (double)before) / distance : 0.0;
}

/* NaN or infinite where the texels give none. */
static slope slope_at(const lobe_slope_map *map, size_t i, size_t j)
{
	const float *row = map->texels + j * stride_of(map);
	slope s;
	if (map->kind == LOBE_SLOPES_HEIGHT) {
		const neighbours x = neighbours_of(i, map->width, map->edge);
		const neighbours y = neighbours_of(j, map->height, map->edge);
		const float *below = map->texels + y.before * stride_of(map);
		const float *above = map->texels + y.after * stride_of(map);
		s.x = difference(row[x.before], row[x.after], x.distance * map->texel_x);
		s.y = difference(below[i], above[i], y.distance * map->texel_y);
	} else {
		double n[3];
		for (size_t k = 0; k < 3; k++) {
			n[k] = (double)row[3 * i + k];
			if (map->kind == LOBE_SLOPES_NORMAL_PICTURE)
				n[k] = 2.0 * n[k] - 1.0;
		}
		s.x = n[2] > 0.0 ? -n[0] / n[2] : (double)NAN;
		s.y = -n[1] / n[2];
		/* Infinite z with finite x gives slopes of 0 that nobody has put there. */
		if (!isfinite(n[2]))
			s.x = (double)NAN;
	}
	if (map->flip_y)
		s.y = -s.y;
	return s;
}

static lobe_status no_slope(const lobe_slope_map *map, size_t i, size_t j)
{
	if (map->kind == LOBE_SLOPES_HEIGHT)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "map.texels: the slope at column %zu, row %zu is too steep", i, j);
	return lobe_fail(LOBE_ERROR_ARGUMENT,
			 "map.texels: no finite slope at column %zu, row %zu: a normal must be finite and have z > 0", i,
			 j);
}

/* Heights are numbers, whether a neighbour's slope looks at them or not. */
static lobe_status check_heights(const lobe_slope_map *map)
{
	for (size_t j = 0; map->kind == LOBE_SLOPES_HEIGHT && j < map->height; j++)
		for (size_t i = 0; i < map->width; i++) {
			const float height = map->texels[j * stride_of(map) + i];
			if (!isfinite(height))
				return lobe_fail(LOBE_ERROR_ARGUMENT, "map.texels: the height at column %zu, row %zu is %g",
						 i, j, (double)height);
		}
	return LOBE_OK;
}

/* Moments of the slope; what is not finite shows in their sum. */
static lobe_slope_moments moments_at(const lobe_slope_map *map, size_t i, size_t j)
{
	const slope s = slope_at(map, i, j);
	const lobe_slope_moments m = {s.x, s.y, s.x * s.x, s.y * s.y, s.x * s.y};
	return m;
}

/* Only finite if all are: no two of them can be infinite of opposite signs and hide. */
static int are_finite(lobe_slope_moments m) { return isfinite(m.xx + m.yy); }

/* --- measure ---------------------------------------------------------------------------------------------------- */

static void accumulate(lobe_slope_moments *sum, lobe_slope_moments m, double weight)
{
	sum->x += weight * m.x;
	sum->y += weight * m.y;
	sum->xx += weight * m.xx;
	sum->yy += weight * m.yy;
	sum->xy += weight * m.xy;
}

/* Moments about (x, y), of rows first, so that rounding grows with a side of the map and not with its area. */
static lobe_status mean_moments(lobe_slope_moments *mean, const lobe_slope_map *map, double x, double y)
{
	lobe_slope_moments sum = {0.0, 0.0, 0.0, 0.0, 0.0};
	const double width = (double)map->width, height = (double)map->height;
	for (size_t j = 0; j < map->height; j++) {
		lobe_slope_moments row = {0.0, 0.0, 0.0, 0.0, 0.0};
		for (size_t i = 0; i < map->width; i++) {
			const slope s = slope_at(map, i, j);
			const double dx = s.x - x, dy = s.y - y;
			const lobe_slope_moments m = {dx, dy, dx * dx, dy * dy, dx * dy};
			if (!are_finite(m))
				return no_slope(map, i, j);
			accumulate(&row, m, 1.0);
		}
		accumulate(&sum, row, 1.0 / width);
	}
	mean->x = sum.x / height;
	mean->y = sum.y / height;
	mean->xx = sum.xx / height;
	mean->yy = sum.yy / height;
	mean->xy = sum.xy / height;
	return are_finite(*mean) ? LOBE_OK
				 : lobe_fail(LOBE_ERROR_ARGUMENT, "map.texels: the squares of the slopes overflow");
}

lobe_status lobe_slope_stats_measure(lobe_slope_stats *stats, const lobe_slope_map *map)
{
	lobe_slope_moments raw, central;
	if (!stats)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "stats is NULL");
	lobe_status status = check_map(map);
	if (status == LOBE_OK)
		status = check_heights(map);
	if (status == LOBE_OK)
		status = mean_moments(&raw, map, 0.0, 0.0);
	if (status == LOBE_OK)
		status = mean_moments(&central, map, raw.x, raw.y);
	if (status != LOBE_OK)
		return status;
	/* The mean of the deviations is not quite 0: what rounding has left of the mean. */
	const double x = central.x, y = central.y;
	stats->moments = raw;
	stats->mean_x = raw.x + x;
	stats->mean_y = raw.y + y;
	stats->var_x = fmax(central.xx - x * x, 0.0);
	stats->var_y = fmax(central.yy - y * y, 0.0);
	stats->cov = central.xy - x * y;
	return LOBE_OK;
}

/* --- pyramid ---------------------------------------------------------------------------------------------------- */

static size_t half(size_t n) { return n > 1 ? n / 2 : 1; }

size_t lobe_slope_levels(size_t width, size_t height)
{
	size_t n = width > height ? width : height, levels = 1;
	if (width == 0 || height == 0)
		return 0;
	for (; n > 1; n /= 2)
		levels++;
	return levels;
}

lobe_status lobe_slope_level(size_t *offset, size_t *level_width, size_t *level_height, size_t width, size_t height,
			     size_t level)
{
	const size_t levels = lobe_slope_levels(width, height);
	if (!is_size(width, height))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "width x height, %zu x %zu, is no size of a map", width, height);
	if (level > levels)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "level = %zu of a pyramid of %zu", level, levels);
	size_t sum = 0;
	for (size_t k = 0; k < level; k++) {
		sum += width * height;
		width = half(width);
		height = half(height);
	}
	if (offset)
		*offset = sum;
	if (level_width)
		*level_width = level < levels ? width : 0;
	if (level_height)
		*level_height = level < levels ? height : 0;
	return LOBE_OK;
}

/* The texels of n that texel i of half(n) covers, and their shares of its area: in units of 1/half(n) of a fine texel,
 * the coarse one covers [i n, (i + 1) n). */
typedef struct {
	size_t first, count; /* at most 3 */
	double share[3];
} cover;

static cover cover_of(size_t i, size_t n)
{
	const uint64_t m = half(n), lo = (uint64_t)i * n, hi = lo + n;
	cover c;
	c.first = (size_t)(lo / m);
	c.count = (size_t)((hi + m - 1) / m) - c.first;
	for (size_t k = 0; k < c.count; k++) {
		const uint64_t begin = (c.first + k) * m, end = begin + m;
		const uint64_t overlap = (end < hi ? end : hi) - (begin > lo ? begin : lo);
		c.share[k] = (double)overlap / (double)n;
	}
	return c;
}

/* Level width x height at fine to the next one at coarse. */
static void coarsen(lobe_slope_moments *coarse, const lobe_slope_moments *fine, size_t width, size_t height)
{
	for (size_t j = 0; j < half(height); j++) {
		const cover rows = cover_of(j, height);
		for (size_t i = 0; i < half(width); i++) {
			const cover columns = cover_of(i, width);
			lobe_slope_moments sum = {0.0, 0.0, 0.0, 0.0, 0.0};
			for (size_t l = 0; l < rows.count; l++)
				for (size_t k = 0; k < columns.count; k++)
					accumulate(&sum, fine[(rows.first + l) * width + columns.first + k],
						   rows.share[l] * columns.share[k]);
			coarse[j * half(width) + i] = sum;
		}
	}
}

/* Every slope is a number whose square is one. */
static lobe_status check_slopes(const lobe_slope_map *map)
{
	const lobe_status status = check_heights(map);
	if (status != LOBE_OK)
		return status;
	for (size_t j = 0; j < map->height; j++)
		for (size_t i = 0; i < map->width; i++)
			if (!are_finite(moments_at(map, i, j)))
				return no_slope(map, i, j);
	return LOBE_OK;
}

lobe_status lobe_slope_pyramid(lobe_slope_moments *pyramid, size_t count, const lobe_slope_map *map)
{
	size_t needed = 0;
	lobe_status status = check_map(map);
	if (status != LOBE_OK)
		return status;
	size_t width = map->width, height = map->height;
	const size_t levels = lobe_slope_levels(width, height);
	lobe_slope_level(&needed, NULL, NULL, width, height, levels);
	if (!pyramid)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "pyramid is NULL");
	if ((uintptr_t)pyramid % sizeof(double))
		return lobe_fail(LOBE_ERROR_ARGUMENT, "pyramid is not aligned as double");
	if (count < needed)
		return lobe_fail(LOBE_ERROR_ARGUMENT, "count = %zu: this pyramid has %zu elements", count, needed);
	status = check_slopes(map);
	if (status != LOBE_OK)
		return status;
	for (size_t j = 0; j < height; j++)
		for (size_t i = 0; i < width; i++)
			pyramid[j * width + i] = moments_at(map, i, j);
	for (size_t level = 1; level < levels; level++) {
		coarsen(pyramid + width * height, pyramid, width, height);
		pyramid += width * height;
		width = half(width);
		height = half(height);
	}
	return LOBE_OK;
}

/* --- moments ---------------------------------------------------------------------------------------------------- */

lobe_slope_moments lobe_slope_scale(lobe_slope_moments m, double factor)
{
	const double square = factor * factor;
	const lobe_slope_moments r = {m.x * factor, m.y * factor, m.xx * square, m.yy * square, m.xy * square};
	return r;
}

lobe_slope_moments lobe_slope_add(lobe_slope_moments a, lobe_slope_moments b)
{
	const lobe_slope_moments r = {a.x + b.x, a.y + b.y, a.xx + b.xx + 2.0 * a.x * b.x,
				      a.yy + b.yy + 2.0 * a.y * b.y, a.xy + b.xy + a.x * b.y + a.y * b.x};
	return r;
}

lobe_slope_moments lobe_slope_roughness(double alpha_x, double alpha_y)
{
	const lobe_slope_moments r = {0.0, 0.0, 0.5 * alpha_x * alpha_x, 0.5 * alpha_y * alpha_y, 0.0};
	return r;
}

lobe_slope_stats lobe_slope_central(lobe_slope_moments m)
{
	lobe_slope_stats s;
	s.moments = m;
	s.mean_x = m.x;
	s.mean_y = m.y;
	/* NaN moments stay NaN. */
	s.var_x = m.xx - m.x * m.x;
	s.var_y = m.yy - m.y * m.y;
	s.var_x = s.var_x < 0.0 ? 0.0 : s.var_x;
	s.var_y = s.var_y < 0.0 ? 0.0 : s.var_y;
	s.cov = m.xy - m.x * m.y;
	return s;
}

lobe_linear lobe_slope_linear(lobe_slope_stats s)
{
	return lobe_linear_from_moments((float)s.mean_x, (float)s.mean_y, (float)s.var_x, (float)s.var_y, (float)s.cov);
}
