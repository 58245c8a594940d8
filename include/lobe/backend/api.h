/* api.h - LOBE_API marks what the shared library shows; all else in it is hidden. */
#ifndef LOBE_BACKEND_API_H
#define LOBE_BACKEND_API_H

#ifdef __GNUC__
#define LOBE_API __attribute__((visibility("default")))
#else
#define LOBE_API
#endif

#endif
