# figures/course/course_mass.gp -- Chapter 8: the mass that the integrator seems to move.
# Input: figures/course/course_mass.c. Output: figures/course/course_mass.svg.
width = 640; height = 400
load 'figures/style.gp'
set xlabel "h"
set ylabel "largest error up to t = 14"
set logscale xy
set xrange [0.005:0.7]
set yrange [3e-6:0.15]
set format y "10^{%T}"
set rmargin 4
unset key
set label 1 "compared with the mass m" at 0.03,0.0095 right tc rgb BLUE
set label 2 "compared with the mass m − ρh/2" at 0.045,1.2e-4 left tc rgb RED
plot dat using 1:2 with linespoints ls 1, dat using 1:3 with linespoints ls 2
