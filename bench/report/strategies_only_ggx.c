/* strategies_only_ggx.c - see strategies_only.h. */
#define LOBE_ONLY_NDF LOBE_NDF_GGX
#define COMPILED      strategies_only_ggx
#include "strategies_only.h"
