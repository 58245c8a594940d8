#!/bin/sh
# opencl.sh - PoCL beside Intel's OpenCL runtime for processors, on the library's own kernels: sets the runtime up in
# build/others as tests/long_opencl_others.sh does, and runs build/bench/opencl with both. Where it cannot be had it says so.
cd "$(dirname "$0")/../.." || exit 1
intel=$PWD/build/others/intel
skip() {
	echo "bench-opencl: skipped: $1"
	exit 0
}

if ! [ -f "$intel/done" ]; then
	command -v python3 >/dev/null || skip "no python3 here"
	mkdir -p build/others
	echo "bench-opencl: installing intel-opencl-rt from PyPI into build/others/intel"
	python3 -m venv "$intel" >build/others/intel.log 2>&1 &&
		"$intel/bin/pip" install -q intel-opencl-rt intel-cmplr-lib-rt >>build/others/intel.log 2>&1 ||
		skip "intel-opencl-rt cannot be had; build/others/intel.log"
	touch "$intel/done"
fi
[ -f "$intel/lib/libintelocl.so" ] || skip "no libintelocl.so in $intel/lib"
pocl=$(cat /etc/OpenCL/vendors/pocl.icd 2>/dev/null) || skip "no PoCL here"
vendors=build/others/both
mkdir -p $vendors
echo "$pocl" >$vendors/0_pocl.icd
echo "$intel/lib/libintelocl.so" >$vendors/1_intel.icd
OCL_ICD_VENDORS=$PWD/$vendors LD_LIBRARY_PATH="$intel/lib" build/bench/opencl
