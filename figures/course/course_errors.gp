# figures/course/course_errors.gp -- Chapter 10: the error against the step, and runs with steps that are too long.
# Input: figures/course/course_errors.c. Output: figures/course/course_errors.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.08,0.94,0.14,0.9 spacing 0.13
unset key
set title "error of x(2)"
set xlabel "h"
set logscale xy
set format "10^{%T}"
set xrange [6e-4:0.4]
set yrange [1e-8:0.1]
set label 1 "α = 1/2, 3/4, 1" at 0.008,3e-3 right tc rgb "#222222"
set label 2 "α = 1/4" at 0.01,3e-4 left tc rgb "#222222"
set label 3 "α = 0: slope 2" at 0.02,2e-6 left tc rgb "#222222"
plot for [i=0:4] dat index i using 1:2 with linespoints ls int(word("8 6 7 2 4", i+1)) ps 0.5
unset label
set title "the running body, three long steps"
set xlabel "k"
unset logscale x
set format x "%g"
set xrange [0:60]
set yrange [1e-3:1e7]
set label 1 "h = 3.4" at 47,1e6 right tc rgb RED
set label 2 "h = 3.2" at 58,8 right tc rgb BROWN
set label 3 "h = 3.1" at 58,0.006 right tc rgb BLUE
plot dat index 7 using 1:2 with lines ls 2 lw 2, \
     dat index 6 using 1:2 with lines ls 5 lw 2, \
     dat index 5 using 1:2 with lines ls 1 lw 2
unset multiplot
