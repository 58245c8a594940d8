/* inputs.h - directions and random numbers that every backend is compared on. */
#ifndef LOBE_TESTS_INPUTS_H
#define LOBE_TESTS_INPUTS_H

#include <stddef.h>

#include "lobe/batch.h"

/* Arrays of a batch's inputs: wo x y z, wi x y z, u x y z. */
typedef struct {
	size_t count;
	float *array[9];
} inputs;

/* count elements, freed by inputs_free. Ends the program when out of memory. */
inputs inputs_alloc(size_t count);
void inputs_free(inputs in);

/* Elements first .. first + in.count of an endless sequence: directions over the sphere, at grazing cosines down to
 * 1e-7, and wi near the mirror image or the straight continuation of wo, where narrow lobes are. */
void inputs_random(inputs in, size_t first);

/* All pairs of extreme directions with each other and with extreme random numbers: poles, horizon, cosines to 1e-7 on
 * both sides, not quite unit, zero, NaN and infinite; u at 0, 2^-149, 2^-24, around 1/2 and 1 - 2^-24. */
inputs inputs_extreme(void);

/* A batch of these elements with every output, for both verbs: out holds f, pdf, sample_wi, weight, sample_pdf and
 * event one after another, in.count each. */
enum { INPUTS_OUTPUTS = 12 };
lobe_batch inputs_batch(inputs in, const uint32_t *material, float *out);

/* The same with an array of its own for each output. */
lobe_batch inputs_batch_to(inputs in, const uint32_t *material, float *const out[INPUTS_OUTPUTS]);

#endif
