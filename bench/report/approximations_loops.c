/* approximations_loops.c - every way of approximations_ways.h as two loops: one that the compiler vectorises where it
 * can, as it does the library's (the same options, src/rows.c), and one that computes a value after another. */
#define LOBE_FN       static inline __attribute__((always_inline, unused))
#define LOBE_FN_APART LOBE_FN

#include "approximations.h"
#include "approximations_side.h"

#include <math.h>
#include <stdlib.h>

#define APART static __attribute__((noinline))

APPROXIMATIONS_HELPERS

#define WAY_RGB(v)     approximations_rgb(v)
#define WAY_DENSITY(d) approximations_density(d)

LOBE_FN lobe_rgb approximations_rgb(lobe_vec3 v) { return lobe_rgb_make(v.x, v.y, v.z); }
LOBE_FN lobe_real approximations_density(lobe_facet_density d) { return d.inv * d.inv * d.factor; }

#define ARRAYS                                                                                                         \
	size_t n, const float *restrict a, const float *restrict b, const float *restrict c, const float *restrict d,  \
		const float *restrict e, float *restrict r0, float *restrict r1, float *restrict r2
#define ARRAY_ARGUMENTS n, in[0], in[1], in[2], in[3], in[4], out[0], out[1], out[2]

/* The set by value: a compiler need not fear that outputs alias it. Inputs that a value does not use are not read. */
#define LOOP(name, store, between)                                                                                     \
	APART void name##_arrays(approximations_set p, ARRAYS)                                                         \
	{                                                                                                              \
		(void)p;                                                                                               \
		for (size_t i = 0; i < n; i++) {                                                                       \
			const float x = a[i], y = b[i], z = c[i], s = d[i], t = e[i];                                  \
			(void)y, (void)z, (void)s, (void)t;                                                            \
			store;                                                                                         \
			between;                                                                                       \
		}                                                                                                      \
		(void)r0, (void)r1, (void)r2;                                                                          \
	}                                                                                                              \
	static void name(const approximations_set *set, size_t n, const float *const in[APPROXIMATIONS_IN],            \
			 float *const out[APPROXIMATIONS_OUT])                                                         \
	{                                                                                                              \
		name##_arrays(*set, ARRAY_ARGUMENTS);                                                                  \
	}
#define STORE(value) r0[i] = (value)
#define STORE_3(value)                                                                                                 \
	do {                                                                                                           \
		const lobe_rgb v = (value);                                                                            \
		r0[i] = v.r;                                                                                           \
		r1[i] = v.g;                                                                                           \
		r2[i] = v.b;                                                                                           \
	} while (0)
#define LOOPS(group, id, name, exact, value)                                                                           \
	LOOP(id##_vector, STORE(value), SIDE_BY_SIDE) LOOP(id##_scalar, STORE(value), ONE_BY_ONE)
#define LOOPS_3(group, id, name, exact, value)                                                                         \
	LOOP(id##_vector, STORE_3(value), SIDE_BY_SIDE) LOOP(id##_scalar, STORE_3(value), ONE_BY_ONE)
APPROXIMATIONS_WAYS(LOOPS, LOOPS_3, LOOPS, LOOPS_3)

/* --- a film by its spectrum --------------------------------------------------------------------------------------- */

/* The four Gaussians of core/thin_film.h over wave number: centre and standard deviation [1/nm], and their weights in
 * red, green and blue. */
static const double gaussian[4][5] = {{1.6810e-3, 9.30354e-5, 2.66236469, -0.84242389, 0.05381666},
				      {2.2399e-3, 9.51651e-5, 0.48388658, -0.15311112, 0.00978121},
				      {1.7953e-3, 1.364155e-4, -1.66612412, 1.95576345, -0.21459656},
				      {2.2084e-3, 1.149966e-4, -0.48012715, 0.03977156, 1.15099869}};

double approximations_film_sensitivity(int channel, double nu)
{
	double sum = 0.0;
	for (int g = 0; g < 4; g++) {
		const double at = (nu - gaussian[g][0]) / gaussian[g][1];
		sum += gaussian[g][2 + channel] * exp(-0.5 * at * at) / (2.50662827463100050 * gaussian[g][1]);
	}
	return sum;
}

enum { NODES_MAX = 32 };
typedef struct {
	float wavelength, weight[3];
} node;
static node nodes_8[NODES_MAX], nodes_16[NODES_MAX], nodes_32[NODES_MAX];

/* Midpoints over what the observer sees, 4 deviations beyond the outermost Gaussians. */
static void place(node *nodes, int count)
{
	const double from = 1.25e-3, to = 2.72e-3;
	double sum[3] = {0};
	for (int i = 0; i < count; i++) {
		const double nu = from + (to - from) * (i + 0.5) / count;
		nodes[i].wavelength = (float)(1.0 / nu);
		for (int k = 0; k < 3; k++)
			sum[k] += approximations_film_sensitivity(k, nu);
	}
	for (int i = 0; i < count; i++)
		for (int k = 0; k < 3; k++)
			nodes[i].weight[k] =
				(float)(approximations_film_sensitivity(k, 1.0 / (double)nodes[i].wavelength) / sum[k]);
}

void approximations_film_nodes(void)
{
	place(nodes_8, 8);
	place(nodes_16, 16);
	place(nodes_32, 32);
}

/* A wavelength after another over all angles, so that the loop over angles vectorises. */
#define SPECTRUM(id, count, between)                                                                                   \
	APART void id##_add(approximations_set p, node at, size_t n, const float *restrict a, float *restrict r0,      \
			    float *restrict r1, float *restrict r2)                                                    \
	{                                                                                                              \
		for (size_t i = 0; i < n; i++) {                                                                       \
			r0[i] += at.weight[0] * lobe_airy_conductor(a[i], p.film, p.n.r, p.k.r, at.wavelength);        \
			r1[i] += at.weight[1] * lobe_airy_conductor(a[i], p.film, p.n.g, p.k.g, at.wavelength);        \
			r2[i] += at.weight[2] * lobe_airy_conductor(a[i], p.film, p.n.b, p.k.b, at.wavelength);        \
			between;                                                                                       \
		}                                                                                                      \
	}                                                                                                              \
	static void id(const approximations_set *set, size_t n, const float *const in[APPROXIMATIONS_IN],              \
		       float *const out[APPROXIMATIONS_OUT])                                                           \
	{                                                                                                              \
		for (size_t i = 0; i < n; i++)                                                                         \
			out[0][i] = out[1][i] = out[2][i] = 0.0f;                                                      \
		for (int k = 0; k < (count); k++)                                                                      \
			id##_add(*set, nodes_##count[k], n, in[0], out[0], out[1], out[2]);                            \
	}
SPECTRUM(film_8_vector, 8, SIDE_BY_SIDE)
SPECTRUM(film_8_scalar, 8, ONE_BY_ONE)
SPECTRUM(film_16_vector, 16, SIDE_BY_SIDE)
SPECTRUM(film_16_scalar, 16, ONE_BY_ONE)
SPECTRUM(film_32_vector, 32, SIDE_BY_SIDE)
SPECTRUM(film_32_scalar, 32, ONE_BY_ONE)

/* --- the list ----------------------------------------------------------------------------------------------------- */

const char *const approximations_groups[GROUPS] = {"lambda", "dielectric", "conductor", "film",    "masking",
						   "across", "density",    "hidden",    "visible", "real"};

#define TEXT_(...) #__VA_ARGS__
#define TEXT(...)  TEXT_(__VA_ARGS__)
#define ENTRY(outputs, group, id, name, exact, text)                                                                   \
	{GROUP_##group, #id, name, outputs, exact, id##_vector, id##_scalar, text},
#define DEVICE_ENTRY(group, id, name, exact, value)   ENTRY(1, group, id, name, exact, TEXT(value))
#define DEVICE_ENTRY_3(group, id, name, exact, value) ENTRY(3, group, id, name, exact, TEXT(value))
#define HOST_ENTRY(group, id, name, exact, value)     ENTRY(1, group, id, name, exact, NULL)
#define HOST_ENTRY_3(group, id, name, exact, value)   ENTRY(3, group, id, name, exact, NULL)
const approximations_way approximations_ways[] = {
	APPROXIMATIONS_WAYS(DEVICE_ENTRY, DEVICE_ENTRY_3, HOST_ENTRY, HOST_ENTRY_3)
		ENTRY(3, FILM, film_8, "spectrum of 8", 0, NULL) ENTRY(3, FILM, film_16, "spectrum of 16", 0, NULL)
			ENTRY(3, FILM, film_32, "spectrum of 32", 1, NULL)};
size_t approximations_way_count(void) { return sizeof approximations_ways / sizeof *approximations_ways; }
