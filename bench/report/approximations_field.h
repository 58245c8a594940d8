/* approximations_field.h - a Gaussian height field with a given slope in its middle, and rays over it.
 *
 * The field is a sum of waves of random directions, lengths and phases: Gaussian by the central limit theorem,
 * correlation exp(-r^2/2), slopes of variance 1/2, that is Beckmann's surface of width 1. Asked is what a reflection
 * needs: of the facets with the half vector's slope, which share do both directions see? So the field is given that
 * slope in its middle by adding what the slope lacks times the field's covariance with it (Matheron): f + (target -
 * slope).x exp(-|x|^2/2) is the Gaussian field of that slope. */
#ifndef LOBE_BENCH_APPROXIMATIONS_FIELD_H
#define LOBE_BENCH_APPROXIMATIONS_FIELD_H

#include <stdint.h>

/* Of a ray, in units of which sqrt(2) is the correlation length. */
#define APPROXIMATIONS_FIELD_STEP 0.04f

enum { APPROXIMATIONS_WAVES = 64 };

typedef struct {
	float kx[APPROXIMATIONS_WAVES], ky[APPROXIMATIONS_WAVES];
	float re[APPROXIMATIONS_WAVES], im[APPROXIMATIONS_WAVES]; /* e^(i phase) at the middle */
	float lack_x, lack_y, height;
} approximations_field;

/* Numbers 3 WAVES answer and on of the stream. */
void approximations_field_make(approximations_field *f, uint32_t stream, uint64_t answer, double slope_x,
			       double slope_y);

/* Whether the ray from the middle along (dx, dy), unit, rising by cot, is free; side -1: below the surface, falling. */
int approximations_field_is_free(const approximations_field *f, float dx, float dy, float cot, float side);

#endif
