# furnaces_maps.gp - energy kept in a white furnace, a map for each surface of a family. Runs in out/report.
#	OUT: file to write; FAMILY: title. furnaces_tone() gives the colours' scale.
load "furnaces_maps_titles.gp"
COLUMNS = COUNT < 5 ? COUNT : COUNT < 7 ? 3 : 4
ROWS = (COUNT + COLUMNS - 1)/COLUMNS
set terminal pngcairo size 400 * COLUMNS + 170, 70 + 350 * ROWS noenhanced font "sans,11"
set output OUT
set palette defined (-1 "#08306b", -0.6667 "#2b7bba", -0.3333 "#a6cde4", -0.08 "#eef5fb", 0 "#ffffff", \
	0.08 "#fff0ea", 0.3333 "#fcae91", 0.6667 "#ef3b2c", 1 "#67000d")
set cbrange [-1:1]
set cbtics ("0" -1, "0.9" -0.6667, "0.99" -0.3333, "1" 0, "1.01" 0.3333, "1.1" 0.6667, "2 and more" 1)
set ylabel "cosine of the view" offset 1.5
set tics out nomirror
set xtics auto
unset key
# By hand: multiplot's own layout would give every map its colours' key.
LEFT = 80.0
TOP = 46.0
W = 400.0*COLUMNS + 170.0
H = 70.0 + 350.0*ROWS
set multiplot title "energy kept of constant light: " . FAMILY font "sans,13"
do for [k = 1:COUNT] {
	column = (k - 1) % COLUMNS
	row = (k - 1)/COLUMNS
	set lmargin at screen (LEFT + 390.0*column)/W
	set rmargin at screen (LEFT + 390.0*column + 300.0)/W
	set tmargin at screen 1.0 - (TOP + 350.0*row + 26.0)/H
	set bmargin at screen 1.0 - (TOP + 350.0*row + 296.0)/H
	set title TITLES[k] offset 0, -0.6
	set xlabel AXES[k] offset 0, 0.5
	if (k == COUNT) {
		set colorbox user origin (W - 150.0)/W, 0.2 size 18.0/W, 0.6
	} else {
		unset colorbox
	}
	# Which counts what lies within the ranges alone.
	set xrange [*:*]
	set yrange [*:*]
	stats "furnaces_maps.dat" index k - 1 using 1 nooutput
	set yrange [0:1]
	set xrange [STATS_min : STATS_max]
	plot "furnaces_maps.dat" index k - 1 using 1:2:3 with image
}
unset multiplot
