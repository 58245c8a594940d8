#include "cases.h"

#include "cases_make.h"
#include "support.h"

#define THIRD        (1.0 / 3.0)
#define RADIANCE     LOBE_TRANSPORT_RADIANCE
#define IMPORTANCE   LOBE_TRANSPORT_IMPORTANCE
#define COUNT(table) (sizeof(table) / sizeof *(table))

typedef struct {
	const char *name;
	double parameter[CASE_PARAMETERS];
} recipe;

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
#define MASKING(masking, joint, across)                       LOBE_MASKING_##masking, LOBE_JOINT_##joint, LOBE_ACROSS_##across
#define BY(strategy, fresnel)                                 LOBE_STRATEGY_##strategy, LOBE_FRESNEL_##fresnel

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

static void describe_lambert(test_case *c) { c->flags = CASE_TWO_SIDED | CASE_RECIPROCAL; }

static void describe_rough_conductor(test_case *c, textbook_ndf ndf)
{
	c->alpha_x = c->parameter[0];
	c->alpha_y = c->parameter[1];
	c->flags = CASE_RECIPROCAL;
	c->ndf = ndf;
}

static void describe_rough_dielectric(test_case *c, textbook_ndf ndf, lobe_rough_dielectric p)
{
	c->alpha_x = c->parameter[0];
	c->alpha_y = c->parameter[1];
	c->eta = c->parameter[2];
	c->flags = CASE_TWO_SIDED | CASE_TRANSMITS | CASE_RECIPROCAL | (p.delta != 0u ? CASE_DELTA : 0u);
	c->ndf = ndf;
}

static void describe_ggx_conductor(test_case *c) { describe_rough_conductor(c, TEXTBOOK_GGX); }
static void describe_beckmann_conductor(test_case *c) { describe_rough_conductor(c, TEXTBOOK_BECKMANN); }

static void describe_ggx_dielectric(test_case *c)
{
	describe_rough_dielectric(c, TEXTBOOK_GGX, c->bsdf.as.ggx_dielectric);
}

static void describe_beckmann_dielectric(test_case *c)
{
	describe_rough_dielectric(c, TEXTBOOK_BECKMANN, c->bsdf.as.beckmann_dielectric);
}

static void describe_ggx_schlick(test_case *c) { describe_ggx_conductor(c); }

static void describe_mirror(test_case *c) { c->flags = CASE_TWO_SIDED | CASE_DELTA | CASE_DELTA_ONLY; }

static void describe_smooth_conductor(test_case *c) { c->flags = CASE_DELTA | CASE_DELTA_ONLY; }

static void describe_smooth_dielectric(test_case *c)
{
	c->eta = c->parameter[0];
	c->transport_at = 1;
	c->flags = CASE_TWO_SIDED | CASE_TRANSMITS | CASE_DELTA | CASE_DELTA_ONLY;
}

/* The same medium on both sides. */
static void describe_thin_dielectric(test_case *c)
{
	c->eta = 1.0;
	c->flags = CASE_TWO_SIDED | CASE_TRANSMITS | CASE_DELTA | CASE_DELTA_ONLY;
}

static void describe_iridescent_conductor(test_case *c) { describe_ggx_conductor(c); }

static void describe_iridescent_dielectric(test_case *c)
{
	c->alpha_x = c->parameter[0];
	c->alpha_y = c->parameter[1];
	c->eta = c->parameter[4];
	c->transport_at = 5;
	c->flags = CASE_TWO_SIDED | CASE_TRANSMITS | CASE_RECIPROCAL | CASE_COLOURED |
		   (c->bsdf.as.iridescent_dielectric.glass.delta != 0u ? CASE_DELTA : 0u);
}

/* Whether samples weigh at most F: visible normals of the masking's own surface. */
static int is_light(lobe_microsurface s, lobe_uint strategy)
{
	if (s.masking == LOBE_MASKING_VCAVITY)
		return strategy == LOBE_STRATEGY_VCAVITY;
	return s.masking == LOBE_MASKING_SMITH && strategy != LOBE_STRATEGY_NDF && strategy != LOBE_STRATEGY_VCAVITY &&
	       strategy != LOBE_STRATEGY_HEMISPHERE && !lobe_strategy_of_directions(strategy) &&
	       !lobe_strategy_borrows_ggx(strategy, s);
}

static void describe_microsurface(test_case *c, lobe_microsurface s, lobe_uint strategy)
{
	c->alpha_x = c->parameter[0] * (double)s.like;
	c->alpha_y = c->parameter[1] * (double)s.like;
	c->ndf = s.distribution.ndf == LOBE_NDF_BECKMANN ? TEXTBOOK_BECKMANN : TEXTBOOK_GGX;
	c->flags |= is_light(s, strategy) ? 0u : CASE_HEAVY;
	c->flags |= s.map.mean_x == 0.0f && s.map.mean_y == 0.0f ? CASE_RECIPROCAL : 0u;
}

static void describe_microfacet_conductor(test_case *c)
{
	const lobe_microfacet_conductor p = c->bsdf.as.microfacet_conductor;
	describe_microsurface(c, p.surface, p.strategy);
}

static void describe_microfacet_dielectric(test_case *c)
{
	const lobe_microfacet_dielectric p = c->bsdf.as.microfacet_dielectric;
	describe_microsurface(c, p.surface, p.strategy);
	c->eta = c->parameter[2];
	c->flags |= CASE_TWO_SIDED | CASE_TRANSMITS | (p.delta != 0u ? CASE_DELTA : 0u);
}

/* No width: what it reflects is spread over the hemisphere, however narrow the facets. Reciprocal but for what the
 * fixed set of facets is off by. */
static void describe_microfacet_diffuse(test_case *c) { c->flags = CASE_HEAVY; }

#define MAX_CASES 256
static test_case cases[MAX_CASES];
static size_t count;

static void add(lobe_uint kind, const recipe *recipes, size_t n, void (*describe)(test_case *))
{
	for (size_t i = 0; i < n && count < MAX_CASES; i++) {
		test_case *c = &cases[count++];
		double p[CASE_PARAMETERS];
		memcpy(p, recipes[i].parameter, sizeof p);
		for (int k = 0; k + 6 <= CASE_PARAMETERS; k++)
			if (p[k] <= -1.0)
				memcpy(p + k, metals[(int)(-1.0 - p[k])], sizeof metals[0]);
		for (int k = 0; k < CASE_PARAMETERS; k++)
			c->parameter[k] = (double)(float)p[k];
		c->name = recipes[i].name;
		c->kind = kind;
		c->bsdf = make_bsdf(kind, c->parameter);
		c->transport_at = 3;
		describe(c);
	}
}

size_t case_count(void)
{
	if (count == 0) {
#define LOBE_X(NAME, name, value) add(value, name##_recipes, COUNT(name##_recipes), describe_##name);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	}
	return count;
}

const test_case *case_at(size_t i) { return i < case_count() ? &cases[i] : NULL; }

static const double cosines[] = {1.0, 0.95, 0.7, 0.4, 0.1, 0.01, 1e-3, 1e-4, 1e-6};

size_t case_wo_count(const test_case *c) { return COUNT(cosines) * (c->flags & CASE_TWO_SIDED ? 2u : 1u); }

lobe_vec3 case_wo(size_t i)
{
	const size_t k = i % COUNT(cosines);
	const double z = cosines[k];
	const double s = sqrt((1.0 - z) * (1.0 + z));
	const double phi = 0.4 + 2.399963 * (double)i; /* the golden angle: every azimuth gets its turn */
	return lobe_vec3_make((float)(s * cos(phi)), (float)(s * sin(phi)), (float)(i < COUNT(cosines) ? z : -z));
}

/* A facet tilted by d turns a reflection by 2 d, or by 2 d o.m across the plane of incidence, and a refraction by about
 * |e - 1| d. A visible facet has o.m of at least about max(cos, alpha). Light that leaves a dense medium besides
 * spreads the cone below the critical angle, in which a rounding of o.m counts e^-2 times, over the hemisphere. */
double case_rounding(const test_case *c, lobe_vec3 wo)
{
	if (c->alpha_x <= 0.0)
		return 0x1p-24;
	const double narrow = fmin(c->alpha_x, c->alpha_y);
	const double om = fmax(fabs((double)wo.z), fmax(c->alpha_x, c->alpha_y));
	double turn = 2.0 * narrow * om;
	double noise = 0.0;
	if ((c->flags & CASE_TRANSMITS) && !(c->flags & CASE_DELTA)) {
		const double e = wo.z > 0.0f ? c->eta : 1.0 / c->eta;
		turn = fmin(turn, fmin(1.0, fabs(e - 1.0)) * narrow * om);
		noise = e < 1.0 ? 0x1p-23 / (e * e) : 0.0;
	}
	return fmax(0x1p-24 / turn, noise);
}

int case_carries_radiance(const test_case *c) { return c->parameter[c->transport_at] == (double)RADIANCE; }

lobe_bsdf case_with_other_transport(const test_case *c)
{
	double p[CASE_PARAMETERS];
	memcpy(p, c->parameter, sizeof p);
	p[c->transport_at] = case_carries_radiance(c) ? IMPORTANCE : RADIANCE;
	return make_bsdf(c->kind, p);
}

double case_film_condition(const test_case *c)
{
	const int iridescent = c->kind == LOBE_KIND_IRIDESCENT_CONDUCTOR || c->kind == LOBE_KIND_IRIDESCENT_DIELECTRIC;
	const int chosen = (c->kind == LOBE_KIND_MICROFACET_CONDUCTOR || c->kind == LOBE_KIND_MICROFACET_DIELECTRIC) &&
			   c->parameter[19] == LOBE_FRESNEL_FILM;
	if (!iridescent && !chosen)
		return 1.0;
	/* 1/2.24e-3 nm is the shortest wavelength that counts; a film of many wavelengths has lost its colour. */
	const double *film = c->parameter + (chosen ? 20 : 2);
	const double opd = fmin(2.0 * film[0] * film[1], 1e4);
	return 1.0 + 2.0 * TWO_PI * opd * 2.24e-3;
}
