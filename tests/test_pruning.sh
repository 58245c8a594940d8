#!/bin/sh
# What a scene or a program does not use costs it nothing: a lobe added to a copy of the sources changes neither the OpenCL
# program of a scene without it nor the executable of a C user of another lobe; and a program that lists its lobes
# (lobe/link.h) holds the loops of no other.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/pruning
rm -rf $out
mkdir -p $out/old $out/new
lobes=$(sed -n 's/^LOBE_X[A-Z_]*.[A-Z0-9_]*, \([a-z0-9_]*\),.*/\1/p' include/lobe/lobes/lobes.def)
upper() { echo "$1" | tr a-z A-Z; }

cp -r include cl $out/old/
cp -r include cl $out/new/

# The hundredth lobe: all that a lobe adds to what users and OpenCL compile.
add_lobe() {
	lists=$out/new/include/lobe
	sed 's/lambert/hundredth/g; s/LAMBERT/HUNDREDTH/g' include/lobe/lobes/lambert.h >$lists/lobes/hundredth.h
	sed -i 's|^#undef LOBE_X_TABLED|#if LOBE_HAS_HUNDREDTH\nLOBE_X(HUNDREDTH, hundredth, 255)\n#endif\n&|' $lists/lobes/lobes.def
	sed -i '$s|^#endif|#if LOBE_HAS_HUNDREDTH\n#include "hundredth.h"\n#endif\n&|' $lists/lobes/lobes.h
	sed -i '0,/^#ifndef LOBE_HAS_LAMBERT/s||#ifndef LOBE_HAS_HUNDREDTH\n#define LOBE_HAS_HUNDREDTH LOBE_HAS_DEFAULT\n#endif\n&|' $lists/config.h
	sed -i 's|(LOBE_HAS_LAMBERT |(LOBE_HAS_HUNDREDTH \&\& LOBE_HAS_LAMBERT |' $lists/config.h
	grep -q HUNDREDTH $lists/lobes/lobes.def && grep -q HUNDREDTH $lists/lobes/lobes.h &&
		[ "$(grep -c HUNDREDTH $lists/config.h)" = 3 ]
}
check "a lobe is added to a copy of the headers" add_lobe

# --- OpenCL ---

# text TREE: the source and kernels as the library of that tree would hold them, to TREE/program.cl.
text() {
	(cd "$out/$1" && "$root/build/embed" include/lobe/shading.h source cl/kernels.cl kernels) >"$out/$1/text.c" &&
		printf '#include <stdio.h>\nconst char *source(void), *kernels(void);\nint main(void) { return printf("%%s%%s", source(), kernels()) < 0; }\n' >"$out/$1/print.c" &&
		$CC "$out/$1/text.c" "$out/$1/print.c" -o "$out/$1/print" && "$out/$1/print" >"$out/$1/program.cl"
}
root=$PWD
both_texts() { text old && text new; }
check "program text of both" both_texts

# What an OpenCL compiler compiles, with the options that follow.
program() {
	tree=$1
	shift
	$CC -E -P -x c -D__OPENCL_VERSION__=120 "$@" "$out/$tree/program.cl"
}

# These are the options of such a scene.
cat >$out/options.c <<'END'
#include <stdio.h>
#include "lobe/lobe.h"
int main(void)
{
	lobe_device *device;
	lobe_scene *scene;
	lobe_bsdf white = lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1)));
	if (lobe_device_open(&device, "native:1") != LOBE_OK || lobe_scene_create(&scene, device, &white, 1) != LOBE_OK)
		return 1;
	printf("%s", lobe_opencl_options(scene));
	return 0;
}
END
scene_options() {
	$CC $exact -Iinclude $out/options.c build/liblobe.a -o $out/options -lm -ldl -lpthread && $out/options | tr ' ' '\n' |
		grep '^-D' >$out/options.txt
	printf '%s\n' -DLOBE_HAS_DEFAULT=0 -DLOBE_HAS_LAMBERT=1 | cmp - $out/options.txt
}
check "options of a scene" scene_options

same_program() {
	program old -DLOBE_HAS_DEFAULT=0 "-DLOBE_HAS_$(upper "$1")=1" >$out/old.cl && program new -DLOBE_HAS_DEFAULT=0 "-DLOBE_HAS_$(upper "$1")=1" >$out/new.cl &&
		grep -q "lobe_kernel_$1_sample_one" $out/old.cl && cmp $out/old.cl $out/new.cl
}
for lobe in $lobes; do
	check "$lobe: the same OpenCL program" same_program "$lobe"
done
program old >$out/old.cl && program new >$out/new.cl
if cmp -s $out/old.cl $out/new.cl; then fail "notices the lobe in a program of all" "no difference"; else pass "notices the lobe in a program of all"; fi

# --- C users ---

# user TREE FLAGS...: stripped executable of $out/user.c.
user() {
	tree=$1
	shift
	# shellcheck disable=SC2086
	(cd "$out/$tree" && $CC -std=c99 -O2 $exact -Iinclude "$@" -s ../user.c -o user -lm)
}
preprocessed() {
	tree=$1
	shift
	(cd "$out/$tree" && $CC -std=c99 -Iinclude "$@" -E -P ../user.c -o user.i && [ -s user.i ])
}
same_executable() {
	cat >$out/user.c <<END
#include "lobe/$1"
static volatile $2 given;
int main(void)
{
	const $2 p = given;
	const lobe_vec3 w = lobe_vec3_make(LOBE_R(0.0), LOBE_R(0.6), LOBE_R(0.8));
	return (int)($2_sample(p, w, w).event + (lobe_uint)$2_pdf(p, w, w) + (lobe_uint)$2_eval(p, w, w).g);
}
END
	shift 2
	# What the compiler gets is the same to the letter (it is, but for lines and file names): so is what it makes of it.
	[ -z "$compile" ] && preprocessed old "$@" && preprocessed new "$@" && cmp -s $out/old/user.i $out/new/user.i ||
		{ user old "$@" && user new "$@" && cmp $out/old/user $out/new/user; }
}
# One is compiled in any case.
compile=yes
check "lambert: the same executable of a user, compiled" same_executable lobes/lambert.h lobe_lambert
compile=
for lobe in $lobes; do
	check "$lobe: the same executable of a user" same_executable "lobes/$lobe.h" "lobe_$lobe"
	check "$lobe: the same executable of a user of lobe_bsdf" same_executable shading.h lobe_bsdf -DLOBE_HAS_DEFAULT=0 \
		"-DLOBE_HAS_$(upper "$lobe")=1"
done
if same_executable shading.h lobe_bsdf >/dev/null; then fail "notices the lobe in lobe_bsdf" "no difference"; else pass "notices the lobe in lobe_bsdf"; fi

# --- programs with liblobe.a ---

cat >$out/linked.c <<'END'
#include <string.h>
#include "lobe/lobe.h"
int main(void)
{
	lobe_device *device;
	lobe_scene *scene = NULL;
	lobe_bsdf m[2] = {lobe_bsdf_from_lambert(lobe_lambert_make(lobe_rgb_make(1, 1, 1))),
			  lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(0.3f, 0.2f, 1.5f))};
	const float z[1] = {0.8f};
	float pdf[1];
	lobe_batch batch = {.count = 1, .wo = {z, z, z}, .wi = {z, z, z}, .pdf = pdf};
	if (lobe_device_open(&device, "native") != LOBE_OK || lobe_scene_create(&scene, device, m, 1) != LOBE_OK ||
	    lobe_scene_eval(scene, &batch) != LOBE_OK)
		return 1;
	lobe_scene_destroy(scene);
	if (lobe_scene_create(&scene, device, m, 2) == LOBE_OK)
		return 2;
	return !strstr(lobe_error_message(), "lobe_ggx_dielectric is not linked");
}
END
printf '#define LOBE_HAS_DEFAULT 0\n#define LOBE_HAS_LAMBERT 1\n#include "lobe/link.h"\n' >$out/list.c

# link NAME FILE...: unstripped, to look at its symbols.
link() {
	name=$1
	shift
	# shellcheck disable=SC2086
	$CC $warnings $exact -O2 -Iinclude "$@" build/liblobe.a -o "$out/$name" -lm -ldl -lpthread
}
loops_of() { nm "$out/$1" | sed -n 's/.* lobe_linked_\([a-z0-9_]*\)$/\1/p' | sort; }

check "a program lists its lobes" link few $out/linked.c $out/list.c
only_its_own() { [ "$(loops_of few)" = lambert ] && ! nm $out/few | grep -E 'lobe_rows_[a-z0-9]*_' | grep -v _lambert; }
check "it holds their loops alone" only_its_own
check "it shades with them and names what is missing" $out/few
check "a program without a list" link whole $out/linked.c
holds_all() { [ "$(loops_of whole)" = "$(echo "$lobes" | sort)" ]; }
check "it holds every lobe" holds_all
sizes() { size $out/few $out/whole && [ "$(size $out/few | awk 'NR == 2 { print $1 }')" -lt "$(size $out/whole | awk 'NR == 2 { print $1 }')" ]; }
check "it is larger" sizes
$out/whole
[ $? = 2 ] && pass "it shades with every lobe" || fail "it shades with every lobe" "exit status $?"
finish
