# figures/lobatto/lobatto_forms.gp -- Chapter 17: both forms of the inertia.
# Input: figures/lobatto/lobatto_forms.c. Output: figures/lobatto/lobatto_forms.svg.
width = 920; height = 470
load 'figures/style.gp'
look(i) = i < 3 ? 14 + i : 18 + i # three stages to six
set multiplot layout 1,2 margins 0.09,0.985,0.12,0.9 spacing 0.1

set title "Bagley and Torvik, x at 2 ≤ t ≤ 20"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "h"
set ylabel "largest error"
set xrange [1e-2:1.5]
set yrange [1e-14:1e3]
set ytics 1e2
set key top left vertical maxrows 4 width -1
plot for [i=1:4] dat index i-1 using 1:2 with linespoints ls look(i) dt (3,3) title sprintf("M, s = %d", i+2), \
     for [i=1:4] '' index i-1 using 1:4 with linespoints ls look(i) dt 1 pt 7 title sprintf("D, s = %d", i+2)

set title "Energy without friction, x'' + x³ = 0, s = 3, h = 1/2"
unset logscale
set format x "%g"
set format y "%g"
set xlabel "t"
set ylabel "energy / energy at t = 0"
set xrange [0:200]
set yrange [0.9:1.01]
set ytics 0.02
set key bottom left maxrows 8 width 0
plot dat index 4 using 1:2 with lines ls 1 lw 1.2 title "M", \
     '' index 4 using 1:3 with lines ls 2 dt 1 lw 1.2 title "D"
unset multiplot
