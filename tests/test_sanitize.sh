#!/bin/sh
# The library and its batch tests under AddressSanitizer and UndefinedBehaviorSanitizer: no report, no leak.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/sanitize

# PoCL and LLVM keep memory for the life of the process; a leak with lobe's code in its trace still counts.
mkdir -p $out
printf 'leak:libpocl\nleak:libLLVM\nleak:libOpenCL\nleak:libclang\nleak:libhwloc\n' >$out/suppressions

echo 'int main(void) { return 0; }' >$out/probe.c
if ! $CC -fsanitize=address,undefined $out/probe.c -o $out/probe 2>/dev/null || ! $out/probe; then
	skip sanitizers "$CC cannot build or run them here"
	finish
	exit
fi

# Row loops at -O1: with every local in memory they would be mostly checks, and compiled twenty times as long.
sanitized() {
	make -s -j2 B=$out ISAS=baseline ROW_OPT=-O1 CFLAGS="-O1 -g1 -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all" "$out/tests/$1"
}
# The leak checker itself may die, of threads that end while it looks: then it has found nothing, and is asked again.
clean() {
	for attempt in 1 2 3; do
		ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=$out/suppressions:print_suppressions=0 \
			UBSAN_OPTIONS=print_stacktrace=1 "$out/tests/$1" >$out/clean.log 2>&1
		status=$?
		cat $out/clean.log
		grep -q 'LeakSanitizer has encountered a fatal error' $out/clean.log || return $status
	done
	return 1
}

for program in test_device test_scene test_batch test_strides test_async test_vectors test_opencl test_opencl_none \
	test_opencl_faults test_opencl_cache test_opencl_cache_files test_opencl_all test_fallback test_core test_fma test_real \
	test_warp test_warp_density test_warp_inverse test_fresnel test_fresnel_schlick test_fresnel_conductor test_refract \
	test_ggx test_ggx_visible test_linear test_smith_leadr test_smith_integrals test_smith_extremes test_slopes \
	test_slopes_pyramid test_slopes_layers test_slopes_refused test_lobes_extremes test_lobes_parameters; do
	check "$program builds" sanitized $program
	check "$program runs clean" clean $program
done

# Data races in the thread pool and the devices.
raceless() {
	make -s -j2 B=$out/threads ISAS=baseline ROW_OPT=-O1 CFLAGS="-O1 -g1 -fsanitize=thread" "$out/threads/tests/$1" && "$out/threads/tests/$1" native
}
for program in test_device test_batch test_async; do check "$program has no data race" raceless $program; done

# A planted overflow is reported.
printf '#include <stdlib.h>\nint main(void) { volatile char *p = malloc(4); return p[4]; }\n' >$out/planted.c
$CC -fsanitize=address $out/planted.c -o $out/planted && if $out/planted >/dev/null 2>&1; then
	fail "notices a planted overflow" "it ran clean"
else
	pass "notices a planted overflow"
fi
finish
