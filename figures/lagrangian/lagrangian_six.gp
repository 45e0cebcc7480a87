# figures/lagrangian/lagrangian_six.gp -- The six mechanisms of the manual.
# Input: figures/lagrangian/lagrangian_six.c. Output: figures/lagrangian/lagrangian_six.svg.
width = 1080; height = 700
load 'figures/style.gp'
set multiplot layout 2,3
unset key
set size ratio -1
set title "elastic pendulum: the body"
set xlabel "x_1"
set ylabel "x_2"
set xrange [-1.4:1.4]
set yrange [-1.9:0.9]
plot '+' using (0):(0) every ::0::0 with points pt 7 ps 0.7 lc rgb "#000000", dat index 0 using 1:2 with lines ls 1
set title "cart (red) and bob of its pendulum"
set xlabel "across"
set ylabel "up"
set yrange [-1.8:1.0]
plot dat index 1 using 1:2 with lines ls 2 dt 1 lw 5, dat index 1 using 3:4 with lines ls 1
set title "double pendulum: the tip"
set xrange [-2.2:2.2]
set yrange [-2.6:1.8]
plot '+' using (0):(0) every ::0::0 with points pt 7 ps 0.7 lc rgb "#000000", dat index 2 using 1:2 with lines ls 1
set title "linkage of four bars"
set xrange [-1.1:2.7]
set yrange [-1.6:2.2]
plot dat index 3 using 1:2 with lines ls 1, dat index 3 using 3:4 with lines ls 2 dt 1, \
     dat index 3 every 25::0::75 using (0):(0):1:2 with vectors nohead lc rgb "#888888" lw 1, \
     dat index 3 every 25::0::75 using 1:2:($3-$1):($4-$2) with vectors nohead lc rgb "#888888" lw 1, \
     dat index 3 every 25::0::75 using (2):(0):($3-2):4 with vectors nohead lc rgb "#888888" lw 1
set size noratio
set title "van der Pol, with a springpot"
set xlabel "x"
set ylabel "v"
set xrange [-2:2]
set yrange [-2.7:2.7]
plot dat index 4 using 1:2 with lines ls 1
set title "a ball that a springpot holds back"
set xlabel "t"
set ylabel "x"
set xrange [0:8]
set yrange [0:1.05]
plot dat index 5 using 1:2 with lines ls 1
unset multiplot
