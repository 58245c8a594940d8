/* strategies_only_beckmann.c - see strategies_only.h. */
#define LOBE_ONLY_NDF LOBE_NDF_BECKMANN
#define COMPILED      strategies_only_beckmann
#include "strategies_only.h"
