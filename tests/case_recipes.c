#include "case_recipes.h"

#include <string.h>

#define THIRD      (1.0 / 3.0)
#define RADIANCE   LOBE_TRANSPORT_RADIANCE
#define IMPORTANCE LOBE_TRANSPORT_IMPORTANCE

static const recipe lambert_recipes[] = {
	{"lambert grey", {0.5, 0.5, 0.5}},
	{"lambert white", {1, 1, 1}},
	{"lambert ochre", {0.8, 0.4, 0.1}},
	{"lambert black", {0, 0, 0}},
};

#define LOBE_GLASS(NAME, name, n)
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb) NAME##_INDEX,
enum {
#include "lobe/core/optics.def"
	METALS
};
#undef LOBE_METAL
#define LOBE_METAL(NAME, name, nr, ng, nb, kr, kg, kb) {nr, ng, nb, kr, kg, kb},
static const double metals[METALS][6] = {
#include "lobe/core/optics.def"
};
#undef LOBE_METAL
#undef LOBE_GLASS

/* The index n + ik is written out, or taken from optics.def where n.r holds -1 - the metal's place there. */
#define METAL(NAME) -1.0 - NAME##_INDEX
#define GREY(n, k)  n, n, n, k, k, k

static const recipe ggx_conductor_recipes[] = {
	{"gold .0001", {1e-4, 1e-4, METAL(GOLD)}},
	{"silver .001", {1e-3, 1e-3, METAL(SILVER)}},
	{"copper .01", {0.01, 0.01, METAL(COPPER)}},
	{"aluminium .1", {0.1, 0.1, METAL(ALUMINIUM)}},
	{"gold .25", {0.25, 0.25, METAL(GOLD)}},
	{"chromium .5", {0.5, 0.5, METAL(CHROMIUM)}},
	{"tungsten 1", {1, 1, METAL(TUNGSTEN)}},
	{"copper .05:.4", {0.05, 0.4, METAL(COPPER)}},
	{"titanium .5:.1", {0.5, 0.1, METAL(TITANIUM)}},
	{"platinum .0001:.1", {1e-4, 0.1, METAL(PLATINUM)}},
	{"iron .0001:1", {1e-4, 1, METAL(IRON)}},
	{"nickel 1:.0001", {1, 1e-4, METAL(NICKEL)}},
	{"mirror .1", {0.1, 0.1, GREY(1e-3, 1000)}},
	{"mirror .5", {0.5, 0.5, GREY(1e-3, 1000)}},
	{"mirror 1", {1, 1, GREY(1e-3, 1000)}},
	{"index 1.5 front .3", {0.3, 0.3, GREY(1.5, 0)}},
	{"index 1000 front .3", {0.3, 0.3, GREY(1000, 0)}},
	{"index 1000+1000i .3", {0.3, 0.3, GREY(1000, 1000)}},
};

static const recipe ggx_dielectric_recipes[] = {
	{"glass .1", {0.1, 0.1, 1.5, RADIANCE}},
	{"glass .3 importance", {0.3, 0.3, 1.5, IMPORTANCE}},
	{"glass .5", {0.5, 0.5, 1.5, RADIANCE}},
	{"glass 1", {1, 1, 1.5, RADIANCE}},
	{"bubble .2", {0.2, 0.2, 1 / 1.5, RADIANCE}},
	{"bubble .3 importance", {0.3, 0.3, 1 / 1.5, IMPORTANCE}},
	{"eta 1/3 .3", {0.3, 0.3, THIRD, RADIANCE}},
	{"eta 1/3 1 importance", {1, 1, THIRD, IMPORTANCE}},
	{"glass .05:.4 importance", {0.05, 0.4, 1.5, IMPORTANCE}},
	{"water .4:.05", {0.4, 0.05, 1.3334, RADIANCE}},
	{"glass .0001", {1e-4, 1e-4, 1.5, RADIANCE}},
	{"glass .001 importance", {1e-3, 1e-3, 1.5, IMPORTANCE}},
	{"diamond .01", {0.01, 0.01, 2.4175, RADIANCE}},
	{"glass .0001:1", {1e-4, 1, 1.5, RADIANCE}},
	{"eta 2 1:.0001", {1, 1e-4, 2, RADIANCE}},
	{"eta 1000 .1", {0.1, 0.1, 1000, IMPORTANCE}},
	{"eta 1000 .5", {0.5, 0.5, 1000, RADIANCE}},
	{"eta 1/1000 .5", {0.5, 0.5, 1e-3, RADIANCE}},
	{"eta 1/1000 .001", {1e-3, 1e-3, 1e-3, RADIANCE}},
	{"eta 1000 .0005", {5e-4, 5e-4, 1000, IMPORTANCE}},
	{"eta 1 .1", {0.1, 0.1, 1, RADIANCE}},
	{"eta 1 1", {1, 1, 1, IMPORTANCE}},
	{"eta 1+1e-6 .0001", {1e-4, 1e-4, 1 + 1e-6, RADIANCE}},
	{"eta 1+1e-6 .1", {0.1, 0.1, 1 + 1e-6, RADIANCE}},
	{"eta 1-1e-6 .1", {0.1, 0.1, 1 - 1e-6, IMPORTANCE}},
	{"eta 1+1e-6 1", {1, 1, 1 + 1e-6, RADIANCE}},
	{"eta 1.0001 .001", {1e-3, 1e-3, 1.0001, RADIANCE}},
	{"eta 1.0001 .1", {0.1, 0.1, 1.0001, RADIANCE}},
	{"eta .9999 .5", {0.5, 0.5, 0.9999, RADIANCE}},
	{"eta 1.001 .001", {1e-3, 1e-3, 1.001, IMPORTANCE}},
	{"eta 1.001 .1", {0.1, 0.1, 1.001, RADIANCE}},
	{"eta 1.001 .5 importance", {0.5, 0.5, 1.001, IMPORTANCE}},
	{"eta .999 .3", {0.3, 0.3, 0.999, RADIANCE}},
};

static const recipe beckmann_conductor_recipes[] = {
	{"beckmann gold .0001", {1e-4, 1e-4, METAL(GOLD)}},    {"beckmann silver .01", {0.01, 0.01, METAL(SILVER)}},
	{"beckmann gold .25", {0.25, 0.25, METAL(GOLD)}},      {"beckmann chromium .5", {0.5, 0.5, METAL(CHROMIUM)}},
	{"beckmann tungsten 1", {1, 1, METAL(TUNGSTEN)}},      {"beckmann copper .05:.4", {0.05, 0.4, METAL(COPPER)}},
	{"beckmann nickel 1:.0001", {1, 1e-4, METAL(NICKEL)}},
};

static const recipe beckmann_dielectric_recipes[] = {
	{"beckmann glass .0001", {1e-4, 1e-4, 1.5, RADIANCE}},
	{"beckmann glass .3 importance", {0.3, 0.3, 1.5, IMPORTANCE}},
	{"beckmann bubble .2", {0.2, 0.2, 1 / 1.5, RADIANCE}},
	{"beckmann glass 1", {1, 1, 1.5, RADIANCE}},
	{"beckmann water .4:.05", {0.4, 0.05, 1.3334, RADIANCE}},
	{"beckmann eta 1 .1", {0.1, 0.1, 1, RADIANCE}},
	{"beckmann eta 1.001 .5", {0.5, 0.5, 1.001, IMPORTANCE}},
};

static const recipe ggx_schlick_recipes[] = {
	{"plastic .1", {0.1, 0.1, 0.04, 0.04, 0.04, 1, 1, 1}},
	{"gold colour .5", {0.5, 0.5, 1, 0.77, 0.34, 1, 1, 1}},
	{"white 1", {1, 1, 1, 1, 1, 1, 1, 1}},
	{"dark edge .2:.6", {0.2, 0.6, 0.9, 0.6, 0.3, 0.1, 0.2, 0.3}},
	{"from black .0001:.3", {1e-4, 0.3, 0, 0, 0, 1, 0.5, 0}},
	{"plastic .0001", {1e-4, 1e-4, 0.04, 0.05, 0.06, 1, 1, 1}},
};

static const recipe mirror_recipes[] = {
	{"mirror white", {1, 1, 1}},
	{"mirror blue", {0.1, 0.4, 0.9}},
	{"mirror black", {0, 0, 0}},
};

static const recipe smooth_conductor_recipes[] = {
	{"polished gold", {METAL(GOLD)}},
	{"polished chromium", {METAL(CHROMIUM)}},
	{"polished perfect", {GREY(1e-3, 1000)}},
	{"polished index 1", {GREY(1, 0)}},
};

static const recipe smooth_dielectric_recipes[] = {
	{"polished glass", {1.5, RADIANCE}},
	{"polished diamond importance", {2.4175, IMPORTANCE}},
	{"polished bubble", {1 / 1.5, RADIANCE}},
	{"polished eta 1/1000", {1e-3, RADIANCE}},
	{"polished eta 1000 importance", {1000, IMPORTANCE}},
	{"polished eta 1", {1, RADIANCE}},
	{"polished eta 1+1e-6", {1 + 1e-6, IMPORTANCE}},
};

static const recipe thin_dielectric_recipes[] = {
	{"pane glass", {1.5}},     {"pane of air", {1 / 1.5}},  {"pane eta 1", {1}},
	{"pane eta 1000", {1000}}, {"pane eta 1/1000", {1e-3}},
};

/* alpha_x, alpha_y, thickness, film index, n + ik */
static const recipe iridescent_conductor_recipes[] = {
	{"tempered iron .3", {0.3, 0.3, 120, 2.9, METAL(IRON)}},
	{"anodised titanium .2:.5", {0.2, 0.5, 350, 2.4, METAL(TITANIUM)}},
	{"coated copper .0001", {1e-4, 1e-4, 550, 1.33, METAL(COPPER)}},
	{"bare gold .5", {0.5, 0.5, 0, 1.5, METAL(GOLD)}},
	{"thick on silver 1", {1, 1, 1e5, 1.5, METAL(SILVER)}},
	{"film of index 1 on aluminium .1", {0.1, 0.1, 400, 1, METAL(ALUMINIUM)}},
};

/* alpha_x, alpha_y, thickness, film index, eta, transport */
static const recipe iridescent_dielectric_recipes[] = {
	{"coated glass .3", {0.3, 0.3, 110, 1.38, 1.5, RADIANCE}},
	{"oil on water .5 importance", {0.5, 0.5, 420, 1.47, 1.33, IMPORTANCE}},
	{"titania on glass .2:.4", {0.2, 0.4, 260, 2.4, 1.5, RADIANCE}},
	{"film in a bubble .3", {0.3, 0.3, 300, 1.2, 1 / 1.5, RADIANCE}},
	{"bare glass .01", {0.01, 0.01, 0, 1.38, 1.5, IMPORTANCE}},
	{"film of index 1 around nothing .1", {0.1, 0.1, 500, 1, 1, RADIANCE}},
};

/* alpha_x, alpha_y, then by the lobe; the surface from [8] on: cases_make.h. */
#define SURFACE(ndf, exponent, width, xy, yx, mean_x, mean_y) ndf, exponent, width, xy, yx, mean_x, mean_y
#define GGX                                                   SURFACE(LOBE_NDF_GGX, 0, 1, 0, 0, 0, 0)
#define GGX_TILTED                                            SURFACE(LOBE_NDF_GGX, 0, 1, 0.15, -0.1, 0.2, -0.3)
#define MASKING(masking, joint, across)                                                                                \
	LOBE_MASKING_##masking, LOBE_JOINT_##joint, LOBE_ACROSS_##across
#define BY(strategy, fresnel) LOBE_STRATEGY_##strategy, LOBE_FRESNEL_##fresnel

static const recipe microfacet_conductor_recipes[] = {
	{"copper ndf .3",
	 {0.3, 0.3, METAL(COPPER), 0, 0, 0, 0, 0, GGX, MASKING(SMITH, SEPARABLE, SEPARABLE), BY(NDF, EXACT)}},
	{"gold slopes .1:.4",
	 {0.1, 0.4, METAL(GOLD), 0, 0, 0, 0, 0, GGX, MASKING(SMITH, DIRECTION, SEPARABLE), BY(VISIBLE_SLOPES, EXACT)}},
	{"grey tilted ellipsoid",
	 {0.5, 0.3, GREY(0.5, 0), GGX_TILTED, MASKING(SMITH, HEIGHT, SEPARABLE), BY(VISIBLE_ELLIPSOID, CONSTANT)}},
	{"schlick bounded .5:.2",
	 {0.5, 0.2, GREY(0.3, 1), GGX, MASKING(SMITH, HEIGHT_DIRECTION, SEPARABLE), BY(BOUNDED_CAP, SCHLICK)}},
	{"film on silver cavities .6",
	 {0.6, 0.6, METAL(SILVER), 0, 0, 0, 0, 0, GGX, MASKING(VCAVITY, HEIGHT, SEPARABLE), BY(VCAVITY, FILM), 300,
	  1.5}},
	{"phong 30 hemisphere",
	 {1, 0.6, METAL(NICKEL), 0, 0, 0, 0, 0, SURFACE(LOBE_NDF_PHONG, 30, 1, 0, 0, 0, 0),
	  MASKING(SMITH, HEIGHT, SEPARABLE), BY(HEMISPHERE, EXACT)}},
	{"gtr 1.5 visible f82",
	 {1, 0.7, 0.9, 0.7, 0.4, 0.1, 0.2, 0.3, SURFACE(LOBE_NDF_GTR, 1.5, 0.3, 0, 0, 0, 0),
	  MASKING(SMITH, HEIGHT, SEPARABLE), BY(VISIBLE, F82)}},
	{"beckmann rational .4:.2",
	 {0.4, 0.2, GREY(0.8, 0), SURFACE(LOBE_NDF_BECKMANN, 0, 1, 0, 0, 0, 0),
	  MASKING(SMITH_RATIONAL, HEIGHT, SEPARABLE), BY(VISIBLE, CONSTANT)}},
	{"power 3.2 neumann cosine .5",
	 {0.5, 0.5, 0.6, 0.3, 0.1, 1, 0.9, 0.8, GGX, MASKING(NEUMANN, HEIGHT, SEPARABLE), BY(COSINE, POWER), 3.2, 0}},
};

/* eta, transport, reflectance that is constant or at normal incidence, and that at grazing */
#define GLASS(eta, transport, r) eta, transport, r, r, r, 1

static const recipe microfacet_dielectric_recipes[] = {
	{"glass slopes .3:.1",
	 {0.3, 0.1, GLASS(1.5, RADIANCE, 0), GGX, MASKING(SMITH, HEIGHT, BETA), BY(VISIBLE_SLOPES, EXACT)}},
	{"bubble ndf .2",
	 {0.2, 0.2, GLASS(1 / 1.5, IMPORTANCE, 0), GGX, MASKING(SMITH, SEPARABLE, SEPARABLE), BY(NDF, EXACT)}},
	{"glass cavities .5",
	 {0.5, 0.5, GLASS(1.5, RADIANCE, 0), GGX, MASKING(VCAVITY, HEIGHT, SEPARABLE), BY(VCAVITY, EXACT)}},
	{"glass tilted schlick",
	 {0.4, 0.3, GLASS(1.5, RADIANCE, 0.04), GGX_TILTED, MASKING(SMITH, HEIGHT, BETA), BY(VISIBLE_CAP, SCHLICK)}},
	{"diamond uniform 1",
	 {1, 1, GLASS(2.4175, IMPORTANCE, 0), GGX, MASKING(SCHLICK_GGX, HEIGHT, SEPARABLE), BY(UNIFORM, EXACT)}},
	{"half mirror bounded .6",
	 {0.6, 0.6, GLASS(1.33, RADIANCE, 0.5), GGX, MASKING(SMITH, HEIGHT, SEPARABLE), BY(BOUNDED_CAP, CONSTANT)}},
	{"student 3 tilted cap",
	 {0.5, 0.4, GLASS(1.5, RADIANCE, 0), SURFACE(LOBE_NDF_STUDENT_T, 3, 1, 0.1, 0, 0.1, 0.2),
	  MASKING(SMITH, HEIGHT, SEPARABLE), BY(VISIBLE_CAP, EXACT)}},
	{"eta 1 ellipsoid .5",
	 {0.5, 0.5, GLASS(1, RADIANCE, 0), GGX, MASKING(SMITH, HEIGHT, SEPARABLE), BY(VISIBLE_ELLIPSOID, EXACT)}},
};

static const recipe microfacet_diffuse_recipes[] = {
	{"clay .5", {0.5, 0.5, 0.8, 0.5, 0.3, 0, 0, 0, GGX, MASKING(SMITH, HEIGHT, SEPARABLE)}},
	{"plaster tilted .3:.6", {0.3, 0.6, 1, 1, 1, 0, 0, 0, GGX_TILTED, MASKING(SMITH, SEPARABLE, SEPARABLE)}},
	{"cavities 1", {1, 1, 1, 0.5, 0, 0, 0, 0, GGX, MASKING(VCAVITY, HEIGHT, SEPARABLE)}},
	{"smooth .0001", {1e-4, 1e-4, 0.9, 0.9, 0.9, 0, 0, 0, GGX, MASKING(SMITH, HEIGHT, SEPARABLE)}},
};

const recipe *recipes_of(lobe_uint kind, size_t *n)
{
	switch (kind) {
#define LOBE_X(NAME, name, value)                                                                                      \
	case value:                                                                                                    \
		*n = sizeof name##_recipes / sizeof *name##_recipes;                                                   \
		return name##_recipes;
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	default:
		*n = 0;
		return NULL;
	}
}

void recipe_parameters(const recipe *r, double parameter[CASE_PARAMETERS])
{
	double p[CASE_PARAMETERS];
	memcpy(p, r->parameter, sizeof p);
	for (int k = 0; k + 6 <= CASE_PARAMETERS; k++)
		if (p[k] <= -1.0)
			memcpy(p + k, metals[(int)(-1.0 - p[k])], sizeof metals[0]);
	for (int k = 0; k < CASE_PARAMETERS; k++)
		parameter[k] = (double)(float)p[k];
}
