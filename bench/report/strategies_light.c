/* strategies_light.c - lights from a pinprick sun to a dome, analytic with their own sampling, and real probes.
 *
 * Analytic lights are sums of parts of which each is drawn exactly in proportion to its radiance. The sun is a disk of
 * .265 degrees, which is what it measures from here. Directions in a cone are told by the chord to its axis, which
 * keeps its digits where the cosine has lost them. */
#define _POSIX_C_SOURCE 200809L
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pi.h"
#include "strategies.h"

static struct light probes[STRATEGIES_PROBES];
static char probe_names[STRATEGIES_PROBES][48];
static double probe_solid_angle[STRATEGIES_PROBES];
static lobe_light_shape probe_shape[STRATEGIES_PROBES];
static size_t probe_count;
static char said[1024], settings[1024];
static int loaded;

/* --- analytic ----------------------------------------------------------------------------------------------------- */

typedef struct {
	const char *name;
	int parts;
	strategies_part part[STRATEGIES_PARTS];
} recipe;

#define CONE(place, share, degrees)                                                                                    \
	{                                                                                                              \
		STRATEGIES_CONE, place, share, degrees, 0.0f,                                                          \
		{                                                                                                      \
			{0, 0, 0}, {0, 0, 0}, { 0, 0, 0 }                                                              \
		}                                                                                                      \
	}
#define SKY(share, a, b)                                                                                               \
	{                                                                                                              \
		STRATEGIES_SKY, STRATEGIES_FIXED, share, a, b,                                                         \
		{                                                                                                      \
			{0, 0, 0}, {0, 0, 0}, { 0, 0, 0 }                                                              \
		}                                                                                                      \
	}
#define GLOW(place, power)                                                                                             \
	{                                                                                                              \
		STRATEGIES_GLOW, place, 1.0f, power, 0.0f,                                                             \
		{                                                                                                      \
			{0, 0, 0}, {0, 0, 0}, { 0, 0, 0 }                                                              \
		}                                                                                                      \
	}
#define NO_PART SKY(0.0f, 1.0f, 0.0f)

/* Of a CONE a is the radius in degrees here. The last but three is what most pictures are lit by: a sun that sends four
 * times as much as the sky, which is three times as bright at the horizon as overhead. */
static const recipe recipes[] = {
	{"sun in the highlight", 1, {CONE(STRATEGIES_HIGHLIGHT, 1.0f, 0.265f), NO_PART}},
	{"sun aside", 1, {CONE(STRATEGIES_ASIDE, 1.0f, 0.265f), NO_PART}},
	{"disk of 5 deg in the highlight", 1, {CONE(STRATEGIES_HIGHLIGHT, 1.0f, 5.0f), NO_PART}},
	{"disk of 5 deg aside", 1, {CONE(STRATEGIES_ASIDE, 1.0f, 5.0f), NO_PART}},
	{"disk of 20 deg in the highlight", 1, {CONE(STRATEGIES_HIGHLIGHT, 1.0f, 20.0f), NO_PART}},
	{"disk of 20 deg aside", 1, {CONE(STRATEGIES_ASIDE, 1.0f, 20.0f), NO_PART}},
	{"clear sky with sun", 2, {CONE(STRATEGIES_ASIDE, 0.8f, 0.265f), SKY(0.2f, 3.0f, -2.0f)}},
	{"hazy glow", 1, {GLOW(STRATEGIES_ASIDE, 15.0f), NO_PART}},
	{"gradient sky", 1, {SKY(1.0f, 3.0f, -2.0f), NO_PART}},
	{"CIE overcast sky", 1, {SKY(1.0f, 1.0f, 2.0f), NO_PART}},
	{"constant dome", 1, {SKY(1.0f, 1.0f, 0.0f), NO_PART}},
};
enum { ANALYTIC = sizeof recipes / sizeof *recipes };

/* Integral of the squared density: 1 over the solid angle of a part alone. */
static double concentration(const strategies_part *p)
{
	const double a = (double)p->a, b = (double)p->b;
	if (p->kind == STRATEGIES_CONE)
		return 1.0 / (2.0 * PI * a);
	if (p->kind == STRATEGIES_GLOW)
		return (a + 1.0) * (a + 1.0) / (4.0 * PI * (2.0 * a + 1.0));
	return (a * a + a * b + b * b / 3.0) / (2.0 * PI * (a + 0.5 * b) * (a + 0.5 * b));
}

static float part_pdf(const strategies_part *p, lobe_vec3 w)
{
	const lobe_vec3 n = p->frame.n;
	if (p->kind == STRATEGIES_CONE) {
		const lobe_vec3 chord = lobe_vec3_fma(-1.0f, n, w);
		return lobe_dot(chord, chord) <= 2.0f * p->a ? lobe_spherical_cap_pdf(p->a) : 0.0f;
	}
	if (p->kind == STRATEGIES_GLOW) {
		const lobe_vec3 chord = lobe_vec3_add(w, n);
		return (p->a + 1.0f) / (2.0f * LOBE_2PI) * lobe_pow(0.25f * lobe_dot(chord, chord), p->a);
	}
	return w.z > 0.0f ? lobe_fma(p->b, w.z, p->a) / (LOBE_2PI * (p->a + 0.5f * p->b)) : 0.0f;
}

static lobe_vec3 part_draw(const strategies_part *p, float u1, float u2)
{
	float z = 0.0f;
	if (p->kind == STRATEGIES_CONE)
		return lobe_frame_to_world(p->frame, lobe_spherical_cap(lobe_vec2_make(u1, u2), p->a));
	if (p->kind == STRATEGIES_GLOW) {
		z = 2.0f * lobe_pow(1.0f - u2, 1.0f / (p->a + 1.0f)) - 1.0f;
	} else {
		/* a z + b z^2/2 = c */
		const float c = u2 * (p->a + 0.5f * p->b);
		z = 2.0f * c / (p->a + lobe_sqrt(lobe_fma(p->a, p->a, 2.0f * p->b * c)));
	}
	const float r = lobe_sqrt(lobe_max(0.0f, (1.0f - z) * (1.0f + z)));
	const lobe_sincos sc = lobe_sincos_2pi(u1);
	const lobe_vec3 w = lobe_vec3_make(r * sc.c, r * sc.s, z);
	return p->kind == STRATEGIES_GLOW ? lobe_frame_to_world(p->frame, w) : w;
}

static float parts_pdf(const strategies_light *light, lobe_vec3 w)
{
	float pdf = 0.0f;
	for (int i = 0; i < light->parts; i++)
		pdf += light->part[i].share * part_pdf(&light->part[i], w);
	return pdf;
}

/* --- probes ------------------------------------------------------------------------------------------------------- */

static uint32_t checksum(const struct image *image)
{
	uint32_t h = 2166136261u;
	const unsigned char *bytes = (const unsigned char *)image->rgb;
	const size_t n = (size_t)image->width * (size_t)image->height * 3 * sizeof *image->rgb;
	for (size_t i = 0; i < n; i++)
		h = (h ^ bytes[i]) * 16777619u;
	return h;
}

static void add_probe(const char *path)
{
	char message[256];
	struct image image;
	size_t repaired;
	const char *slash = strrchr(path, '/');
	if (image_read_exr(&image, path, message, sizeof message) != 0) {
		fprintf(stderr, "report: probe left out: %s\n", message);
		return;
	}
	struct light *light = &probes[probe_count];
	if (light_from_image(light, &image, 0.0f, &repaired) == 0) {
		double sum = 0.0, squares = 0.0;
		const size_t w = (size_t)light->width, h = (size_t)light->height;
		for (size_t y = 0; y < h; y++)
			for (size_t x = 0; x < w; x++) {
				const double l = (double)strategies_luminance(light->texel[y * w + x].radiance);
				const double area =
					2.0 * PI / (double)w * (double)(light->cos_theta[y] - light->cos_theta[y + 1]);
				sum += l * area;
				squares += l * l * area;
			}
		if (sum > 0.0) {
			probe_solid_angle[probe_count] = sum * sum / squares;
			probe_shape[probe_count] = strategies_fit(light);
			snprintf(probe_names[probe_count], sizeof *probe_names, "%s", slash ? slash + 1 : path);
			snprintf(settings + strlen(settings), sizeof settings - strlen(settings), "%s %08x;",
				 probe_names[probe_count], checksum(&image));
			probe_count++;
		} else {
			light_free(light);
		}
	}
	image_free(&image);
}

/* The files of a list of files and folders, or of patterns. */
static void find_probes(const char *list, glob_t *found)
{
	char pattern[512];
	int flags = 0;
	while (*list) {
		const size_t n = strcspn(list, ":");
		const char *exr = n > 4 && strncmp(list + n - 4, ".exr", 4) == 0 ? "" : "/*.exr";
		snprintf(pattern, sizeof pattern, "%.*s%s", (int)n, list, exr);
		if (n && glob(pattern, flags, NULL, found) == 0)
			flags = GLOB_APPEND;
		list += n + (list[n] == ':');
	}
	if (!flags)
		found->gl_pathc = 0;
}

static void load(int quick)
{
	static const char usual[] = "build/probes"; /* deps.sh probes */
	const char *given = getenv("LOBE_REPORT_PROBES");
	const size_t most = quick ? 2 : STRATEGIES_PROBES;
	glob_t found;
	memset(&found, 0, sizeof found);
	find_probes(given ? given : usual, &found);
	if (!given && !found.gl_pathc)
		find_probes("/usr/share/blender/datafiles/studiolights/world", &found);
	/* Spread over the list where it is longer. */
	const size_t n = found.gl_pathc < most ? found.gl_pathc : most;
	for (size_t i = 0; i < n; i++)
		add_probe(found.gl_pathv[n > 1 ? i * (found.gl_pathc - 1) / (n - 1) : 0]);
	if (probe_count) {
		snprintf(said, sizeof said, "Real probes%s:", given ? "" : " (of Debian's blender-data, CC0)");
		for (size_t i = 0; i < probe_count; i++)
			snprintf(said + strlen(said), sizeof said - strlen(said), "%s %s (%d x %d)", i ? "," : "",
				 probe_names[i], probes[i].width, probes[i].height);
		snprintf(said + strlen(said), sizeof said - strlen(said), ".");
	} else {
		snprintf(said, sizeof said,
			 "Real probes are left out: there is no EXR in %s. `make probes` fetches eight; "
			 "`LOBE_REPORT_PROBES` takes other files or folders, separated by `:`.",
			 given ? "LOBE_REPORT_PROBES" : "`build/probes`");
	}
	if (found.gl_pathv)
		globfree(&found);
	loaded = 1;
}

size_t strategies_lights(int quick)
{
	if (!loaded)
		load(quick);
	return ANALYTIC + probe_count;
}

size_t strategies_analytic_lights(void) { return ANALYTIC; }

/* Beckmann's: a disk, the sky with sun, the overcast one, and the first probe. */
static const size_t few[] = {2, 6, 9, ANALYTIC};

size_t strategies_lights_of(int quick, int material)
{
	const size_t all = strategies_lights(quick);
	return material != STRATEGIES_BECKMANN ? all : all > ANALYTIC ? 4 : 3;
}

size_t strategies_light_of(int quick, int material, size_t i)
{
	(void)quick;
	return material != STRATEGIES_BECKMANN ? i : few[i];
}

const char *strategies_probes_said(void) { return said; }

const char *strategies_settings(int quick)
{
	strategies_lights(quick);
	return settings;
}

/* --- either ------------------------------------------------------------------------------------------------------- */

strategies_light strategies_light_at(size_t index, lobe_vec3 wo)
{
	strategies_light light;
	memset(&light, 0, sizeof light);
	if (index >= ANALYTIC) {
		const size_t i = index - ANALYTIC;
		snprintf(light.name, sizeof light.name, "%s", probe_names[i]);
		light.probe = &probes[i];
		light.solid_angle = probe_solid_angle[i];
		light.shape = probe_shape[i];
		return light;
	}
	const recipe *r = &recipes[index];
	const double turn = atan2((double)wo.y, (double)wo.x) + 75.0 / 180.0 * PI, down = 50.0 / 180.0 * PI;
	double squares = 0.0;
	snprintf(light.name, sizeof light.name, "%s", r->name);
	light.parts = r->parts;
	for (int i = 0; i < r->parts; i++) {
		strategies_part *p = &light.part[i];
		*p = r->part[i];
		if (p->kind == STRATEGIES_CONE) {
			const double half = sin(0.5 * (double)p->a / 180.0 * PI);
			p->a = (float)(2.0 * half * half);
		}
		p->frame = lobe_frame_from_normal(p->place == STRATEGIES_HIGHLIGHT
							  ? lobe_vec3_make(-wo.x, -wo.y, wo.z)
							  : lobe_vec3_make((float)(sin(down) * cos(turn)),
									   (float)(sin(down) * sin(turn)),
									   (float)cos(down)));
		/* The sun's share alone squares to something. */
		squares += (double)p->share * (double)p->share * concentration(p);
	}
	light.solid_angle = 1.0 / squares;
	return light;
}

lobe_rgb strategies_radiance(const strategies_light *light, lobe_vec3 wi, float *pdf)
{
	const lobe_vec3 w = light->turned ? lobe_frame_to_world(light->frame, wi) : wi;
	if (light->probe)
		return light_radiance(light->probe, w, pdf);
	*pdf = parts_pdf(light, w);
	return lobe_rgb_make(*pdf, *pdf, *pdf);
}

static struct light_sample draw(const strategies_light *light, float u1, float u2)
{
	struct light_sample s;
	const float first = light->part[0].share;
	const int second = light->parts > 1 && u2 >= first;
	const float v = light->parts == 1 ? u2 : second ? (u2 - first) / (1.0f - first) : u2 / first;
	s.wi = part_draw(&light->part[second], u1, lobe_min(v, 0x1.fffffep-1f));
	s.pdf = parts_pdf(light, s.wi);
	/* A rounding may take what was drawn at a disk's rim out of it. */
	if (light->part[second].kind == STRATEGIES_CONE && !(s.pdf > light->part[second].share))
		s.pdf = first * lobe_spherical_cap_pdf(light->part[0].a);
	s.radiance = lobe_rgb_make(s.pdf, s.pdf, s.pdf);
	return s;
}

struct light_sample strategies_draw(const strategies_light *light, float u1, float u2)
{
	struct light_sample s = light->probe ? light_draw(light->probe, u1, u2) : draw(light, u1, u2);
	if (light->turned)
		s.wi = lobe_frame_to_local(light->frame, s.wi);
	return s;
}
