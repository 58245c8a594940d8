#!/bin/sh
# make LOBE_OPENCL=0 and LOBE_NATIVE=0: libraries without that backend say so, hold none of it, and shade with the other.
# (Loops are those of build/; all else is compiled anew.)
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/backends
mkdir -p $out

cat >$out/user.c <<'END'
#include <stdio.h>
#include <string.h>
#include "lobe/lobe.h"

/* user BACKEND OTHER: the library has BACKEND and not OTHER. */
int main(int argc, char **argv)
{
	const float z[3] = {0.6f, 0.7f, 0.8f};
	float pdf[3];
	size_t count = 7;
	lobe_device *device = NULL;
	lobe_scene *scene;
	lobe_bsdf white = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1)));
	lobe_batch batch = {.count = 3, .wo = {z, z, z}, .wi = {z, z, z}, .pdf = pdf};
	if (argc != 3)
		return 2;
	if (lobe_device_count(argv[2], &count) != LOBE_OK || count != 0)
		return 3;
	if (lobe_device_open(&device, argv[2]) != LOBE_ERROR_DEVICE || device)
		return 4;
	printf("%s\n", lobe_error_message());
	if (!strstr(lobe_error_message(), "built without") || !strstr(lobe_error_message(), "=0"))
		return 5;
	if (strcmp(argv[2], "opencl") == 0 && (lobe_opencl_source()[0] || lobe_device_cl(NULL, NULL, NULL, NULL) == LOBE_OK))
		return 6;
	if (lobe_device_open(&device, argv[1]) != LOBE_OK) {
		printf("%s\n", lobe_error_message());
		return 77;
	}
	if (lobe_scene_create(&scene, device, &white, 1) != LOBE_OK || lobe_scene_eval(scene, &batch) != LOBE_OK ||
	    pdf[1] != lobe_lambert_pdf(white.as.lambert, lobe_vec3_make(z[1], z[1], z[1]), lobe_vec3_make(z[1], z[1], z[1])))
		return 8;
	lobe_scene_destroy(scene);
	lobe_device_close(device);
	return 0;
}
END

# builds NAME SWITCH
builds() { make -s -j2 B="$out/$1" ROW_DIR=build/obj CC="$CC" CFLAGS=-O1 "$2=0" "$out/$1/liblobe.a" "$out/$1/liblobe.so"; }

# without NAME PATTERN: no object of that backend, and no symbol of its functions, is in the library.
without() {
	! ar t "$out/$1/liblobe.a" | grep -v none | grep -E "$2"
}

# uses NAME BACKEND OTHER
uses() {
	# shellcheck disable=SC2086
	$CC $warnings $exact -Iinclude $out/user.c "$out/$1/liblobe.a" -o "$out/$1/user" -lm -ldl -lpthread &&
		"$out/$1/user" "$2" "$3"
}

text() { size "$1" | awk 'NR == 2 { print $1 }'; }

# A library without OpenCL is smaller by the source's text at least, one without native loops by the loops.
smaller() {
	less=$(($(text build/liblobe.so) - $(text "$out/$1/liblobe.so")))
	echo "$1: $less bytes of text less of $(text build/liblobe.so)"
	[ $less -gt "$2" ]
}

check "LOBE_OPENCL=0 builds" builds no_opencl LOBE_OPENCL
check "LOBE_OPENCL=0: no OpenCL in the library" without no_opencl 'opencl'
check "LOBE_OPENCL=0: opening opencl says so, native shades" uses no_opencl native opencl
check "LOBE_OPENCL=0: smaller" smaller no_opencl 20000
check "LOBE_NATIVE=0 builds" builds no_native LOBE_NATIVE
check "LOBE_NATIVE=0: no loop in the library" without no_native 'rows|native|linked'
uses no_native opencl native >$out/said 2>&1
case $? in
0) pass "LOBE_NATIVE=0: opening native says so, OpenCL shades" ;;
77) skip "LOBE_NATIVE=0: opening native says so" "no OpenCL device here: $(tail -n 1 $out/said)" ;;
*) fail "LOBE_NATIVE=0: opening native says so, OpenCL shades" "$(cat $out/said)" ;;
esac
check "LOBE_NATIVE=0: smaller" smaller no_native 20000
check "neither is refused" sh -c '! make -s LOBE_NATIVE=0 LOBE_OPENCL=0 2>/dev/null'

# The test can fail: the whole library does not pass for one without.
mkdir -p $out/whole && cp build/liblobe.a $out/whole/
uses whole native opencl >/dev/null 2>&1 && fail "notices a library with both" "" || pass "notices a library with both"
finish
