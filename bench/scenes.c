/* scenes.c - representative materials, verbs and devices. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../examples/common/processors.h"
#include "scenes.h"

/* --- lobes -------------------------------------------------------------------------------------------------------- */

/* A material of each lobe, material_<lobe>: all that its features cost, anisotropy above all. The table below names one
 * for each line of lobes.def, so a lobe without one does not compile. */

static lobe_bsdf material_lambert(void)
{
	return lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(0.8f, 0.5f, 0.2f)));
}

static lobe_bsdf material_ggx_conductor(void)
{
	return lobe_bsdf_from_ggx_conductor(
		lobe_ggx_conductor_make(0.3f, 0.2f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
}

static lobe_bsdf material_ggx_dielectric(void)
{
	return lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.3f, 0.2f, 1.5f));
}

static lobe_bsdf material_beckmann_conductor(void)
{
	return lobe_bsdf_from_beckmann_conductor(lobe_beckmann_conductor_make(
		0.3f, 0.2f, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
}

static lobe_bsdf material_beckmann_dielectric(void)
{
	return lobe_bsdf_from_beckmann_dielectric(lobe_beckmann_dielectric_make(0.3f, 0.2f, 1.5f));
}

static lobe_bsdf material_ggx_schlick(void)
{
	return lobe_bsdf_from_ggx_schlick(
		lobe_ggx_schlick_make(0.3f, 0.2f, lobe_rgb_make(0.9f, 0.6f, 0.3f), lobe_rgb_make(1.0f, 1.0f, 1.0f)));
}

static lobe_bsdf material_mirror(void)
{
	return lobe_bsdf_from_mirror(lobe_mirror_make(lobe_rgb_make(0.8f, 0.85f, 0.9f)));
}

static lobe_bsdf material_smooth_conductor(void)
{
	return lobe_bsdf_from_smooth_conductor(
		lobe_smooth_conductor_make(lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
}

static lobe_bsdf material_smooth_dielectric(void)
{
	return lobe_bsdf_from_smooth_dielectric(lobe_smooth_dielectric_make(1.5f));
}

static lobe_bsdf material_thin_dielectric(void)
{
	return lobe_bsdf_from_thin_dielectric(lobe_thin_dielectric_make(1.5f));
}

static lobe_bsdf material_iridescent_conductor(void)
{
	return lobe_bsdf_from_iridescent_conductor(lobe_iridescent_conductor_make(
		0.3f, 0.2f, 400.0f, 1.8f, lobe_metal_eta(LOBE_METAL_IRON), lobe_metal_k(LOBE_METAL_IRON)));
}

static lobe_bsdf material_iridescent_dielectric(void)
{
	return lobe_bsdf_from_iridescent_dielectric(lobe_iridescent_dielectric_make(0.3f, 0.2f, 400.0f, 1.38f, 1.5f));
}

/* What ggx_conductor and ggx_dielectric do, chosen at run time. */
static lobe_microsurface microsurface(void)
{
	return lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_GGX),
				      lobe_linear_make(0.3f, 0.0f, 0.0f, 0.2f, 0.0f, 0.0f));
}

static lobe_bsdf material_microfacet_conductor(void)
{
	const lobe_fresnel_model gold =
		lobe_fresnel_model_conductor(lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD));
	return lobe_bsdf_from_microfacet_conductor(
		lobe_microfacet_conductor_make(microsurface(), gold, LOBE_STRATEGY_VISIBLE));
}

static lobe_bsdf material_microfacet_dielectric(void)
{
	return lobe_bsdf_from_microfacet_dielectric(lobe_microfacet_dielectric_make(
		microsurface(), lobe_fresnel_model_dielectric(), 1.5f, LOBE_STRATEGY_VISIBLE));
}

static lobe_bsdf material_microfacet_diffuse(void)
{
	return lobe_bsdf_from_microfacet_diffuse(
		lobe_microfacet_diffuse_make(microsurface(), lobe_rgb_make(0.8f, 0.5f, 0.2f)));
}

static lobe_bsdf material_choosing_otherwise(void)
{
	const lobe_linear map = lobe_linear_make(0.3f, 0.0f, 0.0f, 0.2f, 0.0f, 0.0f);
	lobe_microsurface s = lobe_microsurface_make(lobe_distribution_make(LOBE_NDF_BECKMANN), map);
	s = lobe_microsurface_joint(lobe_microsurface_masking(s, LOBE_MASKING_VCAVITY), LOBE_JOINT_SEPARABLE,
				    LOBE_ACROSS_BETA);
	return lobe_bsdf_from_microfacet_conductor(lobe_microfacet_conductor_make(
		s, lobe_fresnel_model_constant(lobe_rgb_make(0.8f, 0.5f, 0.2f)), LOBE_STRATEGY_BOUNDED_CAP));
}

static const struct {
	const char *name;
	lobe_bsdf (*material)(void);
} lobes[BENCH_LOBES] = {
#define LOBE_X(NAME, name, kind) {#name, material_##name},
#include "lobe/lobes/lobes.def"
#undef LOBE_X
};

const char *bench_lobe_name(int lobe)
{
	return lobe < BENCH_LOBES         ? lobes[lobe].name
	       : lobe == BENCH_OPEN       ? "open choices"
	       : lobe == BENCH_OPEN_GLASS ? "open glass"
					  : "all";
}

lobe_bsdf bench_lobe_material(int lobe) { return lobes[lobe].material(); }

lobe_status bench_scene_create(lobe_scene **out, lobe_device *device, int lobe)
{
	lobe_bsdf material[BENCH_LOBES];
	if (lobe == BENCH_OPEN_GLASS) {
		static const float eta[] = {1.0f, 2.5f};
		material[0] = bench_lobe_material(BENCH_LOBE_GGX_DIELECTRIC);
		for (int i = 0; i < 2; i++)
			material[1 + i] = lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.3f, 0.2f, eta[i]));
		return lobe_scene_create(out, device, material, 3);
	}
	if (lobe == BENCH_OPEN) {
		material[0] = bench_lobe_material(BENCH_LOBE_MICROFACET_CONDUCTOR);
		material[1] = material_choosing_otherwise();
		return lobe_scene_create(out, device, material, 2);
	}
	const int first = lobe < BENCH_LOBES ? lobe : 0;
	const int count = lobe < BENCH_LOBES ? 1 : BENCH_LOBES;
	for (int i = 0; i < count; i++)
		material[i] = bench_lobe_material(first + i);
	return lobe_scene_create(out, device, material, (size_t)count);
}

/* --- verbs -------------------------------------------------------------------------------------------------------- */

const char *bench_verb_name(int verb)
{
	static const char *const names[BENCH_VERBS] = {"eval", "pdf", "eval+pdf", "sample", "sample_wi"};
	return names[verb];
}

int bench_verb_samples(int verb) { return verb >= BENCH_SAMPLE; }

/* --- devices ------------------------------------------------------------------------------------------------------ */

int bench_is_opencl(const bench_device *device) { return strncmp(device->label, "opencl", 6) == 0; }

static int open_one(bench_device *d, const char *label)
{
	const char *const number = strncmp(label, "native:", 7) == 0 ? label + 7 : NULL;
	if (lobe_device_open(&d->device, label) != LOBE_OK)
		return 0;
	snprintf(d->label, sizeof d->label, "%s", label);
	d->threads = number ? (size_t)strtoul(number, NULL, 10) : processor_count();
	printf("device     %-10s %s\n", label, lobe_device_name(d->device));
	return 1;
}

static int open_or_skip(bench_device *d, const char *label)
{
	const int opened = open_one(d, label);
	if (!opened)
		printf("device     %-10s skipped: %s\n", label, lobe_error_message());
	return opened;
}

int bench_devices_open(bench_device *devices, const char *only)
{
	int count = 0;
	size_t opencl = 0;
	/* Without it PoCL's threads wander, and often share a processor for as long as a batch takes. */
	if (setenv("POCL_AFFINITY", "1", 0) == 0)
		printf("setting    POCL_AFFINITY=%s, where PoCL is the OpenCL: each of its threads stays on a "
		       "processor\n",
		       getenv("POCL_AFFINITY"));
	if (only) {
		count = open_one(&devices[0], only);
		if (count == 0)
			fprintf(stderr, "throughput: %s: %s\n", only, lobe_error_message());
		return count;
	}
	count += open_or_skip(&devices[count], "native:1");
	if (processor_count() > 1)
		count += open_or_skip(&devices[count], "native");
	/* Where there is none, the first says why. */
	if (lobe_device_count("opencl", &opencl) != LOBE_OK || opencl == 0)
		opencl = 1;
	for (size_t i = 0; i < opencl && count < BENCH_DEVICES_MAX; i++) {
		char label[32];
		snprintf(label, sizeof label, "opencl:%zu", i);
		count += open_or_skip(&devices[count], label);
	}
	return count;
}

void bench_devices_close(bench_device *devices, int count)
{
	for (int i = 0; i < count; i++)
		lobe_device_close(devices[i].device);
}
