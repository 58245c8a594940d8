# strategies_map.gp - which technique wins, over roughness and view cosine, a panel for each light.
#	OUT, DATA: files in this folder; TITLE
load "strategies_names.gp"
COLUMNS = 4
ROWS = (|LIGHTS| + 1 + COLUMNS - 1) / COLUMNS
set terminal pngcairo size 1400, 60 + 290 * ROWS noenhanced font "sans,10"
set output OUT
array COLOUR[14] = ["#3b6fb6", "#8c8c8c", "#c7c7c7", "#e08f2c", "#6fa8dc", "#9fc5e8", "#cfe2f3", "#1b3a70", "#b5651d", "#f2c879", "#d62728", "#2ca02c", "#98df8a", "#1f6b2e"]
set palette defined (-1 "white", 0 COLOUR[1], 1 COLOUR[2], 2 COLOUR[3], 3 COLOUR[4], 4 COLOUR[5], 5 COLOUR[6], 6 COLOUR[7], 7 COLOUR[8], 8 COLOUR[9], 9 COLOUR[10], 10 COLOUR[11], 11 COLOUR[12], 12 COLOUR[13], 13 COLOUR[14]) maxcolors 15
set cbrange [-1.5:13.5]
unset colorbox
unset key
set multiplot layout ROWS, COLUMNS title TITLE font "sans,13"
set xlabel "alpha" offset 0, 0.6
set ylabel "cos of view" offset 1.5, 0
do for [i = 1:|LIGHTS|] {
	set title LIGHTS[i] offset 0, -0.6
	plot DATA index i - 1 using 1:2:3 with image
}
set title "winner (white: no light arrives)" offset 0, -0.6
unset xtics
unset ytics
unset xlabel
unset ylabel
unset border
set xrange [0:10]
set yrange [0:15]
plot for [t = 1:14] "+" using (0.6):(15 - t) every ::0::0 with points pt 5 ps 2 lc rgb COLOUR[t], \
	for [t = 1:14] "+" using (1.4):(15 - t):(NAMES[t]) every ::0::0 with labels left font "sans,11"
unset multiplot
