/* furnaces.c - the white furnace: how much of constant light a rough surface that absorbs nothing sends back, over
 * roughness and view. What is missing scattered more than once; what is above 1 is no surface's.
 *
 * Energy is the mean weight of the lobe's own samples over a lattice of the square (Roberts 2018), with half the
 * difference of two shifted lattices as its error. Weak furnaces are asserted in tests/test_masking.c and tests/test_lobes_energy.c. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lobe/lobe.h"
#include "report.h"

enum { FURNACE_ALPHAS = 21, FURNACE_COSINES = 24, FURNACE_SURFACES = 12 };

typedef enum { METAL, GLASS } substance;

static const struct {
	const char *name;
	substance what;
	lobe_uint ndf, masking, joint;
} surfaces[FURNACE_SURFACES] = {
	{"GGX", METAL, LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT},
	{"GGX; separable", METAL, LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_JOINT_SEPARABLE},
	{"Beckmann", METAL, LOBE_NDF_BECKMANN, LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT},
	{"GGX glass 1.5", GLASS, LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT},
	{"Beckmann glass 1.5", GLASS, LOBE_NDF_BECKMANN, LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT},
	{"GGX; V-cavities", METAL, LOBE_NDF_GGX, LOBE_MASKING_VCAVITY, LOBE_JOINT_HEIGHT},
	{"GGX; Schlick-Smith k = alpha/2", METAL, LOBE_NDF_GGX, LOBE_MASKING_SCHLICK_GGX, LOBE_JOINT_HEIGHT},
	{"GGX; Disney", METAL, LOBE_NDF_GGX, LOBE_MASKING_DISNEY, LOBE_JOINT_HEIGHT},
	{"GGX; Kelemen", METAL, LOBE_NDF_GGX, LOBE_MASKING_KELEMEN, LOBE_JOINT_HEIGHT},
	{"GGX; Neumann", METAL, LOBE_NDF_GGX, LOBE_MASKING_NEUMANN, LOBE_JOINT_HEIGHT},
	{"GGX; implicit", METAL, LOBE_NDF_GGX, LOBE_MASKING_IMPLICIT, LOBE_JOINT_HEIGHT},
	{"GGX; none", METAL, LOBE_NDF_GGX, LOBE_MASKING_NONE, LOBE_JOINT_HEIGHT},
};

/* Even steps of sqrt(alpha), from .01^2 up, and of the cosine. */
static float alpha_at(size_t i)
{
	const float r = 0.01f + 0.99f * (float)i / (float)(FURNACE_ALPHAS - 1);
	return r * r;
}
static float cosine_at(size_t i) { return ((float)i + 0.5f) / (float)FURNACE_COSINES; }

static lobe_bsdf surface_of(size_t s, float alpha)
{
	lobe_microsurface m =
		lobe_microsurface_make(lobe_distribution_make(surfaces[s].ndf), lobe_linear_stretch(alpha, alpha));
	m = lobe_microsurface_masking(m, surfaces[s].masking);
	m = lobe_microsurface_joint(m, surfaces[s].joint, LOBE_ACROSS_SEPARABLE);
	if (surfaces[s].what == METAL)
		return lobe_bsdf_from_microfacet_conductor(lobe_microfacet_conductor_make(
			m, lobe_fresnel_model_constant(lobe_rgb_make(1.0f, 1.0f, 1.0f)), LOBE_STRATEGY_VISIBLE));
	if (surfaces[s].ndf == LOBE_NDF_GGX)
		return lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_transport(
			lobe_ggx_dielectric_make(alpha, alpha, 1.5f), LOBE_TRANSPORT_IMPORTANCE));
	return lobe_bsdf_from_beckmann_dielectric(lobe_beckmann_dielectric_transport(
		lobe_beckmann_dielectric_make(alpha, alpha, 1.5f), LOBE_TRANSPORT_IMPORTANCE));
}

/* Point i of a lattice shifted by that much, in the cube. */
static lobe_vec3 point(uint32_t i, float shift)
{
	const uint32_t x = i * 0xd1b54a33u, y = i * 0xabc98389u, z = i * 0x8cb92ba7u;
	const float u = (float)(x >> 8) * 0x1p-24f + shift, v = (float)(y >> 8) * 0x1p-24f + shift;
	return lobe_vec3_make(u - floorf(u), v - floorf(v), (float)(z >> 8) * 0x1p-24f);
}

static double energy(lobe_bsdf b, lobe_vec3 wo, uint32_t n, float shift)
{
	double sum = 0.0;
	for (uint32_t i = 0; i < n; i++)
		sum += (double)lobe_bsdf_sample(b, wo, point(i, shift)).weight.g;
	return sum / n;
}

static size_t units(int quick)
{
	(void)quick;
	return (size_t)FURNACE_SURFACES * FURNACE_ALPHAS;
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const size_t s = unit / FURNACE_ALPHAS;
	const float alpha = alpha_at(unit % FURNACE_ALPHAS);
	const lobe_bsdf b = surface_of(s, alpha);
	const uint32_t n = quick ? 1u << 12 : 1u << 16;
	for (size_t i = 0; i < FURNACE_COSINES; i++) {
		const float c = cosine_at(i);
		const lobe_vec3 wo = lobe_vec3_make(sqrtf(1.0f - c * c), 0.0f, c);
		const double x = energy(b, wo, n, 0.0f), y = energy(b, wo, n, 0.5f);
		report_row(rows, "%zu,%s,%.6g,%.6g,%.6g,%.2g", s, surfaces[s].name, (double)alpha, (double)c,
			   0.5 * (x + y), 0.5 * fabs(x - y));
	}
	return 0;
}

static const report_study furnaces_white = {
	"furnaces_white", "surface,name,alpha,cos,energy,error", 0, units, run, NULL};

/* --- the section -------------------------------------------------------------------------------------------------- */

typedef struct {
	double lost, worst, worst_cos, most, error; /* lost: averaged over the hemisphere, by the cosine */
} summary;

static summary summary_of(const report_table *t, size_t s, size_t a)
{
	summary r = {0.0, 2.0, 0.0, 0.0, 0.0};
	double kept = 0.0, weight = 0.0;
	for (size_t i = 0; i < FURNACE_COSINES; i++) {
		const size_t row = (s * FURNACE_ALPHAS + a) * FURNACE_COSINES + i;
		const double e = report_number(t, row, "energy"), c = report_number(t, row, "cos");
		kept += c * e;
		weight += c;
		if (e < r.worst) {
			r.worst = e;
			r.worst_cos = c;
		}
		r.most = fmax(r.most, e);
		r.error = fmax(r.error, report_number(t, row, "error"));
	}
	r.lost = 1.0 - kept / weight;
	return r;
}

static void write(report_page *page, const report_table *const *tables, int quick)
{
	/* r = .01, .505, .7525 and 1 of alpha_at. */
	static const size_t shown[] = {0, 10, 15, 20};
	const report_table *t = tables[0];
	double error = 0.0;
	(void)quick;
	report_text(page, "Energy that a white surface sends back in constant light; single scattering. Lost: 1 less "
			  "its mean over the "
			  "hemisphere, weighted by the cosine. Least, and at which cosine; most.\n\n| surface |");
	for (size_t k = 0; k < sizeof shown / sizeof *shown; k++)
		report_text(page, " alpha %.3g: lost | least (cos) | most |", (double)alpha_at(shown[k]));
	report_text(page, "\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
	for (size_t s = 0; s < FURNACE_SURFACES; s++) {
		report_text(page, "| %s |", surfaces[s].name);
		for (size_t k = 0; k < sizeof shown / sizeof *shown; k++) {
			const summary r = summary_of(t, s, shown[k]);
			report_text(page, " %.4f | %.3f (%.2f) | %.3f |", r.lost, r.worst, r.worst_cos, r.most);
		}
		report_text(page, "\n");
	}
	/* What the comparison without masking is off by is its own matter: it grows without bound. */
	for (size_t s = 0; s + 1 < FURNACE_SURFACES; s++)
		for (size_t a = 0; a < FURNACE_ALPHAS; a++)
			error = fmax(error, summary_of(t, s, a).error);
	report_text(page, "\nThe lattice's own error is at most %.1g (without that of no masking at all).\n", error);
	report_gnuplot(page, "furnaces.gp", NULL);
	report_figure(page, "furnaces_white.png",
		      "Energy kept over roughness and view: 1 is a closed furnace; below it light is lost, "
		      "above it made.");
	const summary ggx = summary_of(t, 0, FURNACE_ALPHAS - 1), half = summary_of(t, 0, 15),
		      separable = summary_of(t, 1, FURNACE_ALPHAS - 1), beckmann = summary_of(t, 2, FURNACE_ALPHAS - 1),
		      glass = summary_of(t, 3, FURNACE_ALPHAS - 1);
	report_finding(page,
		       "Single scattering loses %.1f %% of a white GGX metal's light at alpha 1 and %.1f %% at %.2g "
		       "(separable masking "
		       "%.1f %% at alpha 1, Beckmann %.1f %%, GGX glass %.1f %%)",
		       100.0 * ggx.lost, 100.0 * half.lost, (double)alpha_at(15), 100.0 * separable.lost,
		       100.0 * beckmann.lost, 100.0 * glass.lost);
}

const report_section furnaces_section = {"furnaces", "Furnaces: the energy that is kept", {&furnaces_white}, write};
