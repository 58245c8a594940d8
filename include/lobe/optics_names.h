/* optics_names.h - the measured materials of core/optics.h by name (C only). */
#ifndef LOBE_OPTICS_NAMES_H
#define LOBE_OPTICS_NAMES_H

#include "backend/api.h"
#include "core/optics.h"

#ifdef __cplusplus
extern "C" {
#endif

/* "gold" for LOBE_METAL_GOLD; NULL when there is no such metal. */
LOBE_API const char *lobe_metal_name(uint32_t metal);

/* LOBE_METAL_GOLD for "gold"; LOBE_METAL_COUNT for NULL or a name that is not in the table. */
LOBE_API uint32_t lobe_metal_find(const char *name);

/* "bk7" for LOBE_GLASS_BK7; NULL when there is no such glass. */
LOBE_API const char *lobe_glass_name(uint32_t glass);

/* LOBE_GLASS_BK7 for "bk7"; LOBE_GLASS_COUNT for NULL or a name that is not in the table. */
LOBE_API uint32_t lobe_glass_find(const char *name);

#ifdef __cplusplus
}
#endif

#endif
