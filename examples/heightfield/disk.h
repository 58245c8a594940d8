/* disk.h - distributions of normals as pictures: the hemisphere seen from above, each normal m at (m.x, m.y). */
#ifndef HEIGHTFIELD_DISK_H
#define HEIGHTFIELD_DISK_H

#include "field.h"
#include "fit.h"
#include "image.h"

/* side x side cells over the square around the disk; each the mean of D(m) there, which is the share of the area whose
 * normals project into it, over its own area. */
struct disk {
	int side;
	double *density;
};

int disk_alloc(struct disk *disk, int side);
void disk_free(struct disk *disk);

void disk_of_slopes(struct disk *disk, const lobe_slope_moments *slopes, size_t count);
void disk_of_wanted(struct disk *disk, const struct wanted *w);
void disk_of_surface(struct disk *disk, lobe_smith surface);

/* Half the sum of differences of the shares of all cells, which are joined to blocks of 8 x 8 first: 0 for the same, 1
 * for what has nothing in common. */
double disk_distance(const struct disk *a, const struct disk *b);

/* Into the picture at column x, scale pixels a cell: three decades below peak from dark to bright. */
void disk_draw(const struct disk *disk, double peak, struct image *image, int x, int scale);

#endif
