#!/bin/sh
# opencl.sh - PoCL beside Intel's OpenCL runtime for processors, on the library's own kernels: build/bench/opencl with both.
# Where one of them cannot be had it says so.
cd "$(dirname "$0")/../.." || exit 1
. bench/peers/intel.sh
skip() {
	echo "bench-opencl: skipped: $1"
	exit 0
}

intel_opencl || skip "intel-opencl-rt cannot be had from PyPI here; build/others/intel.log"
pocl=$(cat /etc/OpenCL/vendors/pocl.icd 2>/dev/null) || skip "no PoCL here"
vendors=build/others/both
mkdir -p $vendors
echo "$pocl" >$vendors/0_pocl.icd
echo "$intel/lib/libintelocl.so" >$vendors/1_intel.icd
OCL_ICD_VENDORS=$PWD/$vendors LD_LIBRARY_PATH="$intel/lib" build/bench/opencl
