/* masking.c - masking functions side by side: G1, Smith against V-cavities at grazing view, albedo. */
#include <math.h>
#include <stdio.h>

#include "figures.h"

#define RADIANS(degrees) ((degrees) * 0.017453292519943295)

static const struct {
	const char *name;
	lobe_uint masking, joint;
} models[] = {
	{"Smith: height-correlated", LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT},
	{"Smith: separable", LOBE_MASKING_SMITH, LOBE_JOINT_SEPARABLE},
	{"Smith: direction-correlated", LOBE_MASKING_SMITH, LOBE_JOINT_DIRECTION},
	{"Smith: height-direction", LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT_DIRECTION},
	{"V-cavity", LOBE_MASKING_VCAVITY, 0},
	{"Schlick-Smith: k = alpha sqrt(2/pi)", LOBE_MASKING_SCHLICK_SMITH, 0},
	{"Schlick-Smith: k = alpha/2", LOBE_MASKING_SCHLICK_GGX, 0},
	{"Schlick-Smith: k = (r+1)^2/8", LOBE_MASKING_SCHLICK_GGX_LIGHTS, 0},
	{"Disney", LOBE_MASKING_DISNEY, 0},
	{"Kelemen", LOBE_MASKING_KELEMEN, 0},
	{"Neumann", LOBE_MASKING_NEUMANN, 0},
	{"implicit", LOBE_MASKING_IMPLICIT, 0},
	{"none", LOBE_MASKING_NONE, 0},
};
enum { MODELS = sizeof models / sizeof *models };

static void header(FILE *f, const char *x)
{
	fputs(x, f);
	for (int k = 0; k < MODELS; k++)
		fprintf(f, ",%s", models[k].name);
	fputc('\n', f);
}

static lobe_microsurface model(int k, int surface, double alpha)
{
	return lobe_microsurface_joint(lobe_microsurface_masking(figure_surface(surface, alpha), models[k].masking),
				       models[k].joint, LOBE_ACROSS_SEPARABLE);
}

/* Reflection from o by the facet h of the surface of width 1: the direction, and f cos/(F pdf) = sigma(o) G2/z_o. */
static double bounce(lobe_microsurface s, lobe_vec3 wo, lobe_vec3 h, lobe_vec3 *wi)
{
	const lobe_seen o = lobe_see(s, wo, 1.0f);
	const lobe_vec3 m = lobe_normalize(lobe_linear_normal(s.map, h));
	const float facing = lobe_dot(wo, m);
	const lobe_seen_facet f = {facing, facing, m.z, 1.0f};
	*wi = lobe_reflect(wo, m, facing);
	if (!(wi->z > 0.0f))
		return 0.0;
	return (double)(o.sigma * lobe_masking_g2_over_cos(s, o, lobe_see(s, *wi, 1.0f), f, 0));
}

/* Albedo at F = 1, over a Fibonacci lattice of visible normals. */
static double albedo(lobe_microsurface s, lobe_vec3 wo)
{
	enum { POINTS = 2584, STEP = 1597 };
	double sum = 0.0;
	for (unsigned i = 0; i < POINTS; i++) {
		const lobe_vec2 u = lobe_vec2_make(((float)i + 0.5f) / POINTS,
						   ((float)((unsigned long)i * STEP % POINTS) + 0.5f) / POINTS);
		lobe_vec3 wi;
		sum += bounce(s, wo, lobe_distribution_visible(s.distribution, lobe_linear_direction(s.map, wo), u), &wi);
	}
	return sum / POINTS;
}

static void albedo_curves(const char *name, double alpha)
{
	FILE *f = figure_open(name);
	header(f, "theta [degrees]");
	for (int i = 0; i <= 89; i++) {
		const double theta = i;
		fprintf(f, "%g", theta);
		for (int k = 0; k < MODELS; k++)
			fprintf(f, ",%.6g", albedo(model(k, FIGURE_GGX, alpha), figure_direction(RADIANS(theta))));
		fputc('\n', f);
	}
	fclose(f);
}

/* f cos theta_i in the plane of incidence at theta_o = 1.5, the grazing view at which Heitz 2014 compares the two. */
static void smith_vcavity(void)
{
	static const double alphas[] = {0.1, 0.3, 0.6};
	const lobe_vec3 wo = figure_direction(1.5);
	FILE *f = figure_open("smith_vcavity");
	fputs("theta_i [degrees]", f);
	for (int k = 0; k < 3; k++)
		fprintf(f, ",Smith %g,V-cavity %g", alphas[k], alphas[k]);
	fputc('\n', f);
	for (int i = -356; i <= 356; i++) {
		const lobe_vec3 wi = figure_direction(RADIANS(i * 0.25));
		const lobe_vec3 half = lobe_normalize(lobe_vec3_add(wo, wi));
		fprintf(f, "%g", -i * 0.25); /* forward scattering to the right */
		for (int k = 0; k < 3; k++) {
			for (int v = 0; v < 2; v++) {
				const lobe_microsurface s =
					lobe_microsurface_masking(figure_surface(FIGURE_BECKMANN, alphas[k]),
								  v ? LOBE_MASKING_VCAVITY : LOBE_MASKING_SMITH);
				const float facing = lobe_dot(wo, half);
				const lobe_seen_facet h = {facing, facing, half.z, 1.0f};
				const float g = lobe_masking_g2_over_cos(s, lobe_see(s, wo, 1.0f), lobe_see(s, wi, 1.0f), h, 0);
				fprintf(f, ",%.7g", 0.25 * figure_d(s, half) * (double)g);
			}
		}
		fputc('\n', f);
	}
	fclose(f);
}

/* G1 as the square root of G2(w, w), for those that are a product of two; the exact ones beside them. */
static void g1_approximations(void)
{
	static const int shown[] = {1, 5, 6, 7, 8, 11};
	const double alpha = 0.5;
	const lobe_seen_facet facet = {1.0f, 1.0f, 1.0f, 1.0f}; /* which Smith's masking does not ask for */
	FILE *f = figure_open("masking_functions");
	fputs("theta [degrees]", f);
	for (size_t k = 0; k < sizeof shown / sizeof *shown; k++)
		fprintf(f, ",%s", models[shown[k]].name);
	fputs(",Beckmann,Beckmann by Walter's rational Lambda\n", f);
	for (int i = 0; i < 360; i++) {
		const lobe_vec3 w = figure_direction(RADIANS(i * 0.25));
		fprintf(f, "%g", i * 0.25);
		for (size_t k = 0; k < sizeof shown / sizeof *shown; k++) {
			const lobe_microsurface s = model(shown[k], FIGURE_GGX, alpha);
			const lobe_seen d = lobe_see(s, w, 1.0f);
			const float g = lobe_masking_g2_over_cos(s, d, d, facet, 0);
			fprintf(f, ",%.7g", sqrt((double)(g * d.z)));
		}
		for (int rational = 0; rational < 2; rational++) {
			const lobe_microsurface s = lobe_microsurface_joint(
				lobe_microsurface_masking(figure_surface(FIGURE_BECKMANN, alpha),
							  rational ? LOBE_MASKING_SMITH_RATIONAL : LOBE_MASKING_SMITH),
				LOBE_JOINT_SEPARABLE, LOBE_ACROSS_SEPARABLE);
			const lobe_seen d = lobe_see(s, w, 1.0f);
			const float g = lobe_masking_g2_over_cos(s, d, d, facet, 0);
			fprintf(f, ",%.7g", sqrt((double)(g * d.z)));
		}
		fputc('\n', f);
	}
	fclose(f);
}

void figures_of_masking(void)
{
	g1_approximations();
	smith_vcavity();
	albedo_curves("albedo_02", 0.02);
	albedo_curves("albedo_50", 0.5);
}
