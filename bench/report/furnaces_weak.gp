# furnaces_weak.gp - the weak furnace, a map for each pair of distribution and masking. Runs in out/report.
load "furnaces_weak_titles.gp"
set terminal pngcairo size 1640, 1450 noenhanced font "sans,11"
set tics out nomirror
set xtics 0.2
unset key
set xlabel "roughness sqrt(alpha)" offset 0, 0.5
set ylabel "cosine of the view" offset 1.5
set xrange [0.04:1]
set yrange [0:1]
set output "furnaces_weak_own.png"
set palette defined (0 "#ffffff", 1 "#c6dbef", 2 "#4292c6", 3 "#fdae61", 4 "#d73027", 5 "#67000d")
set logscale cb
set cbrange [1e-8:1e-3]
set format cb "%.0e"
set multiplot layout 4, 4 title "|weak furnace - 1|: the facets seen are as large as the mean plane" font "sans,13"
do for [k = 1:|OWN|] {
	set title OWN[k] offset 0, -0.6
	plot "furnaces_weak_own.dat" index k - 1 using 1:2:3 with image
}
unset multiplot

set terminal pngcairo size 1800, 760 noenhanced font "sans,11"
set output "furnaces_weak_others.png"
unset logscale cb
set format cb "%g"
set palette defined (-1 "#08306b", -0.6667 "#2b7bba", -0.3333 "#a6cde4", -0.08 "#eef5fb", 0 "#ffffff", \
	0.08 "#fff0ea", 0.3333 "#fcae91", 0.6667 "#ef3b2c", 1 "#67000d")
set cbrange [-1:1]
set cbtics ("0" -1, "0.9" -0.6667, "0.99" -0.3333, "1" 0, "1.01" 0.3333, "1.1" 0.6667, "2" 1)
set multiplot layout 2, 4 title "weak furnace of masking that is no surface's: 1 (white) would hold" font "sans,13"
do for [k = 1:|OTHERS|] {
	set title OTHERS[k] offset 0, -0.6
	plot "furnaces_weak_others.dat" index k - 1 using 1:2:3 with image
}
unset multiplot
