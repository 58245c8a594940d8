/* field.c - see field.h. */
#include "field.h"

#include "pi.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Root mean square wave number of heights along an axis, radians a texel: central differences find slopes by 1 - k^2
 * too small. Patches of one width are some times as large as waves. */
static const double WAVE_NUMBER = 0.125, PATCH = 10.0;

/* --- what is wanted --------------------------------------------------------------------------------------------- */

double wanted_p22(const struct wanted *w, double slope_x, double slope_y)
{
	const double root = sqrt(1.0 - w->rho * w->rho);
	const double x = (slope_x - w->mean_x) / w->alpha_x;
	const double y = ((slope_y - w->mean_y) / w->alpha_y - w->rho * x) / root;
	const double r2 = x * x + y * y, q = 1.0 / (1.0 + r2);
	const double area = PI * w->alpha_x * w->alpha_y * root;
	if (w->floor == 0.0)
		return exp(-r2) / area;
	/* The integral over E of exp(-E) times the Gaussian (E + floor) exp(-(E + floor) r2). */
	return exp(-w->floor * r2) * q * (q + w->floor) / area;
}

double wanted_spread(const struct wanted *w)
{
	if (w->floor == 0.0)
		return 1.0;
	/* The midpoint rule over t = exp(-E), which is uniform: 1/(floor - ln t) is smooth but at t = 1. */
	double sum = 0.0;
	const int n = 1 << 20;
	for (int i = 0; i < n; i++)
		sum += 1.0 / (w->floor - log((i + 0.5) / n));
	return sum / n;
}

/* --- Fourier ---------------------------------------------------------------------------------------------------- */

struct complex {
	double re, im;
};

/* sum over k of a[k] exp(2 pi i k j/n), in place; stride between elements. n is a power of 2. */
static void transform(struct complex *a, size_t n, size_t stride)
{
	for (size_t i = 1, j = 0; i < n; i++) {
		size_t bit = n >> 1;
		for (; j & bit; bit >>= 1)
			j ^= bit;
		j |= bit;
		if (i < j) {
			const struct complex t = a[i * stride];
			a[i * stride] = a[j * stride];
			a[j * stride] = t;
		}
	}
	for (size_t half = 1; half < n; half *= 2)
		for (size_t k = 0; k < half; k++) {
			const double angle = PI * (double)k / (double)half, c = cos(angle), s = sin(angle);
			for (size_t i = k; i < n; i += 2 * half) {
				struct complex *p = a + i * stride, *q = a + (i + half) * stride;
				const double re = q->re * c - q->im * s, im = q->re * s + q->im * c;
				q->re = p->re - re;
				q->im = p->im - im;
				p->re += re;
				p->im += im;
			}
		}
}

/* Real heights of a spectrum of waves a cos(k.x + phase) with random phases. Amplitudes are not random: a^2/2 is a
 * normal density of the wave numbers with covariance (xx xy; xy yy), so that all moments are what they should be and
 * not only in the mean. Variance 1. */
static int noise(double *heights, struct complex *work, int size, double xx, double yy, double xy, uint32_t seed)
{
	const int half = size / 2;
	const double det = xx * yy - xy * xy, unit = 2.0 * PI / size;
	double variance = 0.0;
	const size_t n = (size_t)size;
	memset(work, 0, n * n * sizeof *work);
	/* One of each pair k, -k. */
	for (int j = -half + 1; j < half; j++)
		for (int i = j > 0 ? 0 : 1; i < half; i++) {
			const double kx = unit * i, ky = unit * j;
			const double e = (yy * kx * kx - 2.0 * xy * kx * ky + xx * ky * ky) / det;
			const struct random_key key = {seed, (uint32_t)((j + half) * size + i), 0, 0};
			const double phase = 2.0 * PI * (double)random_plain(key, 0), a = exp(-0.25 * e);
			struct complex *c = work + (size_t)((j + size) % size) * n + (size_t)i;
			c->re = a * cos(phase);
			c->im = a * sin(phase);
			variance += 0.5 * a * a;
		}
	for (size_t j = 0; j < n; j++)
		transform(work + j * n, n, 1);
	for (size_t i = 0; i < n; i++)
		transform(work + i, n, n);
	for (size_t i = 0; i < n * n; i++)
		heights[i] = work[i].re / sqrt(variance);
	return 0;
}

/* --- the field -------------------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b)
{
	const double x = **(const double *const *)a, y = **(const double *const *)b;
	return (x > y) - (x < y);
}

/* Multiplies heights by 1/sqrt(E + floor), where E follows a noise of larger waves by rank: the k-th smallest of n
 * values becomes the k-th quantile of the exponential distribution, so that the mixture has no chance in it. */
static int modulate(double *heights, const double *slow, size_t n, double floor)
{
	const double **order = malloc(n * sizeof *order);
	if (!order)
		return -1;
	for (size_t i = 0; i < n; i++)
		order[i] = slow + i;
	qsort(order, n, sizeof *order, ascending);
	for (size_t i = 0; i < n; i++)
		heights[order[i] - slow] /= sqrt(floor - log(((double)i + 0.5) / (double)n));
	free(order);
	return 0;
}

int field_make(struct field *field, const struct wanted *w, int size, uint32_t seed)
{
	const size_t n = (size_t)size * (size_t)size;
	double *heights = malloc(n * sizeof *heights), *slow = malloc(n * sizeof *slow);
	struct complex *work = malloc(n * sizeof *work);
	int status = -1;
	field->size = size;
	field->heights = malloc(n * sizeof *field->heights);
	if (!heights || !slow || !work || !field->heights)
		goto done;
	/* Slopes have height^2 times the covariance of wave numbers. */
	const double xx = 0.5 * w->alpha_x * w->alpha_x, yy = 0.5 * w->alpha_y * w->alpha_y;
	const double xy = 0.5 * w->rho * w->alpha_x * w->alpha_y;
	const double height2 = 0.5 * (xx + yy) / (WAVE_NUMBER * WAVE_NUMBER), height = sqrt(height2);
	const double kxx = xx / height2, kyy = yy / height2, kxy = xy / height2;
	noise(heights, work, size, kxx, kyy, kxy, seed);
	if (w->floor > 0.0) {
		const double k = WAVE_NUMBER / PATCH;
		noise(slow, work, size, k * k, k * k, 0.0, seed + 1);
		if (modulate(heights, slow, n, w->floor) != 0)
			goto done;
	}
	for (int j = 0; j < size; j++)
		for (int i = 0; i < size; i++) {
			const size_t at = (size_t)j * (size_t)size + (size_t)i;
			field->heights[at] = (float)(height * heights[at] + w->mean_x * i + w->mean_y * j);
		}
	/* Means of sin^2 kx and so on over that density, which is what differences make of k^2. */
	const double spread = height2 * wanted_spread(w);
	field->var_x = spread * 0.5 * -expm1(-2.0 * kxx);
	field->var_y = spread * 0.5 * -expm1(-2.0 * kyy);
	field->cov = spread * exp(-0.5 * (kxx + kyy)) * sinh(kxy);
	status = 0;
done:
	free(heights);
	free(slow);
	free(work);
	if (status != 0)
		field_free(field);
	return status;
}

void field_free(struct field *field)
{
	free(field->heights);
	field->heights = NULL;
}
