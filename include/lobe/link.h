/* link.h - for programs that link liblobe.a and shade few kinds of lobe: takes the native loops of those lobes into the
 * program and leaves the others out. Include it in one C file, with the switches of config.h, and without batch.h:
 *
 *	#define LOBE_HAS_DEFAULT 0
 *	#define LOBE_HAS_LAMBERT 1
 *	#define LOBE_HAS_GGX_CONDUCTOR 1
 *	#include "lobe/link.h"
 *
 * All else stays as it is: the other files include lobe.h and see every lobe. On a native device a scene with a lobe
 * that was left out is a LOBE_ERROR_PARAMETER that names it. Without this file a program gets all loops. The shared
 * library always has them all: a program with this file does not link with it, so name the other, as by
 * -l:liblobe.a. A library built with LOBE_NATIVE=0 has none.
 *
 * How: the library finds its loops through the list lobe_linked, which stands alone in one of its objects. A program
 * that brings a list of its own keeps the linker from taking that object, and so all that only it refers to. */
#ifndef LOBE_LINK_H
#define LOBE_LINK_H

#include "config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The loops of one lobe: known to the library alone. */
struct lobe_linked;

#define LOBE_X(NAME, name, kind) extern const struct lobe_linked lobe_linked_##name;
#include "lobes/lobes.def"
#undef LOBE_X

extern const struct lobe_linked *const lobe_linked[];
const struct lobe_linked *const lobe_linked[] = {
#define LOBE_X(NAME, name, kind) &lobe_linked_##name,
#include "lobes/lobes.def"
#undef LOBE_X
	0};

#ifdef __cplusplus
}
#endif

#endif
