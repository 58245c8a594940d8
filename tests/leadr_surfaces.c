#include "leadr_surfaces.h"

#include <math.h>
#include <string.h>

const double rhos[RHOS] = {-0.9999, -0.99, -0.5, 0.0, 0.3, 0.9, 0.999, 0.9999};

const fixed_distribution fixed[FIXED] = {
#define LOBE_NDF_FIXED(NAME, name, number) {number, #name},
#define LOBE_NDF_SHAPED(NAME, name, number)
#include "lobe/microfacet/distributions.def"
#undef LOBE_NDF_FIXED
#undef LOBE_NDF_SHAPED
};

int kind_of(size_t i) { return !strcmp(fixed[i].name, "ggx") ? 0 : !strcmp(fixed[i].name, "beckmann") ? 1 : -1; }

static lobe_linear map_of(const leadr *s)
{
	return lobe_linear_tilted(lobe_linear_correlated((float)s->ax, (float)s->ay, (float)s->rho), (float)s->tx,
				  (float)s->ty);
}

lobe_smith surface_of(const leadr *s, size_t distribution)
{
	return lobe_smith_make(lobe_distribution_make(fixed[distribution].ndf), map_of(s));
}

/* volatile: gcc 12 at -O2 drops the rounding of two side by side that are used as doubles again. */
double single(double x)
{
	volatile float f = (float)x;
	return (double)f;
}

leadr as_floats(leadr s)
{
	s.ax = single(s.ax);
	s.ay = single(s.ay);
	s.rho = single(s.rho);
	s.tx = single(s.tx);
	s.ty = single(s.ty);
	return s;
}

leadr random_surface(uint32_t stream, uint64_t i, leadr_kind kind)
{
	leadr s;
	s.kind = kind;
	s.ax = pow(10.0, -4.0 + 5.0 * uniform(stream, 8 * i));
	s.ay = pow(10.0, -4.0 + 5.0 * uniform(stream, 8 * i + 1));
	s.rho = rhos[test_bits(stream, 8 * i + 2) % 8];
	s.tx = i % 2 ? 0.0 : pow(100.0, uniform(stream, 8 * i + 3));
	s.ty = i % 4 ? 0.0 : -pow(100.0, uniform(stream, 8 * i + 4));
	return as_floats(s);
}
