/* quadrature.h - integrals over directions in coordinates in which a microfacet lobe is flat, and their inverse.
 *
 * The lobe's own samples play no part. A point (x, y) of the unit square is the facet with slopes
 *	(m.x/alpha_x, m.y/alpha_y)/m.z = sqrt(1/x^2 - 1) (cos, sin)(2 pi y)
 * so that a GGX facet distribution of any width fills the square, and a facet stands for the direction that it reflects
 * or refracts wo to. */
#ifndef LOBE_TESTS_QUADRATURE_H
#define LOBE_TESTS_QUADRATURE_H

typedef double (*quadrature_integrand)(void *context, double x, double y);

/* absolute, relative: a cell is split in four until the split changes its integral by less than one of the two (or
 * depth is reached). error: the sum of the last changes. edge: NULL, or a function that is negative where f is 0 and
 * positive elsewhere; cells that its zero may cross are split down to depth, for Gauss points do not see a sliver.
 * kink: NULL, or a function through whose zeros f is not smooth; they are split down too. */
typedef struct {
	quadrature_integrand f, edge, kink;
	void *context;
	double absolute, relative;
	int depth;
	double error;
} quadrature;

/* Integral over [x0, x1] x [y0, y1] by 4 x 4 Gauss points a cell. */
double quadrature_box(quadrature *q, double x0, double x1, double y0, double y1);

/* MAP_SPHERE: equal areas, for lobes without facets. */
typedef enum { MAP_SPHERE, MAP_REFLECT, MAP_TRANSMIT } map_kind;

/* o: wo made unit in double and mirrored to z >= 0 where side is -1. e: index of the far side over that of wo's side.
 */
typedef struct {
	map_kind kind;
	double o[3], side, ax, ay, e;
} direction_map;

direction_map map_make(map_kind kind, const double wo[3], double ax, double ay, double eta);

/* The facet at (x, y), unit, and its solid angle per area of the square. */
double map_facet(const direction_map *m, double x, double y, double facet[3]);

/* wi at (x, y) and its solid angle per area of the square; 0 where the facet is hidden from wo, reflects totally, or
 * sends the light to the wrong side. */
double map_direction(const direction_map *m, double x, double y, double wi[3]);

/* How far inside the part of the square that has directions: negative where map_direction gives 0. */
double map_edge(const direction_map *m, double x, double y);

/* Distance from total reflection, positive where light is refracted: a reflection has a kink there. */
double map_kink(const direction_map *m, double x, double y);

/* (x, y) of wi, the inverse of map_direction. */
void map_coordinates(const direction_map *m, const double wi[3], double *x, double *y);

#endif
