# figures/identification/identification_landscape.gp -- H 24: the false minima of chi^2.
# Input: figures/identification/identification_landscape.c. Output:
# figures/identification/identification_landscape.svg.
width = 920; height = 440
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.13,0.9 spacing 0.17
set title "χ² / n, ρ known"
set xlabel "c"
set ylabel "α"
set xrange [log10(0.2):log10(5)]
set yrange [0.02:0.98]
set xtics ("0.2" log10(0.2), "0.5" log10(0.5), "1" 0, "2" log10(2), "5" log10(5))
set cbrange [0:3.5]
set cbtics ("1" 0, "10" 1, "100" 2, "1000" 3)
set palette defined (0 "#08306b", 1 "#2171b5", 2 "#6baed6", 3 "#c6dbef", 4 "#fff7ec", 5 "#fdd49e")
set colorbox user origin 0.465,0.13 size 0.012,0.77
set key bottom left opaque # marks have no curve that could carry their names
plot dat index 0 using (log10($2)):1:(log10($3)) with image notitle, \
     dat index 1 using (log10($2)):1 with points pt 7 ps 0.7 lc rgb "#D55E00" title "minima", \
     '+' using (0):(0.3) every ::0::0 with points pt 2 ps 1.6 lw 2 lc rgb "#000000" title "truth"
set title "The least χ² / n for each c"
set ylabel "χ² / n"
set logscale y
set yrange [1:3000]
set format y "10^{%L}"
set key noopaque at graph 0.98, graph 0.5 right samplen 2 # no names at the curves, because they come together
plot dat index 2 using (log10($1)):2 with lines ls 2 title "over α, ρ known", \
     dat index 2 using (log10($1)):3 with lines ls 1 title "over α and ρ"
unset multiplot
