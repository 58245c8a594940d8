/* opencl_split.h - how a batch is cut between devices, by what has been measured of them. */
#ifndef LOBE_OPENCL_SPLIT_H
#define LOBE_OPENCL_SPLIT_H

#include <stddef.h>

/* Parts are a multiple of this many elements but for the last, and a batch of fewer for each device goes to one. It is
 * also the least that a device gets: one that seemed slow, because it had a program to build, is measured again. */
#define LOBE_CL_SPLIT_PART ((size_t)1024)

/* What a device does. Zeros: nothing is known. */
typedef struct {
	double speed; /* elements in a second */
	int first;    /* it is that of the first batch, which had kernels to build */
} lobe_cl_measure;

/* Cuts n elements for count devices: k gets [to[k], to[k + 1]), in proportion to its speed, equally as long as one is
 * not known. */
void lobe_cl_split(const lobe_cl_measure *m, size_t count, size_t n, size_t *to);

/* A device took so long for n elements. */
void lobe_cl_measure_add(lobe_cl_measure *m, size_t n, double seconds);

#endif
