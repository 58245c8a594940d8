/* figures.c - writes the numbers of every figure to out/figures; figures.gp draws them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../machine.h"
#include "figures.h"
#include "lobe/microfacet/smith.h"

const char *figure_surface_name(int surface)
{
	static const char *const names[FIGURE_SURFACES] = {"GGX",         "Beckmann",    "Phong",
							   "GTR gamma 1", "GTR gamma 3", "Student-T gamma 3"};
	return names[surface];
}

static void check(lobe_status status)
{
	if (status == LOBE_OK)
		return;
	fprintf(stderr, "figures: %s\n", lobe_error_message());
	exit(1);
}

/* A table that lasts as long as the program: surfaces are few. */
static float *new_table(void)
{
	float *const table = malloc(LOBE_PROFILE_WORDS * sizeof *table);
	if (table)
		return table;
	fputs("figures: out of memory\n", stderr);
	exit(1);
}

lobe_microsurface figure_gtr(double gamma, double alpha)
{
	lobe_distribution d;
	check(lobe_distribution_gtr(&d, new_table(), LOBE_PROFILE_WORDS, (float)gamma, (float)alpha));
	return lobe_microsurface_make(d, lobe_linear_stretch(1.0f, 1.0f));
}

static lobe_microsurface make_surface(int surface, double alpha)
{
	const lobe_linear stretch = lobe_linear_stretch((float)alpha, (float)alpha);
	lobe_distribution d;
	switch (surface) {
	case FIGURE_GGX:
		return lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX), stretch);
	case FIGURE_BECKMANN:
		return lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_BECKMANN), stretch);
	case FIGURE_PHONG:
		check(lobe_distribution_phong(&d, new_table(), LOBE_PROFILE_WORDS, (float)(2.0 / (alpha * alpha) - 2.0)));
		return lobe_microsurface_make(d, lobe_linear_stretch(1.0f, 1.0f));
	case FIGURE_GTR1:
		return figure_gtr(1.0, alpha);
	case FIGURE_GTR3:
		return figure_gtr(3.0, alpha);
	default:
		check(lobe_distribution_student_t(&d, new_table(), LOBE_PROFILE_WORDS, 3.0f));
		return lobe_microsurface_make(d, stretch);
	}
}

lobe_microsurface figure_surface(int surface, double alpha)
{
	static struct {
		int surface;
		double alpha;
		lobe_microsurface made;
	} kept[64];
	static size_t count;
	for (size_t i = 0; i < count; i++)
		if (kept[i].surface == surface && kept[i].alpha == alpha)
			return kept[i].made;
	const lobe_microsurface made = make_surface(surface, alpha);
	if (count < sizeof kept / sizeof *kept) {
		kept[count].surface = surface;
		kept[count].alpha = alpha;
		kept[count++].made = made;
	}
	return made;
}

lobe_vec3 figure_direction(double theta) { return lobe_vec3_make((float)sin(theta), 0.0f, (float)cos(theta)); }

double figure_d(lobe_microsurface s, lobe_vec3 m)
{
	return (double)lobe_smith_d(lobe_smith_make(s.distribution, s.map), m);
}

double figure_g1(lobe_microsurface s, lobe_vec3 w)
{
	return (double)lobe_smith_g1(lobe_smith_make(s.distribution, s.map), w);
}

void *figure_open(const char *name)
{
	char path[128];
	snprintf(path, sizeof path, "out/figures/%s.csv", name);
	fprintf(stderr, "figures: %s\n", name);
	FILE *const f = bench_create_file(path);
	if (!f)
		exit(1);
	return f;
}

int main(void)
{
	figures_of_distributions();
	figures_of_disks();
	figures_of_masking();
	return 0;
}
