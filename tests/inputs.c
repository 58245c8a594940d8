#include "inputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support.h"

enum { DIRECTIONS = 112, NUMBERS = 8 };

inputs inputs_alloc(size_t count)
{
	inputs in;
	in.count = count;
	for (int k = 0; k < 9; k++) {
		in.array[k] = malloc(count * sizeof(float));
		if (!in.array[k]) {
			fprintf(stderr, "out of memory for %zu inputs\n", count);
			exit(1);
		}
	}
	return in;
}

void inputs_free(inputs in)
{
	for (int k = 0; k < 9; k++)
		free(in.array[k]);
}

static void from_angles(double z, double phi, float w[3])
{
	const double r = sqrt((1.0 - z) * (1.0 + z));
	w[0] = (float)(r * cos(phi));
	w[1] = (float)(r * sin(phi));
	w[2] = (float)z;
}

/* wi close to the mirror image (or continuation) of wo: off by about 10^-5 .. 1. */
static void near_specular(size_t i, const float wo[3], float wi[3])
{
	const double spread = pow(10.0, -5.0 * (double)test_uniform(13, i));
	const double flip = test_bits(14, i) & 1 ? 1.0 : -1.0;
	double w[3], length = 0.0;
	for (int k = 0; k < 3; k++) {
		const double jitter = spread * (2.0 * (double)test_uniform((uint32_t)(15 + k), i) - 1.0);
		w[k] = (k == 2 ? flip : -1.0) * (double)wo[k] + jitter;
		length += w[k] * w[k];
	}
	for (int k = 0; k < 3; k++)
		wi[k] = (float)(w[k] / sqrt(length));
}

void inputs_random(inputs in, size_t first)
{
	for (size_t i = 0; i < in.count; i++) {
		const size_t n = first + i;
		const uint32_t how = test_bits(10, n);
		float wo[3], wi[3];
		test_direction(11, n, wo);
		test_direction(12, n, wi);
		if (how % 4 == 0) /* grazing */
			from_angles((how & 16 ? 1.0 : -1.0) * pow(10.0, -7.0 * (double)test_uniform(18, n)),
				    TWO_PI * (double)test_uniform(19, n), wo);
		if (how / 4 % 4 < 2)
			near_specular(n, wo, wi);
		for (int k = 0; k < 3; k++) {
			in.array[k][i] = wo[k];
			in.array[3 + k][i] = wi[k];
			in.array[6 + k][i] = test_uniform((uint32_t)(20 + k), n);
		}
	}
}

static void extreme_directions(float w[DIRECTIONS][3])
{
	static const double cosine[] = {1.0, 0.999999, 0.7, 0.1, 1e-3, 1e-4, 1e-6, 1e-7, 0.0};
	static const double azimuth[] = {0.0, 0.7, 1.5707963267948966, 3.141592653589793, 4.0, 6.283};
	size_t n = 0;
	for (size_t c = 0; c < sizeof cosine / sizeof *cosine; c++)
		for (size_t a = 0; a < sizeof azimuth / sizeof *azimuth; a++)
			for (double sign = 1.0; sign >= -1.0; sign -= 2.0)
				from_angles(sign * cosine[c], azimuth[a], w[n++]);
	const float odd[][3] = {{0, 0, 0}, {NAN, 0, 1}, {INFINITY, 0, 0}, {0.6f, 0.0f, 0.80000037f}};
	for (size_t i = 0; i < sizeof odd / sizeof *odd; i++, n++)
		for (int k = 0; k < 3; k++)
			w[n][k] = odd[i][k];
	if (n != DIRECTIONS) {
		fprintf(stderr, "inputs.c: %zu extreme directions, not %d\n", n, DIRECTIONS);
		exit(1);
	}
}

inputs inputs_extreme(void)
{
	static const float number[NUMBERS] = {0.0f,           0x1p-149f, 0x1p-24f, 0.25f,
					      0x1.fffffep-2f, 0.5f,      0.75f,    0x1.fffffep-1f};
	float w[DIRECTIONS][3];
	extreme_directions(w);
	/* Every wo with every u, and, in the same elements, with each wi in turn. */
	const size_t triples = NUMBERS * NUMBERS * NUMBERS;
	inputs in = inputs_alloc(DIRECTIONS * triples);
	for (size_t i = 0; i < in.count; i++) {
		const size_t u = i % triples;
		for (int k = 0; k < 3; k++) {
			in.array[k][i] = w[i / triples][k];
			in.array[3 + k][i] = w[u % DIRECTIONS][k];
		}
		in.array[6][i] = number[u % NUMBERS];
		in.array[7][i] = number[u / NUMBERS % NUMBERS];
		in.array[8][i] = number[u / NUMBERS / NUMBERS];
	}
	return in;
}

lobe_batch inputs_batch_to(inputs in, const uint32_t *material, float *const out[INPUTS_OUTPUTS])
{
	lobe_batch b;
	memset(&b, 0, sizeof b);
	b.count = in.count;
	b.material = material;
	for (int k = 0; k < 3; k++) {
		b.wo[k] = in.array[k];
		b.wi[k] = in.array[3 + k];
		b.u[k] = in.array[6 + k];
		b.f[k] = out[k];
		b.sample_wi[k] = out[4 + k];
		b.weight[k] = out[7 + k];
	}
	b.pdf = out[3];
	b.sample_pdf = out[10];
	b.event = (uint32_t *)(void *)out[11];
	return b;
}

lobe_batch inputs_batch(inputs in, const uint32_t *material, float *out)
{
	float *array[INPUTS_OUTPUTS];
	for (size_t k = 0; k < INPUTS_OUTPUTS; k++)
		array[k] = out + k * in.count;
	return inputs_batch_to(in, material, array);
}
