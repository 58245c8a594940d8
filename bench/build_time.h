/* build_time.h - how long the OpenCL program of a scene takes to build: cold, with the runtime's cache filled, with
 * lobe's own, and for a second scene of the same kinds on an open device. */
#ifndef LOBE_BENCH_BUILD_TIME_H
#define LOBE_BENCH_BUILD_TIME_H

#include "scenes.h"

/* One measurement of the scene of one lobe on one device. */
typedef struct {
	int lobe;
	const bench_device *device; /* NULL: not measured */
	double value;
} bench_build_figure;

/* The highest of all scenes of one lobe. share: the cold build, in percent of that of the scene of all lobes; without
 * the first launch, which compiles as many kernels in either. cached, kept: the build and the first launch in a second
 * process, in milliseconds: from what the runtime keeps by itself, from what lobe does. */
typedef struct {
	bench_build_figure share, cached, kept;
} bench_build_highest;

/* Prints the table of every scene of scenes.h - each lobe alone, all of them, and what leaves choices open - by OpenCL
 * device, and writes it to path; lobe: of that one alone, -1: all. Each build is a process of its own: program, run as
 * bench_build_child wants it. runs: builds of each kind, of which the median counts; only one of each once seconds have
 * passed. 0 after a failure. highest: of zeros. */
int bench_build_times(const char *program, const bench_device *devices, int count, int lobe, size_t runs,
		      double seconds, const char *path, bench_build_highest *highest);

/* The child: program --build-child CACHE KEPT DEVICE LOBE. CACHE: the folder in which OpenCL runtimes are to keep what
 * they compiled; KEPT: LOBE_CACHE_DIR, or "-" for none; LOBE: as of bench_scene_create. Prints seconds. Its exit
 * status. */
int bench_build_child(char **arguments);

#endif
