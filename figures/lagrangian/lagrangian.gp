# figures/lagrangian/lagrangian.gp -- H 29: a damped motion that conserves its angular momentum, and one that does
# not.
# Input: figures/lagrangian/lagrangian.c. Output: figures/lagrangian/lagrangian.svg.
width = 1080; height = 420
load 'figures/style.gp'
set multiplot layout 1,3
unset key
set title "the path"
set xlabel "x_1"
set ylabel "x_2"
set size ratio -1
set xrange [-1.5:1.5]
set yrange [-1.5:1.5]
plot dat index 0 using 2:3 with lines ls 1, '+' using (0):(0) every ::0::0 with points pt 7 ps 0.7 lc rgb "#000000", \
     '+' using (1.2):(0) every ::0::0 with points pt 7 ps 0.9 lc rgb BLUE
set size noratio
set title "the energy falls"
set xlabel "t"
set ylabel "E"
set xrange [0:60]
set yrange [0:0.5]
set label 1 "strut" at 40, 0.37 tc rgb BLUE
set label 2 "dampers along the axes" at 14, 0.10 tc rgb RED
plot dat index 1 using 1:2 with lines ls 1, dat index 2 using 1:2 with lines ls 2
set title "change of the angular momentum"
set ylabel "|J(t) - J(0)|" offset -1
set logscale y
set yrange [1e-17:10]
set format y "10^{%T}"
set label 1 "strut: roundings" at 18, 2e-12 tc rgb BLUE
set label 2 "dampers along the axes" at 14, 0.02 tc rgb RED
plot dat index 1 using 1:(abs($3)+1e-17) with lines ls 1, dat index 2 using 1:(abs($3)+1e-17) with lines ls 2
unset multiplot
