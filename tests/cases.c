#include "cases.h"

#include "cases_make.h"

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

#define MAX_CASES 256
static test_case cases[MAX_CASES];
static size_t count;

static void add(lobe_uint kind, const recipe *recipes, size_t n, void (*describe)(test_case *))
{
	for (size_t i = 0; i < n && count < MAX_CASES; i++) {
		test_case *c = &cases[count++];
		double p[CASE_PARAMETERS];
		memcpy(p, recipes[i].parameter, sizeof p);
		if (p[2] <= -1.0)
			memcpy(p + 2, metals[(int)(-1.0 - p[2])], sizeof metals[0]);
		for (int k = 0; k < CASE_PARAMETERS; k++)
			c->parameter[k] = (double)(float)p[k];
		c->name = recipes[i].name;
		c->kind = kind;
		c->bsdf = make_bsdf(kind, c->parameter);
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
