#!/bin/sh
# What the sources promise: no warning from gcc and clang, C++17, one lobe by itself, no libm call in a row loop, nothing
# linked but libc, lists complete.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/sources
mkdir -p $out
lobes=$(sed -n 's/^LOBE_X[A-Z_]*.[A-Z0-9_]*, \([a-z0-9_]*\),.*/\1/p' include/lobe/lobes/lobes.def)

# all_sources COMPILER: every C file of the library, and the examples that need nothing else.
all_sources() {
	for file in src/*.c build/gen/opencl_source.c cl/embed.c examples/minimal.c examples/batch.c; do
		extra=
		case $file in src/rows.c | src/linked.c) extra="-DLOBE_ROW=ggx_dielectric -DLOBE_ROW_ISA=test" ;; esac
		# shellcheck disable=SC2086
		"$1" $warnings $exact -O2 -fPIC -Iinclude -Isrc -DLOBE_X86 $extra -c "$file" -o $out/object.o || return 1
	done
}

cplusplus() {
	printf '#include "lobe/lobe.h"\nint main() { return lobe_status_string(LOBE_OK) == nullptr; }\n' >$out/all.cpp
	"$1" -std=c++17 -pedantic -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Werror -Iinclude -c $out/all.cpp -o $out/all.o &&
		"$1" $out/all.o build/liblobe.a -o $out/all -lm -ldl -lpthread && $out/all
}

# one_lobe COMPILER LOBE: its header by itself, and in single and double precision.
one_lobe() {
	printf '#include "lobe/lobes/%s.h"\nlobe_%s p;\nint main(void) { return 0; }\n' "$2" "$2" >$out/one.c
	# With all lobes switched on, and with this one alone, as a scene's program has it.
	alone="-DLOBE_HAS_DEFAULT=0 -DLOBE_HAS_$(echo "$2" | tr a-z A-Z)=1"
	for option in -DLOBE_DOUBLE=0 -DLOBE_DOUBLE=1 "$alone"; do
		# shellcheck disable=SC2086
		"$1" $warnings -O2 -Iinclude $option $out/one.c -o $out/one -lm || return 1
	done
}

# every_header COMPILER: each header is complete by itself, but for the parts of core/real.h.
every_header() {
	for header in include/lobe/*.h include/lobe/core/*.h include/lobe/microfacet/*.h include/lobe/lobes/*.h; do
		! head -n 1 "$header" | grep -q 'a part of real.h' || continue
		# shellcheck disable=SC2086
		printf '#include "%s"\ntypedef int something;\n' "${header#include/}" | "$1" $warnings -Iinclude -x c -c - -o $out/header.o || return 1
	done
}

for compiler in gcc clang; do
	if ! command -v $compiler >/dev/null; then
		skip "$compiler" "no $compiler here"
		continue
	fi
	check "$compiler: library without a warning" all_sources $compiler
	check "$compiler: each header by itself" every_header $compiler
	for lobe in $lobes; do
		check "$compiler: $lobe by itself" one_lobe $compiler "$lobe"
	done
done
# OpenCL's compilers write such a warning to the standard error of whoever makes a scene. What a program may be compiled
# for: all, one lobe, and of what that chooses the first or another value.
printf '#include <stdio.h>\nconst char *lobe_opencl_source(void), *lobe_opencl_kernels(void);\nint main(void) { return printf("%%s%%s", lobe_opencl_source(), lobe_opencl_kernels()) < 0; }\n' >$out/program.c
cc $out/program.c build/gen/opencl_source.c -Iinclude -o $out/program && $out/program >$out/program.cl
choices() { sed -n "s/^#define LOBE_ONLY_\([A-Z]*\) LOBE_ANY\$/-DLOBE_ONLY_\1=$1/p" include/lobe/config.h; }
program() {
	for option in "-DLOBE_LOOPS=1 -DLOBE_MIXED=1" "-DLOBE_LOOPS=0 -DLOBE_MIXED=1" "-DLOBE_LOOPS=1 -DLOBE_MIXED=0 $(choices 0u)" \
		"-DLOBE_LOOPS=1 -DLOBE_MIXED=0 $(choices 1u)"; do
		# shellcheck disable=SC2086
		clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Werror $option "$@" $out/program.cl || return 1
	done
}
if command -v clang >/dev/null; then
	check "what lobes choose is found" test "$(choices 0u | grep -c .)" -ge 8
	check "OpenCL program of all lobes without a warning" program
	for lobe in $lobes; do
		check "OpenCL program of $lobe without a warning" program -DLOBE_HAS_DEFAULT=0 "-DLOBE_HAS_$(echo "$lobe" | tr a-z A-Z)=1"
	done
else
	skip "OpenCL programs" "no clang here"
fi
for compiler in g++ clang++; do
	if command -v $compiler >/dev/null; then
		check "$compiler: headers as C++17" cplusplus $compiler
	else
		skip "$compiler" "no $compiler here"
	fi
done

# memset is where the zeros of a delta lobe's eval and pdf end up.
no_calls() {
	[ "$(nm build/obj/rows_*.o | grep -c "_loop")" -ge 10 ] || return 1
	! nm -u build/obj/rows_*.o | grep -vE '^$|\.o:$|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail| memset$' | grep .
}
check "row loops call nothing" no_calls

# The shared library needs libc and its parts alone.
needs_only_libc() {
	readelf -d build/liblobe.so | grep -q "libc.so" || return 1
	! readelf -d build/liblobe.so | grep NEEDED | grep -vE 'lib(c|m|dl|pthread)\.so|ld-linux'
}
check "the library links with libc alone" needs_only_libc

# No compiler is asked for outside backend/.
no_ifdefs() { ! grep -rnE '#\s*(if|ifdef|ifndef|elif).*(__GNUC__|__clang__|__OPENCL|_MSC_VER|__cplusplus)' include/lobe/core include/lobe/microfacet include/lobe/lobes include/lobe/bsdf.h include/lobe/shading.h; }
check "no compiler switch outside backend/" no_ifdefs

# Each header in lobes/ stands in lobes.def, lobes.h and config.h.
listed() {
	# Long definitions go over several lines.
	sed -e :a -e '/\\$/N; s/\\\n//; ta' include/lobe/config.h >$out/config
	for header in include/lobe/lobes/*.h; do
		name=$(basename "$header" .h)
		[ "$name" != lobes ] || continue
		upper=$(echo "$name" | tr a-z A-Z)
		grep -Eq "^LOBE_X(_TABLED)?\($upper, $name, [0-9]*\)" include/lobe/lobes/lobes.def &&
			grep -q "\"$name.h\"" include/lobe/lobes/lobes.h &&
			grep -q "define LOBE_HAS_$upper LOBE_HAS_DEFAULT" $out/config &&
			grep -q "define LOBE_HAS_ALL .*LOBE_HAS_$upper" $out/config || {
			echo "$name is not listed everywhere"
			return 1
		}
	done
}
check "every lobe is in every list" listed

# The shared library shows what the headers declare with LOBE_API, and nothing else.
shows_its_api() {
	nm -D --defined-only build/liblobe.so | awk '{ print $3 }' | sort >$out/shown
	sed -n 's/^LOBE_API .*[ *]\(lobe_[a-z_]*\)(.*/\1/p' include/lobe/*.h | sort >$out/declared
	[ -s $out/shown ] && diff $out/shown $out/declared
}
check "the shared library shows its API alone" shows_its_api

# Options that would break the bits, or the layout of lobe_bsdf, are refused.
refuses() { ! printf '#include "lobe/lobe.h"\nint x;\n' | $CC -std=c99 -Iinclude "$@" -x c -c - -o $out/refused.o 2>/dev/null; }
check "refuses -ffast-math" refuses -ffast-math

# Processors with half precision, in GNU mode: FLT_EVAL_METHOD is 16, and float is float all the same.
half_precision() { printf '#include "lobe/lobe.h"\nint x;\n' | $CC -std=gnu17 -march=sapphirerapids -Iinclude -fsyntax-only -x c -; }
if $CC -march=sapphirerapids -E -x c /dev/null >/dev/null 2>&1; then
	check "headers for a processor with half precision" half_precision
else
	skip "half precision" "the compiler knows no such processor"
fi

# windows.h has these for macros.
windows() { printf '#define near\n#define far\n#define small char\n#include "lobe/lobe.h"\nint x;\n' | $CC -std=c99 -Iinclude -fsyntax-only -x c -; }
check "headers after windows.h" windows
check "refuses batches without every lobe" refuses -DLOBE_HAS_LAMBERT=0

# README's C program builds without a warning and runs. (Its kernel: test_opencl.c.)
readme() {
	sed -n '/^```c$/,/^```$/p' README.md | sed '1d;$d' >$out/readme.c
	# shellcheck disable=SC2086
	$CC $warnings $exact -Iinclude $out/readme.c build/liblobe.a -o $out/readme -lm -ldl -lpthread && $out/readme
}
check "README's program" readme

installs() {
	rm -rf $out/root
	make -s install DESTDIR="$PWD/$out/root" PREFIX=/usr || return 1
	# One function of the library, and one of the headers, whose root is one of libm.
	cat >$out/user.c <<-'END'
		#include <lobe/lobe.h>
		int main(int argc, char **argv)
		{
			const lobe_vec3 wo = lobe_vec3_make(0.0f, 0.6f * (float)argc, 0.8f);
			const lobe_ggx_dielectric glass = lobe_ggx_dielectric_make(0.1f, 0.1f, 1.5f);
			(void)argv;
			return lobe_metal_find("gold") != LOBE_METAL_GOLD || !(lobe_ggx_dielectric_pdf(glass, wo, wo) > 0.0f);
		}
	END
	flags=$(PKG_CONFIG_PATH=$out/root/usr/lib/pkgconfig pkg-config --define-variable=prefix="$PWD/$out/root/usr" --cflags --libs lobe) || return 1
	# shellcheck disable=SC2086
	$CC $out/user.c $flags -o $out/user && LD_LIBRARY_PATH=$out/root/usr/lib $out/user
}
check "make install, pkg-config, link and run" installs
uninstalls() {
	make -s uninstall DESTDIR="$PWD/$out/root" PREFIX=/usr && ! find $out/root ! -type d | grep . || return 1
	# To another folder for libraries, which lobe.pc then names.
	make -s install DESTDIR="$PWD/$out/root" PREFIX=/usr LIBDIR=/usr/lib/here && [ -f $out/root/usr/lib/here/liblobe.a ] &&
		grep -qx 'libdir=${prefix}/lib/here' $out/root/usr/lib/here/pkgconfig/lobe.pc || return 1
	make -s uninstall DESTDIR="$PWD/$out/root" PREFIX=/usr LIBDIR=/usr/lib/here && ! find $out/root ! -type d | grep .
}
check "make uninstall leaves nothing" uninstalls
finish
