/* options.c - see options.h. */
#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char options_usage[] =
	"usage: gallery [OPTION]...\n"
	"Renders a gallery of materials on each device and compares the devices.\n\n"
	"  --device NAME[,NAME...]  native, native:N, opencl, opencl:N ... or all (default)\n"
	"  --spp N                  samples a pixel, 1 to 65536 (default 64)\n"
	"  --size WxH               pixels, 16x16 to 8192x8192 (default 640x480)\n"
	"  --probe FILE.exr         light from a lat-long picture instead of the studio\n"
	"  --rotate DEG             turn the light about the vertical\n"
	"  --exposure EV            stops, for the PNG alone (default 0)\n"
	"  --bounces N              surfaces a path scatters at, 1 to 64 (default 10)\n"
	"  --reference N            samples of the error table's reference (default 1024); 0: no table\n"
	"  --out DIR                where gallery.png and gallery.exr go (default out)\n"
	"  --help                   this text\n\n"
	"Exit status: 0 success; 1 failure, or devices whose pictures differ; 2 bad arguments.\n";

int complain(const char *what, const char *why)
{
	fprintf(stderr, "gallery: %s%s%s\n", what, why[0] ? ": " : "", why);
	return -1;
}

static int parse_integer(const char *text, long low, long high, long *value, const char **end)
{
	char *stop;
	errno = 0;
	*value = strtol(text, &stop, 10);
	*end = stop;
	return stop != text && text[0] != ' ' && errno == 0 && *value >= low && *value <= high;
}

static int parse_float(const char *text, float limit, float *value)
{
	char *stop;
	*value = strtof(text, &stop);
	return stop != text && !*stop && *value >= -limit && *value <= limit;
}

int options_parse(struct options *o, int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		const char *name = argv[i], *end = "";
		char what[256];
		long n = 0, m = 0;
		int ok = 1;
		if (!strcmp(name, "--help"))
			return 1;
		static const char *const names[] = {"--device",   "--spp",     "--size",      "--probe", "--rotate",
						    "--exposure", "--bounces", "--reference", "--out"};
		size_t k = 0;
		while (k < sizeof names / sizeof names[0] && strcmp(name, names[k]))
			k++;
		if (k == sizeof names / sizeof names[0])
			return complain(name, "unknown argument; --help lists them");
		if (++i == argc)
			return complain(name, "needs a value");
		const char *value = argv[i];
		switch (k) {
		case 0:
			o->devices = value;
			break;
		case 1:
			ok = parse_integer(value, 1, 65536, &n, &end) && !*end;
			o->spp = (uint32_t)n;
			break;
		case 2:
			ok = parse_integer(value, 16, 8192, &n, &end) && *end == 'x' &&
			     parse_integer(end + 1, 16, 8192, &m, &end) && !*end;
			o->width = (int)n;
			o->height = (int)m;
			break;
		case 3:
			o->probe = value;
			break;
		case 4:
			ok = parse_float(value, 1e5f, &o->rotate);
			break;
		case 5:
			ok = parse_float(value, 30.0f, &o->exposure);
			break;
		case 6:
			ok = parse_integer(value, 1, 64, &n, &end) && !*end;
			o->bounces = (int)n;
			break;
		case 7:
			ok = parse_integer(value, 0, 1 << 20, &n, &end) && !*end;
			o->reference = (uint32_t)n;
			break;
		default:
			ok = value[0] != '\0';
			o->out = value;
		}
		if (!ok) {
			snprintf(what, sizeof what, "%s %s", name, value);
			return complain(what, "not a value this option takes; --help says which");
		}
	}
	return 0;
}
