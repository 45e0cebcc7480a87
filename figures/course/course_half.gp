# figures/course/course_half.gp -- Chapter 8: the weights of half a derivative, taken once and taken twice.
# Input: figures/course/course_half.c. Output: figures/course/course_half.svg.
width = 860; height = 360
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.07,0.985,0.15,0.9 spacing 0.1
unset key
set xlabel "n, steps back"
set xrange [-0.7:12.5]
set yrange [-1.15:1.15]
set xtics 2
set title "half a derivative: the weights never end"
set label 1 "1" at 0.4,1.0 left tc rgb BLUE
set label 2 "−1/2" at 1.3,-0.52 left tc rgb BLUE
set label 3 "−1/8, −1/16, −5/128, ..." at 2.2,-0.25 left tc rgb BLUE
plot 0 with lines lc rgb "#444444" lw 1, dat using 1:2 with impulses ls 1 lw 4, '' using 1:2 with points ls 1
set title "taken twice: two weights"
set label 1 "1" at 0.4,1.0 left tc rgb RED
set label 2 "−1" at 1.4,-1.0 left tc rgb RED
set label 3 "0, 0, 0, ..." at 2.2,-0.15 left tc rgb RED
plot 0 with lines lc rgb "#444444" lw 1, dat using 1:3 with impulses ls 2 dt 1 lw 4, '' using 1:3 with points ls 2
unset multiplot
