# approximations.gp - fronts of error against time, and masking against simulated surfaces. Runs in out/report.
set datafile separator comma
set grid lc rgb "#dddddd"
set tics nomirror

# Points have numbers and the key tells whose they are: names beside points that lie close would hide each other.
PARETO(group) = sprintf("approximations_pareto_%s.csv", group)
NAME(group, i) = system(sprintf("sed -n '%dp' %s | cut -d, -f1", i + 1, PARETO(group)))
ERROR(group, i) = real(system(sprintf("sed -n '%dp' %s | cut -d, -f3", i + 1, PARETO(group))))
COUNT(group) = int(system(sprintf("tail -n +2 %s | wc -l", PARETO(group))))
array GROUP[6] = ["dielectric", "conductor", "film", "lambda", "masking", "across"]
array TITLE[6] = ["Fresnel, dielectrics of index 1.1 to 4", "Fresnel, ten metals", "Thin films on metals", \
	"Lambda of Beckmann", "Masking on GGX, against height-correlated Smith", \
	"Masking across GGX, against the beta function"]
array UNIT[6] = ["RMS error of the reflectance", "RMS error of the reflectance", \
	"RMS error of a channel's reflectance", \
	"RMS error of G1", "RMS distance of G2", "RMS error of G2"]
# Of the masking functions one is what the others are measured from: it is drawn at the lower edge, not decades below.
array FLOOR[6] = [0, 0, 0, 0, 4e-3, 0]
HELD(k, y) = y < FLOOR[k] ? FLOOR[k] : y
LABEL(k, i) = sprintf("%d  %s%s", i, NAME(GROUP[k], i), \
	ERROR(GROUP[k], i) < FLOOR[k] ? sprintf(" (%.0e)", ERROR(GROUP[k], i)) : "")
# Numbers beside their points in turn: of masking functions many take the same time, of others many err alike.
SIDE(i) = i % 2 ? 1 : -1
COLOURS = "#1f77b4 #d62728 #2ca02c #9467bd #ff7f0e #8c564b #17becf #e377c2 #7f7f7f #bcbd22 #000000 #aa8800 #4040ff"
COLOUR(i) = word(COLOURS, 1 + (i - 1) % 13)

set terminal pngcairo size 2100, 1100 enhanced font "sans,11"
set output "approximations_pareto.png"
set multiplot layout 2, 3
set format y "10^{%L}"
set xlabel "ns a call, on one core"
set key outside right top vertical Left reverse noenhanced samplen 0.5 spacing 1.25 font "sans,10"
do for [k = 1:6] {
	set title TITLE[k]
	set ylabel UNIT[k]
	unset logscale
	set xrange [*:*]
	set yrange [*:*]
	stats PARETO(GROUP[k]) using 2:(HELD(k, $3)) skip 1 nooutput
	set logscale xy
	set xrange [STATS_min_x/1.6 : STATS_max_x*1.8]
	set yrange [STATS_min_y/(FLOOR[k] > 0 ? 1.3 : 4) : STATS_max_y*(FLOOR[k] > 0 ? 2 : 4)]
	plot sprintf("< awk -F, '$4 == 1' %s", PARETO(GROUP[k])) using 2:(HELD(k, $3)) \
			with lines lw 2 lc rgb "#bbbbbb" title "front", \
		for [i = 1:COUNT(GROUP[k])] PARETO(GROUP[k]) every ::i::i using 2:(HELD(k, $3)) \
			with points pt 7 ps 1.4 lc rgb COLOUR(i) title LABEL(k, i), \
		for [i = 1:COUNT(GROUP[k])] PARETO(GROUP[k]) every ::i::i using 2:(HELD(k, $3)):(sprintf("%d", i)) \
			with labels offset (k == 5 ? SIDE(i)*1.5 : 0), (k == 5 ? 0 : SIDE(i)*0.8) \
			font "sans,9" textcolor rgb COLOUR(i) notitle
}
unset multiplot

set terminal pngcairo size 1200, 700 enhanced font "sans,11"
set output "approximations_real.png"
set title "Elementary functions in single precision"
FUNCTIONS = "sin_2pi cos_2pi sin exp log pow erf erfinv acos atan2"
unset logscale
set logscale xy
set xrange [0.1:20]
# What is off by more than that - libm's sine of the rounded product 2 pi x is, by any number of ulp, where it should be
# 0 - is drawn at HIGH, with its error.
HIGH = 5.0
set yrange [0.1:2*HIGH]
LOW(y) = y > HIGH ? HIGH : y
MARK(f, y) = y > HIGH ? sprintf("%d (%.0e)", f, y) : sprintf("%d", f)
set format y "%g"
set xlabel "ns a call, on one core"
set ylabel "RMS error [ulp]"
# Above the point or below.
ABOVE(f) = 0.8*word("1 -1 1 -1 1 -1 -1 -1 1 1", f)
OF(f, by) = sprintf("%s/%s", word(FUNCTIONS, f), by)
plot for [f = 1:10] PARETO("real") using (strcol(1) eq OF(f, "lobe") ? $2 : NaN):(LOW($3)) skip 1 \
		with points pt 7 ps 1.5 lc rgb "#1f77b4" title sprintf("%d  %s", f, word(FUNCTIONS, f)), \
	PARETO("real") using (strstrt(strcol(1), "/libm") ? $2 : NaN):(LOW($3)) skip 1 \
		with points pt 5 ps 1.4 lc rgb "#d62728" title "libm's", \
	for [f = 1:10] PARETO("real") using (strcol(1) eq OF(f, "lobe") ? $2 : NaN):(LOW($3)):(MARK(f, $3)) skip 1 \
		with labels offset 0, ABOVE(f) font "sans,9" textcolor rgb "#1f77b4" notitle, \
	for [f = 1:10] PARETO("real") using (strcol(1) eq OF(f, "libm") ? $2 : NaN):(LOW($3)):(MARK(f, $3)) skip 1 \
		with labels offset 0, ABOVE(f) font "sans,9" textcolor rgb "#d62728" notitle

set output "approximations_field.png"
unset logscale
set xrange [0:1]
set yrange [0:1.02]
set xlabel "simulated share of facets that both directions see"
set ylabel "masking function"
set key inside bottom right Right noreverse samplen 2 spacing 1.1
set terminal pngcairo size 1300, 620 enhanced font "sans,11"
set multiplot layout 1, 2
FIELD = "approximations_field.csv"
SAME = "'Smith; separable' 'Smith; height-correlated' 'Smith; direction-correlated' 'Smith; height and direction' \
'V-cavities'"
ACROSS = "'separable' 'beta function' '1/(1 + Lo + Li) as on one side'"
IS(side, model) = strcol(1) eq side && strcol(11) eq model
set title "both directions above"
plot x with lines lc rgb "#888888" notitle, \
	for [k = 1:5] FIELD using (IS("same", word(SAME, k)) ? $9 : NaN):12:(2*$10) skip 1 \
		with xerrorbars pt 7 ps 0.9 title word(SAME, k) noenhanced
set title "one above, one below, index 1.5"
plot x with lines lc rgb "#888888" notitle, \
	for [k = 1:3] FIELD using (IS("across", word(ACROSS, k)) ? $9 : NaN):12:(2*$10) skip 1 \
		with xerrorbars pt 7 ps 0.9 title word(ACROSS, k) noenhanced
unset multiplot
