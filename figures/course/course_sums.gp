# figures/course/course_sums.gp -- Chapter 2: half a derivative of t, by sums.
# Input: figures/course/course_sums.c. Output: figures/course/course_sums.svg.
width = 760; height = 400
load 'figures/style.gp'
set xlabel "t"
set ylabel "half a derivative of t"
set xrange [0:1.16]
set yrange [0:1.25]
set xtics 0.25
unset key
set label 1 "4 steps" at 0.27,0.43 left tc rgb RED
set label 2 "16 steps" at 0.3,0.7 right tc rgb GREEN
set label 3 "2(t/π)^{1/2}" at 1.02,1.14 left tc rgb BLACK
plot dat index 2 using 1:2 with lines ls 7 lw 2, \
     dat index 1 using 1:2 with points ls 3, \
     dat index 0 using 1:2 with linespoints ls 2 ps 0.9
