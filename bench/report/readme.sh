#!/bin/sh
# readme.sh - puts what the last report has for README.md between its two marks, and that part's pictures into doc/.
#
#	make readme	after make report
cd "$(dirname "$0")/../.." || exit 1
part=out/report/readme.md
begin='<!-- make readme: begin -->' end='<!-- make readme: end -->'

[ -s $part ] || {
	echo "readme: no $part here; make report writes it" >&2
	exit 1
}
grep -qxF "$begin" README.md && grep -qxF "$end" README.md || {
	echo "readme: README.md has lost its marks: $begin, $end" >&2
	exit 1
}
mkdir -p doc
rm -f doc/*.png
for picture in $(grep -o 'doc/[A-Za-z0-9_]*\.png' $part | sort -u); do
	cp "out/report/$(basename "$picture")" "$picture" || exit 1
done
awk -v begin="$begin" -v end="$end" -v part=$part '
	$0 == end { inside = 0 }
	!inside { print }
	$0 == begin { inside = 1; while ((getline line < part) > 0) print line }
' README.md >build/README.md && cat build/README.md >README.md && rm build/README.md
echo "README.md: $(grep -c '' $part) lines and $(ls doc/*.png | wc -l) pictures from the report"
