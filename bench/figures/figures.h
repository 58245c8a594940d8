/* figures.h - the figures that a reader of the microfacet papers would look for, drawn from the library's own
 * functions.
 *
 *	make figures	writes out/figures/<figure>.png, and the numbers of each curve beside it as <figure>.csv
 *
 * One C file a theme; figures.c lists them, figures.gp draws them. */
#ifndef LOBE_BENCH_FIGURES_H
#define LOBE_BENCH_FIGURES_H

#include "lobe/lobe.h"

/* The surfaces that are compared: a name for the legend and the surface at width alpha. */
enum { FIGURE_GGX, FIGURE_BECKMANN, FIGURE_PHONG, FIGURE_GTR1, FIGURE_GTR3, FIGURE_STUDENT_T, FIGURE_SURFACES };
const char *figure_surface_name(int surface);

/* Tables are made at the first call and kept. Ends the program when one cannot be. */
lobe_microsurface figure_surface(int surface, double alpha);

/* A direction in the xz-plane, theta [radians] from the normal towards +x. */
lobe_vec3 figure_direction(double theta);

/* D(m) [1/sr] and the Smith G1(w) of a surface. */
double figure_d(lobe_microsurface s, lobe_vec3 m);
double figure_g1(lobe_microsurface s, lobe_vec3 w);

/* GTR of any gamma. */
lobe_microsurface figure_gtr(double gamma, double alpha);

/* Opens out/figures/<name>.csv for writing; ends the program with a message when that fails. */
void *figure_open(const char *name);

/* figures of D, G1 and tails (distributions.c); of masking functions, Smith against V-cavity, albedo (masking.c); of
 * visible normals as disks (disks.c). */
void figures_of_distributions(void);
void figures_of_masking(void);
void figures_of_disks(void);

#endif
