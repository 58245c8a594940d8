# stability_forms.gp - printed forms and the library's: stability_forms.csv.
set datafile separator comma
set terminal pngcairo size 1500, 900 noenhanced font "sans,12"
set output "stability_forms.png"
names = "'D of GGX, Karis'|'D of GGX from 1 - cos^2'|'Lambda of GGX'|'refraction by GGX'|'Fresnel, metal'|'Fresnel, glass'"
name(i) = i == 0 ? "D of GGX: Karis" : i == 1 ? "D of GGX: from 1 - cos^2" : i == 2 ? "Lambda of GGX: from the tangent" : \
	i == 3 ? "refraction by GGX: Walter's formula" : i == 4 ? "Fresnel of a metal" : "Fresnel of glass"
over(i) = i < 2 ? "alpha" : i == 2 ? "cosine" : i == 4 ? "k" : "|eta - 1|"
rows(i) = sprintf("< awk -F, '$1 == %d' stability_forms.csv", i)
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set termoption enhanced
set yrange [1e-8:1e4]
set grid
set key top right samplen 2
set ylabel "relative error"
set multiplot layout 2, 3
do for [i = 0:5] {
	set title name(i)
	set xlabel over(i)
	plot rows(i) using 2:($6 > 1e-8 ? $6 : 1e-8) with linespoints lw 2 pt 7 ps 0.6 lc rgb "#d62728" title "printed, worst", \
		rows(i) using 2:($5 > 1e-8 ? $5 : 1e-8) with linespoints lw 2 pt 7 ps 0.6 lc rgb "#1f77b4" title "library, worst", \
		rows(i) using 2:4 with lines lw 2 dt 2 lc rgb "#555555" title "floor, mean"
}
unset multiplot
