#!/bin/sh
# The height-field example from its command line: pictures that are there, moments that come out as prescribed, fits that
# show what they should, files and arguments it refuses.
cd "$(dirname "$0")/.." || exit 1
. tests/unit.sh
out=build/tests/heightfield
rm -rf $out
mkdir -p $out

# heightfield DIRECTORY OPTION...: small pictures into it.
heightfield() {
	directory=$out/$1
	shift
	build/heightfield --texels 512 --size 64 --spp 8 --out "$directory" "$@"
}

runs() {
	heightfield plain >$out/plain.log 2>&1 || {
		cat $out/plain.log
		return 1
	}
	for field in gaussian ggx; do
		begins_with $out/plain/$field.exr 762f3101 && begins_with $out/plain/$field-normals.png 89504e470d0a1a0a &&
			begins_with $out/plain/$field-balls.png 89504e470d0a1a0a || return 1
	done
}
check "writes its pictures" runs

# What is measured is what differences of texels should see, to 2 % of a width; the second field's patches are few.
moments() {
	cat $out/plain.log
	awk -v allowed="$1" -v field="$2" '
		$1 == field ":" { mine = 1; next }
		/^[a-z]+: / { mine = 0 }
		mine && /as differences/ { for (k = 0; k < 5; k++) want[k] = $(NF - k) }
		mine && /^measured/ { n++; for (k = 0; k < 5; k++) { d = $(NF - k) - want[k]; bad += d > allowed || d < -allowed } }
		mine && /^last level/ { n++; for (k = 0; k < 5; k++) { d = $(NF - k) - want[k]; bad += d > allowed || d < -allowed } }
		END { exit !(n == 2 && bad == 0) }' $out/plain.log
}
check "moments of the Gaussian field as prescribed" moments 0.002 gaussian
check "moments of the GGX-like field as prescribed" moments 0.05 ggx

# columns of the two lines of differences: wanted (normals alone), Beckmann, GGX by moments, GGX by median [%].
differences() {
	awk -v field="$1" '
		$1 == field ":" { mine = 1; next }
		/^[a-z]+: / { mine = 0 }
		mine && /normals, share/ { gsub("%", ""); print $(NF - 3), $(NF - 2), $(NF - 1), $NF }
		mine && /ball, mean/ { gsub("%", ""); print 0, $(NF - 2), $(NF - 1), $NF }' $out/plain.log
}
gaussian_is_beckmann() { differences gaussian | awk '{ print; n++; bad += $2 > 6 || $3 < 2 * $2 || $4 < 2 * $2 } END { exit !(n == 2 && bad == 0) }'; }
check "Gaussian field: Beckmann is the nearest, by normals and by light" gaussian_is_beckmann
ggx_is_ggx() { differences ggx | awk '{ print; n++; bad += $4 > 10 || $2 < 1.5 * $4 || $3 < 1.5 * $4 } END { exit !(n == 2 && bad == 0) }'; }
check "GGX-like field: GGX by its median is the nearest" ggx_is_ggx

again() { heightfield again >/dev/null 2>&1 && for f in "$out"/plain/*; do cmp "$f" "$out/again/$(basename "$f")" || return 1; done; }
check "the same once more" again

helps() { build/heightfield --help >$out/help.log && grep -q '^usage: heightfield' $out/help.log; }
check "--help" helps

# pictures OPTION...: where they are not looked at.
pictures() { build/heightfield --out $out/refused "$@"; }
check "unknown option" refused 2 --colour pictures --colour red
check "option without a value" refused 2 --spp pictures --spp
check "texels that are no power of 2" refused 2 "--texels 100" pictures --texels 100
check "0 samples" refused 2 "--spp 0" pictures --spp 0
check "size that is no number" refused 2 "--size x" pictures --size x
: >$out/file
check "--out below a file" refused 1 $out/file pictures --out $out/file/pictures
mkdir -p $out/exr/gaussian.exr $out/png/gaussian-normals.png
check "EXR that cannot be written" refused 1 $out/exr/gaussian.exr pictures --texels 64 --spp 1 --size 16 --out $out/exr
check "PNG that cannot be written" refused 1 $out/png/gaussian-normals.png pictures --texels 64 --spp 1 --size 16 --out $out/png
finish
