# figures/course/course_film.gp -- Chapter 12: a second body, filmed and shown backwards, gives the derivatives of x
# at the last node.
# Input: figures/course/course_film.c. Output: figures/course/course_film.svg.
width = 820; height = 400
load 'figures/style.gp'
set xlabel "t"
set ylabel "x, y"
set xrange [0:20]
set yrange [-0.75:1.15]
unset key
set xzeroaxis lc rgb "#888888" lt 1
set arrow 1 from 15.2,0.93 to 13.2,0.93 head filled size 0.25,20 lc rgb RED lw 2
set label 1 "x, the body" at 0.9,0.9 left tc rgb BLUE
set label 2 "y, the film: it starts at t = 20\nand runs to the left" at 19.6,1.05 right tc rgb RED
set label 3 "circles: a push at t, and how much x(20) grows" at 19.6,-0.62 right tc rgb BLACK
plot dat index 0 using 1:2 with lines ls 1 lw 2.4, \
     dat index 0 using 1:3 with lines ls 2 lw 2.4, \
     dat index 1 using 1:2 with points ls 7 pt 6 ps 1.0
