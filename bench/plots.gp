# plots.gp - pictures of out/bench/throughput.csv, and of roofline.csv, scaling.csv and build_time.csv where they are. From
# the repository's root, after make bench:
#	gnuplot bench/plots.gp
# DEVICE: one of the file's devices alone: gnuplot -e "DEVICE='opencl:0'" bench/plots.gp
if (!exists("FOLDER")) FOLDER = "out/bench"
TABLE = FOLDER . "/throughput.csv"
column_of(i) = system(sprintf("awk -F, 'NR > 1 && !seen[$%d]++ { print $%d }' %s", i, i, TABLE))
DEVICES = exists("DEVICE") ? DEVICE : column_of(3)
VERBS = column_of(2)
LOBES = words(column_of(1))
# Batches this large do not fit into the caches, whatever was measured beside them.
LARGE = int(system(sprintf("awk -F, 'NR > 1 && $5 > most { most = $5 } END { print int(most / 4) }' %s", TABLE)))

rows(verb, device) = sprintf("< awk -F, '$2 == \"%s\" && $3 == \"%s\" && $5 >= %d' %s", verb, device, LARGE, TABLE)
file(what, device) = sprintf("%s/%s_%s.png", FOLDER, what, system(sprintf("echo '%s' | tr : _", device)))

set datafile separator comma
set datafile missing "-"
set terminal pngcairo size (LOBES > 7 ? 150 * LOBES : 1100), 600 noenhanced font "sans,11"
set style data histograms
set style histogram clustered gap 1
set style fill solid 0.8 border -1
set boxwidth 0.9
set grid ytics
set key outside bottom center horizontal Left reverse
set xtics scale 0
# Names of lobes are longer than their bars are wide.
if (LOBES > 7) set xtics rotate by 20 right; set bmargin 8; else set bmargin 5

do for [device in DEVICES] {
	set output file("throughput", device)
	set title sprintf("throughput, %s", device)
	set ylabel "million elements per second"
	set logscale y
	set yrange [0.01:*]
	plot for [verb in VERBS] rows(verb, device) using 7:xtic(1) title verb
	unset logscale y

	set output file("copy_share", device)
	set title sprintf("share of a plain copy, %s", device)
	set ylabel "percent of a plain copy of the same bytes"
	set yrange [0:*]
	plot for [verb in VERBS] rows(verb, device) using 15:xtic(1) title verb

	# Native rows have no ratio; nor have those of a run without a native device.
	if (int(system(sprintf("awk -F, '$3 == \"%s\" && $16 > 0' %s | wc -l", device, TABLE))) > 0) {
		set output file("of_native", device)
		set title sprintf("%s against the native device with all threads", device)
		set ylabel "times the native throughput"
		set logscale y
		set yrange [0.1:*]
		plot for [verb in VERBS] rows(verb, device) using 16:xtic(1) title verb, 1 with lines lc rgb "black" notitle
		unset logscale y
	}
}

BUILDS = FOLDER . "/build_time.csv"
builds(device) = sprintf("< awk -F, '$2 == \"%s\"' %s", device, BUILDS)
do for [device in DEVICES] {
	if (int(system(sprintf("awk -F, '$2 == \"%s\"' %s 2>/dev/null | wc -l", device, BUILDS))) > 0) {
		set output file("build_time", device)
		set title sprintf("build time of the program and its first launch, %s", device)
		set ylabel "milliseconds"
		set logscale y
		set yrange [0.001:*]
		plot builds(device) using ($4 + $5):xtic(1) title "cold", \
			builds(device) using ($6 + $7) title "cached by the runtime, in a new process", \
			builds(device) using ($10 + $11) title "kept by lobe, in a new process", \
			builds(device) using 12 title "a second scene"
		unset logscale y
	}
}

# Operations against bytes: a loop cannot pass the slope of the memory, nor the line of fused sums and products; its own
# divisions and roots hold it below a bar.
ROOFLINE = FOLDER . "/roofline.csv"
exists_file(path) = int(system(sprintf("test -s %s && echo 1 || echo 0", path)))
if (exists_file(ROOFLINE)) {
	reset
	set datafile separator comma
	set terminal pngcairo size 1200, 800 noenhanced font "sans,11"
	largest(column) = system(sprintf("awk -F, 'NR > 1 && $%d > most { most = $%d } END { print most }' %s", column, column, ROOFLINE)) + 0
	PEAK = largest(15)
	BAND = largest(13)
	set output FOLDER . "/roofline.png"
	set title "operations and bytes of every loop, one thread; lobes are named at sample"
	set xlabel "operations for a byte"
	set ylabel "thousand million operations per second"
	set logscale xy
	set xrange [0.05:100]
	set yrange [0.5:2 * PEAK]
	set grid
	set key bottom right
	points(select) = sprintf("< awk -F, 'NR > 1 && $4 > 0 && $2 == \"%s\"' %s", select, ROOFLINE)
	plot (BAND * x < PEAK ? BAND * x : 1 / 0) title sprintf("a copy, %.0f GB/s", BAND) lw 2 lc rgb "gray30", \
		(BAND * x >= PEAK ? PEAK : 1 / 0) title sprintf("fused sums and products, %.0f", PEAK) lw 2 lc rgb "gray60", \
		for [i = 1:words(VERBS)] points(word(VERBS, i)) using ($4 / $3):($8 * $4 / 1000) with points pt 7 ps 1.3 lc i title word(VERBS, i) . ", from memory", \
		for [i = 1:words(VERBS)] points(word(VERBS, i)) using ($4 / $3):($12 * $4 / 1000) with points pt 6 ps 1.3 lc i notitle, \
		for [i = 1:words(VERBS)] points(word(VERBS, i)) using ($4 / $3):($14 > 0 ? $14 * $4 / 1000 : 1 / 0) with points pt 2 ps 1 lc i notitle, \
		points("sample") using ($4 / $3):($8 * $4 / 1000):1 with labels left rotate by -35 offset 0.7, -0.4 font "sans,9" notitle, \
		1 / 0 with points pt 6 lc rgb "black" title "hollow: in the cache", \
		1 / 0 with points pt 2 lc rgb "black" title "crosses: what the divider allows"
}

SCALING = FOLDER . "/scaling.csv"
if (exists_file(SCALING)) {
	reset
	set datafile separator comma
	set terminal pngcairo size 1100, 600 noenhanced font "sans,11"
	distinct(column) = system(sprintf("awk -F, 'NR > 1 && !seen[$%d]++ { print $%d }' %s", column, column, SCALING))
	TEAMS = distinct(3)
	set logscale xy
	set xlabel "elements of a batch"
	set ylabel "million elements per second"
	set grid
	set key bottom right
	set output FOLDER . "/scaling.png"
	set title sprintf("batches of every size, %s", distinct(1))
	curve(verb, team) = sprintf("< awk -F, '$2 == \"%s\" && $3 == \"%s\"' %s", verb, team, SCALING)
	plot for [i = 1:words(TEAMS)] curve("eval+pdf", word(TEAMS, i)) using 4:6:7:8 with yerrorlines lc i lw 1.5 pt 7 ps 0.7 \
			title "eval+pdf, " . word(TEAMS, i), \
		for [i = 1:words(TEAMS)] curve("sample", word(TEAMS, i)) using 4:6:7:8 with yerrorlines lc i lw 1.5 dt 2 pt 6 ps 0.7 \
			title "sample, " . word(TEAMS, i)
}
set output
