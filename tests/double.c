/* double.c - the only file of the tests that is compiled with -DLOBE_DOUBLE=1. */
#include "double.h"

#include "cases_make.h"

#if !LOBE_DOUBLE
#error "compile tests/double.c with -DLOBE_DOUBLE=1"
#endif

static lobe_vec3 vec3(const double v[3]) { return lobe_vec3_make(v[0], v[1], v[2]); }

void double_eval(uint32_t kind, const double *parameter, const double wo[3], const double wi[3], double f[3])
{
	const lobe_rgb v = lobe_bsdf_eval(make_bsdf(kind, parameter), vec3(wo), vec3(wi));
	f[0] = v.r;
	f[1] = v.g;
	f[2] = v.b;
}

double double_pdf(uint32_t kind, const double *parameter, const double wo[3], const double wi[3])
{
	return lobe_bsdf_pdf(make_bsdf(kind, parameter), vec3(wo), vec3(wi));
}

double_sample double_sample_at(uint32_t kind, const double *parameter, const double wo[3], const double u[3])
{
	const lobe_sample s = lobe_bsdf_sample(make_bsdf(kind, parameter), vec3(wo), vec3(u));
	const double_sample d = {{s.wi.x, s.wi.y, s.wi.z}, {s.weight.r, s.weight.g, s.weight.b}, s.pdf, s.event};
	return d;
}
