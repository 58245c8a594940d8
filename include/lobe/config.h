/* config.h - what is compiled. Every switch is always defined, as 0 or 1.
 *
 * LOBE_DOUBLE       1: lobe_real is double and core/real.h maps to libm (reference builds only)
 * LOBE_HAS_DEFAULT  what a lobe's switch is when nobody sets it
 * LOBE_HAS_<LOBE>   0 leaves the lobe out: its header, its place in lobe_bsdf, its kernels
 *
 * LOBE_ONLY_<CHOICE> where something is chosen at run time, the number of the one value that ever is: all others are
 * left out. Glass that is neither near eta = 1 nor beyond 2: LOBE_ONLY_DELTA and LOBE_ONLY_DENSE 0
 *
 * A scene of two lobes compiles with -DLOBE_HAS_DEFAULT=0 and one -DLOBE_HAS_<LOBE>=1 for each. */
#ifndef LOBE_CONFIG_H
#define LOBE_CONFIG_H

#ifndef LOBE_DOUBLE
#define LOBE_DOUBLE 0
#endif

#ifndef LOBE_HAS_DEFAULT
#define LOBE_HAS_DEFAULT 1
#endif

#ifndef LOBE_HAS_LAMBERT
#define LOBE_HAS_LAMBERT LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_GGX_CONDUCTOR
#define LOBE_HAS_GGX_CONDUCTOR LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_GGX_DIELECTRIC
#define LOBE_HAS_GGX_DIELECTRIC LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_BECKMANN_CONDUCTOR
#define LOBE_HAS_BECKMANN_CONDUCTOR LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_BECKMANN_DIELECTRIC
#define LOBE_HAS_BECKMANN_DIELECTRIC LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_GGX_SCHLICK
#define LOBE_HAS_GGX_SCHLICK LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_MIRROR
#define LOBE_HAS_MIRROR LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_SMOOTH_CONDUCTOR
#define LOBE_HAS_SMOOTH_CONDUCTOR LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_SMOOTH_DIELECTRIC
#define LOBE_HAS_SMOOTH_DIELECTRIC LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_THIN_DIELECTRIC
#define LOBE_HAS_THIN_DIELECTRIC LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_IRIDESCENT_CONDUCTOR
#define LOBE_HAS_IRIDESCENT_CONDUCTOR LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_IRIDESCENT_DIELECTRIC
#define LOBE_HAS_IRIDESCENT_DIELECTRIC LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_MICROFACET_CONDUCTOR
#define LOBE_HAS_MICROFACET_CONDUCTOR LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_MICROFACET_DIELECTRIC
#define LOBE_HAS_MICROFACET_DIELECTRIC LOBE_HAS_DEFAULT
#endif
#ifndef LOBE_HAS_MICROFACET_DIFFUSE
#define LOBE_HAS_MICROFACET_DIFFUSE LOBE_HAS_DEFAULT
#endif

/* The distributions of microfacet normals that those lobes need. */
#ifndef LOBE_HAS_NDF_GGX
#define LOBE_HAS_NDF_GGX                                                                                               \
	(LOBE_HAS_GGX_CONDUCTOR || LOBE_HAS_GGX_DIELECTRIC || LOBE_HAS_GGX_SCHLICK || LOBE_HAS_IRIDESCENT_CONDUCTOR || \
	 LOBE_HAS_IRIDESCENT_DIELECTRIC)
#endif
#ifndef LOBE_HAS_NDF_BECKMANN
#define LOBE_HAS_NDF_BECKMANN (LOBE_HAS_BECKMANN_CONDUCTOR || LOBE_HAS_BECKMANN_DIELECTRIC)
#endif

/* What the microfacet_* lobes choose, and what rough glass is (microfacet/dielectric.h). LOBE_ANY: it is not known. */
#define LOBE_ANY                   0xffffffffu
#define LOBE_CHOSEN(choice, only) ((only) == LOBE_ANY ? (choice) : (only))
#ifndef LOBE_ONLY_NDF
#define LOBE_ONLY_NDF LOBE_ANY
#endif
#ifndef LOBE_ONLY_MASKING
#define LOBE_ONLY_MASKING LOBE_ANY
#endif
#ifndef LOBE_ONLY_JOINT
#define LOBE_ONLY_JOINT LOBE_ANY
#endif
#ifndef LOBE_ONLY_ACROSS
#define LOBE_ONLY_ACROSS LOBE_ANY
#endif
#ifndef LOBE_ONLY_FRESNEL
#define LOBE_ONLY_FRESNEL LOBE_ANY
#endif
#ifndef LOBE_ONLY_STRATEGY
#define LOBE_ONLY_STRATEGY LOBE_ANY
#endif
#ifndef LOBE_ONLY_DELTA
#define LOBE_ONLY_DELTA LOBE_ANY
#endif
#ifndef LOBE_ONLY_DENSE
#define LOBE_ONLY_DENSE LOBE_ANY
#endif
/* Then the microfacet_* lobes choose nothing at run time. */
#define LOBE_ONLY_ONE                                                                                                  \
	(LOBE_ONLY_NDF != LOBE_ANY && LOBE_ONLY_MASKING != LOBE_ANY && LOBE_ONLY_JOINT != LOBE_ANY &&                  \
	 LOBE_ONLY_ACROSS != LOBE_ANY && LOBE_ONLY_FRESNEL != LOBE_ANY && LOBE_ONLY_STRATEGY != LOBE_ANY)

/* The linked library has every lobe; its lobe_bsdf is a union over them all. */
#define LOBE_HAS_ALL                                                                                                   \
	(LOBE_HAS_LAMBERT && LOBE_HAS_GGX_CONDUCTOR && LOBE_HAS_GGX_DIELECTRIC && LOBE_HAS_BECKMANN_CONDUCTOR &&       \
	 LOBE_HAS_BECKMANN_DIELECTRIC && LOBE_HAS_GGX_SCHLICK && LOBE_HAS_MIRROR && LOBE_HAS_SMOOTH_CONDUCTOR &&       \
	 LOBE_HAS_SMOOTH_DIELECTRIC && LOBE_HAS_THIN_DIELECTRIC && LOBE_HAS_IRIDESCENT_CONDUCTOR &&                    \
	 LOBE_HAS_IRIDESCENT_DIELECTRIC && LOBE_HAS_MICROFACET_CONDUCTOR && LOBE_HAS_MICROFACET_DIELECTRIC &&          \
	 LOBE_HAS_MICROFACET_DIFFUSE)

#endif
