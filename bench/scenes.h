/* scenes.h - what is measured: one representative material of every lobe, the verbs, and the machine's devices. */
#ifndef LOBE_BENCH_SCENES_H
#define LOBE_BENCH_SCENES_H

#include "lobe/lobe.h"

enum {
#define LOBE_X(NAME, name, kind) BENCH_LOBE_##NAME,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	BENCH_LOBES,
	BENCH_OPEN = BENCH_LOBES + 1,
	BENCH_OPEN_GLASS,
	BENCH_SCENES
};

/* The lobe's name in lobes.def, or what else a scene is called: 0 .. BENCH_SCENES - 1. */
const char *bench_lobe_name(int lobe);

/* Of lobe 0 .. BENCH_LOBES - 1. */
lobe_bsdf bench_lobe_material(int lobe);

/* A scene of that lobe alone, or of every lobe when it is BENCH_LOBES. BENCH_OPEN: of the material of
 * microfacet_conductor and one that chooses otherwise wherever a choice is made at run time, so that a program for it
 * has all choices open; BENCH_OPEN_GLASS: of the material of ggx_dielectric and such as are delta or dense. */
lobe_status bench_scene_create(lobe_scene **out, lobe_device *device, int lobe);

/* What a batch is asked for. */
enum {
	BENCH_EVAL,      /* f */
	BENCH_PDF,       /* pdf */
	BENCH_EVAL_PDF,  /* both */
	BENCH_SAMPLE,    /* wi, weight, pdf, event */
	BENCH_SAMPLE_WI, /* wi, event */
	BENCH_VERBS
};

const char *bench_verb_name(int verb);

/* 1 for the verbs of lobe_scene_sample. */
int bench_verb_samples(int verb);

enum { BENCH_DEVICES_MAX = 16 };

typedef struct {
	char label[32]; /* as lobe_device_open takes it */
	lobe_device *device;
	size_t threads; /* of the copy that it is compared with: a native device's own, processor_count() for OpenCL */
} bench_device;

int bench_is_opencl(const bench_device *device);

/* Opens native:1, native and every OpenCL device, or the one of that name, and prints a line for each. The number
 * opened. Of the first, one that does not open is printed as skipped, with the reason; the one of that name is an
 * error, on stderr. */
int bench_devices_open(bench_device *devices, const char *only);
void bench_devices_close(bench_device *devices, int count);

#endif
