# strategies_curves.gp - error against time of four telling cases.
load "strategies_names.gp"
load "strategies_titles.gp"
set terminal pngcairo size 1500, 1150 noenhanced font "sans,10"
set output "strategies_curves.png"
array COLOUR[14] = ["#3b6fb6", "#8c8c8c", "#c7c7c7", "#e08f2c", "#7b5ea7", "#1aa6a6", "#d88fc4", "#1b3a70", "#b5651d", "#f2c879", "#d62728", "#2ca02c", "#98df8a", "#1f6b2e"]
set multiplot layout 2, 2 title "error against time" font "sans,13"
unset xrange
unset yrange
set autoscale
set logscale xy
set format x "%g"
set format y "%g"
set xtics auto
set ytics auto
set xrange [*:*]
set yrange [*:*]
set xlabel "time, microseconds"
set ylabel "relative root-mean-square error"
set grid lc rgb "gray85"
set key outside right top font "sans,9" samplen 2
do for [k = 1:4] {
	set title TITLES[k]
	first = (k - 1) * 28
	stats "strategies_curves.dat" index first + 1 using 1:2 nooutput
	x0 = STATS_min_x
	y0 = STATS_max_y
	plot y0 * 2 * (x / x0) ** -0.5 with lines lc rgb "gray60" lw 4 title "slope -1/2", \
		NaN with lines dt 3 lc rgb "gray30" title "dotted: independent", \
		NaN with linespoints pt 7 ps 0.5 lc rgb "gray30" title "points: scrambled", \
		for [t = 1:14] "strategies_curves.dat" index first + 2 * (t - 1) using 1:2 with lines dt 3 lw 1 lc rgb COLOUR[t] notitle, \
		for [t = 1:14] "strategies_curves.dat" index first + 2 * (t - 1) + 1 using 1:2 with linespoints pt 7 ps 0.5 lw (t == 1 || t > 10 ? 2.5 : 1.5) lc rgb COLOUR[t] title NAMES[t]
}
unset multiplot
