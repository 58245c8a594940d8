/* strategies_only.h - estimates with the distribution and the strategy as constants, as a production lobe of each would have
 * them: what a technique costs when nothing is chosen at run time. Same bits as strategies_estimate.
 *
 *	LOBE_ONLY_NDF		the distribution
 *	ESTIMATES		the table's name */
#define LOBE_FN           static inline __attribute__((always_inline))
#define LOBE_ONLY_MASKING LOBE_MASKING_SMITH
#define LOBE_ONLY_JOINT   LOBE_JOINT_HEIGHT
#define LOBE_ONLY_FRESNEL LOBE_FRESNEL_EXACT

#include "strategies_estimate.h"

#define ONLY(technique, strategy_)                                                                                     \
	static float only_##technique(const strategies_case *c, const float u[3], const float v[3])                    \
	{                                                                                                              \
		lobe_microfacet_conductor p = c->lobe[strategy_];                                                      \
		p.strategy = strategy_;                                                                                \
		return strategies_by(c, technique, p, u, v);                                                           \
	}
#define EACH(DO)                                                                                                       \
	DO(LOBE_STRATEGY_VISIBLE, LOBE_STRATEGY_VISIBLE)                                                               \
	DO(LOBE_STRATEGY_UNIFORM, LOBE_STRATEGY_UNIFORM)                                                               \
	DO(LOBE_STRATEGY_COSINE, LOBE_STRATEGY_COSINE)                                                                 \
	DO(LOBE_STRATEGY_NDF, LOBE_STRATEGY_NDF)                                                                       \
	DO(LOBE_STRATEGY_VISIBLE_SLOPES, LOBE_STRATEGY_VISIBLE_SLOPES)                                                 \
	DO(LOBE_STRATEGY_VISIBLE_ELLIPSOID, LOBE_STRATEGY_VISIBLE_ELLIPSOID)                                           \
	DO(LOBE_STRATEGY_VISIBLE_CAP, LOBE_STRATEGY_VISIBLE_CAP)                                                       \
	DO(LOBE_STRATEGY_BOUNDED_CAP, LOBE_STRATEGY_BOUNDED_CAP)                                                       \
	DO(LOBE_STRATEGY_VCAVITY, LOBE_STRATEGY_VCAVITY)                                                               \
	DO(LOBE_STRATEGY_HEMISPHERE, LOBE_STRATEGY_HEMISPHERE)                                                         \
	DO(STRATEGIES_LIGHT, LOBE_STRATEGY_VISIBLE)                                                                    \
	DO(STRATEGIES_BALANCE, LOBE_STRATEGY_VISIBLE)                                                                  \
	DO(STRATEGIES_POWER, LOBE_STRATEGY_VISIBLE)                                                                    \
	DO(STRATEGIES_BALANCE_BOUNDED, LOBE_STRATEGY_BOUNDED_CAP)

EACH(ONLY)

#define ENTRY(technique, strategy_) [technique] = only_##technique,
strategies_estimator *const ESTIMATES[STRATEGIES_TECHNIQUES] = {EACH(ENTRY)};
