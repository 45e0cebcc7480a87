# figures/course/course_weights.gp -- Chapter 1: how strongly each node of the past acts on the next step.
# Input: figures/course/course_weights.c. Output: figures/course/course_weights.svg.
width = 860; height = 400
load 'figures/style.gp'
set xlabel "t"
set ylabel "x − x_0, the distance from where the body was held"
set xrange [-0.05:4.35]
set yrange [-1.5:0.12]
set xzeroaxis lc rgb "#888888" lt 1
unset key
unset grid
set boxwidth 0.092 absolute
set style fill solid 1 noborder
# The colour of a strip shows its weight w: white for w = 0, dark blue for w = 1, linear in sqrt(w).
shade(w) = (s = w**0.5, r = int(245 - 245*s), g = int(248 - 134*s), b = int(252 - 74*s), r*65536 + g*256 + b)
set label 1 "now: 1" at 4.06,-0.06 left tc rgb "#222222"
set label 2 "−1/2" at 3.87,-1.36 center tc rgb "#222222"
set label 3 "−1/8" at 3.56,-1.44 center tc rgb "#222222"
set label 4 "−1/16" at 3.15,-1.44 center tc rgb "#222222"
set arrow 2 from 3.87,-1.29 to 3.9,-1.1 nohead lc rgb "#666666"
set arrow 3 from 3.58,-1.37 to 3.8,-1.14 nohead lc rgb "#666666"
set arrow 4 from 3.2,-1.37 to 3.7,-1.18 nohead lc rgb "#666666"
set label 5 "weights fade, but never end" at 1.1,-1.44 center tc rgb "#222222"
set arrow 5 from 0.35,-1.44 to 0.1,-1.44 head filled size 0.05,20 lc rgb "#666666"
plot dat using 1:2:(shade($3)) with boxes lc rgb variable, \
     dat using 1:2 with lines ls 1 lw 2.4, \
     dat using 1:2 every ::40::40 with points pt 7 ps 1.1 lc rgb BLACK
