/* cases.c - what is known of each lobe with the numbers of case_recipes.h, and the directions. */
#include "cases.h"

#include "case_recipes.h"
#include "cases_make.h"
#include "support.h"

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

static void add(lobe_uint kind, void (*describe)(test_case *))
{
	size_t n;
	const recipe *recipes = recipes_of(kind, &n);
	for (size_t i = 0; i < n && count < MAX_CASES; i++) {
		test_case *c = &cases[count++];
		recipe_parameters(&recipes[i], c->parameter);
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
#define LOBE_X(NAME, name, value) add(value, describe_##name);
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	}
	return count;
}

const test_case *case_at(size_t i) { return i < case_count() ? &cases[i] : NULL; }

static const double cosines[] = {1.0, 0.95, 0.7, 0.4, 0.1, 0.01, 1e-3, 1e-4, 1e-6};
#define COSINES (sizeof cosines / sizeof *cosines)

size_t case_wo_count(const test_case *c) { return COSINES * (c->flags & CASE_TWO_SIDED ? 2u : 1u); }

lobe_vec3 case_wo(size_t i)
{
	const size_t k = i % COSINES;
	const double z = cosines[k];
	const double s = sqrt((1.0 - z) * (1.0 + z));
	const double phi = 0.4 + 2.399963 * (double)i; /* the golden angle: every azimuth gets its turn */
	return lobe_vec3_make((float)(s * cos(phi)), (float)(s * sin(phi)), (float)(i < COSINES ? z : -z));
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
int case_carries_radiance(const test_case *c)
{
	return c->parameter[c->transport_at] == (double)LOBE_TRANSPORT_RADIANCE;
}

lobe_bsdf case_with_other_transport(const test_case *c)
{
	double p[CASE_PARAMETERS];
	memcpy(p, c->parameter, sizeof p);
	p[c->transport_at] = case_carries_radiance(c) ? LOBE_TRANSPORT_IMPORTANCE : LOBE_TRANSPORT_RADIANCE;
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
