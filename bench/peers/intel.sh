# intel.sh - Intel's OpenCL runtime for processors (PyPI), set up aside in build/others/intel and not installed. To be read by
# scripts in the project's folder: intel_opencl succeeds where it is there, or can be fetched.
intel=$PWD/build/others/intel
intel_opencl() {
	if ! [ -f "$intel/done" ]; then
		command -v python3 >/dev/null || return 1
		mkdir -p "$PWD/build/others"
		echo "fetching intel-opencl-rt from PyPI into build/others/intel"
		python3 -m venv "$intel" >"$intel.log" 2>&1 &&
			"$intel/bin/pip" install -q intel-opencl-rt intel-cmplr-lib-rt >>"$intel.log" 2>&1 || return 1
		touch "$intel/done"
	fi
	[ -f "$intel/lib/libintelocl.so" ]
}
