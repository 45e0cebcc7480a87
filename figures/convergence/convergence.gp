# figures/convergence/convergence.gp -- H 20: the errors of fvi under a force that jumps, and their bounds.
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
set yrange [1e-5:1e4]
unset key
set label 1 "the bound (20.8)" at 1.3e-3,60 tc rgb "#222222"
set label 2 "α = 3/4" at 0.02,9e-3 right tc rgb RED
set label 3 "α = 1/4" at 0.03,4e-4 left tc rgb BLUE
set label 4 "slope 1" at 0.29,8e-3 right tc rgb "#606060"
plot dat index 0 using 1:4 with lines ls 1 lw 1, \
     dat index 1 using 1:4 with lines ls 2 lw 1, \
     dat index 0 using 1:2 with points ls 1, \
     dat index 1 using 1:2 with points ls 2, \
     0.1*x with lines ls 8
unset logscale x
set format x "%g"
unset label
set label 1 "(20.8)" at 2.2,300 right tc rgb RED
set label 2 "(20.7), run" at 2.9,9 right tc rgb GREEN
set label 3 "errors for h = 3/64, 3/256, 3/1024" at 2.9,0.06 right tc rgb BLUE
set title "α = 3/4: error of x over h"
set xlabel "t"
set xrange [0:3]
set yrange [1e-3:1e4]
plot dat index 5 using 1:3 with lines ls 2, \
     dat index 5 using 1:2 with lines ls 3, \
     dat index 2 using 1:2 with lines ls 6, \
     dat index 3 using 1:2 with lines ls 5, \
     dat index 4 using 1:2 with lines ls 1
unset multiplot
