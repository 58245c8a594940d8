# unit.sh - sourced by test scripts: counts in Unity's format.
tests=0 failures=0 ignored=0
me=$(basename "$0")
CC=${CC:-cc}
# The warnings that the library promises to be free of.
warnings="-std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Werror"
exact="-ffp-contract=off -fno-math-errno -fno-trapping-math"

# Other builds of the library, which scripts share: one makes a build, the others wait and use it. Without flock each makes
# its own.
builds=build/tests/builds
command -v flock >/dev/null || builds=$builds.$me

# build NAME WHAT...: make WHAT with B=$builds/NAME.
build() {
	made=$builds/$1
	shift
	mkdir -p "$made"
	if command -v flock >/dev/null; then
		flock "$made/lock" make -s -j2 B="$made" "$@"
	else
		make -s -j2 B="$made" "$@"
	fi
}

pass() {
	tests=$((tests + 1))
	echo "$me:$1:PASS"
}

fail() {
	tests=$((tests + 1)) failures=$((failures + 1))
	echo "$me:$1:FAIL: ${2:-}"
}

skip() {
	tests=$((tests + 1)) ignored=$((ignored + 1))
	echo "$me:$1:IGNORE: $2"
}

# check NAME COMMAND...: passes when the command does; shows what it printed when it does not.
check() {
	name=$1
	shift
	if said=$("$@" 2>&1); then
		pass "$name"
	else
		fail "$name" "$*"
		printf '%s\n' "$said" | head -n 40
	fi
}

finish() {
	echo "-----------------------"
	echo "$tests Tests $failures Failures $ignored Ignored"
	[ $failures = 0 ]
}
