/* heightfield.c - from heights to a lobe: makes height fields whose slopes are prescribed, measures them, fits
 * microsurfaces, and shows both.
 *
 * field.c makes the fields, fit.c is how lobe is used on them, disk.c draws distributions of normals and sphere.c
 * renders; here are files and tables. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "disk.h"
#include "field.h"
#include "fit.h"
#include "folders.h"
#include "image.h"
#include "progress.h"
#include "sphere.h"

enum { EXIT_USAGE = 2, CELLS = 128 };

static const double TEXEL = 0.5; /* [um] */

static const struct wanted fields[] = {
	{"gaussian", 0.40, 0.20, 0.6, 0.20, -0.10, 0.0},
	{"ggx", 0.12, 0.24, 0.0, 0.0, 0.0, 0.05},
};

struct options {
	const char *out;
	int texels, size;
	uint32_t spp;
};

static const char usage[] = "usage: heightfield [OPTION]...\n"
			    "Makes height fields, measures their slopes, fits microsurfaces, and renders both.\n\n"
			    "  --texels N  side of the fields: 64, 128, ... 4096 (default 1024)\n"
			    "  --size N    side of a ball, 16 to 2048 pixels (default 176)\n"
			    "  --spp N     samples a pixel, 1 to 65536 (default 48)\n"
			    "  --out DIR   where the pictures go (default out/heightfield)\n"
			    "  --help      this text\n\n"
			    "Exit status: 0 success; 1 failure; 2 bad arguments.\n";

static int complain(const char *what, const char *why)
{
	fprintf(stderr, "heightfield: %s: %s\n", what, why);
	return -1;
}

static int parse_number(const char *text, long low, long high, long *value)
{
	char *end;
	*value = strtol(text, &end, 10);
	return end != text && !*end && text[0] != ' ' && *value >= low && *value <= high;
}

/* 0, 1 for --help, or -1 after a complaint. */
static int parse(struct options *o, int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		const char *name = argv[i];
		long n = 0;
		int ok;
		if (!strcmp(name, "--help"))
			return 1;
		if (strcmp(name, "--texels") && strcmp(name, "--size") && strcmp(name, "--spp") &&
		    strcmp(name, "--out"))
			return complain(name, "unknown argument; --help lists them");
		if (++i == argc)
			return complain(name, "needs a value");
		if (!strcmp(name, "--texels")) {
			ok = parse_number(argv[i], 64, 4096, &n) && (n & (n - 1)) == 0;
			o->texels = (int)n;
		} else if (!strcmp(name, "--size")) {
			ok = parse_number(argv[i], 16, 2048, &n);
			o->size = (int)n;
		} else if (!strcmp(name, "--spp")) {
			ok = parse_number(argv[i], 1, 65536, &n);
			o->spp = (uint32_t)n;
		} else {
			ok = argv[i][0] != '\0';
			o->out = argv[i];
		}
		if (!ok) {
			char what[256];
			snprintf(what, sizeof what, "%s %s", name, argv[i]);
			return complain(what, "not a value this option takes; --help says which");
		}
	}
	return 0;
}

/* --- files ------------------------------------------------------------------------------------------------------ */

static void path_of(char *path, size_t size, const struct options *o, const struct wanted *w, const char *suffix)
{
	snprintf(path, size, "%s/%s%s", o->out, w->name, suffix);
}

/* Heights [um] as an EXR file, and back from it, as they would come from elsewhere. */
static int through_file(struct field *field, const struct options *o, const struct wanted *w)
{
	struct image image = {0, 0, NULL};
	char path[768], message[1024];
	const size_t n = (size_t)field->size * (size_t)field->size;
	path_of(path, sizeof path, o, w, ".exr");
	if (image_alloc(&image, field->size, field->size, message, sizeof message) != 0)
		return complain("height field", message);
	for (size_t i = 0; i < n; i++)
		image.rgb[3 * i] = image.rgb[3 * i + 1] = image.rgb[3 * i + 2] = (float)TEXEL * field->heights[i];
	const int written = image_write_exr(&image, path, message, sizeof message);
	image_free(&image);
	if (written != 0)
		return complain("cannot write", message);
	if (image_read_exr(&image, path, message, sizeof message) != 0)
		return complain("cannot read", message);
	for (size_t i = 0; i < n; i++)
		field->heights[i] = image.rgb[3 * i];
	image_free(&image);
	return 0;
}

/* The middle of the field, lit from the left above, columns 0 to size. */
static void draw_relief(struct image *image, int size, const lobe_slope_moments *slopes, int texels)
{
	const lobe_vec3 lamp = lobe_normalize(lobe_vec3_make(-0.8f, 0.5f, 0.3f));
	for (int j = 0; j < size; j++)
		for (int i = 0; i < size; i++) {
			const int x = i % texels, y = (size - 1 - j) % texels;
			const lobe_slope_moments *s = slopes + (size_t)y * (size_t)texels + (size_t)x;
			const lobe_vec3 n = lobe_normalize(lobe_vec3_make((float)-s->x, (float)-s->y, 1.0f));
			float *rgb = image->rgb + 3 * ((size_t)j * (size_t)image->width + (size_t)i);
			rgb[0] = rgb[1] = rgb[2] = lobe_max(lobe_dot(n, lamp), 0.0f);
		}
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

/* To the four digits shown, and no negative 0. */
static double shown(double x) { return rint(1e4 * x) * 1e-4 + 0.0; }

static void print_slopes(const char *what, double mean_x, double mean_y, double var_x, double var_y, double cov)
{
	printf("%-34s %9.4f %9.4f %9.4f %9.4f %9.4f\n", what, shown(mean_x), shown(mean_y), sqrt(2.0 * var_x),
	       sqrt(2.0 * var_y), shown(cov / sqrt(var_x * var_y)));
}

static void print_moments(const struct wanted *w, const struct field *field, const lobe_slope_stats *s,
			  const lobe_slope_stats *top)
{
	const double spread = wanted_spread(w), x = 0.5 * w->alpha_x * w->alpha_x * spread,
		     y = 0.5 * w->alpha_y * w->alpha_y * spread;
	printf("\n%-34s %9s %9s %9s %9s %9s\n", "slopes", "mean x", "mean y", "alpha x", "alpha y", "rho");
	printf("%-34s %9s %9s %9s %9s %9s\n", "", "[1]", "[1]", "[1]", "[1]", "[1]");
	print_slopes("prescribed", w->mean_x, w->mean_y, x, y, w->rho * sqrt(x * y));
	print_slopes("  as differences of texels see it", w->mean_x, w->mean_y, field->var_x, field->var_y, field->cov);
	print_slopes("measured", s->mean_x, s->mean_y, s->var_x, s->var_y, s->cov);
	print_slopes("last level of the pyramid", top->mean_x, top->mean_y, top->var_x, top->var_y, top->cov);
}

/* --- one field --------------------------------------------------------------------------------------------------- */

/* Normals: the field, its histogram, what was wanted, the fits. */
static int draw_normals(const struct options *o, const struct wanted *w, const lobe_slope_moments *slopes,
			const struct fits *fits, double distance[FITS + 1])
{
	struct disk disk[2 + FITS];
	struct image image = {0, 0, NULL};
	char path[768], message[1024];
	const int side = 2 * CELLS, texels = o->texels;
	const size_t count = (size_t)texels * (size_t)texels;
	int status = -1;
	memset(disk, 0, sizeof disk);
	for (int k = 0; k < 2 + FITS; k++)
		if (disk_alloc(&disk[k], CELLS) != 0) {
			complain("normals", "out of memory");
			goto done;
		}
	if (image_alloc(&image, (3 + FITS) * side, side, message, sizeof message) != 0) {
		complain("normals", message);
		goto done;
	}
	disk_of_slopes(&disk[0], slopes, count);
	disk_of_wanted(&disk[1], w);
	for (int k = 0; k < FITS; k++)
		disk_of_surface(&disk[2 + k], fits->surface[k]);
	double peak = 0.0;
	for (size_t i = 0; i < (size_t)CELLS * CELLS; i++)
		peak = fmax(peak, disk[1].density[i]);
	draw_relief(&image, side, slopes, texels);
	for (int k = 0; k < 2 + FITS; k++) {
		disk_draw(&disk[k], peak, &image, (1 + k) * side, 2);
		if (k > 0)
			distance[k - 1] = disk_distance(&disk[0], &disk[k]);
	}
	path_of(path, sizeof path, o, w, "-normals.png");
	if (image_write_png_plain(&image, path, message, sizeof message) != 0) {
		complain("cannot write", message);
		goto done;
	}
	printf("wrote %s: field, its normals, prescribed", path);
	for (int k = 0; k < FITS; k++)
		printf("; %s", fit_name[k]);
	putchar('\n');
	status = 0;
done:
	for (int k = 0; k < 2 + FITS; k++)
		disk_free(&disk[k]);
	image_free(&image);
	return status;
}

/* Balls: of the field itself, and of the fits. */
static int draw_balls(const struct options *o, const struct wanted *w, const struct field *field,
		      const struct fits *fits, double difference[FITS])
{
	struct image image;
	struct progress progress;
	uint64_t done = 0;
	char path[768], message[1024];
	if (image_alloc(&image, (1 + FITS) * o->size, o->size, message, sizeof message) != 0)
		return complain("balls", message);
	progress_start(&progress, w->name, (uint64_t)image.width * (uint64_t)image.height);
	struct sphere_view view = {&image, 0, o->size, o->spp, &progress, &done};
	if (sphere_of_field(&view, field, w->mean_x, w->mean_y) != 0) {
		image_free(&image);
		return complain("balls", "out of memory");
	}
	for (int k = 0; k < FITS; k++) {
		view.x = (1 + k) * o->size;
		sphere_of_surface(&view, fits->surface[k]);
		difference[k] = sphere_difference(&image, view.x, 0, o->size);
	}
	path_of(path, sizeof path, o, w, "-balls.png");
	const int status = image_write_png(&image, path, 0.0f, message, sizeof message);
	image_free(&image);
	if (status != 0)
		return complain("cannot write", message);
	printf("wrote %s: the field, traced", path);
	for (int k = 0; k < FITS; k++)
		printf("; %s", fit_name[k]);
	putchar('\n');
	return 0;
}

static int study(const struct options *o, const struct wanted *w, uint32_t seed)
{
	struct field field = {0, NULL, 0.0, 0.0, 0.0};
	struct fits fits;
	lobe_slope_stats stats;
	lobe_slope_moments *pyramid = NULL;
	double distance[FITS + 1], difference[FITS];
	size_t count = 0;
	const size_t side = (size_t)o->texels;
	int status = -1;
	if (field_make(&field, w, o->texels, seed) != 0) {
		complain("height field", "out of memory");
		goto done;
	}
	if (through_file(&field, o, w) != 0)
		goto done;
	lobe_slope_map map;
	memset(&map, 0, sizeof map);
	map.kind = LOBE_SLOPES_HEIGHT;
	map.texels = field.heights;
	map.width = map.height = side;
	map.texel_x = map.texel_y = TEXEL;
	map.edge = LOBE_EDGE_CLAMP;
	if (lobe_slope_stats_measure(&stats, &map) != LOBE_OK ||
	    lobe_slope_level(&count, NULL, NULL, side, side, lobe_slope_levels(side, side)) != LOBE_OK) {
		complain("slopes", lobe_error_message());
		goto done;
	}
	pyramid = malloc(count * sizeof *pyramid);
	if (!pyramid) {
		complain("pyramid", "out of memory");
		goto done;
	}
	if (lobe_slope_pyramid(pyramid, count, &map) != LOBE_OK) {
		complain("pyramid", lobe_error_message());
		goto done;
	}
	if (fit_all(&fits, &stats, pyramid, side * side) != 0) {
		complain("fit", "out of memory");
		goto done;
	}
	printf("\n%s: %d x %d texels of %g um\n", w->name, o->texels, o->texels, TEXEL);
	const lobe_slope_stats top = lobe_slope_central(pyramid[count - 1]);
	print_moments(w, &field, &stats, &top);
	putchar('\n');
	if (draw_normals(o, w, pyramid, &fits, distance) != 0)
		goto done;
	/* In texels, for tracing. */
	for (size_t i = 0; i < side * side; i++)
		field.heights[i] /= (float)TEXEL;
	if (draw_balls(o, w, &field, &fits, difference) != 0)
		goto done;
	printf("\n%-34s %9s", "differs from the field by", "wanted");
	for (int k = 0; k < FITS; k++)
		printf(" %13s", fit_name[k]);
	printf("\n%-34s %8.1f%%", "  normals, share of the area", 100.0 * distance[0]);
	for (int k = 0; k < FITS; k++)
		printf(" %12.1f%%", 100.0 * distance[1 + k]);
	printf("\n%-34s %9s", "  ball, mean of the radiance", "");
	for (int k = 0; k < FITS; k++)
		printf(" %12.1f%%", 100.0 * difference[k]);
	putchar('\n');
	status = 0;
done:
	free(pyramid);
	field_free(&field);
	return status;
}

int main(int argc, char **argv)
{
	struct options o = {"out/heightfield", 1024, 176, 48};
	const int parsed = parse(&o, argc, argv);
	if (parsed != 0) {
		fputs(parsed > 0 ? usage : "", stdout);
		return parsed > 0 ? EXIT_SUCCESS : EXIT_USAGE;
	}
	setvbuf(stdout, NULL, _IOLBF, 0); /* so that it keeps its order with stderr in a log */
	if (make_folders(o.out) != 0) {
		complain(o.out, strerror(errno));
		return EXIT_FAILURE;
	}
	for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
		if (study(&o, &fields[i], 10u + 10u * (uint32_t)i) != 0)
			return EXIT_FAILURE;
	return EXIT_SUCCESS;
}
