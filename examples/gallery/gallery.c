/* gallery.c - renders a gallery of materials on every device and compares: speed, pictures, error against run time.
 *
 * An example of lobe's batches inside a path tracer. trace.c is the part to read: the algorithm and its batches.
 * scene.c holds what is looked at, light.c what lights it, options.c the arguments, ../common/ random numbers and
 * files; here are devices, pictures and tables. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folders.h"
#include "image.h"
#include "light.h"
#include "options.h"
#include "pool.h"
#include "progress.h"
#include "scene.h"
#include "trace.h"

enum { EXIT_USAGE = 2, MAX_DEVICES = 64, PICTURE_SEED = 1, REFERENCE_SEED = 2 };

/* The error is measured on a picture smaller by this, so that its reference takes no longer than the picture. */
enum { ERROR_SHRINK = 5, ERROR_STEPS = 4 };
static const uint32_t error_spp[ERROR_STEPS] = {1, 4, 16, 64};

/* One device and what was measured on it. */
struct entry {
	char name[64];
	char description[256];
	lobe_device *device;
	lobe_scene *materials;
	double build_seconds, seconds;
	struct trace_stats stats;
	size_t differing;
	double error_seconds[ERROR_STEPS];
};

/* --- devices ---------------------------------------------------------------------------------------------------- */

/* 0, -1 for a device that does not open, EXIT_FAILURE for one on which the materials cannot be had; then *why says why.
 * e is to be closed in any case. */
static int open_device(struct entry *e, const char *name, size_t length, const struct scene *scene, const char **why)
{
	const double before = seconds_now();
	memset(e, 0, sizeof *e);
	snprintf(e->name, sizeof e->name, "%.*s", (int)length, name);
	*why = "no device has such a long name";
	if (length >= sizeof e->name)
		return -1;
	lobe_status status = lobe_device_open(&e->device, e->name);
	if (status == LOBE_OK)
		status = lobe_scene_create(&e->materials, e->device, scene->material, SCENE_MATERIALS);
	if (status != LOBE_OK) {
		*why = lobe_error_message();
		return e->device ? EXIT_FAILURE : -1;
	}
	snprintf(e->description, sizeof e->description, "%s", lobe_device_name(e->device));
	e->build_seconds = seconds_now() - before;
	return 0;
}

static void close_device(struct entry *e)
{
	lobe_scene_destroy(e->materials);
	lobe_device_close(e->device);
}

/* native and all of OpenCL. Nobody has asked for an OpenCL device that lobe refuses, so it is left out. Returns as
 * open_device; *opened of the entries are to be closed in any case. */
static int open_all(struct entry *entries, size_t *opened, const struct scene *scene)
{
	const char *why = "";
	size_t opencl = 0;
	*opened = 1;
	const int status = open_device(&entries[0], "native", strlen("native"), scene, &why);
	if (status != 0)
		return complain("native", why), status;
	if (lobe_device_count("opencl", &opencl) != LOBE_OK)
		printf("skipped: opencl: %s\n", lobe_error_message());
	for (size_t i = 0; i < opencl && *opened < MAX_DEVICES; i++) {
		struct entry *e = &entries[*opened];
		char name[32];
		snprintf(name, sizeof name, "opencl:%zu", i);
		if (open_device(e, name, strlen(name), scene, &why) == 0) {
			++*opened;
			continue;
		}
		printf("skipped: %s: %s\n", name, why);
		close_device(e);
	}
	return 0;
}

/* The devices of a comma-separated list, each of which must open. Otherwise as open_all. */
static int open_listed(struct entry *entries, size_t *opened, const char *list, const struct scene *scene)
{
	for (*opened = 0; *opened < MAX_DEVICES; list++) {
		struct entry *e = &entries[(*opened)++];
		const size_t length = strcspn(list, ",");
		const char *why = "";
		const int status = open_device(e, list, length, scene, &why);
		if (status != 0)
			return complain(e->name, why), status;
		list += length;
		if (!*list)
			return 0;
	}
	return complain("--device", "too many");
}

/* --- pictures --------------------------------------------------------------------------------------------------- */

/* gallery.png and .exr, or gallery-opencl-0.png for a device whose picture is another. */
static int write_picture(const struct image *image, const struct options *o, const char *device)
{
	char path[768], suffix[80] = "", message[1024];
	if (device) {
		snprintf(suffix, sizeof suffix, "-%.63s", device);
		for (char *c = suffix; *c; c++)
			*c = *c == ':' ? '-' : *c;
	}
	snprintf(path, sizeof path, "%s/gallery%s.png", o->out, suffix);
	if (image_write_png(image, path, o->exposure, message, sizeof message) != 0)
		return complain("cannot write", message);
	printf("wrote %s", path);
	snprintf(path, sizeof path, "%s/gallery%s.exr", o->out, suffix);
	if (image_write_exr(image, path, message, sizeof message) != 0)
		return putchar('\n'), complain("cannot write", message);
	printf(" and %s\n", path);
	return 0;
}

static size_t differing_pixels(const struct image *a, const struct image *b)
{
	size_t count = 0;
	for (size_t i = 0; i < (size_t)a->width * (size_t)a->height; i++)
		count += memcmp(a->rgb + 3 * i, b->rgb + 3 * i, 3 * sizeof(float)) != 0;
	return count;
}

/* Brings every pixel to `until` samples on e's device; label NULL: quietly. */
static int run(struct film *film, const struct trace_setup *common, const struct entry *e, const char *label,
	       uint32_t until, struct trace_stats *stats)
{
	struct progress progress;
	char message[512];
	struct trace_stats own = {0, 0, 0.0};
	struct trace_setup setup = *common;
	progress_start(&progress, label, (uint64_t)film->width * (uint64_t)film->height * (until - film->samples));
	setup.materials = e->materials;
	setup.progress = label ? progress_show : NULL;
	setup.context = &progress;
	if (trace(film, &setup, until, &own, message, sizeof message) != 0)
		return complain(e->name, message);
	stats->samples += own.samples;
	stats->queries += own.queries;
	stats->lobe_seconds += own.lobe_seconds;
	return 0;
}

/* A small picture that nobody sees: OpenCL may put off compiling a kernel until it runs. */
static int warm_up(struct entry *e, struct trace_setup *setup)
{
	struct film film;
	struct trace_stats stats = {0, 0, 0.0};
	const double before = seconds_now();
	if (film_alloc(&film, 64, 48) != 0)
		return complain("picture", "out of memory");
	const int status = run(&film, setup, e, NULL, 1, &stats);
	film_free(&film);
	e->build_seconds += seconds_now() - before;
	return status;
}

/* The picture on every device; the first one's is written and the others' compared with it. */
static int render(struct entry *entries, size_t count, struct trace_setup *setup, const struct options *o)
{
	struct image first = {0, 0, NULL}, other = {0, 0, NULL};
	struct film film = {0, 0, 0, NULL};
	char message[256];
	int status = -1;
	if (image_alloc(&first, o->width, o->height, message, sizeof message) != 0 ||
	    image_alloc(&other, o->width, o->height, message, sizeof message) != 0) {
		complain("picture", message);
		goto done;
	}
	for (size_t i = 0; i < count; i++) {
		struct entry *e = &entries[i];
		if (warm_up(e, setup) != 0)
			goto done;
		if (film_alloc(&film, o->width, o->height) != 0) {
			complain("picture", "out of memory");
			goto done;
		}
		const double before = seconds_now();
		if (run(&film, setup, e, e->name, o->spp, &e->stats) != 0)
			goto done;
		e->seconds = seconds_now() - before;
		film_image(&film, i ? &other : &first);
		film_free(&film);
		e->differing = i ? differing_pixels(&first, &other) : 0;
		if ((i == 0 || e->differing) && write_picture(i ? &other : &first, o, i ? e->name : NULL) != 0)
			goto done;
	}
	status = 0;
done:
	film_free(&film);
	image_free(&first);
	image_free(&other);
	return status;
}

/* --- error against run time -------------------------------------------------------------------------------------- */

struct error {
	double relative_mse, rmse;
};

/* Against the reference r, over pixels and channels. Relative: each square is divided by r^2 + 0.01, so that dark
 * pixels count as much as bright ones and black ones do not divide by 0. */
static struct error measure(const struct image *image, const struct image *reference)
{
	const size_t n = (size_t)image->width * (size_t)image->height * 3;
	struct error e = {0.0, 0.0};
	for (size_t i = 0; i < n; i++) {
		const double r = (double)reference->rgb[i], d = (double)image->rgb[i] - r;
		e.relative_mse += d * d / (r * r + 0.01) / (double)n;
		e.rmse += d * d / (double)n;
	}
	e.rmse = sqrt(e.rmse);
	return e;
}

/* Fills errors, and every device's error_seconds. The devices give the same pictures, as render() has found or not, so
 * that the errors are those of the first and the reference is left to the fastest. */
static int measure_errors(struct entry *entries, size_t count, struct trace_setup *setup, const struct options *o,
			  int width, int height, struct error errors[ERROR_STEPS])
{
	struct image steps[ERROR_STEPS], reference = {0, 0, NULL};
	struct film film = {0, 0, 0, NULL};
	struct trace_stats stats = {0, 0, 0.0};
	char message[256];
	int status = image_alloc(&reference, width, height, message, sizeof message);
	size_t fastest = 0;
	memset(steps, 0, sizeof steps);
	for (size_t k = 0; k < ERROR_STEPS && status == 0; k++)
		status = image_alloc(&steps[k], width, height, message, sizeof message);
	if (status != 0)
		complain("error table", message);
	for (size_t i = 0; i < count && status == 0; i++) {
		double seconds = 0.0;
		status = film_alloc(&film, width, height);
		for (size_t k = 0; k < ERROR_STEPS && status == 0; k++) {
			const double before = seconds_now();
			status = run(&film, setup, &entries[i], NULL, error_spp[k], &stats);
			seconds += seconds_now() - before;
			entries[i].error_seconds[k] = seconds;
			if (i == 0 && status == 0)
				film_image(&film, &steps[k]);
		}
		if (entries[i].seconds < entries[fastest].seconds)
			fastest = i;
		film_free(&film);
	}
	if (status == 0 && (status = film_alloc(&film, width, height)) == 0) {
		setup->seed = REFERENCE_SEED;
		status = run(&film, setup, &entries[fastest], "reference", o->reference, &stats);
		setup->seed = PICTURE_SEED;
	}
	if (status == 0) {
		film_image(&film, &reference);
		for (size_t k = 0; k < ERROR_STEPS; k++)
			errors[k] = measure(&steps[k], &reference);
	}
	film_free(&film);
	image_free(&reference);
	for (size_t k = 0; k < ERROR_STEPS; k++)
		image_free(&steps[k]);
	return status;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

static void print_devices(const struct entry *entries, size_t count)
{
	printf("\n%10s %10s %12s %12s %14s %12s  device\n", "set-up", "wall time", "samples", "queries",
	       "in the batches", "differing");
	printf("%10s %10s %12s %12s %14s %12s\n", "[s]", "[s]", "[M/s]", "[M]", "[M queries/s]", "[pixels]");
	for (const struct entry *e = entries; e < entries + count; e++)
		printf("%10.2f %10.2f %12.2f %12.1f %14.1f %12zu  %s\n", e->build_seconds, e->seconds,
		       (double)e->stats.samples / e->seconds * 1e-6, (double)e->stats.queries * 1e-6,
		       (double)e->stats.queries / e->stats.lobe_seconds * 1e-6, e->differing, e->description);
}

static void print_errors(const struct entry *entries, size_t count, const struct options *o, int width, int height,
			 const struct error *errors)
{
	printf("\nerror against run time, at %d x %d; reference: %" PRIu32 " other samples a pixel\n\n", width, height,
	       o->reference);
	printf("%8s %14s %14s", "samples", "relative MSE", "RMSE");
	for (size_t i = 0; i < count; i++)
		printf(" %14s", entries[i].name);
	printf("\n%8s %14s %14s", "[1/px]", "[1]", "[radiance]");
	for (size_t i = 0; i < count; i++)
		printf(" %14s", "[s]");
	for (size_t k = 0; k < ERROR_STEPS; k++) {
		printf("\n%8" PRIu32 " %14.6f %14.6f", error_spp[k], errors[k].relative_mse, errors[k].rmse);
		for (size_t i = 0; i < count; i++)
			printf(" %14.3f", entries[i].error_seconds[k]);
	}
	putchar('\n');
}

/* --- main ------------------------------------------------------------------------------------------------------- */

static int make_light(struct light *light, const struct options *o)
{
	struct image probe;
	char message[1024];
	size_t repaired = 0;
	if (!o->probe)
		return light_studio(light, o->rotate) == 0 ? 0 : complain("light", "out of memory");
	if (image_read_exr(&probe, o->probe, message, sizeof message) != 0)
		return complain("cannot read", message);
	if (probe.width != 2 * probe.height)
		fprintf(stderr, "gallery: %s: %d x %d is not twice as wide as high; taken as lat-long all the same\n",
			o->probe, probe.width, probe.height);
	const int status = light_from_image(light, &probe, o->rotate, &repaired);
	image_free(&probe);
	if (repaired)
		fprintf(stderr, "gallery: %s: %zu texels hold no radiance (NaN, negative or infinite); repaired\n",
			o->probe, repaired);
	return status == 0 ? 0 : complain("light", "out of memory");
}

int main(int argc, char **argv)
{
	struct options o = {"all", NULL, "out", 640, 480, 10, 64, 1024, 0.0f, 0.0f};
	static struct scene scene;
	static struct entry entries[MAX_DEVICES];
	struct light light;
	struct error errors[ERROR_STEPS];
	size_t count = 0;
	int result = EXIT_FAILURE;

	const int parsed = options_parse(&o, argc, argv);
	if (parsed != 0) {
		fputs(parsed > 0 ? options_usage : "", stdout);
		return parsed > 0 ? EXIT_SUCCESS : EXIT_USAGE;
	}
	setvbuf(stdout, NULL, _IOLBF, 0); /* so that it keeps its order with stderr in a log */
	memset(&light, 0, sizeof light);
	scene_make(&scene);
	struct pool *pool = pool_create(0);
	struct trace_setup setup = {&scene, &light, pool, NULL, o.bounces, PICTURE_SEED, NULL, NULL};
	if (!pool) {
		complain("threads", "cannot be started");
		goto done;
	}
	if (make_light(&light, &o) != 0)
		goto done;
	if (make_folders(o.out) != 0) {
		complain(o.out, strerror(errno));
		goto done;
	}
	const int opened = strcmp(o.devices, "all") ? open_listed(entries, &count, o.devices, &scene)
						    : open_all(entries, &count, &scene);
	if (opened != 0) {
		result = opened < 0 ? EXIT_USAGE : EXIT_FAILURE;
		goto done;
	}
	printf("gallery: %d x %d, %" PRIu32 " samples a pixel, at most %d bounces, light: %s (%d x %d)\n", o.width,
	       o.height, o.spp, o.bounces, o.probe ? o.probe : "studio", light.width, light.height);
	if (render(entries, count, &setup, &o) != 0)
		goto done;
	print_devices(entries, count);
	const int width = o.width / ERROR_SHRINK, height = o.height / ERROR_SHRINK;
	if (o.reference > 0) {
		if (measure_errors(entries, count, &setup, &o, width, height, errors) != 0)
			goto done;
		print_errors(entries, count, &o, width, height, errors);
	}
	result = EXIT_SUCCESS;
	for (size_t i = 0; i < count; i++)
		if (entries[i].differing) {
			complain(entries[i].name, "its picture differs from the first device's");
			result = EXIT_FAILURE;
		}
done:
	for (size_t i = 0; i < count; i++)
		close_device(&entries[i]);
	light_free(&light);
	pool_destroy(pool);
	return result;
}
