# stability_map.gp - heat maps of one lobe over width and angle. MAP, TITLE, FILE: by stability.c.
set datafile separator comma
set terminal pngcairo size 1650, 980 noenhanced font "sans,12"
set output FILE
rows(verb) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\"' stability_maps.csv", MAP, verb)
set multiplot layout 2, 3 title TITLE." - eval (above) and pdf (below)" font "sans,15"
set xrange [-4.07:0.07]
set yrange [-7.2:0.2]
set xlabel "alpha"
set ylabel "cosine of the view angle"
set xtics ("1e-4" -4, "1e-3" -3, "1e-2" -2, "0.1" -1, "1" 0) out nomirror
set ytics ("1" 0, "0.1" -1, "1e-2" -2, "1e-3" -3, "1e-4" -4, "1e-5" -5, "1e-6" -6, "1e-7" -7) out nomirror
set palette defined (0 "#30123b", 1 "#4662d7", 2 "#36a9e1", 3 "#1ae4b6", 4 "#a4fc3c", 5 "#fabb39", 6 "#e4460a", 7 "#7a0403")
set cbtics format "%g"
set logscale cb
set colorbox
do for [verb in "eval pdf"] {
	set title verb.": worst error [ulp]"
	set cbrange [0.5:1e5]
	plot rows(verb) using (log10($3)):(log10($4)):($6 > 0 ? $6 : 0.5) with image notitle
	set title verb.": worst error over floor"
	set cbrange [0.001:100]
	plot rows(verb) using (log10($3)):(log10($4)):($8 > 0.001 ? $8 : 0.001) with image notitle
	set title verb.": the floor (median), relative"
	set cbrange [1e-8:1]
	plot rows(verb) using (log10($3)):(log10($4)):9 with image notitle
}
unset multiplot
