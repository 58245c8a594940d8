#!/bin/sh
# Other OpenCL implementations than the machine's own, set up aside in build/others and run by long_opencl_others.c: Intel's
# runtime for processors (PyPI), Oclgrind with its checks of races, uninitialised memory and API calls, and Mesa's rusticl on
# llvmpipe (Debian). None is installed; rusticl's one data package must be, and is when we are root. What cannot be had is
# skipped.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
. bench/peers/intel.sh
out=$PWD/build/others
test=build/tests/long_opencl_others
mkdir -p "$out"

# unpack FOLDER PACKAGE...: Debian packages and what they depend on, without the C library.
unpack() {
	folder=$1
	shift
	[ ! -f "$folder/done" ] || return 0
	command -v apt-get >/dev/null && command -v dpkg >/dev/null || return 1
	mkdir -p "$folder/deb"
	needed=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances "$@" |
		grep '^[a-z0-9]' | grep -vE '^(libc6|libgcc-s1|libstdc\+\+6|libcrypt1|gcc-.*-base|ocl-icd-libopencl1)$')
	# shellcheck disable=SC2086
	(cd "$folder/deb" && apt-get download -q $needed) >"$folder/log" 2>&1 || return 1
	for package in "$folder"/deb/*.deb; do dpkg -x "$package" "$folder" || return 1; done
	touch "$folder/done"
}

# only FOLDER LIBRARY: the one implementation that the loader finds.
only() {
	mkdir -p "$1/vendors"
	echo "$2" >"$1/vendors/only.icd"
	export OCL_ICD_VENDORS="$1/vendors"
}

# run NAME VARIABLE=VALUE...: the test, which has seen an implementation of that name and found nothing wrong.
run() {
	name=$1
	shift
	env "$@" $test >"$out/$name.said" 2>&1
	cat "$out/$name.said"
	grep -q ' 0 Failures' "$out/$name.said" && grep -qi "opencl:0, .*$name" "$out/$name.said"
}

if intel_opencl; then
	# It does not promise correct rounding on every processor, and rounds correctly.
	run_intel() {
		only "$intel" "$intel/lib/libintelocl.so"
		run intel LD_LIBRARY_PATH="$intel/lib" LOBE_OTHERS_EXACT=1
	}
	check "Intel's OpenCL runtime: the same bits" run_intel
else
	skip "Intel's OpenCL runtime" "intel-opencl-rt cannot be had from PyPI here"
fi

if unpack "$out/oclgrind" oclgrind; then
	# A simulator, so few elements; unoptimised, since it does not know every intrinsic. What it finds goes to the log.
	run_oclgrind() {
		rm -f "$out/oclgrind.found"
		only "$out/oclgrind" "$out/oclgrind/usr/lib/oclgrind/liboclgrind-rt-icd.so"
		run oclgrind LD_LIBRARY_PATH="$(echo "$out"/oclgrind/usr/lib/*-linux-gnu)" LOBE_OTHERS_EXACT=1 LOBE_OTHERS_COUNT=2000 \
			OCLGRIND_BUILD_OPTIONS=-cl-opt-disable OCLGRIND_DATA_RACES=1 OCLGRIND_UNINITIALIZED=1 OCLGRIND_CHECK_API=1 \
			OCLGRIND_LOG="$out/oclgrind.found" || return 1
		! [ -s "$out/oclgrind.found" ] || ! cat "$out/oclgrind.found"
	}
	check "Oclgrind: the same bits, no race, nothing uninitialised" run_oclgrind
else
	skip Oclgrind "apt cannot download oclgrind here"
fi

clc=$(apt-cache depends mesa-opencl-icd 2>/dev/null | sed -n 's/.*Depends: \(libclc-[0-9]*\)$/\1/p' | head -n 1)
has_clc() { ls /usr/lib/clc/spirv*-mesa3d-.spv >/dev/null 2>&1; }
if [ -n "$clc" ] && ! has_clc && [ "$(id -u)" = 0 ]; then
	echo "installing $clc"
	apt-get install -y -qq --no-install-recommends "$clc" >"$out/clc.log" 2>&1
fi
if ! has_clc; then
	skip rusticl "it needs the data of ${clc:-libclc}: apt-get install ${clc:-libclc}"
elif unpack "$out/rusticl" mesa-opencl-icd; then
	# It promises no exact arithmetic: that it is refused is the test. (Made to shade all the same, version 22.3
	# leaves results of copied batches missing after clFinish, which PoCL, Intel's runtime and Oclgrind do not.)
	run_rusticl() {
		lib=$(echo "$out"/rusticl/usr/lib/*-linux-gnu)
		only "$out/rusticl" "$lib/libRusticlOpenCL.so.1"
		run rusticl LD_LIBRARY_PATH="$lib" RUSTICL_ENABLE=llvmpipe && grep -q '^refused: .*rusticl' "$out/rusticl.said"
	}
	check "rusticl on llvmpipe: refused, with a reason" run_rusticl
else
	skip rusticl "apt cannot download mesa-opencl-icd here"
fi
grep -hE 'differ$|^refused|taken at' "$out"/*.said 2>/dev/null
finish
