# figures/course/course_work.gp -- Chapter 12: the error against the number of products, for three versions of the
# memory.
# Input: figures/course/course_work.c. Output: figures/course/course_work.svg.
width = 760; height = 420
load 'figures/style.gp'
set xlabel "products in the memory"
set ylabel "error of x(20)" offset 0.5,0
set logscale xy
set format "10^{%T}"
set xrange [3e3:3e8]
set yrange [1e-9:1e-2]
unset key
set label 1 "stage 6: all weights" at 1.5e6,6e-4 left tc rgb BLUE
set label 2 "stage 11: modes" at 2.6e7,1.1e-5 left tc rgb GREEN
set label 3 "stage 12: modes, order 2" at 8e5,1e-7 right tc rgb RED
plot dat index 0 using 1:2 with linespoints ls 1, \
     dat index 1 using 1:2 with linespoints ls 3, \
     dat index 2 using 1:2 with linespoints ls 2 dt 1
