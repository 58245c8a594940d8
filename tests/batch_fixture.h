/* batch_fixture.h - what tests of batches begin with: a native device, a scene of three lobes, a whole batch for it. */
#ifndef LOBE_TESTS_BATCH_FIXTURE_H
#define LOBE_TESTS_BATCH_FIXTURE_H

#include "lobe/lobe.h"

enum { FIXTURE_N = 1000 };

/* in: wo x y z, wi x y z, u x y z. out: f, pdf, sample_wi, weight and sample_pdf, and two that nothing writes to. */
typedef struct {
	lobe_device *device;
	lobe_scene *scene;
	float in[9][FIXTURE_N], out[13][FIXTURE_N];
	uint32_t material[FIXTURE_N], event[FIXTURE_N];
} batch_fixture;

extern batch_fixture fixture;

/* For setUp: device and scene, inputs as they were before any test spoiled them, and outputs of 0xee bytes. For
 * tearDown: closes both. */
void fixture_open(void);
void fixture_close(void);

/* A whole batch; tests spoil one thing each. */
lobe_batch good_batch(void);

/* The call failed with status, and the message has the word in it. */
void assert_refused(lobe_status expected, lobe_status got, const char *word);

/* For tests of devices rather than of lobes: two lobes and LOBE_KIND_NONE, and n elements of each in turn. */
void fixture_materials(lobe_bsdf materials[3], uint32_t *material, uint32_t n);

#endif
