/* constants.h - pi and what is made of it, to more digits than a double holds. */
#ifndef LOBE_CORE_CONSTANTS_H
#define LOBE_CORE_CONSTANTS_H

#include "../backend/backend.h"

#define LOBE_PI     LOBE_R(3.14159265358979323846)
#define LOBE_2PI    LOBE_R(6.28318530717958647693)
#define LOBE_INV_PI LOBE_R(0.318309886183790671538)

#endif
