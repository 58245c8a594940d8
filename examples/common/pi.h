/* pi.h - pi: math.h of C99 has none, and LOBE_PI is as precise as the lobes are. */
#ifndef COMMON_PI_H
#define COMMON_PI_H

#define PI 3.14159265358979323846

#endif
