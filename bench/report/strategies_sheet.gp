# strategies_sheet.gp - pictures by each technique in equal time, and their errors in false colour.
#	PICTURES, ERRORS: files to write; LIGHT
load "strategies_sheet_titles.gp"
set terminal pngcairo size 1500, 60 + 5 * 210 noenhanced font "sans,10"
unset border
unset tics
unset key
unset colorbox
set size ratio -1
set xrange [-0.5:WIDTH - 0.5]
set yrange [HEIGHT - 0.5:-0.5]
set lmargin 0.5
set rmargin 0.5
set bmargin 0.2
set tmargin 3
set output PICTURES
set multiplot layout 5, 3 title "in equal time: " . LIGHT font "sans,13"
do for [i = 1:15] {
	set title TITLES[i] offset 0, -0.8 font "sans,10"
	plot "strategies_pictures.dat" index i - 1 using 1:2:3:3:3 with rgbimage
}
unset multiplot
set output ERRORS
set palette defined (0 "#000020", 1 "#2040a0", 2 "#20a0a0", 3 "#e0d040", 4 "#d03020", 5 "white")
set logscale cb
set cbrange [0.001:10]
set cblabel "relative error"
set multiplot layout 5, 3 title "error in equal time: " . LIGHT font "sans,13"
do for [i = 1:14] {
	set title TITLES[i] offset 0, -0.8 font "sans,10"
	plot "strategies_pictures.dat" index i - 1 using 1:2:4 with image
}
set title "relative error of a pixel"
set colorbox horizontal user origin graph 0.1, graph 0.45 size graph 0.8, graph 0.12
set cbtics format "%g"
plot "strategies_pictures.dat" index 14 using 1:2:(NaN) with image
unset multiplot
