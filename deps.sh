#!/bin/sh
# deps.sh - installs what a target needs: through apt on Debian and its kin, and Unity for the tests.
#
#	deps.sh run     the demo: OpenCL on the processor (PoCL), image files, random numbers
#	deps.sh test    that, and what the tests compare with
#	deps.sh all     that, and what bench and check use
#	deps.sh probes  light probes for the report and the gallery, into build/probes: none come with lobe
#
# Does nothing, and asks no network, when all is there. Without apt it names what is missing and goes on.
set -eu
cd "$(dirname "$0")"

run="gcc libc6-dev pkg-config pocl-opencl-icd ocl-icd-libopencl1 ocl-icd-opencl-dev opencl-headers libopenexr-dev libpng-dev librandom123-dev"
test="$run g++ clang libgsl-dev libmpfr-dev"
all="$test gnuplot-nox cppcheck"

case ${1:-all} in
run) wanted=$run ;;
test) wanted=$test ;;
all) wanted=$all ;;
probes) wanted= ;;
*)
	echo "usage: deps.sh run|test|all|probes" >&2
	exit 2
	;;
esac

as_root() {
	if [ "$(id -u)" = 0 ]; then
		"$@"
	elif command -v sudo >/dev/null; then
		sudo "$@"
	else
		echo "deps: need root for: $*" >&2
		return 1
	fi
}

install_packages() {
	if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
		echo "deps: no apt here; lobe's demo and tests need the equivalent of: $wanted"
		return 0
	fi
	missing=
	for package in $wanted; do
		case $(dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null || true) in
		ii*) ;;
		*) missing="$missing $package" ;;
		esac
	done
	[ -n "$missing" ] || return 0
	echo "deps: installing through apt:$missing"
	as_root apt-get update -qq
	# shellcheck disable=SC2086
	as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >build/deps.log 2>&1 || {
		tail -n 20 build/deps.log >&2
		echo "deps: apt-get install failed; the whole log is build/deps.log" >&2
		return 1
	}
}

# --- Unity, the unit test framework, as Debian's source package cjson carries it ---------------------------------------

# unity_internals.h includes ../examples/unity_config.h, so that comes along.
unity=tests/vendor/unity
unity_sums="\
c3d7d8f48c9dfb38a4cbaabc2d30a0a5335d2bdd8b454fd70326876e90133299  ../examples/unity_config.h
a89aaeeaebb8a9f8b9379493592c1a8a135ece211d48128752d2c4c49724690a  unity.c
2d356dcffe0f8d887ece0ad8d5cd0d388aeef5482800a7b8fea6d415be8bcf1f  unity.h
874c2af0bcebead08d0f609f77e2306a735ba55205b7776d937120cb616d4304  unity_internals.h"

unity_is_there() {
	[ -f $unity/unity.c ] && (cd $unity && echo "$unity_sums" | sha256sum -c --strict --status - 2>/dev/null)
}

# The machine's own mirror, asked for sources. Its lists go to a folder of ours: the system's settings stay as they are.
fetch_unity() {
	if ! command -v apt-get >/dev/null; then
		echo "deps: no apt here; put unity.c, unity.h and unity_internals.h (Unity 2.5) into $unity" >&2
		return 1
	fi
	echo "deps: fetching Unity from Debian's source package cjson into $unity"
	work=$(mktemp -d)
	trap 'rm -rf "$work"' EXIT
	mkdir -p "$work/lists/partial" "$work/parts" $unity $unity/../examples
	for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
		[ -f "$list" ] && sed -n 's/^deb /deb-src /p' "$list"
	done >"$work/parts/source.list"
	for list in /etc/apt/sources.list.d/*.sources; do
		[ -f "$list" ] && sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/parts/$(basename "$list")"
	done
	options="-o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts=$work/parts -o Dir::State::Lists=$work/lists -o APT::Sandbox::User=root"
	here=$(pwd)
	# shellcheck disable=SC2086
	(cd "$work" && apt-get $options update -qq && apt-get $options source -qq --download-only cjson) >build/deps.log 2>&1 || {
		tail -n 20 build/deps.log >&2
		echo "deps: could not fetch the source package cjson" >&2
		return 1
	}
	for file in src/unity.c src/unity.h src/unity_internals.h examples/unity_config.h; do
		to=$here/$unity/$(basename $file)
		[ $file != examples/unity_config.h ] || to=$here/$unity/../$file
		tar -xOf "$work"/cjson_*.orig.tar.* --wildcards "*/tests/unity/$file" >"$to"
	done
	unity_is_there || {
		echo "deps: $unity is not the Unity that the tests were written for (SHA-256 differs)" >&2
		return 1
	}
}

# --- light probes, by Greg Zaal, CC0, as Debian's package blender-data carries them ---------------------------------------

# Eight of 31 MB, of which nothing is installed. Without network or apt the report goes on without.
fetch_probes() {
	ls build/probes/*.exr >/dev/null 2>&1 && return 0
	if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
		echo "deps: no apt here, so no light probes; LOBE_REPORT_PROBES names some of your own"
		return 0
	fi
	echo "deps: fetching light probes from Debian's package blender-data (31 MB, once) into build/probes"
	work=$(mktemp -d)
	trap 'rm -rf "$work"' EXIT
	from=usr/share/blender/datafiles/studiolights/world
	options="-qq -o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o APT::Sandbox::User=root"
	download() { (cd "$work" && apt-get $options download blender-data); }
	# Where apt's lists are missing they are fetched first.
	{ { download || { as_root apt-get $options update && download; }; } && dpkg-deb -x "$work"/blender-data_*.deb "$work"; } \
		>build/deps.log 2>&1 || {
		tail -n 3 build/deps.log
		echo "deps: could not fetch them (offline?): no real light probes; LOBE_REPORT_PROBES names some of your own"
		return 0
	}
	mkdir -p build/probes
	cp "$work/$from"/*.exr "$work/$from"/license.txt build/probes/
}

mkdir -p build
install_packages
case ${1:-all} in
probes) fetch_probes ;;
test | all) unity_is_there || fetch_unity ;;
esac
