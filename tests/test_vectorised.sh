#!/bin/sh
# Every native row loop is vectorised, by gcc and by clang, for every instruction set: read off the compilers' own
# remarks. One loop that is not, for a branch or a call that somebody put into a lobe, fails.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/vectorised
mkdir -p $out

lobes=$(sed -n 's/^LOBE_X[A-Z_]*.[A-Z0-9_]*, \([a-z0-9_]*\),.*/\1/p' include/lobe/lobes/lobes.def)
lines=$(grep -n '^ROW_' src/rows.c | cut -d: -f1)

# widest COMPILER ISA-FLAGS: the vector that its remarks must name; gcc counts bytes, clang elements.
widest() {
	case $2 in
	*avx512*) bytes=64 ;;
	*avx2*) bytes=32 ;;
	*) bytes=16 ;;
	esac
	case $1 in
	*clang*) echo "width: $((bytes / 4))," ;;
	*) echo "using $bytes byte vectors" ;;
	esac
}

# remarks COMPILER ISA-FLAGS LOBE SOURCE: the line numbers of SOURCE with a loop vectorised to that width, compiled with
# the library's own options.
remarks() {
	case $1 in
	*clang*) report="-Rpass=loop-vectorize" ;;
	*) report="-fopt-info-vec-optimized" ;;
	esac
	flags=$(MAKEFLAGS= make -s --no-print-directory print-ROW_CFLAGS CC="$1")
	# shellcheck disable=SC2086
	"$1" $flags $2 $report -DLOBE_ROW="$3" -DLOBE_ROW_ISA=test -c "$4" -o $out/rows.o 2>&1 |
		awk -F: -v file="$(basename "$4")" -v width="$(widest "$1" "$2")" \
			'$1 ~ file "$" && /vectorized loop|loop vectorized/ && index($0, width) { print $2 }' | sort -un
}

# missing COMPILER ISA-FLAGS LOBE SOURCE: the ROW_ lines without one.
missing() {
	found=$(remarks "$@")
	for line in $lines; do
		echo "$found" | grep -qx "$line" || echo "line $line: $(sed -n "${line}p" src/rows.c)"
	done
}

if [ "$(uname -m)" != x86_64 ]; then
	skip vectorised "the instruction sets of this test are x86-64's"
	finish
	exit
fi
for compiler in gcc clang; do
	if ! command -v $compiler >/dev/null; then
		skip "$compiler" "no $compiler here"
		continue
	fi
	for isa in "" "-mavx2 -mfma" "-mavx2 -mfma -mavx512f -mavx512vl -mavx512dq -mavx512bw -mprefer-vector-width=512"; do
		for lobe in $lobes; do
			name="$compiler ${isa:-baseline}: $lobe"
			bad=$(missing $compiler "$isa" "$lobe" src/rows.c)
			if [ -z "$bad" ]; then
				pass "$name"
			else
				fail "$name" "not vectorised:"
				echo "$bad"
			fi
		done
	done
	# The test can fail: a loop with a call to libm in it is noticed.
	sed 's/pdf\[i\] = CALL(_pdf)(p, WO, WI_OR_U)/pdf[i] = lgammaf(ix[i])/' src/rows.c >$out/planted.c
	bad=$(missing $compiler "-mavx2 -mfma" lambert $out/planted.c)
	if echo "$bad" | grep -q EVAL_PDF; then
		pass "$compiler: notices a planted call"
	else
		fail "$compiler: notices a planted call" "it saw every loop vectorised"
	fi
done
finish
