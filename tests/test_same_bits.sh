#!/bin/sh
# The library built by gcc and by clang gives the same bits: at -O2 with row loops at -O3, for each instruction set, and at
# -O1, where loops stay scalar, for the baseline. (The default build is one of them, and is not made again.)
# LOBE_TEST_LONG: at -O0 too, for each instruction set, which takes ten minutes.
# (Threads and OpenCL devices are compared within one build by test_equivalence.c.)
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/same_bits
mkdir -p $out

reference=$out/reference.txt
build/tests/tool_bits native:1 >$reference 2>$out/reference.device || {
	fail reference "tool_bits failed"
	cat $out/reference.device
	finish
	exit
}
[ "$(wc -l <$reference)" -gt 10 ] && pass "reference: $(cat $out/reference.device)" || fail reference "too few cases"

# compare NAME COMMAND...: the command prints what the reference printed.
compare() {
	name=$1
	shift
	"$@" >$out/got.txt 2>$out/got.device || {
		if grep -q 'has no such instructions' $out/got.device; then
			skip "$name" "this processor cannot"
		else
			fail "$name" "$(cat $out/got.device)"
		fi
		return
	}
	if cmp -s $reference $out/got.txt; then
		pass "$name: $(cat $out/got.device)"
	else
		fail "$name" "differs in $(diff $reference $out/got.txt | grep -c '^>') of $(wc -l <$reference) cases"
		diff $reference $out/got.txt | head -n 6
	fi
}

# built COMPILER OPTIMISATION: tool_bits and the whole library by another compiler, apart from build/.
built() {
	case $2 in
	-O2) set -- "$@" ROW_OPT=-O3 ;;
	-O1) set -- "$@" ROW_OPT=-O1 ISAS=baseline ;;
	*) set -- "$@" ROW_OPT="$2" ;;
	esac
	into=$1$2
	compiler=$1 optimisation=$2
	shift 2
	build "$into" CC="$compiler" CFLAGS="$optimisation" "$@" "$builds/$into/tests/tool_bits"
}

case $("$CC" --version 2>/dev/null) in
*clang*) default=clang ;;
*) default=gcc ;;
esac
for isa in baseline avx2 avx512; do
	compare "default build, $isa" env LOBE_ISA=$isa build/tests/tool_bits native:1
done
for compiler in gcc clang; do
	if ! command -v $compiler >/dev/null; then
		skip "$compiler" "no $compiler here"
		continue
	fi
	for optimisation in -O2 -O1 ${LOBE_TEST_LONG:+-O0}; do
		[ "$compiler$optimisation" != "$default-O2" ] || continue
		check "$compiler $optimisation builds" built $compiler $optimisation
		isas=baseline
		[ $optimisation = -O1 ] || isas="baseline avx2 avx512"
		for isa in $isas; do
			compare "$compiler $optimisation, $isa" env LOBE_ISA=$isa $builds/$compiler$optimisation/tests/tool_bits native:1
		done
	done
done

# The comparison can fail: one hash that is another is seen. (That one bit turns the hash, tool_bits.c has by design.)
sed 's/^0/1/' $reference >$out/planted.txt
cmp -s $reference $out/planted.txt && fail "notices a difference" "" || pass "notices a difference"
finish
