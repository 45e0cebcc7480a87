# figures/lobatto/lobatto_forms.gp -- H 17: the two forms of the inertia, form M and form D.
# Input: figures/lobatto/lobatto_forms.c. Output: figures/lobatto/lobatto_forms.svg.
width = 920; height = 470
load 'figures/style.gp'
look(i) = i < 3 ? 14 + i : 18 + i # the line style of block i, for 3 to 6 stages
set multiplot layout 1,2 margins 0.09,0.985,0.12,0.9 spacing 0.1

set title "Bagley and Torvik, x at 2 ≤ t ≤ 20; M dashed, D solid"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "h"
set ylabel "largest error"
set xrange [1e-2:4]
set yrange [1e-14:1]
set ytics 1e2
unset key
set label 1 "s = 3" at 1.2,5e-3 tc rgb "#606060"
set label 2 "s = 4" at 1.2,2e-4 tc ls look(2)
set label 3 "s = 5" at 1.2,1.8e-5 tc ls look(3)
set label 4 "s = 6" at 1.2,1.6e-6 tc ls look(4)
plot for [i=1:4] dat index i-1 using 1:2 with linespoints ls look(i) dt (3,3), \
     for [i=1:4] '' index i-1 using 1:4 with linespoints ls look(i) dt 1 pt 7

set title "Energy without friction, x'' + x³ = 0, s = 3, h = 1/2"
unset logscale
set format x "%g"
set format y "%g"
set xlabel "t"
set ylabel "energy / energy at t = 0"
set xrange [0:200]
set yrange [0.9:1.01]
set ytics 0.02
unset label
set label 1 "M" at 100,1.005 tc ls 1
set label 2 "D" at 100,0.97 tc ls 2
plot dat index 4 using 1:2 with lines ls 1 lw 1.2, \
     '' index 4 using 1:3 with lines ls 2 dt 1 lw 1.2
unset multiplot
