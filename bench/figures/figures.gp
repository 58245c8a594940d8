# figures.gp - draws the numbers that figures.c wrote: gnuplot bench/figures/figures.gp, from the repository's root.
FOLDER = "out/figures"
csv(name) = sprintf("%s/%s.csv", FOLDER, name)
columns(name) = int(system(sprintf("head -n 1 %s | tr , '\\n' | wc -l", csv(name))))

set datafile separator comma
set datafile missing "NaN"
set grid lc rgb "#dddddd"
set style data lines
set format y "%g"
set terminal pngcairo size 1500, 620 noenhanced font "sans,11"

# D and G1: a panel for each width.
do for [what in "d g1"] {
	N = (columns(what) - 1) / 2
	set output sprintf("%s/%s.png", FOLDER, what)
	set multiplot layout 1, 2
	set xrange [0:90]
	set xlabel "theta_m [degrees]"
	if (what eq "d") { set logscale y; set yrange [1e-5:100]; set ylabel "D [1/sr]"; set key top right } \
	else { set yrange [0:1.05]; set ylabel "G1, Smith"; set xlabel "theta [degrees]"; set key bottom left }
	do for [w = 0:1] {
		set title sprintf("%s at alpha = %s (Phong by alpha = sqrt(2/(n+2)))", what eq "d" ? "D" : "G1", w ? "0.5" : "0.1")
		plot for [k = 0:N-1] csv(what) using 1:2+w*N+k title columnhead lw 2
	}
	unset multiplot
	unset logscale
}

set terminal pngcairo size 1000, 680 noenhanced font "sans,11"
set output FOLDER . "/gtr_tails.png"
set title "GTR at alpha = 0.05: the tails (Burley 2012, appendix B)"
set logscale xy
set xrange [0.1:90]
set yrange [1e-4:1000]
set format y "10^{%L}"
set terminal pngcairo enhanced
set xlabel "angle between facet and normal [degrees]"
set ylabel "D [1/sr]"
set key bottom left
plot for [k = 2:columns("gtr_tails")] csv("gtr_tails") using 1:k title columnhead lw 2
unset logscale
set format y "%g"
set terminal pngcairo noenhanced

set output FOLDER . "/masking_functions.png"
set title "Masking functions at alpha = 0.5"
set xrange [0:90]
set yrange [0:1.05]
set xlabel "theta [degrees]"
set ylabel "G1 (square root of G2 of a direction with itself)"
set key bottom left
plot for [k = 2:columns("masking_functions")] csv("masking_functions") using 1:k title columnhead lw 2

set output FOLDER . "/smith_vcavity.png"
set title "Beckmann seen from theta_o = 1.5 (86 degrees): Smith against V-cavities, F = 1"
set xrange [0:90]
set yrange [*:*]
set xlabel "theta_i, forward [degrees]"
set ylabel "f cos theta_i [1/sr]"
set logscale y
set yrange [1e-3:*]
set key top left
plot for [k = 2:columns("smith_vcavity"):2] csv("smith_vcavity") using 1:k title columnhead lw 2 dt 1 lc k/2, \
	for [k = 3:columns("smith_vcavity"):2] csv("smith_vcavity") using 1:k title columnhead lw 2 dt 2 lc (k-1)/2
unset logscale

set terminal pngcairo size 1700, 680 noenhanced font "sans,11"
set output FOLDER . "/albedo.png"
set multiplot layout 1, 2
set yrange [0:1.6]
set xrange [0:90]
set xlabel "theta_o [degrees]"
set ylabel "albedo at F = 1, single scattering"
set key bottom left
do for [a in "02 50"] {
	set title "GGX, alpha = 0." . a
	if (a eq "50") { unset key }
	plot for [k = 2:9] csv("albedo_" . a) using 1:k title columnhead lw 2, \
		for [k = 10:columns("albedo_" . a)] csv("albedo_" . a) using 1:k title columnhead lw 2 dt 2
}
unset multiplot

# Visible normals: a row for each surface, a column for each view.
set terminal pngcairo size 1200, 1200 noenhanced font "sans,11"
set output FOLDER . "/visible_normals.png"
set multiplot layout 3, 3 title "Density of visible normals at alpha = 0.5 over the disk of (m.x, m.y), the view to the right; each from 0 to its maximum"
set datafile separator whitespace
set size ratio -1
unset key
unset colorbox
unset xlabel
unset ylabel
unset grid
unset tics
unset border
set xrange [0:200]
set yrange [0:200]
set palette defined (0 "#000004", 0.25 "#56106e", 0.5 "#bb3754", 0.75 "#f98c0a", 1 "#fcffa4")
do for [s in "ggx beckmann vcavity"] {
	do for [t = 0:2] {
		set title sprintf("%s, theta_o = %s", s eq "ggx" ? "GGX, Smith" : s eq "beckmann" ? "Beckmann, Smith" : "Beckmann, V-cavity", word("0 1.0 1.5", t + 1))
		plot csv(sprintf("disk_%s_%d", s, t)) matrix with image
	}
}
unset multiplot
