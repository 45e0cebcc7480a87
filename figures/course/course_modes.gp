# figures/course/course_modes.gp -- Chapter 11: a power law as a sum of exponentials.
# Input: figures/course/course_modes.c. Output: figures/course/course_modes.svg.
width = 760; height = 440
load 'figures/style.gp'
set xlabel "n, steps back"
set ylabel "size of the weight" offset 0.5,0
set logscale xy
set format "10^{%T}"
set xrange [1:1e5]
set yrange [1e-9:1]
unset key
set label 1 "the weights of order 1/2" at 400,2.5e-4 left tc rgb BLUE
set label 2 "dots: the sum of eleven modes" at 400,9e-5 left tc rgb BLACK
set label 3 "each mode is constant,\nand then it is gone" at 1.6,3e-8 left tc rgb SKY
plot for [i=1:11] dat index i using 1:2 with lines ls 6 dt 1 lw 1, \
     dat index 0 using 1:2 with lines ls 1 lw 2.6, \
     dat index 0 using 1:3 every 4 with points ls 7 pt 7 ps 0.5
