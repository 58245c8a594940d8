#!/bin/sh
# Every native row loop is vectorised, by gcc and by clang, for every instruction set: read off the compilers' own
# accounts, which the Makefile has them write beside the objects. One loop that is not, for a branch or a call that somebody
# put into a lobe, fails; so does an account that is missing or older than its object's sources.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/vectorised
mkdir -p $out

lobes=$(sed -n 's/^LOBE_X[A-Z_]*.[A-Z0-9_]*, \([a-z0-9_]*\),.*/\1/p' include/lobe/lobes/lobes.def)
# Those that choose at run time call what they choose (LOBE_FN_APART); they are for comparison.
apart="microfacet_conductor microfacet_dielectric microfacet_diffuse"
for lobe in $apart; do
	lobes=$(echo "$lobes" | grep -vx "$lobe")
done

# lines LOBE: those of its loops in rows.c. A delta lobe's eval and pdf store zeros, which compilers do without a loop.
lines() {
	rows='^ROW_'
	! grep -q 'eval and pdf are 0' "include/lobe/lobes/$1.h" || rows='^ROW_SAMPLE'
	grep -n "$rows" src/rows.c | cut -d: -f1
}

# print VARIABLE: as the Makefile has it for $compiler.
print() { MAKEFLAGS= make -s --no-print-directory "print-$1" CC="$compiler"; }

# vectorised ACCOUNT SOURCE BYTES: the line numbers of SOURCE with a loop vectorised to that width. gcc writes a line a loop,
# clang a list of records, and counts elements.
vectorised() {
	awk -v file="$2" -v bytes="$3" '
		index($0, file ":") == 1 && /loop vectorized/ && index($0, "using " bytes " byte vectors") { split($0, at, ":"); print at[2] }
		/^---/ { passed = /!Passed/; line = 0 }
		/^DebugLoc:/ && index($0, file) { line = $0; sub(/.*Line: /, "", line); sub(/,.*/, "", line) }
		/VectorizationFactor:/ { gsub("\047", ""); if (passed && line && $NF == bytes / 4) print line }' "$1" | sort -un
}

# missing LOBE ACCOUNT SOURCE BYTES: the ROW_ lines without one.
missing() {
	[ -s "$2" ] || echo "$2 is missing"
	found=$(vectorised "$2" "$3" "$4")
	for line in $(lines "$1"); do
		echo "$found" | grep -qx "$line" || echo "line $line: $(sed -n "${line}p" src/rows.c)"
	done
}

if [ "$(uname -m)" != x86_64 ]; then
	skip vectorised "the instruction sets of this test are x86-64's"
	finish
	exit
fi
case $("$CC" --version 2>/dev/null) in
*clang*) default=clang ;;
*) default=gcc ;;
esac
for compiler in gcc clang; do
	if ! command -v $compiler >/dev/null; then
		skip "$compiler" "no $compiler here"
		continue
	fi
	# The default compiler's objects are those of the library; the other's those of test_same_bits.sh.
	dir=build options=CC=$CC
	[ $compiler = $default ] || dir=$builds/$compiler-O2 options="CC=$compiler CFLAGS=-O2 ROW_OPT=-O3"
	objects=$(for isa in baseline avx2 avx512; do for lobe in $lobes; do echo "$dir/obj/rows_${isa}_$lobe.o"; done; done)
	# shellcheck disable=SC2086
	[ $compiler = $default ] || check "$compiler: row loops build" build $compiler-O2 $options $objects
	# shellcheck disable=SC2086
	check "$compiler: row loops are up to date" make -q -s B=$dir $options $objects
	for isa in baseline avx2 avx512; do
		case $isa in
		avx512) bytes=64 ;;
		avx2) bytes=32 ;;
		*) bytes=16 ;;
		esac
		for lobe in $lobes; do
			name="$compiler $isa: $lobe"
			bad=$(missing "$lobe" "$dir/obj/rows_${isa}_$lobe.vec" src/rows.c $bytes)
			if [ -z "$bad" ]; then
				pass "$name"
			else
				fail "$name" "not vectorised:"
				echo "$bad"
			fi
		done
	done
	# The test can fail: a loop with a call to libm in it is noticed, and an account that is not there.
	sed 's/pdf\[i\] = CALL(_pdf)(p, WO, WI_OR_U)/pdf[i] = lgammaf(ix[i])/' src/rows.c >$out/planted.c
	# shellcheck disable=SC2046
	$compiler $(print ROW_CFLAGS) $(print ISA_avx2) "$(print ROW_REPORT)$out/planted.vec" -DLOBE_ROW=lambert -DLOBE_ROW_ISA=test \
		-c $out/planted.c -o $out/planted.o
	bad=$(missing lambert $out/planted.vec $out/planted.c 32)
	if echo "$bad" | grep -q EVAL_PDF && ! echo "$bad" | grep -q SAMPLE; then
		pass "$compiler: notices a planted call"
	else
		fail "$compiler: notices a planted call" "not vectorised, it says: $bad"
	fi
	[ -n "$(missing lambert $out/none.vec src/rows.c 32 2>/dev/null)" ] && pass "$compiler: notices a missing account" ||
		fail "$compiler: notices a missing account" ""
done
finish
