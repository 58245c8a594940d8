# furnaces_balls.gp - balls in an environment of radiance 1 and what they send back. Runs in out/report.
#	OUT: file to write
load "furnaces_balls_labels.gp"
set terminal pngcairo size WIDTH, HEIGHT noenhanced font "sans,10"
set output OUT
unset border
unset tics
unset key
set lmargin at screen 0
set rmargin at screen 1
set bmargin at screen 0
set tmargin at screen 1
set xrange [-0.5:WIDTH - 0.5]
set yrange [HEIGHT - 0.5:-0.5]
plot "furnaces_balls.rgb" binary array=(WIDTH, HEIGHT) format="%uchar%uchar%uchar" using 1:2:3 with rgbimage
