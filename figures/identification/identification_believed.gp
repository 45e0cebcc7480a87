# figures/identification/identification_believed.gp -- H 24: three profiles of alpha from the same table.
# Input: figures/identification/identification_believed.c. Output: figures/identification/identification_believed.svg.
width = 900; height = 380
load 'figures/style.gp'
set multiplot
set yrange [0:11]
set ylabel "χ² above its least"
set xlabel "α"
set tmargin at screen 0.95
set bmargin at screen 0.16
set lmargin at screen 0.075
set rmargin at screen 0.52
set xrange [0.27:0.35]
set xtics 0.01
set key top right # no names at the curves, because other curves would cross them
set label 1 "truth" at 0.3008, 10.4
set arrow 1 from 0.3, 0 to 0.3, 11 nohead dt 3 lc rgb "#555555"
# The threshold is the square of Student's quantile of 95 %, for 197 degrees of freedom and, on the right, for 22.
plot 3.89 with lines dt 2 lc rgb "#767676" title "95 %", \
     dat index 0 using 1:2 with lines ls 1 title "200 rows: α, ρ, c", \
     dat index 1 using 1:2 with lines ls 2 title "and the offset"
set lmargin at screen 0.585
set rmargin at screen 0.985
set xrange [0:0.5]
set xtics 0.1
unset ylabel
set arrow 1 from 0.3, 0 to 0.3, 11
set label 1 "truth" at 0.306, 10.4
set key top left # no names at the curves, because other curves would cross them
plot 4.30 with lines dt 2 lc rgb "#767676" notitle, \
     dat index 2 using 1:2 with lines ls 1 title "25 rows: α, ρ, c", \
     '' index 2 using 1:3 with lines ls 8 dt 4 title "their parabola"
unset multiplot
