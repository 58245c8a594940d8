/* strategies_case.c - materials, and one sample by each technique. */
#include <math.h>
#include <string.h>

#include "pi.h"
#include "strategies_estimate.h"
#include "strategies_names.h"

static const char *const names[STRATEGIES_TECHNIQUES] = {
	STRATEGIES_NAMES, "light", "balance", "power", "balance + bounded cap",
};

const char *strategies_name(int technique) { return names[technique]; }

const char *strategies_material_name(int material)
{
	static const char *const materials[STRATEGIES_MATERIALS] = {"GGX", "GGX 4:1", "Beckmann"};
	return materials[material];
}

int strategies_ndf(int material) { return material == STRATEGIES_BECKMANN; }

int strategies_default(int material)
{
	return material == STRATEGIES_BECKMANN ? LOBE_STRATEGY_VISIBLE : LOBE_STRATEGY_BOUNDED_CAP;
}

/* --- grids -------------------------------------------------------------------------------------------------------- */

size_t strategies_alphas(int quick) { return quick ? 7 : 13; }

double strategies_alpha(int quick, size_t i) { return pow(10.0, -3.0 + (double)i / (quick ? 2.0 : 4.0)); }

size_t strategies_cosines(int quick) { return quick ? 5 : 9; }

double strategies_cosine(int quick, size_t i)
{
	static const double few[] = {1.0, 0.7, 0.3, 0.1, 0.02};
	static const double many[] = {1.0, 0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02};
	return quick ? few[i] : many[i];
}

/* --- cases -------------------------------------------------------------------------------------------------------- */

lobe_microfacet_conductor strategies_lobe(int material, float alpha, lobe_uint strategy)
{
	const lobe_uint ndf = material == STRATEGIES_BECKMANN ? LOBE_NDF_BECKMANN : LOBE_NDF_GGX;
	const float across = material == STRATEGIES_BRUSHED ? 0.25f * alpha : alpha;
	const lobe_microsurface s =
		lobe_microsurface_make(lobe_distribution_make(ndf), lobe_linear_stretch(alpha, across));
	return lobe_microfacet_conductor_make(
		s, lobe_fresnel_model_conductor(lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)),
		strategy);
}

lobe_rough_conductor strategies_production(int material, float alpha)
{
	const float across = material == STRATEGIES_BRUSHED ? 0.25f * alpha : alpha;
	return lobe_rough_conductor_make(alpha, across, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD));
}

/* The viewer of brushed metal stands 30 degrees off the brushing. */
strategies_case strategies_case_make(int material, double alpha, double cosine, size_t light)
{
	strategies_case c;
	const double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
	const double phi = material == STRATEGIES_BRUSHED ? PI / 6.0 : 0.0;
	memset(&c, 0, sizeof c);
	c.material = material;
	c.alpha = alpha;
	c.cosine = cosine;
	c.wo = lobe_vec3_make((float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)cosine);
	c.light = strategies_light_at(light, c.wo);
	for (lobe_uint k = 0; k <= LOBE_STRATEGY_LAST; k++)
		c.lobe[k] = strategies_lobe(material, (float)alpha, k);
	return c;
}

/* --- techniques --------------------------------------------------------------------------------------------------- */

/* That a technique takes the lobe's direction from; VISIBLE for the light alone. */
static lobe_uint strategy_of(int technique)
{
	if (technique == STRATEGIES_BALANCE_BOUNDED)
		return LOBE_STRATEGY_BOUNDED_CAP;
	return technique < STRATEGIES_LOBE ? (lobe_uint)technique : LOBE_STRATEGY_VISIBLE;
}

const strategies_compiled *strategies_compiled_for(const strategies_case *c)
{
	return c->material == STRATEGIES_BECKMANN ? &strategies_only_beckmann : &strategies_only_ggx;
}

float strategies_estimate(const strategies_case *c, int technique, const float u[3], const float v[3])
{
	return strategies_by(c, technique, c->lobe[strategy_of(technique)], u, v);
}

float strategies_estimate_production(const strategies_case *c, const lobe_rough_conductor *p, const float u[3])
{
	const lobe_vec3 point = lobe_vec3_make(u[0], u[1], u[2]);
	const lobe_sample s = c->material == STRATEGIES_BECKMANN ? lobe_beckmann_conductor_sample(*p, c->wo, point)
								 : lobe_ggx_conductor_sample(*p, c->wo, point);
	float pdf;
	if (!s.event)
		return 0.0f;
	return strategies_luminance(strategies_times(s.weight, strategies_radiance(&c->light, s.wi, &pdf)));
}
