/* options.h - the command line. */
#ifndef GALLERY_OPTIONS_H
#define GALLERY_OPTIONS_H

#include <stdint.h>

struct options {
	const char *devices, *probe, *out;
	int width, height, bounces;
	uint32_t spp, reference;
	float rotate, exposure;
};

extern const char options_usage[];

/* Changes what the arguments name. 0, 1 for --help, or -1 after a complaint. */
int options_parse(struct options *o, int argc, char **argv);

/* "gallery: what: why" on stderr. Always -1. */
int complain(const char *what, const char *why);

#endif
