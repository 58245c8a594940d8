# plots.gp - pictures of out/bench/throughput.csv. From the repository's root:
#	gnuplot bench/plots.gp
# DEVICE is one of the file's devices: gnuplot -e "DEVICE='opencl:0'" bench/plots.gp
if (!exists("DEVICE")) DEVICE = "native:1"
if (!exists("FOLDER")) FOLDER = "out/bench"
FILE = system(sprintf("echo '%s' | tr : _", DEVICE))
set datafile separator comma
set terminal pngcairo size 1100,600 noenhanced
set style data histograms
set style histogram clustered gap 1
set style fill solid 0.8 border -1
set boxwidth 0.9
set grid ytics
set key outside top center horizontal
set xtics rotate by -20

# The larger batches alone: those that do not fit into the caches.
rows(verb) = sprintf("< awk -F, 'NR > 1 && $2 == \"%s\" && $3 == \"%s\" && $5 > 100000' %s/throughput.csv", \
	verb, DEVICE, FOLDER)

set output sprintf("%s/throughput_%s.png", FOLDER, FILE)
set ylabel "million elements per second"
set logscale y
set title sprintf("throughput, %s", DEVICE)
plot for [verb in "eval pdf eval+pdf sample"] rows(verb) using 7:xtic(1) title verb

set output sprintf("%s/copy_share_%s.png", FOLDER, FILE)
set ylabel "percent of a plain copy of the same bytes"
unset logscale y
set yrange [0:*]
set title sprintf("share of a plain copy, %s", DEVICE)
plot for [verb in "eval pdf eval+pdf sample"] rows(verb) using 15:xtic(1) title verb
