#!/bin/sh
# check.sh - `make check`: static analysis by clang and cppcheck, then the tests under the sanitizers.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
mkdir -p build/tests

# Its "garbage value" checks are off: they do not follow an array that another function fills, an OpenCL call say.
analyze() {
	for file in src/*.c examples/*.c; do
		extra=
		case $file in src/rows.c | src/linked.c) extra="-DLOBE_ROW=ggx_dielectric -DLOBE_ROW_ISA=test" ;; esac
		# shellcheck disable=SC2086
		clang --analyze --analyzer-output text -Xclang -analyzer-werror \
			-Xclang -analyzer-disable-checker=core.CallAndMessage,core.UndefinedBinaryOperatorResult,core.uninitialized \
			-std=c99 -DLOBE_X86 $extra -Iinclude -Isrc "$file" -o build/tests/analysis || return 1
	done
}

# Style findings are left out: a shading function that is unused in one file is not a fault. cppcheck loses count of
# lobes.def, so that arrays over the lobes have no elements for it, and tries a file of the double build without its
# switch.
inspect() {
	cppcheck --quiet --std=c99 --enable=warning,portability,performance --inline-suppr --error-exitcode=1 \
		--suppress=missingIncludeSystem --suppress=zerodiv:bench/report/stability_sweep.c \
		--suppress=uninitvar:bench/report/stability_errors.c \
		--suppress=preprocessorErrorDirective:bench/report/approximations_double.c \
		-DLOBE_X86 -DLOBE_ROW=ggx_dielectric -DLOBE_ROW_ISA=test -UPARAMS \
		-Iinclude -Isrc src cl/embed.c examples bench
}

echo "clang's analyzer ..."
if command -v clang >/dev/null; then check "clang --analyze" analyze; else skip "clang --analyze" "no clang here"; fi
echo "cppcheck ..."
if command -v cppcheck >/dev/null; then check cppcheck inspect; else skip cppcheck "no cppcheck here"; fi
finish
status=$?
[ "${1:-}" = quick ] && exit $status
echo "sanitizers (a minute or two) ..."
sh tests/test_sanitize.sh || status=1
exit $status
