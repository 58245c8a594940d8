/* strategies_map.c - variance of every technique over roughness, angle and light. */
#include <math.h>

#include "strategies.h"

static size_t before(int quick, int material)
{
	size_t n = 0;
	for (int m = 0; m < material; m++)
		n += strategies_lights_of(quick, m) * strategies_alphas(quick);
	return n;
}

static size_t units(int quick) { return before(quick, STRATEGIES_MATERIALS); }

static int run(int quick, size_t unit, report_rows *rows)
{
	int material = 0;
	while (unit >= before(quick, material + 1))
		material++;
	const size_t in = unit - before(quick, material), alphas = strategies_alphas(quick);
	const size_t light = strategies_light_of(quick, material, in / alphas);
	const double alpha = strategies_alpha(quick, in % alphas);
	for (size_t i = 0; i < strategies_cosines(quick); i++) {
		const strategies_case c = strategies_case_make(material, alpha, strategies_cosine(quick, i), light);
		const strategies_moments m = strategies_moments_of(&c, quick ? 1024 : 4096, 8, 1u);
		for (int t = 0; t < STRATEGIES_TECHNIQUES; t++)
			report_row(rows, "%s,%s,%.4g,%.5g,%g,%.8g,%.2g,%s,%.7g,%.2g",
				   strategies_material_name(material), c.light.name, c.light.solid_angle, alpha,
				   c.cosine, m.mean, m.mean_error, strategies_name(t), m.variance[t], m.error[t]);
	}
	return 0;
}

const report_study strategies_map_study = {
	"strategies_map",
	"material,light,solid_angle_sr,alpha,cosine,mean,mean_error,technique,variance,variance_error",
	0,
	units,
	run,
	strategies_settings,
};
