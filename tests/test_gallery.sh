#!/bin/sh
# The gallery from its command line: pictures that are there and the same on every device, files it reads and refuses,
# exit codes and messages.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/gallery
rm -rf $out
mkdir -p $out

# gallery DIRECTORY OPTION...: a small picture into it.
gallery() {
	directory=$out/$1
	shift
	build/gallery --size 64x48 --spp 2 --reference 0 --out "$directory" "$@"
}

pictures() { begins_with "$out/$1/gallery.png" 89504e470d0a1a0a && begins_with "$out/$1/gallery.exr" 762f3101; }

# same DIRECTORY DIRECTORY: their EXR files, byte by byte.
same() { cmp "$out/$1/gallery.exr" "$out/$2/gallery.exr"; }

# no_pixel_differs LOG: the table has a line at least, and 0 in each one's column of differing pixels.
no_pixel_differs() {
	cat "$1"
	awk 'NF > 6 && $1 $2 ~ /^[0-9.]+$/ { n++; bad += $6 != "0" } END { exit !(n > 0 && bad == 0) }' "$1"
}

native() { gallery native --device native >$out/native.log 2>&1 && no_pixel_differs $out/native.log && pictures native; }
check "native renders" native

all_devices() {
	gallery all >$out/all.log 2>&1 || {
		cat $out/all.log
		return 1
	}
	no_pixel_differs $out/all.log && pictures all && same native all
}
check "all devices render the same" all_devices

threads() { gallery threads-1 --device native:1 && gallery threads-3 --device native:3 && same threads-1 threads-3 && same native threads-1; }
check "1 and 3 threads give the same" threads

baseline() { LOBE_ISA=baseline gallery baseline --device native && same native baseline; }
check "LOBE_ISA=baseline gives the same" baseline

list() { gallery list --device native:2,native >$out/list.log 2>&1 && no_pixel_differs $out/list.log && [ "$(grep -c ' native' $out/list.log)" -ge 2 ]; }
check "a list of devices" list

errors() { build/gallery --size 80x80 --spp 1 --reference 2 --device native --out $out/errors >$out/errors.log && grep -q 'relative MSE' $out/errors.log; }
check "--reference prints the table of errors" errors

probe() { gallery probe --device native --probe $out/native/gallery.exr && pictures probe && ! same native probe; }
check "its own EXR lights the scene" probe

helps() { build/gallery --help >$out/help.log && grep -q '^usage: gallery' $out/help.log; }
check "--help" helps

check "unknown option" refused 2 --colour gallery refused --colour red
check "option without a value" refused 2 --spp gallery refused --spp
check "size 0" refused 2 "--size 0x0" gallery refused --size 0x0
check "size that is no size" refused 2 "--size 64" gallery refused --size 64
check "0 samples" refused 2 "--spp 0" gallery refused --spp 0
check "unknown device" refused 2 toaster gallery refused --device toaster
check "unknown device in a list" refused 2 toaster gallery refused --device native,toaster
check "OpenCL device that is not there" refused 2 opencl:99 gallery refused --device opencl:99
check "0 threads" refused 2 native:0 gallery refused --device native:0

check "missing file" refused 1 $out/missing.exr gallery refused --device native --probe $out/missing.exr
head -c 2000 $out/native/gallery.exr >$out/truncated.exr
check "truncated EXR" refused 1 $out/truncated.exr gallery refused --device native --probe $out/truncated.exr
head -c 40 $out/native/gallery.exr >$out/header.exr
check "EXR cut in its header" refused 1 $out/header.exr gallery refused --device native --probe $out/header.exr
check "a file that is no EXR" refused 1 $out/native/gallery.png gallery refused --device native --probe $out/native/gallery.png
: >$out/empty.exr
check "empty file" refused 1 $out/empty.exr gallery refused --device native --probe $out/empty.exr
check "--out below a file" refused 1 $out/empty.exr gallery empty.exr/pictures --device native
mkdir -p $out/png/gallery.png $out/exr/gallery.exr
check "PNG that cannot be written" refused 1 $out/png/gallery.png gallery png --device native
check "EXR that cannot be written" refused 1 $out/exr/gallery.exr gallery exr --device native

# OpenCL devices that lobe refuses: one that is not asked for by name is left out. They are real devices that deny,
# through a preloaded dlsym, that they divide as they should.
cat >$out/deny.c <<'END'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdint.h>
#include <string.h>

enum { SINGLE_FP_CONFIG = 0x101B, CORRECTLY_ROUNDED_DIVIDE_SQRT = 1 << 7 };
static int32_t (*real_info)(void *, uint32_t, size_t, void *, size_t *);

static int32_t info(void *device, uint32_t what, size_t size, void *value, size_t *needed)
{
	const int32_t error = real_info(device, what, size, value, needed);
	if (error == 0 && what == SINGLE_FP_CONFIG && value)
		*(uint64_t *)value &= ~(uint64_t)CORRECTLY_ROUNDED_DIVIDE_SQRT;
	return error;
}

void *dlsym(void *library, const char *name)
{
	static const char *const versions[] = {"GLIBC_2.34", "GLIBC_2.17", "GLIBC_2.2.5"};
	void *(*real)(void *, const char *) = NULL;
	for (int i = 0; i < 3 && !real; i++)
		*(void **)&real = dlvsym(RTLD_NEXT, "dlsym", versions[i]);
	if (strcmp(name, "clGetDeviceInfo"))
		return real(library, name);
	*(void **)&real_info = real(library, name);
	return (void *)info;
}
END
deny() { LD_PRELOAD=$PWD/$out/deny.so "$@"; }
skips() {
	deny build/gallery --size 64x48 --spp 2 --reference 0 --out $out/skips >$out/skips.log 2>&1 && no_pixel_differs $out/skips.log &&
		grep '^skipped: opencl:0: .*correctly rounded division' $out/skips.log && same native skips
}
batch_skips() { deny build/batch >$out/batch.log && cat $out/batch.log && grep '^skipped: opencl:0: .*correctly rounded division' $out/batch.log && grep '^native' $out/batch.log; }
if ! gallery opencl --device opencl >$out/opencl.log 2>&1; then
	skip "OpenCL devices that lobe refuses" "no OpenCL device here"
elif ! $CC -shared -fPIC $out/deny.c -o $out/deny.so -ldl 2>$out/deny.log || ! deny build/gallery --help >$out/deny.log 2>&1; then
	skip "OpenCL devices that lobe refuses" "no way to preload dlsym here"
else
	check "refused OpenCL devices are skipped" skips
	check "named ones are errors" refused 2 opencl:0 deny build/gallery --device native,opencl:0 --out $out/refused
	check "build/batch skips them too" batch_skips
fi
finish
