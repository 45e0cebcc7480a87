# figures/convergence/convergence.gp -- Chapter 20: errors, and what bounds them.
# Input: figures/convergence/convergence.c. Output: figures/convergence/convergence.svg.
width = 900; height = 440
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.085,0.985,0.13,0.9 spacing 0.1
set logscale y
set format y "10^{%L}"
set logscale x
set format x "10^{%L}"
set title "largest error of x, 0 ≤ t ≤ 3"
set xlabel "h"
set xrange [1e-3:0.3]
set yrange [1e-5:1e6]
set key top left
plot dat index 0 using 1:4 with lines ls 1 lw 1 title "(20.8), α = 1/4", \
     dat index 1 using 1:4 with lines ls 2 lw 1 title "(20.8), α = 3/4", \
     dat index 0 using 1:2 with points ls 1 title "α = 1/4", \
     dat index 1 using 1:2 with points ls 2 title "α = 3/4", \
     0.1*x with lines ls 8 title "slope 1"
unset logscale x
set format x "%g"
set title "α = 3/4: error of x over h"
set xlabel "t"
set xrange [0:3]
set yrange [1e-3:1e4]
plot dat index 5 using 1:3 with lines ls 2 title "(20.8)", \
     dat index 5 using 1:2 with lines ls 3 title "(20.7), run", \
     dat index 2 using 1:2 with lines ls 6 title "h = 3/64", \
     dat index 3 using 1:2 with lines ls 5 title "h = 3/256", \
     dat index 4 using 1:2 with lines ls 1 title "h = 3/1024"
unset multiplot
