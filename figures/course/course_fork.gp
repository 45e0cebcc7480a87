# figures/course/course_fork.gp -- Chapter 1: the same position and the same velocity, and two futures.
# Input: figures/course/course_fork.c. Output: figures/course/course_fork.svg.
width = 860; height = 420
load 'figures/style.gp'
set xlabel "t"
set ylabel "x"
set xrange [0:14]
set yrange [-0.45:1.1]
unset key
set xzeroaxis lc rgb "#888888" lt 1
set object 1 circle at 2.8,-0.3223 size 0.13 front fs empty border rgb BLACK lw 1.6
set label 1 "same place,\nsame velocity" at 3.0,0.62 left tc rgb BLACK
set arrow 1 from 3.3,0.46 to 2.85,-0.24 head filled size 0.15,20 lc rgb BLACK
set label 2 "moving since t = 0" at 5.7,0.46 tc rgb BLUE
set label 3 "held here until t = 2.8" at 0.25,-0.39 left tc rgb RED
set label 4 "held until t = 2.8, then given the same velocity" at 5.2,-0.25 left tc rgb RED
plot dat index 1 using 1:2 with lines ls 2 lw 2.6, \
     dat index 0 using 1:2 with lines ls 1 lw 2.6
