#include "support.h"

#include <Random123/philox.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

uint32_t test_bits(uint32_t stream, uint64_t i)
{
	const philox4x32_ctr_t counter = {{(uint32_t)(i >> 2), (uint32_t)(i >> 34), stream, 0}};
	const philox4x32_key_t key = {{0x6c6f6265u, 0}};
	return philox4x32(counter, key).v[i & 3];
}

float test_uniform(uint32_t stream, uint64_t i) { return (float)(test_bits(stream, i) >> 8) * 0x1p-24f; }

void test_u3(uint32_t stream, uint64_t i, float u[3])
{
	const philox4x32_ctr_t counter = {{(uint32_t)i, (uint32_t)(i >> 32), stream, 1}};
	const philox4x32_key_t key = {{0x6c6f6265u, 0}};
	const philox4x32_ctr_t r = philox4x32(counter, key);
	for (int k = 0; k < 3; k++)
		u[k] = (float)(r.v[k] >> 8) * 0x1p-24f;
}

void test_direction(uint32_t stream, uint64_t i, float w[3])
{
	const double z = 2.0 * ((double)test_bits(stream, 2 * i) + 0.5) * 0x1p-32 - 1.0;
	const double phi = TWO_PI * (double)test_bits(stream, 2 * i + 1) * 0x1p-32;
	const double r = sqrt((1.0 - z) * (1.0 + z));
	w[0] = (float)(r * cos(phi));
	w[1] = (float)(r * sin(phi));
	w[2] = (float)z;
}

uint32_t test_float_bits(float x)
{
	uint32_t b;
	memcpy(&b, &x, sizeof b);
	return b;
}

float test_float_of_bits(uint32_t bits)
{
	float x;
	memcpy(&x, &bits, sizeof x);
	return x;
}

double test_ulp(float a, double exact)
{
	int e;
	frexp(exact, &e);
	return fabs((double)a - exact) / ldexp(1.0, e - 24 < -149 ? -149 : e - 24);
}

int test_long(void) { return getenv("LOBE_TEST_LONG") != NULL; }
