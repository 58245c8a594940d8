/* approximations_ways.h - every way to compute what the section compares, once.
 *
 * WAY(group, id, name, exact, value) has one output, WAY_3 three. The value is C and, as text, OpenCL C; it may use x,
 * y, z, s, t (the group's inputs) and p, the approximations_set. HOST and HOST_3 are C alone. */
#ifndef LOBE_BENCH_REPORT_APPROXIMATIONS_WAYS_H
#define LOBE_BENCH_REPORT_APPROXIMATIONS_WAYS_H

#include "lobe/lobe.h"

/* What does not change within a loop. */
#define APPROXIMATIONS_SET                                                                                             \
	typedef struct {                                                                                               \
		lobe_microsurface surface;                                                                             \
		lobe_rgb n, k; /* index of a metal or, in n, of a dielectric */                                        \
		lobe_film film;                                                                                        \
		lobe_real f0, depth; /* of Schlick's curve; of the dip, f82 */                                         \
		lobe_real exponent;  /* of a generalised curve that is fitted ... */                                   \
		lobe_real general;   /* ... and the depth of its dip */                                                \
		lobe_real edge;      /* Gulbrandsen's tint */                                                          \
	} approximations_set;
APPROXIMATIONS_SET

#define V3 lobe_vec3_make
#define APPROXIMATIONS_WAYS(WAY, WAY_3, HOST, HOST_3)                                                                  \
	WAY(LAMBDA, lambda_erf, "erf and exp", 1, lobe_beckmann_hidden(V3(x, LOBE_R(0.0), y)))                         \
	WAY(LAMBDA, lambda_ierfc, "one polynomial", 0, LOBE_R(0.5) * (lobe_beckmann_t(V3(x, LOBE_R(0.0), y)) - y))     \
	WAY(LAMBDA, lambda_rational, "Walter's rational", 0, lobe_beckmann_hidden_rational(V3(x, LOBE_R(0.0), y)))     \
	HOST(LAMBDA, lambda_libm, "textbook form by libm", 0,                                                          \
	     y *(0.5f * (erff(y / x) - 1.0f) + 0.28209479f * (x / y) * expf(-(y / x) * (y / x))))                      \
	WAY(DIELECTRIC, dielectric_exact, "exact", 1, lobe_fresnel_dielectric(x, p.n.r).reflectance)                   \
	WAY(DIELECTRIC, dielectric_schlick, "Schlick", 0, lobe_fresnel_schlick(x, p.f0))                               \
	WAY(DIELECTRIC, dielectric_power, "Schlick; fitted exponent", 0,                                               \
	    lobe_fresnel_schlick_power(x, p.f0, LOBE_R(1.0), p.exponent))                                              \
	WAY(DIELECTRIC, dielectric_constant, "constant", 0, p.f0 + LOBE_R(0.0) * x)                                    \
	WAY(CONDUCTOR, conductor_exact, "exact", 1, lobe_fresnel_conductor(x, p.n.r, p.k.r))                           \
	WAY(CONDUCTOR, conductor_schlick, "Schlick", 0, lobe_fresnel_schlick(x, p.f0))                                 \
	WAY(CONDUCTOR, conductor_f82, "F82-tint", 0, lobe_fresnel_f82(x, p.f0, p.depth))                               \
	WAY(CONDUCTOR, conductor_power, "Schlick; fitted exponent", 0,                                                 \
	    lobe_fresnel_schlick_power(x, p.f0, LOBE_R(1.0), p.exponent))                                              \
	WAY(CONDUCTOR, conductor_hoffman, "generalised: exponent and dip", 0,                                          \
	    lobe_fresnel_hoffman(x, p.f0, LOBE_R(1.0), LOBE_R(5.0), p.general))                                        \
	WAY(CONDUCTOR, conductor_artist, "Gulbrandsen; mapped each call", 0, approximations_artist(x, p.f0, p.edge))   \
	WAY(CONDUCTOR, conductor_constant, "constant", 0, p.f0 + LOBE_R(0.0) * x)                                      \
	WAY_3(FILM, film_series, "Belcour-Barla series", 0, lobe_thin_film_conductor_rgb(x, p.film, p.n, p.k))         \
	WAY_3(FILM, film_none, "no film", 0, lobe_fresnel_conductor_rgb(x, p.n, p.k))                                  \
	WAY_3(FILM, film_3, "Airy; 1 wavelength a channel", 0,                                                         \
	      lobe_rgb_make(lobe_airy_conductor(x, p.film, p.n.r, p.k.r, LOBE_R(610.0)),                               \
			    lobe_airy_conductor(x, p.film, p.n.g, p.k.g, LOBE_R(540.0)),                               \
			    lobe_airy_conductor(x, p.film, p.n.b, p.k.b, LOBE_R(450.0))))                              \
	APPROXIMATIONS_MASKING(WAY)                                                                                    \
	WAY(ACROSS, across_beta, "beta function", 1, WAY_ACROSS(LOBE_ACROSS_BETA))                                     \
	WAY(ACROSS, across_separable, "separable", 0, WAY_ACROSS(LOBE_ACROSS_SEPARABLE))                               \
	HOST(DENSITY, density_ggx, "GGX", 1, WAY_DENSITY(lobe_ggx_density(V3(x, y, z))))                               \
	HOST(DENSITY, density_beckmann, "Beckmann", 1, WAY_DENSITY(lobe_beckmann_density(V3(x, y, z))))                \
	HOST(DENSITY, density_table, "table", 0,                                                                       \
	     WAY_DENSITY(lobe_tabulated_density(p.surface.distribution, V3(x, y, z))))                                 \
	HOST(HIDDEN, hidden_ggx, "GGX", 1, lobe_ggx_hidden(V3(x, y, z)))                                               \
	HOST(HIDDEN, hidden_beckmann, "Beckmann", 1, lobe_beckmann_hidden(V3(x, y, z)))                                \
	HOST(HIDDEN, hidden_table, "table", 0, lobe_tabulated_hidden(p.surface.distribution, V3(x, y, z)))             \
	HOST_3(VISIBLE, visible_ggx, "GGX", 1, WAY_RGB(lobe_ggx_visible(V3(x, y, z), lobe_vec2_make(s, t))))           \
	HOST_3(VISIBLE, visible_beckmann, "Beckmann", 1,                                                               \
	       WAY_RGB(lobe_beckmann_visible(V3(x, y, z), lobe_vec2_make(s, t))))                                      \
	HOST_3(VISIBLE, visible_table, "table", 0,                                                                     \
	       WAY_RGB(lobe_tabulated_visible(p.surface.distribution, V3(x, y, z), lobe_vec2_make(s, t))))             \
	APPROXIMATIONS_REAL(WAY, HOST)

/* G2 with the masking and joint as constants, so that the choice is folded as in a production lobe. */
#define WAY_MASKING(masking, joint) approximations_g2(p.surface, masking, joint, x, y, z, s, t)
#define WAY_ACROSS(across)          approximations_g2_across(p.surface, across, x, y, z, s, t)
#define APPROXIMATIONS_MASKING(WAY)                                                                                    \
	WAY(MASKING, smith_height, "Smith; height-correlated", 1, WAY_MASKING(LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT))  \
	WAY(MASKING, smith_separable, "Smith; separable", 0, WAY_MASKING(LOBE_MASKING_SMITH, LOBE_JOINT_SEPARABLE))    \
	WAY(MASKING, smith_direction, "Smith; direction-correlated", 0,                                                \
	    WAY_MASKING(LOBE_MASKING_SMITH, LOBE_JOINT_DIRECTION))                                                     \
	WAY(MASKING, smith_both, "Smith; height and direction", 0,                                                     \
	    WAY_MASKING(LOBE_MASKING_SMITH, LOBE_JOINT_HEIGHT_DIRECTION))                                              \
	WAY(MASKING, vcavity, "V-cavities", 0, WAY_MASKING(LOBE_MASKING_VCAVITY, LOBE_JOINT_HEIGHT))                   \
	WAY(MASKING, schlick_ggx, "Schlick-Smith k = alpha/2", 0,                                                      \
	    WAY_MASKING(LOBE_MASKING_SCHLICK_GGX, LOBE_JOINT_HEIGHT))                                                  \
	WAY(MASKING, schlick_smith, "Schlick-Smith k = alpha sqrt(2/pi)", 0,                                           \
	    WAY_MASKING(LOBE_MASKING_SCHLICK_SMITH, LOBE_JOINT_HEIGHT))                                                \
	WAY(MASKING, schlick_lights, "Schlick-Smith k = (r + 1)^2/8", 0,                                               \
	    WAY_MASKING(LOBE_MASKING_SCHLICK_GGX_LIGHTS, LOBE_JOINT_HEIGHT))                                           \
	WAY(MASKING, kelemen, "Kelemen", 0, WAY_MASKING(LOBE_MASKING_KELEMEN, LOBE_JOINT_HEIGHT))                      \
	WAY(MASKING, neumann, "Neumann", 0, WAY_MASKING(LOBE_MASKING_NEUMANN, LOBE_JOINT_HEIGHT))                      \
	WAY(MASKING, implicit, "implicit", 0, WAY_MASKING(LOBE_MASKING_IMPLICIT, LOBE_JOINT_HEIGHT))                   \
	WAY(MASKING, disney, "Disney", 0, WAY_MASKING(LOBE_MASKING_DISNEY, LOBE_JOINT_HEIGHT))                         \
	WAY(MASKING, none, "none", 0, WAY_MASKING(LOBE_MASKING_NONE, LOBE_JOINT_HEIGHT))

#define APPROXIMATIONS_REAL(WAY, HOST)                                                                                 \
	WAY(REAL, sin_2pi_lobe, "sin_2pi/lobe", 1, lobe_sincos_2pi(x).s)                                               \
	HOST(REAL, sin_2pi_libm, "sin_2pi/libm", 0, sinf(6.2831853071795864769f * x))                                  \
	WAY(REAL, cos_2pi_lobe, "cos_2pi/lobe", 1, lobe_sincos_2pi(x).c)                                               \
	HOST(REAL, cos_2pi_libm, "cos_2pi/libm", 0, cosf(6.2831853071795864769f * x))                                  \
	WAY(REAL, exp_lobe, "exp/lobe", 1, lobe_exp(x))                                                                \
	HOST(REAL, exp_libm, "exp/libm", 0, expf(x))                                                                   \
	WAY(REAL, log_lobe, "log/lobe", 1, lobe_log(x))                                                                \
	HOST(REAL, log_libm, "log/libm", 0, logf(x))                                                                   \
	WAY(REAL, pow_lobe, "pow/lobe", 1, lobe_pow(x, y))                                                             \
	HOST(REAL, pow_libm, "pow/libm", 0, powf(x, y))                                                                \
	WAY(REAL, erf_lobe, "erf/lobe", 1, lobe_erf(x))                                                                \
	HOST(REAL, erf_libm, "erf/libm", 0, erff(x))                                                                   \
	WAY(REAL, erfinv_lobe, "erfinv/lobe", 1, lobe_erfinv(x))                                                       \
	WAY(REAL, acos_lobe, "acos/lobe", 1, lobe_acos(x))                                                             \
	HOST(REAL, acos_libm, "acos/libm", 0, acosf(x))                                                                \
	WAY(REAL, atan2_lobe, "atan2/lobe", 1, lobe_atan2(x, y))                                                       \
	HOST(REAL, atan2_libm, "atan2/libm", 0, atan2f(x, y))                                                          \
	WAY(REAL, sin_lobe, "sin/lobe", 1, lobe_sin(x))                                                                \
	HOST(REAL, sin_libm, "sin/libm", 0, sinf(x))

/* Helpers of the expressions: the same text in C and OpenCL C. */
#define APPROXIMATIONS_HELPERS                                                                                         \
	/* in the loop, as x is: the mapping belongs to each call */                                                   \
	LOBE_FN lobe_real approximations_artist(lobe_real x, lobe_real f0, lobe_real edge)                             \
	{                                                                                                              \
		const lobe_fresnel_index index = lobe_fresnel_artist(lobe_fma(LOBE_R(0x1p-60), x, f0), edge);          \
		return lobe_fresnel_conductor(x, index.n, index.k);                                                    \
	}                                                                                                              \
	/* without the branches of lobe_masking_g2_over_cos, which would keep a loop from vectorising */               \
	LOBE_FN lobe_real approximations_g2_plain(lobe_microsurface q, lobe_seen o, lobe_seen i, lobe_seen_facet m)    \
	{                                                                                                              \
		const lobe_real k = lobe_masking_width(q);                                                             \
		const lobe_real both = o.inv_length * i.cosine;                                                        \
		if (q.masking == LOBE_MASKING_VCAVITY)                                                                 \
			return lobe_masking_vcavity(o, i, m, 0);                                                       \
		if (q.masking == LOBE_MASKING_NONE)                                                                    \
			return LOBE_R(1.0) / o.z;                                                                      \
		if (q.masking == LOBE_MASKING_IMPLICIT)                                                                \
			return both;                                                                                   \
		if (q.masking == LOBE_MASKING_KELEMEN)                                                                 \
			return both / ((m.o / m.length2) * m.i);                                                       \
		if (q.masking == LOBE_MASKING_NEUMANN)                                                                 \
			return both / lobe_max(o.cosine, i.cosine);                                                    \
		if (q.masking == LOBE_MASKING_DISNEY)                                                                  \
			return both * lobe_masking_ggx(o, k) * lobe_masking_ggx(i, k);                                 \
		return both * lobe_masking_schlick(o, k) * lobe_masking_schlick(i, k);                                 \
	}                                                                                                              \
	LOBE_FN lobe_real approximations_g2(lobe_microsurface surface, lobe_uint masking, lobe_uint joint,             \
					    lobe_real oz, lobe_real ox, lobe_real iz, lobe_real ix, lobe_real iy)      \
	{                                                                                                              \
		const lobe_vec3 h = lobe_vec3_add(lobe_vec3_make(ox, LOBE_R(0.0), oz), lobe_vec3_make(ix, iy, iz));    \
		lobe_seen_facet m;                                                                                     \
		lobe_microsurface q = surface;                                                                         \
		q.distribution.ndf = LOBE_NDF_GGX;                                                                     \
		q.masking = masking;                                                                                   \
		m.length2 = lobe_dot(h, h);                                                                            \
		m.o = LOBE_R(0.5) * m.length2;                                                                         \
		m.i = LOBE_R(0.5) * m.length2;                                                                         \
		m.z = h.z;                                                                                             \
		const lobe_seen o = lobe_see(q, lobe_vec3_make(ox, LOBE_R(0.0), oz), LOBE_R(1.0));                     \
		const lobe_seen i = lobe_see(q, lobe_vec3_make(ix, iy, iz), LOBE_R(1.0));                              \
		if (masking == LOBE_MASKING_SMITH)                                                                     \
			return oz * lobe_masking_smith(joint, o, i);                                                   \
		return oz * approximations_g2_plain(q, o, i, m);                                                       \
	}                                                                                                              \
	LOBE_FN lobe_real approximations_g2_across(lobe_microsurface surface, lobe_uint across, lobe_real oz,          \
						   lobe_real ox, lobe_real iz, lobe_real ix, lobe_real iy)             \
	{                                                                                                              \
		lobe_microsurface q = surface;                                                                         \
		q.distribution.ndf = LOBE_NDF_GGX;                                                                     \
		const lobe_seen o = lobe_see(q, lobe_vec3_make(ox, LOBE_R(0.0), oz), LOBE_R(1.0));                     \
		const lobe_seen i = lobe_see(q, lobe_vec3_make(ix, iy, iz), LOBE_R(1.0));                              \
		return oz * lobe_masking_smith_across(across, o, i);                                                   \
	}

#endif
