/* native_list.c - every lobe, for programs without a list of their own. Nothing else may be here: see link.h. */
#include "lobe/link.h"
