/* disks.c - distributions of visible normals as disks: the density [1/sr] of m at the point (m.x, m.y). */
#include <math.h>
#include <stdio.h>

#include "figures.h"

enum { SIZE = 201 };

/* D(m) max(0, v.m)/sigma(v), or V-cavities' G1(v, m) max(0, v.m) D(m)/z; 0 outside the disk. */
static double visible_density(lobe_microsurface s, int vcavity, lobe_vec3 wo, lobe_vec3 m)
{
	const lobe_vec3 v = lobe_linear_direction(s.map, wo);
	const double facing = (double)lobe_max(lobe_dot(wo, m), 0.0f);
	if (vcavity)
		return (double)lobe_vcavity_g1_over_cos(v.z, (float)facing, m.z) * facing * figure_d(s, m);
	return facing * figure_d(s, m) / (double)lobe_distribution_sigma(s.distribution, v);
}

static void disk(const char *name, lobe_microsurface s, int vcavity, double theta)
{
	const lobe_vec3 wo = figure_direction(theta);
	FILE *f = figure_open(name);
	for (int y = 0; y < SIZE; y++) {
		for (int x = 0; x < SIZE; x++) {
			const double mx = (2.0 * x - (SIZE - 1)) / (SIZE - 1), my = (2.0 * y - (SIZE - 1)) / (SIZE - 1);
			const double z2 = 1.0 - mx * mx - my * my;
			const lobe_vec3 m = lobe_vec3_make((float)mx, (float)my, (float)sqrt(fmax(z2, 0.0)));
			fprintf(f, "%s%.6g", x ? " " : "", z2 > 0.0 ? visible_density(s, vcavity, wo, m) : 0.0);
		}
		fputc('\n', f);
	}
	fclose(f);
}

void figures_of_disks(void)
{
	static const double thetas[] = {0.0, 1.0, 1.5};
	for (int t = 0; t < 3; t++) {
		char name[64];
		snprintf(name, sizeof name, "disk_ggx_%d", t);
		disk(name, figure_surface(FIGURE_GGX, 0.5), 0, thetas[t]);
		snprintf(name, sizeof name, "disk_beckmann_%d", t);
		disk(name, figure_surface(FIGURE_BECKMANN, 0.5), 0, thetas[t]);
		snprintf(name, sizeof name, "disk_vcavity_%d", t);
		disk(name, figure_surface(FIGURE_BECKMANN, 0.5), 1, thetas[t]);
	}
}
