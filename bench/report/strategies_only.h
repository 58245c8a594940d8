/* strategies_only.h - estimates, densities and samples with the distribution and the strategy as constants, as a
 * production lobe of each would have them: what a technique costs when nothing is chosen at run time. Same bits as
 * strategies_estimate.
 *
 *	LOBE_ONLY_NDF	the distribution
 *	COMPILED	the table's name */
#define LOBE_FN           static inline __attribute__((always_inline))
#define LOBE_ONLY_MASKING LOBE_MASKING_SMITH
#define LOBE_ONLY_JOINT   LOBE_JOINT_HEIGHT
#define LOBE_ONLY_FRESNEL LOBE_FRESNEL_EXACT

#include "strategies_estimate.h"

#define ONLY(technique, strategy_)                                                                                     \
	static float estimate_##technique(const strategies_case *c, const float u[3], const float v[3])                \
	{                                                                                                              \
		lobe_microfacet_conductor p = c->lobe[strategy_];                                                      \
		p.strategy = strategy_;                                                                                \
		return strategies_by(c, technique, p, u, v);                                                           \
	}
#define ONLY_LOBE(strategy_)                                                                                           \
	ONLY(strategy_, strategy_)                                                                                     \
	static lobe_real pdf_##strategy_(const strategies_case *c, lobe_vec3 wi)                                       \
	{                                                                                                              \
		lobe_microfacet_conductor p = c->lobe[strategy_];                                                      \
		p.strategy = strategy_;                                                                                \
		return lobe_microfacet_conductor_pdf(p, c->wo, wi);                                                    \
	}                                                                                                              \
	static lobe_sample sample_##strategy_(const strategies_case *c, lobe_vec3 u)                                   \
	{                                                                                                              \
		lobe_microfacet_conductor p = c->lobe[strategy_];                                                      \
		p.strategy = strategy_;                                                                                \
		return lobe_microfacet_conductor_sample(p, c->wo, u);                                                  \
	}
#define EACH_LOBE(DO)                                                                                                  \
	DO(LOBE_STRATEGY_VISIBLE)                                                                                      \
	DO(LOBE_STRATEGY_UNIFORM)                                                                                      \
	DO(LOBE_STRATEGY_COSINE)                                                                                       \
	DO(LOBE_STRATEGY_NDF)                                                                                          \
	DO(LOBE_STRATEGY_VISIBLE_SLOPES)                                                                               \
	DO(LOBE_STRATEGY_VISIBLE_ELLIPSOID)                                                                            \
	DO(LOBE_STRATEGY_VISIBLE_CAP)                                                                                  \
	DO(LOBE_STRATEGY_BOUNDED_CAP)                                                                                  \
	DO(LOBE_STRATEGY_VCAVITY)                                                                                      \
	DO(LOBE_STRATEGY_HEMISPHERE)

EACH_LOBE(ONLY_LOBE)
ONLY(STRATEGIES_LIGHT, LOBE_STRATEGY_VISIBLE)
ONLY(STRATEGIES_BALANCE, LOBE_STRATEGY_VISIBLE)
ONLY(STRATEGIES_POWER, LOBE_STRATEGY_VISIBLE)
ONLY(STRATEGIES_BALANCE_BOUNDED, LOBE_STRATEGY_BOUNDED_CAP)

#define ESTIMATE(technique) [technique] = estimate_##technique,
#define PDF(strategy)       [strategy] = pdf_##strategy,
#define SAMPLE(strategy)    [strategy] = sample_##strategy,
const strategies_compiled COMPILED = {
	{EACH_LOBE(ESTIMATE) ESTIMATE(STRATEGIES_LIGHT) ESTIMATE(STRATEGIES_BALANCE) ESTIMATE(STRATEGIES_POWER)
		 ESTIMATE(STRATEGIES_BALANCE_BOUNDED)},
	{EACH_LOBE(PDF)},
	{EACH_LOBE(SAMPLE)},
};
