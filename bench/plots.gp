# plots.gp - pictures of out/bench/throughput.csv, and of build_time.csv where there are OpenCL devices. From the
# repository's root, after make bench:
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
set bmargin 5

do for [device in DEVICES] {
	set output file("throughput", device)
	set title sprintf("throughput, %s", device)
	set ylabel "million elements per second"
	set logscale y
	set yrange [1:*]
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
		plot for [verb in VERBS] rows(verb, device) using 16:xtic(1) title verb
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
set output
