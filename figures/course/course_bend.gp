# figures/course/course_bend.gp -- Chapter 4: a body and its mirror image, and the action when both or one of them is
# varied.
# Input: figures/course/course_bend.c. Output: figures/course/course_bend.svg.
width = 900; height = 400
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.07,0.985,0.14,0.9 spacing 0.12
unset key
set title "the body and its mirror, each with the same bump"
set xlabel "t"
set ylabel "place" offset 1,0
set xrange [0:10]
set yrange [-0.5:1.15]
set label 1 "x" at 0.75,0.9 tc rgb BLUE
set label 2 "y, its mirror" at 8.7,1.04 right tc rgb GREEN
set label 3 "x bent" at 6.3,0.56 left tc rgb BLUE
set label 4 "y bent" at 4.25,0.62 right tc rgb GREEN
plot dat index 0 using 1:2 with lines ls 1 lw 2.6, \
     dat index 0 using 1:3 with lines ls 3 lw 2.6, \
     dat index 0 using 1:4 with lines ls 1 dt 3 lw 1.6, \
     dat index 0 using 1:5 with lines ls 3 dt 3 lw 1.6
unset label
set title "how the action changes"
set xlabel "ε, the size of the bump"
set ylabel "S − S(0)" offset 1,0
set xrange [-0.5:0.5]
set yrange [-0.45:0.15]
set xzeroaxis lc rgb "#888888" lt 1
set label 1 "both bent" at 0,-0.2 center tc rgb BLUE
set label 2 "x alone" at -0.47,0.02 left tc rgb RED
plot dat index 1 using 1:2 with lines ls 1 lw 2.6, \
     dat index 1 using 1:3 with lines ls 2 lw 2.6
unset multiplot
