# furnaces.gp - energy kept in a white furnace, a map for each surface of furnaces_white.csv. Runs in out/report.
set datafile separator comma
set terminal pngcairo size 1600, 1150 noenhanced font "sans,10"
set output "furnaces_white.png"
set palette defined (0 "#08306b", 0.5 "#4292c6", 0.9 "#c6dbef", 1 "#ffffff", 1.001 "#fee0d2", 1.25 "#fb6a4a", 1.5 "#99000d")
set cbrange [0:1.5]
set xrange [0:1.02]
set yrange [0:1]
set xlabel "roughness, sqrt(alpha)"
set ylabel "cosine of the view"
NAMES = system("awk -F, 'NR > 1 && !seen[$1]++ { gsub(/ /, \"_\", $2); printf \"%s \", $2 }' furnaces_white.csv")
set multiplot layout 3, 4 title "energy kept of constant light: 1 (white) is a closed furnace" font "sans,13"
do for [k = 1:words(NAMES)] {
	set title system(sprintf("echo '%s' | tr _ ' '", word(NAMES, k)))
	plot "furnaces_white.csv" using ($1 == k - 1 ? sqrt($3) : NaN):4:5 skip 1 with points pt 5 ps 1.9 lc palette notitle
}
unset multiplot
