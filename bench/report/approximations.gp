# approximations.gp - fronts of error against time, and masking against simulated surfaces. Runs in out/report.
set datafile separator comma
set grid lc rgb "#dddddd"
set logscale xy
set format y "10^{%L}"
set key off
set xlabel "ns a call, vectorised"
PARETO(group) = sprintf("approximations_pareto_%s.csv", group)

set terminal pngcairo size 1800, 1080 enhanced font "sans,11"
set output "approximations_pareto.png"
set multiplot layout 2, 3
do for [k = 1:6] {
	group = word("dielectric conductor film lambda masking across", k)
	title = word("Fresnel,\ dielectric Fresnel,\ conductor Thin\ film Lambda\ of\ Beckmann Masking Masking,\ across", k)
	set title group
	set ylabel "RMS error"
	unset logscale
	set xrange [*:*]
	set yrange [*:*]
	stats PARETO(group) using 2:3 skip 1 nooutput
	set logscale xy
	set xrange [STATS_min_x / 1.6 : STATS_max_x * 4]
	set yrange [STATS_min_y / 4 : STATS_max_y * 4]
	plot PARETO(group) using ($4 == 1 ? $2 : NaN):3 skip 1 with lines lw 2 lc rgb "#1f77b4", \
		'' using 2:3:(strcol(4) eq "1" ? 0x1f77b4 : 0x999999) skip 1 with points pt 7 ps 1.3 lc rgb variable, \
		'' using 2:3:1 skip 1 with labels left offset 0.8, 0.4 noenhanced font "sans,9"
}
unset multiplot

set terminal pngcairo size 1200, 800 enhanced font "sans,11"
set output "approximations_real.png"
set title "Elementary functions: lobe's (round) and libm's in single precision (square)"
set xrange [0.1:*]
set yrange [*:*]
set logscale y
set format y "%g"
set ylabel "RMS error [ulp]"
plot PARETO("real") using (strstrt(strcol(1), "/lobe") ? $2 : NaN):3 skip 1 with points pt 7 ps 1.4 lc rgb "#1f77b4", \
	'' using (strstrt(strcol(1), "/libm") ? $2 : NaN):3 skip 1 with points pt 5 ps 1.4 lc rgb "#d62728", \
	'' using 2:3:1 skip 1 with labels left offset 0.8, 0.4 noenhanced font "sans,9"

set output "approximations_field.png"
unset logscale
set title "Masking models against simulated Gaussian height fields"
set xrange [0:1]
set yrange [0:1.02]
set xlabel "simulated share of facets that both directions see"
set ylabel "masking function"
set key bottom right
set terminal pngcairo size 1300, 620 enhanced font "sans,11"
set multiplot layout 1, 2
SAME = "'Smith; separable' 'Smith; height-correlated' 'Smith; direction-correlated' 'Smith; height and direction' 'V-cavities'"
ACROSS = "'separable' 'beta function' '1/(1 + Lo + Li) as on one side'"
set title "both directions above"
plot x with lines lc rgb "#888888" notitle, for [k = 1:5] "approximations_field.csv" \
	using (strcol(1) eq "same" && strcol(11) eq word(SAME, k) ? $9 : NaN):12:(2 * $10) skip 1 with xerrorbars pt 7 ps 0.9 title word(SAME, k) noenhanced
set title "one above, one below, index 1.5"
plot x with lines lc rgb "#888888" notitle, for [k = 1:3] "approximations_field.csv" \
	using (strcol(1) eq "across" && strcol(11) eq word(ACROSS, k) ? $9 : NaN):12:(2 * $10) skip 1 with xerrorbars pt 7 ps 0.9 title word(ACROSS, k) noenhanced
unset multiplot
