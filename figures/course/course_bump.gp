# figures/course/course_bump.gp -- Chapter 5: half a derivative of a bump, looking back and looking ahead.
# Input: figures/course/course_bump.c. Output: figures/course/course_bump.svg.
width = 760; height = 400
load 'figures/style.gp'
set xlabel "t"
set ylabel "half a derivative"
set xrange [0:1]
set yrange [-2.2:3.4]
unset key
set arrow 1 from 0.5,-2.2 to 0.5,3.4 nohead lc rgb GREY dt (4,4)
set label 1 "the bump" at 0.33,0.5 right tc rgb BLACK
set label 2 "D_+  looks ahead:\nit knows the bump\nbefore it comes" at 0.03,-0.9 left tc rgb RED
set label 3 "D_−  looks back:\nit remembers the bump\nwhen it is over" at 0.97,-0.9 right tc rgb BLUE
plot dat using 1:2 with lines ls 7 lw 1.6, \
     dat using 1:4 with lines ls 2 lw 2.4, \
     dat using 1:3 with lines ls 1 lw 2.4
