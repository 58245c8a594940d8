/* support.h - what tests share: reproducible random numbers, distances in ulp, bits, pi. */
#ifndef LOBE_TESTS_SUPPORT_H
#define LOBE_TESTS_SUPPORT_H

#include <stddef.h>
#include <stdint.h>

#define PI     3.14159265358979323846
#define TWO_PI 6.28318530717958647693

/* Number i of stream, uniform in [0, 2^32): Philox4x32-10 (Random123), a function of its arguments alone. */
uint32_t test_bits(uint32_t stream, uint64_t i);

/* Uniform in [0, 1), a multiple of 2^-24. */
float test_uniform(uint32_t stream, uint64_t i);

/* Point i of stream in the unit cube: three such numbers from one block, for sampling loops. */
void test_u3(uint32_t stream, uint64_t i, float u[3]);

/* A unit vector uniform on the sphere, from numbers 2i and 2i + 1 of stream, rounded from double. */
void test_direction(uint32_t stream, uint64_t i, float w[3]);

/* The 4 bytes of x as a number, and back. */
uint32_t test_float_bits(float x);
float test_float_of_bits(uint32_t bits);

/* |a - exact| in units of the last place of exact as a float (at least 2^-149). */
double test_ulp(float a, double exact);

/* 1 when LOBE_TEST_LONG is set: sweeps may then take minutes. */
int test_long(void);

#endif
