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

# begins_with FILE HEX
begins_with() {
	[ "$(head -c $((${#2} / 2)) "$1" | od -An -v -tx1 | tr -d ' \n')" = "$2" ] || {
		echo "$1 is not there or begins otherwise"
		return 1
	}
}

# refused CODE WORDS COMMAND...: exits with the code and says a line with the words on stderr. Its output goes to $out,
# a folder of the script's.
refused() {
	code=$1 words=$2
	shift 2
	"$@" >$out/refused.out 2>$out/refused.err
	status=$?
	cat $out/refused.err
	[ $status = "$code" ] || {
		echo "exit status $status, not $code"
		return 1
	}
	grep -qF -e "$words" $out/refused.err || {
		echo "nothing on stderr names $words"
		return 1
	}
}

finish() {
	echo "-----------------------"
	echo "$tests Tests $failures Failures $ignored Ignored"
	[ $failures = 0 ]
}
